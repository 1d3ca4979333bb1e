//! `percuss run`: one case by one model.

mod axisymmetric;
mod checkpoints;
mod other_models;
mod seeds;
mod task;

use std::{
    path::PathBuf,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::Duration,
};

use clap::{Args, builder::PossibleValuesParser};
use percuss::{
    Error,
    axisymmetric::{AxisymmetricAnswer, ReferenceMeshes},
    model::{DEFAULT_MODEL, MODELS},
    outcome::{RunResult, Termination},
    summary::{CaseResults, ResultRecord},
    units::UnitSystem,
};
use percuss_report::FieldQuantity;

use self::{axisymmetric::Wanted, task::Task};
use crate::{
    cost, diagnostic,
    failure::Failure,
    figure_formats::FigureArgs,
    file_list::FileList,
    output,
    progress::Progress,
    response::{ProgressCallback, Response, ResponseData, VirtualFiles},
    result_table, run_folder,
    run_output::RunOutput,
    unit_system::unit_system,
    whole_numbers::from_to,
    workers,
};

const LONG_ABOUT: &str = "\
Run a case and print its results: outcome, depth of penetration, final
dimensions of the projectile, distribution of the energy, errors of the energy
and momentum balances, and warnings about the assumptions. Without --model the
model is `chain`; where that does not apply, it is the model that
`percuss compare` recommends, or `axi` where no quick model applies, and the
first lines name it. The main result of every other applicable model is listed
too, except models that take minutes.

Then the axisymmetric model `axi` runs on 3, 4 and 6 cells per radius, and its
depth of penetration (on a rigid wall the final length, after perforation the
residual velocity) in the limit of fine meshes follows: the number to use. The
number after ± is the error of the mesh alone, not of the material data.
--reference fine takes 6, 8 and 12 cells; --fast leaves the runs out. They are
also left out with a --model other than `chain`, where `axi` does not apply,
and where they take more than 60 s of processor time, unless --reference is
given. Ctrl-C during these runs keeps the first result.

With --mesh-tolerance a one-dimensional model tries meshes from half to eight
times the elements of the case, each with twice those of the last. It takes the
coarsest one on which the estimated error of the depth (final length on a rigid
wall, residual velocity after perforation) is within the tolerance: 1.25 times
the difference from Richardson's value, or the spread of three meshes that
approach no limit. Mesh and error are among the results, the mesh also in
case-as-run.toml, for sweeps. A warning says where none is within it.

With --quiet one line is printed, of NAME=VALUE pairs with the names of --json:
  outcome=at_rest depth_of_penetration_mm=0.0436 residual_velocity_m_s=-1.2
  ballistic_limit_m_s=null projectile_final_length_mm=12.7 warnings=1
  model=chain axisymmetric.value=0.0412 axisymmetric.uncertainty=0.0021
(in one line; a number that the model does not give is `null`).

With --out DIR a copy of the case (case-as-run.toml, with the materials of the
files that it names), result.json, the time histories (CSV and Parquet) and the
figures (SVG and PNG) are written to DIR, which is made if it does not exist. A
case-as-run.toml needs no other file and gives the same results. A model without
time histories writes the first two only. The fields of the axisymmetric answer
at its end are axisymmetric.vtp for ParaView and a picture, axisymmetric.png.
Files of the same names are replaced, other files are kept.

With --units the tables in DIR are in another unit system; the names of their
columns say so. result.json and figures keep their units.

With --fields numerical models also write their fields against time as a
series for ParaView (fields.pvd, which can be opened during the run). Ctrl-C, or
a termination request of the system, leaves a checkpoint in DIR, from which
--resume continues with the same numbers.

The two-dimensional models `axi` and `particles` also write their fields at the
end: field.vtp for ParaView and a picture of one of them, field.png. `axi` adds
the shapes of crater and projectile (CSV and figure). With --animation they
write animation.gif and its pictures (frames/), with --dump a text file per
frame in the format of LAMMPS' dumps, which OVITO reads (dump/).

With --seeds N the model `particles` runs N packings: the seed of the case and
the next ones. The table and --json (`seeds`) then also have mean, standard
deviation and range of every result number. Files and the first table are of the
first seed. Ctrl-C keeps the packings that are complete.

After one second a progress bar appears, if standard error is a terminal.";

