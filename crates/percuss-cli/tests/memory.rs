//! Runs side by side stay within the limit of memory together.

#![cfg(target_os = "linux")]

use std::{
    process::{Command, Stdio},
    thread,
    time::{Duration, Instant},
};

use crate::support::{folder_with, memory_of};

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
