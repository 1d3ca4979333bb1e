//! Execution of a run with fields, checkpoints and output folder.

use std::{
    ops::ControlFlow,
    path::{Path, PathBuf},
    sync::{Arc, atomic::AtomicBool},
    time::Duration,
};

use percuss::{
    Error, Scenario, case,
    checkpoint::Header,
    frames::Frame,
    mesh_choice::{MeshChoice, choose_mesh},
    model::{self, ChosenModel, Control, Estimate, Model},
    outcome::RunResult,
};
use percuss_report::{FieldQuantity, FieldSeries, FinalField};

use super::{
    Run, axisymmetric,
    checkpoints::{self, CheckpointWriter},
    seeds,
};
use crate::{
    cost,
    failure::Failure,
    response::{ProgressCallback, VirtualFiles},
    run_folder::RunFolder,
    run_output::RunOutput,
    workers::unless_stopped,
};

/// Default of the largest number of frames.
const FRAMES: u16 = 64;
/// Stem of the files of the axisymmetric fields.
const AXISYMMETRIC: &str = "axisymmetric";
/// Default interval of the checkpoints.
const CHECKPOINT_INTERVAL: Duration = Duration::from_secs(60);

/// Run to be executed.
pub(super) struct Task<'a> {
    options: &'a Run,
    scenario: Arc<Scenario>,
    chosen: ChosenModel,
    folder: Option<RunFolder>,
    fields: Option<Fields<'a>>,
    /// Final fields of the axisymmetric answer.
    axisymmetric: Option<FinalField>,
    stop: &'a AtomicBool,
}

/// Fields and checkpoints of a run in its folder.
struct Fields<'a> {
    /// Fields versus time, if they are requested.
    series: Option<FieldSeries>,
    /// Final fields of a two-dimensional model.
    last: Option<FinalField>,
    two_dimensional: bool,
    checkpoint_writer: CheckpointWriter<'a>,
    /// Checkpoint to continue from.
    resume: Option<Vec<u8>>,
}

impl<'a> Task<'a> {
    /// Reads the case and makes the folder; `say` gets the notes about checkpoints.
    pub fn new(
        options: &'a Run,
        virtual_files: &VirtualFiles,
        stop: &'a AtomicBool,
        say: &dyn Fn(&str),
    ) -> Result<Self, Failure> {
        let document = virtual_files.read(&options.case)?;
        let scenario = case::scenario(&document)?;
        let chosen = model::choose(options.model.as_deref(), &scenario)?;
        let model = chosen.model;
        check_use(options, model)?;
        check_seeds(options, model, &scenario)?;
        check_mesh(options, model, &scenario)?;
        let start = start(options, model, &scenario, say)?;
        // A model that does not apply makes no folder.
        let out = options.out.as_deref();
        let out = out.filter(|_| model::applicability(model, &scenario).is_ok());
        let folder = RunFolder::wanted(out, Some(&document), options.figures.formats())?;
        let fields = match out.filter(|_| model.has_fields()) {
            Some(out) => Some(Fields {
                series: series(options, out, start.as_ref().map(|(header, _)| header))?,
                last: None,
                two_dimensional: model.is_two_dimensional(),
                checkpoint_writer: CheckpointWriter::new(
                    out,
                    options.checkpoint.unwrap_or(CHECKPOINT_INTERVAL),
                    stop,
                ),
                resume: start.map(|(_, bytes)| bytes),
            }),
            None => None,
        };
        Ok(Self {
            options,
            scenario: Arc::new(scenario),
            chosen,
            folder,
            fields,
            axisymmetric: None,
            stop,
        })
    }

    /// The case.
    pub fn scenario(&self) -> &Arc<Scenario> {
        &self.scenario
    }

    /// Estimated cost of the runs of the model.
    pub fn estimate(&self) -> Estimate {
        let runs = f64::from(self.options.seeds.unwrap_or(1));
        cost::of_run(self.chosen.model, &self.scenario).times(runs)
    }

