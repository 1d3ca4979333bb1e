//! `percuss compare`: every model on one case.

use std::fs;

use tempfile::TempDir;

use crate::support::{Said, flat, json, percuss, shot};

const TAYLOR: &str = "
projectile = { material = 'ofhc-copper', length = '23.47 mm', diameter = '7.62 mm', impact_velocity = '183 m/s' }
target = { rigid_wall = true }
chain = { projectile_elements = 20 }
[[experiments]]
impact_velocity = '89 m/s'
projectile_final_length = '21.01 mm'
source = 'wilkins1973'
[[experiments]]
impact_velocity = '183 m/s'
projectile_final_length = '16.81 mm'
uncertainty = '0.1 mm'
source = 'wilkins1973'
";
/// An ogive that no more than one kind of model takes.
const OGIVE: &str = "
projectile = { material = '4340', length = '60 mm', diameter = '7.62 mm', impact_velocity = '600 m/s', nose = { ogive = { crh = 3.0 } } }
target = { material = 'aluminium-2024-t351', thickness = '50 mm' }
";

fn compare(folder: &TempDir, arguments: &[&str]) -> Said {
    percuss(
        folder.path(),
        [&["compare", "shot.toml"], arguments].concat(),
    )
}

#[track_caller]
fn ok(folder: &TempDir, arguments: &[&str]) -> String {
    compare(folder, arguments).ok()
}

#[test]
fn the_table_starts_with_regime_and_recommendation() {
    let folder = shot(TAYLOR);
    let text = ok(&folder, &[]);
    for part in [
        "case shot, impact at 183 m/s",
        "\nregime       deforming projectile, a rigid wall: ",
        "\nrecommended  chain: ",
        "length          [%]",
        "difference",
        "\n chain ★ ",
        "16.81 ± 0.1",
    ] {
        assert!(text.contains(part), "{part:?} is not in:\n{text}");
    }
    assert!(text.find("regime") < text.find("chain ★"));
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
}

#[test]
fn a_sweep_has_one_row_per_velocity() {
    let folder = shot(TAYLOR);
    let text = ok(&folder, &["--velocity", "89..183:3"]);
    for part in [
        "3 velocities, 89 to 183 m/s",
        "\n      136 ",
        "difference from experiment [%]",
    ] {
        assert!(text.contains(part), "{part:?} is not in:\n{text}");
    }
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    let measured = json(&ok(&folder, &["--velocity", "experiments", "--json"]));
    let speeds: Vec<f64> = measured["regime"]
        .as_array()
        .unwrap()
        .iter()
        .map(|at| at["impact_velocity_m_s"].as_f64().unwrap())
        .collect();
    assert_eq!(speeds, [89.0, 183.0]);
}

#[test]
fn json_extends_the_object_of_run() {
    let folder = shot(TAYLOR);
    let said = percuss(folder.path(), ["run", "--fast", "shot.toml", "--json"]);
    let run = json(&said.stdout);
    let object = json(&ok(&folder, &["--json"]));
    for key in ["case", "percuss_version"] {
        assert_eq!(object[key], run[key]);
    }
    let chain = object["results"]
        .as_array()
        .unwrap()
        .iter()
        .find(|r| r["model"] == "chain");
    assert_eq!(*chain.unwrap(), run["results"][0]);
    assert_eq!(object["regime"][0]["projectile"], "deforming");
    assert_eq!(object["regime"][0]["target"], "rigid_wall");
    let recommended = object["recommended"][0]["models"].as_array().unwrap();
    let names: Vec<_> = recommended
        .iter()
        .map(|choice| choice["model"].as_str())
        .collect();
    assert_eq!(names, [Some("axi"), Some("chain")]);
    assert_eq!(object["quantities"][0], "projectile_final_length_mm");
    assert_eq!(
        object["experiments"][1]["uncertainty"]
            .as_f64()
            .map(|u| (u * 1e6).round()),
        Some(1e5)
    );
    let sweep = json(&ok(
        &folder,
        &["--json", "--velocity", "89,183", "--model", "chain"],
    ));
    assert_eq!(sweep["results"].as_array().unwrap().len(), 2);
    assert_eq!(sweep["results"][1], run["results"][0]);
}

#[test]
fn a_model_that_does_not_apply_says_why() {
    let folder = shot(OGIVE);
    let said = compare(&folder, &["--model", "chain"]);
    assert_eq!((said.code, said.stdout.as_str()), (2, ""));
    assert!(
        said.stderr
            .starts_with("error: no model gives a result for this case\n"),
        "{}",
        said.stderr
    );
    assert!(
        said.stderr
            .contains("  chain: not applicable, because it takes flat noses"),
        "{}",
        said.stderr
    );
    let said = compare(&folder, &["--model", "chain", "--json"]);
    assert_eq!(said.code, 2);
    let result = &json(&said.stdout)["results"][0];
    assert_eq!(result["outcome"], "not_applicable");
    assert!(
        result["reason"]
            .as_str()
            .unwrap()
            .starts_with("it takes flat noses")
    );
    assert!(result["depth_of_penetration_mm"].is_null());
}

