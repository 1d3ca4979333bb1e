//! Ladder 3: a rod on a rigid wall.

use crate::common::{assert_near, run, wilkins};

/// A rigid, perfectly plastic rod: Taylor's moving front in the true-stress, constant-volume form.
///
/// Across the front `ρ v²/Y = e²/(1 − e)`, with `e = 1 − A₀/A`; the undeformed rear `h` shortens by
/// `dh = h d(ρv²/Y)/(2e)` and what passed the front is shortened by `1 − e`.
fn taylor_length(density: f64, velocity: f64, yield_stress: f64) -> f64 {
    let number = density * velocity * velocity / yield_stress;
    let strain = |number: f64| 0.5 * (-number + (number * number + 4.0 * number).sqrt());
    let steps = 200_000;
    // In s = sqrt(number) the integrand is smooth: d(number)/(2e) = (s/e) ds.
    let step = number.sqrt() / f64::from(steps);
    let (mut rear, mut length) = (1.0_f64, 0.0);
    for i in (0..steps).rev() {
        let s = (f64::from(i) + 0.5) * step;
        let e = strain(s * s);
        let before = rear;
        rear *= (-s / e * step).exp();
        length += (before - rear) * (1.0 - e);
    }
    rear + length
}

fn rigid_plastic(velocity: f64, elements: u32) -> f64 {
    let result = run(&format!(
        r#"
        projectile = {{ material = "stiff", length = "100 mm", diameter = "10 mm", velocity = "{velocity} m/s" }}
        target = {{ rigid_wall = true }}
        [chain]
        projectile_elements = {elements}
        [materials.stiff]
        name = "nearly rigid, perfectly plastic"
        density = "8000 kg/m3"
        youngs_modulus = "1000 GPa"
        poissons_ratio = 0.3
        strength.perfectly_plastic = {{ flow_stress = "200 MPa" }}
        "#
    ));
    assert!(
        result.numerics().energy_residual <= 1e-3 && result.numerics().momentum_residual <= 1e-12
    );
    result.projectile_final_length.unwrap() / 0.1
}

#[test]
fn a_rigid_plastic_rod_shortens_as_taylor_says() {
    for velocity in [30.0, 60.0, 100.0] {
        let length = rigid_plastic(velocity, 200);
        let exact = taylor_length(8000.0, velocity, 200e6);
        assert_near(&format!("Lf/L0 at {velocity} m/s"), length, exact, 5e-3);
    }
}

#[test]
fn at_low_speed_the_front_stands_still() {
    // ln(Lf/L0) = −ρV²/(2Y) holds to first order in ρV²/Y.
    let length = rigid_plastic(30.0, 200);
    let exact = (-8000.0 * 30.0_f64.powi(2) / (2.0 * 200e6)).exp();
    assert_near("Lf/L0 at 30 m/s", length, exact, 2e-3);
}

/// Copper rods of Wilkins & Guinan (1973), the paper's power law, nothing fitted.
#[test]
fn copper_rods_end_as_long_as_they_were_measured() {
    for (velocity, measured_mm) in [
        (89.0, 21.01),
        (123.0, 19.60),
        (153.0, 18.31),
        (183.0, 16.81),
    ] {
        let result = run(&wilkins(velocity));
        let length = result.projectile_final_length.unwrap() * 1e3;
        assert_near(
            &format!("final length at {velocity} m/s [mm]"),
            length,
            measured_mm,
            0.03,
        );
    }
}
