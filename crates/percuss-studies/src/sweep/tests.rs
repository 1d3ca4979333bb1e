use std::{
    collections::BTreeSet, path::PathBuf, process::Command, sync::atomic::AtomicBool, thread,
};

use super::*;
use crate::{
    made_up::MadeUp,
    outcome::{Outcome, RunResult, Termination},
    scenario::TargetBody,
    validity::ValidityDomain,
};

/// Loads a sweep written into a folder of its own, beside the case that it names.
pub(super) fn load(name: &str, text: &str) -> Result<Sweep, Error> {
    let case =
        PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../cases/paper-table1/scenario.toml");
    load_case(name, &std::fs::read_to_string(case).unwrap(), text)
}

/// The same beside a case of this text.
fn load_case(name: &str, case: &str, text: &str) -> Result<Sweep, Error> {
    let folder = std::env::temp_dir().join(format!("percuss-sweep-{}-{name}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("scenario.toml"), case).unwrap();
    std::fs::write(folder.join("sweep.toml"), text).unwrap();
    let sweep = Sweep::load(folder.join("sweep.toml"));
    std::fs::remove_dir_all(&folder).unwrap();
    sweep
}

pub(super) fn sweep(name: &str, head: &str, parameters: &str) -> Sweep {
    let text = format!("base = 'scenario.toml'\nmodel = 'fdm'\n{head}\n{parameters}");
    load(name, &text).unwrap_or_else(|error| panic!("{name}: {error}"))
}

const LISTS: &str = "
[[parameter]]
key = 'projectile.impact_velocity'
values = ['150 m/s', '200 m/s', '400 m/s']
[[parameter]]
key = 'chain.target_elements'
linear = { from = 40, to = 80, count = 3 }
[[parameter]]
key = 'projectile.length'
log = { from = '1 mm', to = '100 mm', count = 3 }
";

const DISTRIBUTIONS: &str = "
[[parameter]]
key = 'projectile.impact_velocity'
uniform = { from = '100 m/s', to = '400 m/s' }
[[parameter]]
key = 'chain.constraint_factor'
uniform = { from = 1.0, to = 3.0 }
[[parameter]]
key = 'chain.border_shear'
uniform = { from = 0, to = 1 }
";

#[test]
fn a_grid_has_every_combination_and_its_last_parameter_varies_fastest() {
    let sweep = sweep("grid", "design = 'grid'", LISTS);
    assert_eq!(sweep.runs(), 27);
    let at = |i: u64| sweep.run(i).inputs;
    assert_eq!(at(0), [150.0, 40.0, 1.0]);
    assert!((at(1)[2] - 10.0).abs() < 1e-13);
    assert_eq!(at(2), [150.0, 40.0, 100.0]);
    assert_eq!(at(3), [150.0, 60.0, 1.0]);
    assert_eq!(at(9), [200.0, 40.0, 1.0]);
    assert_eq!(at(26), [400.0, 80.0, 100.0]);
    let all: BTreeSet<String> = (0..27).map(|i| format!("{:?}", at(i))).collect();
    assert_eq!(all.len(), 27);
    let scenario = sweep.run(12).scenario.unwrap();
    assert_eq!(scenario.impact_velocity, 200.0);
    assert_eq!(scenario.options.chain.target_elements, Some(60));
    assert_eq!(scenario.projectile.length, 1e-3);
    let columns: Vec<String> = sweep.axes.iter().map(Axis::column).collect();
    assert_eq!(
        columns,
        [
            "projectile.impact_velocity_m_s",
            "chain.target_elements",
            "projectile.length_mm"
        ]
    );
}

#[test]
fn the_longest_list_leaves_room_for_others() {
    let million = "
[[parameter]]
key = 'projectile.impact_velocity'
linear = { from = '150 m/s', to = '400 m/s', count = 1000000 }
[[parameter]]
key = 'chain.constraint_factor'
values = [2.7]
";
    assert_eq!(
        sweep("million", "design = 'grid'", million).runs(),
        1_000_000
    );
}

#[test]
fn a_latin_hypercube_has_one_run_in_every_interval_of_every_margin() {
    for samples in [1_u64, 2, 37, 1000] {
        let head = format!("design = 'latin-hypercube'\nsamples = {samples}\nseed = 4");
        let sweep = sweep("lhs", &head, DISTRIBUTIONS);
        for (dimension, (from, to)) in [(100.0, 400.0), (1.0, 3.0), (0.0, 1.0)].iter().enumerate() {
            let interval = |i: u64| {
                let part = (sweep.run(i).inputs[dimension] - from) / (to - from);
                (part * samples as f64) as u64
            };
            let seen: BTreeSet<u64> = (0..samples).map(interval).collect();
            assert_eq!(seen, (0..samples).collect(), "{samples} {dimension}");
        }
    }
}

#[test]
fn a_seed_gives_the_same_runs_and_another_seed_others() {
    for design in ["latin-hypercube", "sobol"] {
        let with = |seed: u64| {
            let head = format!("design = '{design}'\nsamples = 64\nseed = {seed}");
            let sweep = sweep(&format!("seed-{design}"), &head, DISTRIBUTIONS);
            (0..64).map(|i| sweep.run(i).inputs).collect::<Vec<_>>()
        };
        assert_eq!(with(1), with(1), "{design}");
        assert_ne!(with(1), with(2), "{design}");
        let mut columns: Vec<Vec<f64>> = vec![Vec::new(); 2];
        for inputs in with(1) {
            columns[0].push((inputs[0] - 100.0) / 300.0);
            columns[1].push((inputs[1] - 1.0) / 2.0);
        }
        assert!(
            columns[0].iter().zip(&columns[1]).all(|(a, b)| a != b),
            "{design}"
        );
    }
}

#[test]
fn sobol_runs_fill_the_strata_of_their_margins() {
    let head = "design = 'sobol'\nsamples = 256\nseed = 9";
    let sweep = sweep("sobol", head, DISTRIBUTIONS);
    let stratum = |i: u64| ((sweep.run(i).inputs[0] - 100.0) / 300.0 * 256.0) as u64;
    let seen: BTreeSet<u64> = (0..256).map(stratum).collect();
    assert_eq!(seen.len(), 256);
}

#[test]
fn a_run_that_fails_is_a_row_with_its_error() {
    let text = "
[[parameter]]
key = 'projectile.impact_velocity'
normal = { mean = '100 m/s', standard_deviation = '200 m/s' }
";
    let sweep = sweep("bad-run", "design = 'sobol'\nsamples = 32", text);
    let runs = (0..32).map(|i| sweep.run(i)).collect();
    let rows = ScalarKernel::new(crate::model::model("poncelet").unwrap())
        .rows(runs, &AtomicBool::new(false))
        .unwrap();
    assert_eq!(rows.len(), 32);
    let bad: Vec<&SweepRow> = rows.iter().filter(|row| row.record.is_err()).collect();
    let negative = rows.iter().filter(|row| row.inputs[0] < 0.0).count();
    assert!(negative > 3 && negative < 20, "{negative}");
    assert_eq!(bad.len(), negative);
    let reason = bad[0].record.as_ref().unwrap_err();
    assert!(
        reason.contains("projectile.impact_velocity") && reason.contains("out of range"),
        "{reason}"
    );
}

/// A model with a fault above 300 m/s.
const FAULTY: MadeUp = MadeUp {
    name: "faulty",
    validity: ValidityDomain::OPEN,
    result: |scenario| {
        assert!(scenario.impact_velocity < 300.0, "a wrong {}", "index");
        let end = Termination::ClosedForm;
        Ok(RunResult::new("", "", Outcome::AtRest, end))
    },
};

#[test]
fn a_model_that_panics_costs_one_row() {
    let sweep = sweep("panic", "design = 'grid'", LISTS);
    let runs = (0..27).map(|i| sweep.run(i)).collect();
    let stop = AtomicBool::new(false);
    let rows = ScalarKernel::new(&FAULTY).rows(runs, &stop).unwrap();
    assert_eq!(rows.len(), 27);
    for row in rows {
        let record = row.record.unwrap();
        let failed = row.inputs[0] > 300.0;
        assert_eq!(record.outcome == Outcome::Failed, failed);
        assert_eq!(record.reason.is_some(), failed);
        if let Some(reason) = record.reason {
            assert!(reason.contains("please report it"), "{reason}");
            assert!(reason.contains("tests.rs:"), "{reason}");
            assert!(reason.ends_with(": a wrong index"), "{reason}");
        }
    }
    // Any other panic says so as ever; the next test sees it.
    let elsewhere = thread::spawn(|| panic!("not in a run")).join();
    assert!(elsewhere.is_err());
}

#[test]
fn a_model_that_panics_prints_nothing() {
    let output = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "--nocapture"])
        .arg("sweep::tests::a_model_that_panics_costs_one_row")
        .output()
        .unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{said}");
    assert!(said.contains("not in a run"), "{said}");
    assert!(!said.contains("wrong index"), "{said}");
}

