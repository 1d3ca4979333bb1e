//! What every command does when all is well.

mod support;

use std::{
    fs,
    path::Path,
    process::{Command, Stdio},
};

use serde_json::Value;
use support::{Said, percuss};
use tempfile::TempDir;

const CASE: &str = r#"
title = "Copper on aluminium"
projectile = { material = "copper", length = "12.74 mm", diameter = "4.8 mm", velocity = "230 m/s" }
target = { material = "aluminium-2024-t351", thickness = "25 mm" }
chain = { projectile_elements = 20, target_elements = 40 }
"#;

fn folder_with(case: &str) -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("shot.toml"), case).unwrap();
    folder
}

/// Runs a command that must succeed without a word on standard error.
fn ok(folder: &Path, arguments: &[&str]) -> String {
    let Said {
        code,
        stdout,
        stderr,
    } = percuss(folder, arguments);
    assert_eq!((code, stderr.as_str()), (0, ""), "{arguments:?}");
    stdout
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

#[test]
fn a_run_prints_its_results() {
    let folder = folder_with(CASE);
    let text = ok(folder.path(), &["run", "shot.toml"]);
    for part in [
        "Copper on aluminium\n",
        "case shot, impact at 230 m/s, model chain, scheme conservative, target closure\nexpanding-cavity\n",
        "outcome  ",
        "run ended because  ",
        "depth of penetration  ",
        "largest depth  ",
        "permanent depth  ",
        "time to rest  ",
        "residual velocity  ",
        "final projectile length  ",
        " % of 12.74 mm)",
        "final projectile diameter  ",
        "final projectile mass  ",
        "peak force  ",
        "energy at the end, in % of 51.8",
        "plastic, projectile",
        "energy residual  ",
        "momentum residual  ",
        "steps  ",
        "time step  ",
        "\nwarning: the depth rests on the target closure",
    ] {
        assert!(text.contains(part), "{part:?} is not in:\n{text}");
    }
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
}

#[test]
fn json_is_one_object_with_stable_names() {
    let folder = folder_with(CASE);
    let object = json(&ok(folder.path(), &["run", "shot.toml", "--json"]));
    assert_eq!(object["case"], "shot");
    assert_eq!(object["results"].as_array().unwrap().len(), 1);
    let result = object["results"][0].as_object().unwrap();
    let names: Vec<&str> = result.keys().map(String::as_str).collect();
    for name in [
        "model",
        "scheme",
        "outcome",
        "termination",
        "depth_of_penetration_mm",
        "residual_velocity_m_s",
        "projectile_final_length_mm",
        "time_to_rest_us",
        "steps",
        "time_step_ns",
        "energy_residual",
        "momentum_residual",
        "warnings",
    ] {
        assert!(names.contains(&name), "{name} is not in {names:?}");
    }
    assert_eq!(result["model"], "chain");
    assert_eq!(result["scheme"], "conservative");
    assert!(result["energy_residual"].as_f64().unwrap().abs() < 1e-3);
    assert!(result["warnings"].is_array());
    // A number that does not exist is null, not left out.
    let wall = "projectile = { material = 'copper', length = '10 mm', diameter = '5 mm', velocity = '100 m/s' }\n\
                target = { rigid_wall = true }";
    let folder = folder_with(wall);
    let object = json(&ok(folder.path(), &["run", "shot.toml", "--json"]));
    let result = object["results"][0].as_object().unwrap();
    assert!(result["depth_of_penetration_mm"].is_null());
    assert_eq!(names, result.keys().map(String::as_str).collect::<Vec<_>>());
}

#[test]
fn quiet_is_one_line_with_the_values_of_json() {
    let folder = folder_with(CASE);
    let line = ok(folder.path(), &["run", "shot.toml", "--quiet"]);
    let result = json(&ok(folder.path(), &["run", "shot.toml", "--json"]))["results"][0].clone();
    assert_eq!(line.lines().count(), 1);
    for pair in line.split_whitespace() {
        let (name, value) = pair.split_once('=').unwrap();
        match name {
            "warnings" => {
                assert_eq!(value, result[name].as_array().unwrap().len().to_string());
            }
            "outcome" => assert_eq!(value, result[name].as_str().unwrap()),
            _ if value == "null" => assert!(result[name].is_null(), "{pair}"),
            _ => assert_eq!(
                value.parse::<f64>().unwrap(),
                result[name].as_f64().unwrap()
            ),
        }
    }
    for name in ["depth_of_penetration_mm", "ballistic_limit_m_s"] {
        assert!(line.contains(&format!("{name}=")), "{line}");
    }
}

#[test]
fn every_model_that_applies_writes_its_folder() {
    const PLATE: &str = r#"
projectile = { material = "tool-steel-hrc53", mass = "197 g", diameter = "20 mm", velocity = "300 m/s" }
target = { material = "weldox-460-e", thickness = "12 mm" }
chain = { projectile_elements = 10, target_elements = 10 }
"#;
    const ROD: &str = r#"
projectile = { material = "4340", length = "80 mm", diameter = "5 mm", velocity = "1500 m/s" }
target = { material = "aluminium-2024-t351", thickness = "semi-infinite" }
chain = { projectile_elements = 10, target_elements = 10 }
"#;
    const CORE: &str = r#"
projectile = { material = "apm2-core", length = "35 mm", diameter = "6.17 mm", velocity = "300 m/s", nose = { ogive = { crh = 3.0 } } }
target = { material = "aluminium-2024-t351", thickness = "semi-infinite" }
"#;
    const WALL: &str = r#"
projectile = { material = "ofhc-copper", length = "23.47 mm", diameter = "7.62 mm", velocity = "183 m/s" }
target = { rigid_wall = true }
chain = { projectile_elements = 10 }
"#;
    let without = "  no time history: this model ";
    let mut silent = 0;
    for case in [CASE, PLATE, ROD, CORE, WALL] {
        let folder = folder_with(case);
        let compared = ok(folder.path(), &["compare", "shot.toml", "--json"]);
        for result in json(&compared)["results"].as_array().unwrap() {
            if result["outcome"] == "not_applicable" {
                continue;
            }
            let model = result["model"].as_str().unwrap();
            let out = format!("out-{model}");
            let arguments = ["run", "shot.toml", "--model", model, "--out", &out];
            let text = ok(folder.path(), &arguments);
            let written = folder.path().join(&out);
            assert!(text.contains("outcome  "), "{model}: {text}");
            assert!(written.join("result.json").is_file(), "{model}");
            let history = written.join("history.csv").is_file();
            assert_eq!(text.contains(without), !history, "{model}: {text}");
            silent += usize::from(!history);
        }
    }
    assert!(silent >= 5, "{silent}");
    let folder = folder_with(PLATE);
    let arguments = ["run", "shot.toml", "--model", "plugging", "--out", "out"];
    let text = ok(folder.path(), &arguments);
    assert!(text.contains("no time history: this model is a formula\n"));
}

#[test]
fn a_folder_holds_case_result_histories_and_figures() {
    let folder = folder_with(CASE);
    let arguments = ["run", "shot.toml", "--json", "--out", "deep/out"];
    for _ in 0..2 {
        let said = percuss(folder.path(), arguments);
        assert_eq!(said.code, 0, "{}", said.stderr);
        let files: Vec<&str> = said.stderr.lines().skip(1).map(str::trim).collect();
        for file in &files {
            assert!(folder.path().join(file).is_file(), "{file}");
        }
        for name in [
            "case-as-run.toml",
            "result.json",
            "history.csv",
            "depth-time.svg",
        ] {
            assert!(
                files.contains(&&*format!("deep/out/{name}")),
                "{name}: {files:?}"
            );
        }
        let written = fs::read_to_string(folder.path().join("deep/out/result.json")).unwrap();
        assert_eq!(written, said.stdout);
        let copy = fs::read_to_string(folder.path().join("deep/out/case-as-run.toml")).unwrap();
        assert_eq!(copy, CASE);
    }
    // The copy of the case can be run, into its own folder.
    let again = [
        "run",
        "deep/out/case-as-run.toml",
        "-q",
        "--out",
        "deep/out",
    ];
    assert_eq!(ok(folder.path(), &again).lines().count(), 1);
}

#[test]
fn a_folder_that_cannot_be_written_is_said_before_the_run() {
    let folder = folder_with(CASE);
    for out in ["shot.toml", "shot.toml/out"] {
        let said = percuss(folder.path(), ["run", "shot.toml", "--out", out]);
        assert_eq!((said.code, said.stdout.as_str()), (4, ""));
        let start = format!("error: cannot write `{out}`: ");
        assert!(said.stderr.starts_with(&start), "{}", said.stderr);
    }
}

#[test]
fn the_published_scheme_and_a_named_model_run() {
    let case = CASE.replace(
        "projectile_elements = 20",
        "scheme = 'published', projectile_elements = 20",
    );
    let folder = folder_with(&case);
    let text = ok(folder.path(), &["run", "shot.toml", "--model", "chain"]);
    assert!(text.contains("scheme published"), "{text}");
    let said = percuss(folder.path(), ["run", "shot.toml", "--model", "chian"]);
    assert_eq!(said.code, 2);
    assert!(
        said.stderr.contains("a similar value exists: 'chain'"),
        "{}",
        said.stderr
    );
}

#[test]
fn a_numerical_failure_has_its_own_exit_code() {
    // Elements that never erode are compressed to nothing at this speed.
    let case = "projectile = { material = 'copper', length = '12.74 mm', diameter = '4.8 mm', velocity = '9 km/s' }\n\
                target = { material = 'aluminium-2024-t351', thickness = 'semi-infinite' }\n\
                chain = { erosion_strain = 'never', courant = 1.0 }";
    let folder = folder_with(case);
    let said = percuss(folder.path(), ["run", "shot.toml"]);
    assert_eq!(
        (said.code, said.stdout.as_str()),
        (3, ""),
        "{}",
        said.stderr
    );
    assert!(
        said.stderr.contains(" at step ")
            && said.stderr.contains(
                "
help: "
            ),
        "{}",
        said.stderr
    );
}

#[test]
fn models_are_listed_and_shown() {
    let folder = TempDir::new().unwrap();
    let text = ok(folder.path(), &["models"]);
    let row = text
        .lines()
        .find(|line| line.starts_with(" chain "))
        .unwrap();
    assert!(row.contains("1-D discrete element"), "{text}");
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    let card = ok(folder.path(), &["models", "chain"]);
    for part in [
        "chain\n1-D discrete",
        "made for\n",
        "  - normal impact",
        "first choice for\n  - deforming projectiles",
        "options in [chain] of a case file\n  - ",
        "\n  - courant: Courant number",
        "page\n  - docs/models/chain.md: ",
    ] {
        assert!(card.contains(part), "{part:?} is not in:\n{card}");
    }
    assert!(
        card.lines().all(|line| line.chars().count() <= 80),
        "{card}"
    );
    assert!(!ok(folder.path(), &["models", "hydrodynamic"]).contains("options"));
    let said = percuss(folder.path(), ["models", "chian"]);
    assert_eq!(said.code, 2);
    assert!(
        said.stderr.contains("did you mean `chain`?"),
        "{}",
        said.stderr
    );
}

#[test]
fn models_as_json_hold_their_whole_guard() {
    let folder = TempDir::new().unwrap();
    let list = json(&ok(folder.path(), &["models", "--json"]));
    assert_eq!(
        list[0],
        json(&ok(folder.path(), &["models", "chain", "--json"]))
    );
    assert_eq!(list[0]["name"], "chain");
    assert_eq!(list[0]["guard"]["noses"], serde_json::json!(["flat"]));
    assert_eq!(
        list[3]["options"],
        serde_json::json!(["projectile_strength", "target_resistance"])
    );
    let keys =
        |value: &Value| -> Vec<String> { value.as_object().unwrap().keys().cloned().collect() };
    for model in list.as_array().unwrap() {
        assert_eq!(keys(model), ["guard", "name", "options", "page", "summary"]);
        let page = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../..")
            .join(model["page"].as_str().unwrap());
        assert!(page.is_file(), "{}", page.display());
        let guard = &model["guard"];
        assert_eq!(
            keys(guard),
            [
                "first_choice",
                "fitted_to",
                "noses",
                "notes",
                "oblique_noses",
                "predicts",
                "projectile",
                "projectile_materials",
                "ranges",
                "sees_back_face",
                "separate_layers",
                "start_temperature",
                "target_materials",
                "targets",
            ]
        );
        for range in guard["ranges"].as_array().unwrap() {
            assert_eq!(keys(range), ["because", "max", "measure", "min", "outside"]);
            assert!(range["min"].is_number());
        }
        for choice in guard["first_choice"].as_array().unwrap() {
            assert_eq!(
                keys(choice),
                [
                    "because",
                    "noses",
                    "projectile",
                    "target_material",
                    "targets"
                ]
            );
        }
    }
}

#[test]
fn materials_are_listed_and_shown() {
    let folder = TempDir::new().unwrap();
    let text = ok(folder.path(), &["materials"]);
    assert!(text.lines().next().unwrap().starts_with("id "), "{text}");
    let line = text
        .lines()
        .find(|line| line.starts_with("copper-woodward"))
        .unwrap();
    for part in ["copper ★", "power_law", "8500", "woodward1982"] {
        assert!(line.contains(part), "{line}");
    }
    let list = json(&ok(folder.path(), &["materials", "--json"]));
    assert_eq!(list.as_array().unwrap().len(), text.lines().count() - 1);

    let card = ok(folder.path(), &["materials", "show", "ofhc-copper"]);
    for part in [
        "id                      ofhc-copper-johnson-cook",
        "density                 8960 kg/m3",
        "elastic wave speed      3710 m/s",
        "impedance               33.24e6 kg/(m2 s)",
        "σ = (A + B ε_pⁿ)(1 + C ln ε̇*)(1 − T*ᵐ)",
        "trust: A\n  read in two independent places",
        "[johnson1983] Johnson & Cook 1983",
        "rivals of the same family\n  ofhc-copper-steinberg",
    ] {
        assert!(card.contains(part), "{part:?} is not in:\n{card}");
    }
    let card = json(&ok(
        folder.path(),
        &["materials", "show", "ofhc-copper", "--json"],
    ));
    assert_eq!(card["strength"]["johnson_cook"]["a"], "90 MPa");
    assert_eq!(card["rivals"][0], "ofhc-copper-steinberg");

    let said = percuss(folder.path(), ["materials", "show", "ofhc-coper"]);
    assert_eq!((said.code, said.stdout.as_str()), (2, ""));
    assert!(
        said.stderr.contains("did you mean `ofhc-copper`?"),
        "{}",
        said.stderr
    );
}

#[test]
fn materials_of_a_case_and_of_a_file_are_shown() {
    let record = "name = 'Foam'\ndensity = '30 kg/m3'\nyoungs_modulus = '20 MPa'\npoissons_ratio = 0.1\n\
                  strength.perfectly_plastic.flow_stress = '400 kPa'\n";
    let folder = folder_with(&format!("{CASE}\n[materials.foam]\n{record}"));
    fs::write(
        folder.path().join("mine.toml"),
        format!("[my-foam]\n{record}"),
    )
    .unwrap();
    let card = ok(
        folder.path(),
        &["materials", "show", "foam", "--case", "shot.toml"],
    );
    assert!(
        card.contains("shot (this case)") && card.contains("trust: user"),
        "{card}"
    );
    let card = ok(
        folder.path(),
        &["materials", "--file", "mine.toml", "show", "my-foam"],
    );
    assert!(
        card.contains("400 kPa") && card.contains("mine.toml"),
        "{card}"
    );
    let said = percuss(folder.path(), ["materials", "show", "foam"]);
    assert_eq!(said.code, 2);
}

/// The keys that the reader of case files allows beside one that does not exist.
fn keys_allowed(case: &str) -> Vec<String> {
    let folder = folder_with(case);
    let said = percuss(folder.path(), ["run", "shot.toml"]);
    assert_eq!(said.code, 2, "{case}");
    let message = said.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
    let (_, allowed) = message
        .split_once("allowed: ")
        .unwrap_or_else(|| panic!("{message}"));
    let mut keys: Vec<String> = allowed.split(", ").map(str::to_owned).collect();
    keys.sort();
    keys
}

#[test]
fn the_schema_has_the_keys_that_case_files_have() {
    let folder = TempDir::new().unwrap();
    let schema = json(&ok(folder.path(), &["schema"]));
    assert_eq!(
        schema["$schema"],
        "https://json-schema.org/draft/2020-12/schema"
    );
    assert!(schema.get("$id").is_none());
    assert!(
        !schema.to_string().contains("null"),
        "a TOML file has no null"
    );
    let scheme = &schema["$defs"]["ChainOptions"]["properties"]["scheme"];
    assert_eq!(scheme["default"], "conservative");
    let material = "[materials.x]\nname = 'x'\ndensity = '1 g/cm3'\nyoungs_modulus = '1 GPa'\npoissons_ratio = 0.3\n";
    for (definition, case) in [
        ("", "zz = 1".to_owned()),
        ("Projectile", "projectile.zz = 1".to_owned()),
        ("Target", CASE.replace("thickness", "zz = 1, thickness")),
        (
            "Layer",
            CASE.replace(
                "{ material = \"alu",
                "{ layers = [{ zz = 1 }], material = \"alu",
            ),
        ),
        (
            "ChainOptions",
            CASE.replace("chain = {", "chain = { zz = 1,"),
        ),
        (
            "PublishedOptions",
            CASE.replace("chain = {", "chain = { published.zz = 1,"),
        ),
        (
            "ArtificialViscosity",
            CASE.replace("chain = {", "chain = { artificial_viscosity.zz = 1,"),
        ),
        (
            "Experiment",
            format!("{CASE}[[experiments]]\nsource = 'a'\nzz = 1"),
        ),
        ("Material", format!("{CASE}{material}zz = 1")),
        ("Validity", format!("{CASE}{material}validity.zz = 1")),
        (
            "PowerLaw",
            format!("{CASE}{material}strength.power_law.zz = 1"),
        ),
        (
            "JohnsonCook",
            format!("{CASE}{material}strength.johnson_cook.zz = 1"),
        ),
    ] {
        let object = match definition {
            "" => &schema,
            _ => &schema["$defs"][definition],
        };
        assert_eq!(object["additionalProperties"], false, "{definition}");
        let mut keys: Vec<&String> = object["properties"]
            .as_object()
            .unwrap_or_else(|| panic!("no {definition} in {schema}"))
            .keys()
            .collect();
        keys.sort();
        assert_eq!(
            keys,
            keys_allowed(&case).iter().collect::<Vec<_>>(),
            "{definition}"
        );
    }
}

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
    let text = ok(path, &["run", "cases/my shot/scenario.toml"]);
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
    let folder = folder_with(&text);
    let reference = ok(folder.path(), &["run", "shot.toml", "--json"]);
    // These stand in place of something else, or have no default.
    let no_defaults = [
        "mass",
        "material_files",
        "end_time",
        "target_mass",
        "velocity",
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
        let folder = folder_with(&case);
        assert_eq!(
            ok(folder.path(), &["run", "shot.toml", "--json"]),
            reference,
            "{case}"
        );
    }
    let scheme = text.replace("# scheme = \"conservative\"", "scheme = \"published\"");
    let reference = ok(folder_with(&scheme).path(), &["run", "shot.toml", "--json"]);
    let case = uncommented(&scheme, |number, line| {
        number == published
            || ((published..materials).contains(&number)
                && options.contains(&number)
                && !line.starts_with("# target_mass"))
    });
    let folder = folder_with(&case);
    assert_eq!(
        ok(folder.path(), &["run", "shot.toml", "--json"]),
        reference,
        "{case}"
    );
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
    let folder = folder_with(&case);
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
    let folder = folder_with(&case);
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
    let together = lines.filter(|line| !line.contains("in place of"));
    let (planar, rod): (Vec<&str>, Vec<&str>) =
        together.partition(|line| line.contains("geometry \"planar\" only"));
    let examples = [
        rod.join("\n"),
        format!("[fdm]\ngeometry = \"planar\"\n{}", planar.join("\n")),
        "[forrestal]\ncavity = \"incompressible\"".to_owned(),
    ];
    for example in examples {
        let folder = folder_with(&format!("{text}\n{example}\n"));
        ok(folder.path(), &["run", "shot.toml"]);
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

#[test]
fn completions_and_manual_pages_are_written() {
    let folder = TempDir::new().unwrap();
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        assert!(
            ok(folder.path(), &["completions", shell]).contains("percuss"),
            "{shell}"
        );
    }
    assert!(ok(folder.path(), &["man"]).contains(".TH percuss 1"));
    let text = ok(folder.path(), &["man", "--out", "man/man1"]);
    for page in ["percuss.1", "percuss-run.1", "percuss-materials-show.1"] {
        assert!(text.contains(page), "{text}");
        let roff = fs::read_to_string(folder.path().join("man/man1").join(page)).unwrap();
        assert!(roff.contains(".SH SYNOPSIS"), "{roff}");
    }
}

#[test]
fn help_fits_and_is_as_approved() {
    let folder = TempDir::new().unwrap();
    for command in [
        &[][..],
        &["run"],
        &["compare"],
        &["limit"],
        &["calibrate"],
        &["judge"],
        &["new"],
        &["models"],
        &["materials"],
        &["materials", "show"],
        &["schema"],
        &["completions"],
        &["man"],
    ] {
        let text = ok(folder.path(), &[command, &["--help"]].concat());
        assert!(
            text.contains("Examples:\n") && text.contains("Exit codes: "),
            "{text}"
        );
        assert!(
            text.lines().all(|line| line.chars().count() <= 80),
            "{text}"
        );
        let name = [&["help"], command].concat().join("-");
        insta::with_settings!({
            snapshot_path => "snapshots/help",
            prepend_module_to_snapshot => false,
            omit_expression => true,
        }, {
            insta::assert_snapshot!(name, text);
        });
    }
    assert!(ok(folder.path(), &["--version"]).starts_with("percuss "));
    assert_eq!(percuss::<&str>(folder.path(), []).code, 2);
    assert_eq!(percuss(folder.path(), ["walk"]).code, 2);
}

#[test]
fn a_reader_that_goes_away_is_no_failure() {
    for arguments in [
        &["materials", "--json"][..],
        &["schema"],
        &["completions", "zsh"],
    ] {
        let mut child = Command::new(assert_cmd::cargo::cargo_bin!("percuss"))
            .args(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0));
        assert_eq!(output.stderr, b"");
    }
}
