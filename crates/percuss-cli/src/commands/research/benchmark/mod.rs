//! `percuss benchmark`: depth models compared with the axisymmetric reference.

mod compute;
mod table;

use std::{
    path::{Path, PathBuf},
    sync::atomic::AtomicBool,
};

use clap::{Args, ValueEnum};
use percuss::{
    input_file::{self, MAX_TABLE_BYTES},
    model_error::ErrorRecord,
};
use percuss_research::{
    benchmark::{
        self, CheckedReference, Design, Group, Grouping, Reference, RefusedReference, reference,
    },
    benchmark_report::{self, BenchmarkResults, Origin},
    paper_case::{self, variants::VariantResult},
};
use serde::Serialize;

use crate::{
    diagnostic,
    failure::Failure,
    file_list::FileList,
    output,
    progress::Progress,
    response::{ProgressCallback, Response},
    run_folder::make_folder,
    whole_numbers::from_to,
};

/// Fraction of the work that is the computation of the reference, where it is computed.
const COMPUTED: f64 = 0.98;

const LONG_ABOUT: &str = "\
Compare every model that gives depths with the axisymmetric reference, model
`axi`: flat rods on thick targets, at impact velocities from 150 to 1500 m/s and
L/D 1 to 10, of seven pairs of materials.

The reference depths are stored in the program because they take hours; the
other models run again, which takes seconds. The output is the error of each
model by velocity, length, regime and materials, and a summary.

With --out DIR the report is written as one HTML page and as Markdown with its
figures, and the numbers as CSV and Parquet.

A reference depth needs three meshes. Where it is monotone with an observed
order of 1 to 3 it is extrapolated; otherwise the finest mesh counts. With an
uncertainty above 15 %, or a depth below that of a shorter rod, it is refused.
Cases whose reference fails are listed with the reason and left out of all
numbers.

With --design spread the cases are 104 others: 26 pairs of materials, L/D 1 to
20 and 100 to 2500 m/s. The forms of chain with an expanding cavity,
energy_balance and momentum_balance were chosen or corrected with the cases of
both designs in view; no other model was developed on those of this one.

With --compute the cases that the files of --reference and --paper-case lack
are computed first. Each result is appended as soon as it is complete, so that
the same command continues after an interruption. Run it with --cells 4, 8
and 12.";

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
    /// CSV file of reference depths, instead of those of the program
    #[arg(long, value_name = "FILE")]
    reference: Option<PathBuf>,
    /// CSV file of reference results for the case of the seed paper, instead of those of the program
    #[arg(long, value_name = "FILE")]
    paper_case: Option<PathBuf>,
    /// Compute the cases that these two files lack, which may take hours
    #[arg(long)]
    compute: bool,
    /// Cells along the projectile's radius, for --compute with --reference
    #[arg(long, value_name = "N", default_value_t = 8, requires = "compute")]
    #[arg(value_parser = from_to::<u32>(2, 64, "a number of cells"))]
    cells: u32,
    /// Leave out cases that take longer than this on one core [s], for --compute with --reference
    #[arg(
        long,
        value_name = "SECONDS",
        requires = "compute",
        allow_negative_numbers = true
    )]
    #[arg(value_parser = positive)]
    budget: Option<f64>,
    /// Cases: the grid of the tables and figures, or other pairs of materials spread over L/D 1 to 20 and 100 to 2500 m/s
    #[arg(long, value_enum, value_name = "DESIGN", default_value_t = DesignName::Grid)]
    design: DesignName,
    /// Print the errors by this property; may be given several times
    #[arg(long, value_name = "WHAT")]
    by: Vec<By>,
    /// Write the report and its numbers to a folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print one JSON object and nothing else on standard output
    #[arg(long)]
    json: bool,
    /// No table and no progress: one line of NAME=VALUE pairs per model
    #[arg(long, short)]
    quiet: bool,
}