#[test]
fn words_and_switches_are_varied_like_numbers() {
    let text = "
[[parameter]]
key = 'projectile.material'
values = ['copper', '4340-johnson-cook']
[[parameter]]
key = 'chain.rate_effects'
values = [true, false]
[[parameter]]
key = 'chain.target_resistance'
values = ['column', 'diverging', 'expanding-cavity']
";
    let grid = sweep("words", "design = 'grid'", text);
    assert_eq!(grid.runs(), 12);
    assert_eq!(grid.run(11).inputs, [1.0, 1.0, 2.0]);
    let scenario = grid.run(8).scenario.unwrap();
    assert!(scenario.projectile.material.name.contains("4340"));
    assert_eq!(scenario.options.chain.rate_effects, Some(true));
    assert_eq!(
        scenario.options.chain.target_resistance.unwrap().name(),
        "expanding-cavity"
    );
    let words: Vec<_> = grid.axes.iter().filter_map(Axis::words).collect();
    assert_eq!(words[1], ["true", "false"]);
    assert_eq!(words[0][1], "4340-johnson-cook");
    // In a random design every word is as likely as the others.
    let drawn = sweep(
        "random-words",
        "design = 'latin-hypercube'\nsamples = 48",
        text,
    );
    for word in 0..3 {
        let count = (0..48).filter(|i| drawn.run(*i).inputs[2] == f64::from(word));
        assert_eq!(count.count(), 16);
    }
}

