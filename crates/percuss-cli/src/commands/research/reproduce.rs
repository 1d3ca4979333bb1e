//! `percuss reproduce`: published works, item by item.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use percuss_research::{
    codes::{self, CodeComparison, ComparedValue, DimensionStudy},
    damping::{self, DampingRun, DampingStudy},
    paper::{self, Assessment, Item, Reproduction, Table},
};
use serde::Serialize;

use crate::{
    failure::Failure,
    file_list::FileList,
    progress::Progress,
    response::{ProgressCallback, Response},
    run_folder::make_folder,
    terminal::{bold, width, wrap, yellow},
};

const LONG_ABOUT: &str = "\
Reproduce the seed paper of this program, item by item: Table 1 and the
statements about figures 7 to 11, by the published scheme in two interpretations
and by the conservative scheme. Each statement is classified as reproduced,
contradicted, dependent on the interpretation, or not verifiable, with numbers.

`damping` examines a question that the paper leaves open: whether damping
explains its disagreement at high velocity. The output is the depth in its case
versus velocity and mesh, with viscous damping of every spring, with artificial
viscosity, and by the axisymmetric reference.

`codes` computes the cases that other codes were run on, compares the numbers
with their stored results, and runs Taylor rods in one and in two dimensions.

With --out DIR the page (paper.md, codes.md), its figures (SVG and PNG) and its
tables (CSV) are written to DIR, which is made if it does not exist.";

const AFTER_HELP: &str = "\
Examples:
  percuss reproduce paper --out paper
  percuss reproduce damping --out damping
  percuss reproduce codes --out codes
  percuss reproduce paper --json > paper.json

Exit codes: 0 ok, 2 bad input, 3 numerical failure, 4 a file could not be
written";

/// Works that can be reproduced.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Work {
    /// The seed paper: copper rods on thick 2024-T351 by a 1-D discrete element model
    Paper,
    /// Effect of damping on the depth of penetration in the case of the seed paper
    Damping,
    /// Comparison with stored results of NairnMPM, OpenRadioss and pyKO
    Codes,
}

/// Reproduce a published work, item by item
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Reproduce {
    /// Work to reproduce
    work: Work,
    /// Write the page, its figures and tables to a folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print one JSON object and nothing else on standard output
    #[arg(long)]
    json: bool,
}

/// Result of a reproduction.
enum ReproductionOutput {
    Paper(Reproduction),
    Damping(DampingStudy),
    Codes(CodeComparison),
}

/// Output of `--json`. The names are stable.
#[derive(Serialize)]
struct ReproductionRecord<'a> {
    percuss_version: &'static str,
    #[serde(flatten)]
    found: FoundRecord<'a>,
}

#[derive(Serialize)]
#[serde(tag = "work", rename_all = "snake_case")]
enum FoundRecord<'a> {
    Paper {
        items: &'a [Item],
        tables: &'a [Table],
    },
    Damping {
        findings: Vec<String>,
        runs: &'a [DampingRun],
        reference: Vec<Depth>,
    },
    Codes {
        findings: Vec<String>,
        runs: &'a [ComparedValue],
        dimension: &'a DimensionStudy,
    },
}

/// Depth by the axisymmetric reference.
#[derive(Serialize)]
struct Depth {
    impact_velocity_m_s: f64,
    depth_of_penetration_mm: f64,
}

impl ReproductionOutput {
    fn record(&self) -> ReproductionRecord<'_> {
        let found = match self {
            Self::Paper(reproduction) => FoundRecord::Paper {
                items: &reproduction.items,
                tables: &reproduction.tables,
            },
            Self::Damping(study) => FoundRecord::Damping {
                findings: study.findings(),
                runs: &study.runs,
                reference: study.reference.iter().map(|&at| at.into()).collect(),
            },
            Self::Codes(comparison) => FoundRecord::Codes {
                findings: comparison.findings(),
                runs: &comparison.values,
                dimension: &comparison.dimension,
            },
        };
        ReproductionRecord {
            percuss_version: env!("CARGO_PKG_VERSION"),
            found,
        }
    }

    fn write(&self, folder: &Path) -> Result<Vec<PathBuf>, Failure> {
        Ok(match self {
            Self::Paper(reproduction) => reproduction.write(folder)?,
            Self::Damping(study) => study.write(folder)?,
            Self::Codes(comparison) => comparison.write(folder)?,
        })
    }

    fn text(&self) -> String {
        match self {
            Self::Paper(reproduction) => items(reproduction),
            Self::Damping(study) => findings("Damping in the seed paper's case", study.findings()),
            Self::Codes(comparison) => {
                findings("Comparison with other codes", comparison.findings())
            }
        }
    }
}

impl From<(f64, f64)> for Depth {
    fn from((impact_velocity_m_s, depth_of_penetration_mm): (f64, f64)) -> Self {
        Self {
            impact_velocity_m_s,
            depth_of_penetration_mm,
        }
    }
}

impl Reproduce {
    pub fn run(&self) -> Result<(), Failure> {
        let mut progress = Progress::new(true);
        let found = self.find(&mut progress.callback());
        progress.finish();
        let (found, files) = found?;
        let written = FileList::new(&files);
        match self.json {
            true => written.print_json(&found.record(), false),
            false => written.print_under(found.text()),
        }
    }

    /// Output of --json.
    pub fn execute(&self, on_progress: ProgressCallback<'_>) -> Result<Response, Failure> {
        let (found, files) = self.find(on_progress)?;
        Response::json_of(&found.record(), files)
    }

    fn find(
        &self,
        on_progress: ProgressCallback<'_>,
    ) -> Result<(ReproductionOutput, Vec<PathBuf>), Failure> {
        if let Some(out) = &self.out {
            make_folder(out)?;
        }
        let found = match self.work {
            Work::Paper => ReproductionOutput::Paper(paper::reproduce(&mut |fraction| {
                on_progress(fraction, "running the cases of the paper")
            })?),
            Work::Damping => {
                ReproductionOutput::Damping(damping::damping_study(&mut |fraction| {
                    on_progress(fraction, "running the damping study")
                })?)
            }
            Work::Codes => ReproductionOutput::Codes(codes::compare_codes(&mut |fraction| {
                on_progress(fraction, "running the cases of other codes")
            })?),
        };
        let files = match &self.out {
            Some(out) => found.write(out)?,
            None => Vec::new(),
        };
        Ok((found, files))
    }
}

fn findings(title: &str, lines: Vec<String>) -> String {
    let lines = lines.into_iter();
    let lines = lines.map(|line| format!("{}\n", wrap(&line, width(), 2)));
    let title = bold(title);
    format!("{title}\n\n{}", lines.collect::<String>())
}

fn items(reproduction: &Reproduction) -> String {
    let mut text = format!("{}\n", bold("The seed paper, item by item"));
    for item in &reproduction.items {
        let assessment = match item.assessment {
            Assessment::Reproduced => item.assessment.to_string(),
            _ => yellow(item.assessment),
        };
        let statement = format!("{}: {}", item.place, item.statement);
        text += &format!("\n{}\n", wrap(&statement, width(), 2));
        let words = item.assessment.to_string();
        let finding = wrap(&format!("{words}: {}", item.finding), width() - 2, 4);
        text += &format!("  {}\n", finding.replacen(&words, &assessment, 1));
    }
    text
}
