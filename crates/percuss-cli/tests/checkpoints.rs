//! Fields and checkpoints of one-dimensional runs in a folder.

use std::fs;

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
    let traced = std::process::Command::new("strace")
        .args([
            "-f",
            "-y",
            "-o",
            "calls",
            "-e",
            "trace=fsync,rename,renameat,renameat2",
        ])
        .arg(env!("CARGO_BIN_EXE_percuss"))
        .args([
            "run",
            "shot.toml",
            "--fast",
            "--model",
            "chain",
            "--out",
            "out",
            "--checkpoint",
            "0.01s",
        ])
        .current_dir(folder.path())
        .output();
    if !traced.is_ok_and(|traced| traced.status.success()) {
        println!("no strace here");
        return;
    }
    let calls = fs::read_to_string(folder.path().join("calls")).unwrap();
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
