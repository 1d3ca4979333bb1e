//! Computation of the cases that the files of a reference lack.

use std::{
    path::Path,
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
    thread,
};

use percuss_research::{
    benchmark::{
        BenchmarkCase, Reference,
        reference::{self, seconds},
    },
    paper_case,
};

use super::Benchmark;
use crate::{failure::Failure, response::ProgressCallback, terminal};

/// Computes the cases that the files lack; returns the reasons of failures. `say` gets the estimated time first.
pub(super) fn complete(
    options: &Benchmark,
    cases: &[BenchmarkCase],
    stop: &AtomicBool,
    on_progress: ProgressCallback<'_>,
    say: &dyn Fn(&str),
) -> Result<Vec<String>, Failure> {
    let (paper_case, reference) = (options.paper_case.as_deref(), options.reference.as_deref());
    if paper_case.is_none() && reference.is_none() {
        return Err(Failure::Usage {
            message: "--compute needs a file to write to".to_owned(),
            help:
                "add --reference FILE, --paper-case FILE or both; a file that exists is completed"
                    .to_owned(),
        });
    }
    let left = paper_case
        .map(|file| paper_case::read_file(file).map(|known| paper_case::seconds_left(&known)));
    let left = left.transpose()?.unwrap_or(0.0);
    let within = within_budget(options, cases, reference)?;
    let cases = &*within;
    let due = reference.map(|file| Due::of(file, cases, options.cells));
    let due = due.transpose()?;
    let work = due.as_ref().map_or(Some(0.0), |due| due.work);
    let progress = ComputeProgress {
        state: Mutex::new(State {
            on_progress,
            done: 0.0,
            failures: Vec::new(),
        }),
        total: work.map_or(0.0, |work| left + work),
        stop,
    };
    if let Some(file) = paper_case {
        say(&format!(
            "{}: computing the case of the seed paper, about {}",
            file.display(),
            on_all_cores(left)
        ));
        paper_case::complete(file, stop, &|done, of, row| {
            let work = row.as_ref().map_or(0.0, |row| row.seconds());
            progress.on_progress(done, of, work, row.err());
        })?;
    }
    if let (Some(file), Some(due)) = (reference, due) {
        say(&format!(
            "{}: computing {} of {} cases on {} cells per radius, {}",
            file.display(),
            due.missing,
            cases.len(),
            options.cells,
            match due.work {
                Some(work) => format!("about {}", on_all_cores(work)),
                None => "which may take hours: 8 times as long for twice the cells".to_owned(),
            }
        ));
        reference::complete(file, cases, options.cells, stop, &|done, of, row| {
            let case = row.as_ref().ok();
            let case = case.and_then(|row| cases.iter().find(|case| row.is_of(case)));
            let work = case.and_then(|case| seconds(case, options.cells, &due.known));
            progress.on_progress(done, of, work.unwrap_or(0.0), row.err());
        })?;
    }
    let state = progress.state.into_inner();
    Ok(state.unwrap_or_else(PoisonError::into_inner).failures)
}

/// Cases whose estimated time on one core is within the budget; one without an estimate is.
fn within_budget(
    options: &Benchmark,
    cases: &[BenchmarkCase],
    reference: Option<&Path>,
) -> Result<Vec<BenchmarkCase>, Failure> {
    let known = reference.map(reference::read_file).transpose()?;
    let known = known.unwrap_or_default();
    let is_within = |case: &&BenchmarkCase| match options.budget {
        Some(budget) => seconds(case, options.cells, &known).is_none_or(|time| time <= budget),
        None => true,
    };
    Ok(cases.iter().filter(is_within).cloned().collect())
}

/// Cases that a file of the reference lacks.
struct Due {
    known: Vec<Reference>,
    missing: usize,
    /// Estimated time on one core [s]; `None` when it is unknown.
    work: Option<f64>,
}

impl Due {
    fn of(file: &Path, cases: &[BenchmarkCase], cells: u32) -> Result<Self, Failure> {
        let known = reference::read_file(file)?;
        let missing = cases.iter().filter(|case| {
            let done = |row: &&Reference| row.cells_per_radius == cells;
            !known.iter().filter(done).any(|row| row.is_of(case))
        });
        let missing: Vec<&BenchmarkCase> = missing.collect();
        let work = missing.iter().map(|case| seconds(case, cells, &known));
        Ok(Self {
            work: work.sum(),
            missing: missing.len(),
            known,
        })
    }
}

/// Progress of cases that take long, by their estimated work.
struct ComputeProgress<'a> {
    state: Mutex<State<'a>>,
    /// Estimated work at the start [s]; 0 when it is unknown.
    total: f64,
    stop: &'a AtomicBool,
}

struct State<'a> {
    on_progress: ProgressCallback<'a>,
    done: f64,
    failures: Vec<String>,
}

impl ComputeProgress<'_> {
    fn on_progress(&self, done: usize, of: usize, work: f64, failure: Option<String>) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        state.failures.extend(failure);
        state.done += work;
        let fraction = match self.total > 0.0 {
            true => state.done / self.total,
            false => done as f64 / of as f64,
        };
        if (state.on_progress)(fraction, &format!("{done} of {of} cases")).is_break() {
            self.stop.store(true, Ordering::Relaxed);
        }
    }
}

fn on_all_cores(seconds: f64) -> String {
    let cores = thread::available_parallelism().map_or(1, |n| n.get());
    let words = match seconds / cores as f64 {
        seconds @ ..5400.0 => format!("{:.0} min", (seconds / 60.0).ceil()),
        seconds => format!("{:.1} h", seconds / 3600.0),
    };
    format!("{words} on {}", terminal::counted(cores, "core"))
}
