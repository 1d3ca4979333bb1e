//! Calibrations of the page are those of the library, which `percuss calibrate` prints.

use std::ops::ControlFlow;

use percuss::{
    calibrate::{Calibrated, Fitted, Noise, Observations, Problem, Sampling, Settings},
    case::Document,
    model::model,
};
use percuss_serve::Options;
use serde_json::{Value, json};

use crate::support::{PAPER, Served};

const TAYLOR: &str = include_str!("../../../../cases/taylor-copper-wilkins/scenario.toml");
/// The coefficient of the power law of copper.
const FIT: &str = "
[[parameter]]
key = 'materials.copper.strength.power_law.coefficient'
uniform = { from = '200 MPa', to = '900 MPa' }
";

fn asked(fit: &Value) -> Value {
    json!({ "name": "rod", "case": TAYLOR, "model": "wilkins_guinan", "fit": fit })
}

/// The last line of a calibration.
fn last(served: &Served, asked: &Value) -> Value {
    let lines = served.post("/api/study/calibrate", asked).lines();
    lines[lines.len() - 1].clone()
}

#[test]
fn a_calibration_is_that_of_the_library() {
    let served = Served::new(Options::default());
    for steps in [None, Some(8)] {
        let fit = json!({ "file": FIT, "noise": "2 %", "steps": steps, "seed": 3 });
        let lines = served.post("/api/study/calibrate", &asked(&fit)).lines();
        let done = &lines[lines.len() - 1]["done"];
        assert!(lines.iter().any(|line| {
            line["progress"]["words"]
                .to_string()
                .contains("least squares")
        }));

        let fitted = Fitted::read_with("fit.toml", |_| Ok(Document::new("fit.toml", FIT))).unwrap();
        let mut observations = Observations::default();
        observations
            .add_case(&Document::new("rod", TAYLOR))
            .unwrap();
        let noise: Noise = "2 %".parse().unwrap();
        let problem = Problem::new(
            model("wilkins_guinan").unwrap(),
            fitted,
            observations,
            noise,
        )
        .unwrap();
        let sampling = steps.map(|steps| Sampling::of(&problem, 4, None, steps).unwrap());
        let settings = Settings { sampling, seed: 3 };
        let found = Calibrated::of(&problem, &settings, None, &|_, _, _| {
            ControlFlow::Continue(())
        })
        .unwrap();
        let printed = serde_json::to_string(&found).unwrap();
        let expected: Value = serde_json::from_str(&printed).unwrap();
        assert_eq!(done["calibration"], expected);
        let file = done["files"]["calibration.json"].as_str().unwrap();
        assert_eq!(serde_json::from_str::<Value>(file).unwrap(), expected);
        assert_eq!(done["material"].as_str(), found.toml().as_deref());
        assert!(
            done["files"]["material.toml"]
                .to_string()
                .contains("copper-calibrated")
        );
        let csv = done["files"]["predictions.csv"].as_str().unwrap();
        assert_eq!(csv.lines().count(), 1 + 4);
        assert_eq!(done["charts"][0]["name"], "predictive");
        let pictures = done["pictures"].as_array().unwrap().len();
        assert_eq!(pictures, if steps.is_some() { 2 } else { 0 });
    }
}

/// What is wrong is said in the words of the library, and where.
#[test]
fn what_cannot_be_fitted_is_refused() {
    let served = Served::new(Options::default());
    let said = |fit: &Value| last(&served, &asked(fit))["problem"].clone();
    let message = |fit: &Value| said(fit)["message"].as_str().unwrap_or_default().to_owned();

    let problem = said(&json!({ "file": FIT.replace("900 MPa", "900 mm") }));
    assert_eq!(
        problem["message"],
        "this is in mm, another amount is in MPa"
    );
    assert_eq!(problem["place"]["line"], 4);
    let file = FIT.replace("coefficient", "coeficient");
    assert!(message(&json!({ "file": file })).contains("coeficient"));
    assert_eq!(
        message(&json!({ "file": "" })),
        "the file names nothing to fit"
    );
    assert_eq!(
        message(&json!({ "file": FIT, "noise": "much" })),
        "`much` is no scatter"
    );
    assert_eq!(
        message(&json!({ "file": FIT, "hold_out": ["nobody"] })),
        "no measured value comes from `nobody`"
    );
    assert_eq!(
        message(&json!({ "file": FIT, "hold_out": ["wilkins1973"] })),
        "there is no measured value to fit to"
    );
    assert_eq!(
        message(&json!({ "file": FIT, "steps": 1_000_000 })),
        "1000000 steps are out of range"
    );
    let nine: String = (0..9)
        .map(|i| FIT.replace("coefficient", &format!("c{i}")))
        .collect();
    assert_eq!(
        message(&json!({ "file": nine })),
        "there are 9 fitted numbers"
    );

    let unmeasured = json!({ "case": PAPER, "model": "chain", "fit": { "file": FIT } });
    assert_eq!(
        last(&served, &unmeasured)["problem"]["message"],
        "the case has no measured value"
    );
    let slow = json!({ "case": TAYLOR, "model": "axi", "fit": { "file": FIT } });
    let problem = last(&served, &slow)["problem"].to_string();
    assert!(
        problem.contains("takes too long for the many runs of a calibration"),
        "{problem}"
    );
}