const AFTER_HELP: &str = "\
Examples:
  percuss run my-case/scenario.toml
  percuss run my-case/scenario.toml --fast
  percuss run my-case/scenario.toml --reference fine
  percuss run my-case/scenario.toml --fast --mesh-tolerance 1%
  percuss run my-case/scenario.toml --out results
  percuss run my-case/scenario.toml --out results --units mm-ms-kN
  percuss run my-case/scenario.toml --out results --figures svg,pdf
  percuss run my-case/scenario.toml --json > result.json
  percuss run my-case/scenario.toml --quiet
  percuss run my-case/scenario.toml --out results --fields
  percuss run my-case/scenario.toml --model axi --out results --resume
  percuss run my-case/scenario.toml --model axi --out results --animation
  percuss run my-case/scenario.toml --model particles --seeds 5

Exit codes: 0 ok, 2 bad input or a model that does not apply, 3 numerical
failure, 4 a file could not be read or written, 130 stopped by the user";

/// Run a case
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Run {
    /// Case file; `percuss new` writes one to start from
    #[arg(value_name = "CASE.toml")]
    case: PathBuf,
    /// Model to compute with; `percuss models` describes them, `percuss compare CASE` names those that apply [default: chain where it applies]
    #[arg(long, value_name = "NAME")]
    #[arg(value_parser = PossibleValuesParser::new(MODELS.iter().map(|model| model.name())))]
    model: Option<String>,
    /// Meshes of the axisymmetric answer, whatever they cost [default: standard, within 60 s of processor time]
    #[arg(long, value_name = "MESHES", conflicts_with = "fast")]
    #[arg(value_parser = PossibleValuesParser::new(ReferenceMeshes::ALL.map(ReferenceMeshes::name)))]
    reference: Option<String>,
    /// Leave out the axisymmetric answer
    #[arg(long)]
    fast: bool,
    /// Choose the coarsest mesh on which the main number has at most this error by the mesh, such as 1%
    #[arg(long, value_name = "PERCENT", value_parser = mesh_tolerance, conflicts_with = "resume")]
    #[arg(allow_hyphen_values = true)]
    mesh_tolerance: Option<f64>,
    /// Print one JSON object and nothing else on standard output
    #[arg(long)]
    json: bool,
    /// Also run the next packings of particles, N in all, and give means and spread over them
    #[arg(long, value_name = "N", value_parser = from_to::<u16>(2, 1000, "a number of packings"))]
    seeds: Option<u16>,
    /// Write result, histories and figures to a folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    pub figures: FigureArgs,
    /// Unit system of the histories, profiles, gauges and fragments in DIR [default: mm, us, m/s, kN, MPa, J]
    #[arg(long, value_name = "SYSTEM", requires = "out", value_parser = unit_system())]
    units: Option<UnitSystem>,
    /// No table and no progress: one line of NAME=VALUE pairs
    #[arg(long, short)]
    quiet: bool,
    /// Field that pictures of a two-dimensional model show [default: plastic-strain; of `particles` damage, or von-mises-stress where nothing breaks]
    #[arg(long, value_name = "NAME", requires = "out")]
    #[arg(value_parser = PossibleValuesParser::new(FieldQuantity::ALL.map(FieldQuantity::name)))]
    field: Option<String>,
    /// Write the fields against time as a series for ParaView
    #[arg(long, requires = "out")]
    fields: bool,
    /// Write an animation of one field of a two-dimensional model, and its pictures
    #[arg(long, requires = "out")]
    animation: bool,
    /// Write the fields of a two-dimensional model against time in LAMMPS' format of dumps, for OVITO
    #[arg(long, requires = "out")]
    dump: bool,
    /// Most frames of --fields, --animation and --dump, 2 to 1000; a run has between half as many and all of them, unless it is too short [default: 64]
    #[arg(long, value_name = "N", requires = "out", value_parser = from_to::<u16>(2, 1000, "a number of frames"))]
    frames: Option<u16>,
    /// How often a numerical model leaves a checkpoint in DIR [default: 60s]
    #[arg(long, value_name = "TIME", requires = "out", value_parser = checkpoints::interval)]
    checkpoint: Option<Duration>,
    /// Continue from the checkpoint in DIR; without one there, start at the beginning
    #[arg(long, requires = "out")]
    resume: bool,
}

/// Reads a tolerance of the mesh error, as a part.
fn mesh_tolerance(text: &str) -> Result<f64, String> {
    const ALLOWED: std::ops::RangeInclusive<f64> = 0.01..=50.0;
    let number = text.trim().strip_suffix('%');
    let percent = number.and_then(|number| number.trim().parse::<f64>().ok());
    match percent.filter(|percent| ALLOWED.contains(percent)) {
        Some(percent) => Ok(0.01 * percent),
        None => Err("allowed: 0.01 to 50 percent, such as 1%".to_owned()),
    }
}

