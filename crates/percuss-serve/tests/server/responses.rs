//! What the server answers is what the library and the command line say, to the last bit.

use percuss::{
    case,
    model::{self, Control},
    summary::CaseResults,
};
use percuss_serve::Options;
use serde_json::{Value, json};

use crate::support::{PAPER, Served};

/// What the library says of a case, as `percuss run --json` prints it.
fn by_library(name: &str, text: &str, model: &str) -> Value {
    let scenario = case::load_str(name, text).unwrap();
    let model = model::model(model).unwrap();
    let result = model::run_explained(model, &scenario, &mut Control::default()).unwrap();
    let printed = serde_json::to_string(&CaseResults::new(&scenario, &[result])).unwrap();
    serde_json::from_str(&printed).unwrap()
}

#[test]
fn the_numbers_are_those_of_the_library() {
    let served = Served::new(Options::default());
    let taylor = include_str!("../../../../cases/taylor-copper-wilkins/scenario.toml");
    let blunt = include_str!("../../../../cases/weldox-460e-12mm-blunt/scenario.toml");
    for (text, model) in [
        (PAPER, "chain"),
        (PAPER, "fdm"),
        (PAPER, "crater_energy"),
        (taylor, "chain"),
        (taylor, "taylor"),
        (blunt, "plugging"),
    ] {
        let body = json!({ "name": "shot", "case": text, "model": model });
        let answer = served.post("/api/answer", &body);
        assert_eq!(answer.status, 200, "{model}: {}", answer.text());
        assert_eq!(
            answer.json()["results"],
            by_library("shot", text, model),
            "{model}"
        );
        assert_eq!(answer.json()["case"], text);
    }
}

/// The menu of the page has no case that it cannot answer.
#[test]
fn every_ready_case_has_an_answer() {
    let served = Served::new(Options::default());
    let page = served.get("/", "");
    let (_, data) = page
        .text()
        .split_once("id=\"data\">")
        .map(|(a, b)| (a.to_owned(), b.to_owned()))
        .unwrap();
    let (data, _) = data.split_once("</script>").unwrap();
    let data: Value = serde_json::from_str(data).unwrap();
    let cases = data["cases"].as_array().unwrap();
    assert!(cases.len() >= 18, "{}", cases.len());
    for case in cases {
        let body = json!({ "name": case["name"], "case": case["text"] });
        let answer = served.post("/api/answer", &body);
        assert_eq!(answer.status, 200, "{}: {}", case["name"], answer.text());
    }
}

/// Without a model that is asked for, the page takes the one that a comparison recommends, and says why.
#[test]
fn a_case_that_the_chain_does_not_take_is_answered_by_the_recommended_model() {
    let served = Served::new(Options::default());
    let sharp = "projectile = { material = '4340', length = '60 mm', diameter = '8 mm', nose = { ogive = { crh = 3.0 } }, impact_velocity = '400 m/s' }\n\
                 target = { material = '6061-t6', thickness = 'semi-infinite' }\n";
    let chosen = model::default_model(&case::load_str("shot", sharp).unwrap()).unwrap();
    assert_ne!(chosen.model.name(), "chain");
    let answer = served
        .post("/api/answer", &json!({ "name": "shot", "case": sharp }))
        .json();
    assert_eq!(answer["model"], chosen.model.name());
    let note = chosen.note.unwrap();
    assert_eq!(answer["results"]["results"][0]["model_choice"], note);
    assert_eq!(answer["rows"][0][0], json!(["model", note]));
    let named = json!({ "name": "shot", "case": sharp, "model": "chain" });
    assert_eq!(served.post("/api/answer", &named).status, 422);
}

#[test]
fn edits_of_the_form_are_edits_of_the_text() {
    let served = Served::new(Options::default());
    let edits = json!([
        { "key": "projectile.impact_velocity", "value": "\"400 m/s\"" },
        { "key": "chain.target_elements", "value": null },
    ]);
    let body = json!({ "name": "shot", "case": PAPER, "edits": edits, "model": "chain" });
    let answer = served.post("/api/answer", &body).json();
    let text = PAPER
        .replace("at 230 m/s\"", "at 230 m/s (changed)\"")
        .replace("230 m/s\"\n\n[target]", "400 m/s\"\n\n[target]")
        .replace("target_elements = 80\n", "");
    assert_eq!(answer["case"], text);
    assert_eq!(answer["values"]["projectile.impact_velocity"], "400 m/s");
    assert_eq!(answer["results"], by_library("shot", &text, "chain"));
}

