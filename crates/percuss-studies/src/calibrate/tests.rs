use std::ops::ControlFlow;

use super::*;
use crate::{
    axisymmetric::{ReferenceMeshes, Request},
    case::{self, load_str},
    cost,
    experiments::{self, Experiment, Kind},
    material::{Library, MaterialTable},
    model::{self, Control, Estimate, model},
    validate,
};

/// A rod and a target that are nobody's.
const MATERIALS: &str = "
[rod]
name = 'rod'
density = '8000 kg/m3'
youngs_modulus = '200 GPa'
poissons_ratio = 0.3
strength.perfectly_plastic = { flow_stress = '350 MPa' }
[dart]
name = 'dart'
density = '8000 kg/m3'
youngs_modulus = '200 GPa'
poissons_ratio = 0.3
strength.perfectly_plastic = { flow_stress = '15 GPa' }
[block]
name = 'block'
density = '2700 kg/m3'
youngs_modulus = '70 GPa'
poissons_ratio = 0.33
strength.perfectly_plastic = { flow_stress = '300 MPa' }
";

const GO_ON: Observer<'static> = &|_, _, _| ControlFlow::Continue(());

fn library() -> Library {
    let mut library = Library::built_in().clone();
    let table: MaterialTable = toml::from_str(MATERIALS).unwrap();
    library.add(&table, "test");
    library
}

/// Tests with what a model gives for them as the measured value, times one more than `scatter`.
fn synthetic(kind: Kind, model_name: &str, options: &str, scatter: &[f64]) -> Vec<Experiment> {
    let (rod, target, thickness, nose) = match kind {
        Kind::Taylor => ("rod", "rigid-wall", "", "flat"),
        _ => ("dart", "block", "semi-infinite", "hemisphere"),
    };
    let header = "id,source,kind,projectile_material,nose,length_mm,diameter_mm,impact_velocity_m_s,target_material,thickness_mm,measured,unit";
    let mut rows = header.to_owned();
    for (i, scatter) in scatter.iter().enumerate() {
        let speed = 150.0 + 25.0 * i as f64;
        let target_text = match kind {
            Kind::Taylor => "rigid_wall = true",
            _ => "material = 'block', thickness = 'semi-infinite'",
        };
        let text = format!(
            "projectile = {{ material = '{rod}', length = '25 mm', diameter = '7 mm', nose = '{nose}', impact_velocity = '{speed} m/s' }}\n\
             target = {{ {target_text} }}\n{options}\n{}",
            MATERIALS.replace("\n[", "\n[materials.")
        );
        let scenario = load_str("synthetic", &text).unwrap();
        let result = model::run(
            model(model_name).unwrap(),
            &scenario,
            &mut Control::default(),
        );
        let value = kind.shown(result.unwrap().measurable(kind.quantity()).unwrap());
        let source = if i % 3 == 2 { "second" } else { "first" };
        rows += &format!(
            "\nS{i},{source},{},{rod},{nose},25,7,{speed},{target},{thickness},{:?},mm",
            kind.name(),
            value * (1.0 + scatter)
        );
    }
    experiments::read_str("synthetic.csv", &rows, &library()).unwrap()
}

fn problem(model_name: &str, tests: &[Experiment], fitted: &[&str], noise: Noise) -> Problem {
    let fitted: Vec<Fitted> = fitted
        .iter()
        .flat_map(|text| Fitted::read(text).unwrap())
        .collect();
    let mut observations = Observations::default();
    observations.add_tests(tests, &library(), &fitted).unwrap();
    Problem::new(model(model_name).unwrap(), fitted, observations, noise).unwrap()
}

const NO_SAMPLE: Settings = Settings {
    sampling: None,
    seed: 0,
};

const PONCELET: [&str; 2] = ["poncelet.resistance=0.2..5 GPa", "poncelet.drag=0.05..2"];

#[test]
fn the_yield_stress_of_taylor_tests_is_recovered() {
    let tests = synthetic(Kind::Taylor, "wilkins_guinan", "", &[0.0; 4]);
    let key = "materials.rod.strength.perfectly_plastic.flow_stress=50..2000 MPa";
    let problem = problem("wilkins_guinan", &tests, &[key], Noise::Relative(0.01));
    let found = run(&problem, &NO_SAMPLE, GO_ON).unwrap();
    let stress = found.parameters[0].best;
    assert!((stress / 350.0 - 1.0).abs() < 1e-6, "{stress}");
    assert!(
        found.findings.is_empty() && found.warnings.is_empty(),
        "{found:?}"
    );
    assert!(found.training.unwrap().rms < 1e-8);
}

