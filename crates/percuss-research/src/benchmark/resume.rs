//! Resumable computation of the rows of a CSV file: jobs run in parallel and each row is appended when it is complete.

use std::{
    fs::OpenOptions,
    io::Write,
    ops::ControlFlow,
    path::Path,
    sync::{
        Mutex,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
};

use percuss::{
    Error,
    input_file::{self, MAX_TABLE_BYTES},
    model::{Control, Progress},
};
use serde::{Serialize, de::DeserializeOwned};

/// Computation of one row of a file.
pub(crate) trait Job: Sync {
    /// Row.
    type Row: Serialize + DeserializeOwned + Send;

    /// Description.
    fn name(&self) -> String;

    /// Whether a row is the result of this job.
    fn is_done_by(&self, row: &Self::Row) -> bool;

    /// Computes the row.
    fn compute(&self, control: &mut Control<'_>) -> Result<Self::Row, Error>;
}

/// Callback for every completed job: number of completed jobs, number of all jobs, and the row or the error.
pub type Report<'a, Row> = dyn Fn(usize, usize, Result<&Row, String>) + Sync + 'a;

/// Rows of a file; empty where there is no file.
///
/// # Errors
/// [`Error::Read`].
pub(crate) fn rows<Row: DeserializeOwned>(file: &Path) -> Result<Vec<Row>, Error> {
    match input_file::open(file, MAX_TABLE_BYTES) {
        Ok(text) => csv::Reader::from_reader(text)
            .deserialize()
            .collect::<Result<_, _>>()
            .map_err(|error| unreadable(file, &error)),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(Vec::new()),
        Err(error) => Err(input_file::unreadable(file, error)),
    }
}

/// Computes all jobs whose row a file lacks and appends each row, until `stop` becomes true. A failed job does not stop the others.
///
/// # Errors
/// [`Error::Read`] when the file cannot be read or written; [`Error::Cancelled`] when it was stopped.
pub(crate) fn complete<J: Job>(
    file: &Path,
    jobs: &[J],
    stop: &AtomicBool,
    report: &Report<'_, J::Row>,
) -> Result<Vec<J::Row>, Error> {
    let known: Vec<J::Row> = rows(file)?;
    let left: Vec<&J> = jobs
        .iter()
        .filter(|job| !known.iter().any(|row| job.is_done_by(row)))
        .collect();
    let next = AtomicUsize::new(0);
    let done = AtomicUsize::new(jobs.len() - left.len());
    let broken = AtomicBool::new(false);
    let ending = || stop.load(Ordering::Relaxed) || broken.load(Ordering::Relaxed);
    let state = Mutex::new((known, None));
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get());
    std::thread::scope(|scope| {
        for _ in 0..threads.min(left.len()) {
            scope.spawn(|| {
                while let Some(job) = left.get(next.fetch_add(1, Ordering::Relaxed)) {
                    if ending() {
                        return;
                    }
                    // Parallel jobs use the machine better than the threads of one job: each job gets a pool of one thread.
                    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
                    let computed = match pool {
                        Ok(pool) => pool.install(|| compute(*job, &ending)),
                        Err(_) => compute(*job, &ending),
                    };
                    let mut state = state
                        .lock()
                        .unwrap_or_else(|poisoned| poisoned.into_inner());
                    if matches!(computed, Err(Error::Cancelled { .. })) {
                        return;
                    }
                    let count = done.fetch_add(1, Ordering::Relaxed) + 1;
                    match computed {
                        Err(error) => {
                            report(count, jobs.len(), Err(format!("{}: {error}", job.name())))
                        }
                        Ok(row) => {
                            if let Err(error) = append(file, &row) {
                                state.1 = Some(unreadable(file, &error));
                                broken.store(true, Ordering::Relaxed);
                                return;
                            }
                            report(count, jobs.len(), Ok(&row));
                            state.0.push(row);
                        }
                    }
                }
            });
        }
    });
    match state
        .into_inner()
        .unwrap_or_else(|poisoned| poisoned.into_inner())
    {
        (_, Some(error)) => Err(error),
        _ if stop.load(Ordering::Relaxed) => Err(Error::Cancelled {
            step: 0,
            time_us: 0.0,
        }),
        (rows, None) => Ok(rows),
    }
}

/// Computes the row of a job until `ending` returns true.
fn compute<J: Job>(job: &J, ending: &dyn Fn() -> bool) -> Result<J::Row, Error> {
    let mut watch = |_: Progress| match ending() {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    };
    job.compute(&mut Control {
        progress: Some(&mut watch),
        ..Control::default()
    })
}

fn append(file: &Path, row: &impl Serialize) -> Result<(), std::io::Error> {
    let empty = std::fs::metadata(file).map_or(true, |data| data.len() == 0);
    let mut buffer = csv::WriterBuilder::new()
        .has_headers(empty)
        .from_writer(Vec::new());
    buffer.serialize(row).map_err(std::io::Error::other)?;
    let row = buffer
        .into_inner()
        .map_err(|error| std::io::Error::other(error.to_string()))?;
    let mut out = OpenOptions::new().create(true).append(true).open(file)?;
    out.write_all(&row)?;
    out.sync_data()
}

fn unreadable(file: &Path, error: &dyn std::fmt::Display) -> Error {
    Error::Read {
        path: file.to_path_buf(),
        reason: error.to_string(),
        remedy: String::new(),
        source: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Square<'a>(i64, &'a AtomicUsize);

    impl Job for Square<'_> {
        type Row = (i64, i64);

        fn name(&self) -> String {
            self.0.to_string()
        }

        fn is_done_by(&self, row: &Self::Row) -> bool {
            row.0 == self.0
        }

        fn compute(&self, control: &mut Control<'_>) -> Result<Self::Row, Error> {
            self.1.fetch_add(1, Ordering::Relaxed);
            let (step, time_us) = (0, 0.0);
            let progress = Progress {
                step,
                time: time_us,
                fraction: 0.0,
                depth: 0.0,
            };
            match control.progress.as_mut().map(|hear| hear(progress)) {
                Some(ControlFlow::Break(())) => Err(Error::Cancelled { step, time_us }),
                _ => Ok((self.0, self.0 * self.0)),
            }
        }
    }

    #[test]
    fn what_a_file_has_is_not_computed_again() {
        let name = format!("percuss-resume-{}.csv", std::process::id());
        let file = std::env::temp_dir().join(name);
        // Rows of tuples have no header: a line of its own stands for it.
        std::fs::write(&file, "number,square\n3,9\n").unwrap();
        let runs = AtomicUsize::new(0);
        let jobs = [1, 2, 3].map(|number| Square(number, &runs));
        let report = |_: usize, total: usize, row: Result<&(i64, i64), String>| {
            assert!(total == 3 && row.is_ok());
        };
        for _ in 0..2 {
            let mut squares = complete(&file, &jobs, &AtomicBool::new(false), &report).unwrap();
            squares.sort_unstable();
            assert_eq!(squares, [(1, 1), (2, 4), (3, 9)]);
            assert_eq!(runs.load(Ordering::Relaxed), 2);
        }
        std::fs::remove_file(&file).unwrap();
    }
    #[test]
    fn what_is_stopped_keeps_what_is_done_and_nothing_else() {
        let name = format!("percuss-stopped-{}.csv", std::process::id());
        let file = std::env::temp_dir().join(name);
        std::fs::write(&file, "number,square\n").unwrap();
        let (runs, stop) = (AtomicUsize::new(0), AtomicBool::new(false));
        let jobs: Vec<Square<'_>> = (1..=100).map(|number| Square(number, &runs)).collect();
        let report = |_: usize, _: usize, row: Result<&(i64, i64), String>| {
            assert!(row.is_ok(), "a job that is stopped has not failed");
            stop.store(true, Ordering::Relaxed);
        };
        let stopped = complete(&file, &jobs, &stop, &report);
        let kept: Vec<(i64, i64)> = rows(&file).unwrap();
        std::fs::remove_file(&file).unwrap();
        assert!(matches!(stopped, Err(Error::Cancelled { .. })));
        assert!(!kept.is_empty() && kept.len() < 100, "{}", kept.len());
    }
}
