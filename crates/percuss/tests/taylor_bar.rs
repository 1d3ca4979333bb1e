//! Ladder 3: a rod on a rigid wall.

use crate::common::{
    assert_near,
    rods::{assert_wilkins, taylor_length},
    run,
};

fn rigid_plastic(velocity: f64, elements: u32) -> f64 {
    let result = run(&format!(
        r#"
        projectile = {{ material = "stiff", length = "100 mm", diameter = "10 mm", impact_velocity = "{velocity} m/s" }}
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
        let exact = taylor_length(8000.0 * velocity * velocity / 200e6);
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

#[test]
fn copper_rods_end_as_long_as_they_were_measured() {
    assert_wilkins(run);
}
