//! Mutated input of every kind: each ends with a result or with a short typed error, in limited time.
//!
//! `PERCUSS_FUZZ` sets how many inputs of each kind, `PERCUSS_SEED` which. An input that fails is written to `tests/corpus/KIND`, whose
//! files are tried again by every later run: they are the tests of what was found. `fuzz/` gives inputs to the same targets, guided by the
//! coverage that they reach.

mod http;
mod mutate;
mod oracle;
mod targets;

use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

use crate::support::Draw;
use oracle::tried;
use targets::{Target, targets};

/// Inputs of each kind, of a run that asks for no other number.
const INPUTS: u64 = 2000;
fn from_environment(name: &str, default: u64) -> u64 {
    std::env::var(name).map_or(default, |text| text.parse().unwrap())
}

fn corpus(kind: &str) -> PathBuf {
    Path::new(crate::support::TESTS).join("corpus").join(kind)
}

/// Keeps an input that failed.
fn keep(kind: &str, bytes: &[u8]) -> PathBuf {
    let hash = bytes.iter().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
    });
    let path = corpus(kind).join(format!("{hash:016x}"));
    fs::create_dir_all(corpus(kind)).unwrap();
    fs::write(&path, bytes).unwrap();
    path
}

fn attack(target: &Target) {
    let mut draw = Draw(from_environment("PERCUSS_SEED", 1));
    let mut ends: BTreeMap<&str, u64> = BTreeMap::new();
    let mut failures = Vec::new();
    for number in 0..from_environment("PERCUSS_FUZZ", INPUTS) {
        let bytes = mutate::mutated(&mut draw, &target.seeds);
        match tried(target, &bytes) {
            Ok(end) => *ends.entry(end).or_default() += 1,
            Err(what) => {
                let path = keep(target.kind, &bytes);
                failures.push(format!("input {number}, {}: {what}", path.display()));
            }
        }
        if failures.len() == 5 {
            break;
        }
    }
    println!("{}: {ends:?}", target.kind);
    assert!(
        failures.is_empty(),
        "{}:\n{}",
        target.kind,
        failures.join("\n")
    );
}

/// Whatever was ever found is tried first.
fn replay(target: &Target) {
    let mut entries: Vec<PathBuf> = fs::read_dir(corpus(target.kind))
        .into_iter()
        .flatten()
        .map(|entry| entry.unwrap().path())
        .collect();
    entries.sort();
    for path in &entries {
        if let Err(what) = tried(target, &fs::read(path).unwrap()) {
            panic!("{}: {what}", path.display());
        }
    }
    println!("{}: {} inputs of the corpus", target.kind, entries.len());
}

macro_rules! fuzz {
    ($($name:ident),* $(,)?) => {
        $(
            #[test]
            fn $name() {
                let target = targets(stringify!($name));
                let ends = target.seeds.iter().map(|seed| tried(&target, seed.as_bytes()).unwrap());
                let valid = ends.filter(|end| !matches!(*end, "refused" | "closed")).count();
                assert!(valid > 0 || target.kind == "checkpoint", "no seed is valid");
                replay(&target);
                attack(&target);
            }
        )*
    };
}

fuzz! {
    case, material_file, sweep, uncertainty, calibration, tests_of_limits, tests_of_depths, lsdyna, checkpoint, manifest, command_line, http,
}
