//! Targets that start hot.

use percuss::{
    Error, case,
    model::{self, Control},
    outcome::RunResult,
    scenario::Scenario,
};

/// Cells of `axi` are coarse: the comparisons are between runs of one mesh.
const COARSE: &str = "axi.cells_per_radius = 3\n";

fn scenario(target: &str, options: &str) -> Result<Scenario, Error> {
    let text = format!(
        "projectile = {{ material = 'etp-copper-johnson-cook', length = '20 mm', diameter = '6 mm', impact_velocity = '600 m/s' }}\n\
         target = {{ {target} }}\n{options}"
    );
    case::load_str("hot", &text)
}

fn run(model: &str, target: &str, options: &str) -> Result<RunResult, Error> {
    let scenario = scenario(target, options)?;
    model::run(model::model(model)?, &scenario, &mut Control::default())
}

fn depth(model: &str, target: &str, options: &str) -> f64 {
    let result = run(model, target, options).unwrap_or_else(|e| panic!("{model}, {target}: {e}"));
    result.depth_of_penetration.unwrap()
}

#[test]
fn a_hotter_target_has_a_deeper_crater() {
    const STEEL: &str = "material = '4340-johnson-cook', thickness = '40 mm'";
    for (model, options) in [
        ("chain", ""),
        ("chain", "chain.target_resistance = 'column'"),
        ("chain", "chain.target_resistance = 'diverging-penetrable'"),
        ("axi", COARSE),
    ] {
        let at = |temperature: &str| depth(model, &format!("{STEEL}{temperature}"), options);
        let room = at("");
        // The record's own room temperature, said aloud, changes nothing.
        assert_eq!(at(", temperature = '298 K'"), room, "{model} {options}");
        let (warm, hot) = (
            at(", temperature = '700 K'"),
            at(", temperature = '1100 K'"),
        );
        println!("{model} {options}: {room} {warm} {hot}");
        assert!(
            hot > 1.1 * warm && warm > 1.05 * room,
            "{model} {options}: {room} {warm} {hot}"
        );
    }
}

/// A metal whose thermal factor is one half at 800 K, with a part of the strength.
fn metal(part: f64) -> String {
    format!(
        "[materials.metal]\nname = 'metal'\ndensity = '7800 kg/m3'\nyoungs_modulus = '200 GPa'\npoissons_ratio = 0.3\n\
         specific_heat = '450 J/(kg K)'\nroom_temperature = '300 K'\nmelting_temperature = '1300 K'\n\
         strength.johnson_cook = {{ a = '{} MPa', b = '{} MPa', n = 0.3, c = 0.015, m = 1.0 }}\n\
         damage = {{ d1 = 0.1, d2 = 1.0, d3 = -1.0, d4 = 0.0, d5 = 0.0 }}\n",
        800.0 * part,
        512.0 * part
    )
}

#[test]
fn without_heating_a_hot_target_is_one_of_scaled_constants() {
    const THICK: &str = "material = 'metal', thickness = '30 mm'";
    const THIN: &str =
        "material = 'metal', thickness = '4 mm', plate_diameter = '60 mm', back_face = 'free'";
    for (model, target, options) in [
        ("chain", THICK, "chain.adiabatic_heating = false\n"),
        (
            "chain",
            THICK,
            "chain = { target_resistance = 'column', adiabatic_heating = false }\n",
        ),
        (
            "chain",
            THICK,
            "chain = { target_resistance = 'column', constraint_factor = 'cavity-expansion', adiabatic_heating = false }\n",
        ),
        (
            "chain",
            THICK,
            "chain = { target_resistance = 'diverging-penetrable', adiabatic_heating = false }\n",
        ),
        (
            "chain",
            THIN,
            "chain = { border_shear_law = 'shear-band', dishing = true, adiabatic_heating = false }\n",
        ),
        (
            "axi",
            THICK,
            "axi = { cells_per_radius = 3, adiabatic_heating = false }\n",
        ),
    ] {
        let numbers = |temperature: &str, part: f64| {
            let target = format!("{target}{temperature}");
            let result = run(model, &target, &format!("{options}{}", metal(part)));
            let result = result.unwrap_or_else(|e| panic!("{model} {options}: {e}"));
            let energy = &result.numerics().energy;
            [
                result.depth_of_penetration.unwrap_or(f64::NAN),
                result.residual_velocity.unwrap_or(f64::NAN),
                energy.plastic_target,
            ]
        };
        let [hot, scaled, cold] = [
            numbers(", temperature = '800 K'", 1.0),
            numbers("", 0.5),
            numbers("", 1.0),
        ];
        // Half is exact in binary numbers, so all bits are the same.
        let bits = |numbers: [f64; 3]| numbers.map(f64::to_bits);
        assert_eq!(
            bits(hot),
            bits(scaled),
            "{model} {options}: {hot:?} {scaled:?}"
        );
        let changed = (hot[2] / cold[2] - 1.0).abs();
        assert!(changed > 0.01, "{model} {options}: {changed}");
    }
}

