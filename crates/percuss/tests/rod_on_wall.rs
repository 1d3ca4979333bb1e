//! Rods on a rigid wall, by the models of one flow stress.

use crate::common::{assert_near, scenario, wilkins};
use percuss::{
    Scenario,
    analytic::{mean_flow_stress, taylor_yield_stress, wilkins_guinan_length},
    case::load_str,
    material::Library,
    model::{self, Control},
    outcome::RunResult,
};

const MODELS: [&str; 2] = ["taylor", "wilkins_guinan"];

fn run(model: &str, scenario: &Scenario) -> RunResult {
    model::run(
        model::model(model).unwrap(),
        scenario,
        &mut Control::default(),
    )
    .unwrap_or_else(|error| panic!("{model}: {error}"))
}

fn detail(result: &RunResult, name: &str) -> f64 {
    let found = result.details.iter().find(|detail| detail.name == name);
    found
        .unwrap_or_else(|| panic!("{name}: {:?}", result.details))
        .value
}

#[test]
fn copper_rods_are_predicted_without_a_fit() {
    for material in ["copper", "ofhc-copper"] {
        for model in MODELS {
            let mut sum = 0.0;
            let runs = [
                (89.0, 21.01),
                (123.0, 19.60),
                (153.0, 18.31),
                (183.0, 16.81),
            ];
            for (velocity, measured) in runs {
                let text = wilkins(velocity).replace("\"copper\"", &format!("\"{material}\""));
                let result = run(model, &scenario(&text));
                let length = result.projectile_final_length.unwrap() * 1e3;
                let error = length / measured - 1.0;
                println!(
                    "{model}, {material}, {velocity} m/s: {length:.2} mm, measured {measured} mm ({:+.1} %), Y = {:.0} MPa, strain {:.2}, rate {:.0}/s",
                    100.0 * error,
                    detail(&result, "dynamic yield stress"),
                    detail(&result, "mean strain"),
                    detail(&result, "mean strain rate"),
                );
                sum += error * error;
            }
            let rms = (sum / 4.0_f64).sqrt();
            println!("{model}, {material}: RMS {:.1} %", 100.0 * rms);
            assert!(rms < 0.05, "{model} {material} {rms}");
        }
    }
}

#[test]
fn the_yield_stress_is_its_own_mean() {
    let case = scenario(&wilkins(150.0).replace("\"copper\"", "\"ofhc-copper\""));
    for model in MODELS {
        let result = run(model, &case);
        let mean = mean_flow_stress(
            &case.projectile.material,
            detail(&result, "mean strain"),
            detail(&result, "mean strain rate"),
        );
        assert_near(
            model,
            detail(&result, "dynamic yield stress") * 1e6,
            mean.unwrap(),
            1e-9,
        );
    }
}

#[test]
fn a_given_yield_stress_is_used_and_found_again() {
    let text = wilkins(150.0);
    let text = format!(
        "{text}\n[taylor]\ndynamic_yield_stress = \"400 MPa\"\n[wilkins_guinan]\ndynamic_yield_stress = \"400 MPa\""
    );
    let case = scenario(&text);
    let density = case.projectile.material.density.si();
    let ratio = |model: &str| run(model, &case).projectile_final_length.unwrap() / 0.02347;
    let found = taylor_yield_stress(density, 150.0, ratio("taylor")).unwrap();
    assert_near("taylor, inverse", found, 400e6, 1e-9);
    let exact = wilkins_guinan_length(density * 150.0_f64.powi(2) / 400e6, 0.12);
    assert_near("wilkins_guinan", ratio("wilkins_guinan"), exact, 1e-12);
}

#[test]
fn slow_rods_keep_their_length_and_fast_ones_do_not_grow() {
    for model in MODELS {
        let mut last = 0.02347 * (1.0 + 1e-14);
        for velocity in [0.0, 1.0, 30.0, 80.0, 160.0, 240.0, 320.0] {
            let length = run(model, &scenario(&wilkins(velocity)))
                .projectile_final_length
                .unwrap();
            assert!(length > 0.0 && length <= last, "{model} {velocity}");
            last = length;
        }
        let still = run(model, &scenario(&wilkins(0.0)));
        let length = still.projectile_final_length.unwrap();
        assert!((length / 0.02347 - 1.0).abs() < 1e-14, "{model} {length}");
    }
}

#[test]
fn every_material_gives_a_length_or_a_reason() {
    for entry in Library::built_in().iter() {
        for velocity in [50.0, 200.0, 400.0, 1000.0] {
            let text = wilkins(velocity).replace("\"copper\"", &format!("\"{}\"", entry.id));
            let case = load_str("test", &text).unwrap();
            for name in MODELS {
                let model = model::model(name).unwrap();
                match model::run(model, &case, &mut Control::default()) {
                    Ok(result) => {
                        let length = result.projectile_final_length.unwrap();
                        assert!(
                            length > 0.0 && length <= 0.02347,
                            "{name} {} {length}",
                            entry.id
                        );
                    }
                    Err(error) => println!("{name}, {}, {velocity} m/s: {error}", entry.id),
                }
            }
        }
    }
}

