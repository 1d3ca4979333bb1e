//! `percuss converge`: mesh convergence of a case.

use std::{
    ops::ControlFlow,
    path::PathBuf,
    sync::atomic::{AtomicBool, Ordering},
};

use clap::{Args, builder::PossibleValuesParser};
use percuss::{
    Error, Scenario, case,
    converge::{self, ConvergenceStatus, MeshStudy},
    model::{self, Control, DEFAULT_MODEL, Estimate, MODELS, Model},
    units::significant,
};
use percuss_report::{
    convergence_figure,
    table::{Column, Table, number},
};

use crate::{
    cost,
    failure::Failure,
    figure_formats::FigureArgs,
    file_list::FileList,
    output,
    progress::Progress,
    response::{ProgressCallback, Response, VirtualFiles},
    run_folder::RunFolder,
    table::blocks,
    terminal::{bold, width, wrap},
    whole_numbers::from_to,
    workers::{self, unless_stopped},
};

const LONG_ABOUT: &str = "\
Run a case on successively finer meshes, each with twice the elements of the
last, and assess the mesh convergence of its results: observed order, value
extrapolated to zero element length (Richardson) and grid-convergence index,
the uncertainty of the finest mesh with a factor of safety of 1.25.

Convergence is confirmed by two successive observed orders that agree within
0.5 and lie between 0.5 and 2.2. That takes four meshes: with three, or with
orders that change, the order is printed without an uncertainty.

A result does not converge if its differences do not decrease, or if its
extrapolated value is negligible against its value.

With --out DIR the study is written as convergence.json and its figures as SVG
and PNG. Ctrl-C ends it with the meshes that are complete.";

const AFTER_HELP: &str = "\
Examples:
  percuss converge my-case/scenario.toml
  percuss converge my-case/scenario.toml --levels 5 --out convergence
  percuss converge my-case/scenario.toml --json

Exit codes: 0 ok, 2 bad input or a model that does not apply, 3 numerical
failure, 4 a file could not be read or written, 130 stopped";

/// Refine the mesh of a case and assess its convergence
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Converge {
    /// Case file; its mesh is the coarsest one
    #[arg(value_name = "CASE.toml")]
    case: PathBuf,
    /// Model to compute with; `percuss models` describes them
    #[arg(long, value_name = "NAME", default_value = DEFAULT_MODEL)]
    #[arg(value_parser = PossibleValuesParser::new(MODELS.iter().map(|model| model.name())))]
    model: String,
    /// Number of meshes; the work grows fourfold with each
    #[arg(long, value_name = "N", default_value_t = 4)]
    #[arg(value_parser = from_to::<u32>(3, 8, "a number of meshes"))]
    levels: u32,
    /// Print one JSON object and nothing else on standard output
    #[arg(long)]
    json: bool,
    /// Write the study and its figures to a folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    pub figures: FigureArgs,
}

/// Result of the command and the files that it wrote; a study that was stopped has less meshes.
struct ConvergenceOutput {
    scenario: Scenario,
    study: MeshStudy,
    files: Vec<PathBuf>,
}

impl Converge {
    pub fn run(&self) -> Result<(), Failure> {
        let stop = workers::stop_on_request();
        let mut progress = Progress::new(true);
        let mut report = |part: f64, words: &str| {
            progress.update(part, words);
            unless_stopped(&stop, ControlFlow::Continue(()))
        };
        let found = self.find(&VirtualFiles::default(), &mut report, &stop, &|cost| {
            cost::tell(cost, false);
        });
        progress.finish();
        let found = found?;
        self.print(&found)?;
        match found.study.meshes.len() {
            complete if complete < self.levels as usize => Err(Failure::StudyStopped {
                complete,
                wanted: self.levels,
                runs: "meshes",
            }),
            _ => Ok(()),
        }
    }

    fn print(&self, found: &ConvergenceOutput) -> Result<(), Failure> {
        let ConvergenceOutput {
            scenario,
            study,
            files,
        } = found;
        if self.json {
            return output::print_json(study);
        }
        let mut text = format!(
            "{}\n{}\n\n",
            bold(format!("Convergence of {}", scenario.name)),
            wrap(
                &match self.model.as_str() {
                    "chain" => {
                        let scheme = scenario.options.chain.scheme.name();
                        format!("model chain, scheme {scheme}")
                    }
                    other => format!("model {other}"),
                },
                width(),
                0
            )
        );
        text += &table(study);
        text += &statuses(study);
        FileList::new(files).print_under(text)
    }

