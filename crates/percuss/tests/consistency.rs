//! The same identities over every model, and over every material: what any answer to "how deep" has to satisfy.
//!
//! A model that fails one on purpose, or by its nature, stands in `KNOWN_FAILURES` with the reason, and has to fail there.

use percuss::{
    Error, Scenario, case,
    material::{Library, MaterialClass},
    model::{self, Control, Model},
    outcome::RunResult,
};

/// Runs of every kind that some model is made for. Strength laws without rate, heat or length scale, so that scaling is exact.
const RUNS: &[(&str, &str, &[f64])] = &[
    (
        "rigid steel sphere-nosed rod into aluminium",
        r#"projectile = { material = "tool", length = "70 mm", diameter = "7.1 mm", nose = "hemisphere", impact_velocity = "500 m/s" }
           target = { material = "light", thickness = "semi-infinite" }"#,
        &[100.0, 200.0, 400.0, 600.0, 800.0, 1000.0],
    ),
    (
        "rigid steel ogive into aluminium",
        r#"projectile = { material = "tool", length = "70 mm", diameter = "7.1 mm", nose.ogive.crh = 3.0, impact_velocity = "500 m/s" }
           target = { material = "light", thickness = "semi-infinite" }"#,
        &[100.0, 200.0, 400.0, 600.0, 800.0, 1000.0],
    ),
    (
        "rigid ogive into concrete",
        r#"projectile = { material = "tool", length = "240 mm", diameter = "26.9 mm", nose.ogive.crh = 2.0, impact_velocity = "277 m/s" }
           target = { material = "concrete", thickness = "semi-infinite" }"#,
        &[100.0, 200.0, 300.0, 500.0, 800.0],
    ),
    (
        "soft flat rod into a thick plate",
        r#"projectile = { material = "soft", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "230 m/s" }
           target = { material = "light", thickness = "60 mm" }"#,
        &[100.0, 200.0, 300.0, 400.0],
    ),
    (
        "long heavy rod into steel",
        r#"projectile = { material = "heavy", length = "100 mm", diameter = "10 mm", impact_velocity = "1500 m/s" }
           target = { material = "armour", thickness = "semi-infinite" }"#,
        &[1000.0, 1200.0, 1500.0, 1800.0],
    ),
    (
        "strong rod into a weaker target, from rigid to eroding",
        r#"projectile = { material = "strong", length = "100 mm", diameter = "10 mm", nose = "hemisphere", impact_velocity = "1500 m/s" }
           target = { material = "light", thickness = "semi-infinite" }"#,
        &[200.0, 500.0, 1000.0, 1600.0, 2000.0, 2500.0],
    ),
    (
        "soft rod on a rigid wall",
        r#"projectile = { material = "soft", length = "23.47 mm", diameter = "7.62 mm", impact_velocity = "183 m/s" }
           target = { rigid_wall = true }"#,
        &[50.0, 100.0, 150.0, 200.0, 250.0],
    ),
    (
        "blunt hard rod on a thin plate",
        r#"projectile = { material = "tool", mass = "197 g", diameter = "20 mm", impact_velocity = "250 m/s" }
           target = { material = "armour", thickness = "12 mm", back_face = "free" }
           
           "#,
        &[100.0, 200.0, 250.0, 300.0, 400.0, 600.0],
    ),
    (
        "hard ogive on an aluminium plate",
        r#"projectile = { material = "tool", mass = "5.3 g", diameter = "6.2 mm", nose.ogive.crh = 3.0, impact_velocity = "600 m/s" }
           target = { material = "light", thickness = "20 mm", back_face = "free" }
           
           "#,
        &[300.0, 450.0, 600.0, 700.0, 800.0],
    ),
];

/// Made-up materials: round numbers, constant flow stress, what models need beside.
const MATERIALS: &str = r#"
[materials.soft]
name = "soft copper-like metal"
density = "8900 kg/m3"
youngs_modulus = "120 GPa"
poissons_ratio = 0.34
equation_of_state = { sound_speed = "3940 m/s", slope = 1.5, gruneisen = 2.0 }
strength.perfectly_plastic = { flow_stress = "400 MPa" }