#[test]
fn the_constants_of_poncelet_are_recovered() {
    let options = "poncelet = { resistance = '1.3 GPa', drag = 0.4 }";
    let tests = synthetic(Kind::Depth, "poncelet", options, &[0.0; 8]);
    let problem = problem("poncelet", &tests, &PONCELET, Noise::Relative(0.01));
    let found = run(&problem, &NO_SAMPLE, GO_ON).unwrap();
    for (parameter, exact) in found.parameters.iter().zip([1.3, 0.4]) {
        assert!((parameter.best / exact - 1.0).abs() < 1e-6, "{parameter:?}");
    }
}

/// With scatter of a known size the posterior covers the truth and is as wide as linear theory has it.
#[test]
fn intervals_cover_the_truth_and_the_hold_out() {
    // Normal scores of 12 values in a fixed order, times 2 %.
    let scores = [
        0.32, -1.73, 0.79, -0.32, 1.11, 0.0, -0.79, 0.53, -1.11, 1.73, -0.53, 0.15,
    ];
    let scatter = scores.map(|score| 0.02 * score);
    let options = "poncelet = { resistance = '1.3 GPa', drag = 0.4 }";
    let tests = synthetic(Kind::Depth, "poncelet", options, &scatter);
    let mut problem = problem("poncelet", &tests, &PONCELET, Noise::Relative(0.02));
    for observation in &mut problem.observations {
        observation.held_out = observation.sources[0] == "second";
    }
    let settings = Settings {
        sampling: Some(Sampling {
            ensembles: 2,
            walkers: 8,
            steps: 400,
            burn_in: 100,
        }),
        seed: 7,
    };
    let found = run(&problem, &settings, GO_ON).unwrap();
    for (parameter, exact) in found.parameters.iter().zip([1.3, 0.4]) {
        let marginal = parameter.posterior.unwrap();
        let [low, _, high] = marginal.quantiles;
        assert!((low..=high).contains(&exact), "{parameter:?}");
        let ratio = marginal.standard_deviation / parameter.standard_error.unwrap();
        assert!((0.75..1.35).contains(&ratio), "{ratio}");
        assert!(
            marginal.bulk_effective_size > 60.0 && marginal.r_hat < 1.1,
            "{marginal:?}"
        );
    }
    let quality = found.hold_out.unwrap();
    assert_eq!(quality.count, 4);
    assert!(quality.inside.unwrap() >= 3);
    assert_eq!(found.training.unwrap().count, 8);
}

#[test]
fn an_estimated_scatter_is_the_one_of_the_residuals() {
    let scatter = [0.03, -0.03, 0.03, -0.03, 0.03, -0.03, 0.03, -0.03];
    let tests = synthetic(Kind::Taylor, "wilkins_guinan", "", &scatter);
    let key = "materials.rod.strength.perfectly_plastic.flow_stress=50..2000 MPa";
    let problem = problem("wilkins_guinan", &tests, &[key], Noise::Estimated);
    let found = run(&problem, &NO_SAMPLE, GO_ON).unwrap();
    let errors = found.predictions.iter().map(|p| p.relative_error.unwrap());
    let exact = (errors.map(|e| e * e).sum::<f64>() / 7.0).sqrt();
    assert!((found.scatter.best / exact - 1.0).abs() < 1e-3);
    assert!((found.scatter.best - 0.03).abs() < 0.005);
}

/// The drag coefficient and the density of the target enter as their product only, where the resistance is given.
#[test]
fn parameters_that_enter_as_a_product_are_named() {
    let options = "poncelet = { resistance = '1.3 GPa', drag = 0.4 }";
    let tests = synthetic(Kind::Depth, "poncelet", options, &[0.0; 6]);
    let keys = [
        "poncelet.resistance=1..2 GPa",
        "poncelet.drag=0.2..0.8",
        "materials.block.density=2000..3500 kg/m3",
        "materials.block.poissons_ratio=0.2..0.4",
    ];
    let problem = problem("poncelet", &tests, &keys, Noise::Relative(0.01));
    let found = run(&problem, &NO_SAMPLE, GO_ON).unwrap();
    let named = |weakness| {
        let mut findings = found.findings.iter();
        let diagnostic = findings.find(|diagnostic| diagnostic.weakness == weakness);
        diagnostic
            .unwrap_or_else(|| panic!("{:?}", found.findings))
            .parameters
            .clone()
    };
    assert_eq!(
        named(Weakness::NoInfluence),
        ["materials.block.poissons_ratio"]
    );
    assert_eq!(
        named(Weakness::Combination),
        ["poncelet.drag", "materials.block.density"]
    );
    let errors: Vec<bool> = found
        .parameters
        .iter()
        .map(|parameter| parameter.standard_error.is_some())
        .collect();
    assert!(!errors[1] && !errors[2] && !errors[3], "{errors:?}");
    let product = found.parameters[1].best * found.parameters[2].best;
    assert!((product / (0.4 * 2700.0) - 1.0).abs() < 1e-4, "{product}");
}

