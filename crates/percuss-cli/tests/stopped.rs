//! Studies that are stopped keep what is complete.
#![cfg(unix)]

use std::{
    path::Path,
    process::{Command, Output, Stdio},
    thread::sleep,
    time::Duration,
};

use crate::support::{CASE, folder_with, json, ok, shot};

/// A plate of a few hundred particles, which breaks.
const PLATE: &str = r#"
projectile = { material = "hard", length = "10 mm", diameter = "6 mm", impact_velocity = "20 m/s", nose = "hemisphere" }
target = { material = "glass", thickness = "5 mm", back_face = "free" }
particles = { spacing = "0.7 mm", width = "40 mm", end_time = "40 us" }
[materials.hard]
name = "Elastic"
density = "2500 kg/m3"
youngs_modulus = "70 GPa"
poissons_ratio = 0.22
strength.elastic = {}
[materials.glass]
name = "Glass"
density = "2500 kg/m3"
youngs_modulus = "70 GPa"
poissons_ratio = 0.22
strength.elastic = {}
fracture = { energy = "8 J/m2", tensile_strength = "40 MPa" }
"#;

/// Ctrl-C between the first packing and the last one keeps those that are complete.
#[test]
fn a_stopped_study_keeps_its_complete_packings() {
    let folder = shot(PLATE);
    let options = [
        "run",
        "shot.toml",
        "--model",
        "particles",
        "--seeds",
        "1000",
    ];
    let output = stopped_after_four_seconds(folder.path(), &options);
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(130), "{stderr}");
    let study = json(&String::from_utf8(output.stdout).unwrap())["seeds"].clone();
    let complete = study["seeds"].as_array().unwrap().len();
    assert!((1..1000).contains(&complete), "{complete}");
    let said = format!(
        "error: the study was stopped after {complete} of 1000 packings; their results stand"
    );
    assert!(stderr.contains(&said), "{stderr}");
}

/// A script has means and deviations on the line of the first packing.
#[test]
fn a_quiet_study_has_means_and_deviations() {
    let folder = shot(PLATE);
    let options = ["run", "shot.toml", "--model", "particles", "--seeds", "2"];
    let line = ok(folder.path(), &[&options[..], &["--quiet"]].concat());
    let study = json(&ok(folder.path(), &[&options[..], &["--json"]].concat()))["seeds"].clone();
    assert_eq!(line.lines().count(), 1, "{line}");
    assert!(line.contains(" packings=2 "), "{line}");
    let numbers = study["numbers"].as_array().unwrap();
    let force = numbers.iter().find(|of| of["name"] == "peak_force_kn");
    for key in ["mean", "standard_deviation"] {
        let value = force.unwrap()[key].as_f64().unwrap();
        let pair = format!(" peak_force_kn_{key}={value}");
        assert!(line.contains(&pair), "{pair} is not in {line}");
    }
}

/// The same of the meshes of a study of convergence.
#[test]
fn a_stopped_study_keeps_its_complete_meshes() {
    let folder = folder_with(&[("case.toml", CASE)]);
    let options = ["converge", "case.toml", "--levels", "8", "--out", "study"];
    let output = stopped_after_four_seconds(folder.path(), &options);
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(130), "{stderr}");
    let study = json(&String::from_utf8(output.stdout).unwrap());
    let complete = study["meshes"].as_array().unwrap().len();
    assert!((1..8).contains(&complete), "{complete}");
    let depth = &study["quantities"][0]["values"];
    assert_eq!(depth.as_array().unwrap().len(), complete);
    let said =
        format!("error: the study was stopped after {complete} of 8 meshes; their results stand");
    assert!(stderr.contains(&said), "{stderr}");
    assert!(folder.path().join("study/convergence.json").is_file());
}

/// Output of a command with `--json` to which Ctrl-C comes after four seconds.
fn stopped_after_four_seconds(folder: &Path, options: &[&str]) -> Output {
    let child = Command::new(env!("CARGO_BIN_EXE_percuss"))
        .args(options)
        .arg("--json")
        .current_dir(folder)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    sleep(Duration::from_secs(4));
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(sent.unwrap().success());
    child.wait_with_output().unwrap()
}
