//! Ladder 1: elastic bars have exact solutions.

use crate::common::{assert_near, mean, rods::elastic_bars, run_recorded};
use percuss::outcome::Outcome;

/// Two elastic bars with the elastic constants of Table 1, in small strain.
fn bars(
    velocity: f64,
    thickness_mm: f64,
    target: &str,
    back_face: &str,
    elements: (u32, u32),
    options: &str,
) -> String {
    let (projectile, plate) = elements;
    let options = format!(
        "[chain]\nprojectile_elements = {projectile}\ntarget_elements = {plate}\nborder_shear = 0.0\n{options}"
    );
    elastic_bars(velocity, target, thickness_mm, back_face, &options)
}

const SMALL: &str = "kinematics = \"small-strain\"";

#[test]
fn interface_speed_and_stress_of_unlike_bars() {
    let result = run_recorded(&bars(230.0, 25.0, "plate", "fixed", (80, 160), SMALL));
    let (z1, z2) = ((114e9_f64 * 8500.0).sqrt(), (70e9_f64 * 2780.0).sqrt());
    let speed = z1 * 230.0 / (z1 + z2);
    let stress = z1 * z2 * 230.0 / (z1 + z2);
    assert!((speed - 158.8).abs() < 0.05 && (stress - 2.216e9).abs() < 0.5e6);
    // Behind the front and before the wave comes back from the rod's tail at 2 L/c = 6.96 us.
    let (from, to) = (1.5e-6, 6.3e-6);
    let area = std::f64::consts::PI * 4.8e-3 * 4.8e-3 / 4.0;
    assert_near(
        "interface speed [m/s]",
        mean(&result, from, to, |s| s.interface_velocity),
        speed,
        1e-3,
    );
    assert_near(
        "interface stress [Pa]",
        mean(&result, from, to, |s| s.contact_force / area),
        stress,
        1e-3,
    );
    assert!(
        result.numerics().energy_residual <= 1e-6,
        "energy residual {:e}",
        result.numerics().energy_residual
    );
    assert!(
        result.numerics().momentum_residual <= 1e-12,
        "momentum residual {:e}",
        result.numerics().momentum_residual
    );

    // Without viscosity the plateau rings; that is what central differences do, and this is by how much.
    let samples = &result.history.as_ref().unwrap().samples;
    let ringing = samples
        .iter()
        .filter(|s| (from..to).contains(&s.time))
        .map(|s| (s.interface_velocity / speed - 1.0).abs())
        .fold(0.0, f64::max);
    println!("largest ringing on the plateau: {:.2} %", 100.0 * ringing);
    assert!(ringing < 0.2);
}

/// In logarithmic strain the book closes to second order in the strain of a step, so the residual falls with the speed.
#[test]
fn large_strain_gives_the_same_at_low_speed() {
    let (z1, z2) = ((114e9_f64 * 8500.0).sqrt(), (70e9_f64 * 2780.0).sqrt());
    let mut residuals = Vec::new();
    for velocity in [23.0, 2.3, 0.23] {
        let result = run_recorded(&bars(velocity, 25.0, "plate", "fixed", (80, 160), ""));
        println!(
            "energy residual at {velocity} m/s: {:.2e}",
            result.numerics().energy_residual
        );
        residuals.push(result.numerics().energy_residual);
        assert!(result.numerics().momentum_residual <= 1e-12);
        if velocity == 0.23 {
            let speed = mean(&result, 1.5e-6, 6.3e-6, |s| s.interface_velocity);
            assert_near(
                "interface speed [m/s]",
                speed,
                z1 * velocity / (z1 + z2),
                1e-3,
            );
        }
    }
    assert!(
        residuals[0] <= 1e-4 && residuals[1] <= 1e-5 && residuals[2] <= 1e-6,
        "{residuals:?}"
    );
}

