//! Sampling of a density by ensembles of walkers with the stretch move, which is invariant to linear maps \[goodman2010\].

use std::{
    ops::ControlFlow,
    sync::atomic::{AtomicBool, AtomicUsize, Ordering},
};

use hammer_and_sample::{Model, Parallel, Schedule, Stretch};
use rand_pcg::{Pcg64, rand_core::SeedableRng};
use rayon::prelude::*;
use serde::Serialize;

use super::{
    Noise, Problem,
    diagnostics::{bulk_effective_size, r_hat, tail_effective_size},
    problem::refuse,
};
use crate::{Error, sweep};

/// How a density is sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Sampling {
    /// Independent ensembles.
    pub ensembles: usize,
    /// Walkers of an ensemble: an even number, at least twice the number of parameters.
    pub walkers: usize,
    /// Steps of every walker that are kept.
    pub steps: usize,
    /// Steps before them that are not.
    pub burn_in: usize,
}

impl Sampling {
    /// As many ensembles and steps as are given, after a third as many steps; where nobody says otherwise four walkers for each
    /// parameter, and 12 at least.
    ///
    /// # Errors
    /// [`Error::Calibration`] when the walkers are too few for the problem.
    pub fn of(
        problem: &Problem,
        ensembles: usize,
        walkers: Option<usize>,
        steps: usize,
    ) -> Result<Self, Error> {
        let dimensions = problem.fitted.len() + usize::from(problem.noise == Noise::Estimated);
        let least = 2 * dimensions;
        let walkers = walkers.unwrap_or((2 * least).max(12));
        if walkers < least {
            return Err(refuse(
                format!("{walkers} walkers are too few for {dimensions} parameters"),
                format!("allowed: {least} or more, an even number"),
            ));
        }
        Ok(Self {
            ensembles,
            walkers,
            steps,
            burn_in: steps / 3,
        })
    }
}

/// States of all walkers.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// How it was made.
    pub sampling: Sampling,
    /// States of an ensemble, step by step and walker by walker, those of the burn-in first.
    states: Vec<Vec<Vec<f64>>>,
    /// Part of the proposed moves that were made.
    pub acceptance: f64,
}

/// The caller ended the sampling.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Stopped;

/// What random numbers are drawn for.
const WALKER: u64 = 0x77a1;

struct Density<'a, F> {
    ln: F,
    stop: &'a AtomicBool,
}

impl<F: Fn(&[f64]) -> f64 + Sync + Send> Model for Density<'_, F> {
    type Params = Vec<f64>;

    fn log_prob(&self, state: &Vec<f64>) -> f64 {
        match self.stop.load(Ordering::Relaxed) {
            true => f64::NEG_INFINITY,
            false => (self.ln)(state),
        }
    }
}

/// Ends an ensemble after its steps, or when the caller wants so.
struct Steps<'a> {
    left: usize,
    total: usize,
    done: &'a AtomicUsize,
    stop: &'a AtomicBool,
    progress: &'a (dyn Fn(usize) -> ControlFlow<()> + Sync),
}

impl Schedule<Vec<f64>> for Steps<'_> {
    fn next_step(&mut self, _: &[Vec<f64>]) -> ControlFlow<()> {
        if self.left < self.total {
            let done = 1 + self.done.fetch_add(1, Ordering::Relaxed);
            if (self.progress)(done).is_break() {
                self.stop.store(true, Ordering::Relaxed);
            }
        }
        if self.left == 0 || self.stop.load(Ordering::Relaxed) {
            return ControlFlow::Break(());
        }
        self.left -= 1;
        ControlFlow::Continue(())
    }

    fn iterations(&self, _: usize) -> Option<usize> {
        Some(self.total)
    }
}

/// Samples a density whose logarithm is given up to a constant; `start` is the first state of each walker of each ensemble.
///
/// The result depends on the seed, not on the number of threads. `progress` hears how many steps of all ensembles are done.
pub(super) fn sample(
    ln_density: impl Fn(&[f64]) -> f64 + Sync + Send,
    start: &(dyn Fn(usize, usize) -> Vec<f64> + Sync),
    sampling: Sampling,
    seed: u64,
    progress: &(dyn Fn(usize) -> ControlFlow<()> + Sync),
) -> Result<Sample, Stopped> {
    let (done, stop) = (AtomicUsize::new(0), AtomicBool::new(false));
    let density = Density {
        ln: ln_density,
        stop: &stop,
    };
    let total = sampling.burn_in + sampling.steps;
    let run = |ensemble: usize| {
        let walkers = (0..sampling.walkers).map(|walker| {
            let stream = sweep::stream(seed, WALKER, ensemble);
            let random = Pcg64::seed_from_u64(sweep::bits(stream, walker as u64));
            (start(ensemble, walker), random)
        });
        let schedule = Steps {
            left: total,
            total,
            done: &done,
            stop: &stop,
            progress,
        };
        hammer_and_sample::sample(&density, &Stretch::default(), walkers, schedule, Parallel)
    };
    let runs: Vec<(Vec<Vec<f64>>, usize)> = (0..sampling.ensembles)
        .into_par_iter()
        .with_max_len(1)
        .map(run)
        .collect();
    if stop.load(Ordering::Relaxed) {
        return Err(Stopped);
    }
    let proposed = sampling.ensembles * sampling.walkers * total;
    let accepted: usize = runs.iter().map(|(_, accepted)| accepted).sum();
    Ok(Sample {
        sampling,
        acceptance: accepted as f64 / proposed as f64,
        states: runs.into_iter().map(|(states, _)| states).collect(),
    })
}

