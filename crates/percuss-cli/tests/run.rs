//! `percuss run`: what it prints and writes.

use std::fs;

use serde_json::Value;

use crate::support::{CASE, flat, json, ok, percuss, shot};

#[test]
fn a_run_prints_its_results() {
    let folder = shot(CASE);
    let text = ok(folder.path(), &["run", "--fast", "shot.toml"]);
    for part in [
        "Copper on aluminium\n",
        "case shot, impact at 230 m/s, model chain, scheme conservative, target\nresistance model expanding-cavity\n",
        "outcome  ",
        "termination  ",
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
        "energy balance error  ",
        "momentum balance error  ",
        "steps  ",
        "time step  ",
        "depth by other models (`percuss compare` recommends one)\n",
        "\nfdm                         0.05129",
        "\ncrater_energy               0.924",
        "\nwarning: the depth rests on the target resistance model",
    ] {
        assert!(text.contains(part), "{part:?} is not in:\n{text}");
    }
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    let named = ok(
        folder.path(),
        &["run", "--fast", "shot.toml", "--model", "chain"],
    );
    assert!(!named.contains("by other models"), "{named}");
}

#[test]
fn json_is_one_object_with_stable_names() {
    let folder = shot(CASE);
    let object = json(&ok(
        folder.path(),
        &["run", "--fast", "shot.toml", "--json"],
    ));
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
    let wall = "projectile = { material = 'copper', length = '10 mm', diameter = '5 mm', impact_velocity = '100 m/s' }\n\
                target = { rigid_wall = true }";
    let folder = shot(wall);
    let object = json(&ok(
        folder.path(),
        &["run", "--fast", "shot.toml", "--json"],
    ));
    let result = object["results"][0].as_object().unwrap();
    assert!(result["depth_of_penetration_mm"].is_null());
    assert_eq!(names, result.keys().map(String::as_str).collect::<Vec<_>>());
}

#[test]
fn quiet_is_one_line_with_the_values_of_json() {
    let folder = shot(CASE);
    let line = ok(folder.path(), &["run", "--fast", "shot.toml", "--quiet"]);
    let result = json(&ok(
        folder.path(),
        &["run", "--fast", "shot.toml", "--json"],
    ))["results"][0]
        .clone();
    assert_eq!(line.lines().count(), 1);
    for pair in line.split_whitespace() {
        let (name, value) = pair.split_once('=').unwrap();
        match name {
            "warnings" => {
                assert_eq!(value, result[name].as_array().unwrap().len().to_string());
            }
            "outcome" | "model" => assert_eq!(value, result[name].as_str().unwrap()),
            _ if value == "null" => assert!(result[name].is_null(), "{pair}"),
            // The JSON reader of this test may miss the last digit.
            _ => {
                let (value, of_json) = (value.parse::<f64>().unwrap(), result[name].as_f64());
                let of_json = of_json.unwrap();
                assert!(
                    (value - of_json).abs() <= f64::EPSILON * of_json.abs(),
                    "{pair}"
                );
            }
        }
    }
    for name in ["depth_of_penetration_mm", "ballistic_limit_m_s"] {
        assert!(line.contains(&format!("{name}=")), "{line}");
    }
}

#[test]
fn every_model_that_applies_writes_its_folder() {
    const PLATE: &str = r#"
projectile = { material = "tool-steel-hrc53", mass = "197 g", diameter = "20 mm", impact_velocity = "300 m/s" }
target = { material = "weldox-460-e", thickness = "12 mm" }
chain = { projectile_elements = 10, target_elements = 10 }
axi = { cells_per_radius = 2 }
"#;
    const ROD: &str = r#"
projectile = { material = "4340", length = "25 mm", diameter = "5 mm", impact_velocity = "1500 m/s" }
target = { material = "aluminium-2024-t351", thickness = "semi-infinite" }
chain = { projectile_elements = 10, target_elements = 10 }
axi = { cells_per_radius = 2 }
"#;
    const CORE: &str = r#"
projectile = { material = "apm2-core", length = "35 mm", diameter = "6.17 mm", impact_velocity = "300 m/s", nose = { ogive = { crh = 3.0 } } }
target = { material = "aluminium-2024-t351", thickness = "semi-infinite" }
axi = { cells_per_radius = 2 }
"#;
    const WALL: &str = r#"
projectile = { material = "ofhc-copper", length = "23.47 mm", diameter = "7.62 mm", impact_velocity = "183 m/s" }
target = { rigid_wall = true }
chain = { projectile_elements = 10 }
"#;
    let without = "  no time history: this model ";
    let mut silent = 0;
    for case in [CASE, PLATE, ROD, CORE, WALL] {
        let folder = shot(case);
        let compared = ok(folder.path(), &["compare", "shot.toml", "--json"]);
        for result in json(&compared)["results"].as_array().unwrap() {
            if result["outcome"] == "not_applicable" {
                continue;
            }
            let model = result["model"].as_str().unwrap();
            let out = format!("out-{model}");
            let arguments = [
                "run",
                "--fast",
                "shot.toml",
                "--model",
                model,
                "--out",
                &out,
            ];
            // A long run says on standard error what it will cost.
            let said = percuss(folder.path(), arguments);
            assert_eq!(said.code, 0, "{model}: {}", said.stderr);
            let text = said.stdout;
            let written = folder.path().join(&out);
            assert!(text.contains("outcome  "), "{model}: {text}");
            assert!(written.join("result.json").is_file(), "{model}");
            let history = written.join("history.csv").is_file();
            assert_eq!(text.contains(without), !history, "{model}: {text}");
            silent += usize::from(!history);
        }
    }
    assert!(silent >= 5, "{silent}");
    let folder = shot(PLATE);
    let arguments = [
        "run",
        "--fast",
        "shot.toml",
        "--model",
        "plugging",
        "--out",
        "out",
    ];
    let text = ok(folder.path(), &arguments);
    assert!(text.contains("no time history: this model is a formula\n"));
}

