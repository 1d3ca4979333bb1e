//! Studies of the server end with what the library says, to the last bit.

use std::sync::atomic::AtomicBool;

use percuss::{
    axisymmetric::Request,
    case::{self, Document},
    compare, limit,
    model::{self, model},
    sweep::BatchKernel,
    uncertainty::{self, Observer, Settings, Study},
};
use percuss_serve::Options;
use serde_json::{Value, json};

use crate::support::{PAPER, Served};

#[test]
fn studies_end_with_what_the_library_says() {
    let served = Served::new(Options::default());
    let answer = served.post(
        "/api/study/compare",
        &json!({ "name": "shot", "case": PAPER }),
    );
    let last = answer.lines().pop().unwrap();
    let scenario = case::load_str("shot", PAPER).unwrap();
    let mut watch = compare::Observer::default();
    let comparison =
        compare::compare(&model::fast_models(), None, &scenario, &[230.0], &mut watch).unwrap();
    let printed = serde_json::to_string(&comparison).unwrap();
    let expected: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(last["done"]["comparison"], expected);
    let csv = last["done"]["files"]["compare.csv"].as_str().unwrap();
    assert_eq!(csv.lines().count(), 1 + comparison.results.len());

    let coarse = PAPER.replace("= 40", "= 10").replace("= 80", "= 20");
    let answer = served.post(
        "/api/study/converge",
        &json!({ "case": coarse, "model": "chain" }),
    );
    let lines = answer.lines();
    let done = &lines[lines.len() - 1]["done"]["study"];
    assert_eq!(done["meshes"].as_array().unwrap().len(), 4);
    assert_eq!(done["meshes"][3]["projectile_elements"], 80);
    let parts: Vec<f64> = lines[..lines.len() - 1]
        .iter()
        .map(|line| line["progress"]["fraction"].as_f64().unwrap())
        .collect();
    assert!(parts.iter().all(|part| (0.0..=1.0).contains(part)));

    let answer = served.post("/api/study/nothing", &json!({ "case": PAPER }));
    assert_eq!(answer.status, 404);
}

#[test]
fn uncertainty_is_that_of_the_library() {
    let served = Served::new(Options::default());
    let text = include_str!("../../../../cases/paper-table1-uncertainty/scenario.toml");
    let text = text.replace("= 40", "= 10").replace("= 80", "= 20");
    let asked = json!({
        "name": "shot", "case": text, "model": "chain",
        "uncertainty": { "samples": 32, "seed": 7, "indices": true },
    });
    let lines = served.post("/api/study/uncertainty", &asked).lines();
    let done = &lines[lines.len() - 1]["done"];
    assert!(lines[0]["progress"]["words"].to_string().contains("runs"));

    let study = Study::of(&Document::new("shot", text)).unwrap();
    let chain = model("chain").unwrap();
    let settings = Settings {
        samples: 32,
        seed: 7,
        quantities: Vec::new(),
        indices: true,
        velocities: Vec::new(),
    };
    let watch = Observer {
        stop: &AtomicBool::new(false),
        progress: &|_, _| {},
    };
    let kernel = BatchKernel::new(chain);
    let found = uncertainty::analyse(&study, chain, &kernel, &settings, &watch).unwrap();
    let printed = serde_json::to_string(&found).unwrap();
    let expected: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(done["uncertainty"], expected);
    assert_eq!(done["caution"], found.caution());
    let files = done["files"].as_object().unwrap();
    let samples = files["samples.csv"].as_str().unwrap();
    assert_eq!(samples.lines().count(), 1 + 32);
    let names: Vec<&str> = done["charts"]
        .as_array()
        .unwrap()
        .iter()
        .filter_map(|chart| chart["name"].as_str())
        .collect();
    for chart in ["histogram", "tornado", "indices"] {
        assert!(
            names.contains(&format!("{chart}-depth-of-penetration").as_str()),
            "{names:?}"
        );
    }
}

