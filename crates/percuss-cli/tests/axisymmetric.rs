//! The axisymmetric answer of `percuss run`.

use std::fs;

use percuss::units::significant;
use serde_json::Value;

use crate::support::{flat, json, ok, percuss, shot};

/// A short rod with a small part of the target, on which the runs take a fraction of a second.
const SHORT: &str = r#"
projectile = { material = "copper", length = "5 mm", diameter = "5 mm", impact_velocity = "300 m/s" }
target = { material = "aluminium-2024-t351", thickness = "25 mm" }
chain = { projectile_elements = 10, target_elements = 20 }
axi = { target_radius = "8 mm", target_depth = "8 mm" }
"#;

fn answer(case: &str, more: &[&str]) -> Value {
    let folder = shot(case);
    let arguments = [&["run", "shot.toml", "--json"], more].concat();
    json(&ok(folder.path(), &arguments))["axisymmetric"].clone()
}

#[test]
fn the_axisymmetric_depth_is_the_headline_below_the_first_result() {
    let folder = shot(SHORT);
    let text = ok(folder.path(), &["run", "shot.toml", "--out", "out"]);
    let (first, rest) = text
        .split_once("\nAxisymmetric depth of penetration ")
        .unwrap();
    let said = first.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.contains("the number to use follows at the end: that of the axisymmetric model"));
    assert!(first.contains("depth of penetration  ") && first.contains("depth by other models"));
    // The guess of the error gives way to the difference.
    assert!(!first.contains("estimated model error"), "{text}");
    let (headline, rest) = rest.split_once('\n').unwrap();
    assert!(
        headline.contains(" ± ") && headline.ends_with(" mm: the number to use"),
        "{headline}"
    );
    for part in [
        "one-dimensional (chain)     ",
        "meshes  ",
        " mm on 3, 4 and 6 cells per",
        "outcome  ",
        "wrote\n",
    ] {
        assert!(rest.contains(part), "{part:?} is not in:\n{text}");
    }
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );

    let written = fs::read_to_string(folder.path().join("out/result.json")).unwrap();
    let written = json(&written);
    let found = &written["axisymmetric"];
    assert_eq!(*found, answer(SHORT, &[]));
    assert_eq!(found["quantity"], "depth_of_penetration_mm");
    assert_eq!(found["value"], found["depth_of_penetration_mm"]);
    let value = found["value"].as_f64().unwrap();
    let chain = written["results"][0]["depth_of_penetration_mm"]
        .as_f64()
        .unwrap();
    let difference = format!(", {:+.0} %", 100.0 * (chain / value - 1.0)).replace('-', "−");
    assert!(
        rest.lines().next().unwrap().ends_with(&difference),
        "{text}"
    );
    assert!(
        headline.starts_with(&format!("{value:.2}")[..3]),
        "{headline} {value}"
    );
}

#[test]
fn each_mesh_has_the_numbers_of_a_run_by_axi() {
    let found = answer(SHORT, &["--model", "chain", "--reference", "standard"]);
    let meshes = found["meshes"].as_array().unwrap();
    let folder = shot(&SHORT.replace("axi = {", "axi = { cells_per_radius = 6,"));
    let alone = ok(
        folder.path(),
        &["run", "shot.toml", "--json", "--model", "axi"],
    );
    let alone = json(&alone);
    assert_eq!(alone["axisymmetric"], Value::Null);
    assert_eq!(meshes.len(), 3);
    for name in [
        "depth_of_penetration_mm",
        "residual_velocity_m_s",
        "outcome",
        "steps",
    ] {
        assert_eq!(meshes[2][name], alone["results"][0][name], "{name}");
    }
}

#[test]
fn a_rigid_wall_has_the_final_length_as_headline() {
    let wall = "projectile = { material = 'ofhc-copper', length = '10 mm', diameter = '5 mm', impact_velocity = '180 m/s' }\n\
                target = { rigid_wall = true }\n";
    let text = ok(shot(wall).path(), &["run", "shot.toml"]);
    assert!(
        text.contains("\nAxisymmetric final projectile length "),
        "{text}"
    );
    let found = answer(wall, &[]);
    assert_eq!(found["quantity"], "projectile_final_length_mm");
    assert_eq!(found["depth_of_penetration_mm"], Value::Null);
}

#[test]
fn a_comparison_over_velocities_has_the_uncertainty_of_each() {
    let folder = shot(SHORT);
    let words = ["compare", "shot.toml", "--velocity", "200,300"];
    let words = [&words[..], &["--reference", "standard"]].concat();
    let text = ok(folder.path(), &words);
    let json = json(&ok(folder.path(), &[&words[..], &["--json"]].concat()));
    let axi = json["results"].as_array().unwrap().iter();
    let axi: Vec<&Value> = axi.filter(|entry| entry["model"] == "axi").collect();
    assert_eq!(axi.len(), 2);
    for entry in axi {
        let number = |value: &Value| value.as_f64().unwrap();
        let value = number(&entry["depth_of_penetration_mm"]);
        let row = [
            significant(number(&entry["impact_velocity_m_s"]), 4),
            significant(value, 4),
            significant(number(&entry["band"]["high"]) - value, 2),
        ];
        let is_row = |line: &str| line.split_whitespace().take(3).eq(row.iter());
        assert!(text.lines().any(is_row), "{row:?} is not in:\n{text}");
    }
}

