use std::ops::ControlFlow;

use super::*;
use crate::{
    axisymmetric::Request,
    calibrate::{Noise, Observations, Settings, run},
    case::{Document, load_str},
    model::model,
};

const GO_ON: Observer<'static> = &|_, _, _| ControlFlow::Continue(());
const NO_SAMPLE: Settings = Settings {
    sampling: None,
    seed: 0,
};

fn rod(flow_stress: f64, speed: f64, experiments: &str) -> String {
    format!(
        "projectile = {{ material = 'rod', length = '20 mm', diameter = '8 mm', impact_velocity = '{speed} m/s' }}
        target = {{ rigid_wall = true }}
        materials.rod = {{ name = 'rod', density = '8000 kg/m3', youngs_modulus = '200 GPa', poissons_ratio = 0.3, strength.perfectly_plastic = {{ flow_stress = '{flow_stress} MPa' }} }}
        {experiments}"
    )
}

fn set_up(model_name: &str, fit: &str, measured: &[(f64, f64)]) -> Result<Problem, Error> {
    let mut observations = Observations::default();
    for (speed, length) in measured {
        let experiment = format!(
            "experiments = [{{ impact_velocity = '{speed} m/s', projectile_final_length = '{length:?} mm', source = 'test' }}]"
        );
        let text = rod(500.0, *speed, &experiment);
        observations.add_case(&Document::new("rod", text))?;
    }
    let fitted = Fitted::read(fit)?;
    Problem::new(
        model(model_name)?,
        fitted,
        observations,
        Noise::Relative(0.02),
    )
}

const FLOW_STRESS: &str = "materials.rod.strength.perfectly_plastic.flow_stress=100..1500 MPa";

/// Lengths that `axi` itself gives for 350 MPa have this flow stress as their best value, though the model alone has another.
#[test]
fn a_corrected_formula_finds_the_constant_that_axi_has() {
    let measured: Vec<(f64, f64)> = [120.0, 180.0]
        .map(|speed| {
            let scenario = load_str("rod", &rod(350.0, speed, "")).unwrap();
            let mut go_on = |_| ControlFlow::Continue(());
            let answer = Request::default().answer(&scenario, &mut go_on).unwrap();
            (speed, answer.projectile_final_length_mm.unwrap())
        })
        .to_vec();
    let alone = set_up("chain", FLOW_STRESS, &measured).unwrap();
    let best = |problem: &Problem| run(problem, &NO_SAMPLE, GO_ON).unwrap().parameters[0].best;
    let uncorrected = best(&alone);
    assert!((uncorrected / 350.0 - 1.0).abs() > 0.03, "{uncorrected}");
    let corrected = alone.corrected(Request::default(), 0, GO_ON).unwrap();
    let found = run(&corrected, &NO_SAMPLE, GO_ON).unwrap();
    let record = found.correction.unwrap();
    println!(
        "{uncorrected} MPa, corrected {} MPa, {record:?}",
        found.parameters[0].best
    );
    assert!(record.converged && record.difference < 0.05, "{record:?}");
    assert_eq!(record.answers, 2 * record.rounds);
    assert!(
        (found.parameters[0].best / 350.0 - 1.0).abs() < 0.015,
        "{found:?}"
    );
    for prediction in &found.predictions {
        let [value, uncertainty] = prediction.axisymmetric.unwrap();
        assert!(uncertainty > 0.0 && (value / prediction.measured - 1.0).abs() < 0.01);
    }
    assert_eq!(found.warnings, Vec::<String>::new());
}

/// What `axi` does not have cannot be corrected to it, and `axi` needs no correction.
#[test]
fn options_of_other_models_and_axi_itself_are_refused() {
    let measured = [(120.0, 18.0), (180.0, 16.0)];
    let option = "taylor.dynamic_yield_stress=100..900 MPa";
    let problem = set_up("taylor", option, &measured).unwrap();
    let error = problem.corrected(Request::default(), 0, GO_ON).err();
    let text = error.unwrap().to_string();
    assert!(
        text.contains("`taylor.dynamic_yield_stress` is no number of the model `axi`"),
        "{text}"
    );
    let record = CorrectionRecord {
        reference: ReferenceMeshes::Standard,
        rounds: 6,
        answers: 12,
        difference: 0.031,
        converged: false,
    };
    assert!(
        record
            .warning()
            .unwrap()
            .contains("differed by 3.1 % after 6 rounds")
    );
}

/// A caller ends it during the axisymmetric runs.
#[test]
fn a_correction_ends_when_the_caller_wants_so() {
    let problem = set_up("taylor", FLOW_STRESS, &[(120.0, 18.0), (180.0, 16.0)]).unwrap();
    let observer = |stage: Stage, part: f64, _| match stage == Stage::Correcting && part > 0.0 {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    };
    let ended = problem.corrected(Request::default(), 0, &observer).err();
    assert!(matches!(ended, Some(Error::Cancelled { .. })), "{ended:?}");
}