#[test]
fn materials_are_varied_by_any_of_their_names() {
    for key in ["projectile.material", "target.layers.0.material"] {
        let text = format!("[[parameter]]\nkey = '{key}'\nvalues = ['304', 'copper', '4340']");
        let case = "
[projectile]
material = 'copper'
length = '20 mm'
diameter = '5 mm'
impact_velocity = '300 m/s'
[target]
layers = [{ material = 'copper', thickness = '20 mm' }]
";
        let grid = load_case(
            "digits",
            case,
            &format!("base = 'scenario.toml'\ndesign = 'grid'\n{text}"),
        );
        let grid = grid.unwrap_or_else(|error| panic!("{key}: {error}"));
        let ids: Vec<String> = (0..3)
            .map(|i| {
                let scenario = grid.run(i).scenario.unwrap();
                match &scenario.target {
                    TargetBody::Layers { layers, .. } if key.starts_with("target") => {
                        layers[0].material_id.clone()
                    }
                    _ => scenario.projectile.material_id.clone(),
                }
            })
            .collect();
        assert_eq!(ids[0], "304-steinberg", "{key}");
        assert_eq!(ids[2], "4340-johnson-cook", "{key}");
        assert_eq!(grid.axes[0].words().unwrap(), ["304", "copper", "4340"]);
    }
    // A key that takes no name still refuses a quoted number without a unit.
    let speeds = "base = 'scenario.toml'\ndesign = 'grid'\n[[parameter]]\nkey = 'projectile.impact_velocity'\nvalues = ['230 m/s', '4340']";
    let error = load("no-unit", speeds).unwrap_err().to_string();
    assert!(error.contains("`4340` has no unit"), "{error}");
    assert!(error.contains("parameter.0.values.1"), "{error}");
}

#[test]
fn a_stopped_sweep_gives_no_rows() {
    let sweep = sweep("stop", "design = 'grid'", LISTS);
    let kernel = ScalarKernel::new(sweep.model);
    let runs = || sweep.block(0).map(|i| sweep.run(i)).collect();
    assert_eq!(kernel.rows(runs(), &AtomicBool::new(true)), Err(Stopped));
    assert!(kernel.rows(runs(), &AtomicBool::new(false)).is_ok());
}

#[test]
fn blocks_cover_all_runs() {
    let sweep = sweep("blocks", "design = 'grid'\nblock_size = 4", LISTS);
    let all: Vec<u64> = (0..sweep.blocks()).flat_map(|b| sweep.block(b)).collect();
    assert_eq!((sweep.blocks(), all), (7, (0..27).collect()));
}

#[test]
fn rows_do_not_depend_on_the_kernel_nor_on_the_blocks() {
    // Columns ride side by side, expanding cavities are left to the single run.
    let head = "base = 'scenario.toml'\nmodel = 'chain'\ndesign = 'grid'";
    let mesh = "[[parameter]]\nkey = 'chain.projectile_elements'\nvalues = [8, 10]\n[[parameter]]\nkey = 'chain.target_elements'\nvalues = [16]";
    let speeds = "[[parameter]]\nkey = 'projectile.impact_velocity'\nlinear = { from = '60 m/s', to = '400 m/s', count = 5 }";
    let shear = "[[parameter]]\nkey = 'chain.border_shear'\nvalues = [0.0, 0.577]";
    for (name, parameters) in [
        ("columns", format!("{speeds}\n{shear}\n{mesh}")),
        ("cavities", format!("{speeds}\n{mesh}")),
    ] {
        let sweep = load(name, &format!("{head}\n{parameters}")).unwrap();
        let runs = |from, to| (from..to).map(|i| sweep.run(i)).collect::<Vec<SweepRun>>();
        let stop = AtomicBool::new(false);
        let count = sweep.runs();
        let expected = ScalarKernel::new(sweep.model).rows(runs(0, count), &stop);
        let kernel = BatchKernel::new(sweep.model);
        assert_eq!(kernel.rows(runs(0, count), &stop), expected, "{name}");
        let expected = expected.unwrap();
        for size in [1, 7] {
            let mut rows = Vec::new();
            for from in (0..count).step_by(size as usize) {
                rows.extend(
                    kernel
                        .rows(runs(from, count.min(from + size)), &stop)
                        .unwrap(),
                );
            }
            assert_eq!(rows, expected, "{name} in blocks of {size}");
        }
    }
}
