//! `percuss sweep`: a case with some of its numbers varied.

mod axisymmetric;
mod plot;

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
    time::Instant,
};

use clap::{Args, Subcommand};
use percuss::{
    outcome::Outcome,
    sweep::{self, BatchKernel, SweepRow},
    units::{Length, UnitSystem},
};
use percuss_report::sweep::{Manifest, Status, SweepFolder, merge, status};
use serde::Serialize;

use crate::{
    cost,
    failure::Failure,
    output,
    progress::Progress,
    response::Response,
    terminal::{self, bold},
    unit_system::unit_system,
    whole_numbers::from_to,
    workers::{self, MOST_THREADS},
};

const LONG_ABOUT: &str = "\
Compute a case many times with some of its numbers varied: all combinations of
lists (a grid), a Latin hypercube, or scrambled Sobol' points, from values,
ranges and distributions.

DIR gets a manifest and Parquet files with one row per run: inputs, outcome,
every scalar result, warnings. A run that fails is a row with its error. The
sweep can be interrupted at any time; with --resume the same command computes
the missing rows. Run i depends only on the sweep file, the case and i, so the
rows are independent of the number of threads and shards.

With --axisymmetric N the model `axi` then runs on N of them, spread over the
sweep: axisymmetric.csv has its main result, the discretisation uncertainty and
the result of the sweep's model.

With --shard 2/8 the second of eight parts is computed. Each part needs its own
folder; `percuss sweep merge` joins them.";

const AFTER_HELP: &str = "\
Examples:
  percuss sweep cases/paper-table1/sweep.toml --out rows
  percuss sweep cases/paper-table1/sweep.toml --out rows --resume
  percuss sweep my-sweep.toml --out rows-2 --shard 2/8 --threads 4
  percuss sweep my-sweep.toml --out rows --resume --axisymmetric 20
  percuss sweep status rows
  percuss sweep merge rows --out rows.parquet
  percuss sweep merge rows --out rows.csv
  percuss sweep plot rows

Exit codes: 0 ok, 2 bad input, 4 a file could not be read or written, 130 the
sweep was stopped";

/// Compute a case many times with some of its numbers varied
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct Sweep {
    #[command(subcommand)]
    what: Option<What>,
    /// Sweep file: the base case, the model and what is varied
    #[arg(value_name = "SWEEP.toml", required = true)]
    file: Option<PathBuf>,
    /// Folder of the results
    #[arg(long, value_name = "DIR", required = true)]
    out: Option<PathBuf>,
    /// Continue in a folder that holds a part of this sweep
    #[arg(long)]
    resume: bool,
    /// Compute only one of several parts, such as 2/8
    #[arg(long, value_name = "I/N", value_parser = shard, default_value = "1/1")]
    shard: (u64, u64),
    /// Add axisymmetric answers of this number of runs, spread over all
    #[arg(long, value_name = "N", value_parser = from_to::<u64>(1, 100_000, "a number of axisymmetric runs"))]
    axisymmetric: Option<u64>,
    /// Number of threads [default: number of cores]
    #[arg(long, value_name = "N", value_parser = from_to::<u16>(1, MOST_THREADS, "a number of threads"))]
    threads: Option<u16>,
    /// No summary and no progress
    #[arg(long, short)]
    quiet: bool,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Print the progress of a folder of results
    Status {
        /// Folder of results
        #[arg(value_name = "DIR")]
        folder: PathBuf,
        /// Print one JSON object and nothing else on standard output
        #[arg(long)]
        json: bool,
    },
    Merge(Box<Merge>),
    Plot(plot::Plot),
}

/// Join folders that hold all parts of a sweep into one file, Parquet or CSV
#[derive(Debug, Args)]
struct Merge {
    /// Folders of results
    #[arg(value_name = "DIR", required = true)]
    folders: Vec<PathBuf>,
    /// File to write, CSV if its name ends with .csv; it is replaced if it exists
    #[arg(long, value_name = "FILE.parquet")]
    out: PathBuf,
    /// Unit system of the columns [default: mm, us, m/s, kN, MPa, J]
    #[arg(long, value_name = "SYSTEM", value_parser = unit_system())]
    units: Option<UnitSystem>,
}

