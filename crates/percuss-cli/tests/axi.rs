//! A model of two dimensions on the command line: its files, its options, going on from a checkpoint.

use std::{fs, path::Path};

use crate::support::percuss;

const CASE: &str = r#"
projectile = { material = "copper", length = "6 mm", diameter = "4 mm", velocity = "400 m/s" }
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

#[test]
fn a_run_writes_fields_pictures_an_animation_and_shapes() {
    let folder = tempfile::tempdir().unwrap();
    let case = case(folder.path(), CASE);
    let out = folder.path().join("out");
    let shown = out.to_str().unwrap();
    let run = percuss(
        folder.path(),
        [
            "run", &*case, "--model", "axi", "--out", shown, "--field", "speed",
        ],
    );
    assert_eq!(run.code, 0, "{}", run.stderr);
    for name in [
        "result.json",
        "history.csv",
        "fields.pvd",
        "field.png",
        "crater-profile.csv",
        "projectile-shape.csv",
        "final-shape.svg",
    ] {
        assert!(out.join(name).exists(), "{name}");
    }
    let gif = fs::read(out.join("animation.gif")).unwrap();
    assert!(gif.starts_with(b"GIF89a") && gif.len() < 5_000_000);
    let count = |name: &str| fs::read_dir(out.join(name)).unwrap().count();
    assert!(count("fields") > 10 && count("fields") == count("frames"));
    assert!(!out.join("checkpoint.percuss").exists());
    let collection = fs::read_to_string(out.join("fields.pvd")).unwrap();
    assert_eq!(collection.matches("<DataSet").count(), count("fields"));
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
    let run = percuss(folder.path(), ["run", &*case, "--out", shown, "--resume"]);
    let said = run.stderr;
    assert_eq!(run.code, 2, "{said}");
    assert!(
        said.contains("`--resume` has no effect with model `chain`"),
        "{said}"
    );
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
