mod compute;
mod table;

use std::{path::PathBuf, sync::atomic::AtomicBool};

use clap::{Args, ValueEnum};
use percuss::model_error::Verdict;
use percuss_research::{
    benchmark::{self, CheckedReference, Group, Grouping, Reference, RefusedReference, reference},
    benchmark_report::{self, BenchmarkResults, Origin},
    paper_case::{self, ablation::Line},
};
use serde::Serialize;

use crate::{
    answer::{Answer, Hear},
    diagnostic,
    failure::Failure,
    output,
    progress::Progress,
    run_folder::make_folder,
    written::Written,
};

/// Part of the work that is done when the reference is there, where it has to be computed: the rest takes seconds.
const COMPUTED: f64 = 0.98;

const LONG_ABOUT: &str = "\
Judge every model that gives depths by the axisymmetric reference, model `axi`:
flat rods on thick targets, at speeds from 150 to 1500 m/s and L/D 1 to 10, of
seven pairs of materials.

The reference is stored in the program, since it takes long; the models are run
anew, which takes seconds. The answer is the error of each model by speed,
length, regime and materials, and a few sentences that say what it comes to.

With --out DIR the report is written as one HTML page and as Markdown with its
figures, and the numbers as CSV and Parquet.

A reference needs three meshes. Where the depth is monotone with an observed
order of 0.5 to 2.2 it is extrapolated, by at most 25 %; otherwise the meshes
must agree within 10 %. A rod that stops short of a shorter one is refused.
Shots that fail are listed with the reason and left out of all numbers.

With --compute the shots that the files of --reference and --study lack are
computed first, and appended as each is done: break it off at any time, and the
same command goes on where it was. Run it with --cells 4, 8 and 12.";

const AFTER_HELP: &str = "\
Examples:
  percuss benchmark
  percuss benchmark --by regime --by speed
  percuss benchmark --out benchmark
  percuss benchmark --json > benchmark.json
  percuss benchmark --compute --reference my-reference.csv --cells 4

Exit codes: 0 ok, 2 bad input or no reference, 4 a file could not be read or
written";

/// Compare all depth models with the axisymmetric reference
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Benchmark {
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
    failures: &'a [String],
    refused: Vec<RefusedReference>,
    findings: Vec<String>,
    statistics: Vec<Group>,
    ablation: &'a [Line],
    verdicts: &'a [Verdict],
}

/// What the command found out and wrote.
struct Found {
    compared: BenchmarkResults,
    origin: Origin,
    /// Shots whose reference was to be computed and failed, and why.
    failures: Vec<String>,
    files: Vec<PathBuf>,
}

impl Benchmark {
    pub fn run(&self) -> Result<(), Failure> {
        let say = |words: &str| {
            if !self.quiet {
                diagnostic::print(&format!("{words}\n"));
            }
        };
        // What is done is kept row by row, so that Ctrl-C may just end the program.
        let mut progress = Progress::new(!self.quiet);
        let found = self.find(&AtomicBool::new(false), &mut progress.hear(), &say);
        progress.finish();
        let found = found?;
        for failure in &found.failures {
            diagnostic::print(&format!("warning: no reference: {failure}\n"));
        }
        let written = Written::new(&found.files);
        if self.json {
            return written.print_json(&record(&found), self.quiet);
        }
        if self.quiet {
            let lines: String = benchmark::statistics(&found.compared.verdicts, Grouping::All)
                .iter()
                .map(table::one_line)
                .collect();
            return output::print(&lines);
        }
        let by: Vec<Grouping> = self.by.iter().copied().map(Grouping::from).collect();
        written.print_under(table::text(&found.compared, &found.origin, &by))
    }

    /// What the command prints with --json.
    pub fn answer(&self, stop: &AtomicBool, hear: Hear<'_>) -> Result<Answer, Failure> {
        let found = self.find(stop, hear, &|_| ())?;
        Answer::json_of(&record(&found), found.files.clone())
    }

    fn find(
        &self,
        stop: &AtomicBool,
        hear: Hear<'_>,
        say: &dyn Fn(&str),
    ) -> Result<Found, Failure> {
        let shots = benchmark::shots();
        if let Some(out) = &self.out {
            make_folder(out)?;
        }
        let failures = match self.compute {
            true => {
                let mut part = |part: f64, words: &str| hear(COMPUTED * part, words);
                compute::complete(self, &shots, stop, &mut part, say)?
            }
            false => Vec::new(),
        };
        let (references, reference) = self.references()?;
        let study = match &self.study {
            Some(file) => paper_case::read_file(file)?,
            None => paper_case::built_in(),
        };
        if !references
            .iter()
            .any(|row| shots.iter().any(|shot| row.is_of(shot)))
        {
            return Err(Failure::Usage {
                message: format!("there is no reference depth in {reference}"),
                help: "give a file that has one: --reference FILE; --compute computes it"
                    .to_owned(),
            });
        }
        let checked = benchmark::check_references(&shots, &references);
        if checked.iter().all(|entry| entry.estimate.is_err()) {
            return Err(refused_all(&reference, &checked));
        }
        let _ = hear(COMPUTED, "running all models on all shots");
        let compared = BenchmarkResults::new(&shots, &references, study)?;
        let origin = Origin {
            reference,
            command: self.command(),
        };
        let mut files = Vec::new();
        if let Some(out) = &self.out {
            let _ = hear(1.0, "drawing figures");
            files = benchmark_report::write(out, &compared, &origin)?;
        }
        Ok(Found {
            compared,
            origin,
            failures,
            files,
        })
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

    /// The command as a user would type it.
    fn command(&self) -> String {
        let mut words = vec!["percuss benchmark".to_owned()];
        let path = |name: &str, path: &PathBuf| format!("{name} {}", path.display());
        words.extend(self.reference.iter().map(|file| path("--reference", file)));
        words.extend(self.study.iter().map(|file| path("--study", file)));
        words.extend(self.out.iter().map(|out| path("--out", out)));
        words.join(" ")
    }
}

/// The error when no reference passes the check.
fn refused_all(reference: &str, checked: &[CheckedReference]) -> Failure {
    let reasons = checked.iter().filter_map(|entry| {
        let refused = entry.refused()?;
        Some(format!(
            "{}, L/D {}, {} m/s: {}",
            benchmark::pair_name(&refused.projectile, &refused.target),
            refused.length_to_diameter,
            refused.impact_velocity_m_s,
            refused.reason
        ))
    });
    let reasons: Vec<String> = reasons.take(3).collect();
    Failure::Usage {
        message: format!(
            "no reference in {reference} passes the convergence check: {}",
            reasons.join("; ")
        ),
        help: "compute three meshes: --compute with --cells 4, 8 and 12".to_owned(),
    }
}

fn record(found: &Found) -> Record<'_> {
    let Found {
        compared, origin, ..
    } = found;
    Record {
        percuss_version: env!("CARGO_PKG_VERSION"),
        reference: &origin.reference,
        failures: &found.failures,
        refused: compared
            .references
            .iter()
            .filter_map(CheckedReference::refused)
            .collect(),
        findings: benchmark::findings(&compared.verdicts),
        statistics: Grouping::ALL
            .iter()
            .flat_map(|grouping| benchmark::statistics(&compared.verdicts, *grouping))
            .collect(),
        ablation: &compared.ablation,
        verdicts: &compared.verdicts,
    }
}
