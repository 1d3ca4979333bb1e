//! Correction of a model by axisymmetric runs at the best values, repeated until both agree.
//!
//! A depth or a length `y` of the model becomes `y · a/y₀`, a residual velocity `y + a − y₀`: `a` is the axisymmetric number and `y₀`
//! that of the model, both at the best values of the last round. There the fit is one to `a`; the derivatives are the model's. The limit of
//! fine meshes is taken in the first round; later rounds run the finest mesh and keep its ratio to the limit, so that `a` is smooth.

#[cfg(test)]
#[path = "axisymmetric_tests.rs"]
mod tests;

use std::{
    ops::ControlFlow,
    sync::atomic::{AtomicUsize, Ordering},
};

use rayon::prelude::*;
use serde::Serialize;

use super::{
    Fitted, LeftOut, Observation, Observer, Problem, Stage, cancelled,
    correction::Correction,
    fit, heard,
    problem::{Silent, refuse},
};
use crate::{
    Error,
    axisymmetric::{MODEL, ReferenceMeshes, Request},
    cost,
    jobs::{Jobs, Progress},
    model,
};

/// Rounds after which the correction is left as it is, with a warning.
const ROUNDS: usize = 6;
/// Rounds that are expected, for the progress and the estimated cost.
pub(super) const EXPECTED: f64 = 3.0;
/// Difference of corrected model and axisymmetric number that ends the rounds: a part of what the impact changed, or of the
/// discretisation uncertainty.
const SETTLED: f64 = 0.01;
const UNCERTAIN: f64 = 0.5;

/// How a calibration was corrected. The names are stable.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CorrectionRecord {
    /// Meshes of the axisymmetric answers.
    pub reference: ReferenceMeshes,
    /// Rounds of a fit and axisymmetric answers at its best values.
    pub rounds: usize,
    /// Axisymmetric answers that were computed: on all meshes in the first round, on the finest one later.
    pub answers: usize,
    /// Largest difference between the fit of the last round and its axisymmetric numbers, relative to what the impact changed.
    pub difference: f64,
    /// Whether this is less than 1 %, or than half the discretisation uncertainty, for every value.
    pub converged: bool,
}

impl CorrectionRecord {
    pub(super) fn warning(&self) -> Option<String> {
        (!self.converged).then(|| {
            format!(
                "the best values may be off: model and axisymmetric answers still differed by {:.1} % after {} rounds of correction",
                100.0 * self.difference,
                self.rounds
            )
        })
    }
}

impl Problem {
    /// The problem with the model corrected to axisymmetric answers. Measured values that `axi` does not give are left out; the
    /// discretisation uncertainty of the others adds to their standard deviations.
    ///
    /// # Errors
    /// [`Error::Cancelled`]; [`Error::Input`] for a fitted number that `axi` does not have; [`Error::Calibration`] when the model is
    /// `axi`, fails, or nothing is left to fit to.
    pub fn corrected(
        mut self,
        request: Request,
        seed: u64,
        observer: Observer<'_>,
    ) -> Result<Self, Error> {
        self.check_corrected()?;
        for curve in std::mem::take(&mut self.curve_sets)
            .into_iter()
            .flat_map(|set| set.curves)
        {
            self.left_out.push(LeftOut {
                id: curve.id,
                reason: "curves are not corrected to axisymmetric answers; `--model axi` is fitted to them directly".to_owned(),
            });
        }
        self.check_count()?;
        let answers = AtomicUsize::new(0);
        let mut record = CorrectionRecord {
            reference: request.meshes,
            rounds: 0,
            answers: 0,
            difference: f64::INFINITY,
            converged: false,
        };
        while !record.converged && record.rounds < ROUNDS {
            let before = (record.rounds as f64 / EXPECTED).min(0.9);
            let share = (1.0 - before) / (EXPECTED - record.rounds as f64).max(1.5);
            let silent = |_, _, runs| observer(Stage::Correcting, before, runs);
            let values = fit::least_squares(&self, seed, &silent)?.values;
            let report = |part: f64| {
                let runs = self.runs.load(Ordering::Relaxed);
                heard(
                    &self,
                    observer(Stage::Correcting, before + share * part, runs),
                )
            };
            let found = cost::within_memory(self.memory(Some(request)), || {
                self.answers(&values, request, &answers, &report)
            });
            record.rounds += 1;
            (record.difference, record.converged) = self.correct(found)?;
        }
        record.answers = answers.load(Ordering::Relaxed);
        self.correction = Some(record);
        Ok(self)
    }

