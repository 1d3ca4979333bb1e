//! `percuss sweep plot`: the figure that suits what is varied, with every shot shown or counted.

use std::fs;

use tempfile::TempDir;

use crate::support::{Said, flat, folder_with, percuss};

const CASE: &str = "
projectile = { material = 'copper', length = '12.74 mm', diameter = '4.8 mm', impact_velocity = '230 m/s' }
target = { material = 'aluminium-2024-t351', thickness = '25 mm' }
chain = { projectile_elements = 10, target_elements = 20 }
";
const SPEEDS: &str = "[[parameter]]
key = 'projectile.impact_velocity'
linear = { from = '150 m/s', to = '400 m/s', count = 8 }\n";
/// Some of the speeds are negative, which no case has.
const DRAWN_SPEEDS: &str = "[[parameter]]
key = 'projectile.impact_velocity'
normal = { mean = '150 m/s', standard_deviation = '120 m/s' }\n";
const RESISTANCE_MODELS: &str = "[[parameter]]
key = 'chain.target_resistance'
values = ['column', 'diverging', 'expanding-cavity']\n";
const LENGTHS: &str = "[[parameter]]
key = 'projectile.length'
log = { from = '4 mm', to = '20 mm', count = 7 }\n";

/// Computes a sweep into `rows`.
fn computed(design: &str, parameters: &[&str]) -> TempDir {
    let head = format!("base = 'scenario.toml'\nmodel = 'chain'\n{design}\nblock_size = 10\n");
    let text = head + &parameters.concat();
    let folder = folder_with(&[("scenario.toml", CASE), ("sweep.toml", &text)]);
    let arguments = ["sweep", "sweep.toml", "--out", "rows", "--quiet"];
    let said = percuss(folder.path(), arguments);
    assert_eq!((said.code, said.stderr.as_str()), (0, ""));
    folder
}

fn plot(folder: &TempDir, more: &[&str]) -> Said {
    let arguments = [&["sweep", "plot", "rows", "--out", "figures"], more].concat();
    percuss(folder.path(), arguments)
}

/// The drawing that a command makes; the PNG has to be there too.
fn drawn(folder: &TempDir, more: &[&str], name: &str) -> String {
    let said = plot(folder, more);
    assert_eq!((said.code, said.stderr.as_str()), (0, ""), "{more:?}");
    assert!(
        said.stdout.contains(&format!("{name}.png")),
        "{}",
        said.stdout
    );
    let png = fs::read(folder.path().join(format!("figures/{name}.png"))).unwrap();
    assert!(png.starts_with(b"\x89PNG") && png.len() > 5000);
    fs::read_to_string(folder.path().join(format!("figures/{name}.svg"))).unwrap()
}

const DEPTH: &str = "depth_of_penetration_mm";

#[test]
fn one_parameter_makes_a_curve_and_words_make_one_each() {
    let folder = computed("design = 'grid'", &[SPEEDS, RESISTANCE_MODELS]);
    let svg = drawn(&folder, &[], &format!("curves-{DEPTH}"));
    for word in [
        "column",
        "diverging",
        "expanding-cavity",
        "Impact velocity (m/s)",
        "24 runs",
    ] {
        assert!(svg.contains(word), "{word}");
    }
    assert!(svg.contains("Depth of penetration (mm)"));
    assert!(!svg.contains("failed"));
    let more = ["--quantity", "peak_force_kn", "--style", "map"];
    let svg = drawn(&folder, &more, "map-peak_force_kn");
    assert!(svg.contains("Peak force (kN)") && svg.contains("Target resistance"));
    // Closures in a folder that lacks a block: what is missing is counted.
    fs::remove_file(folder.path().join("rows/block-000001.parquet")).unwrap();
    let svg = drawn(&folder, &[], &format!("curves-{DEPTH}"));
    assert!(svg.contains("14 runs, 10 more not computed yet"), "{svg}");
}

#[test]
fn two_parameters_make_a_map() {
    let folder = computed("design = 'grid'", &[SPEEDS, LENGTHS]);
    let svg = drawn(&folder, &[], &format!("map-{DEPTH}"));
    assert!(svg.contains("Projectile length (mm)") && svg.contains("56 runs"));
    // A cell for each shot: the runs of one colour make up all of them.
    let runs = svg.split("h-").count() - 1;
    assert!(runs > 20, "{runs}");
}

