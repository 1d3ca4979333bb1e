//! Rigid projectiles in thick targets: limits, scaling, guards, by every model that takes them.

use crate::common::{assert_near, scenario};
use percuss::{
    Error, Scenario,
    analytic::{CavityExpansion, effective_yield_stress},
    case::Nose,
    material::{Library, cavity_expansion_pressure},
    model::{self, Control},
    outcome::{Outcome, RunResult, Termination},
};

const METAL_MODELS: [&str; 4] = ["forrestal", "cavity_expansion", "poncelet", "crater_energy"];

fn run(model: &str, scenario: &Scenario) -> Result<RunResult, Error> {
    model::run(
        model::model(model).unwrap(),
        scenario,
        &mut Control::default(),
    )
}

fn computed(model: &str, scenario: &Scenario) -> RunResult {
    run(model, scenario).unwrap_or_else(|error| panic!("{model}: {error}"))
}

fn depth(model: &str, scenario: &Scenario) -> f64 {
    computed(model, scenario).depth_of_penetration.unwrap()
}

/// A hard steel rod into aluminium; `nose` and `options` are TOML.
fn rod(nose: &str, velocity: f64, options: &str) -> Scenario {
    scenario(&format!(
        r#"
        [projectile]
        material = "hard"
        length = "71 mm"
        diameter = "7.1 mm"
        nose = {nose}
        impact_velocity = "{velocity} m/s"
        [target]
        material = "soft"
        thickness = "semi-infinite"
        {options}
        [materials.hard]
        name = "rigid steel"
        density = "8000 kg/m3"
        youngs_modulus = "200 GPa"
        poissons_ratio = 0.3
        strength.elastic = {{}}
        [materials.soft]
        name = "6061-T6 like, perfectly plastic"
        density = "2710 kg/m3"
        youngs_modulus = "68.9 GPa"
        poissons_ratio = 0.333
        strength.perfectly_plastic = {{ flow_stress = "276 MPa" }}
        "#
    ))
}

const NOSES: [&str; 4] = [
    "\"flat\"",
    "\"hemisphere\"",
    "{ cone = { length_to_diameter = 1.5 } }",
    "{ ogive = { crh = 3.0 } }",
];

#[test]
fn nothing_goes_nowhere_at_zero_speed() {
    for nose in NOSES {
        for model in METAL_MODELS {
            for options in [
                "",
                "[forrestal]\nentry = \"gradual\"\ncavity = \"compressible\"",
            ] {
                let result = computed(model, &rod(nose, 0.0, options));
                assert_eq!(result.depth_of_penetration, Some(0.0), "{model} {nose}");
                assert_eq!(result.peak_force.unwrap_or(0.0), 0.0);
                assert_eq!(result.termination, Termination::NothingMoves);
            }
        }
    }
}

#[test]
fn slow_runs_go_as_deep_as_their_energy_over_the_force() {
    for nose in NOSES {
        for model in ["forrestal", "cavity_expansion", "poncelet"] {
            let case = rod(nose, 1.0, "");
            let rod = &case.projectile;
            let resistance = cavity_expansion_pressure(&layer(&case)).unwrap();
            let exact = rod.mass / (2.0 * rod.area() * resistance);
            assert_near(&format!("{model} {nose}"), depth(model, &case), exact, 3e-6);
        }
    }
    // ρLV²/(2R) for a flat rod, whatever the model.
    let case = rod("\"flat\"", 1.0, "");
    let exact = 8000.0 * 0.071 / (2.0 * cavity_expansion_pressure(&layer(&case)).unwrap());
    for model in METAL_MODELS {
        assert_near(model, depth(model, &case), exact, 3e-6);
    }
}

