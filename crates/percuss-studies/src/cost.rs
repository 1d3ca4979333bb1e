//! Estimated cost of the runs of a study, before it starts.

use crate::{
    Scenario,
    model::{self, Estimate, Model},
};

/// Estimated cost of a model's run of a case; of none where the model does not apply.
pub fn of_run(model: &dyn Model, scenario: &Scenario) -> Estimate {
    match model::applicability(model, scenario) {
        Ok(_) => model.estimate(scenario),
        Err(_) => Estimate::LITTLE,
    }
}