    /// Output of --json.
    pub fn execute(
        &self,
        virtual_files: &VirtualFiles,
        on_progress: ProgressCallback<'_>,
    ) -> Result<Response, Failure> {
        let found = self.find(virtual_files, on_progress, &AtomicBool::new(false), &|_| ())?;
        Response::json_of(&found.study, found.files)
    }

    fn find(
        &self,
        virtual_files: &VirtualFiles,
        on_progress: ProgressCallback<'_>,
        stop: &AtomicBool,
        tell: &dyn Fn(Estimate),
    ) -> Result<ConvergenceOutput, Failure> {
        let scenario = case::scenario(&virtual_files.read(&self.case)?)?;
        let model = model::model(&self.model)?;
        let mut folder = RunFolder::wanted(self.out.as_deref(), None, self.figures.formats())?;
        let meshes =
            (0..self.levels).filter_map(|level| model.refined(&scenario, f64::from(1 << level)));
        tell(meshes.map(|mesh| cost::of_run(model, &mesh)).sum());
        let study = self.compute(model, &scenario, on_progress, stop)?;
        if let Some(folder) = &mut folder {
            folder.put("convergence.json", output::json(&study)?.as_bytes())?;
            let figures: Vec<_> = (0..study.quantities.len())
                .filter_map(|i| convergence_figure(scenario.heading(), &study, i))
                .collect();
            folder.add_figures(&figures)?;
        }
        Ok(ConvergenceOutput {
            scenario,
            study,
            files: folder.map_or_else(Vec::new, RunFolder::written),
        })
    }

    /// The study, of the meshes that are complete where the user stops it.
    fn compute(
        &self,
        model: &dyn Model,
        scenario: &Scenario,
        on_progress: ProgressCallback<'_>,
        stop: &AtomicBool,
    ) -> Result<MeshStudy, Failure> {
        let mut report = |now: model::Progress| {
            let words = format!("{:.1} us on the current mesh", now.time * 1e6);
            on_progress(now.fraction, &words)
        };
        let mut control = Control {
            record: false,
            progress: Some(&mut report),
            ..Control::default()
        };
        let mut results = Vec::new();
        let ended = converge::run_meshes(model, scenario, self.levels, &mut control, &mut results);
        match ended {
            Err(Error::Cancelled { .. }) if stop.load(Ordering::Relaxed) => {
                if results.is_empty() {
                    return Err(Failure::Interrupted("the study"));
                }
            }
            ended => ended?,
        }
        Ok(MeshStudy::new(scenario, &results))
    }
}

/// Meshes as rows, quantities as columns, and below them order, extrapolated value and grid-convergence index.
fn table(study: &MeshStudy) -> String {
    let numbers = |status: &ConvergenceStatus| {
        let (richardson, index) = match *status {
            ConvergenceStatus::Converging {
                richardson, index, ..
            } => (Some(richardson), Some(100.0 * index)),
            _ => (None, None),
        };
        let order = status.order().map(|order| format!("{order:.2}"));
        [
            order.unwrap_or_else(|| number(None, 0)),
            number(richardson, 5),
            number(index, 3),
        ]
    };
    let heading = match study
        .meshes
        .iter()
        .any(|mesh| mesh.cells_per_radius.is_some())
    {
        true => "cells per\nradius",
        false => "elements",
    };
    // Orders, extrapolated values and indices are below the meshes.
    let mut table = Table::of(&study.meshes)
        .words(heading, |mesh| match mesh.cells_per_radius {
            Some(cells) => cells.to_string(),
            None => format!("{}–{}", mesh.projectile_elements, mesh.target_elements),
        })
        .each(["order", "Richardson", "GCI [%]"], |rows, name| {
            rows.last(Some(name.to_owned()))
        })
        .numbers("steps", "", |mesh| mesh.steps.to_string())
        .table();
    table
        .columns
        .extend(study.quantities.iter().map(|quantity| {
            let values = quantity.values.iter().map(|value| significant(*value, 5));
            Column {
                heading: quantity.name.replace('_', "\n"),
                unit: quantity.unit.to_owned(),
                numbers: true,
                cells: values.chain(numbers(&quantity.status)).collect(),
            }
        }));
    blocks(&table)
}

fn statuses(study: &MeshStudy) -> String {
    study
        .quantities
        .iter()
        .map(|quantity| {
            let name = quantity.name.replace('_', " ");
            let line = format!("{name}: {}", study.describe(quantity));
            format!("{}\n", wrap(&line, width(), 2))
        })
        .collect()
}
