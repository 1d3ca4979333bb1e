//! Runs without a result, threads, and analyses that end early.

use std::sync::Mutex;

use super::*;

#[test]
fn runs_that_fail_are_counted_and_left_out() {
    let kernel = Linear { fails_above: 236.0 };
    let found = analysed(&study(NORMALS), &kernel, &settings(1024));
    let failed = found
        .draws
        .iter()
        .filter(|draw| draw.inputs[0] > 236.0)
        .count();
    // One normal variable in 15 is more than 1.5 deviations above its mean.
    assert!((60..77).contains(&failed), "{failed}");
    assert_eq!(found.failures.runs, failed);
    let depth = &found.quantities[0];
    assert_eq!(
        (depth.statistics.runs, depth.without_value),
        (1024 - failed, 0)
    );
    let rows = depth.indices.as_ref().unwrap().rows;
    assert!(rows < 512 - failed / 2 && rows > 400, "{rows}");
    assert!(
        found.warnings[0].contains("have no result and are left out"),
        "{:?}",
        found.warnings
    );
    let perforation = found.perforation.unwrap();
    assert_eq!(
        (perforation.undecided, perforation.probability),
        (failed, 0.0)
    );
}

#[test]
fn threads_make_no_difference_and_progress_reaches_its_end() {
    let study = study(NORMALS);
    let with = |threads| {
        let reached = Mutex::new((0, 0));
        let observer = Observer {
            stop: &AtomicBool::new(false),
            progress: &|done, total| {
                let mut reached = reached.lock().unwrap();
                *reached = (done.max(reached.0), total);
            },
        };
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        let chain = model("chain").unwrap();
        let found = pool.install(|| analyse(&study, chain, &LINEAR, &settings(128), &observer));
        let (done, total) = *reached.lock().unwrap();
        assert_eq!((done, total), (6 + 128 + 64 * 4, 6 + 128 + 64 * 4));
        found.unwrap()
    };
    assert_eq!(with(1), with(3));
}

/// A kernel that counts the runs that end at rest.
struct Counted {
    kernel: ScalarKernel,
    to_rest: AtomicU32,
}

impl Kernel for Counted {
    fn rows(&self, runs: Vec<SweepRun>, stop: &AtomicBool) -> Result<Vec<SweepRow>, Stopped> {
        let to_rest = |run: &&SweepRun| {
            let scenario = run.scenario.as_ref().unwrap();
            scenario.options.chain.end_at_rest()
        };
        let count = runs.iter().filter(to_rest).count();
        self.to_rest.fetch_add(count as u32, Ordering::Relaxed);
        self.kernel.rows(runs, stop)
    }
}

#[test]
fn indices_of_a_depth_are_those_of_whole_runs() {
    const COARSE: &str = "chain = { projectile_elements = 8, target_elements = 16 }\n";
    let study = load(&format!("{CASE}{COARSE}{NORMALS}")).unwrap();
    let with = |names: &[&str]| {
        let quantities = names.iter().map(|name| quantity(name).unwrap());
        let settings = Settings {
            quantities: quantities.collect(),
            ..settings(32)
        };
        let kernel = Counted {
            kernel: ScalarKernel::new(model("chain").unwrap()),
            to_rest: AtomicU32::new(0),
        };
        let found = analysed(&study, &kernel, &settings);
        let depth = found.quantities[0].clone();
        assert_eq!(depth.quantity, "depth_of_penetration_mm");
        assert!(depth.indices.is_some(), "{:?}", depth.no_indices);
        (depth, kernel.to_rest.into_inner())
    };
    let (depth, to_rest) = with(&["depth_of_penetration_mm"]);
    let (of_whole_runs, none) = with(&["depth_of_penetration_mm", "permanent_depth_mm"]);
    assert_eq!((to_rest % 4, none), (0, 0));
    assert!(to_rest >= 4 * 16, "{to_rest}");
    assert_eq!(depth, of_whole_runs);
}

#[test]
fn a_stopped_analysis_says_so_and_a_model_that_does_not_apply_why() {
    let study = study(NORMALS);
    let chain = model("chain").unwrap();
    let stop = AtomicBool::new(true);
    let observer = |stop| Observer {
        stop,
        progress: &|_, _| {},
    };
    let ended = analyse(&study, chain, &LINEAR, &settings(64), &observer(&stop));
    assert!(matches!(ended, Err(Error::Cancelled { .. })));
    let concrete = model("forrestal_concrete").unwrap();
    let go = AtomicBool::new(false);
    let kernel = ScalarKernel::new(concrete);
    let ended = analyse(&study, concrete, &kernel, &settings(64), &observer(&go));
    assert!(
        matches!(ended, Err(Error::NotApplicable { .. })),
        "{ended:?}"
    );
}

#[test]
fn a_case_without_the_table_says_what_to_write() {
    let error = load(CASE).unwrap_err().to_string();
    assert!(error.contains("has no uncertain parameters"), "{error}");
    assert!(error.contains("[[uncertainty.parameter]]"), "{error}");
}
