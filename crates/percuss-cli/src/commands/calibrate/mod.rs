mod folder;
mod table;
mod values;

use std::{
    ops::ControlFlow,
    path::PathBuf,
    sync::{Mutex, PoisonError, atomic::Ordering},
};

use clap::{Args, builder::PossibleValuesParser};
use percuss::{
    Error,
    calibrate::{
        Calibrated, Fitted, Noise, Observations, Observer, Problem, Sampling, Settings, Stage,
    },
    case,
    experiments::Kind,
    material::Library,
    model::{MODELS, model},
};

use crate::{
    answer::{Answer, AtHand, Found, Hear},
    failure::Failure,
    output,
    progress::Progress,
    run_folder::RunFolder,
    shot_data, terminal, workers,
    written::Written,
};

const LONG_ABOUT: &str = "\
Fit numbers of cases to what was measured: constants of materials, options of
models. Measured values are the [[experiments]] of case files and the shots of
--data. Where constants of a material are fitted, only shots with that material
are taken; suspect and repeated ones are left out.

--fit KEY=LOW..HIGH names a number by the tables that it stands in, with its
unit behind the range, in which it is evenly likely beforehand; or a TOML file
of [[parameter]] tables with key and uniform, normal, lognormal or triangular,
as sweeps have them. Constants of library materials are
materials.ID.strength.LAW.NAME.

Least squares (Levenberg-Marquardt) give the best values; an ensemble sampler
(stretch move) the posterior, with rank-normalised split R-hat (more than 1.01
is a warning) and effective sample sizes of its bulk and tails. Values scatter
about the model by a Gaussian: their stated standard deviation, and a relative
scatter that is estimated unless --noise says otherwise. Sources that --hold-out
names are not fitted to: they test the result. Parameters that the data do not
determine are named.

With --out DIR the result (calibration.json), tables of parameters and
predictions, the sample (sample.parquet), the calibrated materials
(material.toml, for `material_files` of a case or `--materials` of commands)
and figures are written to DIR. A calibrated material says what it was
calibrated on, and validation does not count that as blind.";

const AFTER_HELP: &str = "\
Examples:
  percuss calibrate --data builtin --hold-out wilkins1973 \\
    --model wilkins_guinan --out copper --fit \\
    \"materials.ofhc-copper-johnson-cook.strength.johnson_cook.a=20..300 MPa\"
  percuss calibrate my-shot/scenario.toml --fit chain.constraint_factor=1..4
  percuss calibrate a.toml b.toml --fit priors.toml --least-squares --json

Exit codes: 0 ok, 2 bad input, 4 a file could not be read or written, 130 the
calibration was stopped";

/// Fit numbers of cases to what was measured
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Calibrate {
    /// Case files with [[experiments]]
    #[arg(value_name = "CASE.toml", required_unless_present = "data")]
    cases: Vec<PathBuf>,
    /// What is fitted: a number of the cases with its range, or a TOML file of them
    #[arg(long, value_name = "KEY=LOW..HIGH", required = true)]
    fit: Vec<String>,
    /// CSV file of shots, or `builtin` for the program's own
    #[arg(long, value_name = "FILE")]
    data: Vec<PathBuf>,
    /// File of materials that the shots name, beside the library
    #[arg(long, value_name = "FILE.toml")]
    materials: Vec<PathBuf>,
    /// Kind of shot; all of them when not given
    #[arg(long, value_name = "KIND", requires = "data")]
    #[arg(value_parser = PossibleValuesParser::new(Kind::ALL.map(Kind::name)))]
    kind: Vec<String>,
    /// Source to take, all when not given; those of --hold-out are taken as well
    #[arg(long, value_name = "KEY")]
    source: Vec<String>,
    /// Source to keep out of the fit and to test it with
    #[arg(long, value_name = "KEY")]
    hold_out: Vec<String>,
    /// Model that computes the cases
    #[arg(long, value_name = "NAME", default_value = "chain")]
    #[arg(value_parser = PossibleValuesParser::new(MODELS.iter().map(|model| model.name())))]
    model: String,
    /// Scatter about the model: `estimated`, a part such as "2 %", or `stated` for stated uncertainties alone
    #[arg(long, value_name = "SCATTER", default_value = "estimated", value_parser = str::parse::<Noise>)]
    noise: Noise,
    /// Least squares only, without a sample of the posterior
    #[arg(long)]
    least_squares: bool,
    /// Independent ensembles
    #[arg(long, value_name = "N", default_value = "4")]
    #[arg(value_parser = clap::value_parser!(u16).range(1..=64))]
    ensembles: u16,
    /// Walkers of an ensemble, an even number; four for each parameter when not given, and at least 12
    #[arg(long, value_name = "N", value_parser = values::walkers)]
    walkers: Option<usize>,
    /// Steps of each walker that are kept; a third as many come before them
    #[arg(long, value_name = "N", default_value = "600")]
    #[arg(value_parser = clap::value_parser!(u32).range(4..=10_000_000))]
    steps: u32,
    /// What decides over everything drawn at random
    #[arg(long, value_name = "N", default_value = "0")]
    seed: u64,
    /// Id of the calibrated material; the old one with `-calibrated` when not given
    #[arg(long, value_name = "ID", value_parser = values::material_id)]
    name: Option<String>,
    /// Write numbers, materials and figures to a folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print one JSON object and nothing else on standard output
    #[arg(long)]
    json: bool,
    /// No table and no progress: a line of NAME=VALUE pairs a parameter
    #[arg(long, short)]
    quiet: bool,
}