#[test]
fn a_draft_has_the_charts_in_view_and_the_same_numbers() {
    let served = Served::new(Options::default());
    let whole = served.post("/api/answer", &json!({ "case": PAPER, "model": "chain" }));
    let seen = json!(["depth-time", "stress-xt"]);
    let draft = json!({ "case": PAPER, "model": "chain", "in_view": seen });
    let draft = served.post("/api/answer", &draft);
    assert!(draft.body.len() * 4 < whole.body.len());
    let (draft, whole) = (draft.json(), whole.json());
    assert_eq!(draft["results"], whole["results"]);
    assert_eq!(draft["rows"], whole["rows"]);
    let charts = draft["charts"].as_array().unwrap();
    let names: Vec<&Value> = charts.iter().map(|chart| &chart["name"]).collect();
    assert_eq!(json!(names), seen);
    let ends = |answer: &Value| {
        let x = answer["charts"][0]["series"][0]["x"].as_array().unwrap();
        (x[0].clone(), x[x.len() - 1].clone(), x.len())
    };
    let (first, last, points) = ends(&draft);
    let (whole_first, whole_last, _) = ends(&whole);
    assert!(points <= 401, "{points}");
    assert_eq!((first, last), (whole_first, whole_last));
}

#[test]
fn limits_are_those_of_the_library_and_say_what_they_rest_on() {
    let served = Served::new(Options::default());
    let text = "projectile = { material = 'tool-steel-hrc53', mass = '197 g', diameter = '20 mm', impact_velocity = '300 m/s' }\n\
                target = { material = 'aluminium-2024-t351', thickness = '12 mm' }\n\
                chain = { projectile_elements = 8, target_elements = 6 }\n\
                fdm = { projectile_elements = 8, target_elements = 6 }\n";
    let answer = served.post("/api/study/limit", &json!({ "name": "shot", "case": text }));
    let done = answer.lines().pop().unwrap()["done"].clone();
    let scenario = case::load_str("shot", text).unwrap();
    let search = limit::Search {
        axisymmetric: Some(Request::unasked()),
        ..limit::Search::default()
    };
    let found = limit::limits(
        &model::fast_models(),
        &scenario,
        &search,
        &mut limit::Observer::default(),
    );
    let printed = serde_json::to_string(&found.unwrap()).unwrap();
    let expected: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(done["limits"], expected);
    let face = done["rear_face"].as_str().unwrap();
    assert!(face.contains("taken as free"), "{face}");
    assert_eq!(done["limits"]["recommended"][0]["model"], "power_balance");
    let said = done["expected"].as_array().unwrap();
    let said: Vec<&str> = said.iter().filter_map(Value::as_str).collect();
    assert!(
        said.iter().any(|words| words.contains("published limits")),
        "{said:?}"
    );
}

#[test]
fn a_fixed_rear_face_is_freed_for_the_limit_and_the_answer_says_so() {
    let served = Served::new(Options::default());
    let case = |back: &str| {
        let text = format!(
            "projectile = {{ material = 'tool-steel-hrc53', mass = '197 g', diameter = '20 mm', impact_velocity = '300 m/s' }}\n\
             target = {{ material = 'aluminium-2024-t351', thickness = '12 mm', back_face = '{back}' }}\n\
             chain = {{ projectile_elements = 8, target_elements = 6 }}\n\
             fdm = {{ projectile_elements = 8, target_elements = 6 }}\n"
        );
        let answer = served.post("/api/study/limit", &json!({ "name": "shot", "case": text }));
        answer.lines().pop().unwrap()["done"].clone()
    };
    let (fixed, free) = (case("fixed"), case("free"));
    assert_eq!(
        (&fixed["freed"], &free["freed"]),
        (&json!(true), &json!(false))
    );
    assert_eq!(fixed["limits"]["results"], free["limits"]["results"]);
    let limits = fixed["limits"]["results"].as_array().unwrap();
    assert!(
        limits.iter().any(|limit| limit["outcome"] == "found"),
        "{limits:?}"
    );
}
