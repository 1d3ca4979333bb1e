mod checkpoints;
mod others;

use std::{ops::ControlFlow, path::PathBuf, time::Duration};

use clap::{Args, builder::PossibleValuesParser};
use percuss::{
    Scenario, case,
    checkpoint::Header,
    frames::Frame,
    model::{self, Control, MODELS},
    outcome::{RunResult, Termination},
    summary::{CaseResults, ResultRecord},
};

use percuss_report::{FieldQuantity, FieldSeries};

use self::checkpoints::Keeper;
use crate::{
    diagnostic,
    failure::Failure,
    progress::Progress,
    result_table,
    run_folder::{self, RunFolder},
    terminal,
    written::Written,
};

const LONG_ABOUT: &str = "\
Run a case and print its results: how the shot ended, how deep it went, what is
left of the projectile, where the energy went, how well the books of energy and
momentum balance, and what to know before relying on the numbers. Without --model the model is `chain`,
and the leading result of every other quick model that applies stands beside it.

With --quiet one line is printed, of NAME=VALUE pairs with the names of --json:
  outcome=at_rest depth_of_penetration_mm=0.0436 residual_velocity_m_s=-1.2
  ballistic_limit_m_s=null projectile_final_length_mm=12.7 warnings=1
(in one line; a number that does not exist is `null`).

With --out DIR a copy of the case (case-as-run.toml; files it names are not
copied), result.json, the time histories (CSV and Parquet) and the figures (SVG
and PNG) are written to DIR, which is made if it does not exist. A model without
time histories writes the first two only. Files of the same names are replaced,
others are left alone.

A model of two dimensions, which `axi` is, also writes its fields for ParaView
(fields.pvd, at any time of the run), pictures of one of them (frames/,
field.png), an animation (animation.gif), and the shapes of crater and
projectile (CSV and figure). Ctrl-C, or a request of the system to end, leaves a
checkpoint there, from which --resume goes on with the very same numbers.

Anything longer than a second shows its progress, if standard error is a
terminal.";

const AFTER_HELP: &str = "\
Examples:
  percuss run my-shot/scenario.toml
  percuss run my-shot/scenario.toml --out results
  percuss run my-shot/scenario.toml --json > result.json
  percuss run my-shot/scenario.toml --quiet
  percuss run my-shot/scenario.toml --model axi --out results
  percuss run my-shot/scenario.toml --model axi --out results --resume

Exit codes: 0 ok, 2 bad input or a model that does not apply, 3 numerical
failure, 4 a file could not be read or written, 130 stopped by the user";

/// Run a case
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Run {
    /// Case file; `percuss new` writes one to start from
    #[arg(value_name = "CASE.toml")]
    case: PathBuf,
    /// Model to compute with; `percuss models` describes them, `percuss compare CASE` names those that apply [default: chain]
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
    /// Field that pictures show, from a model of two dimensions [default: plastic-strain]
    #[arg(long, value_name = "NAME", requires = "out")]
    #[arg(value_parser = PossibleValuesParser::new(FieldQuantity::ALL.map(FieldQuantity::name)))]
    field: Option<String>,
    /// How often a model of two dimensions leaves a checkpoint in DIR [default: 60s]
    #[arg(long, value_name = "TIME", requires = "out", value_parser = checkpoints::interval)]
    checkpoint: Option<Duration>,
    /// Go on from the checkpoint in DIR; without one there, start at the beginning
    #[arg(long, requires = "out")]
    resume: bool,
}

/// Model of a run that names none.
const DEFAULT_MODEL: &str = "chain";
/// Time between two checkpoints, unless another one is asked for.
const CHECKPOINT_INTERVAL: Duration = Duration::from_secs(60);

/// What a run in two dimensions leaves in its folder besides its result.
struct Fields {
    series: FieldSeries,
    keeper: Keeper,
    /// Checkpoint to go on from.
    resume: Option<Vec<u8>>,
}