impl Calibrate {
    pub fn run(&self) -> Result<(), Failure> {
        let problem = self.problem(&AtHand::default())?;
        let settings = self.settings(&problem)?;
        let folder = RunFolder::wanted(self.out.as_deref(), None)?;
        let found = self.watched(&problem, &settings)?;
        let files = written(folder, &found)?;
        self.print(&found, &files)
    }

    /// What the command finds out.
    pub fn answer(&self, at_hand: &AtHand, hear: Hear<'_>) -> Result<Answer, Failure> {
        let problem = self.problem(at_hand)?;
        let settings = self.settings(&problem)?;
        let folder = RunFolder::wanted(self.out.as_deref(), None)?;
        let sampled = settings.sampling.is_some();
        let hear = Mutex::new(hear);
        let found = self.solve(&problem, &settings, &|stage, part, runs| {
            let mut hear = hear.lock().unwrap_or_else(PoisonError::into_inner);
            hear(stage.of_whole(part, sampled), &stage.describe(runs))
        })?;
        let files = written(folder, &found)?;
        Ok(Answer {
            found: Found::Calibration(Box::new(found)),
            files,
        })
    }

    fn problem(&self, at_hand: &AtHand) -> Result<Problem, Failure> {
        let mut fitted = Vec::new();
        for text in &self.fit {
            fitted.extend(Fitted::read_with(text, |path| at_hand.read(path))?);
        }
        let mut library = Library::built_in().clone();
        for path in &self.materials {
            library.add(&case::load_materials(path)?, &path.display().to_string());
        }
        let mut observations = Observations::default();
        for path in &self.cases {
            observations.add_case(&at_hand.read(path)?)?;
        }
        if !self.data.is_empty() {
            let (shots, _) = shot_data::read(&self.data, &self.kind, &library)?;
            observations.add_tests(&shots, &library, &fitted)?;
        }
        let wanted = |found: &[String]| {
            let mut keys = self.source.iter().chain(&self.hold_out);
            self.source.is_empty() || keys.any(|key| found.contains(key))
        };
        if let Some(key) = self
            .source
            .iter()
            .find(|key| !observations.sources().contains(&key.as_str()))
        {
            return Err(observations.no_source(key).into());
        }
        observations.used.retain(|value| wanted(&value.sources));
        observations.hold_out(&self.hold_out)?;
        Ok(Problem::new(
            model(&self.model)?,
            fitted,
            observations,
            self.noise,
        )?)
    }

    fn settings(&self, problem: &Problem) -> Result<Settings, Failure> {
        let steps = self.steps as usize;
        let sampling = match self.least_squares {
            true => None,
            false => Some(Sampling::of(
                problem,
                usize::from(self.ensembles),
                self.walkers,
                steps,
            )?),
        };
        Ok(Settings {
            sampling,
            seed: self.seed,
        })
    }

    fn solve(
        &self,
        problem: &Problem,
        settings: &Settings,
        watch: Observer<'_>,
    ) -> Result<Calibrated, Failure> {
        let name = self.name.as_deref();
        Ok(Calibrated::of(problem, settings, name, watch)?)
    }

    /// Solves it with a bar for each stage.
    fn watched(&self, problem: &Problem, settings: &Settings) -> Result<Calibrated, Failure> {
        let stop = workers::stop_on_request();
        let board = Mutex::new((Stage::LeastSquares, Progress::new(!self.quiet)));
        let watch = |stage: Stage, part: f64, runs: u64| {
            // A bar that another thread is drawing has no need of this one.
            if let Ok(mut board) = board.try_lock() {
                if board.0 != stage {
                    let before =
                        std::mem::replace(&mut *board, (stage, Progress::new(!self.quiet)));
                    before.1.finish();
                }
                board.1.update(part, &stage.describe(runs));
            }
            match stop.load(Ordering::Relaxed) {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        };
        let result = self.solve(problem, settings, &watch);
        let board = board.into_inner().unwrap_or_else(PoisonError::into_inner);
        board.1.finish();
        match result {
            Err(Failure::Library(Error::Cancelled { .. })) => {
                Err(Failure::Interrupted("the calibration"))
            }
            other => other,
        }
    }

    fn print(&self, found: &Calibrated, files: &[PathBuf]) -> Result<(), Failure> {
        let Calibrated {
            calibration,
            records,
        } = found;
        let written = Written::new(files);
        if self.json {
            return written.print_json(found, self.quiet);
        }
        if self.quiet {
            return output::print(&table::lines(calibration));
        }
        let mut text = table::text(calibration);
        if self.out.is_none() {
            for record in records {
                let heading = terminal::bold(format!("material {}", record.id));
                text += &format!("{heading}\n{}\n", record.toml());
            }
        }
        written.print_under(text)
    }
}

/// The files of a calibration, where a folder is wanted.
fn written(folder: Option<RunFolder>, found: &Calibrated) -> Result<Vec<PathBuf>, Failure> {
    folder.map_or_else(|| Ok(Vec::new()), |folder| folder::write(found, folder))
}