[materials.light]
name = "aluminium-like metal"
density = "2700 kg/m3"
youngs_modulus = "70 GPa"
poissons_ratio = 0.33
yield_stress = "300 MPa"
ultimate_strength = "350 MPa"
brinell_hardness = 100.0
equation_of_state = { sound_speed = "5300 m/s", slope = 1.35, gruneisen = 2.0 }
strength.perfectly_plastic = { flow_stress = "300 MPa" }

[materials.heavy]
name = "tungsten-alloy-like metal"
density = "17600 kg/m3"
youngs_modulus = "330 GPa"
poissons_ratio = 0.29
equation_of_state = { sound_speed = "4030 m/s", slope = 1.24, gruneisen = 1.67 }
strength.perfectly_plastic = { flow_stress = "1.2 GPa" }

[materials.armour]
name = "steel-like metal"
density = "7850 kg/m3"
youngs_modulus = "205 GPa"
poissons_ratio = 0.29
yield_stress = "800 MPa"
ultimate_strength = "900 MPa"
brinell_hardness = 270.0
equation_of_state = { sound_speed = "4570 m/s", slope = 1.49, gruneisen = 1.93 }
strength.perfectly_plastic = { flow_stress = "800 MPa" }

[materials.strong]
name = "strong steel"
density = "7850 kg/m3"
youngs_modulus = "205 GPa"
poissons_ratio = 0.29
equation_of_state = { sound_speed = "4570 m/s", slope = 1.49, gruneisen = 1.93 }
strength.perfectly_plastic = { flow_stress = "2.5 GPa" }

[materials.tool]
name = "very hard steel"
density = "8000 kg/m3"
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
equation_of_state = { sound_speed = "4570 m/s", slope = 1.49, gruneisen = 1.93 }
strength.perfectly_plastic = { flow_stress = "8 GPa" }

[materials.concrete]
name = "concrete"
density = "2370 kg/m3"
youngs_modulus = "30 GPa"
poissons_ratio = 0.2
strength.concrete = { compressive_strength = "35.2 MPa" }
"#;

/// Model, identity and reason of what is known to fail.
const KNOWN_FAILURES: &[(&str, Identity, &str)] = &[
    (
        "hydrodynamic",
        Identity::FasterGoesDeeper,
        "its depth is that of infinite speed: it does not depend on the speed",
    ),
    ("tate", Identity::FasterGoesDeeper, STRONGER_RODS),
    ("walker_anderson", Identity::FasterGoesDeeper, STRONGER_RODS),
    ("crater_energy", Identity::FasterGoesDeeper, STRONGER_RODS),
    ("energy_balance", Identity::FasterGoesDeeper, STRONGER_RODS),
    (
        "momentum_balance",
        Identity::FasterGoesDeeper,
        STRONGER_RODS,
    ),
];

const STRONGER_RODS: &str = "a rod that is stronger than its target goes deepest where it just stays rigid, and less deep once it \
                             erodes";

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Identity {
    FasterGoesDeeper,
    NothingMovesAtZeroSpeed,
    ScaledShotScales,
    DenserGoesDeeper,
}

fn shot(text: &str) -> Scenario {
    let text = format!("{text}\n{MATERIALS}");
    case::load_str("consistency", &text).unwrap_or_else(|error| panic!("{error}"))
}

/// The result of a model, or `None` where it does not apply; any other failure fails the test.
fn run(model: &dyn Model, scenario: &Scenario) -> Option<RunResult> {
    match model::run(model, scenario, &mut Control::default()) {
        Ok(result) => {
            assert_finite(&result);
            Some(result)
        }
        Err(Error::NotApplicable { refusal, .. }) => {
            assert!(!refusal.reason.is_empty(), "{}", model.name());
            None
        }
        Err(error) => panic!(
            "{} at {} m/s: {error}",
            model.name(),
            scenario.impact_velocity
        ),
    }
}

