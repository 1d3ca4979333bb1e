//! The axisymmetric answer that refines itself: its numbers and frames are those of the library, and it goes when nobody waits.

use std::{
    collections::BTreeMap,
    io::{Read, Write},
    net::TcpStream,
    ops::ControlFlow,
    time::{Duration, Instant},
};

use percuss::{
    Scenario,
    axisymmetric::{self, ReferenceMeshes},
    case,
    frames::Frame,
    model::{self, Control},
};
use percuss_serve::{Options, RequestLimits};
use serde_json::{Value, json};

use crate::{
    body,
    support::{PAPER, Served, post_request},
};

/// Time after which a test gives up: far more than a busy machine takes.
const AT_MOST: Duration = Duration::from_secs(120);
/// A slow run of many steps: a long rod at a small Courant number.
const SLOW: &str = "projectile = { material = 'copper', length = '80 mm', diameter = '5 mm', impact_velocity = '900 m/s' }\n\
                    target = { material = 'aluminium-2024-t351', thickness = 'semi-infinite' }\n\
                    axi = { courant = 0.1 }\n";

/// A message: head and body.
type Message = (Value, Vec<u8>);

/// Takes complete messages from the start of bytes.
fn take_messages(bytes: &mut Vec<u8>) -> Vec<Message> {
    let mut messages = Vec::new();
    loop {
        let length = |at: usize| -> Option<usize> {
            let four = bytes.get(at..at + 4)?.try_into().unwrap();
            Some(u32::from_le_bytes(four) as usize)
        };
        let Some((head, body)) = length(0).zip(length(4)) else {
            return messages;
        };
        let end = 8 + head + body;
        if bytes.len() < end {
            return messages;
        }
        let value = serde_json::from_slice(&bytes[8..8 + head]).unwrap();
        messages.push((value, bytes[8 + head..end].to_vec()));
        bytes.drain(..end);
    }
}

fn refined(served: &Served, asked: &Value) -> Vec<Message> {
    let mut bytes = served.post("/api/refinement", asked).body;
    let messages = take_messages(&mut bytes);
    assert!(bytes.is_empty(), "{} bytes are left", bytes.len());
    messages
}

fn heads(messages: &[Message], kind: &str) -> Vec<Value> {
    let of_kind = messages.iter().filter_map(|(head, _)| head.get(kind));
    of_kind.cloned().collect()
}

fn one_place() -> Served {
    Served::new(Options {
        bounds: RequestLimits {
            runs: 1,
            ..RequestLimits::default()
        },
        ..Options::default()
    })
}

#[test]
fn the_answer_is_that_of_the_library_and_its_error_shrinks() {
    let served = Served::new(Options::default());
    let messages = refined(&served, &json!({ "name": "shot", "case": PAPER }));
    assert_eq!(heads(&messages, "plan")[0]["cells"], json!([3, 4, 6, 8]));
    assert_eq!(messages.last().unwrap().0, json!({ "done": true }));
    let answers = heads(&messages, "answer");
    assert_eq!(answers.len(), 4);
    let scenario = case::load_str("shot", PAPER).unwrap();
    let plan = axisymmetric::plan(&scenario, ReferenceMeshes::Standard, None).unwrap();
    let mut go_on = |_| ControlFlow::Continue(());
    let standard = axisymmetric::answer(&scenario, &plan, &mut go_on).unwrap();
    let third = &answers[2];
    let on_meshes: Vec<_> = standard
        .meshes
        .iter()
        .map(|mesh| (mesh.cells_per_radius, mesh.depth_of_penetration_mm))
        .collect();
    let headline = percuss_report::axisymmetric_rows::headline(&standard).unwrap();
    for (key, expected) in [
        ("value", json!(standard.value)),
        ("uncertainty", json!(standard.uncertainty)),
        ("meshes", json!(on_meshes)),
        ("headline", json!(headline)),
    ] {
        // As a reader of JSON has its numbers.
        let expected: Value = serde_json::from_str(&expected.to_string()).unwrap();
        assert_eq!(third[key], expected, "{key}");
    }
    // With one mesh there is no limit yet; with more of them its error is smaller.
    assert_eq!(
        (&answers[0]["value"], &answers[0]["reason"]),
        (&json!(null), &json!(""))
    );
    let error = |answer: &Value| answer["uncertainty"].as_f64().unwrap();
    assert!(error(&answers[3]) < error(&answers[1]), "{answers:?}");
}

