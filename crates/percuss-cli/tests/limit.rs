//! `percuss limit`: ballistic limits of a case, and V50 of tests.

use std::fs;

use serde_json::Value;
use tempfile::TempDir;

use crate::support::{Said, flat, folder_with, json, percuss};

const BLUNT: &str = "
projectile = { material = 'tool-steel-hrc53', mass = '197 g', diameter = '20 mm', impact_velocity = '300 m/s' }
target = { material = 'weldox-460-e', thickness = '12 mm' }
[[experiments]]
ballistic_limit = '184.5 m/s'
source = 'borvik2002a'
[[experiments]]
impact_velocity = '300 m/s'
residual_velocity = '200 m/s'
source = 'made up'
";
const TESTS: &str =
    "impact_velocity_m_s,perforated\n180,no\n184,no\n188,no\n186,yes\n190,yes\n194,yes\n";

fn folder(case: &str) -> TempDir {
    folder_with(&[("shot.toml", case), ("tests.csv", TESTS)])
}

fn limit(folder: &TempDir, arguments: &[&str]) -> Said {
    percuss(folder.path(), [&["limit"], arguments].concat())
}

#[track_caller]
fn ok(folder: &TempDir, arguments: &[&str]) -> String {
    limit(folder, arguments).ok()
}

#[test]
fn the_table_has_limits_brackets_and_fits_and_says_who_has_none() {
    let folder = folder(BLUNT);
    let text = ok(&folder, &["shot.toml", "--fast"]);
    for part in [
        "searched from 0 to 2000 m/s, brackets of 0.1 m/s or less",
        "131.4",
        "-28.8",
        "184.5",
        "v_r = a (v^p - v_bl^p)^(1/p)",
        "the rear face of the plate is taken as free: the case gives no `target.back_face`",
        "power_balance ★",
        "★ recommended: power_balance: ",
        "models within their ranges of validity: ",
        "no estimated model error of chain, fdm, plugging, awerbuch_bodner, power_balance: fewer than 5 published limits",
        "residual velocity above a given limit (an input, not a prediction of the limit)",
        "without a limit",
        "plate_cavity: not applicable, because it takes",
    ] {
        assert!(flat(&text).contains(part), "{part:?} is not in:\n{text}");
    }
    assert!(
        !text.contains("+0.0"),
        "a model repeats the measured limit:\n{text}"
    );
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
}

/// Unasked the axisymmetric limit is the first line, where no first choice is judged nor the nose flat; elsewhere the first choice is.
#[test]
fn the_first_line_has_the_limit_to_use() {
    let head = |case: &str, arguments: &[&str]| {
        let folder = folder(case);
        let text = ok(
            &folder,
            &[
                &["shot.toml", "--velocity", "50..500", "--points", "0"],
                arguments,
            ]
            .concat(),
        );
        let line = text.lines().find(|line| line.contains("allistic limit "));
        (line.unwrap_or_default().to_owned(), flat(&text))
    };
    let (line, text) = head(BLUNT, &[]);
    assert!(
        line.starts_with(
            "Ballistic limit 182.6 m/s (power_balance), -1.1 % from the measured 184.5 m/s"
        ),
        "{text}"
    );
    assert!(text.contains(" axisymmetric limit 2"), "{text}");
    assert!(text.contains("★ recommended: power_balance: "), "{text}");
    let round = BLUNT.replace("'20 mm'", "'20 mm', nose = 'hemisphere'");
    let (line, text) = head(&round, &[]);
    assert!(line.starts_with("Axisymmetric ballistic limit 2"), "{text}");
    assert!(line.contains("from the measured 184.5 m/s"), "{line}");
    assert!(text.contains("★ recommended: axi: "), "{text}");
    let light = BLUNT.replace("weldox-460-e", "aluminium-2024-t351");
    let (line, text) = head(&light, &["--reference", "standard"]);
    assert!(
        line.starts_with("Ballistic limit 143.6 m/s (power_balance), model error −8 %"),
        "{text}"
    );
    assert!(text.contains(" axisymmetric limit "), "{text}");
    let (line, text) = head(BLUNT, &["--fast"]);
    assert!(
        line.starts_with("Ballistic limit 182.6 m/s (power_balance), -1.1 %"),
        "{text}"
    );
    assert!(!text.contains("axisymmetric limit"), "{text}");
}

