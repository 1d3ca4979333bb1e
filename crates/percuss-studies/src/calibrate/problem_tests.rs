use std::{
    ops::ControlFlow,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

use super::*;
use crate::{case::Document, model::model};

const NO_SAMPLE: Settings = Settings {
    sampling: None,
    seed: 0,
};

/// A caller on another thread ends it, before it has begun as well.
#[test]
fn a_problem_that_is_stopped_computes_nothing() {
    let stop = Arc::new(AtomicBool::new(false));
    let set_up = || {
        let text = "projectile = { material = 'copper', length = '20 mm', diameter = '8 mm', impact_velocity = '200 m/s' }
            target = { rigid_wall = true }
            experiments = [{ impact_velocity = '200 m/s', projectile_final_length = '15 mm', source = 'test' }]";
        let mut observations = Observations::default();
        let case = Document::new("rod", text);
        observations.add_case(&case).unwrap();
        let fitted = Fitted::read("projectile.length=10..30 mm").unwrap();
        Problem::stoppable(
            model("chain").unwrap(),
            fitted,
            observations,
            Noise::Relative(0.02),
            stop.clone(),
        )
    };
    let problem = set_up().unwrap();
    stop.store(true, Ordering::Relaxed);
    let before = problem.runs.load(Ordering::Relaxed);
    let ended = run(&problem, &NO_SAMPLE, &|_, _, _| ControlFlow::Continue(()));
    assert!(matches!(ended, Err(Error::Cancelled { .. })), "{ended:?}");
    assert!(problem.runs.load(Ordering::Relaxed) <= before + 1);
    assert!(matches!(set_up(), Err(Error::Cancelled { .. })));
}
