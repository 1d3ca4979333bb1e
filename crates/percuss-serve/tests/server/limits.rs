//! What a request may ask for, and for how long.

use std::{
    io::{Read, Write},
    net::TcpStream,
    time::{Duration, Instant},
};

use percuss_serve::{Options, RequestLimits};
use serde_json::{Value, json};

use crate::{
    body,
    support::{PAPER, Served, post_request},
};

/// Time after which a test gives up: far more than a busy machine takes, and far less than the runs that are cancelled.
const AT_MOST: Duration = Duration::from_secs(120);

/// The last line of a study that takes a while.
fn outcome(served: &Served, study: &str, body: &Value) -> Value {
    let answer = served.post(&format!("/api/study/{study}"), body);
    answer.lines().pop().unwrap()
}

fn few_elements() -> Served {
    Served::new(Options {
        bounds: RequestLimits {
            elements: 200,
            ..RequestLimits::default()
        },
        ..Options::default()
    })
}

#[test]
fn a_mesh_has_a_size() {
    let served = few_elements();
    let fine = PAPER.replace("target_elements = 80", "target_elements = 4000");
    let answer = served.post("/api/answer", &json!({ "case": fine, "model": "chain" }));
    assert_eq!(answer.status, 422);
    assert_eq!(answer.problem(), "the mesh has 4040 elements");
    let answer = served.post("/api/answer", &json!({ "case": fine, "model": "fdm" }));
    assert_eq!(answer.status, 422);
    let long = PAPER.replace("projectile_elements = 40", "projectile_elements = 4000");
    let answer = served.post("/api/answer", &json!({ "case": long, "model": "chain" }));
    assert_eq!(answer.json()["problem"]["key"], "chain.projectile_elements");
    // Three refinements of 40 and 80 elements are more than 200.
    let asked = json!({ "case": PAPER, "model": "chain" });
    let last = outcome(&served, "converge", &asked);
    assert_eq!(last["problem"]["message"], "the mesh has 960 elements");
    let layers = "{ material = \"copper\", thickness = \"1 mm\" },".repeat(500);
    let layered = format!(
        "projectile = {{ material = \"copper\", length = \"10 mm\", diameter = \"5 mm\", impact_velocity = \"300 m/s\" }}\ntarget.layers = [{layers}]"
    );
    let answer = served.post("/api/answer", &json!({ "case": layered, "model": "chain" }));
    assert_eq!(answer.status, 422);
}

#[test]
fn a_run_has_a_time() {
    let served = Served::new(Options {
        bounds: RequestLimits {
            seconds: 3,
            ..RequestLimits::default()
        },
        ..Options::default()
    });
    let fine = format!("{PAPER}\n[axi]\ncells_per_radius = 16\ncourant = 0.2\n");
    let axi = json!({ "case": fine, "model": "axi" });
    let answer = served.post("/api/answer", &axi);
    assert_eq!(answer.status, 422, "{}", answer.text());
    let message = &answer.json()["problem"]["message"];
    assert_eq!(message, "model `axi` takes too long for the page");
    let last = outcome(&served, "run", &axi);
    assert_eq!(
        last["problem"]["message"],
        "the run was stopped at the time limit of 3 s"
    );
    // Of an analysis no shot needs to come to its end.
    let fine = PAPER.replace("= 40", "= 500").replace("= 80", "= 1400");
    let uncertain = format!(
        "{fine}\n[[uncertainty.parameter]]\nkey = \"projectile.impact_velocity\"\nuniform = {{ from = \"200 m/s\", to = \"300 m/s\" }}\n"
    );
    let asked = json!({ "case": uncertain, "uncertainty": { "samples": 16_384 } });
    let last = outcome(&served, "uncertainty", &asked);
    assert_eq!(
        last["problem"]["message"],
        "the run was stopped at the time limit of 3 s"
    );
}