#[test]
fn json_has_an_entry_a_model_with_stable_names() {
    let folder = folder(BLUNT);
    let object = json(&ok(
        &folder,
        &["shot.toml", "--fast", "--json", "--tests", "tests.csv"],
    ));
    let results = object["results"].as_array().unwrap();
    let of = |model: &str| {
        results
            .iter()
            .find(|entry| entry["model"] == model)
            .unwrap()
    };
    let plugging = of("plugging");
    assert_eq!(plugging["outcome"], "found");
    let number = |value: &Value| value.as_f64().unwrap();
    assert!((number(&plugging["ballistic_limit_m_s"]) - 131.42955).abs() < 1e-4);
    assert_eq!(
        plugging["stated_limit_m_s"],
        plugging["ballistic_limit_m_s"]
    );
    let bracket = &plugging["bracket"];
    assert!(number(&bracket["stopped_m_s"]) < 131.42955);
    assert!(number(&bracket["perforated_m_s"]) > 131.42955);
    assert_eq!(plugging["curve"].as_array().unwrap().len(), 12);
    assert!((number(&plugging["fit"]["p"]) - 2.0).abs() < 1e-5);
    let forrestal = of("forrestal");
    assert_eq!(forrestal["outcome"], "not_applicable");
    assert!(
        forrestal["reason"]
            .as_str()
            .unwrap()
            .contains("does not predict")
    );
    assert_eq!(forrestal["ballistic_limit_m_s"], Value::Null);
    assert_eq!(object["experiments"].as_array().unwrap().len(), 2);
    assert_eq!(object["v50"]["pattern"], "mixed");
    let probit = &object["v50"]["estimates"][0];
    assert_eq!(probit["method"], "probit");
    assert!((number(&probit["v50_m_s"]) - 187.0).abs() < 1e-6);
    let tests = object["tests"].as_array().unwrap();
    assert_eq!(object["v50"]["tests"], tests.len());
    assert!(number(&tests[0]["impact_velocity_m_s"]) > 0.0 && tests[0]["perforated"].is_boolean());
}

#[test]
fn a_range_that_is_stopped_or_perforated_throughout_is_an_answer() {
    let folder = folder(BLUNT);
    let text = ok(
        &folder,
        &["shot.toml", "--model", "plugging", "--velocity", "10..100"],
    );
    assert!(
        text.contains("partial penetration at every velocity up to 100 m/s"),
        "{text}"
    );
    let quiet = ok(
        &folder,
        &[
            "shot.toml",
            "--model",
            "plugging",
            "--velocity",
            "0.2..0.3 km/s",
            "-q",
        ],
    );
    assert!(
        quiet.starts_with("model=plugging outcome=always_perforates ballistic_limit_m_s=null"),
        "{quiet}"
    );
}

