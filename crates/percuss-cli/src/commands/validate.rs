use std::{ops::ControlFlow, path::PathBuf, sync::Mutex};

use clap::{Args, builder::PossibleValuesParser};
use percuss::{
    case,
    experiments::{Experiment, Kind},
    material::Library,
    model::{self, MODELS, Model},
    validate::{self, Group, Grouping, PredictionRecord, Standing, Validation},
};
use percuss_report::validation::{self, Origin};
use serde::Serialize;

use crate::{
    answer::{Answer, Hear},
    failure::Failure,
    output,
    progress::Progress,
    run_folder::make_folder,
    shot_data, terminal, validation_table,
    written::Written,
};

const LONG_ABOUT: &str = "\
Compute every published shot with every model that applies to it, and say how
far off each is: bias, root mean square, median and worst of the relative
errors, by model, material record, source, target, projectile and regime.
A model that may take minutes, which `axi` is, runs only when it is asked for by
name.

The program brings Taylor tests, ballistic limits of plates and a few single
shots, each with the place where it was read. Suspect and repeated rows are
computed and not counted.

With --data FILE the shots of a CSV file take their place; `--data builtin`
adds the program's own to them. Columns a file needs: id, kind,
projectile_material, diameter_mm, length_mm or mass_g, impact_velocity_m_s,
target_material, measured, unit.

With --out DIR the report is written as one HTML page and as Markdown with its
figures, and the numbers as CSV and Parquet.";

const AFTER_HELP: &str = "\
Examples:
  percuss validate
  percuss validate --model chain --kind taylor
  percuss validate --out validation
  percuss validate --data my-shots.csv --data builtin
  percuss validate --json > validation.json

Exit codes: 0 ok, 2 bad input, 4 a file could not be read or written";

/// Compare models with published shots
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Validate {
    /// Model to validate; all that answer at once when not given
    #[arg(long, value_name = "NAME")]
    #[arg(value_parser = PossibleValuesParser::new(MODELS.iter().map(|model| model.name())))]
    model: Vec<String>,
    /// CSV file of shots, or `builtin` for the program's own
    #[arg(long, value_name = "FILE")]
    data: Vec<PathBuf>,
    /// File of materials that the shots name, beside the library
    #[arg(long, value_name = "FILE.toml")]
    materials: Vec<PathBuf>,
    /// Kind of shot; all of them when not given
    #[arg(long, value_name = "KIND")]
    #[arg(value_parser = PossibleValuesParser::new(Kind::ALL.map(Kind::name)))]
    kind: Vec<String>,
    /// Write the report and its numbers to a folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print one JSON object and nothing else on standard output
    #[arg(long)]
    json: bool,
    /// No table and no progress: one line of NAME=VALUE pairs a model and kind
    #[arg(long, short)]
    quiet: bool,
}

/// What `--json` prints. The names are stable.
#[derive(Serialize)]
struct Record {
    percuss_version: &'static str,
    data: Vec<String>,
    models: Vec<&'static str>,
    shots: usize,
    statistics: Vec<Group>,
    coverage: Vec<CoverageRecord>,
    predictions: Vec<PredictionRecord>,
}

#[derive(Serialize)]
struct CoverageRecord {
    model: &'static str,
    kind: Kind,
    shots: usize,
    counted: usize,
    commonest_reason: Option<String>,
}

/// What the command found out and wrote.
struct Found {
    validation: Validation,
    /// What the shots come from.
    data: Vec<String>,
    files: Vec<PathBuf>,
}

impl Validate {
    pub fn run(&self) -> Result<(), Failure> {
        let mut progress = Progress::new(!self.quiet);
        let found = self.find(&mut progress.hear());
        progress.finish();
        let Found {
            validation,
            data,
            files,
        } = found?;
        let written = Written::new(&files);
        if self.json {
            return written.print_json(&record(&validation, data), self.quiet);
        }
        if self.quiet {
            let lines: String = validate::statistics(&validation, Grouping::All)
                .iter()
                .map(validation_table::one_line)
                .collect();
            return output::print(&lines);
        }
        let text = validation_table::text(&validation, &data, self.model.len() == 1);
        written.print_under(text)
    }

