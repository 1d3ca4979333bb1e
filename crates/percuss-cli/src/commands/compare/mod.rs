//! `percuss compare`: all models on one case.

mod curves;
mod head;
mod messages;
mod missing;
mod quantities;
mod single;
mod sweep;
#[cfg(test)]
mod tests;
mod warnings;

use std::path::PathBuf;

use clap::{Args, builder::PossibleValuesParser};
use percuss::{
    Scenario,
    axisymmetric::{ReferenceMeshes, Request},
    case,
    compare::{self, Comparison, Observer},
    model::{self, CostClass, Estimate, MODELS},
    units::UnitSystem,
};

use crate::{
    by_models, cost,
    failure::Failure,
    figure_formats::FigureArgs,
    file_list::FileList,
    output,
    progress::Progress,
    response::{ProgressCallback, Response, VirtualFiles},
    run_folder::RunFolder,
    speeds::Speeds,
    terminal,
    unit_system::unit_system,
};

const LONG_ABOUT: &str = "\
Run every model on a case and compare their results: impact regime, recommended
model with the reason, results of each model, differences from the experiments
of the case, and the reason where a model does not apply. A model that fails
does not stop the others.

The axisymmetric model `axi` runs on 3, 4 and 6 cells per radius: its number is
the limit of the meshes, its range the discretisation uncertainty. It is left
out with --fast, where it costs more than 60 s of processor time, and at several
velocities unless --reference asks for it.

With --velocity the case is run at other impact velocities:
  --velocity 200..1500:27         27 velocities, 200 and 1500 included
  --velocity \"0.2..1.5 km/s:27\"   the same, in another unit
  --velocity 200,300,400          a list
  --velocity 230                  one velocity
  --velocity experiments          those of the case's [[experiments]]

With --quiet one line of NAME=VALUE pairs is printed per velocity and model.

With --out DIR a copy of the case (case-as-run.toml), compare.json, the numbers
(compare.csv and compare.parquet) and the figure (compare.svg and compare.png)
are written to DIR, which is made if it does not exist.";

const AFTER_HELP: &str = "\
Examples:
  percuss compare my-case/scenario.toml
  percuss compare my-case/scenario.toml --velocity 200..1500:27 --out results
  percuss compare my-case/scenario.toml --velocity 200,400,600 --reference fine
  percuss compare my-case/scenario.toml --model chain --json

Exit codes: 0 ok, 2 bad input or no model gives a result, 4 a file could not be
read or written";

/// Run every model on a case and compare them
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Compare {
    /// Case file; `percuss new` writes one to start from
    #[arg(value_name = "CASE.toml")]
    case: PathBuf,
    /// Impact velocities: FROM..TO:COUNT, a list, one value, or `experiments`
    // A negative velocity gets the error that names the allowed range.
    #[arg(long, value_name = "SPEEDS", allow_hyphen_values = true)]
    velocity: Option<Speeds>,
    /// Compare this model only; may be given several times. `axi` runs on the mesh of the case when it is named
    #[arg(long, value_name = "NAME")]
    #[arg(value_parser = PossibleValuesParser::new(MODELS.iter().map(|model| model.name())))]
    model: Vec<String>,
    /// Meshes of the axisymmetric model, whatever they cost [default: standard at one velocity, within 60 s of processor time]
    #[arg(long, value_name = "MESHES", conflicts_with_all = ["fast", "model"])]
    #[arg(value_parser = PossibleValuesParser::new(ReferenceMeshes::ALL.map(ReferenceMeshes::name)))]
    reference: Option<String>,
    /// Leave out the axisymmetric model
    #[arg(long)]
    fast: bool,
    /// Print one JSON object and nothing else on standard output
    #[arg(long)]
    json: bool,
    /// Write numbers and figure to a folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    pub figures: FigureArgs,
    /// Unit system of compare.csv and compare.parquet [default: mm, m/s]
    #[arg(long, value_name = "SYSTEM", requires = "out", value_parser = unit_system())]
    units: Option<UnitSystem>,
    /// No table and no progress: lines of NAME=VALUE pairs
    #[arg(long, short)]
    quiet: bool,
}

/// Result of the command and the files that it wrote.
struct ComparisonOutput {
    scenario: Scenario,
    comparison: Comparison,
    files: Vec<PathBuf>,
}

impl Compare {
    pub fn run(&self) -> Result<(), Failure> {
        let mut progress = Progress::new(!self.quiet);
        let found = self.find(
            &VirtualFiles::default(),
            &mut progress.callback(),
            &|cost| cost::tell(cost, self.quiet),
        );
        progress.finish();
        let found = found?;
        self.print(&found)?;
        match found.comparison.has_results() {
            true => Ok(()),
            false => Err(Failure::NoResult(missing::reasons(&found.comparison))),
        }
    }