#[test]
fn every_layer_has_its_own_temperature() {
    const LAYERS: &str = "temperature = '400 K', layers = [{ material = '4340-johnson-cook', thickness = '10 mm', temperature = '900 K' }, \
                          { material = '4340-johnson-cook', thickness = '30 mm' }]";
    let layered = scenario(LAYERS, "").unwrap();
    let starts: Vec<f64> = layered
        .layers()
        .iter()
        .map(|l| l.start_temperature())
        .collect();
    assert_eq!(starts, [900.0, 400.0]);
    let model = model::model("chain").unwrap();
    let result = model::run(model, &layered, &mut Control::recording()).unwrap();
    let first = &result.history.as_ref().unwrap().profiles[0];
    let of_target = first.elements.iter().filter(|e| e.initial_position > 0.0);
    for element in of_target {
        let expected = match element.initial_position < 0.01 {
            true => 900.0,
            false => 400.0,
        };
        assert_eq!(element.temperature, expected);
    }
}

#[test]
fn what_cannot_take_a_hot_target_refuses_it() {
    let refusal = |model: &str, target: &str| match run(model, target, COARSE) {
        Err(Error::NotApplicable { refusal, .. }) => refusal.to_string(),
        other => panic!("{other:?}"),
    };
    const STEEL: &str =
        "material = '4340-johnson-cook', thickness = '40 mm', temperature = '700 K'";
    for model in ["fdm", "tate"] {
        let reason = refusal(model, STEEL);
        assert!(
            reason.contains("a target at the temperature of its material's record, 298 K, and this one has 700 K"),
            "{model}: {reason}"
        );
    }
    let cold_law = "material = 'aluminium-2024-t351', thickness = '40 mm', temperature = '700 K'";
    for model in ["chain", "axi"] {
        let reason = refusal(model, cold_law);
        assert!(
            reason.contains("does not tell 700 K, the target's temperature"),
            "{reason}"
        );
    }
    for (target, key, what) in [
        (
            "material = '4340-johnson-cook', thickness = '40 mm', temperature = '1793 K'",
            "target.temperature",
            "melts at 1793 K",
        ),
        (
            "layers = [{ material = '4340-johnson-cook', thickness = '40 mm', temperature = '2000 K' }]",
            "target.layers.0.temperature",
            "melts at 1793 K",
        ),
        (
            "rigid_wall = true, temperature = '700 K'",
            "target.temperature",
            "no temperature",
        ),
        (
            "material = '4340-johnson-cook', thickness = '40 mm', temperature = '0.5 K'",
            "target.temperature",
            "out of range",
        ),
    ] {
        let error = scenario(target, "").unwrap_err().to_string();
        assert!(error.contains(key) && error.contains(what), "{error}");
    }
}

#[test]
fn the_estimate_of_the_model_error_is_of_cold_targets() {
    let estimate = |temperature: &str| {
        let target =
            format!("material = '4340-johnson-cook', thickness = 'semi-infinite'{temperature}");
        let scenario = scenario(&target, "").unwrap();
        let regime = percuss::regime::Regime::of(&scenario);
        let chain = model::model("chain").unwrap();
        percuss::model_error::estimate_error(chain, &scenario, &regime)
    };
    assert!(estimate("").is_some());
    assert!(estimate(", temperature = '700 K'").is_none());
}

#[test]
fn a_room_of_another_record_is_no_heat() {
    // Records are measured between 293 and 300 K.
    for (temperature, is_heated) in [
        ("20 celsius", false),
        ("25 celsius", false),
        ("40 celsius", true),
    ] {
        let text = format!(
            "projectile = {{ material = 'copper', length = '12 mm', diameter = '4 mm', impact_velocity = '200 m/s' }}\n\
             target = {{ material = 'etp-copper-johnson-cook', thickness = '25 mm', temperature = '{temperature}' }}"
        );
        let scenario = case::load_str("room", &text).unwrap();
        assert_eq!(scenario.is_heated(), is_heated, "{temperature}");
    }
}
