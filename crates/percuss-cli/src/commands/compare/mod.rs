mod absent;
mod head;
mod kinds;
mod shown;
mod single;
mod sweep;
#[cfg(test)]
mod tests;
mod warnings;

use std::path::PathBuf;

use clap::{Args, builder::PossibleValuesParser};
use percuss::{
    Scenario, case,
    compare::{self, Comparison, Observer},
    model::{self, CostClass, MODELS},
};

use crate::{
    answer::{Answer, AtHand, Hear},
    by_models,
    failure::Failure,
    output,
    progress::Progress,
    run_folder::RunFolder,
    speeds::Speeds,
    terminal,
    written::Written,
};

const LONG_ABOUT: &str = "\
Run every model on a case and set their results side by side: which regime the
shot is in, which model to rely on and why, what each of them says, how far that
is from the case's experiments, and why a model says nothing where it does not
apply. One model that fails does not stop the others. A model that may take
minutes, which `axi` is, runs only when it is asked for by name.

With --velocity the case is run at other speeds than its own:
  --velocity 200..1500:27         27 speeds from 200 to 1500, ends included
  --velocity \"0.2..1.5 km/s:27\"   the same, in another unit
  --velocity 200,300,400          a list
  --velocity 230                  one speed
  --velocity experiments          those of the case's [[experiments]]

With --quiet one line of NAME=VALUE pairs is printed for each speed and model.

With --out DIR a copy of the case (case-as-run.toml), compare.json, the numbers
(compare.csv and compare.parquet) and the figure (compare.svg and compare.png)
are written to DIR, which is made if it does not exist.";

const AFTER_HELP: &str = "\
Examples:
  percuss compare my-shot/scenario.toml
  percuss compare my-shot/scenario.toml --velocity 200..1500:27 --out results
  percuss compare my-shot/scenario.toml --model chain --json

Exit codes: 0 ok, 2 bad input or no model gives a result, 4 a file could not be
read or written";

/// Run every model on a case and compare them
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Compare {
    /// Case file; `percuss new` writes one to start from
    #[arg(value_name = "CASE.toml")]
    case: PathBuf,
    /// Impact speeds: FROM..TO:COUNT, a list, one, or `experiments`
    // A negative speed is answered with the range that speeds have.
    #[arg(long, value_name = "SPEEDS", allow_hyphen_values = true)]
    velocity: Option<Speeds>,
    /// Compare this model only, or a slow one such as `axi`; may be given several times
    #[arg(long, value_name = "NAME")]
    #[arg(value_parser = PossibleValuesParser::new(MODELS.iter().map(|model| model.name())))]
    model: Vec<String>,
    /// Print one JSON object and nothing else on standard output
    #[arg(long)]
    json: bool,
    /// Write numbers and figure to a folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// No table and no progress: lines of NAME=VALUE pairs
    #[arg(long, short)]
    quiet: bool,
}

/// What the command found out and wrote.
struct Found {
    scenario: Scenario,
    comparison: Comparison,
    files: Vec<PathBuf>,
}

impl Compare {
    pub fn run(&self) -> Result<(), Failure> {
        let mut progress = Progress::new(!self.quiet);
        let found = self.find(&AtHand::default(), &mut progress.hear());
        progress.finish();
        let found = found?;
        self.print(&found)?;
        match found.comparison.has_results() {
            true => Ok(()),
            false => Err(Failure::NoResult(absent::reasons(&found.comparison))),
        }
    }

    /// What the command prints with --json; a case without any result is no failure here.
    pub fn answer(&self, at_hand: &AtHand, hear: Hear<'_>) -> Result<Answer, Failure> {
        let found = self.find(at_hand, hear)?;
        Answer::json_of(&found.comparison, found.files)
    }

    fn find(&self, at_hand: &AtHand, hear: Hear<'_>) -> Result<Found, Failure> {
        let document = at_hand.read(&self.case)?;
        let scenario = case::scenario(&document)?;
        let speeds = self.speeds(&scenario)?;
        let folder = RunFolder::wanted(self.out.as_deref(), Some(&document))?;
        let comparison = self.compute(&scenario, &speeds, hear)?;
        let files = match folder {
            Some(folder) => folder.write_comparison(&scenario, &comparison)?,
            None => Vec::new(),
        };
        Ok(Found {
            scenario,
            comparison,
            files,
        })
    }

    fn compute(
        &self,
        scenario: &Scenario,
        speeds: &[f64],
        hear: Hear<'_>,
    ) -> Result<Comparison, Failure> {
        let models = by_models::named(&self.model);
        let mut report = |now: compare::Progress| {
            let words = format!("{} of {} runs", now.finished, now.total);
            hear(now.fraction, &words)
        };
        let mut watch = Observer {
            progress: Some(&mut report),
        };
        Ok(compare::compare(&models, scenario, speeds, &mut watch)?)
    }

    fn speeds(&self, scenario: &Scenario) -> Result<Vec<f64>, Failure> {
        match &self.velocity {
            None => Ok(vec![scenario.impact_velocity]),
            Some(speeds) => speeds.of(scenario),
        }
    }

    /// Names the models that would apply and are too slow to run unasked.
    fn left_out(&self, scenario: &Scenario) -> String {
        let slow = MODELS
            .iter()
            .filter(|model| model.cost() == CostClass::Minutes);
        let applying = slow.filter(|model| model::applicability(**model, scenario).is_ok());
        let names: Vec<&str> = applying.map(|model| model.name()).collect();
        if !self.model.is_empty() || names.is_empty() {
            return String::new();
        }
        let line = format!(
            "not run, since it may take minutes: {}; `--model NAME` runs it.",
            names.join(", ")
        );
        format!("{}\n", terminal::wrap(&line, terminal::width(), 0))
    }

    fn print(&self, found: &Found) -> Result<(), Failure> {
        let Found {
            scenario,
            comparison,
            files,
        } = found;
        let written = Written::new(files);
        if self.json {
            return written.print_json(comparison, self.quiet);
        }
        if self.quiet {
            return output::print(&single::lines(comparison));
        }
        // Without a result there are reasons only, and they are the error.
        let mut text = String::new();
        if comparison.has_results() {
            text += &head::text(scenario, comparison);
            text += &match comparison.regime.len() {
                1 => single::text(comparison),
                _ => sweep::text(comparison),
            };
            text += &shown::elsewhere(comparison);
            text += &warnings::text(comparison);
            text += &absent::text(comparison);
            text += &self.left_out(scenario);
            text += &format!(
                "{}\n",
                terminal::wrap(
                    "`percuss run CASE.toml --model NAME` says all about one of them, `percuss models NAME` what it is made for.",
                    terminal::width(),
                    0
                )
            );
        }
        written.print_under(text)
    }
}