#[test]
fn a_folder_holds_numbers_and_figure() {
    let folder = shot(TAYLOR);
    let text = ok(&folder, &["--velocity", "89,183", "--out", "deep/out"]);
    for name in [
        "case-as-run.toml",
        "compare.json",
        "compare.csv",
        "compare.parquet",
        "compare.svg",
        "compare.png",
    ] {
        let file = format!("deep/out/{name}");
        assert!(text.contains(&file), "{text}");
        assert!(folder.path().join(&file).is_file(), "{file}");
    }
    let written = fs::read_to_string(folder.path().join("deep/out/compare.json")).unwrap();
    assert_eq!(written, ok(&folder, &["--velocity", "89,183", "--json"]));
    let said = compare(&folder, &["--out", "shot.toml"]);
    assert_eq!((said.code, said.stdout.as_str()), (4, ""));
}

#[test]
fn quiet_is_a_line_a_speed_and_model() {
    let folder = shot(TAYLOR);
    let text = ok(
        &folder,
        &["--quiet", "--velocity", "89,183", "--model", "chain"],
    );
    assert_eq!(text.lines().count(), 2);
    for (line, speed) in text.lines().zip(["89", "183"]) {
        assert!(
            line.starts_with(&format!("model=chain impact_velocity_m_s={speed} outcome=")),
            "{line}"
        );
        assert!(line.contains(" depth_of_penetration_mm=null "), "{line}");
    }
}

#[test]
fn speeds_that_are_none_are_refused_with_what_is_allowed() {
    let folder = shot(OGIVE);
    for (speeds, words) in [
        ("fast", "`fast` is not a number"),
        ("200..1500", "the range has no number of velocities"),
        ("1500..200:27", "not above its start"),
        ("200..1500:1", "`1` is not a number of velocities"),
        ("200 knots", "`knots` is not a unit of velocity"),
        ("20 km/s", "20000 m/s is out of range"),
        ("-5", "-5 m/s is out of range"),
    ] {
        let said = compare(&folder, &["--velocity", speeds]);
        assert_eq!((said.code, said.stdout.as_str()), (2, ""), "{speeds}");
        assert!(said.stderr.contains(words), "{speeds}: {}", said.stderr);
    }
    let said = compare(&folder, &["--velocity", "experiments"]);
    assert_eq!(said.code, 2);
    assert!(
        said.stderr
            .contains("the case has no experiments with a velocity"),
        "{}",
        said.stderr
    );
    let said = compare(&folder, &["--model", "chian"]);
    assert_eq!(said.code, 2);
}

#[test]
fn a_failure_is_told_and_named() {
    // Elements that never erode are compressed to nothing at this speed.
    let case = "projectile = { material = 'copper', length = '12.74 mm', diameter = '4.8 mm', impact_velocity = '9 km/s' }\n\
                target = { material = 'aluminium-2024-t351', thickness = 'semi-infinite' }\n\
                chain = { target_resistance = 'column', erosion_strain = 'never', courant = 1.0 }";
    let said = compare(&shot(case), &["--model", "chain"]);
    assert_eq!(said.code, 2);
    assert!(said.stderr.contains("  chain: failed: "), "{}", said.stderr);
}

#[test]
fn a_sweep_has_one_line_per_reason() {
    let text = ok(&shot(OGIVE), &["--velocity", "200..1500:14"]);
    let words = flat(&text);
    for part in [
        "not applicable at 200 to 500 m/s: it takes rigid projectiles, and this one is deforming",
        "(at 200 m/s); at 600 to 1500 m/s: it takes rigid projectiles, and this one is eroding",
    ] {
        assert!(words.contains(part), "{part:?} is not in:\n{text}");
    }
}

#[test]
fn what_a_recommended_model_gives_and_what_was_measured_is_printed() {
    let plate = "
projectile = { material = 'apm2-core', length = '27.6 mm', diameter = '6.17 mm', impact_velocity = '300 m/s', nose = { ogive = { crh = 3.0 } } }
target = { material = 'aluminium-2024-t351', thickness = '40 mm' }
[[experiments]]
impact_velocity = '200 m/s'
depth_of_penetration = '3 mm'
source = 'a'
[[experiments]]
impact_velocity = '700 m/s'
residual_velocity = '300 m/s'
source = 'a'
";
    let folder = shot(plate);
    let sweep = ok(&folder, &["--velocity", "200,900"]);
    assert!(sweep.contains("recommended  forrestal"), "{sweep}");
    assert!(sweep.contains("depth [mm]\n"), "{sweep}");
    assert!(
        sweep.contains("\n1 experiment at another velocity: `--velocity experiments`\n"),
        "{sweep}"
    );
    let own = ok(&folder, &[]);
    assert!(
        own.contains("\n2 experiments at other velocities: "),
        "{own}"
    );
    assert!(!ok(&folder, &["--velocity", "experiments"]).contains("other velocit"));
    // A limit that no model gives is shown all the same.
    let limit = format!("{BLUNT}[[experiments]]\nballistic_limit = '777 m/s'\nsource = 'a'\n");
    for speeds in ["100", "100,110"] {
        let text = ok(&shot(&limit), &["--model", "chain", "--velocity", speeds]);
        assert!(text.contains("777"), "{text}");
    }
}

/// A blunt rod on a plate that it does not perforate.
const BLUNT: &str = "
projectile = { material = 'copper', length = '12.74 mm', diameter = '4.8 mm', impact_velocity = '100 m/s' }
target = { material = 'aluminium-2024-t351', thickness = '25 mm' }
chain = { projectile_elements = 10, target_elements = 20 }
";