#[test]
fn a_folder_holds_case_result_histories_and_figures() {
    let folder = shot(CASE);
    let arguments = ["run", "--fast", "shot.toml", "--json", "--out", "deep/out"];
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
        "--fast",
        "deep/out/case-as-run.toml",
        "-q",
        "--out",
        "deep/out",
    ];
    assert_eq!(ok(folder.path(), &again).lines().count(), 1);
}

/// A model without histories leaves those of an earlier run where they are, and says so.
#[test]
fn files_of_an_earlier_run_are_named() {
    let folder = shot(CASE);
    let run = |model: &str| {
        let arguments = ["run", "shot.toml", "--model", model, "--out", "out"];
        flat(&ok(folder.path(), &arguments))
    };
    assert!(!run("fdm").contains("not of this run"));
    let said = run("crater_energy");
    let names = said.split("not of this run: ").nth(1).unwrap();
    assert!(
        names.contains("history.csv") && !names.contains("result.json"),
        "{said}"
    );
}

#[test]
fn a_folder_that_cannot_be_written_is_said_before_the_run() {
    let folder = shot(CASE);
    for out in ["shot.toml", "shot.toml/out"] {
        let said = percuss(folder.path(), ["run", "--fast", "shot.toml", "--out", out]);
        assert_eq!((said.code, said.stdout.as_str()), (4, ""));
        let start = format!("error: cannot write `{out}`: ");
        assert!(said.stderr.starts_with(&start), "{}", said.stderr);
        assert!(said.stderr.contains("\nhelp: "), "{}", said.stderr);
    }
}

#[test]
fn the_published_scheme_and_a_named_model_run() {
    let case = CASE.replace(
        "projectile_elements = 20",
        "scheme = 'published', projectile_elements = 20",
    );
    let folder = shot(&case);
    let text = ok(
        folder.path(),
        &["run", "--fast", "shot.toml", "--model", "chain"],
    );
    assert!(text.contains("scheme published"), "{text}");
    let said = percuss(
        folder.path(),
        ["run", "--fast", "shot.toml", "--model", "chian"],
    );
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
    let case = "projectile = { material = 'copper', length = '12.74 mm', diameter = '4.8 mm', impact_velocity = '9 km/s' }\n\
                target = { material = 'aluminium-2024-t351', thickness = 'semi-infinite' }\n\
                chain = { target_resistance = 'column', erosion_strain = 'never', courant = 1.0 }";
    let folder = shot(case);
    let said = percuss(folder.path(), ["run", "--fast", "shot.toml"]);
    assert_eq!(
        (said.code, said.stdout.as_str()),
        (3, ""),
        "{}",
        said.stderr
    );
    let words: Vec<&str> = said.stderr.split_whitespace().collect();
    assert!(
        words.join(" ").contains(" at step ") && said.stderr.contains("\nhelp: "),
        "{}",
        said.stderr
    );
}

/// A rigid ogive on a thick plate, which the chain does not take.
const OGIVE: &str = r#"
projectile = { material = "4340", length = "60 mm", diameter = "8 mm", nose = { ogive = { crh = 3.0 } }, impact_velocity = "400 m/s" }
target = { material = "6061-t6", thickness = "semi-infinite" }
"#;

