//! Tables in other unit systems.

use std::fs;

use crate::support::{CASE, flat, folder_with, ok, percuss, shot};

const SWEEP: &str = "base = 'shot.toml'\nmodel = 'chain'\ndesign = 'grid'\n\
                     [[parameter]]\nkey = 'projectile.impact_velocity'\nvalues = ['200 m/s', '230 m/s']\n";

/// First number of a column of a table.
fn first(table: &str, column: &str) -> f64 {
    let mut lines = table
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().unwrap();
    let at = header.iter().position(|name| *name == column);
    let at = at.unwrap_or_else(|| panic!("{column} is not in {header:?}"));
    lines.next().unwrap()[at].parse().unwrap()
}

#[test]
fn histories_are_written_in_the_units_of_a_system() {
    let folder = shot(CASE);
    let path = folder.path();
    ok(path, &["run", "shot.toml", "--fast", "--out", "own"]);
    let own = fs::read_to_string(path.join("own/history.csv")).unwrap();
    assert_eq!(first(&own, "tip_velocity_m_s"), 230.0);
    for (system, velocity, expected) in [
        ("SI", "tip_velocity_m_s", 230.0),
        ("mm-ms-kN", "tip_velocity_mm_ms", 230.0),
        ("cm-g-us", "tip_velocity_cm_us", 0.023),
        ("in-lb-s", "tip_velocity_in_s", 230.0 / 0.0254),
    ] {
        ok(
            path,
            &[
                "run",
                "shot.toml",
                "--fast",
                "--out",
                system,
                "--units",
                system,
            ],
        );
        let table = fs::read_to_string(path.join(system).join("history.csv")).unwrap();
        let found = first(&table, velocity);
        assert!((found / expected - 1.0).abs() < 1e-12, "{system}: {found}");
        assert_eq!(table.lines().count(), own.lines().count());
        // What JSON says has the units of its names.
        let results = |folder: &str| fs::read(path.join(folder).join("result.json")).unwrap();
        assert_eq!(results(system), results("own"));
    }
}

#[test]
fn units_without_a_table_and_unknown_ones_are_refused() {
    let folder = folder_with(&[("shot.toml", CASE), ("sweep.toml", SWEEP)]);
    let path = folder.path();
    for command in ["run", "compare"] {
        let said = percuss(path, [command, "shot.toml", "--units", "SI"]);
        assert_eq!(said.code, 2);
        assert!(flat(&said.stderr).contains("--out"), "{}", said.stderr);
    }
    ok(path, &["sweep", "sweep.toml", "--out", "rows"]);
    let merge = ["sweep", "merge", "rows", "--out", "a.parquet", "--units"];
    ok(path, &[&merge[..], &["in-lb-s"]].concat());
    let bytes = fs::read(path.join("a.parquet")).unwrap();
    let has = |name: &str| {
        bytes
            .windows(name.len())
            .any(|part| part == name.as_bytes())
    };
    assert!(has("depth_of_penetration_in") && has("energy_residual"));
    let said = percuss(path, [&merge[..], &["furlong"]].concat());
    assert_eq!(said.code, 2);
    assert!(flat(&said.stderr).contains("in-lb-s"), "{}", said.stderr);
}
