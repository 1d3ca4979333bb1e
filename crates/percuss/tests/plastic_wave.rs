//! Ladder 2: every level of strain travels at its own speed, `sqrt((dσ/dε)/ρ)` (von Kármán, Rakhmatulin).

use crate::common::{assert_near, run_recorded};

const MODULUS: f64 = 100e9;
const DENSITY: f64 = 8000.0;
const COEFFICIENT: f64 = 500e6;
const EXPONENT: f64 = 0.3;

/// Stress and plastic wave speed in the small-strain reading at a plastic strain.
fn level(plastic_strain: f64) -> (f64, f64) {
    let yield_strain = (COEFFICIENT / MODULUS).powf(1.0 / (1.0 - EXPONENT));
    let strain = yield_strain + plastic_strain;
    let stress = COEFFICIENT * strain.powf(EXPONENT);
    let hardening = EXPONENT * stress / strain;
    (
        stress,
        (MODULUS * hardening / (MODULUS + hardening) / DENSITY).sqrt(),
    )
}

#[test]
fn strain_levels_travel_at_their_own_speeds() {
    let time = 30e-6;
    let case = format!(
        r#"
        projectile = {{ material = "hardening", length = "200 mm", diameter = "5 mm", velocity = "60 m/s" }}
        target = {{ rigid_wall = true }}
        [chain]
        projectile_elements = 2000
        kinematics = "small-strain"
        end_time = "{} us"
        [chain.artificial_viscosity]
        linear = 0.02
        [materials.hardening]
        name = "hardening"
        density = "{DENSITY} kg/m3"
        youngs_modulus = "{} GPa"
        poissons_ratio = 0.3
        strength.power_law = {{ coefficient = "{} MPa", exponent = {EXPONENT} }}
        "#,
        time * 1e6,
        MODULUS / 1e9,
        COEFFICIENT / 1e6
    );
    let result = run_recorded(&case);
    let profile = result.history.as_ref().unwrap().profiles.last().unwrap();
    // From the wall inwards plastic strain falls off; find where each level stands.
    let points: Vec<(f64, f64)> = profile
        .elements
        .iter()
        .rev()
        .map(|element| (-element.initial_position, element.plastic_strain))
        .collect();
    // The wall sees the speed ∫ c dε: it must lie beyond the levels looked at.
    let mut checked = 0;
    for plastic_strain in [0.005, 0.01, 0.015, 0.02] {
        let (_, speed) = level(plastic_strain);
        let Some(pair) = points
            .windows(2)
            .find(|p| p[0].1 >= plastic_strain && p[1].1 < plastic_strain)
        else {
            continue;
        };
        let share = (pair[0].1 - plastic_strain) / (pair[0].1 - pair[1].1);
        let position = pair[0].0 + share * (pair[1].0 - pair[0].0);
        assert_near(
            &format!("speed of plastic strain {plastic_strain} [m/s]"),
            position / profile.time,
            speed,
            1e-2,
        );
        checked += 1;
    }
    assert!(checked >= 3, "only {checked} levels were reached");
    assert!(
        result.numerics().energy_residual <= 1e-3 && result.numerics().momentum_residual <= 1e-12
    );
}