#[test]
fn a_case_that_the_chain_does_not_take_runs_by_the_recommended_model() {
    let folder = shot(OGIVE);
    let compared = json(&ok(folder.path(), &["compare", "shot.toml", "--json"]));
    // The meshes of `axi` settle, `tate` is outside its range, and the rod may be rigid.
    let recommended = &compared["recommended"][0];
    assert_eq!(recommended["models"][0]["model"], "axi");
    let depth = |model: &str| {
        let rows = compared["results"].as_array().unwrap();
        let row = rows.iter().find(|row| row["model"] == model).unwrap();
        row["depth_of_penetration_mm"].as_f64().unwrap()
    };
    // Two independent ways to the resistance of a smooth nose.
    assert!((depth("axi") / depth("forrestal") - 1.0).abs() < 0.1);
    let note = recommended["note"].as_str().unwrap();
    for part in [
        "`tate` would be a first choice, but length to diameter",
        "the projectile may also be rigid, for which `forrestal` is the first choice",
    ] {
        assert!(note.contains(part), "{note}");
    }
    let model = "forrestal";
    let ran = json(&ok(
        folder.path(),
        &["run", "--fast", "shot.toml", "--json"],
    ));
    assert_eq!(ran["results"][0]["model"], model);
    let choice = ran["results"][0]["model_choice"].as_str().unwrap();
    let start = format!(
        "model `{model}` instead of the default `chain`, which does not apply: it takes flat noses"
    );
    assert!(choice.starts_with(&start), "{choice}");
    for part in [
        "the resistance to a rigid nose follows from the target's own strength law",
        "`tate` would be a first choice",
    ] {
        assert!(choice.contains(part), "{choice}");
    }

    let text = ok(folder.path(), &["run", "--fast", "shot.toml"]);
    let first: Vec<&str> = text.lines().take(4).collect();
    assert!(
        flat(&first.join(" ")).contains("instead of the default `chain`"),
        "{text}"
    );
    // The model that ran does not stand among the others.
    assert!(!text.contains(&format!("\n{model}  ")), "{text}");

    let named = percuss(
        folder.path(),
        ["run", "--fast", "shot.toml", "--model", "chain"],
    );
    assert_eq!((named.code, named.stdout.as_str()), (2, ""));
    assert!(
        flat(&named.stderr).contains("it takes flat noses"),
        "{}",
        named.stderr
    );
    let asked = json(&ok(
        folder.path(),
        &["run", "--fast", "shot.toml", "--json", "--model", model],
    ));
    assert_eq!(asked["results"][0]["model_choice"], Value::Null);
    ok(
        folder.path(),
        &["run", "--fast", "shot.toml", "--out", "results", "-q"],
    );
    assert!(folder.path().join("results/result.json").is_file());
}

#[test]
fn where_no_model_applies_the_error_gives_every_reason() {
    let folder = shot(&OGIVE.replace(
        "target = { material = \"6061-t6\", thickness = \"semi-infinite\" }",
        "target = { layers = [{ material = \"4340\", thickness = \"4 mm\" }, { material = \"4340\", thickness = \"4 mm\", gap = \"9 mm\" }] }",
    ));
    let said = percuss(
        folder.path(),
        ["run", "--fast", "shot.toml", "--out", "results"],
    );
    assert_eq!((said.code, said.stdout.as_str()), (2, ""));
    assert!(
        said.stderr
            .starts_with("error: no model applies to this case"),
        "{}",
        said.stderr
    );
    for model in ["chain", "plate_cavity", "taylor"] {
        assert!(said.stderr.contains(model), "{}", said.stderr);
    }
    assert!(!folder.path().join("results").exists());
}

/// A number among those of the model.
fn detail(run: &Value, name: &str) -> f64 {
    let details = run["results"][0]["details"].as_array().unwrap();
    let found = details.iter().find(|detail| detail["name"] == name);
    found.unwrap_or_else(|| panic!("no {name}: {details:?}"))["value"]
        .as_f64()
        .unwrap()
}

/// The case on its default mesh.
fn on_default_mesh() -> String {
    CASE.lines()
        .filter(|line| !line.starts_with("chain"))
        .map(|line| format!("{line}\n"))
        .collect()
}

