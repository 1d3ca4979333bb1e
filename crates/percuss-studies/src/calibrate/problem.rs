//! Calibration problem: parameters, measured values and model.

use std::{
    ops::ControlFlow,
    sync::{
        Arc,
        atomic::{AtomicBool, AtomicU64, Ordering},
    },
};

use rayon::prelude::*;

use super::{
    CorrectionRecord, Fitted, LeftOut, Noise, Observation, Observations, cancelled,
    least_squares::{Bounds, Unable},
    noise::{SCATTER, deviation},
};
use crate::{
    Error, Scenario, cost,
    model::{self, Control, Model},
    outcome::{BandQuantity, Outcome},
};

/// Parameters, measured values and the model between them.
pub struct Problem {
    /// The model.
    pub model: &'static dyn Model,
    /// What is fitted.
    pub fitted: Vec<Fitted>,
    /// Measured values that the model gives.
    pub observations: Vec<Observation>,
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
            for observation in &observations.used {
                parameter.check(&observation.template)?;
            }
        }
        let mut problem = Self {
            model,
            fitted,
            observations: observations.used,
            left_out: observations.left_out,
            noise,
            stop,
            runs: AtomicU64::new(0),
            correction: None,
        };
        problem.leave_out()?;
        problem.check_count()?;
        Ok(problem)
    }

    /// Makes sure that there are enough values to fit to.
    pub(super) fn check_count(&self) -> Result<(), Error> {
        let training = self.training().count();
        if training == 0 {
            return Err(refuse(
                "there is no measured value to fit to".to_owned(),
                match self.left_out.last() {
                    Some(left) => format!("`{}`, for example, is left out: {}", left.id, left.reason),
                    None => "give cases with [[experiments]], or --data with tests of the material that is fitted".to_owned(),
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
            let scatter = self.noise.given().unwrap_or(SCATTER.0);
            let reason = match predicted {
                Err(Silent::Always(reason)) => Some(reason),
                Err(Silent::Stopped) => return Err(cancelled(self)),
                Err(Silent::Here(reason)) => {
                    let message = format!(
                        "the model `{}` fails on `{}` with every parameter in the middle of its range: {reason}",
                        self.model.name(),
                        observation.id
                    );
                    return Err(refuse(message, "give other ranges".to_owned()));
                }
                _ if deviation(&observation, scatter) > 0.0 => None,
                _ if self.noise == Noise::Stated => {
                    let message = format!("`{}` has no stated uncertainty", observation.id);
                    let help = "give one, or let the scatter be estimated, or give it with --noise \"2 %\"";
                    return Err(refuse(message, help.to_owned()));
                }
                _ => Some("a value of 0 has no relative scatter".to_owned()),
            };
            match reason {
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

    pub(super) fn compute(
        &self,
        scenario: &Scenario,
        quantity: BandQuantity,
    ) -> Result<f64, Silent> {
        let mut observer = |_| match self.stop.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        };
        let mut control = Control {
            record: false,
            progress: Some(&mut observer),
            ..Control::default()
        };
        self.runs.fetch_add(1, Ordering::Relaxed);
        if !self.model.validity().predicts.contains(&quantity) {
            return Err(Silent::Always(gives_no(self.model.name(), quantity)));
        }
        let result = match model::run(self.model, scenario, &mut control) {
            Ok(result) => result,
            Err(Error::NotApplicable { refusal, .. }) => {
                return Err(Silent::Always(refusal.to_string()));
            }
            Err(Error::Cancelled { .. }) => return Err(Silent::Stopped),
            Err(error) => return Err(Silent::Here(error.to_string())),
        };
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

    /// Differences between model and measured values that are fitted to, in their order [m or m/s].
    pub(super) fn differences(&self, values: &[f64]) -> Result<Vec<f64>, Unable> {
        let difference = |observation: &&Observation| {
            if self.stop.load(Ordering::Relaxed) {
                return Err(Unable::Stopped);
            }
            match self.prediction(observation, values) {
                Ok(predicted) => Ok(predicted - observation.measured),
                Err(Silent::Stopped) => Err(Unable::Stopped),
                Err(_) => Err(Unable::Failed),
            }
        };
        let training: Vec<&Observation> = self.training().collect();
        let found: Vec<Result<f64, Unable>> = training.par_iter().map(difference).collect();
        if found.contains(&Err(Unable::Stopped)) {
            return Err(Unable::Stopped);
        }
        found.into_iter().collect()
    }

    /// Differences over their standard deviations, then the scores of the parameters in their priors.
    pub(super) fn residuals(&self, values: &[f64], scatter: f64) -> Result<Vec<f64>, Unable> {
        let differences = self.differences(values)?.into_iter().zip(self.training());
        let scores = self.fitted.iter().zip(values);
        Ok(differences
            .map(|(difference, observation)| difference / deviation(observation, scatter))
            .chain(scores.map(|(parameter, value)| parameter.prior.score(*value)))
            .collect())
    }

    /// Logarithm of the posterior density, up to a constant, of the parameters and, where it is estimated, the logarithm of the
    /// scatter.
    pub(super) fn ln_posterior(&self, state: &[f64]) -> f64 {
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
        let likelihood = |(difference, observation): (f64, &Observation)| {
            let deviation = deviation(observation, scatter);
            -0.5 * (difference / deviation).powi(2) - deviation.ln()
        };
        let likelihoods = differences.into_iter().zip(self.training()).map(likelihood);
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

fn gives_no(model: &str, quantity: BandQuantity) -> String {
    format!("the model `{model}` gives no {}", quantity.describe())
}

pub(super) fn refuse(reason: String, remedy: String) -> Error {
    Error::Calibration { reason, remedy }
}
