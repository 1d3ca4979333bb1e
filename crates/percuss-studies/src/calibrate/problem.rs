//! Calibration problem: parameters, measured values and model.

use std::{
    collections::BTreeSet,
    ops::ControlFlow,
    sync::{
        Arc,
        atomic::{AtomicBool, AtomicU64, Ordering},
    },
};

use rayon::prelude::*;

use super::{
    CorrectionRecord, CurveObservation, CurveSet, Fitted, LeftOut, Noise, Observation,
    Observations, cancelled,
    least_squares::{Bounds, Unable},
    noise::{SCATTER, Spread},
};
use crate::{
    Error, Scenario, cost,
    measured_curves::computed,
    model::{self, Control, Model, why_unread},
    outcome::{BandQuantity, Outcome, RunResult},
};

/// Parameters, measured values and the model between them.
pub struct Problem {
    /// The model.
    pub model: &'static dyn Model,
    /// What is fitted.
    pub fitted: Vec<Fitted>,
    /// Measured values that the model gives.
    pub observations: Vec<Observation>,
    /// Measured curves that the model gives, those of a case together.
    pub curve_sets: Vec<CurveSet>,
    /// Those that are not used.
    pub left_out: Vec<LeftOut>,
    /// How far they may be off.
    pub noise: Noise,
    pub(super) stop: Arc<AtomicBool>,
    pub(super) runs: AtomicU64,
    pub(super) correction: Option<CorrectionRecord>,
}

/// Why a model gives no value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Silent {
    /// It does not give this quantity or does not apply.
    Always(String),
    /// It fails.
    Here(String),
    /// The caller ended the run.
    Stopped,
}

impl Problem {
    /// Sets up a problem: the parameters have to be ones that the cases can have over all of their range, and the model has to give
    /// the measured quantities in the middle of it.
    ///
    /// # Errors
    /// [`Error::Input`] at the place of a parameter that is wrong, [`Error::Calibration`] when nothing is left to fit to.
    pub fn new(
        model: &'static dyn Model,
        fitted: Vec<Fitted>,
        observations: Observations,
        noise: Noise,
    ) -> Result<Self, Error> {
        Self::stoppable(model, fitted, observations, noise, Arc::default())
    }

    /// The same for a caller that may change its mind: when `stop` becomes true, what is computed for the problem ends within a
    /// few steps of a run, here and later.
    ///
    /// # Errors
    /// As [`Problem::new`], and [`Error::Cancelled`].
    pub fn stoppable(
        model: &'static dyn Model,
        fitted: Vec<Fitted>,
        observations: Observations,
        noise: Noise,
        stop: Arc<AtomicBool>,
    ) -> Result<Self, Error> {
        for (i, parameter) in fitted.iter().enumerate() {
            if fitted[..i]
                .iter()
                .any(|other| other.key() == parameter.key())
            {
                let message = format!("`{}` is fitted twice", parameter.key());
                return Err(parameter.error(&message, "remove one of the two"));
            }
            let of_values = observations.used.iter().map(|value| &value.template);
            let of_curves = observations.curves.iter().map(|set| &set.template);
            let (mut unused, mut is_used) = (None, false);
            for template in of_values.chain(of_curves) {
                let is_same =
                    |other: &&Fitted| template.is_same_number(other.key(), parameter.key());
                if let Some(other) = fitted[..i].iter().find(is_same) {
                    let message =
                        format!("`{}` and `{}` are one number", other.key(), parameter.key());
                    return Err(parameter.error(&message, "remove one of the two"));
                }
                parameter.check(template)?;
                match template.unused_material(parameter.key()) {
                    Some(id) => unused = Some(id),
                    None => is_used = true,
                }
            }
            if let Some(id) = unused.filter(|_| !is_used) {
                let message = format!(
                    "`{}` has no effect: no part of a case is of `{id}`",
                    parameter.key()
                );
                let help = "name a material of the projectile or the target";
                return Err(parameter.error(&message, help));
            }
            if let Some(why) = why_unread(model, parameter.key()) {
                let help = "fit a number that the model reads, or name another model";
                return Err(parameter.error(&why, help));
            }
        }
        let mut problem = Self {
            model,
            fitted,
            observations: observations.used,
            curve_sets: observations.curves,
            left_out: observations.left_out,
            noise,
            stop,
            runs: AtomicU64::new(0),
            correction: None,
        };
        problem.leave_out()?;
        problem.cover_curves()?;
        problem.check_count()?;
        Ok(problem)
    }