/// A positive number of an option.
fn positive(text: &str) -> Result<f64, String> {
    let number: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    match number.is_finite() && number > 0.0 {
        true => Ok(number),
        false => Err("must be positive".to_owned()),
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum DesignName {
    Grid,
    Spread,
}

impl From<DesignName> for Design {
    fn from(name: DesignName) -> Self {
        match name {
            DesignName::Grid => Self::Grid,
            DesignName::Spread => Self::Spread,
        }
    }
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

/// Output of `--json`. The names are stable.
#[derive(Serialize)]
struct BenchmarkRecord<'a> {
    percuss_version: &'static str,
    reference: &'a str,
    failures: &'a [String],
    refused: Vec<RefusedReference>,
    findings: Vec<String>,
    statistics: Vec<Group>,
    variants: &'a [VariantResult],
    verdicts: &'a [ErrorRecord],
}

/// Result of the command and the files that it wrote.
struct BenchmarkOutput {
    compared: BenchmarkResults,
    origin: Origin,
    /// Cases whose reference could not be computed, with the reason.
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
        // Every row is stored as soon as it is complete: Ctrl-C can end the program.
        let mut progress = Progress::new(!self.quiet);
        let found = self.find(&AtomicBool::new(false), &mut progress.callback(), &say);
        progress.finish();
        let found = found?;
        for failure in &found.failures {
            diagnostic::print(&format!("warning: no reference: {failure}\n"));
        }
        let written = FileList::new(&found.files);
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

    /// Output of --json.
    pub fn execute(
        &self,
        stop: &AtomicBool,
        on_progress: ProgressCallback<'_>,
    ) -> Result<Response, Failure> {
        let found = self.find(stop, on_progress, &|_| ())?;
        Response::json_of(&record(&found), found.files.clone())
    }

    fn find(
        &self,
        stop: &AtomicBool,
        on_progress: ProgressCallback<'_>,
        say: &dyn Fn(&str),
    ) -> Result<BenchmarkOutput, Failure> {
        let cases = Design::from(self.design).cases();
        if let Some(out) = &self.out {
            make_folder(out)?;
        }
        let failures = match self.compute {
            true => {
                let mut part = |part: f64, words: &str| on_progress(COMPUTED * part, words);
                compute::complete(self, &cases, stop, &mut part, say)?
            }
            false => Vec::new(),
        };
        let (references, reference) = self.references()?;
        let paper_case = match &self.paper_case {
            Some(file) => {
                opens(file)?;
                paper_case::read_file(file)?
            }
            None => paper_case::built_in(),
        };
        if !references
            .iter()
            .any(|row| cases.iter().any(|case| row.is_of(case)))
        {
            return Err(Failure::Usage {
                message: format!("there is no reference depth in {reference}"),
                help:
                    "give a file with reference depths: --reference FILE; --compute computes them"
                        .to_owned(),
            });
        }
        let checked = benchmark::check_references(&cases, &references);
        if checked.iter().all(|entry| entry.estimate.is_err()) {
            return Err(refused_all(&reference, &checked));
        }
        let _ = on_progress(COMPUTED, "running all models on all cases");
        let compared = BenchmarkResults::new(&cases, &references, paper_case)?;
        let origin = Origin {
            reference,
            command: self.command(),
        };
        let mut files = Vec::new();
        if let Some(out) = &self.out {
            let _ = on_progress(1.0, "drawing figures");
            files = benchmark_report::write(out, &compared, &origin)?;
        }
        Ok(BenchmarkOutput {
            compared,
            origin,
            failures,
            files,
        })
    }

    /// Reference depths with their source.
    fn references(&self) -> Result<(Vec<Reference>, String), Failure> {
        let (references, name) = match &self.reference {
            Some(file) => {
                opens(file)?;
                (reference::read_file(file)?, file.display().to_string())
            }
            None => (reference::built_in(), "data of the program".to_owned()),
        };
        let name = format!("{name} ({} rows)", references.len());
        Ok((references, name))
    }

    /// Command line that repeats this command.
    fn command(&self) -> String {
        let mut words = vec!["percuss benchmark".to_owned()];
        let path = |name: &str, path: &PathBuf| format!("{name} {}", path.display());
        words.extend(self.reference.iter().map(|file| path("--reference", file)));
        words.extend(
            self.paper_case
                .iter()
                .map(|file| path("--paper-case", file)),
        );
        words.extend(self.out.iter().map(|out| path("--out", out)));
        words.join(" ")
    }
}

/// Fails where a file cannot be opened: a misspelt name is an error, not an empty file.
fn opens(file: &Path) -> Result<(), Failure> {
    input_file::open(file, MAX_TABLE_BYTES).map_err(|error| input_file::unreadable(file, error))?;
    Ok(())
}

/// Error when no reference passes its check.
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

fn record(found: &BenchmarkOutput) -> BenchmarkRecord<'_> {
    let BenchmarkOutput {
        compared, origin, ..
    } = found;
    BenchmarkRecord {
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
        variants: &compared.variants,
        verdicts: &compared.verdicts,
    }
}