#[test]
fn where_no_model_applies_the_reasons_are_the_error() {
    let folder = folder("
projectile = { material = 'ofhc-copper', length = '23.47 mm', diameter = '7.62 mm', impact_velocity = '183 m/s' }
target = { rigid_wall = true }
");
    let said = limit(&folder, &["shot.toml"]);
    assert_eq!((said.code, said.stdout.as_str()), (2, ""));
    assert!(
        flat(&said.stderr).contains("the target has no rear face to perforate"),
        "{}",
        said.stderr
    );
}

#[test]
fn files_and_figures_are_written() {
    let folder = folder(BLUNT);
    ok(
        &folder,
        &[
            "shot.toml",
            "--tests",
            "tests.csv",
            "--out",
            "out",
            "--model",
            "recht_ipson",
            "--model",
            "plugging",
        ],
    );
    let out = folder.path().join("out");
    for name in [
        "case-as-run.toml",
        "limit.json",
        "limit.svg",
        "limit.png",
        "v50.svg",
        "v50.png",
    ] {
        assert!(out.join(name).is_file(), "{name}");
    }
    let read = |name: &str| fs::read_to_string(out.join(name)).unwrap();
    assert_eq!(read("limit.csv").lines().count(), 3);
    assert!(read("limit.csv").starts_with("model,outcome,ballistic_limit_m_s,"));
    assert_eq!(read("curve.csv").lines().count(), 25);
    let figure = read("limit.svg");
    for part in [
        ">plugging<",
        ">limit (m/s)<",
        ">131<",
        "experiment",
        ">measured<",
        ">184.5<",
    ] {
        assert!(figure.contains(part), "{part}");
    }
}

#[test]
fn tests_need_no_case_and_separated_ones_have_no_likeliest_v50() {
    let folder = folder(BLUNT);
    let text = ok(&folder, &["--tests", "tests.csv"]);
    assert!(
        flat(&text).contains(
            "6 tests of tests.csv: 3 partial and 3 complete penetrations; zone of mixed results from 186 to 188 m/s"
        ),
        "{text}"
    );
    fs::write(
        folder.path().join("apart.csv"),
        "impact_velocity_m_s,perforated\n170,no\n180,no\n190,yes\n200,yes\n",
    )
    .unwrap();
    let text = ok(&folder, &["--tests", "apart.csv", "--span", "20 m/s"]);
    for part in [
        "no zone of mixed results",
        "extremes: the 2 fastest partial",
    ] {
        assert!(flat(&text).contains(part), "{text}");
    }
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
}

#[test]
fn what_is_wrong_is_said_with_its_place() {
    let folder = folder(BLUNT);
    fs::write(
        folder.path().join("bad.csv"),
        "impact_velocity_m_s,perforated\n184,maybe\n",
    )
    .unwrap();
    for (arguments, code, words) in [
        (vec!["--tests", "bad.csv"], 2, "bad.csv:2:5"),
        (
            vec!["--tests", "none.csv"],
            4,
            "give the path of a CSV file that exists",
        ),
        (
            vec!["shot.toml", "--velocity", "400..100"],
            2,
            "not above its start",
        ),
        (
            vec!["shot.toml", "--velocity", "400"],
            2,
            "FROM..TO such as 100..400",
        ),
        (vec!["shot.toml", "--tolerance", "0.5"], 2, "0.2 %"),
        (vec!["shot.toml", "--model", "pluging"], 2, "plugging"),
        (
            vec!["--model", "plugging", "--tests", "tests.csv"],
            2,
            "CASE.toml",
        ),
        (vec![], 2, "CASE.toml"),
    ] {
        let said = limit(&folder, &arguments);
        assert_eq!(said.code, code, "{arguments:?}: {}", said.stderr);
        assert!(
            said.stderr.contains(words),
            "{arguments:?}: {}",
            said.stderr
        );
        assert_eq!(said.stdout, "");
    }
}

#[test]
fn the_expected_error_is_that_on_published_limits_of_the_same_kind() {
    let light = BLUNT.replace("weldox-460-e", "aluminium-2024-t351");
    let folder = folder(&light);
    let options = ["shot.toml", "--model", "plugging", "--points", "0"];
    let text = ok(&folder, &options);
    assert!(
        flat(&text).contains("estimated model error of plugging: +"),
        "{text}"
    );
    assert!(flat(&text).contains("noses on "), "{text}");
    let object = json(&ok(&folder, &[&options[..], &["--json"]].concat()));
    let expected = &object["results"][0]["expected_error"];
    assert!(expected["cases"].as_u64().unwrap() >= 5, "{expected}");
    assert_eq!(expected["blind"], expected["cases"]);
}

/// Without a word on the rear face the chain used to be stopped at every speed.
#[test]
fn a_rear_face_is_free_unless_the_case_fixes_it() {
    let sheet = |back: &str| {
        format!(
            "projectile = {{ material = 'copper', length = '20 mm', diameter = '5 mm', impact_velocity = '300 m/s' }}\n\
             target = {{ material = 'aluminium-2024-t351', thickness = '5 mm'{back} }}\n\
             chain = {{ projectile_elements = 10, target_elements = 8 }}\n"
        )
    };
    let options = [
        "shot.toml",
        "--model",
        "chain",
        "--tolerance",
        "10 m/s",
        "--points",
        "0",
        "--json",
    ];
    let of = |back: &str| json(&ok(&folder(&sheet(back)), &options));
    let (open, free) = (of(""), of(", back_face = 'free'"));
    assert_eq!(open["results"], free["results"]);
    assert_eq!(open["results"][0]["outcome"], "found");
    assert_eq!(open["rear_face"]["condition"], "free");
    assert_eq!(
        (&open["rear_face"]["assumed"], &free["rear_face"]["assumed"]),
        (&Value::Bool(true), &Value::Bool(false))
    );

    let fixed = folder(&sheet(", back_face = 'fixed'"));
    let text = ok(&fixed, &["shot.toml"]);
    let head: Vec<&str> = text.lines().take(4).collect();
    assert!(
        flat(&head.join(" ")).contains("perforation is impossible: the case fixes the rear face"),
        "{text}"
    );
    let object = json(&ok(&fixed, &options));
    assert_eq!(object["results"][0]["outcome"], "never_perforates");
    assert_eq!(object["results"][0]["runs"], 0);
}

#[test]
fn a_limit_that_is_an_input_is_no_result() {
    let given = format!("{BLUNT}[recht_ipson]\nballistic_limit = '184.5 m/s'\n");
    let folder = folder(&given);
    let object = json(&ok(
        &folder,
        &["shot.toml", "--model", "recht_ipson", "--json"],
    ));
    let entry = &object["results"][0];
    assert_eq!(entry["outcome"], "input");
    assert_eq!(
        (&entry["ballistic_limit_m_s"], &object["range"]),
        (&Value::Null, &Value::Null)
    );
    assert_eq!(entry["input_limit"]["ballistic_limit_m_s"], 184.5);
    assert_eq!(entry["input_limit"]["computed_by"], Value::Null);
    assert_eq!(entry["curve"].as_array().unwrap().len(), 12);
    let text = ok(&folder, &["shot.toml", "--model", "recht_ipson"]);
    assert!(
        text.contains("no model predicts a limit of this case between the velocities searched"),
        "{text}"
    );
}

/// A column of the user's own is not read and is named; a misspelt one is an error.
#[test]
fn further_columns_of_tests_are_noted() {
    let folder = TempDir::new().unwrap();
    let rows = |header: &str| {
        format!("{header}\n300,no,a\n325,yes,b\n318,no,b\n322,yes,a\n312,yes,a\n310,no,b\n")
    };
    let path = folder.path().join("tests.csv");
    fs::write(&path, rows("impact_velocity_m_s,perforated,shooter")).unwrap();
    let said = percuss(folder.path(), ["limit", "--tests", "tests.csv"]);
    assert_eq!(said.code, 0, "{}", said.stderr);
    assert_eq!(
        said.stderr,
        "note: the column `shooter` of `tests.csv` is not read\n"
    );
    fs::write(&path, rows("impact_velocity_m_s,perforatd,shooter")).unwrap();
    let said = percuss(folder.path(), ["limit", "--tests", "tests.csv"]);
    assert_eq!(said.code, 2);
    assert!(
        said.stderr.contains("did you mean `perforated`?"),
        "{}",
        said.stderr
    );
}

/// A plate thinner than a cell of the coarsest mesh: material at the axis moves with the plate for as long as the run lasts.
#[test]
fn a_plate_thinner_than_a_cell_has_no_axisymmetric_limit() {
    let folder = folder(&BLUNT.replace("'12 mm'", "'1 mm'"));
    let text = ok(&folder, &["shot.toml", "--points", "0"]);
    let words = "thinner than a cell of the coarsest mesh, 3 cells per radius: take finer ones by `--reference fine`";
    assert!(flat(&text).contains(words), "{text}");
}

/// The scan of 17 velocities has none at which this model perforates within its range; the limit is found all the same.
#[test]
fn the_range_of_the_search_does_not_hide_a_limit() {
    let cone = "
projectile = { material = 'tool-steel-hrc53', mass = '197 g', diameter = '20 mm', impact_velocity = '300 m/s', nose = { cone = { angle = '33.4 deg' } } }
target = { material = 'weldox-460-e', thickness = '20 mm' }
";
    let folder = folder(cone);
    let of = |range: &[&str]| {
        let arguments = [
            "shot.toml",
            "--model",
            "plate_cavity",
            "--points",
            "0",
            "--json",
        ];
        let found = json(&ok(&folder, &[&arguments[..], range].concat()));
        found["results"][0]["ballistic_limit_m_s"].as_f64().unwrap()
    };
    let [whole, narrow] = [of(&[]), of(&["--velocity", "200..450"])];
    assert!((whole / narrow - 1.0).abs() < 1e-3, "{whole}, {narrow}");
}

#[test]
fn options_without_effect_are_refused() {
    let folder = folder(BLUNT);
    let refused = |arguments: &[&str], words: &str| {
        let said = limit(&folder, arguments);
        assert_eq!(said.code, 2, "{arguments:?}: {}", said.stderr);
        assert!(flat(&said.stderr).contains(words), "{}", said.stderr);
    };
    for (option, value) in [
        ("--velocity", "100..400"),
        ("--tolerance", "1 %"),
        ("--points", "3"),
    ] {
        refused(&["--tests", "tests.csv", option, value], "CASE.toml");
    }
    refused(
        &["shot.toml", "--fast", "--model", "axi"],
        "`--fast` leaves out the axisymmetric model",
    );
    let said = percuss(
        folder.path(),
        ["compare", "shot.toml", "--fast", "--model", "axi"],
    );
    assert_eq!(said.code, 2, "{}", said.stderr);
}
