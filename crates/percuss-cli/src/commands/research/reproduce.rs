use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use percuss_research::{
    damping::{self, DampingStudy, Shot},
    paper::{self, Item, Reproduction, Table, Verdict},
};
use serde::Serialize;

use crate::{
    answer::{Answer, Hear},
    failure::Failure,
    progress::Progress,
    run_folder::make_folder,
    terminal::{bold, width, wrap, yellow},
    written::Written,
};

const LONG_ABOUT: &str = "\
Work through the paper that this program starts from, item by item: Table 1 and
what the text says of figures 7 to 11, by the published scheme in two readings
and by the conservative scheme. Each statement is reproduced, contradicted,
depends on the reading, or cannot be known, with numbers.

`damping` answers what that paper asks and leaves open: whether damping explains
its mismatch at high speed. The depth in its case, against speed and mesh, with
viscous damping of every spring and with artificial viscosity, and beside it the
axisymmetric reference.

With --out DIR the page (paper.md), its figures (SVG and PNG) and its tables
(CSV) are written to DIR, which is made if it does not exist.";

const AFTER_HELP: &str = "\
Examples:
  percuss reproduce paper --out paper
  percuss reproduce damping --out damping
  percuss reproduce paper --json > paper.json

Exit codes: 0 ok, 2 bad input, 3 numerical failure, 4 a file could not be
written";

/// Works that can be reproduced.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Work {
    /// The seed paper: copper rods on thick 2024-T351 by a 1-D discrete element model
    Paper,
    /// Its suspicion: what damping does to the depth in its case
    Damping,
}

/// Reproduce a published work and say what holds
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Reproduce {
    /// What to reproduce
    work: Work,
    /// Write the page, its figures and tables to a folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print one JSON object and nothing else on standard output
    #[arg(long)]
    json: bool,
}

/// What came of it.
enum Found {
    Paper(Reproduction),
    Damping(DampingStudy),
}

/// What `--json` prints. The names are stable.
#[derive(Serialize)]
struct Record<'a> {
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
        shots: &'a [Shot],
        reference: Vec<Depth>,
    },
}

/// Depth by the axisymmetric reference.
#[derive(Serialize)]
struct Depth {
    impact_velocity_m_s: f64,
    depth_of_penetration_mm: f64,
}

impl Found {
    fn record(&self) -> Record<'_> {
        let found = match self {
            Self::Paper(reproduction) => FoundRecord::Paper {
                items: &reproduction.items,
                tables: &reproduction.tables,
            },
            Self::Damping(study) => FoundRecord::Damping {
                findings: study.findings(),
                shots: &study.shots,
                reference: study.reference.iter().map(|&at| at.into()).collect(),
            },
        };
        Record {
            percuss_version: env!("CARGO_PKG_VERSION"),
            found,
        }
    }

    fn write(&self, folder: &Path) -> Result<Vec<PathBuf>, Failure> {
        Ok(match self {
            Self::Paper(reproduction) => reproduction.write(folder)?,
            Self::Damping(study) => study.write(folder)?,
        })
    }

    fn text(&self) -> String {
        match self {
            Self::Paper(reproduction) => items(reproduction),
            Self::Damping(study) => findings(study),
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
        let found = self.find(&mut progress.hear());
        progress.finish();
        let (found, files) = found?;
        let written = Written::new(&files);
        match self.json {
            true => written.print_json(&found.record(), false),
            false => written.print_under(found.text()),
        }
    }

    /// What the command prints with --json.
    pub fn answer(&self, hear: Hear<'_>) -> Result<Answer, Failure> {
        let (found, files) = self.find(hear)?;
        Answer::json_of(&found.record(), files)
    }

    fn find(&self, hear: Hear<'_>) -> Result<(Found, Vec<PathBuf>), Failure> {
        if let Some(out) = &self.out {
            make_folder(out)?;
        }
        let found = match self.work {
            Work::Paper => Found::Paper(paper::reproduce(&mut |fraction| {
                hear(fraction, "running the paper's cases")
            })?),
            Work::Damping => Found::Damping(damping::damping_study(&mut |fraction| {
                hear(fraction, "damping the paper's case")
            })?),
        };
        let files = match &self.out {
            Some(out) => found.write(out)?,
            None => Vec::new(),
        };
        Ok((found, files))
    }
}

fn findings(study: &DampingStudy) -> String {
    let lines = study.findings().into_iter();
    let lines = lines.map(|line| format!("{}\n", wrap(&line, width(), 2)));
    let title = bold("Damping in the seed paper's case");
    format!("{title}\n\n{}", lines.collect::<String>())
}

fn items(reproduction: &Reproduction) -> String {
    let mut text = format!("{}\n", bold("The seed paper, item by item"));
    for item in &reproduction.items {
        let verdict = match item.verdict {
            Verdict::Reproduced => item.verdict.to_string(),
            _ => yellow(item.verdict),
        };
        text += &format!(
            "\n{}: {}\n",
            item.place,
            wrap(&item.statement, width() - 10, 2)
        );
        text += &format!("  {verdict}: {}\n", wrap(&item.finding, width() - 14, 4));
    }
    text
}
