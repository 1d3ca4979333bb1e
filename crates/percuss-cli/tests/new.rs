//! `percuss new`: the starter case shows every option, and each of them works.

use std::fs;

use percuss::units::Length;
use serde_json::Value;
use tempfile::TempDir;

use crate::support::{json, ok, percuss, shot};

/// The starter case, and the numbers of its lines that are options commented out.
fn starter() -> (String, Vec<usize>) {
    let folder = TempDir::new().unwrap();
    ok(folder.path(), &["new", "shot"]);
    let text = fs::read_to_string(folder.path().join("shot/scenario.toml")).unwrap();
    let option = |line: &str| {
        let key = line
            .strip_prefix("# ")
            .and_then(|rest| rest.split_once(" = "));
        key.is_some_and(|(key, _)| !key.contains(' '))
    };
    let options = text.lines().enumerate().filter(|(_, line)| option(line));
    let numbers = options.map(|(number, _)| number).collect();
    (text, numbers)
}

fn uncommented(text: &str, wanted: impl Fn(usize, &str) -> bool) -> String {
    let lines = text.lines().enumerate().map(|(number, line)| {
        let bare = if wanted(number, line) {
            line.strip_prefix("# ")
        } else {
            None
        };
        bare.unwrap_or(line).to_owned() + "\n"
    });
    lines.collect()
}

#[test]
fn a_new_case_runs_and_is_not_overwritten() {
    let folder = TempDir::new().unwrap();
    let path = folder.path();
    let text = ok(path, &["new", "cases/my shot"]);
    assert!(
        text.ends_with("next: percuss run 'cases/my shot/scenario.toml'\n"),
        "{text}"
    );
    let text = ok(path, &["run", "--fast", "cases/my shot/scenario.toml"]);
    assert!(text.contains("case my shot, impact at 230 m/s"), "{text}");

    let file = path.join("cases/my shot/scenario.toml");
    fs::write(&file, "changed").unwrap();
    let said = percuss(path, ["new", "cases/my shot"]);
    assert_eq!((said.code, said.stdout.as_str()), (4, ""));
    assert!(said.stderr.contains("it exists already") && said.stderr.contains("--force"));
    assert_eq!(fs::read_to_string(&file).unwrap(), "changed");
    ok(path, &["new", "cases/my shot", "--force"]);
    assert!(
        fs::read_to_string(&file)
            .unwrap()
            .starts_with("# A case for percuss")
    );

    assert_eq!(percuss(path, ["new", ""]).code, 2);
    fs::write(path.join("file"), "").unwrap();
    assert_eq!(percuss(path, ["new", "file"]).code, 4);
}

#[test]
fn a_new_case_shows_every_option_at_its_default() {
    let (text, options) = starter();
    let folder = shot(&text);
    let reference = ok(folder.path(), &["run", "--fast", "shot.toml", "--json"]);
    // These stand instead of something else, or have no default.
    let no_defaults = [
        "mass",
        "material_files",
        "end_time",
        "target_mass",
        "impact_velocity",
        "depth_of_penetration",
        "uncertainty",
        "source",
        "note",
        "key",
        "normal",
    ];
    let first_of = |header: &str| text.lines().position(|line| line == header).unwrap();
    let (published, materials) = (
        first_of("# [chain.published]"),
        first_of("# [materials.my-copper]"),
    );
    let plain = |number: usize, line: &str| {
        let key = line
            .trim_start_matches("# ")
            .split(' ')
            .next()
            .unwrap_or_default();
        options.contains(&number) && number < published && !no_defaults.contains(&key)
    };
    for case in [
        uncommented(&text, plain),
        uncommented(&text, |number, line| {
            plain(number, line)
                || number == materials
                || (number > materials && options.contains(&number))
        }),
    ] {
        let folder = shot(&case);
        assert_eq!(
            ok(folder.path(), &["run", "--fast", "shot.toml", "--json"]),
            reference,
            "{case}"
        );
    }
    let scheme = text.replace("# scheme = \"conservative\"", "scheme = \"published\"");
    let reference = ok(
        shot(&scheme).path(),
        &["run", "--fast", "shot.toml", "--json"],
    );
    let case = uncommented(&scheme, |number, line| {
        number == published
            || ((published..materials).contains(&number)
                && options.contains(&number)
                && !line.starts_with("# target_mass"))
    });
    let folder = shot(&case);
    assert_eq!(
        ok(folder.path(), &["run", "--fast", "shot.toml", "--json"]),
        reference,
        "{case}"
    );
}

#[test]
fn options_of_other_models_have_their_defaults() {
    let (text, _) = starter();
    let folder = TempDir::new().unwrap();
    let schema: Value = serde_json::from_str(&ok(folder.path(), &["schema"])).unwrap();
    let (_, others) = text.split_once("# Options of the other models").unwrap();
    let (mut table, mut checked) = (String::new(), 0);
    for line in others.lines().filter_map(|line| line.strip_prefix("#   ")) {
        if let Some(name) = line.strip_prefix('[') {
            table = name.trim_end_matches(']').to_owned();
            continue;
        }
        let (key, _) = line.split_once(" = ").unwrap();
        let of = schema["properties"][&table]["$ref"].as_str();
        let name = of.and_then(|of| of.rsplit('/').next());
        let options = &schema["$defs"][name.unwrap_or_else(|| panic!("no table {table}"))];
        let default = &options["properties"][key]["default"];
        if default.is_null() {
            continue;
        }
        let written: toml::Table = toml::from_str(line).unwrap();
        let written = serde_json::to_value(&written[key]).unwrap();
        let length = |value: &Value| serde_json::from_value::<Length>(value.clone()).ok();
        let is_same = written == *default
            || length(&written).is_some_and(|written| Some(written) == length(default));
        assert!(is_same, "{table}.{key}: {written}, default {default}");
        checked += 1;
    }
    assert!(checked > 30, "{checked}");
}

