//! Properties of every model of long eroding rods, through the case file.

use crate::common::scenario;
use percuss::{
    analytic::{Hydrodynamic, LanzOdermatt, Tate, WalkerAnderson},
    chain::Chain,
    model::{self, Control, Model},
    outcome::RunResult,
};

const MODELS: [&dyn Model; 4] = [&Tate, &WalkerAnderson, &LanzOdermatt, &Hydrodynamic];

/// A tungsten alloy rod on armour steel; sizes times `scale`.
fn case(density: f64, scale: f64, velocity: f64) -> String {
    format!(
        r#"
        projectile = {{ material = "rod", length = "{} mm", diameter = "{} mm", impact_velocity = "{velocity} m/s" }}
        target = {{ material = "armour", thickness = "semi-infinite" }}
        lanz_odermatt.target_hardness = 260
        [materials.rod]
        name = "rod"
        density = "{density} kg/m3"
        youngs_modulus = "340 GPa"
        poissons_ratio = 0.28
        equation_of_state = {{ sound_speed = "4030 m/s", slope = 1.24, gruneisen = 1.6 }}
        strength.perfectly_plastic = {{ flow_stress = "1500 MPa" }}
        [materials.armour]
        name = "armour"
        density = "7850 kg/m3"
        youngs_modulus = "205 GPa"
        poissons_ratio = 0.29
        strength.perfectly_plastic = {{ flow_stress = "1000 MPa" }}
        "#,
        100.0 * scale,
        5.0 * scale
    )
}

fn run(model: &dyn Model, density: f64, scale: f64, velocity: f64) -> RunResult {
    model
        .run(
            &scenario(&case(density, scale, velocity)),
            &mut Control::default(),
        )
        .unwrap()
}

fn depth(model: &dyn Model, density: f64, scale: f64, velocity: f64) -> f64 {
    let depth = run(model, density, scale, velocity)
        .depth_of_penetration
        .unwrap();
    assert!(depth.is_finite(), "{} at {velocity} m/s", model.name());
    depth
}

#[test]
fn zero_speed_gives_zero_depth_and_depth_grows_with_speed() {
    for model in MODELS {
        assert_eq!(depth(model, 17600.0, 1.0, 0.0), 0.0, "{}", model.name());
        let mut before = 0.0;
        for velocity in (1..=60).map(|i| 50.0 * f64::from(i)) {
            let depth = depth(model, 17600.0, 1.0, velocity);
            assert!(
                depth >= before,
                "{} at {velocity} m/s: {depth} {before}",
                model.name()
            );
            before = depth;
        }
        assert!(before > 0.05);
    }
}

#[test]
fn depth_scales_with_size_and_a_denser_rod_goes_deeper() {
    for model in MODELS {
        for velocity in [1200.0, 1500.0, 2500.0] {
            let one = depth(model, 17600.0, 1.0, velocity);
            let ratio = depth(model, 17600.0, 2.0, velocity) / one;
            assert!((ratio - 2.0).abs() < 1e-6, "{} {ratio}", model.name());
            assert!(
                depth(model, 18400.0, 1.0, velocity) > one,
                "{}",
                model.name()
            );
        }
    }
}

#[test]
fn all_of_them_apply_to_a_tungsten_rod_on_steel_and_agree_roughly() {
    let scenario = scenario(&case(17600.0, 1.0, 1500.0));
    let mut depths = Vec::new();
    for model in MODELS {
        let result = model::run(model, &scenario, &mut Control::default()).unwrap();
        let depth = result.depth_of_penetration.unwrap() * 1e3;
        println!("{}: {depth:.1} mm", model.name());
        for detail in &result.details {
            println!("    {}: {:.4} {}", detail.name, detail.value, detail.unit);
            assert!(detail.value.is_finite());
        }
        if let Some(band) = &result.band {
            println!("    band {:.1} to {:.1} mm", band.low, band.high);
            assert!(band.low <= depth && depth <= band.high);
        }
        depths.push(depth);
    }
    let [tate, walker, regression, limit] = depths[..] else {
        unreachable!()
    };
    for depth in [tate, walker, regression] {
        assert!(depth < limit);
    }
    // A regression to runs, which knows nothing of these strengths: the two models are not tuned to it.
    assert!((tate / regression - 1.0).abs() < 0.4 && (walker / regression - 1.0).abs() < 0.4);
}

#[test]
fn a_target_without_an_equation_of_state_is_warned_of() {
    let result = run(&WalkerAnderson, 17600.0, 1.0, 1500.0);
    let about = |word: &str| result.warnings.iter().any(|warning| warning.contains(word));
    assert!(about("the target's material has no `equation_of_state`"));
    assert!(!about(
        "the projectile's material has no `equation_of_state`"
    ));
}

#[test]
fn deep_in_a_plate_and_outside_the_regime_there_is_no_number() {
    let thin = case(17600.0, 1.0, 1500.0).replace("\"semi-infinite\"", "\"60 mm\"");
    let slow = case(17600.0, 1.0, 300.0);
    for model in MODELS {
        for text in [&thin, &slow] {
            let refused = model::run(model, &scenario(text), &mut Control::default());
            assert!(
                matches!(refused, Err(percuss::Error::NotApplicable { .. })),
                "{}",
                model.name()
            );
        }
    }
}

/// A run of the chain on a rod of tungsten alloy, with options of its own.
fn by_chain(diameters: u32, options: &str) -> (RunResult, percuss::Scenario) {
    let text = format!(
        "projectile = {{ material = 'tungsten-alloy', length = '{} mm', diameter = '5 mm', impact_velocity = '2000 m/s' }}\n\
         target = {{ material = '4340', thickness = 'semi-infinite' }}\nchain = {{ {options} }}",
        5 * diameters
    );
    let scenario = scenario(&text);
    let result = Chain.run(&scenario, &mut Control::default()).unwrap();
    (result, scenario)
}

#[test]
fn a_rod_of_the_chain_has_short_elements_however_long_it_is() {
    let part = |(result, scenario): &(RunResult, percuss::Scenario)| {
        result.depth_of_penetration.unwrap() / scenario.projectile.length
    };
    let warns = |(result, _): &(RunResult, percuss::Scenario)| {
        let words = "which makes the depth too small: raise `chain.projectile_elements` to 160";
        result
            .warnings
            .iter()
            .any(|warning| warning.contains(words))
    };
    let short = by_chain(20, "");
    let long = by_chain(80, "");
    assert_eq!(short.0.numerics().elements.0, 40);
    assert_eq!(long.0.numerics().elements.0, 160);
    // In steady flow the depth is a part of the length; entry and the last diameters are a smaller part of the longer rod.
    assert!(
        (part(&long) / part(&short) - 1.0).abs() < 0.05,
        "{} {}",
        part(&short),
        part(&long)
    );
    // Elements of two diameters make it shallower.
    let coarse = by_chain(80, "projectile_elements = 40");
    assert!(
        part(&coarse) < 0.9 * part(&long),
        "{} {}",
        part(&coarse),
        part(&long)
    );
    assert!(warns(&coarse) && !warns(&long) && !warns(&short));
}

#[test]
fn a_run_without_erosion_that_takes_too_long_is_left_out_of_the_band() {
    let basis = |diameters| {
        let (mut result, scenario) = by_chain(diameters, "");
        let explained = Chain.explain(&scenario, &mut result, &mut Control::default());
        explained.unwrap();
        result.band.unwrap().basis
    };
    assert!(basis(10).starts_with("erosion strain from 1 to never"));
    assert!(basis(40).starts_with("erosion strain from 1 to the default"));
}
