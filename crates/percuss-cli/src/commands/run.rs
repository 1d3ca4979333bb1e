use std::{ops::ControlFlow, path::PathBuf};

use clap::{Args, builder::PossibleValuesParser};
use percuss::{
    Scenario, case,
    model::{self, Control, MODELS},
    outcome::{RunResult, Termination},
    summary::{CaseResults, ResultRecord},
};

use crate::{
    diagnostic,
    failure::Failure,
    progress::Progress,
    result_table,
    run_folder::{self, RunFolder},
    terminal,
};

const LONG_ABOUT: &str = "\
Run a case and print its results: how the shot ended, how deep it went, what is
left of the projectile, where the energy went, how well the books of energy and
momentum balance, and what to know before relying on the numbers.

With --quiet one line is printed, of NAME=VALUE pairs with the names of --json:
  outcome=at_rest depth_of_penetration_mm=0.0436 residual_velocity_m_s=-1.2
  ballistic_limit_m_s=null projectile_final_length_mm=12.7 warnings=1
(in one line; a number that does not exist is `null`).

With --out DIR a copy of the case (case-as-run.toml; files it names are not
copied), result.json, the time histories (CSV and Parquet) and the figures (SVG
and PNG) are written to DIR, which is made if it does not exist. A model without
time histories writes the first two only. Files of the same names are replaced,
others are left alone.

Anything longer than a second shows its progress, if standard error is a
terminal.";

const AFTER_HELP: &str = "\
Examples:
  percuss run my-shot/scenario.toml
  percuss run my-shot/scenario.toml --out results
  percuss run my-shot/scenario.toml --json > result.json
  percuss run my-shot/scenario.toml --quiet

Exit codes: 0 ok, 2 bad input or a model that does not apply, 3 numerical
failure, 4 a file could not be read or written";

/// Run a case
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Run {
    /// Case file; `percuss new` writes one to start from
    #[arg(value_name = "CASE.toml")]
    case: PathBuf,
    /// Model to compute with; `percuss models` describes them, `percuss compare CASE` names those that apply
    #[arg(long, value_name = "NAME", default_value = "chain")]
    #[arg(value_parser = PossibleValuesParser::new(MODELS.iter().map(|model| model.name())))]
    model: String,
    /// Print one JSON object and nothing else on standard output
    #[arg(long)]
    json: bool,
    /// Write result, histories and figures to a folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// No table and no progress: one line of NAME=VALUE pairs
    #[arg(long, short)]
    quiet: bool,
}

impl Run {
    pub fn run(&self) -> Result<(), Failure> {
        let scenario = case::load(&self.case)?;
        let model = model::model(&self.model)?;
        // Before a run that may take long: a folder that cannot be written should be known at once.
        let folder = match (&self.out, model::applicability(model, &scenario)) {
            (Some(out), Ok(_)) => Some(RunFolder::create(out, &self.case)?),
            _ => None,
        };
        let result = self.compute(model, &scenario)?;
        let results = CaseResults::new(&scenario, std::slice::from_ref(&result));
        let files = match folder {
            Some(folder) => {
                let mut progress = Progress::new(!self.quiet);
                let written = folder.write(&scenario, &result, &results, &mut progress);
                progress.finish();
                written?
            }
            None => Vec::new(),
        };
        let mut wrote: String = files
            .iter()
            .map(|file| format!("  {}\n", file.display()))
            .collect();
        if !run_folder::has_history(&result) {
            wrote += &format!(
                "  no time history: this model {}\n",
                without_history(&result)
            );
        }
        if self.json {
            terminal::print_json(&results)?;
            if !files.is_empty() && !self.quiet {
                diagnostic::print(&format!("wrote\n{wrote}"));
            }
            return Ok(());
        }
        if self.quiet {
            let lines: String = results.results.iter().map(one_line).collect();
            return terminal::print(&lines);
        }
        let mut text = result_table::text(&scenario, &result, &results.results[0]);
        if !files.is_empty() {
            text += &format!("\n{}\n{wrote}", terminal::bold("wrote"));
        }
        terminal::print(&text)
    }

    fn compute(&self, model: &dyn model::Model, scenario: &Scenario) -> Result<RunResult, Failure> {
        let mut progress = Progress::new(!self.quiet);
        let mut report = |now: model::Progress| {
            let words = format!("{:.1} us, depth {:.3} mm", now.time * 1e6, now.depth * 1e3);
            progress.update(now.fraction, &words);
            ControlFlow::Continue(())
        };
        let mut control = Control {
            record: self.out.is_some(),
            progress: Some(&mut report),
        };
        let result = model::run(model, scenario, &mut control);
        progress.finish();
        Ok(result?)
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
    let value = |value: Option<f64>| value.map_or_else(|| "null".to_owned(), |v| v.to_string());
    format!(
        "outcome={} depth_of_penetration_mm={} residual_velocity_m_s={} \
         ballistic_limit_m_s={} projectile_final_length_mm={} warnings={}\n",
        outcome.as_str().unwrap_or_default(),
        value(record.depth_of_penetration_mm),
        value(record.residual_velocity_m_s),
        value(record.ballistic_limit_m_s),
        value(record.projectile_final_length_mm),
        record.warnings.len(),
    )
}
