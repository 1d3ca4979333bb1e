mod reliance;
mod table;
mod values;

use std::path::{Path, PathBuf};

use clap::{Args, builder::PossibleValuesParser};
use percuss::{
    Scenario, case,
    limit::{self, LimitOutcome, Limits, Observer, Range, Search, Tolerance},
    model::MODELS,
    v50::{self, Test, V50},
};
use serde::Serialize;

use crate::{
    answer::{Answer, AtHand, Hear},
    by_models,
    failure::Failure,
    output,
    progress::Progress,
    run_folder::RunFolder,
    written::Written,
};

const LONG_ABOUT: &str = "\
Find the ballistic limit of a case: the impact speed above which the target is
perforated. Every model that says whether it is gets the same search: 17 speeds
across a range, then halves between the fastest shot that is stopped and the
slowest that perforates, until they are close enough. Above the limit the speeds
behind the target are computed, and the curve of Lambert and Jonas,
v_r = a (v^p - v_bl^p)^(1/p), is fitted to them. A model that does not apply
says why; one that stops or lets through everything in the range says so.
A model that may take minutes, which `axi` is, runs only when it is asked for by
name.

The rear face of a plate is free unless the case gives `target.back_face`;
behind a fixed one perforation is impossible. The recommended model is marked
with ★, and the errors of the models on published limits of the same kind stand
below. `recht_ipson` and `lambert_jonas` start from a limit: their residual
velocities are shown, and their limit counts as none.

With --shots FILE.csv the speed V50 at which half of all shots go through is
estimated from shots that scatter: by maximum likelihood (probit and logit) with
the 95 % interval of the likelihood ratio, and as the mean of equal numbers of
the fastest stopped shots and the slowest that went through (extremes). The file
has a row a shot and the columns impact_velocity_m_s and perforated (yes or no); the
case may then be left out.

With --out DIR a copy of the case (case-as-run.toml), limit.json, the tables
limit.csv (a row a model) and curve.csv (a row a speed), and the figures (limit
and v50, as SVG and PNG) are written to DIR, which is made if it does not exist.";

const AFTER_HELP: &str = "\
Examples:
  percuss limit my-shot/scenario.toml
  percuss limit my-shot/scenario.toml --velocity 100..400 --tolerance \"0.2 %\"
  percuss limit my-shot/scenario.toml --model plugging --out results
  percuss limit --shots my-shots.csv

Exit codes: 0 ok, 2 bad input or no model applies, 4 a file could not be read or
written";

/// Find the ballistic limit of a case, or V50 from shots
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Limit {
    /// Case file; `percuss new` writes one to start from
    #[arg(value_name = "CASE.toml", required_unless_present = "shots")]
    case: Option<PathBuf>,
    /// Search with this model only, or a slow one such as `axi`; may be given several times
    #[arg(long, value_name = "NAME", requires = "case")]
    #[arg(value_parser = PossibleValuesParser::new(MODELS.iter().map(|model| model.name())))]
    model: Vec<String>,
    /// Range of impact speeds to search, in m/s unless a unit follows
    // A negative speed is answered with the range that speeds have.
    #[arg(long, value_name = "FROM..TO", default_value = "0..2000", value_parser = values::range)]
    #[arg(allow_hyphen_values = true)]
    velocity: Range,
    /// How far apart the stopped and the perforating shot may be: a speed, or a part in %
    #[arg(long, value_name = "SPEED", default_value = "0.1 m/s", value_parser = values::tolerance)]
    #[arg(allow_hyphen_values = true)]
    tolerance: Tolerance,
    /// Residual velocities to compute above the limit, up to 2.5 times the limit; 0 for none
    #[arg(long, value_name = "COUNT", default_value = "12")]
    #[arg(value_parser = values::points, allow_hyphen_values = true)]
    points: u16,
    /// CSV file of shots that were stopped or went through
    #[arg(long, value_name = "FILE.csv")]
    shots: Option<PathBuf>,
    /// Widest span of the shots that V50 may be the mean of; 125 ft/s when not given
    #[arg(long, value_name = "SPEED", requires = "shots", value_parser = values::span)]
    #[arg(allow_hyphen_values = true)]
    span: Option<f64>,
    /// Print one JSON object and nothing else on standard output
    #[arg(long)]
    json: bool,
    /// Write numbers and figures to a folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// No table and no progress: lines of NAME=VALUE pairs
    #[arg(long, short)]
    quiet: bool,
}

/// What `--json` prints. The names are stable.
#[derive(Serialize)]
struct Record<'a> {
    #[serde(flatten)]
    limits: Option<&'a Limits>,
    v50: Option<&'a V50>,
    shots: Option<&'a [Test]>,
}

/// What the command found out.
struct Found {
    case: Option<(Scenario, Limits)>,
    shots: Option<(Vec<Test>, V50)>,
    files: Vec<PathBuf>,
}

