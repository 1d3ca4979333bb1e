//! `percuss validate`: models compared with published tests.

use std::{ops::ControlFlow, path::PathBuf, sync::Mutex};

use clap::{Args, builder::PossibleValuesParser};
use percuss::{
    case,
    experiments::{Experiment, Kind},
    material::Library,
    model::{self, Estimate, MODELS, Model},
    validate::{self, Group, Grouping, PredictionRecord, Standing, Validation},
};
use percuss_report::validation::{self, Origin};
use serde::Serialize;

use crate::{
    cost,
    failure::Failure,
    figure_formats::FigureArgs,
    file_list::FileList,
    output,
    progress::Progress,
    response::{ProgressCallback, Response},
    run_folder::make_folder,
    terminal, test_data, validation_table,
};

const LONG_ABOUT: &str = "\
Compare all applicable models with published tests: bias, root mean square,
median and largest of the relative errors, by model, material record, source,
target, projectile and regime. A model that may take minutes, such as `axi`,
runs only when --model names it.

The program contains Taylor tests, ballistic limits of plates and single tests,
each with its source. Suspect and repeated tests are computed and not counted.

With --data FILE the tests of a CSV file are used instead; `--data builtin`
adds those of the program. Required columns: id, kind,
projectile_material, diameter_mm, length_mm or mass_g, impact_velocity_m_s,
target_material, measured, unit, and for targets other than `rigid-wall`
thickness_mm.

With --out DIR the report is written as one HTML page and as Markdown with its
figures as PNG, and the numbers as CSV and Parquet. --figures adds other
formats.";

const AFTER_HELP: &str = "\
Examples:
  percuss validate
  percuss validate --model chain --kind taylor
  percuss validate --out validation
  percuss validate --data tests.csv --out mine --figures svg,pdf
  percuss validate --data tests.csv --data builtin
  percuss validate --json > validation.json

Exit codes: 0 ok, 2 bad input, 4 a file could not be read or written";

/// Compare models with published tests
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Validate {
    /// Model to validate [default: all except those that may take minutes]
    #[arg(long, value_name = "NAME")]
    #[arg(value_parser = PossibleValuesParser::new(MODELS.iter().map(|model| model.name())))]
    model: Vec<String>,
    /// CSV file of tests, or `builtin` for the tests of the program
    #[arg(long, value_name = "FILE")]
    data: Vec<PathBuf>,
    /// File of materials for the tests, in addition to the library
    #[arg(long, value_name = "FILE.toml")]
    materials: Vec<PathBuf>,
    /// Kind of test [default: all kinds]
    #[arg(long, value_name = "KIND")]
    #[arg(value_parser = PossibleValuesParser::new(Kind::ALL.map(Kind::name)))]
    kind: Vec<String>,
    /// Write the report and its numbers to a folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    pub figures: FigureArgs,
    /// Print one JSON object and nothing else on standard output
    #[arg(long)]
    json: bool,
    /// No table and no progress: one line of NAME=VALUE pairs per model and kind
    #[arg(long, short)]
    quiet: bool,
}

/// Output of `--json`. The names are stable.
#[derive(Serialize)]
struct ValidationRecord {
    percuss_version: &'static str,
    data: Vec<String>,
    models: Vec<&'static str>,
    tests: usize,
    statistics: Vec<Group>,
    coverage: Vec<CoverageRecord>,
    predictions: Vec<PredictionRecord>,
}

#[derive(Serialize)]
struct CoverageRecord {
    model: &'static str,
    kind: Kind,
    tests: usize,
    counted: usize,
    commonest_reason: Option<String>,
}

/// Result of the command and the files that it wrote.
struct ValidationOutput {
    validation: Validation,
    /// Sources of the tests.
    data: Vec<String>,
    files: Vec<PathBuf>,
}

impl Validate {
    pub fn run(&self) -> Result<(), Failure> {
        let mut progress = Progress::new(!self.quiet);
        let found = self.find(&mut progress.callback(), &|cost| {
            cost::tell(cost, self.quiet)
        });
        progress.finish();
        let ValidationOutput {
            validation,
            data,
            files,
        } = found?;
        let written = FileList::new(&files);
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
        let text = validation_table::text(&validation, &data, &self.model);
        written.print_under(text)
    }

    /// Output of --json.
    pub fn execute(&self, on_progress: ProgressCallback<'_>) -> Result<Response, Failure> {
        let found = self.find(on_progress, &|_| ())?;
        Response::json_of(&record(&found.validation, found.data), found.files)
    }

    fn find(
        &self,
        on_progress: ProgressCallback<'_>,
        tell: &dyn Fn(Estimate),
    ) -> Result<ValidationOutput, Failure> {
        let (models, library) = (self.models()?, self.library()?);
        let (tests, data) = self.tests(&library)?;
        tell(validate::estimate(&models, &tests, &library));
        if let Some(out) = &self.out {
            make_folder(out)?;
        }
        let validation = self.compute(&models, &tests, &library, &mut *on_progress)?;
        let mut files = Vec::new();
        if let Some(out) = &self.out {
            let origin = Origin {
                files: data.clone(),
                command: self.command(),
            };
            let _ = on_progress(1.0, "drawing figures");
            files = validation::write(out, &validation, &origin, self.figures.formats())?;
        }
        Ok(ValidationOutput {
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

    /// Tests with their sources.
    fn tests(&self, library: &Library) -> Result<(Vec<Experiment>, Vec<String>), Failure> {
        let built_in = [PathBuf::from(test_data::BUILT_IN)];
        let data = if self.data.is_empty() {
            &built_in[..]
        } else {
            &self.data
        };
        test_data::read(data, &self.kind, library)
    }

    fn compute(
        &self,
        models: &[&'static dyn Model],
        tests: &[Experiment],
        library: &Library,
        on_progress: ProgressCallback<'_>,
    ) -> Result<Validation, Failure> {
        let on_progress = Mutex::new(on_progress);
        let words = format!(
            "{}, {}",
            terminal::counted(tests.len(), "test"),
            terminal::counted(models.len(), "model")
        );
        let report = |fraction: f64| match on_progress.try_lock() {
            Ok(mut on_progress) => on_progress(fraction, &words),
            // Another thread is reporting: this report is left out.
            Err(_) => ControlFlow::Continue(()),
        };
        Ok(validate::run(models, tests, library, &report)?)
    }

    /// Command line that repeats this command.
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

fn record(validation: &Validation, data: Vec<String>) -> ValidationRecord {
    ValidationRecord {
        percuss_version: env!("CARGO_PKG_VERSION"),
        data,
        models: validation.models.clone(),
        tests: validation.tests.len(),
        statistics: validation.all_statistics(),
        coverage: validate::coverage(validation)
            .into_iter()
            .map(|coverage| CoverageRecord {
                model: coverage.model,
                kind: coverage.kind,
                tests: coverage.total(),
                counted: coverage.count(Standing::Counted),
                commonest_reason: coverage.reason.map(|(reason, _)| reason),
            })
            .collect(),
        predictions: validation.records(),
    }
}
