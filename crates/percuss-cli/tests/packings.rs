//! `percuss run --seeds`: a study over packings that is stopped.
#![cfg(unix)]

use std::{
    process::{Command, Stdio},
    thread::sleep,
    time::Duration,
};

use crate::support::{json, shot};

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
    let child = Command::new(env!("CARGO_BIN_EXE_percuss"))
        .args([
            "run",
            "shot.toml",
            "--model",
            "particles",
            "--seeds",
            "1000",
            "--json",
        ])
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    sleep(Duration::from_secs(4));
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(sent.unwrap().success());
    let output = child.wait_with_output().unwrap();
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(130), "{stderr}");
    let study = json(&String::from_utf8(output.stdout).unwrap())["seeds"].clone();
    let complete = study["seeds"].as_array().unwrap().len();
    assert!((1..1000).contains(&complete), "{complete}");
    let said = format!(
        "error: the run was stopped after {complete} of 1000 packings; their results stand"
    );
    assert!(stderr.contains(&said), "{stderr}");
}
