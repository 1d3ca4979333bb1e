//! `percuss uncertainty`: what uncertain numbers of a case do to its results.

use std::fs;

use tempfile::TempDir;

use crate::support::{Said, flat, folder_with, json, names_in, percuss, refuses_all_of};

const CASE: &str = "
projectile = { material = 'copper', length = '12.74 mm', diameter = '4.8 mm', impact_velocity = '230 m/s' }
target = { material = 'aluminium-2024-t351', thickness = '25 mm' }
chain = { projectile_elements = 20, target_elements = 40 }
[[uncertainty.parameter]]
key = 'projectile.impact_velocity'
normal = { mean = '230 m/s', standard_deviation = '3 m/s' }
[[uncertainty.parameter]]
key = 'projectile.length'
uniform = { from = '12.5 mm', to = '13 mm' }
";
const CORRELATION: &str = "
[uncertainty.correlation]
parameters = ['projectile.impact_velocity', 'projectile.length']
matrix = [[1, 0.5], [0.5, 1]]
";
const BLUNT: &str = "
projectile = { material = 'tool-steel-hrc53', mass = '197 g', diameter = '20 mm', impact_velocity = '187 m/s' }
target = { material = 'weldox-460-e', thickness = '12 mm', back_face = 'free' }
recht_ipson = { ballistic_limit = '184.5 m/s' }
[[experiments]]
impact_velocity = '184.8 m/s'
residual_velocity = '0 m/s'
source = 'borvik2002a'
[[uncertainty.parameter]]
key = 'projectile.impact_velocity'
normal = { mean = '187 m/s', standard_deviation = '5 m/s' }
[[uncertainty.parameter]]
key = 'recht_ipson.ballistic_limit'
normal = { mean = '184.5 m/s', standard_deviation = '5 m/s' }
";

fn folder() -> TempDir {
    folder_with(&[
        ("case.toml", CASE),
        ("joint.toml", &format!("{CASE}{CORRELATION}")),
        ("blunt.toml", BLUNT),
    ])
}

fn run(folder: &TempDir, arguments: &[&str]) -> Said {
    percuss(folder.path(), [&["uncertainty"], arguments].concat())
}

#[track_caller]
fn ok(folder: &TempDir, arguments: &[&str]) -> String {
    run(folder, arguments).ok()
}

