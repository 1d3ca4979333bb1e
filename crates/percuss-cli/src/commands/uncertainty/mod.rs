mod table;

use std::{
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
    model::{self, MODELS, Model},
    summary::ResultNumber,
    sweep::BatchKernel,
    uncertainty::{
        self, MAX_SAMPLES, MIN_SAMPLES, Observer, Settings, Study, Uncertainty as Found,
    },
};

use crate::{
    answer::{self, Answer, AtHand, Hear},
    failure::Failure,
    output,
    progress::Progress,
    run_folder::RunFolder,
    speeds::{Speeds, SpeedsError},
    workers,
    written::Written,
};

const LONG_ABOUT: &str = "\
Say what the uncertainty of a case's numbers does to its results. The case names
them with their distributions in its table `uncertainty`:

  [[uncertainty.parameter]]
  key = \"projectile.impact_velocity\"
  normal = { mean = \"230 m/s\", standard_deviation = \"3 m/s\" }

Scrambled Sobol' points are drawn from the distributions, and of each result come
its mean, standard deviation and percentiles with 95 % intervals, the chance of
perforation, the effect of each parameter from low to high (tornado), and the
first-order and total Sobol' indices: which part of the variance a parameter
causes alone, and which part with others as well. With N samples and d
parameters the indices take N (d + 1) shots more. Correlated parameters have no
such indices; everything else is said of them too.

With --velocity the same is done at each of several impact speeds, by 256 shots
at most: percentiles and chances of perforation against speed.

A shot without a result is counted, and left out of the statistics. The spread
is that of the inputs: the error of the model itself comes on top of it.

With --out DIR a copy of the case (case-as-run.toml), uncertainty.json, the
tables samples.csv, statistics.csv, sensitivity.csv and bands.csv, and the
figures (histograms, tornado charts, indices, bands, chances of perforation, as
SVG and PNG) are written to DIR, which is made if it does not exist.";

const AFTER_HELP: &str = "\
Examples:
  percuss uncertainty cases/paper-table1-uncertainty/scenario.toml
  percuss uncertainty my-shot/scenario.toml --samples 4096 --out spread
  percuss uncertainty my-shot/scenario.toml --velocity 150..400 --no-indices
  percuss uncertainty my-shot/scenario.toml --quantity peak_force_kn --json

Exit codes: 0 ok, 2 bad input or no shot has a result, 4 a file could not be
read or written, 130 stopped by the user";

/// Say what uncertain numbers of a case do to its results
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Uncertainty {
    /// Case file with a table `uncertainty`
    #[arg(value_name = "CASE.toml")]
    case: PathBuf,
    /// Model to compute with
    #[arg(long, value_name = "NAME", default_value = "chain")]
    #[arg(value_parser = PossibleValuesParser::new(MODELS.iter().map(|model| model.name())))]
    model: String,
    /// Shots that the statistics rest on; a power of two serves best
    #[arg(long, value_name = "N", default_value = "1024")]
    #[arg(value_parser = clap::value_parser!(u64).range(MIN_SAMPLES..=MAX_SAMPLES))]
    samples: u64,
    /// Decides over everything drawn at random
    #[arg(long, value_name = "S", default_value = "0")]
    seed: u64,
    /// Result to look at, by its name in JSON; may be given several times
    #[arg(long, value_name = "NAME")]
    #[arg(value_parser = PossibleValuesParser::new(uncertainty::quantities().map(|quantity| quantity.name)))]
    quantity: Vec<String>,
    /// Impact speeds for bands: FROM..TO (11 speeds), FROM..TO:COUNT, a list, or `experiments`
    // A negative speed is answered with the range that speeds have.
    #[arg(long, value_name = "SPEEDS", allow_hyphen_values = true, value_parser = speeds)]
    velocity: Option<Speeds>,
    /// Leave out the Sobol' indices, which take most of the shots
    #[arg(long)]
    no_indices: bool,
    /// Threads; as many as there are cores when not given
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Print one JSON object and nothing else on standard output
    #[arg(long)]
    json: bool,
    /// Write numbers and figures to a folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// No tables and no progress: one line of NAME=VALUE pairs a quantity
    #[arg(long, short)]
    quiet: bool,
}

/// What is to be computed.
struct Task {
    document: Document,
    study: Study,
    model: &'static dyn Model,
    settings: Settings,
}

/// Speeds of a range that does not say how many.
const SPEEDS: u32 = 11;

fn speeds(text: &str) -> Result<Speeds, SpeedsError> {
    match text.contains("..") && !text.contains(':') {
        true => format!("{text}:{SPEEDS}").parse(),
        false => text.parse(),
    }
}

impl Uncertainty {
    pub fn run(&self) -> Result<(), Failure> {
        let task = self.task(&AtHand::default())?;
        let mut progress = Progress::new(!self.quiet);
        let found = self.find(&task, &workers::stop_on_request(), &mut progress.hear());
        progress.finish();
        let (found, files) = match found {
            Err(Failure::Library(Error::Cancelled { .. })) => {
                return Err(Failure::Interrupted("the analysis"));
            }
            other => other?,
        };
        self.print(&task.study, &found, &files)
    }

    /// What the command finds out.
    pub fn answer(
        &self,
        at_hand: &AtHand,
        stop: &AtomicBool,
        hear: Hear<'_>,
    ) -> Result<Answer, Failure> {
        let (found, files) = self.find(&self.task(at_hand)?, stop, hear)?;
        Ok(Answer {
            found: answer::Found::Uncertainty(Box::new(found)),
            files,
        })
    }

    fn find(
        &self,
        task: &Task,
        stop: &AtomicBool,
        hear: Hear<'_>,
    ) -> Result<(Found, Vec<PathBuf>), Failure> {
        let folder = RunFolder::wanted(self.out.as_deref(), Some(&task.document))?;
        let found = self.compute(task, stop, hear)?;
        let files = match folder {
            Some(folder) => write(folder, &task.study, &found)?,
            None => Vec::new(),
        };
        Ok((found, files))
    }

    fn task(&self, at_hand: &AtHand) -> Result<Task, Failure> {
        let document = at_hand.read(&self.case)?;
        let study = Study::of(&document)?;
        let model = model::model(&self.model)?;
        let speeds = match &self.velocity {
            Some(speeds) => speeds.of(&study.scenario)?,
            None => Vec::new(),
        };
        let names = self.quantity.iter();
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

    fn compute(&self, task: &Task, stop: &AtomicBool, hear: Hear<'_>) -> Result<Found, Failure> {
        let pool = workers::pool(self.threads)?;
        let hear = Mutex::new(hear);
        let watch = Observer {
            stop,
            progress: &|done, total| {
                let mut hear = hear.lock().unwrap_or_else(PoisonError::into_inner);
                let words = format!("{done} of {total} shots");
                if hear(done as f64 / total as f64, &words).is_break() {
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
        let found =
            pool.install(|| uncertainty::analyse(study, *model, &kernel, settings, &watch))?;
        self.check_quantities(&found)?;
        if found.quantities.is_empty() && found.perforation.is_none() {
            return Err(Failure::NoResult(found.failures.reasons));
        }
        Ok(found)
    }

    /// A quantity that was asked for has to be there.
    fn check_quantities(&self, found: &Found) -> Result<(), Failure> {
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
            message: format!("no shot of model `{}` has a value of {missing}", self.model),
            help: match names.is_empty() {
                true => "`percuss run` says what is wrong with the shot".to_owned(),
                false => format!("it gives {}", names.join(", ")),
            },
        })
    }

    fn print(&self, study: &Study, found: &Found, files: &[PathBuf]) -> Result<(), Failure> {
        let written = Written::new(files);
        if self.json {
            return written.print_json(found, self.quiet);
        }
        if self.quiet {
            return output::print(&table::lines(found));
        }
        written.print_under(table::text(&study.scenario, found))
    }
}

fn write(mut folder: RunFolder, study: &Study, found: &Found) -> Result<Vec<PathBuf>, Failure> {
    folder.put("uncertainty.json", output::json(found)?.as_bytes())?;
    folder.add(percuss_report::write_uncertainty(folder.path(), found)?);
    for figure in percuss_report::uncertainty_figures(&study.scenario, found) {
        folder.add(figure.write(folder.path())?);
    }
    Ok(folder.written())
}
