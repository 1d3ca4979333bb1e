//! `percuss calibrate`: parameters fitted to experiments.

mod folder;
mod table;
mod values;

use std::{
    fs,
    ops::ControlFlow,
    path::PathBuf,
    sync::{Mutex, PoisonError},
};

use clap::{Args, builder::PossibleValuesParser};
use percuss::{
    Error,
    axisymmetric::{ReferenceMeshes, Request},
    calibrate::{
        Calibrated, Fitted, Noise, Observations, Observer, Problem, Sampling, Settings, Stage,
        Stages,
    },
    case,
    experiments::Kind,
    material::Library,
    model::{DEFAULT_MODEL, MODELS, model},
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
    terminal, test_data,
    whole_numbers::from_to,
    workers::{self, unless_stopped},
};

const LONG_ABOUT: &str = "\
Calibrate material constants and model options against experiments. The data are
the [[experiments]] and [[measured_curves]] of case files and the tests of
--data. Where constants of a material are fitted, only tests with that material
are used; suspect and repeated tests are left out.

--fit KEY=LOW..HIGH gives the dotted key of a number and the range of a uniform
prior, with the unit behind the range; or a TOML file of [[parameter]] tables
with key and uniform, normal, lognormal or triangular, as in sweep files.
Constants of library materials are materials.ID.strength.LAW.NAME.

Least squares (Levenberg-Marquardt) give the best fit; an ensemble sampler
(stretch move) the posterior, with rank-normalised split R-hat (a warning above
1.01) and effective sample sizes of bulk and tails. The error model is Gaussian:
the stated standard deviation, and a relative scatter that is estimated unless
--noise gives it. The errors of a curve are correlated in time: it counts as
the number of independent values that its `correlation_time` leaves, which is
estimated from the residuals unless the case gives it. Sources of --hold-out
are not fitted; they test the result.
Parameters that the data do not identify are reported.

With --reference the model is corrected to the axisymmetric model `axi`: each
depth or length by the factor axi/model at the best values, each residual
velocity by the difference. Fits and axisymmetric runs alternate until they
agree to 1 %. The best values are then those of `axi`, at a few of its runs.
Their discretisation uncertainty adds to the standard deviations. Curves are
left out.

With --out DIR the result (calibration.json), tables of parameters, predictions
and curves, the sample (sample.parquet), the calibrated materials
(material.toml, for `material_files` of a case or `--materials` of commands)
and figures are written to DIR. A calibrated material lists
the data of its calibration, and validation does not count these as blind.";

const AFTER_HELP: &str = "\
Examples:
  percuss calibrate --data builtin --hold-out wilkins1973 \\
    --model wilkins_guinan --out copper --fit \\
    \"materials.ofhc-copper-johnson-cook.strength.johnson_cook.a=20..300 MPa\"
  percuss calibrate my-case/scenario.toml --fit chain.constraint_factor=1..4
  percuss calibrate bar.toml --model fdm --fit \\
    \"materials.my-steel.strength.perfectly_plastic.flow_stress=200..900 MPa\"
  percuss calibrate a.toml b.toml --fit priors.toml --least-squares --json

Exit codes: 0 ok, 2 bad input, 4 a file could not be read or written, 130 the
calibration was stopped";

/// Calibrate material constants and model options against experiments
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Calibrate {
    /// Case files with [[experiments]] or [[measured_curves]]
    #[arg(value_name = "CASE.toml", required_unless_present = "data")]
    cases: Vec<PathBuf>,
    /// Parameter to fit: key of a number with its range, or a TOML file of parameters
    #[arg(long, value_name = "KEY=LOW..HIGH", required = true)]
    fit: Vec<String>,
    /// CSV file of tests, or `builtin` for the tests of the program
    #[arg(long, value_name = "FILE")]
    data: Vec<PathBuf>,
    /// File of materials for the tests, in addition to the library
    #[arg(long, value_name = "FILE.toml")]
    materials: Vec<PathBuf>,
    /// Kind of test [default: all kinds]
    #[arg(long, value_name = "KIND", requires = "data")]
    #[arg(value_parser = PossibleValuesParser::new(Kind::ALL.map(Kind::name)))]
    kind: Vec<String>,
    /// Source to use, besides those of --hold-out [default: all sources]
    #[arg(long, value_name = "KEY")]
    source: Vec<String>,
    /// Source that is not fitted and tests the result
    #[arg(long, value_name = "KEY")]
    hold_out: Vec<String>,
    /// Model to calibrate
    #[arg(long, value_name = "NAME", default_value = DEFAULT_MODEL)]
    #[arg(value_parser = PossibleValuesParser::new(MODELS.iter().map(|model| model.name())))]
    model: String,
    /// Correct the model to axisymmetric answers on these meshes, at the best values
    #[arg(long, value_name = "MESHES")]
    #[arg(value_parser = PossibleValuesParser::new(ReferenceMeshes::ALL.map(ReferenceMeshes::name)))]
    reference: Option<String>,
    /// Relative scatter about the model: `estimated`, a percentage such as "2 %", or `stated` for the stated uncertainties alone
    #[arg(long, value_name = "SCATTER", default_value = "estimated", value_parser = str::parse::<Noise>)]
    #[arg(allow_hyphen_values = true)]
    noise: Noise,
    /// Least squares only, without a sample of the posterior
    #[arg(long, conflicts_with_all = ["ensembles", "walkers", "steps"])]
    least_squares: bool,
    /// Number of independent ensembles
    #[arg(long, value_name = "N", default_value = "4")]
    #[arg(value_parser = from_to::<u16>(1, 64, "a number of ensembles"))]
    ensembles: u16,
    /// Walkers per ensemble, an even number [default: four per parameter, at least 12]
    #[arg(long, value_name = "N", value_parser = values::walkers)]
    walkers: Option<usize>,
    /// Kept steps per walker; the burn-in has a third as many
    #[arg(long, value_name = "N", default_value = "600")]
    #[arg(value_parser = from_to::<u32>(4, 10_000_000, "a number of steps per walker"))]
    steps: u32,
    /// Seed of the random numbers
    #[arg(
        long,
        value_name = "N",
        default_value = "0",
        allow_hyphen_values = true
    )]
    #[arg(value_parser = from_to::<u64>(0, u64::MAX, "a seed"))]
    seed: u64,
    /// Id of the calibrated material [default: the original id with `-calibrated`]
    #[arg(long, value_name = "ID", value_parser = values::material_id)]
    name: Option<String>,
    /// Write numbers, materials and figures to a folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    pub figures: FigureArgs,
    /// Print one JSON object and nothing else on standard output
    #[arg(long)]
    json: bool,
    /// No table and no progress: one line of NAME=VALUE pairs per parameter
    #[arg(long, short)]
    quiet: bool,
}