#[test]
fn the_experiment_of_a_new_case_is_compared() {
    let (text, options) = starter();
    let first = text
        .lines()
        .position(|line| line == "# [[experiments]]")
        .unwrap();
    let case = uncommented(&text, |number, _| {
        number == first || ((first..first + 6).contains(&number) && options.contains(&number))
    });
    let folder = shot(&case);
    let object = json(&ok(folder.path(), &["compare", "shot.toml", "--json"]));
    assert_eq!(object["experiments"][0]["value"], 0.5, "{case}");
    assert_eq!(object["experiments"][0]["sources"][0], "my-notebook");
}

#[test]
fn the_uncertain_speed_of_a_new_case_is_analysed() {
    let (text, options) = starter();
    let first = text
        .lines()
        .position(|line| line == "# [[uncertainty.parameter]]")
        .unwrap();
    let case = uncommented(&text, |number, _| {
        number == first || ((first..first + 3).contains(&number) && options.contains(&number))
    });
    let folder = shot(&case);
    let said = ok(
        folder.path(),
        &["uncertainty", "shot.toml", "--samples", "16", "--json"],
    );
    assert_eq!(json(&said)["inputs"][0]["median"], 230.0, "{case}");
}

#[test]
fn the_example_options_of_a_new_case_can_be_written() {
    let (text, _) = starter();
    let block = text
        .split_once("# Options of the other models")
        .and_then(|(_, rest)| rest.split_once("\n\n"))
        .map(|(block, _)| block)
        .unwrap();
    let lines = block.lines().filter_map(|line| line.strip_prefix("#   "));
    let together = lines.filter(|line| !line.contains("instead of"));
    let (planar, rod): (Vec<&str>, Vec<&str>) =
        together.partition(|line| line.contains("geometry \"planar\" only"));
    let (stress, rod): (Vec<&str>, Vec<&str>) = rod
        .into_iter()
        .partition(|line| line.contains("formulation \"particle-stress\" only"));
    let examples = [
        rod.join("\n"),
        format!("[fdm]\ngeometry = \"planar\"\n{}", planar.join("\n")),
        format!(
            "[particles]\nformulation = \"particle-stress\"\n{}",
            stress.join("\n")
        ),
        "[forrestal]\ncavity = \"incompressible\"".to_owned(),
    ];
    for example in examples {
        let folder = shot(&format!("{text}\n{example}\n"));
        ok(folder.path(), &["run", "--fast", "shot.toml"]);
    }
}

#[test]
fn a_new_case_names_every_key_of_the_schema() {
    let folder = TempDir::new().unwrap();
    let (text, _) = starter();
    let schema = json(&ok(folder.path(), &["schema"]));
    let definitions = schema["$defs"].as_object().unwrap().iter();
    let root = "Case".to_owned();
    let objects = definitions.chain([(&root, &schema)]);
    for (definition, object) in objects {
        for key in keys_of(object) {
            assert!(is_named(&text, key), "{definition}.{key}");
        }
    }
}

/// Whether a file has a key: `key = `, `[key]`, or in a path such as `strength.power_law`.
fn is_named(text: &str, key: &str) -> bool {
    text.match_indices(key).any(|(at, _)| {
        let (before, after) = (&text[..at], &text[at + key.len()..]);
        let part_of_word = |c: char| c.is_alphanumeric() || c == '_' || c == '-';
        let in_path = |rest: &str| rest.starts_with(|c: char| c.is_lowercase());
        !before.ends_with(part_of_word)
            && (after.starts_with(" = ")
                || after.starts_with(']')
                || after.strip_prefix('.').is_some_and(in_path))
    })
}

/// Every key that an object or a variant of a choice in the schema has.
fn keys_of(object: &Value) -> Vec<&String> {
    let own = object["properties"].as_object().into_iter();
    let choices = ["oneOf", "anyOf"].into_iter();
    let variants = choices.filter_map(|choice| object[choice].as_array());
    own.flat_map(|properties| properties.keys())
        .chain(variants.flatten().flat_map(keys_of))
        .collect()
}

/// Each material that the brittle plate names as another choice is one, and the plate cracks.
#[test]
fn the_brittle_plate_runs_with_every_material_that_it_names() {
    let folder = TempDir::new().unwrap();
    let new = ["new", "plate", "--template", "brittle-plate"];
    ok(folder.path(), &new);
    let text = fs::read_to_string(folder.path().join("plate/scenario.toml")).unwrap();
    let line = text.lines().find(|line| line.contains(" # or \"alumina"));
    let names: Vec<&str> = line.unwrap().split('"').skip(1).step_by(2).collect();
    assert!(names.len() >= 3, "{names:?}");
    for name in &names {
        let case = text.replacen(&format!("\"{}\"", names[0]), &format!("\"{name}\""), 1);
        let folder = shot(&case);
        let run = ["run", "shot.toml", "--model", "particles", "--json"];
        let broken = &json(&ok(folder.path(), &run))["results"][0]["broken_bonds"];
        assert!(broken.as_u64().unwrap() > 0, "{name}");
    }
}
