//! Fields and checkpoints of one-dimensional runs in a folder.

use std::fs;
#[cfg(target_os = "linux")]
use std::path::Path;

use crate::support::{CASE, ok, percuss, shot};

#[test]
fn a_series_of_rectangles_is_written_on_request() {
    let folder = shot(CASE);
    for (model, least) in [("chain", 10), ("fdm", 10)] {
        let arguments = [
            "run",
            "--fast",
            "shot.toml",
            "--model",
            model,
            "--out",
            model,
            "--fields",
        ];
        ok(folder.path(), &arguments);
        let out = folder.path().join(model);
        let collection = fs::read_to_string(out.join("fields.pvd")).unwrap();
        let frames = collection.matches("<DataSet").count();
        assert!((least..=64).contains(&frames), "{model}: {frames}");
        let (_, last) = collection.rsplit_once("file=\"").unwrap();
        let (last, _) = last.split_once('"').unwrap();
        let file = fs::read(out.join(last)).unwrap();
        let text = String::from_utf8_lossy(&file);
        assert!(
            text.contains("<CellData Scalars=\"plastic_strain\">"),
            "{text}"
        );
        for name in ["field.vtp", "field.png", "checkpoint.percuss"] {
            assert!(!out.join(name).exists(), "{model}: {name}");
        }
    }
}

#[cfg(unix)]
#[test]
fn a_run_that_is_interrupted_continues_with_the_same_numbers() {
    use std::{thread::sleep, time::Duration};

    use crate::support::{flat, interrupt, spawn};

    // A few seconds on the column: long enough to be interrupted.
    let case = r#"
        projectile = { material = "copper", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "230 m/s" }
        target = { material = "aluminium-2024-t351", thickness = "25 mm" }
        chain = { target_resistance = "column", projectile_elements = 1500, target_elements = 3000 }
        "#;
    let folder = shot(case);
    let run = |out: &'static str| {
        [
            "run",
            "--fast",
            "shot.toml",
            "--model",
            "chain",
            "--out",
            out,
        ]
    };
    let child = spawn(folder.path(), &run("out"));
    // Its copy of the case is written before the run begins.
    while !folder.path().join("out/case-as-run.toml").exists() {
        sleep(Duration::from_millis(10));
    }
    sleep(Duration::from_millis(300));
    let said = flat(&interrupt(child));
    assert!(said.contains("--resume"), "{said}");
    let out = folder.path().join("out");
    assert!(out.join("checkpoint.percuss").exists() && !out.join("result.json").exists());
    let arguments = [&run("out")[..], &["--resume"]].concat();
    let said = percuss(folder.path(), &arguments);
    assert_eq!(said.code, 0, "{}", said.stderr);
    assert!(said.stderr.contains("continuing from"), "{}", said.stderr);
    assert!(!out.join("checkpoint.percuss").exists());
    ok(folder.path(), &run("whole"));
    for name in ["result.json", "history.csv"] {
        let of = |out: &str| fs::read(folder.path().join(out).join(name)).unwrap();
        assert!(of("out") == of("whole"), "{name}");
    }
}

/// Calls with which a command puts files on the disk and gives them their names; `None` where `strace` is missing.
#[cfg(target_os = "linux")]
fn disk_calls(folder: &Path, arguments: &[&str]) -> Option<String> {
    let traced = std::process::Command::new("strace")
        .args(["-f", "-y", "-o", "calls", "-e"])
        .arg("trace=fsync,rename,renameat,renameat2")
        .arg(env!("CARGO_BIN_EXE_percuss"))
        .args(arguments)
        .current_dir(folder)
        .output();
    let calls = fs::read_to_string(folder.join("calls")).unwrap_or_default();
    // It says how the program ended, unless it may not trace.
    let (true, Ok(traced)) = (calls.contains("exited with"), traced) else {
        println!("no strace here");
        return None;
    };
    assert!(traced.status.success(), "{arguments:?}: {traced:?}");
    Some(calls)
}

