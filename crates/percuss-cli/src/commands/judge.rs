use std::{path::PathBuf, sync::Mutex};

use clap::{Args, ValueEnum};
use percuss::judge::{
    self, Group, Grouping, Reference, Shot, Verdict, ablation::Line, reference, study,
};
use percuss_report::judgement::{self, Judgement, Origin};
use serde::Serialize;

use crate::{
    diagnostic, failure::Failure, judgement_table, progress::Progress, run_folder::make_folder,
    terminal, written::Written,
};

const LONG_ABOUT: &str = "\
Judge every model that gives depths by the axisymmetric reference, model `axi`:
flat rods on thick targets, at speeds from 150 to 1500 m/s and L/D 1 to 10, of
seven pairs of materials.

The reference is stored in the program, since it takes long; the models are run
anew, which takes seconds. The answer is the error of each model by speed,
length, regime and materials, and a few sentences that say what it comes to.

With --out DIR the report is written as one HTML page and as Markdown with its
figures, and the numbers as CSV and Parquet.

With --compute the shots that the files of --reference and --study lack are
computed first, and appended as each is done: break it off at any time, and the
same command goes on where it was. Two meshes, --cells 4 and --cells 8, give a
reference its uncertainty.";

const AFTER_HELP: &str = "\
Examples:
  percuss judge
  percuss judge --by regime --by speed
  percuss judge --out judgement
  percuss judge --json > judgement.json
  percuss judge --compute --reference my-reference.csv --cells 4

Exit codes: 0 ok, 2 bad input or no reference, 4 a file could not be read or
written";

/// Judge all depth models by the axisymmetric reference
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Judge {
    /// CSV file of reference depths in place of the program's own
    #[arg(long, value_name = "FILE")]
    reference: Option<PathBuf>,
    /// CSV file of the paper's case by the reference in place of the program's own
    #[arg(long, value_name = "FILE")]
    study: Option<PathBuf>,
    /// Compute what these two files lack, which may take hours
    #[arg(long)]
    compute: bool,
    /// Cells along the projectile's radius, for --compute with --reference
    #[arg(long, value_name = "N", default_value_t = 8, requires = "compute")]
    #[arg(value_parser = clap::value_parser!(u32).range(2..=64))]
    cells: u32,
    /// Print all errors by this; may be given several times
    #[arg(long, value_name = "WHAT")]
    by: Vec<By>,
    /// Write the report and its numbers to a folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print one JSON object and nothing else on standard output
    #[arg(long)]
    json: bool,
    /// No table and no progress: one line of NAME=VALUE pairs a model
    #[arg(long, short)]
    quiet: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum By {
    Speed,
    Length,
    Regime,
    Materials,
    Uncertainty,
}

impl From<By> for Grouping {
    fn from(by: By) -> Self {
        match by {
            By::Speed => Self::Speed,
            By::Length => Self::Length,
            By::Regime => Self::Regime,
            By::Materials => Self::Pair,
            By::Uncertainty => Self::Reference,
        }
    }
}

/// What `--json` prints. The names are stable.
#[derive(Serialize)]
struct Record<'a> {
    percuss_version: &'static str,
    reference: &'a str,
    findings: Vec<String>,
    statistics: Vec<Group>,
    ablation: &'a [Line],
    verdicts: &'a [Verdict],
}

impl Judge {
    pub fn run(&self) -> Result<(), Failure> {
        let shots = judge::shots();
        if let Some(out) = &self.out {
            make_folder(out)?;
        }
        if self.compute {
            self.compute(&shots)?;
        }
        let (references, origin) = self.references()?;
        let study = match &self.study {
            Some(file) => study::read_file(file)?,
            None => study::built_in(),
        };
        if !references
            .iter()
            .any(|row| shots.iter().any(|shot| row.is_of(shot)))
        {
            return Err(Failure::Usage {
                message: format!("there is no reference to judge by in {origin}"),
                help: "give a file that has one: --reference FILE; --compute computes it"
                    .to_owned(),
            });
        }
        let mut progress = Progress::new(!self.quiet);
        progress.update(0.1, "running all models on all shots");
        let judgement = Judgement::new(&shots, references, study)?;
        let origin = Origin {
            reference: origin,
            command: self.command(),
        };
        let mut paths = Vec::new();
        if let Some(out) = &self.out {
            progress.update(0.7, "drawing figures");
            paths = judgement::write(out, &judgement, &origin)?;
        }
        progress.finish();
        let written = Written::new(&paths);
        if self.json {
            return written.print_json(&record(&judgement, &origin), self.quiet);
        }
        if self.quiet {
            let lines: String = judge::statistics(&judgement.verdicts, Grouping::All)
                .iter()
                .map(judgement_table::one_line)
                .collect();
            return terminal::print(&lines);
        }
        let by: Vec<Grouping> = self.by.iter().copied().map(Grouping::from).collect();
        written.print_under(judgement_table::text(&judgement, &origin, &by))
    }

