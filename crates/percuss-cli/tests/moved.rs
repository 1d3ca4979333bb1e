//! A folder of results that is moved away from the files that its case named, and run again by itself.

use std::{collections::BTreeMap, fs, path::Path};

use tempfile::TempDir;

use crate::support::{json, ok};

const CASE: &str = "
title = 'Rod and plate from files'
material_files = ['../library/rod.toml', '../library/plate.toml']

[projectile]
material = 'rod' # of the file
length = '20 mm'
diameter = '5 mm'
impact_velocity = '300 m/s'

[target]
material = 'plate'
thickness = '6 mm'

[chain]
projectile_elements = 10
target_elements = 8

[materials.spare]
name = 'a record of the case itself'
density = '1000 kg/m3'
youngs_modulus = '1 GPa'
poissons_ratio = 0.3
strength.perfectly_plastic.flow_stress = '1 MPa'

[[uncertainty.parameter]]
key = 'projectile.impact_velocity'
normal = { mean = '300 m/s', standard_deviation = '3 m/s' }
";
const ROD: &str = "
[rod]
name = 'rod'
density = '7850.000000000001 kg/m3'
youngs_modulus = '203.3 GPa'
poissons_ratio = 0.29
strength.perfectly_plastic.flow_stress = '611.1 MPa'
";
const PLATE: &str = "
[materials.plate]
name = 'plate'
density = '2703 kg/m3'
youngs_modulus = '71.1 GPa'
poissons_ratio = 0.33
melting_temperature = '900 K'
specific_heat = '900 J/(kg K)'

[materials.plate.strength.johnson_cook]
a = '324 MPa'
b = '114 MPa'
n = 0.42
c = 0.002
m = 1.34
";

/// Runs a command on a case in a folder that refers to files beside it.
fn results(command: &[&str]) -> TempDir {
    let work = TempDir::new().unwrap();
    for folder in ["library", "my-shot"] {
        fs::create_dir(work.path().join(folder)).unwrap();
    }
    let write = |name: &str, text: &str| fs::write(work.path().join(name), text).unwrap();
    write("library/rod.toml", ROD);
    write("library/plate.toml", PLATE);
    write("my-shot/shot.toml", CASE);
    let rest = ["my-shot/shot.toml", "--out", "results", "-q"];
    ok(work.path(), &[&command[..1], &rest, &command[1..]].concat());
    // Elsewhere, and without the files that the case named.
    let elsewhere = TempDir::new().unwrap();
    fs::rename(
        work.path().join("results"),
        elsewhere.path().join("results"),
    )
    .unwrap();
    elsewhere
}

/// Files of a folder by name, but for pictures; JSON without the name of the case, which is that of its file.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    files
        .filter_map(|file| {
            let name = file.file_name().into_string().unwrap();
            let bytes = fs::read(file.path()).unwrap();
            let bytes = match name.rsplit('.').next()? {
                "png" | "svg" => return None,
                "json" => {
                    let mut object = json(&String::from_utf8(bytes).unwrap());
                    object.as_object_mut().unwrap().remove("case").unwrap();
                    object.to_string().into_bytes()
                }
                _ => bytes,
            };
            Some((name, bytes))
        })
        .collect()
}

#[test]
fn a_moved_folder_gives_the_same_results_to_the_last_bit() {
    for command in [
        &["run", "--fast"][..],
        &["run", "--model", "fdm"],
        &["compare"],
        &[
            "limit",
            "--model",
            "plugging",
            "--model",
            "chain",
            "--tolerance",
            "20 m/s",
            "--points",
            "2",
        ],
        &["uncertainty", "--samples", "16", "--no-indices"],
    ] {
        let moved = results(command);
        let first = contents(&moved.path().join("results"));
        assert!(first.len() >= 3, "{command:?}: {:?}", first.keys());
        let case = ["results/case-as-run.toml", "--out", "again", "-q"];
        ok(
            moved.path(),
            &[&command[..1], &case, &command[1..]].concat(),
        );
        let again = contents(&moved.path().join("again"));
        assert_eq!(
            first.keys().collect::<Vec<_>>(),
            again.keys().collect::<Vec<_>>()
        );
        for (name, bytes) in &first {
            assert!(again[name] == *bytes, "{command:?}: {name} differs");
        }
    }
}
