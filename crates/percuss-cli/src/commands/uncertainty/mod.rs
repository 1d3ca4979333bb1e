//! `percuss uncertainty`: propagation of uncertain input parameters.

mod table;

use std::{
    collections::HashSet,
    path::PathBuf,
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
};

use clap::{Args, builder::PossibleValuesParser};
use percuss::{
    Error,
    case::Document,
    model::{self, DEFAULT_MODEL, MODELS, Model},
    summary::ResultNumber,
    sweep::BatchKernel,
    uncertainty::{
        self, FEWEST_POINTS, MAX_SAMPLES, MIN_SAMPLES, MOST_POINTS, Observer, Settings, Study,
        Uncertainty as Analysis,
    },
};

use crate::{
    cost,
    failure::Failure,
    figure_formats::FigureArgs,
    file_list::FileList,
    output,
    progress::Progress,
    response::{ProgressCallback, Response, ResponseData, VirtualFiles},
    run_folder::RunFolder,
    speeds::{Speeds, SpeedsError},
    whole_numbers::from_to,
    workers::{self, MOST_THREADS, unless_stopped},
};

const LONG_ABOUT: &str = "\
Propagate the uncertainty of input parameters to the results of a case. The case
lists the parameters with their distributions in its table `uncertainty`:

  [[uncertainty.parameter]]
  key = \"projectile.impact_velocity\"
  normal = { mean = \"230 m/s\", standard_deviation = \"3 m/s\" }

The samples are scrambled Sobol' points. The output has the mean, the standard
deviation and percentiles of each result with 95 % intervals, the probability of
perforation, the effect of each parameter from low to high (tornado), and the
first-order and total-effect Sobol' indices: the fraction of the variance due to
a parameter alone, and including its interactions. With N samples and d
parameters the indices take N (d + 1) / 2 additional runs, at least 16 (d + 1).
Correlated parameters have no such indices.

With --velocity the analysis is repeated at each of several impact velocities,
with at most 256 runs each: percentiles and probability of perforation versus
velocity.

With --axisymmetric N the model `axi` runs on N of the samples, spread over the
percentiles of the main result. A straight line from the result of the model to
that of `axi` corrects mean, standard deviation and percentiles over all
samples (control variate), with standard errors.

Runs without a result are counted and left out of the statistics. The spread is
due to the inputs only; the model error adds to it.

With --out DIR a copy of the case (case-as-run.toml), uncertainty.json, the
tables samples.csv, statistics.csv, sensitivity.csv and bands.csv, and the
figures (histograms, tornado charts, indices, bands, probability of perforation,
as SVG and PNG) are written to DIR, which is made if it does not exist.";

const AFTER_HELP: &str = "\
Examples:
  percuss uncertainty cases/paper-table1-uncertainty/scenario.toml
  percuss uncertainty my-case/scenario.toml --samples 4096 --out spread
  percuss uncertainty my-case/scenario.toml --velocity 150..400 --no-indices
  percuss uncertainty my-case/scenario.toml --axisymmetric 8
  percuss uncertainty my-case/scenario.toml --quantity peak_force_kn --json

Exit codes: 0 ok, 2 bad input or no run has a result, 4 a file could not be
read or written, 130 stopped by the user";

/// Propagate uncertain input parameters to the results of a case
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Uncertainty {
    /// Case file with a table `uncertainty`
    #[arg(value_name = "CASE.toml")]
    case: PathBuf,
    /// Model to compute with
    #[arg(long, value_name = "NAME", default_value = DEFAULT_MODEL)]
    #[arg(value_parser = PossibleValuesParser::new(MODELS.iter().map(|model| model.name())))]
    model: String,
    /// Number of samples; a power of two is best
    #[arg(long, value_name = "N", default_value = "1024")]
    #[arg(value_parser = from_to::<u64>(MIN_SAMPLES, MAX_SAMPLES, "a number of samples"))]
    samples: u64,
    /// Seed of the random numbers
    #[arg(
        long,
        value_name = "S",
        default_value = "0",
        allow_hyphen_values = true
    )]
    #[arg(value_parser = from_to::<u64>(0, u64::MAX, "a seed"))]
    seed: u64,
    /// Result to analyse, by its name in JSON; may be given several times. Each model has its own: `percuss models
    /// NAME` lists them
    #[arg(long, value_name = "NAME")]
    #[arg(value_parser = PossibleValuesParser::new(uncertainty::quantities().map(|quantity| quantity.name)))]
    quantity: Vec<String>,
    /// Impact velocities for bands: FROM..TO (11 values), FROM..TO:COUNT, a list, or `experiments`
    // A negative velocity gets the error that names the allowed range.
    #[arg(long, value_name = "SPEEDS", allow_hyphen_values = true, value_parser = speeds)]
    velocity: Option<Speeds>,
    /// Leave out the Sobol' indices, which take most of the runs
    #[arg(long)]
    no_indices: bool,
    /// Correct mean and spread by the axisymmetric model on this number of the samples, 4 to 256
    #[arg(long, value_name = "N")]
    #[arg(value_parser = from_to::<u64>(FEWEST_POINTS as u64, MOST_POINTS as u64, "a number of axisymmetric runs"))]
    axisymmetric: Option<u64>,
    /// Number of threads [default: number of cores]
    #[arg(long, value_name = "N", value_parser = from_to::<u16>(1, MOST_THREADS, "a number of threads"))]
    threads: Option<u16>,
    /// Print one JSON object and nothing else on standard output
    #[arg(long)]
    json: bool,
    /// Write numbers and figures to a folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    pub figures: FigureArgs,
    /// No tables and no progress: one line of NAME=VALUE pairs per quantity
    #[arg(long, short)]
    quiet: bool,
}