#[test]
fn runs_that_failed_are_shown_and_counted() {
    let folder = computed("design = 'sobol'\nsamples = 40", &[DRAWN_SPEEDS]);
    let svg = drawn(&folder, &[], &format!("curves-{DEPTH}"));
    let failed = count(&svg, "failed (", ')');
    assert!((2..20).contains(&failed), "{failed}");
    assert!(svg.contains(&format!("40 runs, {failed} failed")));
    let folder = computed(
        "design = 'sobol'\nsamples = 40",
        &[DRAWN_SPEEDS, RESISTANCE_MODELS, LENGTHS],
    );
    let svg = drawn(&folder, &[], &format!("parallel-{DEPTH}"));
    let failed = count(&svg, "failed (", ')');
    assert!((2..20).contains(&failed), "{failed}");
    // A dashed line for each of them, and a full one for each of the others.
    assert_eq!(svg.matches("stroke-dasharray").count() as u64, failed);
    assert_eq!(svg.matches("stroke-opacity=\"0.6\"").count(), 40);
    let named = ["--x", "projectile.impact_velocity"];
    let svg = drawn(&folder, &named, &format!("curves-{DEPTH}"));
    assert_eq!(count(&svg, "failed (", ')'), failed);
    assert!(svg.contains("over all values of Target resistance"));
}

/// The number that stands between two texts.
fn count(svg: &str, before: &str, after: char) -> u64 {
    let rest = &svg[svg.find(before).unwrap() + before.len()..];
    rest[..rest.find(after).unwrap()].parse().unwrap()
}

#[test]
fn the_title_of_a_figure_is_that_of_the_sweep_or_the_result_and_its_caption_has_the_case() {
    let case = format!("title = 'A rod of copper'\n{CASE}");
    for (title, expected) in [("", "Depth of penetration"), ("title = 'Speeds'", "Speeds")] {
        let text = format!("base = 'scenario.toml'\ndesign = 'grid'\n{title}\n{SPEEDS}");
        let folder = folder_with(&[("scenario.toml", &case), ("sweep.toml", &text)]);
        let arguments = ["sweep", "sweep.toml", "--out", "rows", "--quiet"];
        assert_eq!(percuss(folder.path(), arguments).code, 0);
        let svg = drawn(&folder, &[], &format!("curves-{DEPTH}"));
        assert!(svg.contains(&format!(">{expected}</text>")), "{title}");
        assert!(svg.contains(">A rod of copper; model chain, "), "{svg}");
    }
}

#[test]
fn a_request_that_does_not_fit_is_refused_with_what_does() {
    let folder = computed("design = 'grid'", &[SPEEDS]);
    let refused = |more: &[&str], words: [&str; 2]| {
        let said = plot(&folder, more);
        let flat = flat(&said.stderr);
        assert_eq!(said.code, 2, "{more:?}: {flat}");
        assert!(
            words.iter().all(|word| flat.contains(word)),
            "{more:?}: {flat}"
        );
    };
    refused(
        &["--quantity", "depth"],
        [
            "the sweep has no result `depth`",
            "did you mean `depth_of_penetration_mm`?",
        ],
    );
    refused(
        &["--quantity", "peak_force"],
        ["no result `peak_force`", "did you mean `peak_force_kn`?"],
    );
    refused(
        &["--x", "impact_velocity"],
        [
            "does not vary `impact_velocity`",
            "did you mean `projectile.impact_velocity`?",
        ],
    );
    refused(
        &["--x", "target.thickness"],
        [
            "does not vary `target.thickness`",
            "projectile.impact_velocity",
        ],
    );
    refused(
        &["--style", "map"],
        ["a map needs two parameters", "--style curves"],
    );
    let same = [
        "--x",
        "projectile.impact_velocity",
        "--y",
        "projectile.impact_velocity",
    ];
    refused(&same, ["the same parameter", "name two"]);
    let said = percuss(folder.path(), ["sweep", "plot", "."]);
    assert_eq!(said.code, 2);
    assert!(said.stderr.contains("no manifest.json"), "{}", said.stderr);
}