    /// Ids of the materials whose constants are fitted, for a message.
    fn fitted_materials(&self) -> String {
        let ids = self.fitted.iter().filter_map(|parameter| {
            let (id, _) = parameter
                .key()
                .strip_prefix("materials.")?
                .split_once('.')?;
            Some(format!(" `{id}`"))
        });
        let ids: BTreeSet<String> = ids.collect();
        Vec::from_iter(ids).join(",")
    }

    /// Makes sure that there are enough values to fit to.
    pub(super) fn check_count(&self) -> Result<(), Error> {
        let values = self.training().count();
        let of_curves = self.training_curves().map(CurveObservation::values);
        let training = values + of_curves.sum::<usize>();
        if training == 0 {
            return Err(refuse(
                "there is no measured value to fit to".to_owned(),
                match self.left_out.last() {
                    Some(left) => {
                        format!("`{}`, for example, is left out: {}", left.id, left.reason)
                    }
                    None => format!(
                        "give cases with [[experiments]] or [[measured_curves]], or --data with tests of the fitted material{}",
                        self.fitted_materials()
                    ),
                },
            ));
        }
        if self.noise == Noise::Estimated && training <= self.fitted.len() {
            return Err(refuse(
                format!(
                    "{training} measured values cannot give {} parameters and their own scatter",
                    self.fitted.len()
                ),
                "add data, fit fewer parameters, or give the scatter with --noise \"2 %\""
                    .to_owned(),
            ));
        }
        Ok(())
    }

    /// Leaves out what the model does not give and what has no standard deviation.
    fn leave_out(&mut self) -> Result<(), Error> {
        let middle = self.middle();
        let predicted: Vec<Result<f64, Silent>> = cost::within_memory(self.memory(None), || {
            self.observations
                .par_iter()
                .map(|observation| self.prediction(observation, &middle))
                .collect()
        });
        let mut used = Vec::new();
        for (observation, predicted) in std::mem::take(&mut self.observations)
            .into_iter()
            .zip(predicted)
        {
            match self.unusable(&observation.id, observation.spread(), predicted.err())? {
                Some(reason) => self.left_out.push(LeftOut {
                    id: observation.id,
                    reason,
                }),
                None => used.push(observation),
            }
        }
        self.observations = used;
        Ok(())
    }

    /// Why something measured is left out, if it is: the model does not give it, or it has no standard deviation.
    fn unusable(
        &self,
        id: &str,
        spread: Spread,
        silent: Option<Silent>,
    ) -> Result<Option<String>, Error> {
        let scatter = self.noise.given().unwrap_or(SCATTER.0);
        Ok(match silent {
            Some(Silent::Always(reason)) => Some(reason),
            Some(Silent::Stopped) => return Err(cancelled(self)),
            Some(Silent::Here(reason)) => {
                let message = format!(
                    "the model `{}` fails on `{id}` with every parameter in the middle of its range: {reason}",
                    self.model.name(),
                );
                return Err(refuse(message, "give other ranges".to_owned()));
            }
            None if spread.deviation(scatter) > 0.0 => None,
            None if self.noise == Noise::Stated => {
                let message = format!("`{id}` has no stated uncertainty");
                let help =
                    "give one, or let the scatter be estimated, or give it with --noise \"2 %\"";
                return Err(refuse(message, help.to_owned()));
            }
            None => Some("what is 0 has no relative scatter".to_owned()),
        })
    }

    /// Takes the points of the curves that the run covers with every parameter in the middle of its range, and leaves out curves that
    /// cannot be used.
    fn cover_curves(&mut self) -> Result<(), Error> {
        let middle = self.middle();
        let run = |set: &CurveSet| {
            let scenario = set.scenario(&self.fitted, &middle).map_err(Silent::Here)?;
            self.run_with(&scenario, true)
        };
        let results: Vec<Result<RunResult, Silent>> =
            cost::within_memory(self.memory(None), || {
                self.curve_sets.par_iter().map(run).collect()
            });
        let sets = std::mem::take(&mut self.curve_sets);
        for (mut set, result) in sets.into_iter().zip(results) {
            let mut kept = Vec::new();
            for index in 0..set.curves.len() {
                let curve = &set.curves[index].curve;
                let found = match &result {
                    Ok(result) => computed(curve, result.history.as_ref()).map_err(Silent::Always),
                    Err(silent) => Err(silent.clone()),
                };
                let silent = match found {
                    Ok(found) => {
                        set.cover(index, &found)?;
                        None
                    }
                    Err(silent) => Some(silent),
                };
                let curve = &set.curves[index];
                match self.unusable(&curve.id, curve.spread(), silent)? {
                    Some(reason) => self.left_out.push(LeftOut {
                        id: curve.id.clone(),
                        reason,
                    }),
                    None => kept.push(curve.clone()),
                }
            }
            if !kept.is_empty() {
                set.curves = kept;
                self.curve_sets.push(set);
            }
        }
        Ok(())
    }

