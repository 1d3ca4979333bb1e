//! `percuss validate` on small files, and what it says of wrong ones.

use std::{fs, path::Path};

use tempfile::TempDir;

use crate::support::{Said, json, percuss, whole_report};

const TESTS: &str = "\
id,source,kind,projectile_material,diameter_mm,length_mm,impact_velocity_m_s,target_material,measured,unit,flag
one,my <lab> & co,taylor,copper ofhc-copper,7.62,23.47,183,rigid-wall,16.8,mm,
two,my <lab> & co,taylor,copper,7.62,23.47,123,rigid-wall,19.6,mm,
odd,my <lab> & co,taylor,copper,7.62,23.47,123,rigid-wall,5,mm,a | slip
";

fn folder_with(tests: &str) -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("tests.csv"), tests).unwrap();
    folder
}

#[track_caller]
fn ok(folder: &Path, arguments: &[&str]) -> String {
    let said = percuss(
        folder,
        [
            &["validate", "--data", "tests.csv", "--model", "chain"],
            arguments,
        ]
        .concat(),
    );
    said.ok()
}

#[test]
fn a_users_tests_take_the_place_of_the_programs() {
    let folder = folder_with(TESTS);
    let text = ok(folder.path(), &[]);
    for part in [
        "data: tests.csv (3)\n",
        "not counted: 1 suspect and 0 repeated tests\n",
        "final lengths of Taylor rods (--kind taylor)\n",
        "copper ofhc-copper; copper",
        "by source",
    ] {
        assert!(text.contains(part), "{part:?} is not in:\n{text}");
    }
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    let line = ok(folder.path(), &["--quiet"]);
    assert!(
        line.starts_with("model=chain kind=taylor count=2 bias=") && line.lines().count() == 1,
        "{line}"
    );
}

#[test]
fn json_holds_statistics_and_predictions() {
    let folder = folder_with(TESTS);
    let json = json(&ok(folder.path(), &["--json"]));
    assert_eq!(json["tests"], 3);
    let predictions = json["predictions"].as_array().unwrap();
    assert_eq!(predictions.len(), 4);
    assert_eq!(predictions[3]["standing"], "flagged");
    let errors: Vec<f64> = [0, 2]
        .map(|i: usize| predictions[i]["relative_error"].as_f64().unwrap())
        .to_vec();
    let all = &json["statistics"][0];
    assert_eq!(
        (&all["grouping"], &all["count"]),
        (&"all".into(), &2.into())
    );
    let mean = (errors[0] + errors[1]) / 2.0;
    assert!(
        (all["bias"].as_f64().unwrap() - mean).abs() < 1e-12,
        "{all}"
    );
    assert!(errors.iter().all(|error| error.abs() < 0.03), "{errors:?}");
}

#[test]
fn the_report_is_written_whole_and_escaped() {
    let folder = folder_with(&TESTS.replace("two,", "<i>two</i>,"));
    ok(folder.path(), &["--out", "report"]);
    let read = |name: &str| fs::read_to_string(folder.path().join("report").join(name)).unwrap();
    let parts = ["prefers-color-scheme:dark", "Blind predictions"];
    let tables = ["predictions.parquet", "statistics.parquet"];
    let report = folder.path().join("report");
    let [html, markdown] = whole_report(&report, "validation", &parts, &tables);
    assert!(
        html.contains("my &lt;lab&gt; &amp; co")
            && !html.contains("<lab>")
            && !html.contains("<i>")
    );
    assert!(
        markdown.contains(r"a \| slip") && markdown.contains("my &lt;lab&gt;"),
        "{markdown}"
    );
    assert_eq!(read("predictions.csv").lines().count(), 5);
}

