//! Estimated cost of a calibration, before it starts.

use super::{Problem, Settings, axisymmetric::EXPECTED, fit};
use crate::{Scenario, axisymmetric::Request, cost, model::Estimate};

impl Problem {
    /// Estimated cost of its solution, after the correction to axisymmetric answers where one is asked for.
    pub fn estimate(&self, settings: &Settings, correction: Option<Request>) -> Estimate {
        let cases: Vec<Scenario> = self.cases().collect();
        let runs = cases.iter().map(|c| cost::of_run(self.model, c));
        let once: Estimate = runs.map(|run| cost::of_runs(run, 1.0)).sum();
        let fit = once.times(fit::evaluations(self.fitted.len()) as f64);
        let sampled = settings.sampling.map_or(0, |sampling| {
            sampling.ensembles * sampling.walkers * (sampling.burn_in + sampling.steps)
        });
        let corrected = correction.map(|request| {
            let answers: Estimate = cases.iter().map(|c| request.estimate(c)).sum();
            [fit.times(EXPECTED), answers].into_iter().sum()
        });
        let parts = [Some(fit), Some(once.times(sampled as f64)), corrected];
        parts.into_iter().flatten().sum()
    }

    /// Memory of its largest run, at the middle of the ranges, or of its largest axisymmetric answer [bytes].
    pub(super) fn memory(&self, correction: Option<Request>) -> f64 {
        let of_case = |case: Scenario| {
            let answer = correction.map(|request| request.memory(&case));
            let run = cost::of_run(self.model, &case).memory;
            run.max(answer.unwrap_or(0.0))
        };
        self.cases().map(of_case).fold(0.0, f64::max)
    }

    /// Its cases with every parameter in the middle of its range.
    fn cases(&self) -> impl Iterator<Item = Scenario> {
        let middle = self.middle();
        let values = self.observations.iter();
        let values = values.map(|o| o.scenario(&self.fitted, &middle));
        let curves = self.curve_sets.iter();
        let curves = curves.map(|set| set.scenario(&self.fitted, &middle));
        let cases: Vec<Scenario> = values.chain(curves).filter_map(Result::ok).collect();
        cases.into_iter()
    }
}