    /// The reference and what it comes from.
    fn references(&self) -> Result<(Vec<Reference>, String), Failure> {
        let (references, name) = match &self.reference {
            Some(file) => {
                // A misspelt name should not look like an empty file.
                let text = std::fs::File::open(file).map_err(|source| percuss::Error::Read {
                    path: file.clone(),
                    reason: match source.kind() {
                        std::io::ErrorKind::NotFound => "there is no such file".to_owned(),
                        _ => source.to_string(),
                    },
                    source: Some(source),
                })?;
                drop(text);
                (reference::read_file(file)?, file.display().to_string())
            }
            None => (reference::built_in(), "the program's own".to_owned()),
        };
        let name = format!("{name} ({} rows)", references.len());
        Ok((references, name))
    }

    /// Computes what the files lack.
    fn compute(&self, shots: &[Shot]) -> Result<(), Failure> {
        if self.reference.is_none() && self.study.is_none() {
            return Err(Failure::Usage {
                message: "--compute needs a file to write to".to_owned(),
                help: "add --reference FILE, --study FILE or both; a file that exists is completed"
                    .to_owned(),
            });
        }
        if let Some(file) = &self.study {
            self.announce(&format!(
                "{}: computing the paper's case, {} runs, minutes to half an hour",
                file.display(),
                study::SPEEDS.len() * study::VARIANTS.len()
            ));
            let watch = Watch::new(!self.quiet, 0.0);
            study::complete(file, &|done, of, row| {
                watch.hear(done, of, 0.0, row.err());
            })?;
            watch.finish();
        }
        if let Some(file) = &self.reference {
            let known = reference::read_file(file)?;
            let cost = |shot: &Shot| reference::seconds(shot, self.cells, &known);
            let missing: Vec<&Shot> = shots
                .iter()
                .filter(|shot| {
                    let done = |row: &&Reference| row.cells_per_radius == self.cells;
                    !known.iter().filter(done).any(|row| row.is_of(shot))
                })
                .collect();
            let total: Option<f64> = missing.iter().map(|shot| cost(shot)).sum();
            let cores = std::thread::available_parallelism().map_or(1, |n| n.get());
            self.announce(&format!(
                "{}: computing {} of {} shots on {} cells per radius, {}",
                file.display(),
                missing.len(),
                shots.len(),
                self.cells,
                match total {
                    Some(seconds) => format!(
                        "about {} on {}",
                        in_words(seconds / cores as f64),
                        terminal::counted(cores, "core")
                    ),
                    None => "which may take hours: 8 times as long for twice the cells".to_owned(),
                }
            ));
            let watch = Watch::new(!self.quiet, total.unwrap_or(0.0));
            reference::complete(file, shots, self.cells, &|done, of, row| {
                let seconds = row
                    .as_ref()
                    .ok()
                    .and_then(|row| shots.iter().find(|shot| row.is_of(shot)))
                    .and_then(cost);
                watch.hear(done, of, seconds.unwrap_or(0.0), row.err());
            })?;
            watch.finish();
        }
        Ok(())
    }

    fn announce(&self, words: &str) {
        if !self.quiet {
            diagnostic::print(&format!("{words}\n"));
        }
    }

    /// The command as a user would type it.
    fn command(&self) -> String {
        let mut words = vec!["percuss judge".to_owned()];
        let path = |name: &str, path: &PathBuf| format!("{name} {}", path.display());
        words.extend(self.reference.iter().map(|file| path("--reference", file)));
        words.extend(self.study.iter().map(|file| path("--study", file)));
        words.extend(self.out.iter().map(|out| path("--out", out)));
        words.join(" ")
    }
}

/// Progress of shots that take long, by the work that they are expected to be.
struct Watch {
    state: Mutex<(Progress, f64)>,
    /// All the work that was left at the start; 0 when nobody knows.
    total: f64,
}

impl Watch {
    fn new(wanted: bool, total: f64) -> Self {
        Self {
            state: Mutex::new((Progress::new(wanted), 0.0)),
            total,
        }
    }

    fn hear(&self, done: usize, of: usize, work: f64, failure: Option<String>) {
        if let Some(reason) = failure {
            diagnostic::print(&format!("warning: no reference: {reason}\n"));
        }
        if let Ok(mut state) = self.state.lock() {
            state.1 += work;
            let fraction = match self.total > 0.0 {
                true => state.1 / self.total,
                false => done as f64 / of as f64,
            };
            state.0.update(fraction, &format!("{done} of {of} shots"));
        }
    }

    fn finish(self) {
        if let Ok((progress, _)) = self.state.into_inner() {
            progress.finish();
        }
    }
}

fn in_words(seconds: f64) -> String {
    match seconds {
        ..5400.0 => format!("{:.0} min", (seconds / 60.0).ceil()),
        _ => format!("{:.1} h", seconds / 3600.0),
    }
}

fn record<'a>(judgement: &'a Judgement, origin: &'a Origin) -> Record<'a> {
    Record {
        percuss_version: env!("CARGO_PKG_VERSION"),
        reference: &origin.reference,
        findings: judge::findings(&judgement.verdicts),
        statistics: Grouping::ALL
            .iter()
            .flat_map(|grouping| judge::statistics(&judgement.verdicts, *grouping))
            .collect(),
        ablation: &judgement.ablation,
        verdicts: &judgement.verdicts,
    }
}