/// Inputs of an analysis.
struct Task {
    document: Document,
    study: Study,
    model: &'static dyn Model,
    settings: Settings,
}

/// Number of velocities of a range without a count.
const SPEEDS: u32 = 11;

fn speeds(text: &str) -> Result<Speeds, SpeedsError> {
    match text.contains("..") && !text.contains(':') {
        true => format!("{text}:{SPEEDS}").parse(),
        false => text.parse(),
    }
}

impl Uncertainty {
    pub fn run(&self) -> Result<(), Failure> {
        let task = self.task(&VirtualFiles::default())?;
        let of_run = cost::of_run(task.model, &task.study.scenario);
        let runs = uncertainty::runs(&task.study, &task.settings);
        let whole = cost::of_runs(of_run, runs as f64);
        cost::tell(whole, self.quiet);
        let mut progress = Progress::new(!self.quiet);
        let found = self.find(&task, &workers::stop_on_request(), &mut progress.callback());
        progress.finish();
        let (found, files) = match found {
            Err(Failure::Library(Error::Cancelled { .. })) => {
                return Err(Failure::Interrupted("the analysis"));
            }
            other => other?,
        };
        self.print(&task.study, &found, &files)
    }

    /// Result of the command.
    pub fn execute(
        &self,
        virtual_files: &VirtualFiles,
        stop: &AtomicBool,
        on_progress: ProgressCallback<'_>,
    ) -> Result<Response, Failure> {
        let (found, files) = self.find(&self.task(virtual_files)?, stop, on_progress)?;
        Ok(Response {
            data: ResponseData::Uncertainty(Box::new(found)),
            files,
        })
    }

    fn find(
        &self,
        task: &Task,
        stop: &AtomicBool,
        on_progress: ProgressCallback<'_>,
    ) -> Result<(Analysis, Vec<PathBuf>), Failure> {
        let folder = RunFolder::wanted(
            self.out.as_deref(),
            Some(&task.document),
            self.figures.formats(),
        )?;
        let found = self.compute(task, stop, on_progress)?;
        let files = match folder {
            Some(folder) => write(folder, &task.study, &found)?,
            None => Vec::new(),
        };
        Ok((found, files))
    }

    fn task(&self, virtual_files: &VirtualFiles) -> Result<Task, Failure> {
        let document = virtual_files.read(&self.case)?;
        let mut study = Study::of(&document)?;
        if let Some(change) = &virtual_files.change {
            study = study.with_change(change.clone());
        }
        let model = model::model(&self.model)?;
        let speeds = match &self.velocity {
            Some(speeds) => speeds.of(&study.scenario)?,
            None => Vec::new(),
        };
        let mut asked = HashSet::new();
        let names = self.quantity.iter().filter(|name| asked.insert(*name));
        let settings = Settings {
            samples: self.samples,
            seed: self.seed,
            quantities: names
                .filter_map(|name| uncertainty::quantity(name))
                .collect(),
            indices: !self.no_indices,
            velocities: speeds,
        };
        Ok(Task {
            document,
            study,
            model,
            settings,
        })
    }

