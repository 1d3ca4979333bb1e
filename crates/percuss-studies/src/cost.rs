//! Estimated cost of the runs of a study, before it starts.

use crate::{
    Scenario,
    model::{self, Estimate, Model},
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
