//! Option `--figure-width`: every figure of every command that has it is so wide.

use std::{fs, path::Path};

use crate::support::{CASE, folder_with, percuss};

const PLATE: &str = include_str!("../../../cases/weldox-460e-12mm-blunt/scenario.toml");

const SWEEP: &str = r#"
base = "case.toml"
model = "chain"
design = "grid"

[[parameter]]
key = "projectile.impact_velocity"
values = ["200 m/s", "230 m/s"]
"#;

const SPREAD: &str = r#"
[uncertainty]
[[uncertainty.parameter]]
key = "projectile.impact_velocity"
uniform = { from = "220 m/s", to = "240 m/s" }
"#;

/// Widths of the figures in a folder [px].
fn widths(folder: &Path) -> Vec<f64> {
    let mut widths = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|suffix| suffix == "svg") {
            let svg = fs::read_to_string(&path).unwrap();
            let width = svg.split(" width=\"").nth(1).unwrap();
            widths.push(width.split('"').next().unwrap().parse().unwrap());
        }
    }
    widths
}

#[test]
fn every_command_draws_figures_of_the_width_that_is_asked_for() {
    let spread = format!("{CASE}{SPREAD}");
    let folder = folder_with(&[
        ("case.toml", CASE),
        ("plate.toml", PLATE),
        ("sweep.toml", SWEEP),
        ("spread.toml", &spread),
    ]);
    let rows = percuss(
        folder.path(),
        ["sweep", "sweep.toml", "--out", "rows", "-q"],
    );
    assert_eq!(rows.code, 0, "{}", rows.stderr);
    for (name, words) in [
        ("run", "run case.toml --fast -q"),
        ("compare", "compare case.toml --velocity 200,230"),
        ("limit", "limit plate.toml --fast --model plugging"),
        ("converge", "converge case.toml"),
        ("uncertainty", "uncertainty spread.toml --samples 16 -q"),
        ("materials", "materials compare copper lead"),
        ("sweep", "sweep plot rows"),
        (
            "calibrate",
            "calibrate --data builtin --source wilkins1973 --model wilkins_guinan --steps 8 --walkers 8 --fit materials.ofhc-copper-johnson-cook.strength.johnson_cook.a=20..300MPa",
        ),
    ] {
        let more = ["--out", name, "--figures", "svg", "--figure-width", "91 mm"];
        let words: Vec<&str> = words.split(' ').chain(more).collect();
        let said = percuss(folder.path(), &words);
        assert_eq!(said.code, 0, "{name}: {}", said.stderr);
        let widths = widths(&folder.path().join(name));
        assert!(!widths.is_empty(), "{name}");
        assert!(
            widths.iter().all(|width| *width == 430.0),
            "{name}: {widths:?}"
        );
    }
}

#[test]
fn other_widths_are_refused_with_those_allowed() {
    let folder = folder_with(&[("case.toml", CASE)]);
    for (width, part) in [
        ("88", "unit"),
        ("2 m", "allowed are 60 mm to 182 mm"),
        ("88 kg", "mm"),
    ] {
        let words = ["run", "case.toml", "--out", "out", "--figure-width", width];
        let said = percuss(folder.path(), words);
        assert_eq!(said.code, 2);
        assert!(said.stderr.contains(part), "{}", said.stderr);
        assert!(!folder.path().join("out").exists());
    }
}
