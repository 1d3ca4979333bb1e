//! Searches of many models side by side.

use std::{
    ops::ControlFlow,
    sync::{Mutex, PoisonError},
};

use rayon::prelude::*;

use super::{
    ModelLimit, Observer, Progress, Search,
    run_results::{self, LimitRun},
    search::{Passage, Sample, search},
};
use crate::{
    Error, Scenario,
    analytic::InputLimit,
    model::{self, Control, Model},
    regime::Regime,
    solver::go_on_to_next_run,
};

/// Part of the limit by which the curve of residual velocities goes beyond it.
const BEYOND: f64 = 1.5;

/// Intervals of the range at whose ends runs are tried before the bracket is narrowed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scan(u32);

impl Scan {
    /// Of a range in which little is known.
    pub(super) const WHOLE: Self = Self(16);
    /// Of a range in which the limit is expected.
    pub(super) const COARSE: Self = Self(4);
}

/// Searches by every model; the entries stand in the order of the models.
pub(super) fn run(
    models: &[&dyn Model],
    scenario: &Scenario,
    search: &Search,
    observer: &mut Observer<'_>,
) -> Result<Vec<ModelLimit>, Error> {
    let board = Mutex::new(Board::new(
        models.len(),
        planned_runs(search, Scan::WHOLE),
        observer,
    ));
    let job = |index: usize| Job {
        model: models[index],
        index,
        scenario,
        search,
        scan: Scan::WHOLE,
        board: &board,
    };
    (0..models.len())
        .into_par_iter()
        .map(|index| job(index).finish())
        .collect()
}

/// Searches by one model.
pub(super) fn run_one(
    model: &dyn Model,
    scenario: &Scenario,
    search: &Search,
    scan: Scan,
    observer: &mut Observer<'_>,
) -> Result<ModelLimit, Error> {
    let board = Mutex::new(Board::new(1, planned_runs(search, scan), observer));
    let job = Job {
        model,
        index: 0,
        scenario,
        search,
        scan,
        board: &board,
    };
    job.finish()
}

/// Runs that a model takes that finds its limit.
pub(super) fn planned_runs(search: &Search, scan: Scan) -> usize {
    let range = search.range;
    let interval = (range.to - range.from) / f64::from(scan.0);
    let halvings = (interval / search.tolerance.at(0.5 * range.to)).log2();
    scan.0 as usize + 1 + halvings.ceil().max(0.0) as usize + search.points
}

/// One model's search.
struct Job<'a, 'b, 'c> {
    model: &'a dyn Model,
    index: usize,
    scenario: &'a Scenario,
    search: &'a Search,
    scan: Scan,
    board: &'a Mutex<Board<'b, 'c>>,
}

