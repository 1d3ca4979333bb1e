//! Ladder 4: a projectile that does not deform against a constant pressure stops after `ρ L V²/(2R)`.

use crate::common::{assert_near, run};
use percuss::outcome::Outcome;

fn stopped_by(pressure_mpa: f64, velocity: f64, courant: f64) -> percuss::outcome::RunResult {
    run(&format!(
        r#"
        projectile = {{ material = "stiff", length = "50 mm", diameter = "10 mm", impact_velocity = "{velocity} m/s" }}
        target = {{ constant_pressure = "{pressure_mpa} MPa" }}
        [chain]
        projectile_elements = 20
        courant = {courant}
        [materials.stiff]
        name = "nearly rigid"
        density = "8000 kg/m3"
        youngs_modulus = "1000 GPa"
        poissons_ratio = 0.3
        strength.elastic = {{}}
        "#
    ))
}

#[test]
fn depth_is_the_kinetic_energy_over_the_force() {
    for (pressure_mpa, velocity) in [(100.0, 100.0), (500.0, 300.0), (50.0, 20.0)] {
        let result = stopped_by(pressure_mpa, velocity, 0.8);
        let exact = 8000.0 * 0.05 * velocity * velocity / (2.0 * pressure_mpa * 1e6);
        let depth = result.depth_of_penetration.unwrap();
        assert_eq!(result.outcome, Outcome::AtRest);
        assert_near(
            &format!("depth at {pressure_mpa} MPa, {velocity} m/s [m]"),
            depth,
            exact,
            5e-3,
        );
        let time = result.time_to_rest.unwrap();
        assert_near("time to rest [s]", time, 2.0 * exact / velocity, 5e-3);
        assert!(
            result.numerics().energy_residual <= 1e-3
                && result.numerics().momentum_residual <= 1e-12
        );
    }
}

/// What erodes at the tip does not take the pressure away. The force is `R A₀` whenever the tip moves and less while it holds
/// a tip that has just been bared, so its impulse can only fall short of `R A₀ t`, and only by a little.
#[test]
fn the_pressure_stays_on_a_tip_that_erodes() {
    let result = run(r#"
        projectile = { material = "copper", length = "50 mm", diameter = "10 mm", impact_velocity = "800 m/s" }
        target = { constant_pressure = "2 GPa" }
        "#);
    assert_eq!(result.outcome, Outcome::AtRest);
    assert!(result.numerics().eroded_elements.0 > 0);
    let force = 2e9 * std::f64::consts::PI * 0.01_f64.powi(2) / 4.0;
    let stopped = result.numerics().momentum.initial - result.numerics().momentum.eroded;
    let share = stopped / (force * result.time_to_rest.unwrap());
    println!("impulse over the largest possible one: {share:.4}");
    assert!(share <= 1.0 && share > 0.97, "{share}");
    assert_near("peak force [N]", result.peak_force.unwrap(), force, 1e-9);
}

#[test]
fn a_projectile_of_which_nothing_is_left_ends_the_run() {
    // Its only element fails in tension at once.
    let result = run(r#"
        projectile = { material = "copper-woodward", length = "1 mm", diameter = "0.5 mm", impact_velocity = "2213.9 m/s" }
        target = { constant_pressure = "2901 MPa" }
        [chain]
        projectile_elements = 1
        failure = { spall = { strength = "50 MPa" } }
        "#);
    assert_eq!(result.outcome, Outcome::ProjectileEroded);
    assert_eq!(result.projectile_final_mass, Some(0.0));
}