/// Particles and mass of each body by the number of the frame.
type Bodies = BTreeMap<u64, Vec<(usize, f64)>>;

/// Bodies of all frames and places of the last one [mm], as the run itself has them.
fn fields(scenario: &Scenario) -> (Bodies, Vec<[f64; 2]>) {
    let (mut bodies, mut places) = (Bodies::new(), Vec::new());
    let mut keep = |frame: &Frame<'_>| {
        let mut sums = vec![(0, 0.0); 2];
        places.clear();
        for (body, particle) in frame.fields.particles() {
            sums[body].0 += 1;
            sums[body].1 += particle.mass;
            places.push(particle.position.map(|x| x * 1e3));
        }
        bodies.insert(frame.number, sums);
        ControlFlow::Continue(())
    };
    let mut control = Control {
        frames: Some(&mut keep),
        ..Control::default()
    };
    model::run(model::model("axi").unwrap(), scenario, &mut control).unwrap();
    (bodies, places)
}

#[test]
fn frames_have_the_particles_and_the_masses_of_the_run() {
    let served = Served::new(Options::default());
    let messages = refined(&served, &json!({ "name": "shot", "case": PAPER }));
    let frames: Vec<&Message> = messages
        .iter()
        .filter(|(head, _)| head["frame"]["cells"] == 4)
        .collect();
    let mut scenario = case::load_str("shot", PAPER).unwrap();
    scenario.options.axi.cells_per_radius = Some(4);
    let (bodies, places) = fields(&scenario);
    let mut shown: Vec<u64> = Vec::new();
    for (head, body) in &frames {
        let head = &head["frame"];
        let number = head["number"].as_u64().unwrap();
        for dropped in head["dropped"].as_array().unwrap() {
            shown.retain(|number| dropped != number);
        }
        shown.push(number);
        let own = &bodies[&number];
        let particles: usize = own.iter().map(|(count, _)| count).sum();
        assert_eq!(body.len(), 16 * particles);
        for (sent, (count, mass)) in head["bodies"].as_array().unwrap().iter().zip(own) {
            assert_eq!(sent["particles"], json!(count));
            let off = sent["mass_kg"].as_f64().unwrap() / mass - 1.0;
            assert!(off.abs() < 1e-12, "{off}");
        }
    }
    assert_eq!(
        (frames[0].0["frame"]["first"].clone(), shown[0]),
        (json!(true), 0)
    );
    assert_eq!(shown.last(), bodies.keys().last());
    assert!((60..=121).contains(&shown.len()), "{}", shown.len());
    // The places of the last frame.
    let (head, body) = frames[frames.len() - 1];
    let value = |column: usize, row: usize| {
        let at = 2 * (column * places.len() + row);
        let scale = |end: usize| head["frame"]["scales"][column][end].as_f64().unwrap();
        let part = f64::from(u16::from_le_bytes([body[at], body[at + 1]])) / f64::from(u16::MAX);
        (
            scale(0) + part * (scale(1) - scale(0)),
            (scale(1) - scale(0)) / 65_535.0,
        )
    };
    for (row, place) in places.iter().enumerate() {
        for (column, exact) in place.iter().enumerate() {
            let (value, step) = value(column, row);
            assert!((value - exact).abs() < step, "{value} for {exact} mm");
        }
    }
}

#[test]
fn a_case_without_an_answer_has_the_reason() {
    let served = Served::new(Options::default());
    let text = format!("{PAPER}\n[axi]\ndamage = true\n");
    let text = text.replace("aluminium-2024-t351", "copper");
    let scenario = case::load_str("shot", &text).unwrap();
    let refusal = axisymmetric::plan(&scenario, ReferenceMeshes::Standard, None).unwrap_err();
    let messages = refined(&served, &json!({ "name": "shot", "case": text }));
    let expected = json!({ "reason": refusal.reason, "remedy": refusal.remedy });
    assert_eq!(heads(&messages, "refused"), [expected]);
    // One that would take minutes.
    let long = PAPER
        .replace("12.74 mm", "800 mm")
        .replace("25 mm", "semi-infinite")
        .replace("back_face = \"fixed\"\n", "");
    let messages = refined(&served, &json!({ "name": "shot", "case": long }));
    let reason = heads(&messages, "refused")[0]["reason"].to_string();
    assert!(reason.contains("processor time"), "{reason}");
}