#[test]
fn a_mesh_within_a_tolerance_is_the_coarsest_one() {
    let folder = shot(&on_default_mesh());
    let with = |tolerance: &str| {
        let arguments = ["run", "--fast", "shot.toml", "--json", "--mesh-tolerance"];
        json(&ok(folder.path(), &[&arguments[..], &[tolerance]].concat()))
    };
    let [coarse, fine] = ["5%", "0.7 %"].map(with);
    let elements = |run| {
        let of = |body| detail(run, &format!("{body} elements of the chosen mesh"));
        [of("projectile"), of("target")]
    };
    assert_eq!(elements(&coarse), [20.0, 40.0]);
    assert_eq!(elements(&fine), [80.0, 160.0]);
    for (run, tolerance) in [(&coarse, 5.0), (&fine, 0.7)] {
        assert_eq!(detail(run, "tolerance of the mesh error"), tolerance);
        let error = detail(run, "estimated mesh error of the main number");
        assert!(error <= tolerance && error > 0.0, "{error}");
    }
    // The depth is that of a run on this mesh.
    let mesh = "projectile_elements = 80\ntarget_elements = 160";
    fs::write(
        folder.path().join("fine.toml"),
        format!("{}[chain]\n{mesh}\n", on_default_mesh()),
    )
    .unwrap();
    let run = json(&ok(
        folder.path(),
        &["run", "--fast", "fine.toml", "--json"],
    ));
    for name in ["depth_of_penetration_mm", "residual_velocity_m_s", "steps"] {
        assert_eq!(fine["results"][0][name], run["results"][0][name], "{name}");
    }
}

#[test]
fn a_tolerance_that_no_mesh_meets_is_said_and_one_without_a_mesh_refused() {
    let folder = shot(&on_default_mesh());
    let run = |more: &[&str]| {
        let arguments = [&["run", "--fast", "shot.toml", "--mesh-tolerance"], more].concat();
        percuss(folder.path(), arguments)
    };
    let text = flat(&run(&["0.01%"]).ok());
    let warning = "warning: no mesh up to 320 + 640 elements is within the tolerance of 0.01 %: the depth on the finest one has an estimated error of ";
    assert!(text.contains(warning), "{text}");
    for (more, said) in [
        (&["1"][..], "allowed: 0.01 to 50 percent, such as 1%"),
        (&["-1%"], "allowed: 0.01 to 50 percent"),
        (&["nan%"], "allowed: 0.01 to 50 percent"),
        (
            &["1%", "--model", "tate"],
            "has no effect with model `tate`, which has no elements along a line",
        ),
        (
            &["1%", "--model", "axi"],
            "has no effect with model `axi`, which has no elements along a line",
        ),
    ] {
        let refused = run(more);
        assert_eq!(refused.code, 2, "{}", refused.stderr);
        assert!(flat(&refused.stderr).contains(said), "{}", refused.stderr);
    }
    let arguments = [
        "run",
        "--fast",
        "shot.toml",
        "--out",
        "out",
        "--mesh-tolerance",
        "0.7%",
    ];
    ok(folder.path(), &arguments);
    let written = fs::read_to_string(folder.path().join("out/result.json")).unwrap();
    let chosen = json(&written);
    let again = json(&ok(
        folder.path(),
        &["run", "--fast", "out/case-as-run.toml", "--json"],
    ));
    for name in ["depth_of_penetration_mm", "residual_velocity_m_s", "steps"] {
        assert_eq!(
            chosen["results"][0][name], again["results"][0][name],
            "{name}"
        );
    }
    // A wall has no elements.
    let wall = on_default_mesh()
        .lines()
        .filter(|line| !line.starts_with("target"))
        .map(|line| format!("{line}\n"))
        .collect::<String>()
        + "target.rigid_wall = true\n";
    fs::write(folder.path().join("wall.toml"), wall).unwrap();
    let arguments = [
        "run",
        "--fast",
        "wall.toml",
        "--out",
        "wall",
        "--mesh-tolerance",
        "1%",
    ];
    let text = ok(folder.path(), &arguments);
    assert!(
        text.contains("projectile elements of the chosen mesh"),
        "{text}"
    );
    assert!(!text.contains("target elements"), "{text}");
    let again = ok(folder.path(), &["run", "--fast", "wall/case-as-run.toml"]);
    let length = |text: &str| {
        text.lines()
            .find(|line| line.starts_with("final projectile length"))
            .map(str::to_owned)
    };
    assert!(length(&again).is_some());
    assert_eq!(length(&text), length(&again));
    let planar = "projectile = { material = 'ofhc-copper-johnson-cook', length = '2 mm', diameter = '80 mm', impact_velocity = '300 m/s' }\n\
                  target = { material = '6061-t6-lesuer', thickness = '4 mm', back_face = 'free' }\n\
                  fdm.geometry = 'planar'\n";
    fs::write(folder.path().join("shot.toml"), planar).unwrap();
    let refused = run(&["1%", "--model", "fdm"]);
    let said = "it gives no depth, final length or residual velocity to choose a mesh by";
    assert_eq!(refused.code, 2, "{}", refused.stderr);
    assert!(flat(&refused.stderr).contains(said), "{}", refused.stderr);
}
