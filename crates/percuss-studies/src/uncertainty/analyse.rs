//! Uncertainty analysis: runs, statistics, sensitivities.

use std::sync::atomic::AtomicU64;

use super::{
    bands,
    design::{MAX_PARAMETERS, Rows},
    indices::{FEWEST_ROWS, SobolIndices, indices},
    perforation::Perforation,
    quantity::quantities,
    result::{Draw, Failures, Input, Nominal, QuantityResult, Uncertainty},
    runner::Runner,
    statistics::Statistics,
    study::{Settings, Study},
    tornado::{self, ENDS},
};
use crate::{
    Error, cost,
    model::{Model, why_unread},
    outcome::Outcome,
    summary::{InStatistics, ResultNumber, Role},
    sweep::{Axis, BatchKernel, Kernel, Observer, Stopped, SweepRun, values},
};

/// Longest key that is not shortened.
const LONGEST_LABEL: usize = 30;
/// Most reasons of failed runs that are kept.
const REASONS: usize = 3;

/// Computes a study by a kernel, which has to compute by `model`.
///
/// # Errors
/// [`Error::NotApplicable`] when the model does not apply to the case with its uncertain numbers at their medians;
/// [`Error::Cancelled`].
pub fn analyse(
    study: &Study,
    model: &dyn Model,
    kernel: &dyn Kernel,
    settings: &Settings,
    observer: &Observer<'_>,
) -> Result<Uncertainty, Error> {
    let memory = BatchKernel::memory_of_thread(model, &study.scenario);
    cost::within_memory(memory, || {
        analysed(study, model, kernel, settings, observer)
    })
}

/// The same on these threads.
fn analysed(
    study: &Study,
    model: &dyn Model,
    kernel: &dyn Kernel,
    settings: &Settings,
    observer: &Observer<'_>,
) -> Result<Uncertainty, Error> {
    let cancelled = |_: Stopped| Error::Cancelled {
        step: 0,
        time_us: 0.0,
    };
    let no_indices = no_indices(study, settings);
    let rows = Rows::new(settings.samples, settings.seed, study.axes.len());
    let runner = Runner {
        study,
        kernel,
        observer,
        total: runs(study, settings) - 1,
        done: AtomicU64::new(0),
    };
    let (nominal, nominal_draw) = nominal(study, model, kernel, observer, &cancelled)?;
    let lows_and_highs = tornado::runs(&runner).map_err(cancelled)?;
    let of = |point: Vec<f64>| values(&study.axes, study.copula.as_ref(), &point);
    let draws = runner
        .run(settings.samples, &|i| of(rows.first(i)), None, false)
        .map_err(cancelled)?;
    let quantities = chosen(settings, &draws);
    // Seven of eight runs: they end when their depth is known, if it is all that is asked.
    let to_rest = quantities.iter().all(|quantity| quantity.known_at_rest);
    let others = rows.others();
    let mixed = runner
        .run(
            index_rows(study, settings) * others,
            &|i| of(rows.other(i / others, i % others)),
            None,
            to_rest,
        )
        .map_err(cancelled)?;
    let at_velocities =
        bands::at_velocities(&runner, &settings.velocities, &rows, settings.samples)
            .map_err(cancelled)?;

    let keys: Vec<&str> = study.axes.iter().map(|axis| axis.key.as_str()).collect();
    let result = |quantity: &&'static ResultNumber| -> Option<QuantityResult> {
        let found = draws.iter().filter_map(|draw| draw.value(quantity));
        let statistics = Statistics::of(found)?;
        let indices = no_indices.is_none().then(|| {
            let rows = complete_rows(&draws, &mixed, others as usize, quantity);
            indices(&rows, &keys, settings.seed)
        });
        let (indices, why): (Option<SobolIndices>, Option<String>) = match indices {
            None => (None, None),
            Some(Ok(found)) => (Some(found), None),
            Some(Err(why)) => (None, Some(why)),
        };
        let failed = draws.iter().filter(|draw| draw.is_failed()).count();
        Some(QuantityResult {
            quantity: quantity.name,
            nominal: nominal_draw.value(quantity),
            without_value: draws.len() - failed - statistics.runs,
            statistics,
            tornado: tornado::bars(&runner, &lows_and_highs, quantity),
            indices,
            no_indices: why,
        })
    };
    let mut found = Uncertainty {
        case: study.scenario.name.clone(),
        percuss_version: env!("CARGO_PKG_VERSION"),
        model: model.name(),
        samples: settings.samples,
        seed: settings.seed,
        runs: runner.total + 1,
        inputs: inputs_of(&study.axes),
        correlated: study.is_correlated(),
        nominal,
        failures: failures(&draws),
        perforation: Perforation::of(draws.iter().map(|draw| draw.outcome)),
        quantities: quantities.iter().filter_map(result).collect(),
        no_indices,
        bands: at_velocities
            .iter()
            .map(|(velocity, runs)| bands::band(*velocity, runs, &quantities))
            .collect(),
        axisymmetric: None,
        warnings: Vec::new(),
        draws,
    };
    let unread = study.axes.iter();
    found.warnings = unread
        .filter_map(|axis| why_unread(model, &axis.key))
        .collect();
    found.warnings.extend(warnings(&found));
    Ok(found)
}

/// All runs of a study.
pub fn runs(study: &Study, settings: &Settings) -> u64 {
    let parameters = study.axes.len() as u64;
    let of_indices = index_rows(study, settings) * (parameters + 1);
    let at_velocities = settings.velocities.len() as u64 * settings.samples.min(bands::RUNS);
    1 + 2 * parameters + settings.samples + of_indices + at_velocities
}

