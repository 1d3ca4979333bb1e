//! Computing what the files of a reference lack.

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
        Reference, Shot,
        reference::{self, seconds},
    },
    paper_case,
};

use super::Benchmark;
use crate::{answer::Hear, failure::Failure, terminal};

/// Computes what the files lack; returns why shots failed. `say` is told beforehand how long it may take.
pub(super) fn complete(
    options: &Benchmark,
    shots: &[Shot],
    stop: &AtomicBool,
    hear: Hear<'_>,
    say: &dyn Fn(&str),
) -> Result<Vec<String>, Failure> {
    let (study, reference) = (options.study.as_deref(), options.reference.as_deref());
    if study.is_none() && reference.is_none() {
        return Err(Failure::Usage {
            message: "--compute needs a file to write to".to_owned(),
            help: "add --reference FILE, --study FILE or both; a file that exists is completed"
                .to_owned(),
        });
    }
    let left =
        study.map(|file| paper_case::read_file(file).map(|known| paper_case::seconds_left(&known)));
    let left = left.transpose()?.unwrap_or(0.0);
    let due = reference.map(|file| Due::of(file, shots, options.cells));
    let due = due.transpose()?;
    let work = due.as_ref().map_or(Some(0.0), |due| due.work);
    let watch = Watch {
        state: Mutex::new(State {
            hear,
            done: 0.0,
            failures: Vec::new(),
        }),
        total: work.map_or(0.0, |work| left + work),
        stop,
    };
    if let Some(file) = study {
        say(&format!(
            "{}: computing the paper's case, about {}",
            file.display(),
            on_all_cores(left)
        ));
        paper_case::complete(file, stop, &|done, of, row| {
            let work = row.as_ref().map_or(0.0, |row| row.seconds());
            watch.hear(done, of, work, row.err());
        })?;
    }
    if let (Some(file), Some(due)) = (reference, due) {
        say(&format!(
            "{}: computing {} of {} shots on {} cells per radius, {}",
            file.display(),
            due.missing,
            shots.len(),
            options.cells,
            match due.work {
                Some(work) => format!("about {}", on_all_cores(work)),
                None => "which may take hours: 8 times as long for twice the cells".to_owned(),
            }
        ));
        reference::complete(file, shots, options.cells, stop, &|done, of, row| {
            let shot = row.as_ref().ok();
            let shot = shot.and_then(|row| shots.iter().find(|shot| row.is_of(shot)));
            let work = shot.and_then(|shot| seconds(shot, options.cells, &due.known));
            watch.hear(done, of, work.unwrap_or(0.0), row.err());
        })?;
    }
    let state = watch.state.into_inner();
    Ok(state.unwrap_or_else(PoisonError::into_inner).failures)
}

/// What a file of the reference lacks.
struct Due {
    known: Vec<Reference>,
    missing: usize,
    /// Time that it takes one core [s]; `None` when nobody knows.
    work: Option<f64>,
}

impl Due {
    fn of(file: &Path, shots: &[Shot], cells: u32) -> Result<Self, Failure> {
        let known = reference::read_file(file)?;
        let missing = shots.iter().filter(|shot| {
            let done = |row: &&Reference| row.cells_per_radius == cells;
            !known.iter().filter(done).any(|row| row.is_of(shot))
        });
        let missing: Vec<&Shot> = missing.collect();
        let work = missing.iter().map(|shot| seconds(shot, cells, &known));
        Ok(Self {
            work: work.sum(),
            missing: missing.len(),
            known,
        })
    }
}

/// Progress of shots that take long, by the work that they are expected to be.
struct Watch<'a> {
    state: Mutex<State<'a>>,
    /// All the work that was left at the start [s]; 0 when nobody knows.
    total: f64,
    stop: &'a AtomicBool,
}

struct State<'a> {
    hear: Hear<'a>,
    done: f64,
    failures: Vec<String>,
}

impl Watch<'_> {
    fn hear(&self, done: usize, of: usize, work: f64, failure: Option<String>) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        state.failures.extend(failure);
        state.done += work;
        let fraction = match self.total > 0.0 {
            true => state.done / self.total,
            false => done as f64 / of as f64,
        };
        if (state.hear)(fraction, &format!("{done} of {of} shots")).is_break() {
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