/// Fraction of the work that is computation; the rest is writing files.
const COMPUTED: f64 = 0.9;
/// Fraction of the computation that is the run of the model, where an axisymmetric answer follows.
const MODEL: f64 = 0.1;

impl Run {
    /// Whether frames are kept during the run.
    fn has_frames(&self) -> bool {
        self.fields || self.animation || self.dump
    }

    pub fn run(&self) -> Result<(), Failure> {
        let say = |words: &str| {
            if !self.quiet {
                diagnostic::print(&format!("note: {words}\n"));
            }
        };
        // A run that leaves no checkpoint and is no study just ends with the program.
        let stop = match self.leaves_checkpoints() || self.seeds.is_some() {
            true => workers::stop_on_request(),
            false => Arc::default(),
        };
        let mut task = Task::new(self, &VirtualFiles::default(), &stop, &say)?;
        cost::tell(task.estimate(), self.quiet);
        let mut progress = Progress::new(!self.quiet);
        let run_output = task.compute(&mut progress.callback());
        progress.finish();
        let mut run_output = run_output.map_err(|error| match error {
            Failure::Library(Error::Cancelled { .. }) if stop.load(Ordering::Relaxed) => {
                Failure::Interrupted("the run")
            }
            error => error,
        })?;
        let wanted = Wanted::of(self, &run_output.scenario);
        let is_planned = wanted.as_ref().is_some_and(Wanted::is_planned);
        let is_text = !(self.json || self.quiet);
        if is_planned && is_text {
            output::print(&self.first_text(&run_output, true)?)?;
        }
        let mut was_stopped = false;
        if let Some(wanted) = &wanted {
            let stop = match is_planned && !self.leaves_checkpoints() {
                true => workers::stop_on_request(),
                false => Arc::clone(&stop),
            };
            let answer = self.axisymmetric(wanted, &mut task, &stop)?;
            was_stopped = answer.is_none();
            run_output.axisymmetric = Some(answer.unwrap_or_else(|| wanted.stopped()));
        }
        let mut progress = Progress::new(!self.quiet);
        let files = task.write(&run_output, &mut |part, words| progress.update(part, words));
        progress.finish();
        self.print(&run_output, &files?, is_planned)?;
        match (was_stopped, run_output.seeds_stopped) {
            (true, _) => Err(Failure::AxisymmetricStopped),
            (false, true) => Err(Failure::StudyStopped {
                complete: run_output.seeds.map_or(1, |study| study.seeds.len()),
                wanted: self.seeds.unwrap_or(1).into(),
                runs: "packings",
            }),
            (false, false) => Ok(()),
        }
    }

    /// Result of the command, with histories where it writes them.
    pub fn execute(
        &self,
        virtual_files: &VirtualFiles,
        stop: &AtomicBool,
        on_progress: ProgressCallback<'_>,
    ) -> Result<Response, Failure> {
        let mut task = Task::new(self, virtual_files, stop, &|_| ())?;
        let wanted = Wanted::of(self, task.scenario());
        let is_planned = wanted.as_ref().is_some_and(Wanted::is_planned);
        let model = if is_planned { MODEL } else { 1.0 };
        let mut run_output =
            task.compute(&mut |part, words| on_progress(COMPUTED * model * part, words))?;
        if run_output.seeds_stopped {
            let (step, time_us) = (0, 0.0);
            return Err(Error::Cancelled { step, time_us }.into());
        }
        if let Some(wanted) = wanted {
            let mut report = |part: f64, words: &str| {
                on_progress(COMPUTED * (model + (1.0 - model) * part), words)
            };
            let answer = wanted.compute(
                &run_output.scenario,
                stop,
                &mut report,
                &mut task.axisymmetric_frames(),
            )?;
            run_output.axisymmetric = Some(answer);
        }
        let files = task.write(&run_output, &mut |part, words| {
            // What is left takes seconds.
            let _ = on_progress(COMPUTED + (1.0 - COMPUTED) * part, words);
        })?;
        Ok(Response {
            data: ResponseData::Run(Box::new(run_output)),
            files,
        })
    }

