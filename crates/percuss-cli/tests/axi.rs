//! A model of two dimensions on the command line: its files, its options, going on from a checkpoint.

use std::{
    fs,
    path::{Path, PathBuf},
};

use crate::support::{flat, percuss};

const CASE: &str = r#"
projectile = { material = "copper", length = "6 mm", diameter = "4 mm", impact_velocity = "400 m/s" }
target = { material = "aluminium-2024-t351", thickness = "4 mm" }
[axi]
cells_per_radius = 3
target_radius = "8 mm"
end_time = "2 us"
"#;

fn case(folder: &Path, text: &str) -> String {
    let path = folder.join("scenario.toml");
    fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

/// Runs the case by model `axi` with further options, into a folder that it returns.
fn written(folder: &Path, options: &[&str]) -> PathBuf {
    let case = case(folder, CASE);
    let out = folder.join("out");
    let shown = out.to_str().unwrap();
    let line = ["run", &*case, "--model", "axi", "--out", shown];
    let run = percuss(folder, line.iter().chain(options));
    assert_eq!(run.code, 0, "{}", run.stderr);
    out
}

fn files_in(folder: &Path) -> usize {
    fs::read_dir(folder).unwrap().count()
}

#[test]
fn a_run_writes_its_shapes_and_the_field_at_the_end_and_no_more() {
    let folder = tempfile::tempdir().unwrap();
    let out = written(folder.path(), &["--field", "speed"]);
    for name in [
        "result.json",
        "history.csv",
        "field.vtp",
        "crater-profile.csv",
        "projectile-shape.csv",
        "final-shape.svg",
    ] {
        assert!(out.join(name).exists(), "{name}");
    }
    let picture = fs::read(out.join("field.png")).unwrap();
    assert!(picture.starts_with(b"\x89PNG") && picture.len() > 10_000);
    for name in [
        "fields.pvd",
        "fields",
        "frames",
        "animation.gif",
        "checkpoint.percuss",
    ] {
        assert!(!out.join(name).exists(), "{name}");
    }
}

#[test]
fn a_series_of_fields_is_written_on_request() {
    let folder = tempfile::tempdir().unwrap();
    let out = written(folder.path(), &["--fields"]);
    let series = files_in(&out.join("fields"));
    assert!((10..=64).contains(&series), "{series}");
    let collection = fs::read_to_string(out.join("fields.pvd")).unwrap();
    assert_eq!(collection.matches("<DataSet").count(), series);
    assert!(!out.join("frames").exists() && !out.join("animation.gif").exists());
    // The last frame of the series is the field at the end.
    let (_, last) = collection.rsplit_once("file=\"").unwrap();
    let (last, _) = last.split_once('"').unwrap();
    assert_eq!(
        fs::read(out.join(last)).unwrap(),
        fs::read(out.join("field.vtp")).unwrap()
    );
}

#[test]
fn an_animation_is_written_on_request_with_a_number_of_frames() {
    let folder = tempfile::tempdir().unwrap();
    let out = written(folder.path(), &["--animation", "--frames", "8"]);
    let gif = fs::read(out.join("animation.gif")).unwrap();
    assert!(gif.starts_with(b"GIF89a") && gif.len() < 1_000_000);
    let frames = files_in(&out.join("frames"));
    assert!((4..=8).contains(&frames), "{frames}");
    assert!(!out.join("fields").exists() && !out.join("fields.pvd").exists());
}

#[test]
fn dumps_are_written_on_request() {
    let folder = tempfile::tempdir().unwrap();
    let out = written(folder.path(), &["--dump", "--frames", "8"]);
    assert!((4..=8).contains(&files_in(&out.join("dump"))));
    assert!(!out.join("fields").exists() && !out.join("fields.pvd").exists());
}

#[test]
fn a_checkpoint_of_something_else_is_refused_in_words() {
    let folder = tempfile::tempdir().unwrap();
    let case = case(folder.path(), CASE);
    let out = folder.path().join("out");
    fs::create_dir(&out).unwrap();
    fs::write(out.join("checkpoint.percuss"), "something").unwrap();
    let shown = out.to_str().unwrap();
    let run = percuss(
        folder.path(),
        ["run", &*case, "--model", "axi", "--out", shown, "--resume"],
    );
    let said = run.stderr;
    assert_eq!(run.code, 2, "{said}");
    assert!(
        said.contains("no checkpoint of percuss") && said.contains("without `--resume`"),
        "{said}"
    );
    assert!(!out.join("case-as-run.toml").exists());
}

#[test]
fn options_of_fields_are_refused_where_there_are_none() {
    let folder = tempfile::tempdir().unwrap();
    let case = case(folder.path(), CASE);
    let shown = folder.path().join("out");
    let shown = shown.to_str().unwrap();
    let chain = "whose fields are one-dimensional";
    let formula = "which does not step through time";
    for (model, option, why) in [
        ("chain", "--animation", chain),
        ("chain", "--dump", chain),
        ("chain", "--field=speed", chain),
        ("tate", "--animation", formula),
        ("tate", "--resume", formula),
        ("tate", "--fields", formula),
        ("tate", "--frames=10", formula),
    ] {
        let run = percuss(
            folder.path(),
            ["run", &*case, "--model", model, "--out", shown, option],
        );
        let said = run.stderr;
        assert_eq!(run.code, 2, "{said}");
        let name = option.split('=').next().unwrap();
        let expected = format!("`{name}` has no effect with model `{model}`, {why}");
        assert!(
            said.contains(&expected) && said.contains("--model axi"),
            "{said}"
        );
    }
    let axi = ["run", &*case, "--model", "axi"];
    let run = percuss(
        folder.path(),
        axi.iter().chain(&["--out", shown, "--frames", "9"]),
    );
    let said = run.stderr;
    assert_eq!(run.code, 2, "{said}");
    assert!(
        said.contains("`--frames` has no effect without `--fields`, `--animation` or `--dump`"),
        "{said}"
    );
    for given in [
        &["--fields"][..],
        &["--animation", "--out", shown, "--frames", "1"][..],
    ] {
        let run = percuss(folder.path(), axi.iter().chain(given));
        assert_eq!(run.code, 2, "{given:?}: {}", run.stderr);
    }
    let run = percuss(
        folder.path(),
        ["run", &*case, "--model", "axi", "--field", "speed"],
    );
    assert_eq!(run.code, 2);
    let run = percuss(
        folder.path(),
        [
            "run",
            &*case,
            "--model",
            "axi",
            "--out",
            shown,
            "--checkpoint",
            "60",
        ],
    );
    let said = run.stderr;
    assert!(said.contains("for example 60s"), "{said}");
}

/// What a study refines is what its table and its figures have.
#[test]
fn a_study_of_meshes_counts_cells_per_radius() {
    let folder = tempfile::tempdir().unwrap();
    let path = case(folder.path(), &format!("title = 'A short rod'\n{CASE}"));
    let out = folder.path().join("out");
    let out = out.to_str().unwrap();
    let line = [
        "converge", &*path, "--model", "axi", "--levels", "3", "--out", out,
    ];
    let study = percuss(folder.path(), line);
    assert_eq!(study.code, 0, "{}", study.stderr);
    assert!(
        flat(&study.stdout).contains("cells per"),
        "{}",
        study.stdout
    );
    assert!(!study.stdout.contains("elements"), "{}", study.stdout);
    let json = fs::read_to_string(format!("{out}/convergence.json")).unwrap();
    assert!(json.contains("\"cells_per_radius\": 12"), "{json}");
    for entry in fs::read_dir(out).unwrap() {
        let file = entry.unwrap().path();
        if file.extension().is_some_and(|end| end == "svg") {
            let svg = fs::read_to_string(&file).unwrap();
            assert!(svg.contains("Cells per radius of the projectile"));
            assert!(svg.contains("A short rod; "), "{}", file.display());
        }
    }
}

#[test]
fn a_gap_is_refused_with_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let layers = "layers = [{ material = \"4340\", thickness = \"4 mm\" }, { material = \"4340\", thickness = \"4 mm\", gap = \"9 mm\" }]";
    let plate = "material = \"aluminium-2024-t351\", thickness = \"4 mm\"";
    let path = case(folder.path(), &CASE.replace(plate, layers));
    let run = percuss(folder.path(), ["run", &*path, "--model", "axi"]);
    assert_eq!(run.code, 2, "{}", run.stderr);
    let said = flat(&run.stderr);
    assert!(said.contains("without a gap"), "{said}");
    assert!(
        said.contains("help: use the model `chain`, or give one layer"),
        "{said}"
    );
}

