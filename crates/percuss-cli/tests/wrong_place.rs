//! Messages on what a user puts in the wrong place.

use crate::support::{CASE, flat, folder_with, ok, percuss};

const TESTS: &str = "impact_velocity_m_s,perforated\n180,no\n185,yes\n190,no\n195,yes\n";

#[test]
fn an_option_of_another_command_is_named_with_that_command() {
    let folder = folder_with(&[("case.toml", CASE), ("tests.csv", TESTS)]);
    for (line, words) in [
        (
            &["run", "case.toml", "--velocity", "300"][..],
            "percuss compare CASE.toml --velocity 200..1500:14",
        ),
        (&["validate", "tests.csv"], "'--data FILE.csv'"),
        (&["limit"], "'--tests FILE.csv' needs no case"),
    ] {
        let said = percuss(folder.path(), line);
        assert_eq!(said.code, 2, "{line:?}");
        assert!(said.stderr.contains(words), "{}", said.stderr);
    }
    let said = percuss(folder.path(), ["converge", "case.toml", "--quantity"]);
    assert!(!said.stderr.contains("as a value"), "{}", said.stderr);
}

#[test]
fn a_file_of_another_kind_is_told_with_the_one_that_is_due() {
    let folder = folder_with(&[("case.toml", CASE), ("tests.csv", TESTS)]);
    for (line, words) in [
        (&["limit", "tests.csv"][..], "are given with `--tests`"),
        (
            &["sweep", "case.toml", "--out", "rows"],
            "this is a case, and a sweep file is due here",
        ),
        (
            &["materials", "show", "copper", "--file", "case.toml"],
            "`--case` takes a case",
        ),
    ] {
        let said = percuss(folder.path(), line);
        assert_eq!(said.code, 2, "{line:?}");
        assert!(flat(&said.stderr).contains(words), "{}", said.stderr);
    }
}

#[test]
fn an_unknown_material_is_told_with_those_of_the_case() {
    let record = ok(
        folder_with(&[]).path(),
        &["materials", "export", "6061-t6-lesuer"],
    );
    let case = CASE.replacen('\n', "\nmaterial_files = [\"mine.toml\"]\n", 1);
    let folder = folder_with(&[
        ("case.toml", &case.replace("copper", "alloy-7")),
        ("mine.toml", &record.replace("6061-t6-lesuer", "zinc-9")),
    ]);
    let said = percuss(folder.path(), ["run", "case.toml"]);
    assert!(
        flat(&said.stderr).contains("your own: `zinc-9`"),
        "{}",
        said.stderr
    );
}

#[test]
fn an_interval_far_from_the_tests_leaves_them_the_axis() {
    let tests = "impact_velocity_m_s,perforated\n780,no\n790,no\n795,no\n802,yes\n810,no\n815,yes\n822,no\n830,yes\n845,yes\n";
    let folder = folder_with(&[("tests.csv", tests)]);
    ok(
        folder.path(),
        &["limit", "--tests", "tests.csv", "--out", "out"],
    );
    let figure = std::fs::read_to_string(folder.path().join("out/v50.svg")).unwrap();
    assert!(figure.contains("95 % interval 769.5 to 1042 m/s"));
    assert!(figure.contains(">850<") && !figure.contains(">1000<"));
}

#[test]
fn a_parameter_without_an_effect_is_refused() {
    let sweep = |key: &str| {
        format!(
            "base = \"case.toml\"\nmodel = \"crater_energy\"\ndesign = \"grid\"\n[[parameter]]\nkey = \"{key}\"\nvalues = [\"7 g/cm3\", \"9 g/cm3\"]\n"
        )
    };
    let folder = folder_with(&[
        ("case.toml", CASE),
        ("unused.toml", &sweep("materials.4340.density")),
        ("alias.toml", &sweep("materials.cu.density")),
    ]);
    let said = percuss(folder.path(), ["sweep", "unused.toml", "--out", "rows"]);
    assert_eq!(said.code, 2);
    let words = "`materials.4340.density` has no effect: no part of the case is of `4340`";
    assert!(flat(&said.stderr).contains(words), "{}", said.stderr);
    ok(folder.path(), &["sweep", "alias.toml", "--out", "rows"]);
    ok(
        folder.path(),
        &["sweep", "merge", "rows", "--out", "rows.csv"],
    );
    let mut rows = csv::Reader::from_path(folder.path().join("rows.csv")).unwrap();
    let names = rows.headers().unwrap().clone();
    let depth = names
        .iter()
        .position(|name| name == "depth_of_penetration_mm");
    let depths: Vec<String> = rows
        .records()
        .map(|row| row.unwrap()[depth.unwrap()].to_owned())
        .collect();
    assert_ne!(depths[0], depths[1]);
}

#[test]
fn an_uncertain_option_of_another_model_is_warned_of() {
    let uncertain = "[[uncertainty.parameter]]\nkey = 'tate.target_resistance'\nuniform = { from = '4 GPa', to = '5 GPa' }\n";
    let velocity = "[[uncertainty.parameter]]\nkey = 'projectile.impact_velocity'\nuniform = { from = '220 m/s', to = '240 m/s' }\n";
    let uncertain = format!("{CASE}\n{uncertain}{velocity}");
    let folder = folder_with(&[("uncertain.toml", &uncertain)]);
    let without = "`tate.target_resistance` has no effect: model `crater_energy` does not read the table `tate`";
    let model = ["--model", "crater_energy", "--samples", "16"];
    let said = ok(
        folder.path(),
        &[&["uncertainty", "uncertain.toml"], &model[..]].concat(),
    );
    assert!(flat(&said).contains(without), "{said}");
}
