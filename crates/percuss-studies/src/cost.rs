//! Estimated cost of the runs of a study, before it starts, and how many of them fit into the memory.

use crate::{
    Scenario,
    model::{self, Estimate, Model, memory::memory_limit},
};

/// Processor time to make the case of a run and to use its result, measured [s].
const OF_A_CASE: f64 = 3e-4;

/// Estimated cost of many runs of one model, each of a case that is made for it.
pub fn of_runs(of_one: Estimate, runs: f64) -> Estimate {
    let Estimate { seconds, .. } = of_one;
    let whole = Estimate {
        seconds: seconds + OF_A_CASE,
        ..of_one
    };
    whole.times(runs)
}

/// Estimated cost of a model's run of a case; of none where the model does not apply.
pub fn of_run(model: &dyn Model, scenario: &Scenario) -> Estimate {
    match model::applicability(model, scenario) {
        Ok(_) => model.estimate(scenario),
        Err(_) => Estimate::LITTLE,
    }
}

/// Computes runs side by side in so few threads that they stay within the limit of memory together, where each thread takes `memory`
/// [bytes]; one run may take all of it.
pub fn within_memory<T: Send>(memory: f64, work: impl FnOnce() -> T + Send) -> T {
    let fitting = (memory_limit() as f64 / memory).max(1.0) as usize;
    if fitting >= rayon::current_num_threads() {
        return work();
    }
    match rayon::ThreadPoolBuilder::new().num_threads(fitting).build() {
        Ok(pool) => pool.install(work),
        // Without a thread more there is no memory for it either: the system refuses what is too much.
        Err(_) => work(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_that_fill_the_memory_together_are_computed_by_fewer_threads() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(8).build();
        let limit = memory_limit() as f64;
        let threads = |memory: f64| {
            let pool = pool.as_ref().unwrap();
            pool.install(|| within_memory(memory, rayon::current_num_threads))
        };
        for (memory, expected) in [
            (0.0, 8),
            (limit / 100.0, 8),
            (limit / 7.9, 7),
            (limit / 3.1, 3),
            (0.6 * limit, 1),
            (3.0 * limit, 1),
            (f64::INFINITY, 1),
        ] {
            assert_eq!(threads(memory), expected, "{memory} of {limit}");
        }
    }
}