/// No file has its name before its content is on the disk.
#[cfg(target_os = "linux")]
#[test]
fn results_outlive_a_loss_of_power() {
    let uncertainty = "[[uncertainty.parameter]]\nkey = 'projectile.impact_velocity'\n\
        normal = { mean = '230 m/s', standard_deviation = '3 m/s' }\n";
    let folder = shot(&format!("{CASE}\n{uncertainty}"));
    for (arguments, least) in [
        (&["run", "shot.toml", "--fast"][..], 10),
        (&["uncertainty", "shot.toml", "--samples", "16"], 5),
        (&["limit", "shot.toml", "--fast"], 3),
        (&["converge", "shot.toml", "--levels", "3"], 3),
    ] {
        let arguments = [arguments, &["--out", "out"]].concat();
        let Some(calls) = disk_calls(folder.path(), &arguments) else {
            return;
        };
        let mut on_disk: Vec<&str> = Vec::new();
        let mut named = 0;
        for call in calls.lines() {
            let file = call
                .split(['"', '<', '>'])
                .find(|part| part.ends_with(".tmp"));
            let file = file.and_then(|path| path.rsplit('/').next());
            let Some(file) = file else { continue };
            if call.contains("fsync(") {
                on_disk.push(file);
            } else if call.contains("rename") {
                assert!(on_disk.contains(&file), "{arguments:?}: {call}");
                named += 1;
            }
        }
        assert!(named >= least, "{arguments:?}: {named}");
    }
}

/// A checkpoint is on the disk before its name is, and its name before the run goes on. Where `strace` is missing nothing is tried.
#[cfg(target_os = "linux")]
#[test]
fn a_checkpoint_outlives_a_loss_of_power() {
    let case = r#"
        projectile = { material = "copper", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "230 m/s" }
        target = { material = "aluminium-2024-t351", thickness = "25 mm" }
        chain = { target_resistance = "column", projectile_elements = 300, target_elements = 600 }
        "#;
    let folder = shot(case);
    let run = [
        "run",
        "shot.toml",
        "--fast",
        "--model",
        "chain",
        "--out",
        "out",
        "--checkpoint",
        "0.01s",
    ];
    let Some(calls) = disk_calls(folder.path(), &run) else {
        return;
    };
    let calls: Vec<&str> = calls
        .lines()
        .filter(|call| call.contains("fsync(") || call.contains("checkpoint.percuss"))
        .collect();
    let renames: Vec<usize> = (0..calls.len())
        .filter(|i| calls[*i].contains("rename"))
        .collect();
    assert!(!renames.is_empty(), "{calls:#?}");
    for i in renames {
        let [before, after] = [i.checked_sub(1), i.checked_add(1)]
            .map(|i| i.and_then(|i| calls.get(i)).copied().unwrap_or_default());
        assert!(
            before.contains("fsync(") && before.contains(".tmp>"),
            "{before}\n{}",
            calls[i]
        );
        assert!(
            after.contains("fsync(") && after.contains("/out>"),
            "{}\n{after}",
            calls[i]
        );
    }
}

/// The program with another number for its version in all of its texts.
#[cfg(target_os = "linux")]
fn of_another_version(folder: &std::path::Path) -> std::path::PathBuf {
    let version = env!("CARGO_PKG_VERSION");
    let (start, _) = version.rsplit_once('.').unwrap();
    let other = start.replace(|c: char| c.is_ascii_digit(), "9");
    let (start, other) = (format!("{start}."), format!("{other}."));
    let mut program = fs::read(env!("CARGO_BIN_EXE_percuss")).unwrap();
    let mut place = 0;
    while place + start.len() <= program.len() {
        if &program[place..place + start.len()] == start.as_bytes() {
            program[place..place + start.len()].copy_from_slice(other.as_bytes());
        }
        place += 1;
    }
    let path = folder.join("another-version");
    fs::copy(env!("CARGO_BIN_EXE_percuss"), &path).unwrap();
    fs::write(&path, program).unwrap();
    path
}

#[cfg(target_os = "linux")]
#[test]
fn what_another_version_began_is_refused_and_kept() {
    let folder = shot(CASE);
    let path = folder.path();
    let program = of_another_version(path);
    let sweep = "base = 'shot.toml'\nmodel = 'crater_energy'\nsamples = 4\ndesign = 'sobol'\n[[parameter]]\nkey = 'projectile.impact_velocity'\nuniform = { from = '100 m/s', to = '300 m/s' }\n";
    fs::write(path.join("sweep.toml"), sweep).unwrap();
    let arguments = ["sweep", "sweep.toml", "--out", "rows", "--quiet"];
    let began = std::process::Command::new(&program)
        .args(arguments)
        .current_dir(path)
        .status();
    assert!(began.unwrap().success());
    let manifest = fs::read(path.join("rows/manifest.json")).unwrap();
    let said = percuss(path, [&arguments[..], &["--resume"]].concat());
    assert_eq!(said.code, 2, "{}", said.stderr);
    assert!(
        said.stderr.contains("its `percuss_version` is \"9.9."),
        "{}",
        said.stderr
    );
    assert_eq!(fs::read(path.join("rows/manifest.json")).unwrap(), manifest);
}
