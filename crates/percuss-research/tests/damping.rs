//! The study of damping, and the page that tells it.

use std::{fs, ops::ControlFlow, path::Path};

use percuss_research::damping::{DampingStudy, damping_study};

fn change(study: &DampingStudy, way: &str, speed: f64, elements: u32) -> String {
    let mut runs = study.runs.iter();
    let run = runs
        .find(|s| s.way == way && s.speed == speed && s.elements == elements)
        .unwrap_or_else(|| panic!("{way} {speed} {elements}"));
    format!("{:+.1} %", 100.0 * run.change).replace('-', "\u{2212}")
}

#[test]
fn the_numbers_of_the_page_are_those_of_the_study() {
    let study = damping_study(&mut |_| ControlFlow::Continue(())).unwrap();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/damping.md");
    let page = fs::read_to_string(path).unwrap();
    for way in [
        "ratio 0.05",
        "ratio 0.1",
        "ratio 0.2",
        "ratio 0.5",
        "viscosity 0.06, 1.5",
        "local 0.2",
        "local 0.8",
    ] {
        let columns = [(230.0, 40), (230.0, 320), (600.0, 40), (600.0, 320)];
        let numbers = columns.map(|(speed, elements)| change(&study, way, speed, elements));
        let row = format!("| {way} | {} |", numbers.join(" | "));
        assert!(page.contains(&row), "{row}");
    }
    // What is damped is booked, and without damping nothing is.
    for run in &study.runs {
        assert_eq!(run.way == "none", run.damped == 0.0, "{run:?}");
        assert!((0.0..0.6).contains(&run.damped), "{run:?}");
    }
    assert_eq!(study.reference.len(), 2);
    assert_eq!(study.findings().len(), 9);
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(study.write(folder.path()).unwrap().len(), 7);
    // The names in JSON are those of the table.
    let table = fs::read_to_string(folder.path().join("damping.csv")).unwrap();
    let mut columns: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    columns.sort_unstable();
    let json = serde_json::to_value(&study.runs[0]).unwrap();
    let mut names: Vec<&String> = json.as_object().unwrap().keys().collect();
    names.sort_unstable();
    assert_eq!(names, columns);
}

#[test]
fn a_caller_can_stop_it() {
    assert!(damping_study(&mut |_| ControlFlow::Break(())).is_err());
}