/// Every numerical model says alike what a material's record does not cover, and what a wall does not have.
#[test]
fn models_agree_on_the_range_of_a_record_and_on_what_a_wall_lacks() {
    let text = r#"
        projectile = { material = "metal", length = "20 mm", diameter = "5 mm", impact_velocity = "200 m/s" }
        target = { rigid_wall = true }
        particles = { formulation = "particle-stress", spacing = "0.5 mm" }
        axi = { cells_per_radius = 4 }
        [materials.metal]
        name = "metal"
        density = "8960 kg/m3"
        youngs_modulus = "124 GPa"
        poissons_ratio = 0.34
        specific_heat = "380 J/(kg K)"
        validity = { plastic_strain_max = 0.05, strain_rate_max = "10 1/s", temperature_max = "300 K" }
        strength.johnson_cook = { a = "200 MPa", b = "100 MPa", n = 0.5, c = 0.0, m = 1.0 }
    "#;
    for name in ["chain", "fdm", "axi", "particles"] {
        let model = model::model(name).unwrap();
        let result = model::run(model, &scenario(text), &mut Control::recording()).unwrap();
        let says = |words: &str| result.warnings.iter().any(|w| w.contains(words));
        assert!(says("the projectile reached a plastic strain of"), "{name}");
        assert!(
            says("K, beyond 300 K to which its law was fitted"),
            "{name}: {:#?}",
            result.warnings
        );
        assert!(
            says("has no melting temperature: heat does not reduce"),
            "{name}"
        );
        let keeps_rates = matches!(name, "chain" | "fdm");
        assert_eq!(says("reached a strain rate of"), keeps_rates, "{name}");
        for sample in &result.history.unwrap().samples {
            for number in [
                sample.interface_velocity,
                sample.back_velocity,
                sample.back_force,
            ] {
                assert!(number.is_nan(), "{name}: {sample:?}");
            }
        }
    }
}

/// Cells that chatter on a wall give neither a peak force nor a contact time; an ordinary impact is not warned of.
#[test]
fn a_contact_that_opens_and_closes_is_warned_of() {
    for (speed, expected) in [(300.0, false), (1500.0, true)] {
        let text = format!(
            "projectile = {{ material = 'mars-500-plate', length = '100 mm', diameter = '20 mm', impact_velocity = '{speed} m/s' }}\n\
             target = {{ rigid_wall = true }}"
        );
        let result = run("fdm", &scenario(&text));
        let words = "peak force and contact time depend on the mesh";
        let warned = result.warnings.iter().any(|w| w.contains(words));
        assert_eq!(warned, expected, "{speed} m/s");
    }
}

/// A plate at the bound of a warning by thickness is the same plate in inches.
#[test]
fn warnings_of_a_plate_do_not_depend_on_the_unit() {
    for model in ["chain", "axi"] {
        let warnings = |diameter: &str, thickness: &str| {
            let text = format!(
                "projectile = {{ material = 'copper', length = '20 mm', diameter = '{diameter}', impact_velocity = '100 m/s' }}\n\
                 target = {{ material = 'aluminium-2024-t351', thickness = '{thickness}' }}\naxi = {{ cells_per_radius = 3 }}"
            );
            run(model, &scenario(&text)).warnings.len()
        };
        let inches = warnings("0.393700787401575 in", "1.18110236220472 in");
        assert_eq!(warnings("10 mm", "30 mm"), inches, "{model}");
    }
}

/// In one dimension a rod of constant strength stops in a plastic shock, as `taylor` has it: its nominal stress `Y/(1 − e)` grows ever faster
/// with the strain. Elements without viscosity lack what the shock dissipates, and crush further on any mesh.
#[test]
fn a_plastic_shock_needs_viscosity() {
    let length = |model: &str, velocity: f64, elements: u32, quadratic: f64| {
        let text = format!(
            r#"
            projectile = {{ material = "rod", length = "50 mm", diameter = "10 mm", impact_velocity = "{velocity} m/s" }}
            target.rigid_wall = true
            [chain]
            projectile_elements = {elements}
            erosion_strain = "never"
            artificial_viscosity.quadratic = {quadratic:?}
            [materials.rod]
            density = "7850 kg/m3"
            youngs_modulus = "200 GPa"
            poissons_ratio = 0.3
            strength.perfectly_plastic.flow_stress = "400 MPa"
            "#
        );
        let result = run(model, &scenario(&text));
        let mut warnings = result.warnings.iter();
        let warns =
            warnings.any(|warning| warning.contains("set `") && warning.contains("plastic shock"));
        assert_eq!(
            warns,
            model != "taylor" && quadratic == 0.0 && velocity > 280.0,
            "{model}"
        );
        result.projectile_final_length.unwrap()
    };
    // Below ρV²/Y = 1.5 there is no warning.
    for model in ["chain", "fdm"] {
        length(model, 270.0, 40, 0.0);
    }
    for (velocity, short) in [(300.0, 0.05), (400.0, 0.15)] {
        let exact = length("taylor", velocity, 40, 0.0);
        for model in ["chain", "fdm"] {
            let error =
                |elements, quadratic| length(model, velocity, elements, quadratic) / exact - 1.0;
            let errors = [40, 160, 640].map(|elements| error(elements, 2.0));
            println!("{model} at {velocity} m/s: {errors:.4?}");
            assert!(
                errors[0] > errors[1] && errors[1] > errors[2].abs(),
                "{errors:?}"
            );
            assert!(errors[2].abs() < 0.006, "{errors:?}");
            assert!(error(160, 0.0) < -short, "{model} {velocity}");
        }
    }
}