#[test]
fn equal_bars_exchange_velocities_and_part_after_a_round_trip() {
    let result = run_recorded(&bars(10.0, 12.74, "rod", "free", (200, 200), SMALL));
    assert_eq!(result.outcome, Outcome::AtRest);
    let transit = 2.0 * 12.74e-3 / (114e9_f64 / 8500.0).sqrt();
    let samples = &result.history.as_ref().unwrap().samples;
    let parted = samples
        .iter()
        .rev()
        .find(|s| s.contact_force > 0.0)
        .unwrap()
        .time;
    assert_near("contact time [s]", parted, transit, 5e-3);
    // All momentum and, except for what rings in the bars, all energy are the target's.
    let ledger = &result.numerics().momentum;
    assert_near(
        "momentum of the struck bar [N s]",
        ledger.target,
        ledger.initial,
        5e-3,
    );
    let restitution = (ledger.target - ledger.projectile) / ledger.initial;
    assert_near("coefficient of restitution", restitution, 1.0, 1e-2);
    assert!(
        result.numerics().energy_residual <= 1e-6 && result.numerics().momentum_residual <= 1e-12
    );
}

#[test]
fn a_non_reflecting_end_lets_the_wave_out() {
    let result = run_recorded(&bars(
        10.0,
        12.74,
        "rod",
        "non-reflecting",
        (100, 100),
        SMALL,
    ));
    // Equal bars: the whole wave leaves through the back, and nothing pushes the rod back.
    let out = result.numerics().energy.boundary / result.numerics().energy.initial;
    assert!(out > 0.99, "only {out} of the energy left");
    assert!(
        result.residual_velocity.unwrap().abs() < 0.02 * 10.0,
        "{}",
        result.residual_velocity.unwrap()
    );
    assert!(
        result.numerics().energy_residual <= 1e-6 && result.numerics().momentum_residual <= 1e-12
    );
}

/// With linear hardening the stress on a wall is that of an elastic wave with a slower plastic wave behind it.
#[test]
fn stress_past_yield() {
    let (modulus, density, yield_stress, hardening) = (100e9_f64, 8000.0, 200e6, 5e9_f64);
    let case = format!(
        r#"
        projectile = {{ material = "bilinear", length = "50 mm", diameter = "5 mm", impact_velocity = "40 m/s" }}
        target = {{ rigid_wall = true }}
        [chain]
        projectile_elements = 800
        kinematics = "small-strain"
        adiabatic_heating = false
        [chain.artificial_viscosity]
        linear = 0.1
        [materials.bilinear]
        name = "bilinear"
        density = "{density} kg/m3"
        youngs_modulus = "{} GPa"
        poissons_ratio = 0.3
        strength.johnson_cook = {{ a = "{} MPa", b = "{} GPa", n = 1.0, c = 0.0, m = 1.0 }}
        "#,
        modulus / 1e9,
        yield_stress / 1e6,
        hardening / 1e9
    );
    let result = run_recorded(&case);
    let elastic = (modulus / density).sqrt();
    let plastic = (modulus * hardening / (modulus + hardening) / density).sqrt();
    let yield_speed = yield_stress / (density * elastic);
    let stress = yield_stress + density * plastic * (40.0 - yield_speed);
    let area = std::f64::consts::PI * 25e-6 / 4.0;
    let force = mean(&result, 4e-6, 24e-6, |s| s.contact_force);
    assert_near("stress past yield [Pa]", force / area, stress, 2e-3);
}

/// At default options elastic bars run at any of the paper's speeds: where the book does not balance, the time step is halved.
#[test]
fn default_options_carry_elastic_bars() {
    for (target, back_face) in [
        ("plate", "fixed"),
        ("rod", "free"),
        ("plate", "non-reflecting"),
    ] {
        for velocity in [100.0, 230.0, 400.0] {
            let result = run_recorded(&bars(velocity, 25.0, target, back_face, (40, 80), ""));
            assert!(result.numerics().energy_residual <= 1e-3);
        }
    }
}

/// A column of elastic material behind a non-reflecting end drifts; what drifts is no crater.
#[test]
fn the_drift_of_a_non_reflecting_column_is_not_depth() {
    let result = run_recorded(&bars(100.0, 25.0, "plate", "non-reflecting", (40, 80), ""));
    let deepest = result.largest_depth.unwrap();
    // The column shortens by at most the strain of the plateau over its length.
    let strain = 100.0 * (114e9_f64 * 8500.0).sqrt()
        / ((114e9_f64 * 8500.0).sqrt() + (70e9_f64 * 2780.0).sqrt())
        / (70e9_f64 / 2780.0).sqrt();
    assert!(deepest < 1.2 * strain * 25e-3, "{deepest}");
}