#[test]
fn a_case_that_is_not_valid_is_refused_in_the_words_of_the_reader() {
    let served = Served::new(Options::default());
    for (good, bad) in [
        ("\"4.8 mm\"", "\"4.8 kg\""),
        ("\"4.8 mm\"", "\"nan mm\""),
        ("\"4.8 mm\"", "nan"),
        ("\"4.8 mm\"", "\"1e999 mm\""),
        ("\"4.8 mm\"", "[[[1]]]"),
        ("diameter", "diametre"),
        ("\"copper\"", "\"unobtainium\""),
        ("= 40", "= -40"),
        ("= 40", "= 0.5"),
        ("[projectile]", "[projectile"),
        ("title", "material_files = [\"/etc/passwd\"]\ntitle"),
        ("title", "material_files = [\"../../secret.toml\"]\ntitle"),
    ] {
        let text = PAPER.replacen(good, bad, 1);
        let error = case::load_str("case", &text).unwrap_err();
        let (message, help) = error.message_and_help();
        let answer = served.post("/api/answer", &json!({ "case": text }));
        assert_eq!(answer.status, 422, "{bad}");
        assert_eq!(answer.problem(), message, "{bad}");
        assert_eq!(answer.json()["problem"]["help"], help, "{bad}");
        assert_eq!(answer.json()["case"], text);
    }
    let text = PAPER.replace("\"4.8 mm\"", "\"4.8 kg\"");
    let answer = served.post("/api/answer", &json!({ "case": text })).json();
    let place = &answer["problem"]["place"];
    assert_eq!(place["line"], 8);
    assert_eq!(place["text"], "diameter = \"4.8 kg\"");
    assert_eq!(
        (&place["column"], &place["length"]),
        (&json!(11), &json!(8))
    );
    assert_eq!(answer["problem"]["key"], "projectile.diameter");
    // The form follows a text that is TOML, valid or not.
    assert_eq!(answer["values"]["projectile.diameter"], "4.8 kg");
}

/// A drawing without the numbers of its clipping paths, which count on from drawing to drawing.
fn without_numbers(svg: &str) -> String {
    let mut parts = svg.split("kuva-clip-");
    let first = parts.next().unwrap_or_default().to_owned();
    let rest = parts.map(|part| part.trim_start_matches(|c: char| c.is_ascii_digit()));
    rest.fold(first, |text, part| text + part)
}

#[test]
fn files_are_those_of_a_run_folder() {
    let served = Served::new(Options::default());
    let file = |name: &str| {
        let body = json!({ "name": "shot", "case": PAPER, "model": "chain", "file": name });
        served.post("/api/file", &body)
    };
    let scenario = case::load_str("shot", PAPER).unwrap();
    let chain = model::model("chain").unwrap();
    let result = model::run(chain, &scenario, &mut Control::recording()).unwrap();
    for (name, content) in percuss_report::history_files(&result, None).unwrap() {
        let answer = file(name);
        assert!(answer.body == content, "{name}");
        assert!(answer.head.contains("content-disposition: attachment"));
    }
    for figure in percuss_report::run_figures(&scenario, &result).unwrap() {
        let drawn = file(&format!("{}.svg", figure.name)).text();
        assert_eq!(without_numbers(&drawn), without_numbers(&figure.svg));
    }
    for name in [
        "../../etc/passwd",
        "/etc/passwd",
        "",
        "nothing.svg",
        "history.csv/..",
    ] {
        assert_eq!(file(name).status, 404, "{name}");
    }
}

#[test]
fn the_page_comes_with_its_first_answer() {
    let served = Served::new(Options::default());
    let page = served.get("/", "").text();
    assert!(page.contains("<dt>depth of penetration</dt><dd>0.208 mm</dd>"));
    let start = page.split("id=\"data\">").nth(1).unwrap();
    let data: Value = serde_json::from_str(start.split("</script>").next().unwrap()).unwrap();
    assert_eq!(
        data["answer"]["results"],
        by_library("paper-table1", PAPER, "chain")
    );
    for path in ["/assets/app.js", "/assets/app.css"] {
        let answer = served.get(path, "");
        assert_eq!(answer.status, 200, "{path}");
        let tag = answer
            .head
            .lines()
            .find_map(|line| line.strip_prefix("etag: "));
        let again = served.get(path, &format!("If-None-Match: {}\r\n", tag.unwrap()));
        assert_eq!((again.status, again.body.len()), (304, 0));
    }
}

#[test]
fn materials_are_pages() {
    let served = Served::new(Options::default());
    let list = served.get("/materials", "").text();
    assert!(list.contains("href=\"/materials/aluminium-2024-t351"));
    let card = served.get("/materials/copper", "").text();
    assert!(card.contains("Young&#39;s modulus") && card.contains("sources"));
    assert!(card.contains("<a href=\"/\">Case</a>"), "{card}");
}

#[test]
fn a_page_that_is_not_there_is_a_page_with_the_way_back() {
    let served = Served::new(Options::default());
    for (path, title) in [
        ("/materials/unobtainium", "There is no such page"),
        ("/nowhere", "There is no such page"),
        ("/validation", "The validation is not computed yet"),
    ] {
        let answer = served.get(path, "Accept: text/html\r\n");
        assert_eq!(answer.status, 404, "{path}");
        let text = answer.text();
        assert!(
            text.contains(&format!("<h1>{title}</h1>")),
            "{path}: {text}"
        );
        assert!(text.contains("<a href=\"/\">Case</a>"), "{path}: {text}");
    }
    // A program is answered in JSON.
    assert_eq!(
        served.get("/nowhere", "").problem(),
        "there is no such page"
    );
}