#[test]
fn a_comparison_has_speeds_that_are_possible() {
    let served = Served::new(Options::default());
    for speeds in [
        json!([0.0, 1e5, 10]),
        json!([0.0, 100.0, 1_000_000]),
        json!([-1.0, 100.0, 3]),
    ] {
        let asked = json!({ "case": PAPER, "speeds": speeds });
        let last = outcome(&served, "compare", &asked);
        assert!(last["problem"]["message"].is_string(), "{last}");
    }
}

#[test]
fn an_analysis_of_uncertainty_has_its_bounds() {
    let served = few_elements();
    for samples in [0, 1, 1_000_000] {
        let asked = json!({ "case": PAPER, "uncertainty": { "samples": samples } });
        let last = outcome(&served, "uncertainty", &asked);
        let said = format!("{samples} samples are out of range");
        assert_eq!(last["problem"]["message"], said);
    }
    // A number of elements can be uncertain: runs of too large a mesh are none.
    let elements = |values: &str| {
        let uncertain = format!(
            "{PAPER}\n[[uncertainty.parameter]]\nkey = \"chain.target_elements\"\nvalues = [{values}]\n"
        );
        let asked = json!({ "case": uncertain, "model": "chain", "uncertainty": { "samples": 16, "indices": false } });
        outcome(&served, "uncertainty", &asked)
    };
    let last = elements("9000, 9001");
    assert_eq!(last["problem"]["message"], "no run has a result");
    assert!(
        last["problem"]["help"]
            .to_string()
            .contains("the mesh has 90"),
        "{last}"
    );
    let last = elements("20, 9000");
    assert_eq!(last["done"]["uncertainty"]["failures"]["runs"], 8, "{last}");
    let last = outcome(&served, "uncertainty", &json!({ "case": PAPER }));
    let said = "the case has no uncertain parameters";
    assert_eq!(last["problem"]["message"], said);
}

/// Who goes away cancels: the only place is free long before the run would have ended.
fn is_free_without(waiting: TcpStream, served: &Served) {
    drop(waiting);
    let start = Instant::now();
    while served.post_bytes("/api/answer", &body(), "").status != 200 {
        assert!(start.elapsed() < AT_MOST);
    }
}

#[test]
fn runs_have_places_and_free_them_when_nobody_waits() {
    let served = Served::new(Options {
        bounds: RequestLimits {
            runs: 1,
            ..RequestLimits::default()
        },
        ..Options::default()
    });
    let fine = format!("{PAPER}\n[axi]\ncells_per_radius = 16\ncourant = 0.2\n");
    let long = json!({ "case": fine, "model": "axi" }).to_string();
    let request = post_request(served.address, "/api/study/run", long.as_bytes(), "");
    let mut waiting = served.connect();
    waiting.write_all(&request).unwrap();
    // What it says of its progress shows that the run has its place.
    let mut said = Vec::new();
    while !String::from_utf8_lossy(&said).contains("progress") {
        let mut some = [0; 512];
        let count = waiting.read(&mut some).unwrap();
        assert!(count > 0, "{}", String::from_utf8_lossy(&said));
        said.extend_from_slice(&some[..count]);
    }
    let busy = served.post_bytes("/api/answer", &body(), "");
    assert_eq!(busy.status, 503);
    assert_eq!(busy.problem(), "1 runs are in progress, which is the limit");
    is_free_without(waiting, &served);
}

#[test]
fn an_answer_that_nobody_waits_for_is_not_computed_to_its_end() {
    let served = Served::new(Options {
        bounds: RequestLimits {
            runs: 1,
            elements: 20_000,
            seconds: 600,
        },
        ..Options::default()
    });
    let fine = PAPER.replace("= 40", "= 4000").replace("= 80", "= 8000");
    let long = json!({ "case": fine, "model": "chain" }).to_string();
    let mut waiting = served.connect();
    waiting
        .write_all(&post_request(
            served.address,
            "/api/answer",
            long.as_bytes(),
            "",
        ))
        .unwrap();
    // It has its place when there is none left.
    let start = Instant::now();
    while served.post_bytes("/api/answer", &body(), "").status != 503 {
        assert!(start.elapsed() < AT_MOST);
    }
    is_free_without(waiting, &served);
}