fn layer(case: &Scenario) -> percuss::material::Material {
    match &case.target {
        percuss::scenario::TargetBody::Layers { layers, .. } => (*layers[0].material).clone(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn faster_goes_deeper_and_sharper_goes_deeper() {
    for model in METAL_MODELS {
        for nose in NOSES {
            let mut last = 0.0;
            for speed in (1..=15).map(|i| 100.0 * f64::from(i)) {
                let now = depth(model, &rod(nose, speed, ""));
                assert!(now.is_finite() && now > last, "{model} {nose} {speed}");
                last = now;
            }
        }
    }
    // Of one mass: forrestal and poncelet alone see the shape of the nose.
    for model in ["forrestal", "poncelet"] {
        let mut last = 0.0;
        for nose in [
            Nose::Flat,
            Nose::Hemisphere,
            Nose::Cone {
                length_to_diameter: 1.0,
            },
            Nose::Ogive { crh: 4.5 },
        ] {
            let mut case = rod("\"flat\"", 800.0, "");
            case.projectile.nose = nose;
            let now = depth(model, &case);
            assert!(now > last, "{model} {nose:?}");
            last = now;
        }
    }
}

#[test]
fn lengths_times_two_give_depths_times_two() {
    for model in METAL_MODELS {
        for nose in NOSES {
            let case = rod(
                nose,
                700.0,
                "[forrestal]\ncavity = \"compressible\"\nentry = \"gradual\"",
            );
            let mut twice = case.clone();
            twice.projectile.length *= 2.0;
            twice.projectile.diameter *= 2.0;
            twice.projectile.mass *= 8.0;
            let (one, two) = (computed(model, &case), computed(model, &twice));
            let ratio = two.depth_of_penetration.unwrap() / one.depth_of_penetration.unwrap();
            assert!((ratio / 2.0 - 1.0).abs() < 1e-11, "{model} {nose} {ratio}");
            if let (Some(one), Some(two)) = (one.time_to_rest, two.time_to_rest) {
                assert!((two / one / 2.0 - 1.0).abs() < 1e-11, "{model} {nose}");
            }
        }
    }
}

#[test]
fn the_models_stand_in_order() {
    // No inertia, drag ρ N V², inertia 3/2 ρ N V².
    for nose in NOSES {
        let case = rod(nose, 900.0, "");
        let depths = ["cavity_expansion", "poncelet", "forrestal"].map(|model| depth(model, &case));
        assert!(depths[0] > depths[1] && depths[1] > depths[2], "{depths:?}");
        let warned = computed("cavity_expansion", &case);
        assert!(
            warned
                .warnings
                .iter()
                .any(|text| text.contains("inertia of the target"))
        );
    }
    // Friction costs depth; a compressible target costs less of it; both are bracketed by the band.
    let case = rod(NOSES[3], 900.0, "");
    let plain = computed("forrestal", &case);
    let rough = depth(
        "forrestal",
        &rod(NOSES[3], 900.0, "[forrestal]\nfriction = 0.1"),
    );
    let soft = depth(
        "forrestal",
        &rod(NOSES[3], 900.0, "[forrestal]\ncavity = \"compressible\""),
    );
    let band = plain.band.unwrap();
    let plain = plain.depth_of_penetration.unwrap();
    assert!(rough < plain && plain < soft, "{rough} {plain} {soft}");
    assert_near("low end of the band", band.low, plain * 1e3, 1e-9);
    assert_near("high end of the band", band.high, soft * 1e3, 1e-9);
}

#[test]
fn given_coefficients_are_used() {
    let given = rod(
        "\"hemisphere\"",
        900.0,
        "[forrestal]\na = 4.0\nyield_stress = \"300 MPa\"\nb = 1.0",
    );
    let rod = &given.projectile;
    let exact = rod.mass / (rod.area() * 2710.0)
        * (1.0 + 0.5 * 2710.0 * 900.0_f64.powi(2) / (4.0 * 300e6)).ln();
    assert_near("a, b", depth("forrestal", &given), exact, 1e-9);
}

#[test]
fn a_rigid_projectile_against_a_constant_pressure_is_poncelet_without_drag() {
    let case = scenario(
        r#"
        projectile = { material = "steel", length = "50 mm", diameter = "10 mm", impact_velocity = "200 m/s" }
        target = { constant_pressure = "500 MPa" }
        [materials.steel]
        name = "elastic"
        density = "8000 kg/m3"
        youngs_modulus = "200 GPa"
        poissons_ratio = 0.3
        strength.elastic = {}
        "#,
    );
    let exact = 8000.0 * 0.05 * 200.0_f64.powi(2) / (2.0 * 500e6);
    assert_near("ρLV²/(2R)", depth("poncelet", &case), exact, 1e-12);
}

#[test]
fn what_lies_outside_is_refused_or_warned_of() {
    let refusal = |model: &str, case: &Scenario| match run(model, case) {
        Err(Error::NotApplicable { refusal, .. }) => refusal.to_string(),
        other => panic!("{model}: {other:?}"),
    };
    let soft_rod = scenario(
        r#"
        projectile = { material = "copper", length = "50 mm", diameter = "5 mm", impact_velocity = "1500 m/s" }
        target = { material = "4340", thickness = "semi-infinite" }
        "#,
    );
    assert!(refusal("forrestal", &soft_rod).contains("it takes rigid projectiles"));
    assert!(refusal("taylor", &soft_rod).contains("it takes rigid walls"));
    let eroding = computed("crater_energy", &soft_rod);
    assert_eq!(eroding.outcome, Outcome::AtRest);
    assert!(eroding.warnings.iter().any(|text| text.contains("debris")));

    let mut plate = rod(NOSES[3], 900.0, "");
    if let percuss::scenario::TargetBody::Layers { layers, .. } = &mut plate.target {
        layers[0].thickness = Some(0.04);
    }
    for model in METAL_MODELS {
        assert!(
            refusal(model, &plate).contains("the rear face would affect it"),
            "{model}"
        );
    }
    let concrete = rod(NOSES[3], 277.0, "");
    assert!(refusal("forrestal_concrete", &concrete).contains("concrete"));
    let fast = rod(NOSES[0], 3000.0, "[forrestal]\ncavity = \"compressible\"");
    let fast = computed("forrestal", &fast);
    assert!(
        fast.warnings
            .iter()
            .any(|text| text.contains("no plastic shock"))
    );
    let shallow = computed("forrestal", &rod(NOSES[3], 60.0, ""));
    assert!(
        shallow
            .warnings
            .iter()
            .any(|text| text.contains("entry = \"gradual\""))
    );
}

#[test]
fn every_metal_of_the_library_has_a_resistance() {
    for entry in Library::built_in().iter() {
        let material = &entry.material;
        let (Some(pressure), Some(body)) = (
            cavity_expansion_pressure(material),
            CavityExpansion::of(material),
        ) else {
            continue;
        };
        let yield_stress = effective_yield_stress(material).unwrap();
        assert_eq!(body.yield_stress, yield_stress);
        let compressible = body.static_pressure();
        let fit = body.fit(800.0);
        println!(
            "{}: σs = {:.0} MPa, effective yield stress {:.0} MPa, compressible {:.0} MPa, B = {:.3} up to {:.0} m/s (worst {:.1} %)",
            entry.id,
            pressure * 1e-6,
            yield_stress * 1e-6,
            compressible * 1e-6,
            fit.inertia,
            fit.largest_speed,
            100.0 * fit.worst
        );
        assert!(
            compressible < 1.001 * pressure && compressible > 0.8 * pressure,
            "{}",
            entry.id
        );
        assert!(
            fit.inertia > 0.8 && fit.inertia < 1.5,
            "{} {fit:?}",
            entry.id
        );
    }
}

#[test]
fn the_empirical_factor_of_concrete_is_warned_of_far_from_its_test() {
    let warns = |strength: f64, options: &str| {
        let text = format!(
            r#"
            projectile = {{ material = "tool-steel-hrc53", mass = "0.9 kg", diameter = "26.9 mm", impact_velocity = "500 m/s", nose = {{ ogive = {{ crh = 2 }} }} }}
            target = {{ material = "concrete", thickness = "semi-infinite" }}
            {options}
            [materials.concrete]
            name = "concrete"
            density = "2370 kg/m3"
            youngs_modulus = "30 GPa"
            poissons_ratio = 0.2
            strength.concrete = {{ compressive_strength = "{strength} MPa" }}
            "#
        );
        let result = computed("forrestal_concrete", &scenario(&text));
        result
            .warnings
            .iter()
            .any(|w| w.contains("checked on concrete of 35.2 MPa"))
    };
    assert!(warns(5.0, "") && warns(150.0, ""));
    assert!(!warns(14.0, "") && !warns(100.0, ""));
    assert!(!warns(150.0, "forrestal_concrete = { s = 6.0 }"));
}

#[test]
fn indentation_is_that_of_a_flat_face() {
    let warns = |nose: &str, options: &str| {
        let text = format!(
            r#"
            projectile = {{ material = "tool-steel-hrc53", mass = "197 g", diameter = "20 mm", impact_velocity = "400 m/s", nose = {nose} }}
            target = {{ material = "weldox-460-e", thickness = "12 mm", back_face = "free" }}
            {options}
            "#
        );
        let result = computed("power_balance", &scenario(&text));
        result
            .warnings
            .iter()
            .any(|w| w.contains("`power_balance.indentation` has no effect"))
    };
    let without = "power_balance = { indentation = false }";
    assert!(warns("\"hemisphere\"", without));
    assert!(!warns("\"flat\"", without) && !warns("\"hemisphere\"", ""));
}
