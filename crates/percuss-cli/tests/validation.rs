//! `validation/run`: decks of other codes from the cases of percuss, and the codes where they are installed.

use std::{
    env, fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

use serde_json::Value;
use tempfile::TempDir;

/// Environment variables that name an installed code.
const CODES: [(&str, &str); 3] = [
    ("pyko", "PYKO"),
    ("nairn", "NAIRN_MPM"),
    ("openradioss", "OPENRADIOSS_STARTER"),
];

/// A Python that can run the script: 3.11 or newer. Names the test that is skipped where there is none.
fn python(test: &str) -> Option<&'static str> {
    let check = "import sys; sys.exit(sys.version_info < (3, 11))";
    let found = Command::new("python3").args(["-c", check]).status();
    if found.is_ok_and(|status| status.success()) {
        return Some("python3");
    }
    println!("{test}: skipped: no Python 3.11 or newer");
    None
}

fn run(python: &str, work: &Path, arguments: &[&str], keep_codes: bool) -> Output {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut command = Command::new(python);
    command
        .arg(root.join("validation/run"))
        .args(arguments)
        .arg("--work")
        .arg(work)
        .env("PERCUSS", env!("CARGO_BIN_EXE_percuss"));
    if !keep_codes {
        for (_, variable) in CODES {
            command.env_remove(variable);
        }
    }
    command.output().unwrap()
}

#[test]
fn decks_have_the_constants_of_the_case_and_missing_codes_are_named() {
    let Some(python) = python("decks") else {
        return;
    };
    let work = TempDir::new().unwrap();
    let output = run(python, work.path(), &[], false);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{stderr}");
    assert!(output.stdout.is_empty());
    for (code, variable) in CODES {
        let own: Vec<&str> = stderr
            .lines()
            .filter(|line| line.starts_with(&format!("{code}: ")))
            .collect();
        assert!(own.len() >= 2, "{code}: {stderr}");
        for line in own {
            assert!(
                line.contains("skipped: ") && line.ends_with(&format!("set {variable}")),
                "{line}"
            );
        }
    }
    let read = |place: &str| fs::read_to_string(work.path().join(place)).unwrap();
    // Density, moduli and strength of the case file, in the units of the code.
    let plates = read("pyko/copper-plate-on-aluminium_500_100/deck.yml");
    let plates: Value = serde_json::from_str(&plates).unwrap();
    assert_eq!(plates["mat1"]["init"]["rho0"], 8930.0);
    assert_eq!(plates["mat1"]["init"]["up0"], 500.0);
    assert_eq!(plates["mat2"]["mesh"]["cells"], 300);
    assert_eq!(plates["mat2"]["str"]["ys"], 290e6);
    let shear = plates["mat2"]["str"]["gmod"].as_f64().unwrap();
    assert!((shear / (73.7e9 / 2.67) - 1.0).abs() < 1e-12);
    // The mean tension at an axial spall strength of 1.1933 GPa.
    let spall = read("pyko/copper-plate-on-aluminium-spall_500_50/deck.yml");
    let spall: Value = serde_json::from_str(&spall).unwrap();
    let mean = spall["mat2"]["frac"]["pfrac"].as_f64().unwrap();
    assert!((mean / 1e9 - 1.0).abs() < 1e-4, "{mean}");
    // Constants of the library.
    let rod = read("nairn/johnson-cook-rod-on-wall_190_8/deck.fmcmd");
    assert!(rod.contains("<Ajc>90</Ajc><Bjc>292</Bjc><njc>0.31</njc><Cjc>0</Cjc>"));
    assert!(rod.contains("<rho>8.96</rho>") && rod.contains("vy=\"-190000\""));
    let with_rate = read("nairn/johnson-cook-rate-rod-on-wall_190_4_method-USL/deck.fmcmd");
    assert!(with_rate.contains("<Cjc>0.025</Cjc>") && with_rate.contains("<MPMMethod>3<"));
    assert!(read("openradioss/copper-on-wall_183_0.24/rod_0000.rad").contains("UNTRIED"));
}

#[test]
fn an_unknown_code_is_refused() {
    let Some(python) = python("unknown code") else {
        return;
    };
    let work = TempDir::new().unwrap();
    let output = run(python, work.path(), &["--code", "dyna"], false);
    assert_eq!(output.status.code(), Some(2));
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(stderr.contains("invalid choice: 'dyna'"), "{stderr}");
}

/// The script compares with the stored results itself.
#[test]
fn installed_codes_give_their_stored_numbers() {
    for (code, variable) in CODES {
        if env::var_os(variable).is_none() {
            println!("{code}: skipped: {variable} is not set");
            continue;
        }
        let Some(python) = python(code) else {
            continue;
        };
        let work = TempDir::new().unwrap();
        let output = run(python, work.path(), &["--code", code], true);
        let rows = String::from_utf8_lossy(&output.stdout);
        let stderr = String::from_utf8_lossy(&output.stderr);
        println!("{rows}{stderr}");
        assert!(output.status.success() && !rows.is_empty(), "{stderr}");
    }
}
