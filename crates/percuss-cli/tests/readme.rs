//! The commands of the README and of the quick start do what these say, in an empty folder; the library example is a doc test of `percuss`.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use crate::support::blocks;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn readme() -> String {
    fs::read_to_string(root().join("README.md")).unwrap()
}

fn quick_start() -> String {
    fs::read_to_string(root().join("docs/quick-start.md")).unwrap()
}

/// Lines of all blocks of a language.
fn lines(text: &str, language: &str) -> Vec<String> {
    let blocks = blocks(text, language);
    blocks
        .iter()
        .flat_map(|block| block.lines())
        .map(str::to_owned)
        .collect()
}

#[test]
fn every_percuss_command_of_the_readme_runs() {
    let folder = tempfile::tempdir().unwrap();
    // A reader stands in the clone: the cases that commands name are there.
    for name in [
        "cases/paper-table1",
        "cases/paper-table1-uncertainty",
        "cases/weldox-460e-12mm-blunt",
    ] {
        let case = folder.path().join(name);
        fs::create_dir_all(&case).unwrap();
        for file in fs::read_dir(root().join(name)).unwrap() {
            let file = file.unwrap();
            fs::copy(file.path(), case.join(file.file_name())).unwrap();
        }
    }
    let commands = lines(&readme(), "sh");
    let own: Vec<&String> = commands
        .iter()
        .filter(|line| line.starts_with("percuss "))
        .collect();
    assert!(own.len() >= 8, "{own:?}");
    for line in own {
        let output = Command::new(env!("CARGO_BIN_EXE_percuss"))
            .args(line.split_whitespace().skip(1))
            .current_dir(folder.path())
            .output()
            .unwrap();
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{line}\n{stderr}");
        assert!(!output.stdout.is_empty(), "{line} says nothing");
    }
    assert!(folder.path().join("paper/paper.md").is_file());
}

/// `.ci/run` runs these two word for word.
#[test]
fn two_commands_set_everything_up() {
    let commands = lines(&readme(), "sh");
    assert_eq!(
        commands[..2],
        [
            "cargo run --release -- run cases/paper-table1/scenario.toml --out out/paper-table1",
            "tests/run"
        ]
    );
}

#[test]
fn the_short_case_of_the_readme_runs() {
    let case = lines(&readme(), "toml").join("\n");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scenario.toml");
    fs::write(&path, case).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_percuss"))
        .arg("run")
        .arg(&path)
        .args(["--fast", "--quiet"])
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

/// The numbers that the README shows are those of a run.
#[test]
fn the_table_of_the_readme_is_real() {
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/paper-table1/scenario.toml");
    let output = Command::new(env!("CARGO_BIN_EXE_percuss"))
        .arg("run")
        .arg(case)
        .output()
        .unwrap();
    let table = String::from_utf8_lossy(&output.stdout).into_owned();
    for line in lines(&readme(), "text") {
        let is_row = [
            "outcome",
            "depth of",
            "time to",
            "final projectile",
            "peak",
            "Axisymmetric",
            "one-dimensional",
            "meshes",
            "limit",
            "fdm",
            "crater_energy",
        ]
        .iter()
        .any(|start| line.starts_with(start));
        if is_row {
            assert!(
                table.lines().any(|row| row == line),
                "`{line}` is not in\n{table}"
            );
        }
    }
}

/// A case with this slip has the error that the quick start shows.
#[test]
fn the_error_of_the_quick_start_is_real() {
    let case = lines(&readme(), "toml")
        .join("\n")
        .replace("4.8 mm", "4.8 kg");
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scenario.toml"), case).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_percuss"))
        .args(["run", "scenario.toml"])
        .current_dir(folder.path())
        .output()
        .unwrap();
    let printed = String::from_utf8_lossy(&output.stderr).into_owned();
    let shown = lines(&quick_start(), "text");
    let from = shown.iter().position(|line| line.starts_with("error"));
    for line in &shown[from.unwrap()..] {
        assert!(printed.contains(line), "`{line}` is not in\n{printed}");
    }
}

/// What the quick start shows of a comparison is what is printed.
#[test]
fn the_comparison_of_the_quick_start_is_real() {
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/paper-table1/scenario.toml");
    let output = Command::new(env!("CARGO_BIN_EXE_percuss"))
        .arg("compare")
        .arg(case)
        .output()
        .unwrap();
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    let shown = lines(&quick_start(), "text");
    let from = shown
        .iter()
        .position(|line| line.starts_with("regime "))
        .unwrap();
    let block = shown[from..]
        .iter()
        .take_while(|line| !line.starts_with("error"));
    for line in block {
        assert!(
            printed.lines().any(|row| row == line),
            "`{line}` is not in\n{printed}"
        );
    }
}
