//! Titles and captions of figures: a long title of a case stands below the title of the figure, and none of both is cut.

use std::{fs, path::Path};

use crate::support::{folder_with, percuss};

/// 70 characters.
const TITLE: &str = "A short copper rod at a moderate velocity on thick 2024-T351 aluminium";

const CASE: &str = "
projectile = { material = 'copper', length = '12.74 mm', diameter = '4.8 mm', impact_velocity = '230 m/s' }
target = { material = 'aluminium-2024-t351', thickness = '25 mm' }
chain = { projectile_elements = 20, target_elements = 40 }
[uncertainty]
[[uncertainty.parameter]]
key = 'projectile.impact_velocity'
uniform = { from = '220 m/s', to = '240 m/s' }
";

const PLATE: &str = "
projectile = { material = 'tool-steel-hrc53', mass = '197 g', diameter = '20 mm', impact_velocity = '187 m/s' }
target = { material = 'weldox-460-e', thickness = '12 mm', back_face = 'free' }
recht_ipson = { ballistic_limit = '184.5 m/s' }
[uncertainty]
[[uncertainty.parameter]]
key = 'projectile.impact_velocity'
normal = { mean = '187 m/s', standard_deviation = '5 m/s' }
";

const SWEEP: &str = "
base = 'case.toml'
design = 'grid'
[[parameter]]
key = 'projectile.impact_velocity'
values = ['200 m/s', '230 m/s', '260 m/s']
[[parameter]]
key = 'projectile.length'
values = ['6 mm', '12 mm']
";

const TESTS: &str = "impact_velocity_m_s,perforated
180,no
186,no
187,yes
186.5,no
186.2,yes
190,yes
";

/// Drawings in a folder: name and content of each.
fn drawings(folder: &Path) -> Vec<(String, String)> {
    let files = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let svgs = files.filter(|path| path.extension().is_some_and(|end| end == "svg"));
    svgs.map(|path| {
        (
            path.display().to_string(),
            fs::read_to_string(&path).unwrap(),
        )
    })
    .collect()
}

#[test]
fn no_title_is_cut_where_the_case_has_one_of_70_characters() {
    assert_eq!(TITLE.chars().count(), 70);
    let titled = |text: &str| format!("title = '{TITLE}'\n{text}");
    let folder = folder_with(&[
        ("case.toml", &titled(CASE)),
        ("plate.toml", &titled(PLATE)),
        ("sweep.toml", SWEEP),
        ("tests.csv", TESTS),
    ]);
    let run = |line: &str| {
        let said = percuss(folder.path(), line.split_whitespace());
        assert_eq!(said.code, 0, "{line}: {}", said.stderr);
    };
    run("sweep sweep.toml --out rows --quiet");
    // The sweep's figures are drawn in all styles.
    for (line, kinds) in [
        ("run case.toml --fast", 7),
        ("compare case.toml --fast", 1),
        ("compare case.toml --fast --velocity 200,300,400", 1),
        ("limit plate.toml --fast --tests tests.csv", 2),
        ("converge case.toml --levels 3", 4),
        ("uncertainty case.toml --samples 64", 6),
        (
            "uncertainty plate.toml --model recht_ipson --samples 64 --velocity 150..260",
            5,
        ),
        ("sweep plot rows --style curves", 1),
        ("sweep plot rows --style map", 1),
        ("sweep plot rows --style parallel", 1),
    ] {
        let out = line.replace([' ', '/'], "-");
        run(&format!("{line} --figures svg --out {out}"));
        let drawn = drawings(&folder.path().join(&out));
        assert!(drawn.len() >= kinds, "{line}: {} figures", drawn.len());
        for (name, svg) in drawn {
            assert!(!svg.contains('…'), "{name}: {svg}");
            // V50 is that of a file of tests.
            let has_case = !name.ends_with("v50.svg");
            assert!(!has_case || svg.contains("A short copper rod at"), "{name}");
        }
    }
}