fn numbers(result: &RunResult) -> Vec<(&'static str, f64)> {
    [
        ("depth_of_penetration", result.depth_of_penetration),
        ("largest_depth", result.largest_depth),
        ("permanent_depth", result.permanent_depth),
        ("residual_velocity", result.residual_velocity),
        ("ballistic_limit", result.ballistic_limit),
        ("projectile_final_length", result.projectile_final_length),
        (
            "projectile_final_diameter",
            result.projectile_final_diameter,
        ),
        ("projectile_final_mass", result.projectile_final_mass),
        ("time_to_rest", result.time_to_rest),
        ("peak_force", result.peak_force),
        ("contact_time", result.contact_time),
        ("end_time", result.end_time),
        (
            "low end of the band",
            result.band.as_ref().map(|band| band.low),
        ),
        (
            "high end of the band",
            result.band.as_ref().map(|band| band.high),
        ),
    ]
    .into_iter()
    .filter_map(|(name, value)| Some((name, value?)))
    .chain(
        result
            .details
            .iter()
            .map(|detail| (detail.name, detail.value)),
    )
    .collect()
}

pub fn assert_finite(result: &RunResult) {
    for (name, value) in numbers(result) {
        assert!(value.is_finite(), "{}: {name} is {value}", result.model);
    }
    if let Some(band) = &result.band {
        assert!(band.low <= band.high, "{}: {band:?}", result.model);
    }
}

/// Holds every model to an identity on every shot that it applies to, and known failures to failing.
fn hold(identity: Identity, check: impl Fn(&dyn Model, &str, &[f64]) -> Result<usize, String>) {
    for model in model::fast_models() {
        let known = KNOWN_FAILURES
            .iter()
            .find(|known| known.0 == model.name() && known.1 == identity);
        let mut failures = Vec::new();
        for (what, text, speeds) in RUNS {
            match check(model, text, speeds) {
                Ok(compared) => println!("{}: {what}: {compared} compared", model.name()),
                Err(failure) => failures.push(format!("{}: {what}: {failure}", model.name())),
            }
        }
        match known {
            None => assert!(failures.is_empty(), "{identity:?}\n{}", failures.join("\n")),
            Some((_, _, reason)) => assert!(
                !failures.is_empty(),
                "{} no longer fails {identity:?} ({reason}): take it off the list",
                model.name()
            ),
        }
    }
}

/// Depth and residual velocity grow, and on a wall the final length falls; equal only where nothing penetrates.
fn more(what: &str, slow: &RunResult, fast: &RunResult) -> Result<usize, String> {
    let signed = [
        (
            slow.depth_of_penetration,
            fast.depth_of_penetration,
            1.0,
            "depth",
        ),
        (
            slow.residual_velocity,
            fast.residual_velocity,
            1.0,
            "residual velocity",
        ),
        (
            slow.projectile_final_length,
            fast.projectile_final_length,
            -1.0,
            "final length",
        ),
    ];
    let perforates =
        slow.ballistic_limit.is_some() || fast.outcome == percuss::outcome::Outcome::Perforated;
    let depth = slow.depth_of_penetration.is_some() || fast.depth_of_penetration.is_some();
    let mut compared = 0;
    for (slow, fast, sign, name) in signed {
        let (Some(slow), Some(fast)) = (slow, fast) else {
            continue;
        };
        // A projectile that stops or bounces has no residual velocity to order; one that perforates, no depth; what is left
        // of one that penetrates depends on how long it took.
        if (name == "final length" && depth)
            || (name == "residual velocity" && (!perforates || fast <= 0.0))
            || (name == "depth" && perforates)
        {
            continue;
        }
        compared += 1;
        if sign * (fast - slow) < -1e-9 * slow.abs() {
            return Err(format!("{what}: {name} goes from {slow:e} to {fast:e}"));
        }
    }
    Ok(compared)
}