impl Merge {
    /// Writes the file; returns the number of rows.
    fn write(&self) -> Result<u64, Failure> {
        Ok(merge(&self.folders, &self.out, self.units)?)
    }
}

impl Sweep {
    /// Width of the figure, where one is drawn.
    pub fn figure_width(&self) -> Option<Length> {
        match &self.what {
            Some(What::Plot(plot)) => plot.figure_width,
            _ => None,
        }
    }

    pub fn run(&self) -> Result<(), Failure> {
        match (&self.what, &self.file, &self.out) {
            (Some(What::Status { folder, json }), ..) => match *json {
                true => output::print_json(&StatusRecord::from(status(folder)?)),
                false => print_status(folder),
            },
            (Some(What::Merge(parts)), ..) => {
                let rows = parts.write()?;
                let rows = terminal::counted(rows as usize, "row");
                output::print(&format!("wrote {rows} to {}\n", parts.out.display()))
            }
            (Some(What::Plot(plot)), ..) => plot.run(),
            (None, Some(file), Some(out)) => self.compute(file, out),
            _ => Err(Failure::Usage {
                message: "a sweep file and --out DIR are required".to_owned(),
                help: "percuss sweep SWEEP.toml --out DIR".to_owned(),
            }),
        }
    }

    /// Results of the subcommands; a sweep itself is a folder of rows.
    pub fn execute(&self) -> Result<Response, Failure> {
        match &self.what {
            Some(What::Status { folder, .. }) => {
                Response::json_of(&StatusRecord::from(status(folder)?), Vec::new())
            }
            Some(What::Merge(parts)) => Response::json_of(&parts.write()?, vec![parts.out.clone()]),
            Some(What::Plot(plot)) => plot.execute(),
            None => Err(Failure::no_response()),
        }
    }

    fn compute(&self, file: &Path, out: &Path) -> Result<(), Failure> {
        let (part, parts) = self.shard;
        if self.axisymmetric.is_some() && parts > 1 {
            return Err(Failure::Usage {
                message: "`--axisymmetric` needs the whole sweep, not a part of it".to_owned(),
                help: "leave out --shard, or --axisymmetric".to_owned(),
            });
        }
        let sweep = sweep::Sweep::load(file)?;
        let folder = SweepFolder::open(out, &sweep, self.resume)?;
        let missing = folder.missing(part, parts);
        let count = |blocks: &mut dyn Iterator<Item = u64>| -> u64 {
            blocks.map(|block| folder.manifest().runs_in(block)).sum()
        };
        let total = count(&mut (part - 1..sweep.blocks()).step_by(parts as usize));
        let due = count(&mut missing.iter().copied());
        cost::tell(sweep.estimate(due), self.quiet);
        let state = Mutex::new(SweepProgress {
            progress: Progress::new(!self.quiet),
            outcomes: BTreeMap::new(),
            done: 0,
        });
        let start = Instant::now();
        let on_progress = |rows: &[SweepRow]| {
            let mut state = state.lock().unwrap_or_else(PoisonError::into_inner);
            state.on_progress(rows);
            let rate = state.done as f64 / start.elapsed().as_secs_f64();
            let done = total - due + state.done;
            let words = format!("{done} of {total} runs, {} per second", rounded(rate));
            let fraction = done as f64 / total as f64;
            state.progress.update(fraction, &words);
        };
        on_progress(&[]);
        let pool = workers::pool(self.threads)?;
        let stop = workers::stop_on_request();
        let kernel = BatchKernel::new(sweep.model);
        let complete =
            pool.install(|| folder.compute(&sweep, &kernel, &missing, &stop, &on_progress));
        let state = state.into_inner().unwrap_or_else(PoisonError::into_inner);
        state.progress.finish();
        if !complete? {
            return Err(Failure::SweepStopped {
                done: total - due + state.done,
                runs: total,
            });
        }
        let answers = match self.axisymmetric {
            Some(count) => {
                pool.install(|| axisymmetric::compute(&sweep, out, count, &stop, self.quiet))?
            }
            None => String::new(),
        };
        if self.quiet {
            return Ok(());
        }
        let seconds = start.elapsed().as_secs_f64();
        let mut text = format!(
            "{}\n  {} in {}",
            bold(format!(
                "{}, model {}, {}",
                sweep.case(),
                sweep.model.name(),
                sweep.design().name()
            )),
            terminal::counted(sweep.runs() as usize, "run"),
            out.display(),
        );
        if parts > 1 {
            text += &format!(", of which part {part}/{parts} has {total}");
        }
        text += &match due {
            0 if total == 0 => {
                "\n  no block of runs falls to this part: take fewer parts\n".to_owned()
            }
            0 => "\n  all rows were already computed\n".to_owned(),
            _ => {
                let rate = rounded(due as f64 / seconds);
                format!("\n  computed {due} in {seconds:.1} s, {rate} per second\n")
            }
        };
        for (outcome, count) in &state.outcomes {
            text += &format!("  {count:>9} {outcome}\n");
        }
        output::print(&(text + &answers))
    }
}