    /// Keeps the final fields of an axisymmetric answer, where there is a folder for them.
    pub fn axisymmetric_frames(&mut self) -> impl FnMut(&Frame<'_>) + Send {
        let wanted = self.folder.is_some();
        let last = &mut self.axisymmetric;
        move |frame: &Frame<'_>| {
            if frame.last && wanted {
                *last = Some(FinalField::of(frame));
            }
        }
    }

    /// Executes the run. A run with checkpoints is stopped by its checkpoint writer alone.
    pub fn compute(&mut self, on_progress: ProgressCallback<'_>) -> Result<RunOutput, Failure> {
        let mesh = match self.options.mesh_tolerance {
            Some(tolerance) => Some(self.choose_mesh(tolerance, on_progress)?),
            None => None,
        };
        let by_checkpoint = self.fields.is_some();
        let runs = f64::from(self.options.seeds.unwrap_or(1));
        let mut report = |now: model::Progress| {
            let words = format!("{:.1} us, depth {:.3} mm", now.time * 1e6, now.depth * 1e3);
            match on_progress(now.fraction / runs, &words) {
                ControlFlow::Break(()) if !by_checkpoint => ControlFlow::Break(()),
                _ => ControlFlow::Continue(()),
            }
        };
        let result = match &mut self.fields {
            Some(fields) => fields.run(&self.chosen, &self.scenario, &mut report)?,
            None => {
                let mut report = |now: model::Progress| unless_stopped(self.stop, report(now));
                let mut control = Control {
                    record: self.folder.is_some() || !self.scenario.measured_curves.is_empty(),
                    progress: Some(&mut report),
                    ..Control::default()
                };
                self.chosen.run(&self.scenario, &mut control)?
            }
        };
        let result = match mesh {
            Some(mesh) => mesh.told(result),
            None => result,
        };
        let (model, scenario) = (self.chosen.model, &self.scenario);
        let of_seeds =
            |count| seeds::study(model, scenario, &result, count, self.stop, on_progress);
        let (seeds, seeds_stopped) = self.options.seeds.map(of_seeds).transpose()?.unzip();
        Ok(RunOutput {
            scenario: Arc::clone(&self.scenario),
            result: Arc::new(result),
            axisymmetric: None,
            seeds,
            seeds_stopped: seeds_stopped.unwrap_or(false),
        })
    }

    /// Takes a mesh within the tolerance.
    fn choose_mesh(
        &mut self,
        tolerance: f64,
        on_progress: ProgressCallback<'_>,
    ) -> Result<MeshChoice, Failure> {
        let mut report =
            |_: model::Progress| unless_stopped(self.stop, on_progress(0.0, "choice of the mesh"));
        let mut control = Control {
            progress: Some(&mut report),
            ..Control::default()
        };
        let mesh = choose_mesh(self.chosen.model, &self.scenario, tolerance, &mut control)?;
        self.scenario = Arc::new(mesh.scenario.clone());
        if let Some(folder) = &self.folder {
            folder.put_mesh(self.chosen.model.name(), &mesh.elements)?;
        }
        Ok(mesh)
    }

    /// Writes the results, if there is a folder; returns the files.
    pub fn write(
        &mut self,
        run_output: &RunOutput,
        report: &mut (dyn FnMut(f64, &str) + Send),
    ) -> Result<Vec<PathBuf>, Failure> {
        let (Some(folder), Some(out)) = (self.folder.take(), &self.options.out) else {
            return Ok(Vec::new());
        };
        let mut files = folder.write(
            &run_output.scenario,
            &run_output.result,
            &run_output.results(),
            self.options.units,
            report,
        )?;
        let has_answer = run_output.axisymmetric.as_ref();
        let has_answer = has_answer.is_some_and(|answer| answer.finest.is_some());
        if let Some(last) = self.axisymmetric.take().filter(|_| has_answer) {
            let quantity = FieldQuantity::default();
            let meshes = run_output
                .axisymmetric
                .iter()
                .flat_map(|answer| &answer.meshes);
            let cells = meshes.map(|mesh| mesh.cells_per_radius).max();
            let note = cells.map_or_else(String::new, |cells| format!("now, on {cells} cells"));
            let scenario = &run_output.scenario;
            files.extend(last.write_as(out, AXISYMMETRIC, &note, scenario, quantity)?);
        }
        if let Some(fields) = &mut self.fields {
            let (model, scenario) = (self.chosen.model, &run_output.scenario);
            let quantity = self.options.field.as_deref().and_then(FieldQuantity::named);
            let quantity = quantity.unwrap_or_else(|| FieldQuantity::of_case(model, scenario));
            let written = fields.write(self.options, quantity, out, scenario, report)?;
            files.extend(written);
            checkpoints::remove(out);
        }
        Ok(files)
    }
}

