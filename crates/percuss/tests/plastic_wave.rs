//! Ladder 2: every level of strain travels at its own speed, `sqrt((dσ/dε)/ρ)` (von Kármán, Rakhmatulin).

use crate::common::{rods::assert_levels, run_recorded};

const MODULUS: f64 = 100e9;
const DENSITY: f64 = 8000.0;
const COEFFICIENT: f64 = 500e6;
const EXPONENT: f64 = 0.3;

/// Plastic wave speed in the small-strain reading at a plastic strain.
fn speed(plastic_strain: f64) -> f64 {
    let yield_strain = (COEFFICIENT / MODULUS).powf(1.0 / (1.0 - EXPONENT));
    let strain = yield_strain + plastic_strain;
    let stress = COEFFICIENT * strain.powf(EXPONENT);
    let hardening = EXPONENT * stress / strain;
    (MODULUS * hardening / (MODULUS + hardening) / DENSITY).sqrt()
}

#[test]
fn strain_levels_travel_at_their_own_speeds() {
    let time = 30e-6;
    let case = format!(
        r#"
        projectile = {{ material = "hardening", length = "200 mm", diameter = "5 mm", impact_velocity = "60 m/s" }}
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
    assert_levels(&result, speed);
    assert!(
        result.numerics().energy_residual <= 1e-3 && result.numerics().momentum_residual <= 1e-12
    );
}