impl Job<'_, '_, '_> {
    /// The entry, after which all planned runs count as done.
    fn finish(&self) -> Result<ModelLimit, Error> {
        let entry = self.entry()?;
        let planned = planned_runs(self.search, self.scan);
        self.tell(|(runs, part)| (runs, part.max(planned as f64)))?;
        Ok(entry)
    }

    fn entry(&self) -> Result<ModelLimit, Error> {
        if let Some((outcome, reason)) = run_results::unsuited(self.model, self.scenario) {
            return Ok(run_results::without_limit(
                self.model.name(),
                outcome,
                reason,
            ));
        }
        if let Some(input) = self.input_limit() {
            let runs = self.curve_above(input.ballistic_limit_m_s)?;
            return Ok(run_results::input_entry(self.model.name(), input, &runs));
        }
        let mut samples = search(
            self.search.range,
            self.search.tolerance,
            self.scan.0,
            &|velocity| self.shoot(velocity),
        )?;
        let runs = match run_results::limit_of(&samples) {
            Some(limit) => self.curve_above(limit)?,
            None => Vec::new(),
        };
        let residuals = run_results::curve(&runs);
        samples.extend(runs);
        samples.sort_by(|a, b| a.velocity.total_cmp(&b.velocity));
        Ok(run_results::entry(self.model.name(), &samples, residuals))
    }

    /// The limit that the model starts from. A limit by another model needs a velocity at which that model applies: its own limit, which
    /// the lowest such velocity of the scan leads to.
    fn input_limit(&self) -> Option<InputLimit> {
        let at = |velocity: f64| {
            self.model
                .input_limit(&self.scenario.at_impact_velocity(velocity))
        };
        let part = |i: u32| f64::from(i) / f64::from(self.scan.0);
        let first = (1..=self.scan.0).find_map(|i| at(self.search.range.at(part(i))))?;
        Some(at(first.ballistic_limit_m_s).unwrap_or(first))
    }

    /// Runs at the velocities of the curve above a limit.
    fn curve_above(&self, limit: f64) -> Result<Vec<Sample<LimitRun>>, Error> {
        let most = self.search.range.to.min((1.0 + BEYOND) * limit);
        self.curve_velocities(limit, most)
            .par_iter()
            .map(|velocity| self.shoot(*velocity))
            .collect()
    }

    /// Velocities above the limit, closer to each other where the residual velocity rises steeply.
    fn curve_velocities(&self, limit: f64, most: f64) -> Vec<f64> {
        let count = self.search.points;
        (1..=count)
            .map(|i| {
                let part = i as f64 / count as f64;
                limit + (most - limit) * part * part
            })
            .filter(|velocity| *velocity > limit)
            .collect()
    }

    /// A run at a velocity. What a model cannot say there is no error.
    fn shoot(&self, velocity: f64) -> Result<Sample<LimitRun>, Error> {
        let sample = |passage, run| Sample {
            velocity,
            passage,
            run,
        };
        if velocity == 0.0 {
            return Ok(sample(Passage::Stopped, None));
        }
        let scenario = self.scenario.at_impact_velocity(velocity);
        let regime = Regime::of(&scenario);
        let mut told = 0.0;
        let mut report = |now: model::Progress| {
            let more = now.fraction.clamp(told, 1.0) - told;
            told += more;
            match self.tell(|(runs, part)| (runs, part + more)) {
                Ok(()) => ControlFlow::Continue(()),
                Err(_) => ControlFlow::Break(()),
            }
        };
        let mut control = Control {
            progress: Some(&mut report),
            ..Control::default()
        };
        let result = model::run_in(self.model, &scenario, &regime, &mut control);
        self.tell(|(runs, part)| (runs + 1, part + 1.0 - told))?;
        match result {
            Ok(result) => Ok(sample(
                run_results::passage(&result),
                Some(LimitRun::of(result)),
            )),
            Err(stop @ Error::Cancelled { .. }) => Err(stop),
            Err(error) => Ok(sample(
                Passage::Undecided(run_results::reason(&error)),
                Some(LimitRun::failed(&error)),
            )),
        }
    }

    /// Changes what is known of this model's runs: how many have ended, and how many are done in parts.
    fn tell(&self, change: impl Fn((usize, f64)) -> (usize, f64)) -> Result<(), Error> {
        // A caller whose callback has panicked gets its panic anyway.
        let mut board = self.board.lock().unwrap_or_else(PoisonError::into_inner);
        board.models[self.index] = change(board.models[self.index]);
        go_on_to_next_run(board.report())
    }
}

/// What all searches together have done.
struct Board<'a, 'b> {
    /// Runs that a model is expected to take.
    planned: usize,
    /// Of each model, the runs that have ended and the runs done in parts.
    models: Vec<(usize, f64)>,
    stopped: bool,
    observer: &'a mut Observer<'b>,
}

impl<'a, 'b> Board<'a, 'b> {
    fn new(models: usize, planned: usize, observer: &'a mut Observer<'b>) -> Self {
        Self {
            planned,
            models: vec![(0, 0.0); models],
            stopped: false,
            observer,
        }
    }

    fn report(&mut self) -> ControlFlow<()> {
        if self.stopped {
            return ControlFlow::Break(());
        }
        let planned = self.planned as f64;
        let part = |done: f64| (done / planned).min(1.0);
        let progress = Progress {
            finished: self.models.iter().map(|(runs, _)| runs).sum(),
            total: self.planned * self.models.len(),
            fraction: self.models.iter().map(|(_, done)| part(*done)).sum::<f64>()
                / self.models.len() as f64,
        };
        if let Some(callback) = &mut self.observer.progress {
            self.stopped = callback(progress).is_break();
        }
        match self.stopped {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    }
}