/// Output of `percuss sweep status --json`. The names are stable.
#[derive(Serialize)]
struct StatusRecord {
    manifest: Manifest,
    blocks_done: Vec<u64>,
    blocks_damaged: Vec<u64>,
    runs_done: u64,
    running: bool,
}

impl From<Status> for StatusRecord {
    fn from(status: Status) -> Self {
        Self {
            runs_done: status.runs_done(),
            manifest: status.manifest,
            blocks_done: status.done,
            blocks_damaged: status.damaged,
            running: status.running,
        }
    }
}

/// Progress and outcomes of a sweep in progress.
struct SweepProgress {
    progress: Progress,
    outcomes: BTreeMap<&'static str, u64>,
    done: u64,
}

impl SweepProgress {
    fn on_progress(&mut self, rows: &[SweepRow]) {
        self.done += rows.len() as u64;
        for row in rows {
            let outcome = row.record.as_ref().map_or(Outcome::Failed, |r| r.outcome);
            *self.outcomes.entry(outcome.describe()).or_default() += 1;
        }
    }
}

fn print_status(folder: &Path) -> Result<(), Failure> {
    let status = status(folder)?;
    let manifest = &status.manifest;
    let mut text = format!(
        "{}\n  {} of {} runs done, {} of {} blocks\n",
        bold(format!(
            "{}: {}, model {}, {}",
            folder.display(),
            manifest.case,
            manifest.model,
            manifest.design
        )),
        status.runs_done(),
        manifest.runs,
        status.done.len(),
        manifest.blocks(),
    );
    if !status.damaged.is_empty() {
        let files = terminal::counted(status.damaged.len(), "damaged file");
        text += &format!("  {files}: --resume computes the lost rows again\n");
    }
    if status.running {
        text += "  a process is computing this sweep now\n";
    }
    output::print(&text)
}

/// Rate to three digits.
fn rounded(rate: f64) -> String {
    match rate {
        ..10.0 => format!("{rate:.2}"),
        ..100.0 => format!("{rate:.1}"),
        _ => format!("{rate:.0}"),
    }
}

fn shard(text: &str) -> Result<(u64, u64), String> {
    let parsed = text.split_once('/').and_then(|(part, parts)| {
        let part: u64 = part.trim().parse().ok()?;
        let parts: u64 = parts.trim().parse().ok()?;
        (1..=parts).contains(&part).then_some((part, parts))
    });
    parsed
        .filter(|(_, parts)| *parts <= 1_000_000)
        .ok_or_else(|| {
            "give a part and the number of parts, such as 2/8 for the second of eight".to_owned()
        })
}