impl Sample {
    /// Walkers of an ensemble.
    pub(super) fn walkers(&self) -> usize {
        self.sampling.walkers
    }

    /// Every kept state, ensemble by ensemble, step by step, walker by walker.
    pub fn kept(&self) -> impl Iterator<Item = &[f64]> {
        let from = self.sampling.burn_in * self.sampling.walkers;
        let states = self.states.iter().flat_map(move |states| &states[from..]);
        states.map(Vec::as_slice)
    }

    /// Kept values of a parameter.
    pub fn values(&self, parameter: usize) -> Vec<f64> {
        self.kept().map(|state| state[parameter]).collect()
    }

    /// Values of a parameter in an ensemble, a list a step, the burn-in included.
    pub fn steps(&self, ensemble: usize, parameter: usize) -> Vec<Vec<f64>> {
        let steps = self.states[ensemble].chunks(self.sampling.walkers);
        let value = |state: &Vec<f64>| state[parameter];
        steps
            .map(|states| states.iter().map(value).collect())
            .collect()
    }

    /// Kept values of a parameter, a list an ensemble: step by step, walker by walker.
    fn chains(&self, parameter: usize) -> Vec<Vec<f64>> {
        let kept = |ensemble| self.steps(ensemble, parameter)[self.sampling.burn_in..].concat();
        (0..self.states.len()).map(kept).collect()
    }

    /// R-hat over the ensembles, all walkers of an ensemble together: they depend on each other, ensembles do not.
    pub fn r_hat(&self, parameter: usize) -> f64 {
        r_hat(&self.chains(parameter))
    }

    /// Effective sample size for the mean and the median.
    pub fn bulk_effective_size(&self, parameter: usize) -> f64 {
        bulk_effective_size(&self.chains(parameter), self.sampling.walkers)
    }

    /// Effective sample size for the ends of intervals.
    pub fn tail_effective_size(&self, parameter: usize) -> f64 {
        tail_effective_size(&self.chains(parameter), self.sampling.walkers)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::{mean, variance};

    const SAMPLING: Sampling = Sampling {
        ensembles: 4,
        walkers: 16,
        steps: 3000,
        burn_in: 300,
    };

    /// Means, standard deviations and correlation of two parameters of very different size.
    const MEAN: [f64; 2] = [3.0, -2e6];
    const DEVIATION: [f64; 2] = [0.01, 5e5];
    const CORRELATION: f64 = -0.95;

    fn gaussian(state: &[f64]) -> f64 {
        let z = [0, 1].map(|i| (state[i] - MEAN[i]) / DEVIATION[i]);
        let square = z[0] * z[0] - 2.0 * CORRELATION * z[0] * z[1] + z[1] * z[1];
        -0.5 * square / (1.0 - CORRELATION * CORRELATION)
    }

    fn start(ensemble: usize, walker: usize) -> Vec<f64> {
        let u = |dimension| {
            let stream = sweep::stream(5, ensemble as u64, dimension);
            sweep::bits(stream, walker as u64) as f64 / u64::MAX as f64 - 0.5
        };
        (0..2)
            .map(|i| MEAN[i] + 6.0 * DEVIATION[i] * u(i))
            .collect()
    }

    fn sampled(seed: u64) -> Sample {
        let go_on = |_| ControlFlow::Continue(());
        sample(gaussian, &start, SAMPLING, seed, &go_on).unwrap()
    }

    #[test]
    fn a_gaussian_is_recovered_within_the_monte_carlo_error() {
        let sample = sampled(1);
        let values = [sample.values(0), sample.values(1)];
        for i in 0..2 {
            let size = sample.bulk_effective_size(i);
            let tail = sample.tail_effective_size(i);
            assert!(size > 2000.0 && tail > 2000.0, "{size} {tail}");
            let error = (mean(&values[i]) - MEAN[i]) / DEVIATION[i] * size.sqrt();
            assert!(error.abs() < 4.0, "{error}");
            // Of a normal distribution the estimated variance scatters by √(2/size).
            let error = (variance(&values[i]) / DEVIATION[i].powi(2) - 1.0) * (size / 2.0).sqrt();
            assert!(error.abs() < 4.0, "{error}");
            assert!((sample.r_hat(i) - 1.0).abs() < 0.02, "{}", sample.r_hat(i));
        }
        let count = values[0].len() as f64;
        let product = |(a, b): (&f64, &f64)| (a - MEAN[0]) * (b - MEAN[1]);
        let covariance = values[0].iter().zip(&values[1]).map(product).sum::<f64>() / count;
        let correlation = covariance / (DEVIATION[0] * DEVIATION[1]);
        assert!((correlation - CORRELATION).abs() < 0.07, "{correlation}");
        assert!((0.3..0.9).contains(&sample.acceptance));
    }

    #[test]
    fn the_seed_decides_and_threads_do_not() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        let alone = pool.unwrap().install(|| sampled(2));
        assert_eq!(alone, sampled(2));
        assert_ne!(alone.values(0), sampled(3).values(0));
    }

    #[test]
    fn it_ends_when_the_caller_wants_so() {
        let end = |done| match done {
            ..10 => ControlFlow::Continue(()),
            _ => ControlFlow::Break(()),
        };
        assert_eq!(sample(gaussian, &start, SAMPLING, 1, &end), Err(Stopped));
    }
}
