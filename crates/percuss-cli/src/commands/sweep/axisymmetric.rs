//! Axisymmetric answers of some runs of a sweep.

use std::{
    ops::ControlFlow,
    path::Path,
    sync::{Mutex, PoisonError, atomic::AtomicBool},
};

use percuss::{
    Error, cost,
    statistics::{quantile, sorted},
    sweep::Sweep,
    units::significant,
};
use percuss_report::sweep::AxisymmetricFile;
use rayon::prelude::*;

use crate::{
    diagnostic,
    failure::Failure,
    progress::Progress,
    terminal::{self, bold, paragraph},
    workers::unless_stopped,
};

/// Computes what the file of a folder lacks, and sums up what this computed.
pub(super) fn compute(
    sweep: &Sweep,
    folder: &Path,
    count: u64,
    stop: &AtomicBool,
    quiet: bool,
) -> Result<String, Failure> {
    let file = AxisymmetricFile::open(folder, sweep)?;
    let chosen = sweep.spread(count);
    let due: Vec<u64> = chosen.iter().copied().filter(|i| !file.has(*i)).collect();
    let costs: Vec<f64> = due
        .par_iter()
        .map(|i| sweep.axisymmetric_seconds(*i))
        .collect();
    let whole: f64 = costs.iter().sum();
    if !quiet && !due.is_empty() {
        diagnostic::print(&format!(
            "note: {}, about {} s of processor time\n",
            terminal::counted(due.len(), "axisymmetric answer"),
            significant(whole.max(1.0), 2),
        ));
    }
    let state = Mutex::new(State {
        progress: Progress::new(!quiet),
        file,
        fractions: vec![0.0; due.len()],
        done: 0,
    });
    let lock = || state.lock().unwrap_or_else(PoisonError::into_inner);
    let one = |place: usize| -> Result<(), Failure> {
        let mut report = |fraction: f64| {
            let mut state = lock();
            state.fractions[place] = fraction;
            let work = state.fractions.iter().zip(&costs).map(|(f, cost)| f * cost);
            let part = work.sum::<f64>() / whole.max(f64::MIN_POSITIVE);
            let words = format!("{} of {} axisymmetric answers", state.done, due.len());
            state.progress.update(part, &words);
            unless_stopped(stop, ControlFlow::Continue(()))
        };
        if report(0.0).is_break() {
            return Err(Failure::Interrupted("the axisymmetric answers"));
        }
        let row = match sweep.axisymmetric(due[place], &mut report) {
            Err(Error::Cancelled { .. }) => {
                return Err(Failure::Interrupted("the axisymmetric answers"));
            }
            row => row?,
        };
        let mut state = lock();
        state.file.add(&row)?;
        state.done += 1;
        Ok(())
    };
    let memory = due.iter().map(|i| sweep.axisymmetric_memory(*i));
    let done: Result<(), Failure> = cost::within_memory(memory.fold(0.0, f64::max), || {
        (0..due.len())
            .into_par_iter()
            .with_max_len(1)
            .map(one)
            .collect()
    });
    let state = state.into_inner().unwrap_or_else(PoisonError::into_inner);
    state.progress.finish();
    done.map_err(|failure| match failure {
        Failure::Interrupted(_) => Failure::AnswersStopped {
            complete: chosen.len() - due.len() + state.done,
            wanted: chosen.len(),
        },
        other => other,
    })?;
    Ok(text(state.file.ratios(), chosen.len()))
}

/// What the workers share.
struct State {
    progress: Progress,
    file: AxisymmetricFile,
    fractions: Vec<f64>,
    done: usize,
}

fn text(ratios: Vec<f64>, chosen: usize) -> String {
    let runs = terminal::counted(chosen, "run");
    let mut text = format!(
        "\n{}\n",
        bold(format!(
            "axisymmetric answers of {runs}, in axisymmetric.csv"
        ))
    );
    let ratios = sorted(ratios);
    if !ratios.is_empty() {
        let at = |part: f64| significant(quantile(&ratios, part), 3);
        text += &paragraph(&format!(
            "the sweep's model over `axi`, {}: median {}, 10th-90th percentile {} to {}",
            terminal::counted(ratios.len(), "run"),
            at(0.5),
            at(0.1),
            at(0.9),
        ));
    }
    text
}
