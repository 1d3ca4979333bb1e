//! `percuss calibrate`: from tests to a material with its provenance.

use std::fs;

use tempfile::TempDir;

use crate::support::{Said, flat, folder_with, json, percuss};

const CASE: &str = include_str!("../../../cases/taylor-copper-wilkins/scenario.toml");
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

#[test]
fn an_option_of_another_model_is_no_parameter() {
    let folder = TempDir::new().unwrap();
    let said = calibrate(&folder, "chain.heat_fraction=0..1", &[]);
    assert_eq!(said.code, 2);
    let words = "model `wilkins_guinan` does not read the table `chain`";
    assert!(flat(&said.stderr).contains(words), "{}", said.stderr);
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

/// Elastic bars, one of which strikes the other, with a gauge; what follows the tables is appended.
fn bars(modulus: &str, more: &str) -> String {
    format!(
        "[projectile]
material = 'bar'
length = '40 mm'
diameter = '10 mm'
impact_velocity = '10 m/s'
[target]
material = 'bar'
thickness = '80 mm'
[[gauges]]
name = 'bar'
position = '30 mm'
[chain]
target_resistance = 'column'
border_shear = 0.0
kinematics = 'small-strain'
projectile_elements = 40
target_elements = 80
end_time = '20 us'
[materials.bar]
name = 'bar'
density = '8930 kg/m3'
youngs_modulus = '{modulus}'
poissons_ratio = 0.34
strength.elastic = {{}}
{more}"
    )
}

const MODULUS: &str = "materials.bar.youngs_modulus=60..200 GPa";
const BEST: [&str; 5] = [
    "calibrate",
    "case.toml",
    "--fit",
    MODULUS,
    "--least-squares",
];
const OF_BAR: &str = "[[measured_curves]]\nfile = 'gauge.csv'\ngauge = 'bar'\n";

/// A folder with the gauge of a run as the measured curve of a case with another modulus.
fn bar_folder(keys: &str, more: &str) -> TempDir {
    let case = bars("90 GPa", &format!("{OF_BAR}{keys}\n{more}"));
    let folder = folder_with(&[("true.toml", &bars("124 GPa", "")), ("case.toml", &case)]);
    let path = folder.path();
    percuss(path, ["run", "true.toml", "--fast", "--out", "true"]).ok();
    let gauges = fs::read_to_string(path.join("true/gauges.csv")).unwrap();
    let mut lines = gauges
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().unwrap();
    let at = |name: &str| header.iter().position(|found| *found == name).unwrap();
    let (time, stress) = (at("time_us"), at("stress_mpa"));
    let rows = lines.map(|row| format!("{},{}\n", row[time], row[stress]));
    let table = format!("time_us,stress_mpa\n{}", rows.collect::<String>());
    fs::write(path.join("gauge.csv"), table).unwrap();
    folder
}

/// The curve that a model made gives its parameter back, with the norms of `run`, in every output.
#[test]
fn a_measured_curve_is_data() {
    let folder = bar_folder("uncertainty = '2 MPa'\ncorrelation_time = '1 us'", "");
    let path = folder.path();
    let line = [
        "calibrate",
        "case.toml",
        "--fit",
        MODULUS,
        "--noise",
        "stated",
        "--ensembles",
        "2",
        "--walkers",
        "4",
        "--steps",
        "20",
    ];
    let text = percuss(path, [&line[..], &["--out", "one"]].concat()).ok();
    for words in ["case: gauge, stress", "1 (given)", "RMS diff.", "MPa"] {
        assert!(text.contains(words), "{words}: {text}");
    }
    let table = fs::read_to_string(path.join("one/calibration.json")).unwrap();
    let found = json(&table);
    let best = found["parameters"][0]["best"].as_f64().unwrap();
    assert!((best / 124.0 - 1.0).abs() < 1e-4, "{best}");
    assert!(found["training"].is_null());
    let curve = &found["curves"][0];
    let run = json(&percuss(path, ["run", "case.toml", "--fast", "--json"]).ok());
    for name in [
        "rms_difference",
        "relative_rms_difference",
        "largest_difference",
    ] {
        assert_eq!(
            curve["before"][name], run["results"][0]["measured_curves"][0][name],
            "{name}"
        );
    }
    assert!(
        curve["best"]["relative_rms_difference"].as_f64().unwrap() < 1e-3,
        "{curve}"
    );
    let rows = fs::read_to_string(path.join("one/curves.csv")).unwrap();
    assert_eq!(
        rows.lines().count(),
        1 + curve["values"].as_u64().unwrap() as usize
    );
    let figure = fs::read_to_string(path.join("one/curve-1.svg")).unwrap();
    assert!(figure.contains("before calibration") && figure.contains("measured (gauge)"));
    assert!(!path.join("one/predictive.svg").exists());
    let material = fs::read_to_string(path.join("one/material.toml")).unwrap();
    assert!(material.contains("1 measured curve of gauge"), "{material}");
    percuss(path, [&line[..], &["--out", "two", "-q"]].concat()).ok();
    for file in [
        "calibration.json",
        "curves.csv",
        "curve-1.svg",
        "sample.parquet",
    ] {
        let read = |out: &str| fs::read(path.join(out).join(file)).unwrap();
        assert_eq!(read("one"), read("two"), "{file}");
    }
}

/// A correlation time that is not stated is estimated, a source held out, and a run that does not cover all of a curve says so.
#[test]
fn a_curve_is_held_out_and_cut_with_a_warning() {
    let more = format!("{OF_BAR}name = 'again'\nsource = 'blind'\n");
    let folder = bar_folder("", &more);
    let path = folder.path();
    let mut table = fs::read_to_string(path.join("gauge.csv")).unwrap();
    table += "30,0\n40,0\n";
    fs::write(path.join("gauge.csv"), table).unwrap();
    let line = [&BEST[..], &["--hold-out", "blind", "--json"]].concat();
    let found = json(&percuss(path, line).ok());
    let curves = found["curves"].as_array().unwrap();
    let held_out: Vec<bool> = curves.iter().map(|c| c["held_out"] == true).collect();
    assert_eq!(held_out, [false, true]);
    assert_eq!(curves[0]["correlation_estimated"], true);
    let warnings = found["warnings"].to_string();
    assert!(
        warnings.contains("of `case: gauge, stress` are not used"),
        "{warnings}"
    );
}

#[test]
fn a_wrong_curve_is_refused_with_its_place() {
    for (keys, table, place, message, help) in [
        (
            "uncertainty = '0 MPa'",
            None,
            "case.toml:28",
            "`0 MPa` is not positive",
            "standard uncertainty",
        ),
        (
            "uncertainty = '-2 MPa'",
            None,
            "case.toml:28",
            "not positive",
            "standard uncertainty",
        ),
        (
            "uncertainty = '2 mm'",
            None,
            "case.toml:28",
            "`mm` is no unit of `stress`",
            "units: MPa",
        ),
        (
            "uncertainty = '2'",
            None,
            "case.toml:28",
            "the unit of `2` is missing",
            "units: MPa",
        ),
        ("uncertainty = 2", None, "case.toml:28", "", "\"5 MPa\""),
        (
            "uncertainty = { strain = '0.1' }",
            None,
            "case.toml:28",
            "no quantity `strain`",
            "quantities: stress",
        ),
        (
            "uncertainty = '2 MPa'",
            Some("time_us,stress_mpa,velocity_m_s\n0,0,0\n5,1,1\n"),
            "case.toml:28",
            "the table has 2 quantities",
            "uncertainty = { stress",
        ),
        (
            "correlation_time = '-1 us'",
            None,
            "case.toml:28",
            "out of range",
            "allowed: 0",
        ),
        (
            "",
            Some("time_us,stress_mpa\n0,0\n5,1\n3,1\n"),
            "gauge.csv:4",
            "does not come after 5",
            "sort",
        ),
        (
            "",
            Some("time_us,stress_mpa\n100,0\n110,1\n"),
            "case.toml:25",
            "the run covers 0 to 20",
            "later `end_time`",
        ),
    ] {
        let folder = bar_folder(keys, "");
        let path = folder.path();
        if let Some(table) = table {
            fs::write(path.join("gauge.csv"), table).unwrap();
        }
        let said = percuss(path, BEST);
        assert_eq!(said.code, 2, "{keys} {table:?} {}", said.stdout);
        let words = crate::support::flat(&said.stderr);
        for part in [place, message, help] {
            assert!(words.contains(part), "{part:?} is not in {words}");
        }
    }
    let folder = bar_folder("", "");
    let path = folder.path();
    let said = percuss(path, [&BEST[..], &["--noise", "stated"]].concat());
    assert_eq!(said.code, 2);
    assert!(
        said.stderr.contains("no stated uncertainty"),
        "{}",
        said.stderr
    );
    let fit = [
        "calibrate",
        "case.toml",
        "--fit",
        "taylor.dynamic_yield_stress=50..2000 MPa",
    ];
    let said = percuss(
        path,
        [&fit[..], &["--model", "taylor", "--least-squares"]].concat(),
    );
    assert_eq!(said.code, 2);
    assert!(said.stderr.contains("is left out"), "{}", said.stderr);
    let case = bars("90 GPa", &OF_BAR.replace("'bar'", "'rod'"));
    fs::write(path.join("case.toml"), case).unwrap();
    let said = percuss(path, BEST);
    assert_eq!(said.code, 2);
    let words = crate::support::flat(&said.stderr);
    assert!(
        words.contains("no gauge named `rod`") && words.contains("allowed: bar"),
        "{words}"
    );
}

#[test]
fn what_would_count_twice_is_refused() {
    let folder = folder_with(&[("scenario.toml", CASE)]);
    let fit = "materials.copper.strength.power_law.coefficient=200..700 MPa";
    let start = [
        "calibrate",
        "scenario.toml",
        "--model",
        "taylor",
        "--least-squares",
    ];
    for (more, words) in [
        (&["./scenario.toml", "--fit", fit][..], "is named twice"),
        (
            &[
                "--fit",
                fit,
                "--fit",
                "materials.copper-woodward.strength.power_law.coefficient=200..700 MPa",
            ],
            "are one number",
        ),
    ] {
        let said = percuss(folder.path(), [&start[..], more].concat());
        assert_eq!(said.code, 2, "{}", said.stderr);
        assert!(flat(&said.stderr).contains(words), "{}", said.stderr);
    }
}
