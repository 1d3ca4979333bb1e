mod checkpoints;
mod others;
mod task;

use std::{path::PathBuf, sync::Arc, sync::atomic::AtomicBool, time::Duration};

use clap::{Args, builder::PossibleValuesParser, value_parser};
use percuss::{
    model::{DEFAULT_MODEL, MODELS},
    outcome::{RunResult, Termination},
    summary::ResultRecord,
};
use percuss_report::FieldQuantity;

use self::task::Task;
use crate::{
    answer::{Answer, AtHand, Found, Hear},
    diagnostic,
    failure::Failure,
    output,
    progress::Progress,
    ran::Ran,
    result_table, run_folder, workers,
    written::Written,
};

const LONG_ABOUT: &str = "\
Run a case and print its results: how the shot ended, how deep it went, what is
left of the projectile, where the energy went, how well the books of energy and
momentum balance, and what to know before relying on the numbers. Without
--model the model is `chain`; where that does not apply, it is the model that
`percuss compare` recommends, and the first lines say so. The leading result of
every other quick model that applies stands beside it.

With --quiet one line is printed, of NAME=VALUE pairs with the names of --json:
  outcome=at_rest depth_of_penetration_mm=0.0436 residual_velocity_m_s=-1.2
  ballistic_limit_m_s=null projectile_final_length_mm=12.7 warnings=1 model=chain
(in one line; a number that does not exist is `null`).

With --out DIR a copy of the case (case-as-run.toml, with the materials of the
files that it names), result.json, the time histories (CSV and Parquet) and the
figures (SVG and PNG) are written to DIR, which is made if it does not exist. A
case-as-run.toml needs no other file and gives the same results. A model without
time histories writes the first two only. Files of the same names are replaced,
others are left alone.

With --fields the models `chain`, `fdm` and `axi` also write their fields against
time as a series for ParaView (fields.pvd, which can be opened during the run).
Ctrl-C, or a request of the system to end, leaves a checkpoint in DIR, from which
--resume continues with the same numbers.

The two-dimensional model `axi` also writes the shapes of crater and projectile
(CSV and figure) and its fields at the end: field.vtp for ParaView and a picture
of one of them, field.png. With --animation it writes animation.gif and its
pictures (frames/).

Anything longer than a second shows its progress, if standard error is a
terminal.";

const AFTER_HELP: &str = "\
Examples:
  percuss run my-shot/scenario.toml
  percuss run my-shot/scenario.toml --out results
  percuss run my-shot/scenario.toml --json > result.json
  percuss run my-shot/scenario.toml --quiet
  percuss run my-shot/scenario.toml --out results --fields
  percuss run my-shot/scenario.toml --model axi --out results --resume
  percuss run my-shot/scenario.toml --model axi --out results --animation

Exit codes: 0 ok, 2 bad input or a model that does not apply, 3 numerical
failure, 4 a file could not be read or written, 130 stopped by the user";

/// Run a case
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Run {
    /// Case file; `percuss new` writes one to start from
    #[arg(value_name = "CASE.toml")]
    case: PathBuf,
    /// Model to compute with; `percuss models` describes them, `percuss compare CASE` names those that apply [default: chain where it applies]
    #[arg(long, value_name = "NAME")]
    #[arg(value_parser = PossibleValuesParser::new(MODELS.iter().map(|model| model.name())))]
    model: Option<String>,
    /// Print one JSON object and nothing else on standard output
    #[arg(long)]
    json: bool,
    /// Write result, histories and figures to a folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// No table and no progress: one line of NAME=VALUE pairs
    #[arg(long, short)]
    quiet: bool,
    /// Field that pictures of a two-dimensional model show [default: plastic-strain]
    #[arg(long, value_name = "NAME", requires = "out")]
    #[arg(value_parser = PossibleValuesParser::new(FieldQuantity::ALL.map(FieldQuantity::name)))]
    field: Option<String>,
    /// Write the fields against time as a series for ParaView
    #[arg(long, requires = "out")]
    fields: bool,
    /// Write an animation of one field of a two-dimensional model, and its pictures
    #[arg(long, requires = "out")]
    animation: bool,
    /// Most frames of --fields and --animation, 2 to 1000; a run has between half as many and all of them, unless it is too short [default: 64]
    #[arg(long, value_name = "N", requires = "out", value_parser = value_parser!(u16).range(2..=1000))]
    frames: Option<u16>,
    /// How often a numerical model leaves a checkpoint in DIR [default: 60s]
    #[arg(long, value_name = "TIME", requires = "out", value_parser = checkpoints::interval)]
    checkpoint: Option<Duration>,
    /// Continue from the checkpoint in DIR; without one there, start at the beginning
    #[arg(long, requires = "out")]
    resume: bool,
}

