//! `percuss export` writes the input of other codes, or says why not.

use std::fs;

use crate::support::{flat, json, ok, percuss};

/// A strip on a wall, which LAMMPS takes.
const STRIP: &str = r#"
projectile = { material = "glass", length = "20 mm", diameter = "10 mm", impact_velocity = "10 m/s" }
target = { rigid_wall = true }
particles = { spacing = "1 mm" }
[materials.glass]
name = "Glass"
density = "2500 kg/m3"
youngs_modulus = "70 GPa"
poissons_ratio = 0.22
strength.elastic = {}
"#;

#[test]
fn the_folder_has_commands_data_and_what_differs() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("strip.toml"), STRIP).unwrap();
    let words = ["export", "strip.toml", "--to", "lammps", "--out", "deck"];
    let text = flat(&ok(folder.path(), &words));
    assert!(
        text.contains("steps of") && text.contains("deck/impact.in"),
        "{text}"
    );
    let said = percuss(folder.path(), [&words[..], &["--json"]].concat());
    assert_eq!(said.code, 0);
    let answer = json(&said.stdout);
    let read = |name: &str| fs::read_to_string(folder.path().join("deck").join(name)).unwrap();
    assert_eq!(answer, json(&read("export.json")));
    let bonds = &answer["bonds"];
    assert!(read("particles.data").contains(&format!("\n{bonds} bonds\n")));
    let commands = read("impact.in");
    for part in [
        "bond_style bpm/rotational",
        "wall/harmonic",
        "velocity lattice set 0 10 0",
    ] {
        assert!(commands.contains(part), "{part}");
    }
    for difference in answer["differences"].as_array().unwrap() {
        assert!(read("README.md").contains(difference.as_str().unwrap()));
    }
}

#[test]
fn a_case_that_lammps_has_not_leaves_no_folder() {
    let folder = tempfile::tempdir().unwrap();
    let breaks =
        format!("{STRIP}fracture = {{ energy = \"8 J/m2\", tensile_strength = \"40 MPa\" }}\n");
    fs::write(folder.path().join("strip.toml"), breaks).unwrap();
    let said = percuss(
        folder.path(),
        ["export", "strip.toml", "--to", "lammps", "--out", "deck"],
    );
    assert_eq!(said.code, 2);
    let message = flat(&said.stderr);
    assert!(
        message.contains("no bonds that soften") && message.contains("particles.fracture = false"),
        "{message}"
    );
    assert!(!folder.path().join("deck").exists());
}