    /// The measured curves.
    pub fn curves(&self) -> impl Iterator<Item = &CurveObservation> {
        self.curve_sets.iter().flat_map(|set| &set.curves)
    }

    /// Curves that are fitted to.
    pub fn training_curves(&self) -> impl Iterator<Item = &CurveObservation> {
        self.curves().filter(|curve| !curve.held_out)
    }

    /// How what is fitted to is distributed about the model, in the order of its differences; correlation times of all curves are given.
    pub(super) fn spreads(&self, correlation_times: &[f64]) -> Vec<Spread> {
        let curves = self.curves().zip(correlation_times);
        let curves = curves.filter(|(curve, _)| !curve.held_out);
        self.training()
            .map(Observation::spread)
            .chain(curves.flat_map(|(curve, time)| curve.spreads(*time)))
            .collect()
    }

    /// Values that are fitted to.
    pub fn training(&self) -> impl Iterator<Item = &Observation> {
        self.observations.iter().filter(|o| !o.held_out)
    }

    /// Every parameter at the median of its prior.
    pub(super) fn middle(&self) -> Vec<f64> {
        self.fitted.iter().map(|p| p.quantile(0.5)).collect()
    }

    pub(super) fn bounds(&self) -> Vec<Bounds> {
        self.fitted.iter().map(Fitted::bounds).collect()
    }

    /// What the model gives for a measured value, corrected where it is [m or m/s].
    pub(super) fn prediction(
        &self,
        observation: &Observation,
        values: &[f64],
    ) -> Result<f64, Silent> {
        let scenario = observation
            .scenario(&self.fitted, values)
            .map_err(Silent::Here)?;
        let value = self.compute(&scenario, observation.quantity)?;
        Ok(observation.predicted(value))
    }

    /// What the model gives for the case as it is written, uncorrected [m or m/s].
    pub(super) fn as_written(&self, observation: &Observation) -> Option<f64> {
        let scenario = observation.scenario(&[], &[]).ok()?;
        self.compute(&scenario, observation.quantity).ok()
    }

    /// What the model gives for the curves of a set, each at its points and in SI units.
    pub(super) fn curves_of(
        &self,
        set: &CurveSet,
        values: &[f64],
    ) -> Result<Vec<Vec<f64>>, Silent> {
        let scenario = set.scenario(&self.fitted, values).map_err(Silent::Here)?;
        let result = self.run_with(&scenario, true)?;
        let curves = set.curves.iter();
        curves.map(|curve| curve.predicted(&result)).collect()
    }

    /// A run for the curves of a set, with values or as the case is written.
    pub(super) fn curve_run(&self, set: &CurveSet, values: Option<&[f64]>) -> Option<RunResult> {
        let (fitted, values) = match values {
            Some(values) => (self.fitted.as_slice(), values),
            None => (&[][..], &[][..]),
        };
        self.run_with(&set.scenario(fitted, values).ok()?, true)
            .ok()
    }