    /// What the command prints with --json.
    pub fn answer(&self, hear: Hear<'_>) -> Result<Answer, Failure> {
        let found = self.find(hear)?;
        Answer::json_of(&record(&found.validation, found.data), found.files)
    }

    fn find(&self, hear: Hear<'_>) -> Result<Found, Failure> {
        let (models, library) = (self.models()?, self.library()?);
        let (shots, data) = self.shots(&library)?;
        if let Some(out) = &self.out {
            make_folder(out)?;
        }
        let validation = self.compute(&models, &shots, &library, &mut *hear)?;
        let mut files = Vec::new();
        if let Some(out) = &self.out {
            let origin = Origin {
                files: data.clone(),
                command: self.command(),
            };
            let _ = hear(1.0, "drawing figures");
            files = validation::write(out, &validation, &origin)?;
        }
        Ok(Found {
            validation,
            data,
            files,
        })
    }

    fn library(&self) -> Result<Library, Failure> {
        let mut library = Library::built_in().clone();
        for path in &self.materials {
            library.add(&case::load_materials(path)?, &path.display().to_string());
        }
        Ok(library)
    }

    fn models(&self) -> Result<Vec<&'static dyn Model>, Failure> {
        if self.model.is_empty() {
            return Ok(model::fast_models());
        }
        let chosen = self.model.iter().map(|name| model::model(name));
        let mut models = chosen.collect::<Result<Vec<_>, _>>()?;
        let mut seen = Vec::new();
        models.retain(|model| {
            let new = !seen.contains(&model.name());
            seen.push(model.name());
            new
        });
        Ok(models)
    }

    /// The shots and what they come from.
    fn shots(&self, library: &Library) -> Result<(Vec<Experiment>, Vec<String>), Failure> {
        let built_in = [PathBuf::from(shot_data::BUILT_IN)];
        let data = if self.data.is_empty() {
            &built_in[..]
        } else {
            &self.data
        };
        shot_data::read(data, &self.kind, library)
    }

    fn compute(
        &self,
        models: &[&'static dyn Model],
        shots: &[Experiment],
        library: &Library,
        hear: Hear<'_>,
    ) -> Result<Validation, Failure> {
        let hear = Mutex::new(hear);
        let words = format!(
            "{}, {}",
            terminal::counted(shots.len(), "shot"),
            terminal::counted(models.len(), "model")
        );
        let report = |fraction: f64| match hear.try_lock() {
            Ok(mut hear) => hear(fraction, &words),
            // Who listens to another thread has no need of this one.
            Err(_) => ControlFlow::Continue(()),
        };
        Ok(validate::run(models, shots, library, &report)?)
    }

    /// The command as a user would type it.
    fn command(&self) -> String {
        let mut words = vec!["percuss validate".to_owned()];
        words.extend(self.model.iter().map(|name| format!("--model {name}")));
        let path = |name: &str, path: &PathBuf| format!("{name} {}", path.display());
        words.extend(self.data.iter().map(|file| path("--data", file)));
        words.extend(self.materials.iter().map(|file| path("--materials", file)));
        words.extend(self.kind.iter().map(|kind| format!("--kind {kind}")));
        words.extend(self.out.iter().map(|out| path("--out", out)));
        words.join(" ")
    }
}

fn record(validation: &Validation, data: Vec<String>) -> Record {
    Record {
        percuss_version: env!("CARGO_PKG_VERSION"),
        data,
        models: validation.models.clone(),
        shots: validation.tests.len(),
        statistics: validation.all_statistics(),
        coverage: validate::coverage(validation)
            .into_iter()
            .map(|coverage| CoverageRecord {
                model: coverage.model,
                kind: coverage.kind,
                shots: coverage.total(),
                counted: coverage.count(Standing::Counted),
                commonest_reason: coverage.reason.map(|(reason, _)| reason),
            })
            .collect(),
        predictions: validation.records(),
    }
}