/// Series of fields, if it or an animation is requested.
fn series(
    options: &Run,
    out: &Path,
    start: Option<&Header>,
) -> Result<Option<FieldSeries>, Failure> {
    if !options.has_frames() {
        return Ok(None);
    }
    let most = usize::from(options.frames.unwrap_or(FRAMES));
    Ok(Some(match start {
        Some(header) => FieldSeries::resume(out, most, header.time)?,
        None => FieldSeries::create(out, most)?,
    }))
}

impl Fields<'_> {
    fn run(
        &mut self,
        chosen: &ChosenModel,
        scenario: &Scenario,
        report: &mut dyn FnMut(model::Progress) -> ControlFlow<()>,
    ) -> Result<RunResult, Failure> {
        let mut failure = None;
        let is_shown = self.two_dimensional || self.series.is_some();
        let Self {
            series,
            last,
            two_dimensional,
            ..
        } = self;
        let mut add = |frame: &Frame<'_>| {
            if frame.last && *two_dimensional {
                *last = Some(FinalField::of(frame));
            }
            match series.as_mut().map_or(Ok(()), |series| series.add(frame)) {
                Ok(()) => ControlFlow::Continue(()),
                Err(error) => {
                    failure = Some(Failure::from(error));
                    ControlFlow::Break(())
                }
            }
        };
        let mut control = Control {
            frames: is_shown.then_some(&mut add),
            checkpoints: Some(&mut self.checkpoint_writer),
            resume: self.resume.as_deref(),
            record: true,
            progress: Some(report),
        };
        let result = chosen.run(scenario, &mut control);
        match (failure.or(self.checkpoint_writer.failure.take()), result) {
            (Some(failure), _) => Err(failure),
            (None, Err(Error::Cancelled { time_us, .. })) if self.checkpoint_writer.stopped() => {
                Err(Failure::Stopped { time_us })
            }
            (None, result) => Ok(result?),
        }
    }

    /// Writes the final fields and the requested series and animation; returns the files.
    fn write(
        &mut self,
        options: &Run,
        quantity: FieldQuantity,
        out: &Path,
        scenario: &Scenario,
        report: &mut (dyn FnMut(f64, &str) + Send),
    ) -> Result<Vec<PathBuf>, Failure> {
        let mut files = Vec::new();
        if let Some(last) = self.last.take() {
            report(0.0, "drawing the field");
            files.extend(last.write(out, scenario, quantity)?);
        }
        let Some(series) = self.series.take() else {
            return Ok(files);
        };
        // Without pictures the option is refused.
        #[cfg(feature = "png")]
        if options.animation {
            let mut report = |part: f64| report(part, "drawing the animation");
            files.extend(percuss_report::animate(
                out,
                scenario,
                &series,
                quantity,
                &mut report,
            )?);
        }
        if options.dump {
            report(0.0, "writing dumps");
            files.push(percuss_report::write_dumps(out, &series)?);
        }
        if options.fields {
            files.push(series.collection());
        } else {
            series.discard();
        }
        Ok(files)
    }
}