    fn run_with(&self, scenario: &Scenario, record: bool) -> Result<RunResult, Silent> {
        let mut observer = |_| match self.stop.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        };
        let mut control = Control {
            record,
            progress: Some(&mut observer),
            ..Control::default()
        };
        self.runs.fetch_add(1, Ordering::Relaxed);
        match model::run(self.model, scenario, &mut control) {
            Ok(result) => Ok(result),
            Err(Error::NotApplicable { refusal, .. }) => Err(Silent::Always(refusal.to_string())),
            Err(Error::Cancelled { .. }) => Err(Silent::Stopped),
            Err(error) => Err(Silent::Here(error.to_string())),
        }
    }

    pub(super) fn compute(
        &self,
        scenario: &Scenario,
        quantity: BandQuantity,
    ) -> Result<f64, Silent> {
        if !self.model.validity().predicts.contains(&quantity) {
            self.runs.fetch_add(1, Ordering::Relaxed);
            return Err(Silent::Always(gives_no(self.model.name(), quantity)));
        }
        let result = self.run_with(scenario, false)?;
        if result.outcome == Outcome::OutOfTime {
            return Err(Silent::Here("the run ended before the test did".to_owned()));
        }
        match result.measurable(quantity) {
            None => Err(Silent::Always(gives_no(self.model.name(), quantity))),
            Some(value) if !value.is_finite() => Err(Silent::Here(format!("it gives {value}"))),
            // A projectile that is stopped or thrown back has no residual velocity.
            Some(value) if quantity == BandQuantity::ResidualVelocity => Ok(value.max(0.0)),
            Some(value) => Ok(value),
        }
    }

    /// Differences between model and measured values that are fitted to, in their order, then those of the curves at their points, in SI
    /// units.
    pub(super) fn differences(&self, values: &[f64]) -> Result<Vec<f64>, Unable> {
        let difference = |part: &Part<'_>| -> Result<Vec<f64>, Silent> {
            if self.stop.load(Ordering::Relaxed) {
                return Err(Silent::Stopped);
            }
            match part {
                Part::Value(observation) => {
                    let predicted = self.prediction(observation, values)?;
                    Ok(vec![predicted - observation.measured])
                }
                Part::Curves(set) => {
                    let curves = set.curves.iter().zip(self.curves_of(set, values)?);
                    let training = curves.filter(|(curve, _)| !curve.held_out);
                    Ok(training
                        .flat_map(|(curve, predicted)| curve.differences(&predicted))
                        .collect())
                }
            }
        };
        let trained = |set: &&CurveSet| set.curves.iter().any(|curve| !curve.held_out);
        let values = self.training().map(Part::Value);
        let curves = self.curve_sets.iter().filter(trained).map(Part::Curves);
        let parts: Vec<Part<'_>> = values.chain(curves).collect();
        let found: Vec<Result<Vec<f64>, Silent>> = parts.par_iter().map(difference).collect();
        if found.contains(&Err(Silent::Stopped)) {
            return Err(Unable::Stopped);
        }
        let mut differences = Vec::new();
        for part in found {
            differences.extend(part.map_err(|_| Unable::Failed)?);
        }
        Ok(differences)
    }

    /// Differences over their standard deviations, then the scores of the parameters in their priors.
    pub(super) fn residuals(
        &self,
        values: &[f64],
        spreads: &[Spread],
        scatter: f64,
    ) -> Result<Vec<f64>, Unable> {
        let differences = self.differences(values)?.into_iter().zip(spreads);
        let scores = self.fitted.iter().zip(values);
        Ok(differences
            .map(|(difference, spread)| spread.residual(difference, scatter))
            .chain(scores.map(|(parameter, value)| parameter.prior.score(*value)))
            .collect())
    }

    /// Logarithm of the posterior density, up to a constant, of the parameters and, where it is estimated, the logarithm of the
    /// scatter.
    pub(super) fn ln_posterior(&self, state: &[f64], spreads: &[Spread]) -> f64 {
        let (values, rest) = state.split_at(self.fitted.len());
        let prior: f64 = self
            .fitted
            .iter()
            .zip(values)
            .map(|(parameter, value)| parameter.prior.ln_density(*value))
            .sum();
        let scatter = match (self.noise.given(), rest) {
            (Some(scatter), _) => scatter,
            (None, [ln_scatter, ..]) => ln_scatter.exp(),
            (None, []) => f64::NAN,
        };
        let impossible =
            self.noise == Noise::Estimated && !(SCATTER.0..=SCATTER.1).contains(&scatter);
        if prior == f64::NEG_INFINITY || impossible {
            return f64::NEG_INFINITY;
        }
        let Ok(differences) = self.differences(values) else {
            return f64::NEG_INFINITY;
        };
        let likelihoods = differences
            .into_iter()
            .zip(spreads)
            .map(|(difference, spread)| spread.ln_likelihood(difference, scatter));
        prior + likelihoods.sum::<f64>()
    }

    /// The state of the sampler in a single run: values, and the scatter that goes with them.
    pub(super) fn scatter_in(&self, state: &[f64]) -> f64 {
        let ln_scatter = state.get(self.fitted.len()).copied();
        self.noise
            .given()
            .or(ln_scatter.map(f64::exp))
            .unwrap_or(f64::NAN)
    }
}

/// Part of what is fitted to, by one run.
enum Part<'a> {
    Value(&'a Observation),
    Curves(&'a CurveSet),
}

fn gives_no(model: &str, quantity: BandQuantity) -> String {
    format!("the model `{model}` gives no {}", quantity.describe())
}

pub(super) fn refuse(reason: String, remedy: String) -> Error {
    Error::Calibration { reason, remedy }
}