    /// Output of --json; a case without any result is no failure here.
    pub fn execute(
        &self,
        virtual_files: &VirtualFiles,
        on_progress: ProgressCallback<'_>,
    ) -> Result<Response, Failure> {
        let found = self.find(virtual_files, on_progress, &|_| ())?;
        Response::json_of(&found.comparison, found.files)
    }

    fn find(
        &self,
        virtual_files: &VirtualFiles,
        on_progress: ProgressCallback<'_>,
        tell: &dyn Fn(Estimate),
    ) -> Result<ComparisonOutput, Failure> {
        super::axi_named::refuse_with_fast(self.fast, &self.model)?;
        let document = virtual_files.read(&self.case)?;
        let scenario = case::scenario(&document)?;
        let speeds = self.speeds(&scenario)?;
        let folder =
            RunFolder::wanted(self.out.as_deref(), Some(&document), self.figures.formats())?;
        let models = by_models::named(&self.model);
        let of_models = models.iter().map(|model| cost::of_run(*model, &scenario));
        tell(of_models.sum::<Estimate>().times(speeds.len() as f64));
        let comparison = self.compute(&scenario, &speeds, on_progress)?;
        let files = match folder {
            Some(folder) => folder.write_comparison(&scenario, &comparison, self.units)?,
            None => Vec::new(),
        };
        Ok(ComparisonOutput {
            scenario,
            comparison,
            files,
        })
    }

    fn compute(
        &self,
        scenario: &Scenario,
        speeds: &[f64],
        on_progress: ProgressCallback<'_>,
    ) -> Result<Comparison, Failure> {
        let models = by_models::named(&self.model);
        let mut report = |now: compare::Progress| {
            let words = format!("{} of {} runs", now.finished, now.total);
            on_progress(now.fraction, &words)
        };
        let mut watch = Observer {
            progress: Some(&mut report),
        };
        let axisymmetric = self.axisymmetric(speeds);
        Ok(compare::compare(
            &models,
            axisymmetric,
            scenario,
            speeds,
            &mut watch,
        )?)
    }

    /// Axisymmetric answers that are wanted.
    fn axisymmetric(&self, speeds: &[f64]) -> Option<Request> {
        let named = self.reference.as_deref().and_then(ReferenceMeshes::named);
        match named {
            Some(meshes) => Some(Request::whole(meshes)),
            None if self.fast || !self.model.is_empty() || speeds.len() > 1 => None,
            None => Some(Request::unasked()),
        }
    }

    fn speeds(&self, scenario: &Scenario) -> Result<Vec<f64>, Failure> {
        match &self.velocity {
            None => Ok(vec![scenario.impact_velocity]),
            Some(speeds) => speeds.of(scenario),
        }
    }

    /// Line that names the axisymmetric model where it applies and was not run.
    fn left_out(&self, scenario: &Scenario, comparison: &Comparison) -> String {
        let axi = MODELS
            .iter()
            .find(|model| model.cost() == CostClass::Minutes);
        let applies = axi.is_some_and(|axi| {
            model::applicability(*axi, scenario).is_ok()
                && !comparison.models().contains(&axi.name())
        });
        if !self.model.is_empty() || !applies {
            return String::new();
        }
        let line = "not run: `axi`; `--reference standard` runs it, about a second per velocity for a short rod.";
        format!("{}\n", terminal::wrap(line, terminal::width(), 0))
    }

    fn print(&self, found: &ComparisonOutput) -> Result<(), Failure> {
        let ComparisonOutput {
            scenario,
            comparison,
            files,
        } = found;
        let written = FileList::new(files);
        if self.json {
            return written.print_json(comparison, self.quiet);
        }
        if self.quiet {
            return output::print(&single::lines(comparison));
        }
        // Without a result there are reasons only, and they are the error.
        let mut text = String::new();
        if comparison.has_results() {
            text += &head::text(scenario, comparison);
            text += &match comparison.regime.len() {
                1 => single::text(comparison),
                _ => sweep::text(comparison),
            };
            text += &curves::text(scenario, comparison);
            text += &quantities::elsewhere(comparison);
            text += &warnings::text(comparison);
            text += &missing::text(comparison);
            text += &self.left_out(scenario, comparison);
            text += &format!(
                "{}\n",
                terminal::wrap(
                    "`percuss run CASE.toml --model NAME` prints all results of one model, `percuss models NAME` its range of validity.",
                    terminal::width(),
                    0
                )
            );
        }
        written.print_under(text)
    }
}
