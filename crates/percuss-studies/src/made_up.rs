//! Models made up for tests.

use crate::{
    Error, Scenario,
    outcome::RunResult,
    solver::{Control, Model, Progress},
    validity::ValidityDomain,
};

/// A model whose result is a function of the case.
pub(crate) struct MadeUp {
    pub(crate) name: &'static str,
    pub(crate) validity: ValidityDomain,
    pub(crate) result: fn(&Scenario) -> Result<RunResult, Error>,
}

impl Model for MadeUp {
    fn name(&self) -> &'static str {
        self.name
    }

    fn summary(&self) -> &'static str {
        "made up"
    }

    fn validity(&self) -> &'static ValidityDomain {
        Box::leak(Box::new(self.validity))
    }

    fn run(&self, scenario: &Scenario, control: &mut Control<'_>) -> Result<RunResult, Error> {
        control.report(Progress {
            step: 1,
            time: 0.0,
            fraction: 0.5,
            depth: 0.0,
        })?;
        let mut result = (self.result)(scenario)?;
        result.model = self.name;
        Ok(result)
    }
}