impl Found {
    fn record(&self) -> Record<'_> {
        Record {
            limits: self.case.as_ref().map(|(_, limits)| limits),
            v50: self.shots.as_ref().map(|(_, v50)| v50),
            shots: self.shots.as_ref().map(|(shots, _)| &**shots),
        }
    }
}

impl Limit {
    pub fn run(&self) -> Result<(), Failure> {
        let mut progress = Progress::new(!self.quiet);
        let found = self.find(&AtHand::default(), &mut progress.hear());
        progress.finish();
        let found = found?;
        self.print(&found)?;
        match &found.case {
            Some((_, limits)) if found.shots.is_none() && no_model_applies(limits) => {
                Err(Failure::NoResult(table::reasons(limits)))
            }
            _ => Ok(()),
        }
    }

    /// What the command prints with --json; a case to which no model applies is no failure here.
    pub fn answer(&self, at_hand: &AtHand, hear: Hear<'_>) -> Result<Answer, Failure> {
        let found = self.find(at_hand, hear)?;
        Answer::json_of(&found.record(), found.files.clone())
    }

    fn find(&self, at_hand: &AtHand, hear: Hear<'_>) -> Result<Found, Failure> {
        let document = self.case.as_ref().map(|path| at_hand.read(path));
        let document = document.transpose()?;
        let scenario = document.as_ref().map(case::scenario).transpose()?;
        let shots = self.shots.as_ref().map(v50::read).transpose()?;
        let folder = RunFolder::wanted(self.out.as_deref(), document.as_ref())?;
        let shots = shots.map(|shots| {
            let v50 = v50::estimate(&shots, self.span.unwrap_or(v50::SPAN));
            (shots, v50)
        });
        let case = match scenario {
            Some(scenario) => {
                let limits = self.search(&scenario, hear)?;
                Some((scenario, limits))
            }
            None => None,
        };
        let mut found = Found {
            case,
            shots,
            files: Vec::new(),
        };
        if let Some(folder) = folder {
            found.files = self.write(folder, &found)?;
        }
        Ok(found)
    }

    fn search(&self, scenario: &Scenario, hear: Hear<'_>) -> Result<Limits, Failure> {
        let models = by_models::named(&self.model);
        let search = Search {
            range: self.velocity,
            tolerance: self.tolerance,
            points: usize::from(self.points),
        };
        let mut report = |now: limit::Progress| {
            let words = format!("{} runs", now.finished);
            hear(now.fraction, &words)
        };
        let mut watch = Observer {
            progress: Some(&mut report),
        };
        Ok(limit::limits(&models, scenario, &search, &mut watch)?)
    }

    fn write(&self, mut folder: RunFolder, found: &Found) -> Result<Vec<PathBuf>, Failure> {
        folder.put("limit.json", output::json(&found.record())?.as_bytes())?;
        if let Some((scenario, limits)) = &found.case {
            folder.add(percuss_report::write_limits(folder.path(), limits)?);
            if let Some(figure) = percuss_report::limit_figure(scenario, limits) {
                folder.add(figure.write(folder.path())?);
            }
        }
        if let Some((shots, v50)) = &found.shots {
            let name = self.shots.as_deref().map_or_else(String::new, stem);
            folder.add(percuss_report::v50_figure(&name, shots, v50).write(folder.path())?);
        }
        Ok(folder.written())
    }

    fn print(&self, found: &Found) -> Result<(), Failure> {
        let written = Written::new(&found.files);
        if self.json {
            return written.print_json(&found.record(), self.quiet);
        }
        let mut text = String::new();
        if self.quiet {
            text += &found
                .case
                .as_ref()
                .map_or_else(String::new, |(_, limits)| table::lines(limits));
            text += &found
                .shots
                .as_ref()
                .map_or_else(String::new, |(_, v50)| table::v50_lines(v50));
            return output::print(&text);
        }
        if let Some((scenario, limits)) = &found.case {
            // Without a result there are reasons only, and they are the error.
            if found.shots.is_some() || !no_model_applies(limits) {
                text += &table::head(scenario, limits, self.tolerance);
                text += &table::text(limits);
            }
        }
        if let (Some((_, v50)), Some(path)) = (&found.shots, &self.shots) {
            text += &table::v50_text(&path.display().to_string(), v50);
        }
        written.print_under(text)
    }
}

fn stem(path: &Path) -> String {
    path.file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned()
}

/// Whether there is nothing to say but reasons: a target that stops or lets through everything is an answer.
fn no_model_applies(limits: &Limits) -> bool {
    let silent = [LimitOutcome::NotApplicable, LimitOutcome::Failed];
    limits
        .results
        .iter()
        .all(|limit| silent.contains(&limit.outcome))
}