    /// The axisymmetric answer of a run; `None` where the user stopped it.
    fn axisymmetric(
        &self,
        wanted: &Wanted,
        task: &mut Task<'_>,
        stop: &AtomicBool,
    ) -> Result<Option<AxisymmetricAnswer>, Failure> {
        let mut progress = Progress::new(!self.quiet);
        let scenario = Arc::clone(task.scenario());
        let mut frames = task.axisymmetric_frames();
        let answer = wanted.compute(&scenario, stop, &mut progress.callback(), &mut frames);
        drop(frames);
        progress.finish();
        match answer {
            Err(Error::Cancelled { .. }) => Ok(None),
            answer => Ok(Some(answer?)),
        }
    }

    /// Whether the model leaves checkpoints in the folder.
    fn leaves_checkpoints(&self) -> bool {
        let asked = self.model.as_deref().unwrap_or(DEFAULT_MODEL);
        let chosen = MODELS.iter().find(|model| model.name() == asked);
        self.out.is_some() && chosen.is_some_and(|model| model.has_fields())
    }

    /// Prints what is left to print: the first text may be on the terminal already.
    fn print(
        &self,
        run_output: &RunOutput,
        files: &[PathBuf],
        first_is_printed: bool,
    ) -> Result<(), Failure> {
        let files = self.file_list(run_output, files);
        if self.json {
            return files.print_json(&run_output.results(), self.quiet);
        }
        if self.quiet {
            let seeds = run_output.seeds.as_ref();
            let of_seeds = seeds.map_or_else(String::new, seeds::pairs);
            let line = one_line(&run_output.results());
            return output::print(&format!("{}{of_seeds}\n", line.trim_end()));
        }
        let first = match first_is_printed {
            true => String::new(),
            false => self.first_text(run_output, false)?,
        };
        let of_seeds = run_output
            .seeds
            .as_ref()
            .map_or_else(String::new, seeds::text);
        files.print_under(first + &axisymmetric_text(run_output, first_is_printed) + &of_seeds)
    }

    /// List of the written files.
    fn file_list(&self, run_output: &RunOutput, files: &[PathBuf]) -> FileList {
        let mut written = FileList::new(files);
        if !run_folder::has_history(&run_output.result) {
            let why = without_history(&run_output.result);
            written = written.with_note(&format!("no time history: this model {why}"));
        }
        match self
            .out
            .as_deref()
            .and_then(|out| run_folder::others(out, files))
        {
            Some(names) => written.with_note(&format!("not of this run: {names}")),
            None => written,
        }
    }

    /// Results of the model, and of others if none is named. Where an axisymmetric answer `follows`, it stands for the estimated model
    /// error.
    fn first_text(&self, run_output: &RunOutput, follows: bool) -> Result<String, Failure> {
        let (scenario, result) = (&run_output.scenario, &run_output.result);
        let others = match self.model {
            Some(_) => None,
            None => {
                let mut progress = Progress::new(true);
                let others = other_models::rows(scenario, result.model, &mut progress);
                progress.finish();
                Some(others?)
            }
        };
        let mut record = ResultRecord::new(scenario, result);
        if follows {
            record.expected_error = None;
        }
        Ok(result_table::text(
            scenario, result, &record, others, follows,
        ))
    }
}

/// The axisymmetric answer as text, if there is one; the first text `lacks_estimate` where an answer was to follow.
fn axisymmetric_text(run_output: &RunOutput, lacks_estimate: bool) -> String {
    match &run_output.axisymmetric {
        Some(answer) => {
            let record = ResultRecord::new(&run_output.scenario, &run_output.result);
            axisymmetric::text(answer, &record, lacks_estimate)
        }
        None => String::new(),
    }
}

/// Reason why a result has no history.
fn without_history(result: &RunResult) -> &'static str {
    match result.termination {
        Termination::ClosedForm => "is a formula",
        _ => "keeps none",
    }
}

/// Result as one line of NAME=VALUE pairs.
fn one_line(results: &CaseResults) -> String {
    let mut line: String = results.results.iter().map(pairs).collect();
    if let Some(answer) = &results.axisymmetric {
        for (name, value) in [("value", answer.value), ("uncertainty", answer.uncertainty)] {
            let value = value.map_or("null".to_owned(), |value| value.to_string());
            line += &format!(" axisymmetric.{name}={value}");
        }
    }
    line + "\n"
}

fn pairs(record: &ResultRecord) -> String {
    let outcome = serde_json::json!(record.outcome);
    format!(
        "outcome={} {} warnings={} model={}",
        outcome.as_str().unwrap_or_default(),
        output::main_numbers(record),
        record.warnings.len(),
        record.model,
    )
}