#[test]
fn tables_json_and_pairs_say_the_same() {
    let folder = folder();
    let arguments = ["case.toml", "--samples", "32", "--seed", "5"];
    let object = json(&ok(&folder, &[&arguments[..], &["--json"]].concat()));
    assert_eq!(object["runs"], 1 + 4 + 32 + 16 * 3);
    assert_eq!(object["inputs"][1]["distribution"], "uniform, 12.5 … 13 mm");
    let depth = &object["quantities"][0];
    assert_eq!(depth["quantity"], "depth_of_penetration_mm");
    let mean = depth["statistics"]["mean"].as_f64().unwrap();
    assert!((0.15..0.3).contains(&mean), "{mean}");
    assert_eq!(
        depth["statistics"]["percentiles"].as_array().unwrap().len(),
        7
    );
    assert_eq!(depth["indices"]["rows"], 16);
    assert_eq!(object["perforation"]["probability"], 0.0);
    assert_eq!(object["failures"]["runs"], 0);

    let quiet = ok(&folder, &[&arguments[..], &["--quiet"]].concat());
    assert!(
        quiet.starts_with("quantity=depth_of_penetration_mm mean=0."),
        "{quiet}"
    );
    let of_quiet: f64 = quiet
        .split("mean=")
        .nth(1)
        .unwrap()
        .split(' ')
        .next()
        .unwrap()
        .parse()
        .unwrap();
    assert!((of_quiet / mean - 1.0).abs() < 1e-5);

    let text = flat(&ok(&folder, &arguments));
    for part in [
        "32 samples, seed 5, 85 runs in total",
        "normal, 230 ± 3 m/s",
        "probability of perforation 0 % (0 …",
        "sensitivity of the depth of penetration",
        "first-order",
        "The model's own error comes on top",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
}

#[test]
fn threads_make_no_difference() {
    let folder = folder();
    let with = |threads| {
        let arguments = [
            "case.toml",
            "--samples",
            "16",
            "--json",
            "--threads",
            threads,
        ];
        ok(&folder, &arguments)
    };
    assert_eq!(with("1"), with("3"));
}

#[test]
fn correlated_parameters_have_all_but_indices() {
    let folder = folder();
    let text = ok(&folder, &["joint.toml", "--samples", "16"]);
    assert!(
        flat(&text).contains("no Sobol' indices: the parameters are correlated"),
        "{text}"
    );
    let object = json(&ok(&folder, &["joint.toml", "--samples", "16", "--json"]));
    assert_eq!(
        (object["correlated"].as_bool(), object["runs"].as_u64()),
        (Some(true), Some(21))
    );
    assert!(object["quantities"][0]["indices"].is_null());
}

#[test]
fn a_folder_holds_numbers_and_figures() {
    let folder = folder();
    let arguments = [
        "blunt.toml",
        "--model",
        "recht_ipson",
        "--velocity",
        "160..210",
        "--out",
        "found",
    ];
    let text = ok(&folder, &arguments);
    assert!(
        text.contains("percentiles versus impact velocity, 256 runs each"),
        "{text}"
    );
    let found = folder.path().join("found");
    let figures = [
        "bands-residual-velocity",
        "histogram-residual-velocity",
        "indices-residual-velocity",
        "perforation",
        "tornado-residual-velocity",
    ];
    let mut expected: Vec<String> = figures
        .iter()
        .flat_map(|name| [format!("{name}.svg"), format!("{name}.png")])
        .collect();
    let tables = [
        "bands.csv",
        "case-as-run.toml",
        "samples.csv",
        "sensitivity.csv",
        "statistics.csv",
    ];
    expected.extend(tables.map(str::to_owned));
    expected.push("uncertainty.json".to_owned());
    expected.sort();
    assert_eq!(names_in(&found), expected);
    let samples = fs::read_to_string(found.join("samples.csv")).unwrap();
    assert_eq!(samples.lines().count(), 1025);
    assert!(
        samples
            .starts_with("projectile.impact_velocity_m_s,recht_ipson.ballistic_limit_m_s,outcome,"),
        "{samples}"
    );
    let object = json(&fs::read_to_string(found.join("uncertainty.json")).unwrap());
    // Half of the difference of two normal variables over its deviation of 7.07 m/s.
    let probability = object["perforation"]["probability"].as_f64().unwrap();
    assert!((probability - 0.638).abs() < 0.004, "{probability}");
    let probabilities: Vec<f64> = object["bands"]
        .as_array()
        .unwrap()
        .iter()
        .map(|band| band["perforation"]["probability"].as_f64().unwrap())
        .collect();
    assert_eq!(probabilities.len(), 11);
    assert!(
        probabilities.is_sorted() && probabilities[0] == 0.0 && probabilities[10] == 1.0,
        "{probabilities:?}"
    );
    for name in figures {
        let svg = fs::read_to_string(found.join(format!("{name}.svg"))).unwrap();
        assert!(svg.contains("</svg>") && !svg.contains("NaN"), "{name}");
    }
}

#[test]
fn what_cannot_be_computed_is_refused() {
    let folder = folder();
    for (arguments, part) in [
        (
            &["case.toml", "--samples", "15"][..],
            "a number of samples is a whole number from 16 to 1048576",
        ),
        (
            &["case.toml", "--quantity", "depth"],
            "invalid value 'depth'",
        ),
        (
            &["case.toml", "--velocity", "400..150"],
            "which is not above its start",
        ),
        (
            &["case.toml", "--velocity", "experiments"],
            "no experiments with a velocity",
        ),
        (
            &[
                "case.toml",
                "--samples",
                "16",
                "--no-indices",
                "--quantity",
                "plug_mass_g",
            ],
            "no run of model `chain` has a value of plug_mass_g",
        ),
        (
            &["case.toml", "--model", "forrestal_concrete"],
            "does not apply to this case",
        ),
    ] {
        let said = run(&folder, arguments);
        assert_eq!((said.code, said.stdout.as_str()), (2, ""), "{arguments:?}");
        assert!(
            flat(&said.stderr).contains(part),
            "{arguments:?}: {}",
            said.stderr
        );
    }
}

#[test]
fn wrong_tables_are_refused_with_their_place() {
    refuses_all_of("bad-uncertainties", 7, |bad, name| {
        percuss(bad, ["uncertainty", name])
    });
}

#[test]
#[cfg(unix)]
fn ctrl_c_ends_it_and_leaves_no_result() {
    use std::{thread, time::Duration};

    use crate::support::{interrupt, spawn};

    let folder = folder();
    let child = spawn(
        folder.path(),
        &[
            "uncertainty",
            "case.toml",
            "--samples",
            "1048576",
            "--out",
            "found",
        ],
    );
    // The copy of the case is written just before the first shot.
    while !folder.path().join("found/case-as-run.toml").exists() {
        thread::sleep(Duration::from_millis(5));
    }
    thread::sleep(Duration::from_millis(300));
    let said = interrupt(child);
    assert!(
        said.contains("the analysis was stopped and left no result"),
        "{said}"
    );
    assert!(!folder.path().join("found/uncertainty.json").exists());
}

/// Mean and spread by axisymmetric runs: numbers of JSON, table and figure agree; a rod without the model has a warning with the reason.
#[test]
fn axisymmetric_runs_correct_mean_and_spread() {
    let folder = folder();
    let arguments = [
        "case.toml",
        "--samples",
        "16",
        "--no-indices",
        "--axisymmetric",
        "4",
    ];
    let said = run(
        &folder,
        &[&arguments[..], &["--json", "--out", "out"]].concat(),
    );
    let object = json(&said.stdout);
    let spread = &object["axisymmetric"];
    assert_eq!(spread["quantity"], "depth_of_penetration_mm");
    assert_eq!(spread["points"].as_array().unwrap().len(), 4);
    let number = |name: &str| spread[name].as_f64().unwrap();
    assert!((0.15..0.3).contains(&number("mean")) && number("correlation") > 0.5);
    assert!(number("standard_error") > 0.0 && number("p05") < number("p95"));
    assert!(
        names_in(&folder.path().join("out"))
            .iter()
            .any(|name| name.starts_with("axisymmetric-depth"))
    );
    let text = ok(&folder, &arguments);
    let words = "axisymmetric depth of penetration, corrected by 4 runs of `axi`";
    assert!(flat(&text).contains(words), "{text}");
    // The pairs have it, too, and a quantity asked for twice stands once.
    let quantity = ["--quantity", "depth_of_penetration_mm"];
    let arguments = [
        &arguments[..],
        &quantity,
        &quantity,
        &["--velocity", "230,300", "--quiet"],
    ];
    let pairs = ok(&folder, &arguments.concat());
    let starts = pairs
        .lines()
        .map(|line| line.split_whitespace().next().unwrap());
    assert_eq!(
        starts.collect::<Vec<_>>(),
        [
            "quantity=depth_of_penetration_mm",
            "axisymmetric.quantity=depth_of_penetration_mm",
            "impact_velocity_m_s=230",
            "impact_velocity_m_s=300"
        ]
    );
    let refused = ok(
        &folder,
        &[
            "blunt.toml",
            "--model",
            "recht_ipson",
            "--samples",
            "16",
            "--no-indices",
            "--axisymmetric",
            "4",
            "--json",
        ],
    );
    let warnings = json(&refused)["warnings"].to_string();
    assert!(warnings.contains("are not corrected: "), "{warnings}");
}