#[test]
fn faster_goes_deeper() {
    hold(Identity::FasterGoesDeeper, |model, text, speeds| {
        let base = shot(text);
        let results: Vec<(f64, RunResult)> = speeds
            .iter()
            .filter_map(|&speed| Some((speed, run(model, &base.at_impact_velocity(speed))?)))
            .collect();
        let mut compared = 0;
        for pair in results.windows(2) {
            let what = format!("{} to {} m/s", pair[0].0, pair[1].0);
            compared += more(&what, &pair[0].1, &pair[1].1)?;
        }
        if let [(_, first), .., (_, last)] = results.as_slice() {
            let grows =
                |slow: Option<f64>, fast: Option<f64>| slow.zip(fast).is_some_and(|(s, f)| f > s);
            let shrinks = grows(last.projectile_final_length, first.projectile_final_length);
            if !grows(first.depth_of_penetration, last.depth_of_penetration)
                && !grows(first.residual_velocity, last.residual_velocity)
                && !shrinks
            {
                return Err("nothing changes from the slowest to the fastest".to_owned());
            }
        }
        Ok(compared)
    });
}

#[test]
fn nothing_moves_at_zero_speed() {
    hold(Identity::NothingMovesAtZeroSpeed, |model, text, _| {
        let Some(result) = run(model, &shot(text).at_impact_velocity(0.0)) else {
            return Ok(0);
        };
        let scenario = shot(text);
        let zero = [
            ("depth", result.depth_of_penetration),
            ("residual velocity", result.residual_velocity),
            (
                "shortening",
                result
                    .projectile_final_length
                    .map(|length| length / scenario.projectile.length - 1.0),
            ),
        ];
        for (name, value) in zero {
            if value.is_some_and(|value| value.abs() > 1e-12) {
                return Err(format!("{name} is {value:?}"));
            }
        }
        Ok(1)
    });
}

/// The same shot in another size: lengths times `k`, the speed unchanged.
fn scaled(scenario: &Scenario, k: f64) -> Scenario {
    use percuss::scenario::TargetBody;
    let mut other = scenario.clone();
    other.projectile.length *= k;
    other.projectile.diameter *= k;
    other.projectile.mass *= k * k * k;
    if let TargetBody::Layers {
        layers,
        column_diameter,
        ..
    } = &mut other.target
    {
        *column_diameter *= k;
        for layer in layers {
            layer.thickness = layer.thickness.map(|thickness| k * thickness);
        }
    }
    other
}

#[test]
fn a_shot_twice_as_large_goes_twice_as_deep() {
    hold(Identity::ScaledShotScales, |model, text, speeds| {
        let mut compared = 0;
        for &speed in speeds {
            let base = shot(text).at_impact_velocity(speed);
            let (Some(one), Some(other)) = (run(model, &base), run(model, &scaled(&base, 2.0)))
            else {
                continue;
            };
            let pairs = [
                (
                    "depth",
                    one.depth_of_penetration,
                    other.depth_of_penetration,
                    2.0,
                ),
                (
                    "residual velocity",
                    one.residual_velocity,
                    other.residual_velocity,
                    1.0,
                ),
                (
                    "ballistic limit",
                    one.ballistic_limit,
                    other.ballistic_limit,
                    1.0,
                ),
                (
                    "final length",
                    one.projectile_final_length,
                    other.projectile_final_length,
                    2.0,
                ),
                ("peak force", one.peak_force, other.peak_force, 4.0),
                ("time to rest", one.time_to_rest, other.time_to_rest, 2.0),
                ("contact time", one.contact_time, other.contact_time, 2.0),
            ];
            for (name, one, other, factor) in pairs {
                if one.is_some() != other.is_some() {
                    return Err(format!("{name} at {speed} m/s: {one:?} and {other:?}"));
                }
                let (Some(one), Some(other)) = (one, other) else {
                    continue;
                };
                compared += 1;
                let scale = (factor * one).abs().max(match name {
                    "residual velocity" => speed,
                    _ => 0.0,
                });
                if (other - factor * one).abs() > 1e-6 * scale {
                    return Err(format!(
                        "{name} at {speed} m/s: {one:e} becomes {other:e}, not {factor} times as much"
                    ));
                }
            }
        }
        Ok(compared)
    });
}