#[test]
fn a_record_is_taken_back_and_is_no_blind_test_of_its_source() {
    let mut tests = synthetic(Kind::Taylor, "wilkins_guinan", "", &[0.0; 4]);
    let key = "materials.rod.strength.perfectly_plastic.flow_stress=50..2000 MPa";
    let mut problem = problem("wilkins_guinan", &tests, &[key], Noise::Relative(0.01));
    for observation in &mut problem.observations {
        observation.held_out = observation.sources[0] == "second";
    }
    let found = run(&problem, &NO_SAMPLE, GO_ON).unwrap();
    let [record] = records(&problem, &found, Some("new-rod"))
        .unwrap()
        .try_into()
        .unwrap();
    assert_eq!(record.id, "new-rod");
    assert_eq!(record.material.sources, ["first"]);

    let folder = std::env::temp_dir().join(format!("percuss-record-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join("material.toml");
    std::fs::write(&file, record.toml()).unwrap();
    let table = case::load_materials(&file).unwrap();
    std::fs::remove_dir_all(folder).unwrap();
    assert_eq!(table["new-rod"], record.material);

    let mut library = library();
    library.add(&table, "material.toml");
    for test in &mut tests {
        test.projectile_materials = vec!["new-rod".to_owned()];
    }
    let validation = validate::run(
        &[model("wilkins_guinan").unwrap()],
        &tests,
        &library,
        &|_| ControlFlow::Continue(()),
    )
    .unwrap();
    for (prediction, test) in validation.predictions.iter().zip(&tests) {
        assert!(prediction.relative_error.unwrap().abs() < 1e-5);
        let blind = test.source == "second";
        assert_eq!(
            prediction.split == experiments::Split::Blind,
            blind,
            "{}",
            test.id
        );
    }
}

#[test]
fn a_constant_of_a_metal_that_no_case_has_is_refused() {
    let tests = synthetic(Kind::Taylor, "wilkins_guinan", "", &[0.0; 4]);
    let mut observations = Observations::default();
    let own = Fitted::read("materials.rod.strength.perfectly_plastic.flow_stress=50..2000 MPa");
    observations
        .add_tests(&tests, &library(), &own.unwrap())
        .unwrap();
    let other = Fitted::read("materials.4340.density=7..9 g/cm3").unwrap();
    let model = model("wilkins_guinan").unwrap();
    let refused = Problem::new(model, other, observations, Noise::Estimated);
    let words = refused.err().unwrap().to_string();
    assert!(
        words.contains("`materials.4340.density` has no effect"),
        "{words}"
    );
}

/// A case that went through TOML is the case that it was.
#[test]
fn tests_become_the_same_scenarios_as_elsewhere() {
    let library = Library::built_in();
    let mut observations = Observations::default();
    observations
        .add_tests(experiments::built_in(), library, &[])
        .unwrap();
    assert!(observations.used.len() > 1000);
    for observation in observations.used.iter().step_by(7) {
        let mut tests = experiments::built_in().iter();
        let test = tests.find(|test| test.id == observation.id).unwrap();
        let exact = test
            .scenario(&test.projectile_materials[0], library)
            .unwrap();
        let found = observation.scenario(&[], &[]).unwrap();
        let close = |a: f64, b: f64| assert!((a - b).abs() <= 1e-14 * b.abs(), "{}", test.id);
        close(found.projectile.mass, exact.projectile.mass);
        close(found.projectile.length, exact.projectile.length);
        close(found.projectile.diameter, exact.projectile.diameter);
        close(found.impact_velocity, exact.impact_velocity);
        assert_eq!(found.projectile.material, exact.projectile.material);
    }
}

#[test]
fn constants_of_a_material_take_its_tests_alone() {
    let fitted =
        Fitted::read("materials.ofhc-copper-johnson-cook.strength.johnson_cook.a=20..300 MPa");
    let mut observations = Observations::default();
    observations
        .add_tests(
            experiments::built_in(),
            Library::built_in(),
            &fitted.unwrap(),
        )
        .unwrap();
    let sources = observations.sources();
    assert_eq!(
        sources,
        [
            "house1995",
            "johnson1983",
            "wilkins1973",
            "jones1987",
            "zelepugin2023"
        ]
    );
    assert!(
        observations
            .left_out
            .iter()
            .any(|left| left.id == "TAY-CU-JONES-01")
    );
    assert!(observations.used.iter().all(|o| !o.id.contains("GUST")));
    let error = observations.hold_out(&["nobody".to_owned()]).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("no measured value comes from `nobody`")
    );
    observations.hold_out(&["wilkins1973".to_owned()]).unwrap();
    assert_eq!(observations.used.iter().filter(|o| o.held_out).count(), 6);
}

/// What is said of a parameter, and the text that it points at.
fn refused(text: &str) -> (String, String) {
    let tests = synthetic(Kind::Depth, "poncelet", "", &[0.0; 2]);
    let error = Fitted::read(text)
        .and_then(|fitted| {
            let mut observations = Observations::default();
            observations.add_tests(&tests, &library(), &fitted)?;
            Problem::new(
                model("poncelet")?,
                fitted,
                observations,
                Noise::Relative(0.01),
            )
        })
        .err();
    match error {
        Some(Error::Input(error)) => (
            error.message.clone(),
            error.text[error.span.clone()].to_owned(),
        ),
        other => panic!("{text}: {other:?}"),
    }
}

#[test]
fn a_wrong_key_unit_or_range_is_placed() {
    for (text, words, place) in [
        ("poncelet.drag", "no `=`", "poncelet.drag"),
        ("poncelet.drag=1", "no range", "1"),
        ("poncelet.drag=2..1", "not above", "2..1"),
        ("poncelet.drag=a..1", "no number", "a..1"),
        ("poncelet.drug=0..1", "drug", "0..1"),
        ("poncelet.resistance=1..2 mm", "mm", "1..2 mm"),
        (
            "poncelet.resistance=1 GPa..2 MPa",
            "two units",
            "1 GPa..2 MPa",
        ),
        ("poncelet.drag=-1..1", "out of range", "-1..1"),
        (
            "materials.blok.density=1..2 g/cm3",
            "no material is named `blok`",
            "materials.blok.density",
        ),
        ("poncelet.drag=0.1..inf", "no number", "0.1..inf"),
    ] {
        let (message, at) = refused(text);
        assert!(message.contains(words), "{text}: {message}");
        assert_eq!(at, place, "{text}");
    }
}

/// The estimate is that of the runs which are made, within a factor of four.
#[test]
fn the_cost_is_known_before_it_starts() {
    let tests = synthetic(Kind::Depth, "poncelet", "", &[0.0; 6]);
    let problem = problem("poncelet", &tests, &PONCELET, Noise::Relative(0.01));
    let sampled = Settings {
        sampling: Some(Sampling {
            ensembles: 2,
            walkers: 8,
            steps: 60,
            burn_in: 20,
        }),
        seed: 0,
    };
    let alone = cost::of_runs(Estimate::LITTLE, 1.0).seconds;
    for settings in [NO_SAMPLE, sampled] {
        let expected = problem.estimate(&settings, None).seconds / alone;
        let before = problem.runs.load(std::sync::atomic::Ordering::Relaxed);
        let made = (run(&problem, &settings, GO_ON).unwrap().runs - before) as f64;
        let ratio = expected / made;
        assert!((0.25..4.0).contains(&ratio), "{expected} {made}");
    }
    // With a correction, the axisymmetric runs come on top.
    let request = Request::whole(ReferenceMeshes::Standard);
    let corrected = problem.estimate(&NO_SAMPLE, Some(request));
    assert!(corrected.steps > 1000.0 && corrected.memory > 0.0);
}

#[test]
fn it_ends_when_the_caller_wants_so() {
    let tests = synthetic(Kind::Depth, "poncelet", "", &[0.0; 6]);
    let problem = problem("poncelet", &tests, &PONCELET, Noise::Relative(0.01));
    let settings = Settings {
        sampling: Some(Sampling {
            ensembles: 2,
            walkers: 8,
            steps: 100_000,
            burn_in: 10,
        }),
        seed: 0,
    };
    let stop = |stage, part, _| match (stage, part) {
        (Stage::Sampling, 1e-5..) => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    };
    let ended = run(&problem, &settings, &stop);
    assert!(matches!(ended, Err(Error::Cancelled { .. })));
}
