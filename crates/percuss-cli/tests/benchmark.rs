//! `percuss benchmark` on a small reference of its own.

use std::{fs, path::Path};

use serde_json::Value;
use tempfile::TempDir;

use crate::support::{json, percuss, whole_report};

/// Made up: two runs on three meshes, one that fails the check on three and one on two, and one of no shot of the design.
const REFERENCE: &str = "\
projectile,target,length_to_diameter,impact_velocity_m_s,cells_per_radius,depth_of_penetration_mm,largest_depth_mm,projectile_final_length_mm,projectile_final_diameter_mm,outcome,energy_residual,transfer_loss,steps,particles
copper-woodward,aluminium-2024-t351-woodward,1.0,600.0,4,1.8,1.9,3.0,8.0,rebounded,0.002,0.05,1000,6000
copper-woodward,aluminium-2024-t351-woodward,1.0,600.0,8,1.9,1.9,3.0,8.0,rebounded,0.002,0.05,2000,24000
copper-woodward,aluminium-2024-t351-woodward,1.0,600.0,16,1.95,1.96,3.0,8.0,rebounded,0.002,0.05,4000,96000
4340-johnson-cook,6061-t6-lesuer,1.0,300.0,4,1.1,1.3,,,rebounded,0.002,0.05,1000,6000
4340-johnson-cook,6061-t6-lesuer,1.0,300.0,8,1.2,1.3,,,rebounded,0.002,0.05,2000,24000
4340-johnson-cook,6061-t6-lesuer,1.0,300.0,16,1.15,1.3,,,rebounded,0.002,0.05,4000,96000
6061-t6-lesuer,4340-johnson-cook,1.0,300.0,4,1.0,1.3,,,rebounded,0.002,0.05,1000,6000
6061-t6-lesuer,4340-johnson-cook,1.0,300.0,8,1.4,1.4,,,rebounded,0.002,0.05,2000,24000
6061-t6-lesuer,4340-johnson-cook,1.0,300.0,16,1.8,1.8,,,rebounded,0.002,0.05,4000,96000
6061-t6-lesuer,4340-johnson-cook,1.0,600.0,4,1.0,1.3,,,rebounded,0.002,0.05,1000,6000
6061-t6-lesuer,4340-johnson-cook,1.0,600.0,8,1.0,1.4,,,rebounded,0.002,0.05,2000,24000
copper-woodward,aluminium-2024-t351-woodward,1.0,601.0,8,1.9,1.9,3.0,8.0,rebounded,0.002,0.05,2000,24000
";

fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("own.csv"), REFERENCE).unwrap();
    folder
}

#[track_caller]
fn ok(folder: &Path, arguments: &[&str]) -> String {
    let said = percuss(
        folder,
        [&["benchmark", "--reference", "own.csv"], arguments].concat(),
    );
    said.ok()
}

#[test]
fn models_are_compared_with_a_reference() {
    let folder = folder();
    let text = ok(folder.path(), &[]);
    for part in [
        "reference: own.csv (12 rows)\n",
        "- 2 cases have a reference that passes its convergence check on three meshes",
        "- 2 more cases are left out of all numbers",
        "all cases, errors in % (P10-P90: 10th-90th percentile)\n",
        "chain: diverging-penetrable",
        "median error in % by L/D\n",
        "case of the seed paper, one change at a time",
    ] {
        assert!(text.contains(part), "{part:?} is not in:\n{text}");
    }
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    let by = ok(folder.path(), &["--by", "regime", "--by", "materials"]);
    assert!(
        by.contains("\ncopper-woodward on aluminium-2024-t351-woodward\n"),
        "{by}"
    );
    let lines = ok(folder.path(), &["--quiet"]);
    assert!(
        lines.starts_with("candidate=chain:column count=2 median="),
        "{lines}"
    );
}

/// The other design has its own stored reference, and says which models were developed with it in view.
#[test]
fn the_spread_design_says_whose_errors_are_blind() {
    let folder = folder();
    let text = percuss(
        folder.path(),
        ["benchmark", "--design", "spread", "--by", "length"],
    )
    .ok();
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let rule = "The forms of `chain: expanding-cavity`, `energy_balance` and `momentum_balance` were chosen or corrected with these cases in \
                view, so their errors are not blind. - No other model was developed on these cases: the errors are blind.";
    assert!(words.contains(rule), "{text}");
    assert!(
        !text.contains("combinations of velocity and length"),
        "{text}"
    );
    let all = percuss(
        folder.path(),
        ["benchmark", "--design", "spread", "--quiet"],
    )
    .ok();
    let count = all
        .split_whitespace()
        .find_map(|pair| pair.strip_prefix("count="));
    assert!(count.unwrap().parse::<u32>().unwrap() > 60, "{all}");
}