#[test]
fn a_denser_projectile_goes_deeper() {
    hold(Identity::DenserGoesDeeper, |model, text, speeds| {
        let mut compared = 0;
        for &speed in speeds {
            let base = shot(text).at_impact_velocity(speed);
            let mut material = (*base.projectile.material).clone();
            material.density = percuss::units::Density::new(1.04 * material.density.si());
            let mut denser = base.clone();
            denser.projectile.material = material.into();
            denser.projectile.mass *= 1.04;
            let (Some(light), Some(heavy)) = (run(model, &base), run(model, &denser)) else {
                continue;
            };
            let what = format!("4 % denser at {speed} m/s");
            compared += more(&what, &light, &heavy)?;
        }
        Ok(compared)
    });
}

#[test]
fn every_model_applies_to_some_shot_and_says_why_not_to_the_others() {
    for model in model::fast_models() {
        let applies = RUNS.iter().any(|(_, text, speeds)| {
            let base = shot(text);
            speeds
                .iter()
                .any(|&speed| run(model, &base.at_impact_velocity(speed)).is_some())
        });
        assert!(
            applies,
            "no shot of this suite is one for model `{}`: add one",
            model.name()
        );
    }
}

/// Whether a model without erosion crushes a rod of this material: soft and weak, it is not pushed back before a cell is gone.
fn is_crushed(model: &dyn Model, id: &str, scenario: &Scenario) -> bool {
    (model.name(), id) == ("fdm", "polycarbonate-vaango") && scenario.impact_velocity > 1000.0
}

/// Every metal and polymer of the library, as a projectile and as a target: a finite answer or a reason, and no depth at rest.
#[test]
fn every_material_works_in_every_model() {
    let mut answered = 0;
    for entry in Library::built_in().iter() {
        if entry.material.class() == MaterialClass::Concrete {
            continue;
        }
        let id = &entry.id;
        let cases = [
            format!(
                r#"projectile = {{ material = "{id}", length = "30 mm", diameter = "6 mm", impact_velocity = "200 m/s" }}
                   target = {{ rigid_wall = true }}"#
            ),
            format!(
                r#"projectile = {{ material = "{id}", length = "60 mm", diameter = "6 mm", impact_velocity = "1200 m/s" }}
                   target = {{ material = "6061-t6", thickness = "semi-infinite" }}"#
            ),
            format!(
                r#"projectile = {{ material = "tool", length = "60 mm", diameter = "6 mm", nose = "hemisphere", impact_velocity = "300 m/s" }}
                   target = {{ material = "{id}", thickness = "semi-infinite" }}"#
            ),
            format!(
                r#"projectile = {{ material = "tool", length = "30 mm", diameter = "10 mm", impact_velocity = "300 m/s" }}
                   target = {{ material = "{id}", thickness = "6 mm", back_face = "free" }}"#
            ),
        ];
        for text in cases {
            let scenario = shot(&text);
            for model in model::fast_models() {
                if is_crushed(model, id, &scenario) {
                    let error = model::run(model, &scenario, &mut Control::default());
                    let said = error.unwrap_err().to_string();
                    assert!(said.contains("has no erosion: use the model"), "{said}");
                    continue;
                }
                let Some(result) = run(model, &scenario) else {
                    continue;
                };
                answered += 1;
                let rest = run(model, &scenario.at_impact_velocity(0.0));
                let depth = rest.and_then(|rest| rest.depth_of_penetration);
                assert!(
                    depth.unwrap_or(0.0).abs() <= 1e-12,
                    "{}: {id}: {depth:?} at rest",
                    result.model
                );
            }
        }
    }
    assert!(answered > 50, "{answered}");
}
