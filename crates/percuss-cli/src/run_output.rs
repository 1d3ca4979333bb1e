//! Case with the result of its run.

use std::{slice, sync::Arc};

use percuss::{
    Scenario,
    axisymmetric::AxisymmetricAnswer,
    outcome::RunResult,
    summary::{CaseResults, SeedStudy},
};

/// Case with the result of its run.
#[derive(Debug)]
pub struct RunOutput {
    /// Case.
    pub scenario: Arc<Scenario>,
    /// Result.
    pub result: Arc<RunResult>,
    /// Axisymmetric answer; `None` where none is wanted.
    pub axisymmetric: Option<AxisymmetricAnswer>,
    /// Study over seeds; `None` where none is wanted.
    pub seeds: Option<SeedStudy>,
    /// Whether that study was stopped before its last packing.
    pub seeds_stopped: bool,
}

impl RunOutput {
    /// Output of `percuss run --json`.
    pub fn results(&self) -> CaseResults {
        CaseResults::new(&self.scenario, slice::from_ref(&self.result))
            .with_axisymmetric(self.axisymmetric.clone())
            .with_seeds(self.seeds.clone())
    }
}
