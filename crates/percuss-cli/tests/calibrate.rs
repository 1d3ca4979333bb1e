//! `percuss calibrate`: from tests to a material with its provenance.

use std::fs;

use tempfile::TempDir;

use crate::support::{Said, folder_with, json, percuss};

const YIELD: &str = "materials.ofhc-copper-johnson-cook.strength.johnson_cook.a=20..300 MPa";
const WILKINS: [&str; 8] = [
    "calibrate",
    "--data",
    "builtin",
    "--source",
    "wilkins1973",
    "--model",
    "wilkins_guinan",
    "--fit",
];

fn calibrate(folder: &TempDir, fit: &str, more: &[&str]) -> Said {
    let arguments = [&WILKINS[..], &[fit], more].concat();
    percuss(folder.path(), arguments)
}

#[test]
fn least_squares_say_what_they_found() {
    let folder = TempDir::new().unwrap();
    let more = ["--least-squares", "--hold-out", "zelepugin2023"];
    let text = calibrate(&folder, YIELD, &more).ok();
    for words in [
        "best ± error",
        "held out",
        "left out",
        "[ofhc-copper-johnson-cook-calibrated]",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    let found = calibrate(&folder, YIELD, &[&more[..], &["--json"]].concat()).ok();
    let found = json(&found);
    let stress = found["parameters"][0]["best"].as_f64().unwrap();
    assert!((60.0..250.0).contains(&stress), "{stress}");
    assert_eq!(found["training"]["count"], 6);
    assert!(found["training"]["rms"].as_f64() < found["training"]["rms_before"].as_f64());
    let held_out = found["predictions"].as_array().unwrap().iter();
    let held_out = held_out.filter(|value| value["held_out"] == true).count();
    assert_eq!(found["hold_out"]["count"], held_out);
    let line = calibrate(&folder, YIELD, &[&more[..], &["-q"]].concat()).ok();
    assert!(
        line.starts_with("key=materials.ofhc-copper-johnson-cook"),
        "{line}"
    );
}

/// The files of a calibration: the same from the same seed, and a material that a case can use at once.
#[test]
fn the_folder_holds_a_material_that_a_case_takes() {
    let folder = TempDir::new().unwrap();
    let sample = [
        "--ensembles",
        "2",
        "--walkers",
        "4",
        "--steps",
        "30",
        "--name",
        "my-copper",
    ];
    for out in ["one", "two"] {
        calibrate(
            &folder,
            YIELD,
            &[&sample[..], &["--out", out, "-q"]].concat(),
        )
        .ok();
    }
    for file in [
        "calibration.json",
        "parameters.csv",
        "predictions.csv",
        "sample.parquet",
        "material.toml",
        "trace.svg",
        "corner.svg",
        "predictive.svg",
    ] {
        let read = |out: &str| fs::read(folder.path().join(out).join(file)).unwrap();
        assert_eq!(read("one"), read("two"), "{file}");
    }
    assert!(folder.path().join("one/corner.png").is_file());
    let case = "
material_files = ['one/material.toml']
projectile = { material = 'my-copper', length = '23.47 mm', diameter = '7.62 mm', impact_velocity = '183 m/s' }
target = { rigid_wall = true }
";
    fs::write(folder.path().join("case.toml"), case).unwrap();
    let said = percuss(
        folder.path(),
        ["run", "case.toml", "--model", "wilkins_guinan", "--json"],
    )
    .ok();
    let run = json(&said);
    let length = run["results"][0]["projectile_final_length_mm"]
        .as_f64()
        .unwrap();
    let table = fs::read_to_string(folder.path().join("one/calibration.json")).unwrap();
    let found = json(&table);
    let mut fitted = found["predictions"].as_array().unwrap().iter();
    let fitted = fitted
        .find(|value| value["impact_velocity_m_s"] == 183.0)
        .unwrap();
    let best = fitted["best"].as_f64().unwrap();
    assert!((length / best - 1.0).abs() < 1e-5, "{length} {best}");

    let card = percuss(
        folder.path(),
        ["materials", "show", "my-copper", "--case", "case.toml"],
    )
    .ok();
    assert!(
        card.contains("wilkins_guinan") && card.contains("wilkins1973"),
        "{card}"
    );
}

#[test]
fn a_case_with_experiments_is_data() {
    let folder = TempDir::new().unwrap();
    let case = "
projectile = { material = 'copper', length = '23.47 mm', diameter = '7.62 mm', impact_velocity = '183 m/s' }
target = { rigid_wall = true }
";
    fs::write(folder.path().join("case.toml"), case).unwrap();
    let fit = [
        "--fit",
        "taylor.dynamic_yield_stress=50..2000 MPa",
        "--model",
        "taylor",
    ];
    let said = percuss(
        folder.path(),
        [&["calibrate", "case.toml"], &fit[..]].concat(),
    );
    assert_eq!(said.code, 2);
    assert!(
        said.stderr.contains("the case has no measured value"),
        "{}",
        said.stderr
    );
    let measured = "[[experiments]]\nimpact_velocity = '183 m/s'\nprojectile_final_length = '16.81 mm'\nsource = 'wilkins1973'\n";
    fs::write(folder.path().join("case.toml"), format!("{case}{measured}")).unwrap();
    let said = percuss(
        folder.path(),
        [&["calibrate", "case.toml"], &fit[..]].concat(),
    );
    assert_eq!(said.code, 2);
    assert!(said.stderr.contains("their own scatter"), "{}", said.stderr);
    let more = ["--noise", "2 %", "--least-squares", "--json"];
    let found = percuss(
        folder.path(),
        [&["calibrate", "case.toml"], &fit[..], &more[..]].concat(),
    )
    .ok();
    let found = json(&found);
    assert!(found["training"]["rms"].as_f64().unwrap() < 1e-8);
}

#[test]
fn bad_input_is_answered_with_its_place() {
    let priors = "[[parameter]]\nkey = 'materials.ofhc-copper-johnson-cook.strength.johnson_cook.a'\nvalues = ['90 MPa']\n";
    let folder = folder_with(&[("priors.toml", priors)]);
    for (fit, more, words) in [
        ("a", &[][..], "there is no `=` after the key"),
        (
            "materials.ofhc-coper.density=8..9 g/cm3",
            &[],
            "did you mean",
        ),
        (
            "materials.ofhc-copper-johnson-cook.strength.johnson_cook.a=20..300 mm",
            &[],
            "`mm` is a unit of",
        ),
        ("priors.toml", &[], "priors.toml:1"),
        ("nothing.toml", &[], "there is no such file"),
        (
            YIELD,
            &["--hold-out", "nobody1999"],
            "no measured value comes from `nobody1999`",
        ),
        (YIELD, &["--noise", "stated"], "no stated uncertainty"),
        (YIELD, &["--noise", "2"], "allowed: estimated, stated"),
        (YIELD, &["--walkers", "5"], "an even number"),
        (
            YIELD,
            &["--model", "poncelet"],
            "there is no measured value to fit to",
        ),
    ] {
        let mut arguments = WILKINS.to_vec();
        if more.contains(&"--model") {
            arguments.drain(5..7);
        }
        let said = percuss(folder.path(), [&arguments[..], &[fit], more].concat());
        assert!(matches!(said.code, 2 | 4), "{fit}: {}", said.stderr);
        assert!(said.stderr.contains(words), "{fit}: {}", said.stderr);
        assert_eq!(said.stdout, "", "{fit}");
    }
}

#[cfg(unix)]
#[test]
fn an_interrupt_ends_it() {
    use std::{thread, time::Duration};

    use crate::support::{interrupt, names_in, spawn};

    let folder = TempDir::new().unwrap();
    let arguments = [
        &WILKINS[..],
        &[YIELD, "--steps", "10000000", "--out", "out"],
    ]
    .concat();
    let child = spawn(folder.path(), &arguments);
    // The handler stands before the first run of a model.
    thread::sleep(Duration::from_secs(2));
    let said = interrupt(child);
    assert!(said.contains("the calibration was stopped"), "{said}");
    assert!(said.starts_with("note: estimated cost: "), "{said}");
    assert!(names_in(&folder.path().join("out")).is_empty());
}
