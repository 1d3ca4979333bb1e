//! Runs side by side stay within the limit of memory together.

#![cfg(target_os = "linux")]

use std::{
    process::{Command, Stdio},
    thread,
    time::{Duration, Instant},
};

use crate::support::{flat, folder_with, memory_of};

/// Cases whose runs take 57 MiB and minutes each.
const CASE: &str = "
projectile = { material = 'copper', length = '1 m', diameter = '1 m', impact_velocity = '300 m/s' }
target = { material = 'aluminium-2024-t351', thickness = '1 m' }
axi = { cells_per_radius = 40 }
";
const SWEEP: &str = "
base = 'scenario.toml'
model = 'axi'
design = 'grid'
block_size = 1
[[parameter]]
key = 'projectile.impact_velocity'
linear = { from = '150 m/s', to = '400 m/s', count = 16 }
";

/// Memory that a run has once it computes [MiB].
const LEAST: u64 = 20;

#[test]
fn runs_side_by_side_stay_within_the_limit_together() {
    let folder = folder_with(&[("scenario.toml", CASE), ("sweep.toml", SWEEP)]);
    for arguments in [
        &["sweep", "sweep.toml", "--out", "rows", "--threads", "8"][..],
        &["limit", "scenario.toml", "--model", "axi"],
        &[
            "compare",
            "scenario.toml",
            "--model",
            "axi",
            "--velocity",
            "200..400:16",
        ],
    ] {
        let mut child = Command::new(assert_cmd::cargo::cargo_bin!("percuss"))
            .args(arguments)
            .current_dir(folder.path())
            .envs([
                ("PERCUSS_MEMORY_LIMIT", "150 MiB"),
                ("RAYON_NUM_THREADS", "8"),
            ])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        // Eight runs at once take 400 MiB a second after the first has begun, which may take long beside other programs.
        let (start, mut began, mut most) = (Instant::now(), None, 0);
        let waits = |began: Option<Instant>| match began {
            None => start.elapsed() < Duration::from_secs(60),
            Some(began) => began.elapsed() < Duration::from_secs(4),
        };
        while waits(began) && child.try_wait().unwrap().is_none() {
            most = memory_of(child.id())[1].max(most);
            if most >> 20 >= LEAST {
                began.get_or_insert(Instant::now());
            }
            thread::sleep(Duration::from_millis(20));
        }
        child.kill().unwrap();
        child.wait().unwrap();
        println!("{arguments:?}: {} MiB", most >> 20);
        assert!(
            (LEAST..200).contains(&(most >> 20)),
            "{arguments:?}: {most} bytes"
        );
    }
}

/// Exit code, standard output and error of a command under a limit of the shell and a variable of the environment.
fn under(limit: &str, variable: (&str, &str), arguments: &[&str]) -> (Option<i32>, String, String) {
    let folder = folder_with(&[("scenario.toml", crate::support::CASE)]);
    let output = Command::new("bash")
        .args(["-c", &format!("{limit} exec \"$0\" \"$@\"")])
        .arg(assert_cmd::cargo::cargo_bin!("percuss"))
        .args(arguments)
        .current_dir(folder.path())
        .env(variable.0, variable.1)
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| flat(&String::from_utf8(bytes).unwrap());
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}

/// No other model answers where the default one takes too much memory, and a size has a unit.
#[test]
fn too_little_memory_is_an_error() {
    let run = ["run", "scenario.toml", "--fast", "--quiet"];
    let (code, printed, said) = under("", ("PERCUSS_MEMORY_LIMIT", "8 KiB"), &run);
    assert_eq!((code, printed.as_str()), (Some(2), ""), "{said}");
    assert!(said.contains("more than the limit of 8 KiB"), "{said}");
    let (code, _, said) = under("", ("PERCUSS_MEMORY_LIMIT", "8"), &run);
    assert_eq!(code, Some(2));
    assert!(said.contains("`8` is no size"), "{said}");
}

/// Where the system gives no threads every command says so.
#[test]
fn threads_that_cannot_be_started_are_an_error() {
    for arguments in [
        &["run", "scenario.toml", "--fast"][..],
        &["limit", "scenario.toml"],
        &["compare", "scenario.toml"],
        &["serve", "--port", "0"],
    ] {
        let few = ("RAYON_NUM_THREADS", "1000");
        let (code, _, said) = under("ulimit -v 400000;", few, arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {said}");
        assert!(said.contains("cannot start the threads"), "{said}");
        let many = ("RAYON_NUM_THREADS", "100000");
        let (code, _, said) = under("", many, arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {said}");
        assert!(said.contains("allowed: 1 to 1024"), "{said}");
    }
}