/// Refuses options that would have no effect.
fn check_use(options: &Run, model: &dyn Model) -> Result<(), Failure> {
    let given = [
        ("--fields", options.fields),
        ("--animation", options.animation),
        ("--dump", options.dump),
        ("--frames", options.frames.is_some()),
        ("--field", options.field.is_some()),
        ("--checkpoint", options.checkpoint.is_some()),
        ("--resume", options.resume),
    ];
    #[cfg(not(feature = "png"))]
    for (option, given) in [
        ("`--animation`", options.animation),
        ("`--field`", options.field.is_some()),
    ] {
        if given {
            return Err(crate::commands::left_out::refuse(option, "png"));
        }
    }
    let useless = |what: &str, option: &str, models: &str| Failure::Usage {
        message: format!(
            "`{option}` has no effect with model `{}`, {what}",
            model.name()
        ),
        help: format!("remove `{option}` or give {models}"),
    };
    if let Some((option, _)) = given.iter().find(|(_, given)| *given)
        && !model.has_fields()
    {
        let what = "which does not step through time";
        return Err(useless(
            what,
            option,
            "`--model chain`, `--model fdm` or `--model axi`",
        ));
    }
    for (option, given) in [
        ("--animation", options.animation),
        ("--dump", options.dump),
        ("--field", options.field.is_some()),
    ] {
        if given && !model.is_two_dimensional() {
            let what = "whose fields are one-dimensional";
            return Err(useless(what, option, "`--model axi`"));
        }
    }
    if options.reference.is_some() && !axisymmetric::is_added_to(options.model.as_deref()) {
        let what = "to which no axisymmetric answer is added";
        return Err(useless(what, "--reference", "`--model chain`, or no model"));
    }
    if options.frames.is_some() && !options.has_frames() {
        return Err(Failure::Usage {
            message: "`--frames` has no effect without `--fields`, `--animation` or `--dump`"
                .to_owned(),
            help: "remove `--frames`, or add `--fields`, `--animation` or `--dump`".to_owned(),
        });
    }
    Ok(())
}

/// Refuses seeds of a model or a packing without any.
fn check_seeds(options: &Run, model: &dyn Model, scenario: &Scenario) -> Result<(), Failure> {
    let why = match model.name() {
        _ if options.seeds.is_none() => return Ok(()),
        "particles" if percuss::particles::has_seeds(scenario) => return Ok(()),
        "particles" => {
            "the packing of this case is \"hexagonal\", without random numbers".to_owned()
        }
        name => format!("model `{name}` has no packing of particles"),
    };
    Err(Failure::Usage {
        message: format!("`--seeds` has no effect: {why}"),
        help: "remove `--seeds`, or give `--model particles` and a case whose packing is \"irregular\"".to_owned(),
    })
}

/// Refuses a tolerance of the mesh error of a model without elements along a line.
fn check_mesh(options: &Run, model: &dyn Model, scenario: &Scenario) -> Result<(), Failure> {
    let has_elements = !model.is_two_dimensional() && model.refined(scenario, 1.0).is_some();
    if options.mesh_tolerance.is_none() || has_elements {
        return Ok(());
    }
    Err(Failure::Usage {
        message: format!(
            "`--mesh-tolerance` has no effect with model `{}`, which has no elements along a line",
            model.name()
        ),
        help: "remove `--mesh-tolerance`, or give `--model chain` or `--model fdm`; `--reference fine` has finer axisymmetric meshes".to_owned(),
    })
}

/// Checkpoint to continue from, if there is one and --resume is given.
fn start(
    options: &Run,
    model: &dyn Model,
    scenario: &Scenario,
    say: &dyn Fn(&str),
) -> Result<Option<(Header, Vec<u8>)>, Failure> {
    let Some(out) = options.out.as_deref().filter(|_| model.has_fields()) else {
        return Ok(None);
    };
    let shown = Path::display(out);
    let Some(bytes) = checkpoints::load(out)? else {
        if options.resume {
            say(&format!(
                "`{shown}` has no checkpoint; the run starts at the beginning"
            ));
        }
        return Ok(None);
    };
    let header = Header::read(&bytes, model.name(), scenario);
    if !options.resume {
        if let Ok(header) = header {
            say(&format!(
                "`{shown}` has a checkpoint of this case at {:.1} us; the run starts at the beginning; `--resume` continues",
                header.time * 1e6
            ));
        }
        return Ok(None);
    }
    let header = header?;
    say(&format!("continuing from {:.1} us", header.time * 1e6));
    Ok(Some((header, bytes)))
}