/// A case that would fill the machine is refused before anything is allocated; the limit is the user's.
#[test]
fn a_run_that_would_fill_the_memory_is_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    for (length, diameter) in [("50 m", "5 mm"), ("100 m", "10 um")] {
        let long = CASE
            .replace("6 mm", length)
            .replacen("4 mm", diameter, 1)
            .replace("cells_per_radius = 3", "cells_per_radius = 16");
        let path = case(folder.path(), &long);
        let run = percuss(folder.path(), ["run", &*path, "--model", "axi"]);
        assert_eq!(run.code, 2, "{}", run.stderr);
        let said = flat(&run.stderr);
        assert!(said.contains("more than the limit of 4 GiB"), "{said}");
        assert!(said.contains("set PERCUSS_MEMORY_LIMIT"), "{said}");
    }
    let path = case(folder.path(), CASE);
    let limited = |limit: &str| {
        let output = std::process::Command::new(assert_cmd::cargo::cargo_bin!("percuss"))
            .args(["run", &*path, "--model", "axi"])
            .env("PERCUSS_MEMORY_LIMIT", limit)
            .output()
            .unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        (output.status.code(), flat(&said))
    };
    assert_eq!(limited("100 MiB"), (Some(0), String::new()));
    let (code, said) = limited("100 KiB");
    assert_eq!(code, Some(2));
    assert!(said.contains("more than the limit of 100 KiB"), "{said}");
    let (code, said) = limited("plenty");
    assert_eq!(code, Some(2));
    assert!(said.contains("`plenty` is no size"), "{said}");
}