/// Rows of points that indices are estimated from: half of the samples leave them surer than the percentiles are.
fn index_rows(study: &Study, settings: &Settings) -> u64 {
    match no_indices(study, settings) {
        None => settings
            .samples
            .div_ceil(2)
            .max(FEWEST_ROWS)
            .min(settings.samples),
        Some(_) => 0,
    }
}

/// Why there are no Sobol' indices, whatever the quantity.
fn no_indices(study: &Study, settings: &Settings) -> Option<String> {
    let count = study.axes.len();
    if !settings.indices {
        Some("they were not asked for".to_owned())
    } else if study.is_correlated() {
        Some("the parameters are correlated, and a variance does not fall into parts of single parameters then".to_owned())
    } else if count > MAX_PARAMETERS {
        Some(format!(
            "{count} parameters are more than the {MAX_PARAMETERS} that there are points for"
        ))
    } else {
        None
    }
}

/// The run at the medians, and what is kept of it.
fn nominal(
    study: &Study,
    model: &dyn Model,
    kernel: &dyn Kernel,
    observer: &Observer<'_>,
    cancelled: &dyn Fn(Stopped) -> Error,
) -> Result<(Nominal, Draw), Error> {
    let run = SweepRun::new(&study.template, &study.axes, 0, study.medians(), &[]);
    let rows = kernel.rows(vec![run], observer.stop).map_err(cancelled)?;
    let mut nominal = Nominal {
        outcome: Outcome::Failed,
        reason: None,
        expected_error: None,
        warnings: Vec::new(),
    };
    let Some(row) = rows.into_iter().next() else {
        return Err(cancelled(Stopped));
    };
    match &row.record {
        Ok(record) if record.outcome == Outcome::NotApplicable => {
            return Err(Error::not_applicable(
                model.name(),
                record.reason.clone().unwrap_or_default(),
            ));
        }
        Ok(record) => {
            nominal = Nominal {
                outcome: record.outcome,
                reason: record.reason.clone(),
                expected_error: record.expected_error.clone(),
                warnings: record.warnings.clone(),
            };
        }
        Err(reason) => nominal.reason = Some(reason.clone()),
    }
    Ok((nominal, Draw::of(row)))
}

/// The quantities asked for; otherwise the main ones that the model gives, without those that are the same in all runs.
fn chosen(settings: &Settings, draws: &[Draw]) -> Vec<&'static ResultNumber> {
    if !settings.quantities.is_empty() {
        return settings.quantities.clone();
    }
    let spread = |quantity: &ResultNumber| {
        let values = || draws.iter().filter_map(|draw| draw.value(quantity));
        let first = values().next()?;
        Some(values().any(|value| value != first))
    };
    let given = || quantities().filter(|q| q.role == Role::Main && spread(q).is_some());
    let varying: Vec<&ResultNumber> = given().filter(|q| spread(q) == Some(true)).collect();
    match varying.is_empty() {
        true => given().collect(),
        false => varying,
    }
}

/// Values of the rows in which no run lacks one: that of the sample, and those of its other points.
fn complete_rows(
    draws: &[Draw],
    mixed: &[Draw],
    others: usize,
    quantity: &ResultNumber,
) -> Vec<Vec<f64>> {
    let row = |(first, others): (&Draw, &[Draw])| {
        let row = std::iter::once(first).chain(others);
        row.map(|run| run.value(quantity)).collect()
    };
    draws
        .iter()
        .zip(mixed.chunks(others))
        .filter_map(row)
        .collect()
}

fn inputs_of(axes: &[Axis]) -> Vec<Input> {
    let short: Vec<String> = axes.iter().map(|axis| without_middle(&axis.key)).collect();
    let label = |axis: &Axis| {
        let label = without_middle(&axis.key);
        match short.iter().filter(|other| **other == label).count() {
            1 => label,
            _ => axis.key.clone(),
        }
    };
    let input = |axis: &Axis| Input {
        key: axis.key.clone(),
        unit: axis.unit.clone(),
        distribution: axis.describe(),
        low: axis.at(ENDS[0]),
        median: axis.at(0.5),
        high: axis.at(ENDS[1]),
        label: label(axis),
        column: axis.column(),
        words: axis.words(),
    };
    axes.iter().map(input).collect()
}

/// A long key by its first two parts and its last one.
fn without_middle(key: &str) -> String {
    let parts: Vec<&str> = key.split('.').collect();
    match parts.as_slice() {
        [first, second, _, .., last] if key.len() > LONGEST_LABEL => {
            format!("{first}.{second} … {last}")
        }
        _ => key.to_owned(),
    }
}

fn failures(draws: &[Draw]) -> Failures {
    let failed = || draws.iter().filter(|draw| draw.is_failed());
    let mut reasons: Vec<String> = Vec::new();
    for draw in failed() {
        if reasons.len() < REASONS && !reasons.contains(&draw.error) {
            reasons.push(draw.error.clone());
        }
    }
    Failures {
        runs: failed().count(),
        reasons,
    }
}

fn warnings(found: &Uncertainty) -> Vec<String> {
    let mut warnings = Vec::new();
    let failed = found.failures.runs;
    if failed > 0 {
        warnings.push(format!(
            "{failed} of {} runs have no result and are left out of all statistics, which speak of the others only; the first reason: {}",
            found.samples, found.failures.reasons[0]
        ));
    }
    for quantity in found.quantities.iter().filter(|q| q.without_value > 0) {
        let why = match (quantity.what().in_statistics, &found.perforation) {
            (InStatistics::NotPerforated, Some(p)) if p.perforated == quantity.without_value => {
                " because they go through"
            }
            _ => "",
        };
        warnings.push(format!(
            "{} of {} runs have no {}{why}: its statistics are those of the others",
            quantity.without_value,
            found.samples,
            quantity.what().label
        ));
    }
    warnings
}