#[test]
fn a_case_that_is_not_valid_is_refused_in_the_words_of_the_reader() {
    let served = Served::new(Options::default());
    for (good, bad) in [("\"4.8 mm\"", "\"4.8 kg\""), ("diameter", "diametre")] {
        let text = PAPER.replacen(good, bad, 1);
        let (message, help) = case::load_str("case", &text)
            .unwrap_err()
            .message_and_help();
        let messages = refined(&served, &json!({ "case": text }));
        let problem = &heads(&messages, "problem")[0];
        assert_eq!(
            (&problem["message"], &problem["help"]),
            (&json!(message), &json!(help))
        );
    }
    assert_eq!(
        served.post("/api/refinement", &json!({ "shot": 1 })).status,
        400
    );
    let layers = "{ material = \"copper\", thickness = \"1 mm\" },".repeat(41);
    let layered = format!(
        "projectile = {{ material = \"copper\", length = \"10 mm\", diameter = \"5 mm\", impact_velocity = \"300 m/s\" }}\ntarget.layers = [{layers}]"
    );
    let messages = refined(&served, &json!({ "case": layered }));
    assert_eq!(
        heads(&messages, "problem")[0]["message"],
        "the target has 41 layers"
    );
}

/// A refinement that has begun, and what it sent.
fn started(served: &Served) -> (TcpStream, Vec<u8>) {
    let asked = json!({ "case": SLOW }).to_string();
    let mut stream = served.connect();
    let request = post_request(served.address, "/api/refinement", asked.as_bytes(), "");
    stream.write_all(&request).unwrap();
    let mut said = Vec::new();
    read_until(&mut stream, &mut said, "\"frame\"");
    (stream, said)
}

/// Reads on until the bytes read contain a text.
fn read_until(stream: &mut TcpStream, said: &mut Vec<u8>, text: &str) {
    let mut some = [0; 4096];
    while !said.windows(text.len()).any(|part| part == text.as_bytes()) {
        let count = stream.read(&mut some).unwrap();
        assert!(count > 0, "the answer ends without {text}");
        said.extend_from_slice(&some[..count]);
    }
}

#[test]
fn a_refinement_gives_way_to_an_answer_and_goes_on() {
    let served = one_place();
    let (mut stream, _) = started(&served);
    let start = Instant::now();
    let answer = served.post_bytes("/api/answer", &body(), "");
    assert_eq!(answer.status, 200, "{}", answer.text());
    let took = start.elapsed();
    // It still runs: there is more of it after the answer.
    let mut said = Vec::new();
    read_until(&mut stream, &mut said, "\"frame\"");
    assert!(took < AT_MOST, "{took:?}");
}

#[test]
fn a_refinement_beside_a_sweep_gives_way_to_an_answer() {
    let served = Served::new(Options {
        bounds: RequestLimits {
            runs: 2,
            ..RequestLimits::default()
        },
        ..Options::default()
    });
    let (mut refined, _) = started(&served);
    let sweep = r#"
        base = "scenario.toml"
        model = "chain"
        design = "grid"
        [[parameter]]
        key = "projectile.impact_velocity"
        linear = { from = "150 m/s", to = "300 m/s", count = 4000 }
    "#;
    let fine = PAPER.replace("target_elements = 80", "target_elements = 1600");
    let asked = json!({ "case": fine, "sweep": sweep }).to_string();
    let request = post_request(served.address, "/api/study/sweep", asked.as_bytes(), "");
    let mut swept = served.connect();
    swept.write_all(&request).unwrap();
    read_until(&mut swept, &mut Vec::new(), "of 4000 runs");
    let answer = served.post_bytes("/api/answer", &body(), "");
    assert_eq!(answer.status, 200, "{}", answer.text());
    // Both go on.
    read_until(&mut refined, &mut Vec::new(), "\"frame\"");
    read_until(&mut swept, &mut Vec::new(), "of 4000 runs");
}

#[test]
fn a_refinement_that_nobody_waits_for_ends_at_once() {
    let served = one_place();
    let (first, _) = started(&served);
    drop(first);
    // Another one in the background takes the only place long before the first would have ended.
    let start = Instant::now();
    let (_second, _) = started(&served);
    assert!(
        start.elapsed() < Duration::from_secs(10),
        "{:?}",
        start.elapsed()
    );
}