#[test]
fn a_fast_run_keeps_the_estimated_model_error() {
    let folder = shot(SHORT);
    let text = ok(folder.path(), &["run", "shot.toml", "--fast"]);
    assert!(
        text.contains("estimated model error")
            && !text.to_lowercase().contains("axisymmetric answer")
    );
    assert_eq!(answer(SHORT, &["--fast"]), Value::Null);
}

#[test]
fn a_quiet_run_has_the_value_and_its_uncertainty() {
    let folder = shot(SHORT);
    let line = ok(folder.path(), &["run", "shot.toml", "--quiet"]);
    assert_eq!(line.lines().count(), 1);
    let found = answer(SHORT, &[]);
    for name in ["value", "uncertainty"] {
        let pairs = line.split_whitespace();
        let mut own = pairs.filter_map(|pair| pair.strip_prefix("axisymmetric."));
        let value = own.find_map(|pair| pair.strip_prefix(&format!("{name}=")));
        let value: f64 = value.unwrap().parse().unwrap();
        let expected = found[name].as_f64().unwrap();
        assert!((value / expected - 1.0).abs() < 1e-15, "{value} {expected}");
    }
}

#[test]
fn where_axi_does_not_apply_the_reason_is_given() {
    let constant = r#"
projectile = { material = "ofhc-copper", length = "20 mm", diameter = "5 mm", impact_velocity = "200 m/s" }
target = { constant_pressure = "1 GPa" }
chain = { projectile_elements = 10 }
"#;
    let text = ok(shot(constant).path(), &["run", "shot.toml"]);
    let found = answer(constant, &[]);
    let reason = found["reason"].as_str().unwrap();
    assert!(reason.contains("constant pressure"), "{reason}");
    let line = format!("no axisymmetric answer: {reason}");
    assert!(flat(&text).contains(&flat(&line)), "{text}");
    assert_eq!(
        (&found["value"], found["meshes"].as_array().unwrap().len()),
        (&Value::Null, 0)
    );
}

#[test]
fn a_long_case_says_what_it_would_cost() {
    let long = r#"
projectile = { material = "4340", length = "300 mm", diameter = "5 mm", impact_velocity = "1500 m/s" }
target = { material = "6061-t6", thickness = "semi-infinite" }
chain = { projectile_elements = 20 }
"#;
    let text = flat(&ok(shot(long).path(), &["run", "shot.toml"]));
    let line = "no axisymmetric answer: the runs take about ";
    assert!(text.contains(line), "{text}");
    assert!(
        text.contains(" of processor time; `--reference standard` computes them"),
        "{text}"
    );
}

#[test]
fn options_without_effect_are_refused() {
    let folder = shot(SHORT);
    for (options, words) in [
        (
            ["--model", "fdm", "--reference", "fine"],
            "`--reference` has no effect with model `fdm`",
        ),
        (
            ["--model", "chain", "--reference", "finest"],
            "[possible values: standard, fine]",
        ),
    ] {
        let said = percuss(
            folder.path(),
            [&["run", "shot.toml"][..], &options].concat(),
        );
        assert_eq!((said.code, said.stdout.as_str()), (2, ""));
        assert!(flat(&said.stderr).contains(words), "{}", said.stderr);
    }
    let said = percuss(
        folder.path(),
        ["run", "shot.toml", "--fast", "--reference", "fine"],
    );
    assert_eq!(said.code, 2);
}

/// Ctrl-C during the axisymmetric runs keeps the first result, on paper and in the folder.
#[cfg(unix)]
#[test]
fn a_stopped_answer_keeps_the_first_result() {
    use std::{
        io::{BufRead, BufReader, Read},
        process::{Command, Stdio},
    };

    // Half a minute of processor time on a target as large as the model takes by itself.
    let long = SHORT.replace("5 mm\", diameter", "15 mm\", diameter");
    let folder = shot(long.split("axi = ").next().unwrap());
    let mut child = Command::new(env!("CARGO_BIN_EXE_percuss"))
        .args(["run", "shot.toml", "--reference", "fine", "--out", "out"])
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdout = BufReader::new(child.stdout.take().unwrap());
    let mut first = String::new();
    // The first result is there while the long runs go on.
    while !first.contains("depth by other models") {
        assert!(stdout.read_line(&mut first).unwrap() > 0, "{first}");
    }
    std::thread::sleep(std::time::Duration::from_millis(300));
    let id = child.id().to_string();
    assert!(
        Command::new("kill")
            .args(["-INT", &id])
            .status()
            .unwrap()
            .success()
    );
    let mut rest = String::new();
    stdout.read_to_string(&mut rest).unwrap();
    let output = child.wait_with_output().unwrap();
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(130), "{stderr}");
    assert!(
        stderr.starts_with("error: the axisymmetric runs were stopped"),
        "{stderr}"
    );
    assert!(
        rest.contains("\nno axisymmetric answer: the runs were stopped\n"),
        "{rest}"
    );
    assert!(rest.contains("estimated model error"), "{rest}");
    let written = fs::read_to_string(folder.path().join("out/result.json")).unwrap();
    let written = json(&written);
    assert!(written["results"][0]["depth_of_penetration_mm"].is_number());
    assert_eq!(written["axisymmetric"]["reason"], "the runs were stopped");
}