impl Run {
    pub fn run(&self) -> Result<(), Failure> {
        let scenario = case::load(&self.case)?;
        let model = model::model(self.model.as_deref().unwrap_or(DEFAULT_MODEL))?;
        self.check_use(model)?;
        let start = self.start(model, &scenario)?;
        // Before a run that may take long: a folder that cannot be written should be known at once.
        let folder = match (&self.out, model::applicability(model, &scenario)) {
            (Some(out), Ok(_)) => Some(RunFolder::create(out, &self.case)?),
            _ => None,
        };
        let mut fields = match (&self.out, &folder) {
            (Some(out), Some(_)) if model.has_fields() => Some(Fields {
                series: match &start {
                    Some((header, _)) => FieldSeries::resume(out, header.time)?,
                    None => FieldSeries::create(out)?,
                },
                keeper: Keeper::new(out, self.checkpoint.unwrap_or(CHECKPOINT_INTERVAL)),
                resume: start.map(|(_, bytes)| bytes),
            }),
            _ => None,
        };
        let result = self.compute(model, &scenario, fields.as_mut())?;
        let results = CaseResults::new(&scenario, std::slice::from_ref(&result));
        let files = match folder {
            Some(folder) => {
                let mut progress = Progress::new(!self.quiet);
                let written = folder.write(&scenario, &result, &results, &mut progress);
                let written = written.and_then(|mut files| {
                    if let (Some(out), Some(fields)) = (&self.out, &fields) {
                        files.push(fields.series.collection());
                        files.extend(self.draw(out, &scenario, fields, &mut progress)?);
                        checkpoints::remove(out);
                    }
                    Ok(files)
                });
                progress.finish();
                written?
            }
            None => Vec::new(),
        };
        let mut written = Written::new(&files);
        if !run_folder::has_history(&result) {
            let why = without_history(&result);
            written = written.with_note(&format!("no time history: this model {why}"));
        }
        if self.json {
            return written.print_json(&results, self.quiet);
        }
        if self.quiet {
            let lines: String = results.results.iter().map(one_line).collect();
            return terminal::print(&lines);
        }
        let others = match self.model {
            Some(_) => None,
            None => {
                let mut progress = Progress::new(true);
                let others = others::rows(&scenario, model.name(), &mut progress);
                progress.finish();
                Some(others?)
            }
        };
        let record = &results.results[0];
        written.print_under(result_table::text(&scenario, &result, record, others))
    }

    /// Refuses options that would have no effect.
    fn check_use(&self, model: &dyn model::Model) -> Result<(), Failure> {
        let given = [
            ("--field", self.field.is_some()),
            ("--checkpoint", self.checkpoint.is_some()),
            ("--resume", self.resume),
        ];
        match given.iter().find(|(_, given)| *given) {
            Some((option, _)) if !model.has_fields() => Err(Failure::Usage {
                message: format!(
                    "`{option}` has no effect with model `{}`, which has no fields",
                    model.name()
                ),
                help: format!("remove `{option}` or give `--model axi`"),
            }),
            _ => Ok(()),
        }
    }

    /// The checkpoint to go on from, if there is one and it is wanted.
    fn start(
        &self,
        model: &dyn model::Model,
        scenario: &Scenario,
    ) -> Result<Option<(Header, Vec<u8>)>, Failure> {
        let Some(out) = self.out.as_ref().filter(|_| model.has_fields()) else {
            return Ok(None);
        };
        let loaded = checkpoints::load(out)?;
        let say = |words: String| {
            if !self.quiet {
                diagnostic::print(&format!("note: {words}\n"));
            }
        };
        let Some(bytes) = loaded else {
            if self.resume {
                say(format!(
                    "`{}` holds no checkpoint; the run starts at the beginning",
                    out.display()
                ));
            }
            return Ok(None);
        };
        let header = Header::read(&bytes, model.name(), scenario);
        if !self.resume {
            if let Ok(header) = header {
                say(format!(
                    "`{}` holds a checkpoint of this case at {:.1} us; the run starts anew, `--resume` would go on",
                    out.display(),
                    header.time * 1e6
                ));
            }
            return Ok(None);
        }
        let header = header?;
        say(format!("going on from {:.1} us", header.time * 1e6));
        Ok(Some((header, bytes)))
    }

    fn draw(
        &self,
        out: &std::path::Path,
        scenario: &Scenario,
        fields: &Fields,
        progress: &mut Progress,
    ) -> Result<Vec<PathBuf>, Failure> {
        let field = self.field.as_deref().and_then(FieldQuantity::named);
        let mut report = |part: f64| progress.update(part, "drawing the field");
        Ok(percuss_report::draw_fields(
            out,
            scenario,
            &fields.series,
            field.unwrap_or_default(),
            &mut report,
        )?)
    }

    fn compute(
        &self,
        model: &dyn model::Model,
        scenario: &Scenario,
        fields: Option<&mut Fields>,
    ) -> Result<RunResult, Failure> {
        let mut progress = Progress::new(!self.quiet);
        let mut report = |now: model::Progress| {
            let words = format!("{:.1} us, depth {:.3} mm", now.time * 1e6, now.depth * 1e3);
            progress.update(now.fraction, &words);
            ControlFlow::Continue(())
        };
        let mut control = Control {
            record: self.out.is_some(),
            progress: Some(&mut report),
            ..Control::default()
        };
        let Some(fields) = fields else {
            let result = model::run(model, scenario, &mut control);
            progress.finish();
            return Ok(result?);
        };
        let mut failure = None;
        let mut add = |frame: &Frame<'_>| match fields.series.add(frame) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                failure = Some(Failure::from(error));
                ControlFlow::Break(())
            }
        };
        control.frames = Some(&mut add);
        control.checkpoints = Some(&mut fields.keeper);
        control.resume = fields.resume.as_deref();
        let result = model::run(model, scenario, &mut control);
        progress.finish();
        match (failure.or(fields.keeper.failure.take()), result) {
            (Some(failure), _) => Err(failure),
            (None, Err(percuss::Error::Cancelled { time_us, .. }))
                if fields.keeper.interrupted() =>
            {
                Err(Failure::Stopped { time_us })
            }
            (None, result) => Ok(result?),
        }
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