    fn check_corrected(&self) -> Result<(), Error> {
        if self.model.name() == MODEL {
            return Err(refuse(
                "the model `axi` is not corrected by itself".to_owned(),
                "leave the axisymmetric reference out, or give another model".to_owned(),
            ));
        }
        let of_another_model = |parameter: &&Fitted| {
            let table = parameter.key().split('.').next().unwrap_or_default();
            table != MODEL && model::model(table).is_ok()
        };
        match self.fitted.iter().find(of_another_model) {
            Some(parameter) => Err(parameter.error(
                &format!(
                    "`{}` is no number of the model `axi`, which the fit is corrected to",
                    parameter.key()
                ),
                "fit constants of materials or numbers of projectile and target, or leave the axisymmetric reference out",
            )),
            None => Ok(()),
        }
    }

    /// Axisymmetric answers at some values, for each measured value.
    fn answers(
        &self,
        values: &[f64],
        request: Request,
        count: &AtomicUsize,
        report: &(dyn Fn(f64) + Sync),
    ) -> Vec<Result<Correction, Silent>> {
        let mut progress = |part: f64| {
            report(part);
            match self.stop.load(Ordering::Relaxed) {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        };
        let jobs = Jobs::new(vec![1.0; self.observations.len()], &mut progress);
        let observations = self.observations.par_iter().with_max_len(1).enumerate();
        observations
            .map(|(place, observation)| {
                let mut progress = |fraction: f64| jobs.report(place, fraction);
                count.fetch_add(1, Ordering::Relaxed);
                let found = self.correction_of(observation, values, request, &mut progress);
                let _ = progress(1.0);
                found
            })
            .collect()
    }

    fn correction_of(
        &self,
        observation: &Observation,
        values: &[f64],
        request: Request,
        progress: &mut Progress<'_>,
    ) -> Result<Correction, Silent> {
        let scenario = observation
            .scenario(&self.fitted, values)
            .map_err(Silent::Here)?;
        let model = self.compute(&scenario, observation.quantity)?;
        Correction::at(
            &scenario,
            observation.quantity,
            model,
            request,
            observation.correction.as_ref(),
            progress,
        )
    }

    /// Takes the corrections over. Gives the largest relative difference to the ones before, and whether that is small.
    fn correct(&mut self, found: Vec<Result<Correction, Silent>>) -> Result<(f64, bool), Error> {
        let (mut largest, mut converged) = (0.0, true);
        let mut used = Vec::new();
        for (mut observation, found) in std::mem::take(&mut self.observations)
            .into_iter()
            .zip(found)
        {
            let correction = match found {
                Ok(correction) => correction,
                Err(Silent::Stopped) => return Err(cancelled(self)),
                Err(Silent::Always(reason) | Silent::Here(reason)) => {
                    self.left_out.push(LeftOut {
                        id: observation.id,
                        reason,
                    });
                    continue;
                }
            };
            let before = observation.predicted(correction.model);
            let difference = (before - correction.value).abs();
            largest = f64::max(largest, difference / correction.change);
            let small = (SETTLED * correction.change).max(UNCERTAIN * correction.first.uncertainty);
            converged &= difference <= small;
            observation.correction = Some(correction);
            used.push(observation);
        }
        self.observations = used;
        self.check_count()?;
        Ok((largest, converged))
    }
}
