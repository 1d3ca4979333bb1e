//! A run of a case with its result.

use std::{slice, sync::Arc};

use percuss::{Scenario, outcome::RunResult, summary::CaseResults};

/// A case and what came of it.
#[derive(Debug)]
pub struct Ran {
    /// The case.
    pub scenario: Arc<Scenario>,
    /// What came of it.
    pub result: Arc<RunResult>,
}

impl Ran {
    /// What `percuss run --json` prints.
    pub fn results(&self) -> CaseResults {
        CaseResults::new(&self.scenario, slice::from_ref(&self.result))
    }
}