/// Part of the work that is done when the run has come to its end; the rest is writing.
const COMPUTED: f64 = 0.9;

impl Run {
    pub fn run(&self) -> Result<(), Failure> {
        let say = |words: &str| {
            if !self.quiet {
                diagnostic::print(&format!("note: {words}\n"));
            }
        };
        // A run that leaves no checkpoint just ends with the program.
        let stop = match self.leaves_checkpoints() {
            true => workers::stop_on_request(),
            false => Arc::default(),
        };
        let mut task = Task::new(self, &AtHand::default(), &stop, &say)?;
        let mut progress = Progress::new(!self.quiet);
        let ran = task.compute(&mut progress.hear());
        progress.finish();
        let ran = ran?;
        let mut progress = Progress::new(!self.quiet);
        let files = task.write(&ran, &mut |part, words| progress.update(part, words));
        progress.finish();
        self.print(&ran, &files?)
    }

    /// What the command finds out, with histories where it writes them.
    pub fn answer(
        &self,
        at_hand: &AtHand,
        stop: &AtomicBool,
        hear: Hear<'_>,
    ) -> Result<Answer, Failure> {
        let mut task = Task::new(self, at_hand, stop, &|_| ())?;
        let ran = task.compute(&mut |part, words| hear(COMPUTED * part, words))?;
        let files = task.write(&ran, &mut |part, words| {
            // What is left takes seconds.
            let _ = hear(COMPUTED + (1.0 - COMPUTED) * part, words);
        })?;
        Ok(Answer {
            found: Found::Run(Box::new(ran)),
            files,
        })
    }

    /// Whether the model, if there is such a one, leaves checkpoints in the folder.
    fn leaves_checkpoints(&self) -> bool {
        let asked = self.model.as_deref().unwrap_or(DEFAULT_MODEL);
        let chosen = MODELS.iter().find(|model| model.name() == asked);
        self.out.is_some() && chosen.is_some_and(|model| model.has_fields())
    }

    fn print(&self, ran: &Ran, files: &[PathBuf]) -> Result<(), Failure> {
        let results = ran.results();
        let mut written = Written::new(files);
        if !run_folder::has_history(&ran.result) {
            let why = without_history(&ran.result);
            written = written.with_note(&format!("no time history: this model {why}"));
        }
        if self.json {
            return written.print_json(&results, self.quiet);
        }
        if self.quiet {
            let lines: String = results.results.iter().map(one_line).collect();
            return output::print(&lines);
        }
        let others = match self.model {
            Some(_) => None,
            None => {
                let mut progress = Progress::new(true);
                let others = others::rows(&ran.scenario, ran.result.model, &mut progress);
                progress.finish();
                Some(others?)
            }
        };
        let record = &results.results[0];
        let text = result_table::text(&ran.scenario, &ran.result, record, others);
        written.print_under(text)
    }
}

/// Why there is no history of a result.
fn without_history(result: &RunResult) -> &'static str {
    match result.termination {
        Termination::ClosedForm => "is a formula",
        _ => "keeps none",
    }
}

/// A result in one line for scripts.
fn one_line(record: &ResultRecord) -> String {
    let outcome = serde_json::json!(record.outcome);
    format!(
        "outcome={} {} warnings={} model={}\n",
        outcome.as_str().unwrap_or_default(),
        output::main_numbers(record),
        record.warnings.len(),
        record.model,
    )
}
