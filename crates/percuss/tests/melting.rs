//! Rate and heat act in projectile and target alike, up to the melting point.

use crate::common::run;
use percuss::outcome::RunResult;

/// A rod on a plate of the same metal, which melts at a temperature [K].
fn shot(melting: f64, options: &str) -> RunResult {
    run(&format!(
        r#"
        projectile = {{ material = "metal", length = "20 mm", diameter = "5 mm", impact_velocity = "600 m/s" }}
        target = {{ material = "metal", thickness = "15 mm" }}
        [chain]
        constraint_factor = 1.0
        border_shear = 0.2
        erosion_strain = 3.0
        {options}
        [materials.metal]
        name = "metal"
        density = "7800 kg/m3"
        youngs_modulus = "200 GPa"
        poissons_ratio = 0.3
        specific_heat = "450 J/(kg K)"
        melting_temperature = "{melting} K"
        strength.johnson_cook = {{ a = "400 MPa", b = "300 MPa", n = 0.3, c = 0.02, m = 1.0 }}
        "#
    ))
}

fn warned(result: &RunResult, body: &str) -> bool {
    let words = format!("the {body} reached");
    result
        .warnings
        .iter()
        .any(|w| w.contains(&words) && w.contains("melting point"))
}

#[test]
fn both_bodies_melt_and_say_so() {
    let result = shot(360.0, "");
    let (projectile, target) = result.numerics().largest_temperature;
    println!("{projectile} K, {target} K\n{:#?}", result.warnings);
    for temperature in [projectile, target] {
        // Without strength nothing heats any more: the temperature stays at the melting point.
        assert!((355.0..365.0).contains(&temperature), "{temperature}");
    }
    assert!(warned(&result, "projectile") && warned(&result, "target"));
    assert!(
        result.numerics().energy_residual <= 1e-3 && result.numerics().momentum_residual <= 1e-9
    );
}

#[test]
fn heat_softens_and_rate_hardens_both_bodies() {
    let plain = shot(1800.0, "rate_effects = false\nadiabatic_heating = false");
    let hot = shot(1800.0, "rate_effects = false");
    let fast = shot(1800.0, "adiabatic_heating = false");
    let strains = |result: &RunResult| result.numerics().largest_plastic_strain;
    println!(
        "{:?} {:?} {:?}",
        strains(&plain),
        strains(&hot),
        strains(&fast)
    );
    assert!(!warned(&hot, "projectile") && !warned(&hot, "target"));
    assert_eq!(plain.numerics().largest_temperature, (293.0, 293.0));
    assert!(
        hot.numerics().largest_temperature.0 > 320.0
            && hot.numerics().largest_temperature.1 > 320.0
    );
    let depth = |result: &RunResult| result.depth_of_penetration.unwrap();
    let length = |result: &RunResult| result.projectile_final_length.unwrap();
    println!("{} {} {}", depth(&plain), depth(&hot), depth(&fast));
    assert!(length(&hot) < length(&plain) && length(&plain) < length(&fast));
}