#[test]
fn the_programs_own_tests_can_be_added() {
    let folder = folder_with(
        &TESTS
            .replace("taylor", "depth")
            .replace("rigid-wall,", "aluminium-2024-t351,")
            .replace("measured,unit", "thickness_mm,measured,unit")
            .replace("t351,", "t351,semi-infinite,"),
    );
    let text = ok(folder.path(), &["--data", "builtin", "--kind", "depth"]);
    assert!(
        text.contains("data: tests.csv (3), tests of the program (1133)\n"),
        "{text}"
    );
    assert!(
        text.contains("FORR94-14") || text.contains("of 5 counted"),
        "{text}"
    );
}

fn refused(tests: &str, arguments: &[&str]) -> String {
    let folder = folder_with(tests);
    let Said {
        code,
        stdout,
        stderr,
        ..
    } = percuss(folder.path(), [&["validate"], arguments].concat());
    assert_eq!((code, stdout.as_str()), (2, ""), "{stderr}");
    assert!(
        stderr.starts_with("error: ") && stderr.len() < 2000,
        "{stderr}"
    );
    stderr
}

#[test]
fn wrong_files_are_refused_with_place_and_remedy() {
    let file = ["--data", "tests.csv"];
    for (tests, parts) in [
        (
            TESTS.replace("diameter_mm,", "").replace(",7.62", ""),
            ["the first line lacks `diameter_mm`", "required are `kind`"],
        ),
        (
            TESTS.replace(",123,rigid-wall,19", ",fast,rigid-wall,19"),
            ["`fast` is no number", "tests.csv:3:"],
        ),
        (
            TESTS.replace("two,my <lab> & co,taylor", "two,my <lab> & co,tailor"),
            ["unknown value `tailor`", "did you mean `taylor`?"],
        ),
        (
            TESTS.replace(
                "two,my <lab> & co,taylor,copper",
                "two,my <lab> & co,taylor,coper",
            ),
            ["no material is named `coper`", "tests.csv:3:"],
        ),
        (
            TESTS.replace("two,", "one,"),
            ["a second test is named `one`", "tests.csv:3:"],
        ),
        (
            TESTS.replace("diameter_mm,", "diametr_mm,"),
            [
                "no column is named `diametr_mm`",
                "did you mean `diameter_mm`?",
            ],
        ),
        (String::new(), ["the first line lacks", "help: "]),
    ] {
        let stderr = refused(&tests, &file);
        assert!(!stderr.contains("key:"), "{stderr}");
        for part in parts {
            assert!(stderr.contains(part), "{part:?} is not in:\n{stderr}");
        }
    }
}

#[test]
fn wrong_arguments_are_refused() {
    assert!(refused(TESTS, &["--model", "chian"]).contains("chain"));
    assert!(refused(TESTS, &["--kind", "tailor"]).contains("taylor"));
    let empty = refused(TESTS, &["--data", "tests.csv", "--kind", "depth"]);
    assert!(empty.contains("no test of kind depth"), "{empty}");
    let twice = refused(TESTS, &["--data", "tests.csv", "--data", "tests.csv"]);
    assert!(twice.contains("a test with the id `one`"), "{twice}");
    let folder = folder_with(TESTS);
    let missing = percuss(folder.path(), ["validate", "--data", "none.csv"]);
    assert_eq!(missing.code, 4);
    assert!(
        missing
            .stderr
            .contains("cannot read `none.csv`: there is no such file"),
        "{}",
        missing.stderr
    );
    assert!(
        !missing.stderr.contains("percuss new"),
        "a file of tests is no case: {}",
        missing.stderr
    );
}

#[test]
fn a_long_validation_says_first_what_it_will_cost() {
    use std::io::{BufRead, BufReader};

    use crate::support::spawn;

    let folder = TempDir::new().unwrap();
    let mut child = spawn(
        folder.path(),
        &["validate", "--model", "axi", "--kind", "taylor"],
    );
    let mut line = String::new();
    let mut said = BufReader::new(child.stderr.take().unwrap());
    said.read_line(&mut line).unwrap();
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(line.starts_with("note: estimated cost: "), "{line}");
}