    fn compute(
        &self,
        task: &Task,
        stop: &AtomicBool,
        on_progress: ProgressCallback<'_>,
    ) -> Result<Analysis, Failure> {
        let pool = workers::pool(self.threads)?;
        let on_progress = Mutex::new(on_progress);
        let watch = Observer {
            stop,
            progress: &|done, total| {
                let mut on_progress = on_progress.lock().unwrap_or_else(PoisonError::into_inner);
                let words = format!("{done} of {total} runs");
                if on_progress(done as f64 / total as f64, &words).is_break() {
                    stop.store(true, Ordering::Relaxed);
                }
            },
        };
        let Task {
            study,
            model,
            settings,
            ..
        } = task;
        let kernel = BatchKernel::new(*model);
        let mut found =
            pool.install(|| uncertainty::analyse(study, *model, &kernel, settings, &watch))?;
        if let Some(points) = self.axisymmetric {
            let words = format!("{points} axisymmetric answers");
            let mut report = |fraction: f64| {
                let mut on_progress = on_progress.lock().unwrap_or_else(PoisonError::into_inner);
                unless_stopped(stop, on_progress(fraction, &words))
            };
            let corrected =
                pool.install(|| uncertainty::correct(study, &found, points as usize, &mut report))?;
            match corrected {
                Ok(spread) => found.axisymmetric = Some(spread),
                Err(reason) => found
                    .warnings
                    .push(format!("mean and spread are not corrected: {reason}")),
            }
        }
        self.check_quantities(&found)?;
        if found.quantities.is_empty() && found.perforation.is_none() {
            return Err(Failure::NoResult(found.failures.reasons));
        }
        Ok(found)
    }

    /// Refuses a requested quantity without any value.
    fn check_quantities(&self, found: &Analysis) -> Result<(), Failure> {
        let given = |name: &&String| found.quantities.iter().any(|q| q.quantity == **name);
        let Some(missing) = self.quantity.iter().find(|name| !given(name)) else {
            return Ok(());
        };
        let has = |quantity: &&ResultNumber| {
            found
                .draws
                .iter()
                .any(|draw| draw.value(quantity).is_some())
        };
        let names: Vec<&str> = uncertainty::quantities()
            .filter(has)
            .map(|q| q.name)
            .collect();
        Err(Failure::Usage {
            message: format!("no run of model `{}` has a value of {missing}", self.model),
            help: match names.is_empty() {
                true => "`percuss run` prints the reason".to_owned(),
                false => format!(
                    "{}available quantities: {}",
                    models_that_predict(missing),
                    names.join(", ")
                ),
            },
        })
    }

    fn print(&self, study: &Study, found: &Analysis, files: &[PathBuf]) -> Result<(), Failure> {
        let written = FileList::new(files);
        if self.json {
            return written.print_json(found, self.quiet);
        }
        if self.quiet {
            return output::print(&table::lines(found));
        }
        written.print_under(table::text(&study.scenario, found))
    }
}

fn write(mut folder: RunFolder, study: &Study, found: &Analysis) -> Result<Vec<PathBuf>, Failure> {
    folder.put("uncertainty.json", output::json(found)?.as_bytes())?;
    folder.add(percuss_report::write_uncertainty(folder.path(), found)?);
    folder.add_figures(&percuss_report::uncertainty_figures(&study.scenario, found))?;
    Ok(folder.written())
}

/// The models that predict a quantity, as a sentence; empty where the lists of models do not name it.
fn models_that_predict(quantity: &str) -> String {
    let predicts = |model: &&&dyn Model| {
        let predicted = model.validity().predicts.iter();
        predicted.map(|of| of.name()).any(|name| name == quantity)
    };
    let names: Vec<&str> = model::MODELS
        .iter()
        .filter(predicts)
        .map(|m| m.name())
        .collect();
    match names.is_empty() {
        true => String::new(),
        false => format!("models that predict it: {}; ", names.join(", ")),
    }
}