#[test]
fn json_holds_statistics_and_verdicts_of_the_extrapolated_reference() {
    let folder = folder();
    let json = json(&ok(folder.path(), &["--json"]));
    let verdicts = json["verdicts"].as_array().unwrap();
    let of = |speed: f64| {
        let own =
            |v: &&Value| v["impact_velocity_m_s"] == speed && v["candidate"] == "chain: column";
        verdicts.iter().find(own).unwrap()
    };
    assert!((of(600.0)["reference_depth_mm"].as_f64().unwrap() - 2.0).abs() < 1e-9);
    assert!((of(600.0)["reference_uncertainty_mm"].as_f64().unwrap() - 0.0625).abs() < 1e-9);
    assert!((of(300.0)["reference_depth_mm"].as_f64().unwrap() - 1.15).abs() < 1e-12);
    assert!((of(300.0)["reference_uncertainty_mm"].as_f64().unwrap() - 0.1).abs() < 1e-12);
    let refused = json["refused"].as_array().unwrap();
    assert_eq!(refused.len(), 2);
    let reason = |speed: f64| {
        let own =
            |r: &&Value| r["projectile"] == "6061-t6-lesuer" && r["impact_velocity_m_s"] == speed;
        refused.iter().find(own).unwrap()["reason"]
            .as_str()
            .unwrap()
    };
    let three = reason(300.0);
    assert!(
        three.contains("the meshes leave an uncertainty of 44 %, more than 15 %"),
        "{three}"
    );
    // Two meshes that agree to the last digit are still two.
    assert_eq!(reason(600.0), "fewer than three meshes");
    assert!(verdicts.iter().all(|v| v["projectile"] != "6061-t6-lesuer"));
    let all = &json["statistics"][0];
    assert_eq!(
        (&all["candidate"], &all["grouping"], &all["count"]),
        (&"chain: column".into(), &"all".into(), &2.into())
    );
    assert_eq!(json["failures"], serde_json::json!([]));
    assert!(json["findings"].as_array().unwrap().len() > 3);
    assert!(json["variants"].as_array().unwrap().len() >= 14);
}

#[test]
fn the_report_is_written_whole() {
    let folder = folder();
    ok(folder.path(), &["--out", "report"]);
    let read = |name: &str| fs::read_to_string(folder.path().join("report").join(name)).unwrap();
    let parts = [
        "<h2>Findings</h2>",
        "4: 1.8, 8: 1.9, 16: 1.95",
        "2 ± 0.06",
        "refused: fewer than three meshes",
        "2 cases left out: their reference fails its check",
        "percuss benchmark --reference own.csv --out report",
    ];
    let tables = ["verdicts.parquet", "statistics.parquet", "variants.parquet"];
    let report = folder.path().join("report");
    let [_, markdown] = whole_report(&report, "benchmark", &parts, &tables);
    assert!(markdown.contains("error-chain-column.png"), "{markdown}");
    let header = read("verdicts.csv").lines().next().unwrap().to_owned();
    assert!(
        header.starts_with("candidate,projectile,target,"),
        "{header}"
    );
    let references = read("references.csv");
    assert!(
        references.contains("an uncertainty of 44 %")
            && references.contains("fewer than three meshes"),
        "{references}"
    );
}

fn refused(arguments: &[&str], code: i32) -> String {
    let folder = folder();
    let only_header = REFERENCE.lines().next().unwrap().to_owned() + "\n";
    fs::write(folder.path().join("empty.csv"), only_header).unwrap();
    let coarse: Vec<&str> = REFERENCE.lines().take(2).collect();
    fs::write(folder.path().join("coarse.csv"), coarse.join("\n") + "\n").unwrap();
    let wrong = REFERENCE.replace("600.0,8,1.9", "600.0,8,deep");
    fs::write(folder.path().join("wrong.csv"), wrong).unwrap();
    let said = percuss(folder.path(), [&["benchmark"], arguments].concat());
    assert_eq!(
        (said.code, said.stdout.as_str()),
        (code, ""),
        "{}",
        said.stderr
    );
    said.stderr
}

#[test]
fn wrong_arguments_and_files_are_refused() {
    let empty = refused(&["--reference", "empty.csv"], 2);
    assert!(
        empty.contains("no reference depth in empty.csv") && empty.contains("--compute"),
        "{empty}"
    );
    let coarse = refused(&["--reference", "coarse.csv"], 2);
    assert!(
        coarse.contains("no reference in coarse.csv (1 rows) passes the convergence check")
            && coarse.contains("fewer than three meshes")
            && coarse.contains("--cells 4, 8 and 12"),
        "{coarse}"
    );
    let none = refused(&["--reference", "none.csv"], 4);
    assert!(
        none.contains("cannot read `none.csv`: there is no such file"),
        "{none}"
    );
    let wrong = refused(&["--reference", "wrong.csv"], 4);
    assert!(
        wrong.contains("wrong.csv") && wrong.contains("line: 3"),
        "{wrong}"
    );
    let nowhere = refused(&["--compute"], 2);
    assert!(nowhere.contains("--reference FILE"), "{nowhere}");
    refused(&["--cells", "8"], 2);
    refused(&["--by", "moon"], 2);
}

#[test]
fn the_former_name_of_the_command_is_refused_with_the_name_of_today() {
    let folder = folder();
    let said = percuss(folder.path(), ["judge", "--reference", "own.csv"]);
    assert_eq!((said.code, said.stdout.as_str()), (2, ""));
    let stderr = said.stderr;
    assert!(
        stderr.contains("the command `judge` is now `benchmark`"),
        "{stderr}"
    );
    // Other words get no such tip.
    let other = percuss(folder.path(), ["jugde"]);
    assert_eq!(other.code, 2);
    assert!(!other.stderr.contains("is now"), "{}", other.stderr);
}
