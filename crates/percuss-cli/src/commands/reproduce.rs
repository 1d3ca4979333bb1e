use std::{ops::ControlFlow, path::PathBuf};

use clap::{Args, ValueEnum};
use percuss_report::{
    damping::{self, DampingStudy},
    paper::{self, Reproduction, Verdict},
};

use crate::{
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

The page (paper.md), its figures (SVG and PNG) and its tables (CSV) are written
to the folder given with --out.

`damping` answers what that paper asks and leaves open: whether damping explains
its mismatch at high speed. The depth in its case, against speed and mesh, with
viscous damping of every spring and with artificial viscosity, and beside it the
axisymmetric reference.";

const AFTER_HELP: &str = "\
Examples:
  percuss reproduce paper --out paper
  percuss reproduce damping --out damping

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
    /// Folder for the page, its figures and tables
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

impl Reproduce {
    pub fn run(&self) -> Result<(), Failure> {
        make_folder(&self.out)?;
        let mut progress = Progress::new(true);
        let (text, written) = match self.work {
            Work::Paper => {
                let reproduction = paper::reproduce(&mut |fraction| {
                    progress.update(fraction, "running the paper's cases");
                    ControlFlow::Continue(())
                })?;
                (items(&reproduction), reproduction.write(&self.out)?)
            }
            Work::Damping => {
                let study = damping::damping_study(&mut |fraction| {
                    progress.update(fraction, "damping the paper's case");
                    ControlFlow::Continue(())
                })?;
                (findings(&study), study.write(&self.out)?)
            }
        };
        progress.finish();
        Written::new(&written).print_under(text)
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