impl Calibrate {
    pub fn run(&self) -> Result<(), Failure> {
        let problem = self.problem(&VirtualFiles::default())?;
        let settings = self.settings(&problem)?;
        let folder = RunFolder::wanted(self.out.as_deref(), None, self.figures.formats())?;
        let cheaper = match settings.sampling {
            Some(_) => "`--least-squares` gives a first answer with a small part of these runs",
            None => "",
        };
        let estimate = problem.estimate(&settings, self.request());
        cost::tell_with(estimate, cheaper, self.quiet);
        let found = self.watched(problem, &settings)?;
        let files = written(folder, &found)?;
        self.print(&found, &files)
    }

    /// Result of the command.
    pub fn execute(
        &self,
        virtual_files: &VirtualFiles,
        on_progress: ProgressCallback<'_>,
    ) -> Result<Response, Failure> {
        let problem = self.problem(virtual_files)?;
        let settings = self.settings(&problem)?;
        let folder = RunFolder::wanted(self.out.as_deref(), None, self.figures.formats())?;
        let stages = self.stages();
        let on_progress = Mutex::new(on_progress);
        let found = self.solve(problem, &settings, &|stage, part, runs| {
            let mut on_progress = on_progress.lock().unwrap_or_else(PoisonError::into_inner);
            on_progress(stages.of_whole(stage, part), &stage.describe(runs))
        })?;
        let files = written(folder, &found)?;
        Ok(Response {
            data: ResponseData::Calibration(Box::new(found)),
            files,
        })
    }

    fn problem(&self, virtual_files: &VirtualFiles) -> Result<Problem, Failure> {
        let mut fitted = Vec::new();
        for text in &self.fit {
            fitted.extend(Fitted::read_with(text, |path| virtual_files.read(path))?);
        }
        let mut library = Library::built_in().clone();
        for path in &self.materials {
            library.add(&case::load_materials(path)?, &path.display().to_string());
        }
        let mut observations = Observations::default();
        let file = |path: &PathBuf| fs::canonicalize(path).unwrap_or_else(|_| path.clone());
        for (i, path) in self.cases.iter().enumerate() {
            if self.cases[..i]
                .iter()
                .any(|other| file(other) == file(path))
            {
                return Err(Failure::Usage {
                    message: format!("the case `{}` is named twice", path.display()),
                    help: "its values would count twice: name it once".to_owned(),
                });
            }
            observations.add_case(&virtual_files.read(path)?)?;
        }
        if !self.data.is_empty() {
            let (tests, _) = test_data::read(&self.data, &self.kind, &library)?;
            observations.add_tests(&tests, &library, &fitted)?;
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
        observations.keep(wanted);
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
        problem: Problem,
        settings: &Settings,
        watch: Observer<'_>,
    ) -> Result<Calibrated, Failure> {
        let name = self.name.as_deref();
        let problem = match self.request() {
            None => problem,
            Some(request) => problem.corrected(request, self.seed, watch)?,
        };
        Ok(Calibrated::of(&problem, settings, name, watch)?)
    }

    /// Axisymmetric answers that the model is corrected to.
    fn request(&self) -> Option<Request> {
        let meshes = ReferenceMeshes::named(self.reference.as_deref()?)?;
        Some(Request::whole(meshes))
    }

    fn stages(&self) -> Stages {
        Stages {
            corrected: self.request().is_some(),
            sampled: !self.least_squares,
        }
    }

    /// Solves the problem with a progress bar per phase.
    fn watched(&self, problem: Problem, settings: &Settings) -> Result<Calibrated, Failure> {
        let stop = workers::stop_on_request();
        let first = match self.request() {
            Some(_) => Stage::Correcting,
            None => Stage::LeastSquares,
        };
        let board = Mutex::new((first, Progress::new(!self.quiet)));
        let watch = |stage: Stage, part: f64, runs: u64| {
            // Another thread is drawing the bar: this update is left out.
            if let Ok(mut board) = board.try_lock() {
                if board.0 != stage {
                    let before =
                        std::mem::replace(&mut *board, (stage, Progress::new(!self.quiet)));
                    before.1.finish();
                }
                board.1.update(part, &stage.describe(runs));
            }
            unless_stopped(&stop, ControlFlow::Continue(()))
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
        let written = FileList::new(files);
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

/// Files of a calibration; none without a folder.
fn written(folder: Option<RunFolder>, found: &Calibrated) -> Result<Vec<PathBuf>, Failure> {
    folder.map_or_else(|| Ok(Vec::new()), |folder| folder::write(found, folder))
}
