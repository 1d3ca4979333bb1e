//! `percuss limit`: ballistic limits and V50.

mod reliance;
mod table;
mod values;

use std::path::{Path, PathBuf};

use clap::{Args, builder::PossibleValuesParser};
use percuss::{
    Scenario,
    axisymmetric::{self, ReferenceMeshes, Request},
    case,
    limit::{self, LimitOutcome, Limits, Observer, Range, Search, Tolerance},
    model::{Estimate, MODELS},
    v50::{self, Test, V50},
};
use serde::Serialize;

use crate::{
    by_models, cost,
    failure::Failure,
    figure_formats::FigureArgs,
    file_list::FileList,
    output,
    progress::Progress,
    response::{ProgressCallback, Response, VirtualFiles},
    run_folder::RunFolder,
    test_data::note_columns,
};

/// Runs of a search for a limit, for the estimate of its cost.
const RUNS: f64 = 20.0;

const LONG_ABOUT: &str = "\
Find the ballistic limit of a case: the impact velocity above which the target
is perforated. Every model that predicts perforation gets the same search: 17
velocities across a range, then bisection between the highest velocity with a
partial and the lowest with a complete penetration, down to the tolerance. Above
the limit the residual velocities are computed, and the curve of Lambert and
Jonas, v_r = a (v^p - v_bl^p)^(1/p), is fitted to them with v_bl fixed at the
limit. The output gives the reason where a model does not apply or has no limit
in the range.

The axisymmetric model `axi` is searched with on 3, 4 and 6 cells per radius,
with --reference fine on 6, 8 and 12: its limit is extrapolated to fine meshes,
with its discretisation uncertainty. Its brackets are half a per cent wide at
least, and it is left out with --fast or --model, and where it is expected to
take more than 60 s of processor time, unless --reference is given.

The rear face of a plate is free unless the case gives `target.back_face`;
behind a fixed one perforation is impossible. The first line has the limit to
use: that of the recommended model, marked with ★, if its errors on published
limits of the same kind are known or the nose is flat, otherwise the
axisymmetric one. `recht_ipson` and `lambert_jonas` need a limit as input: only
their residual velocities are listed.

With --tests FILE.csv V50, the velocity at which the probability of perforation
is 50 %, is estimated from test results: by maximum likelihood (probit and
logit) with the 95 % likelihood-ratio interval, and as the mean of equal numbers
of the highest partial and the lowest complete penetrations (extremes). The file
has one row per test and the columns impact_velocity_m_s, or another unit such
as \"velocity (ft/s)\", and perforated (yes or no, or CP or PP). The case is then
optional.

With --out DIR a copy of the case (case-as-run.toml), limit.json, the tables
limit.csv (one row per model) and curve.csv (one row per velocity), and the
figures (limit and v50, as SVG and PNG) are written to DIR, which is made if it
does not exist.";

const AFTER_HELP: &str = "\
Examples:
  percuss limit my-case/scenario.toml
  percuss limit my-case/scenario.toml --velocity 100..400 --tolerance \"0.2 %\"
  percuss limit my-case/scenario.toml --model plugging --out results
  percuss limit my-case/scenario.toml --fast
  percuss limit my-case/scenario.toml --velocity 100..400 --reference fine
  percuss limit --tests tests.csv

Exit codes: 0 ok, 2 bad input or no model applies, 4 a file could not be read or
written";

/// Find the ballistic limit of a case, or V50 from test results
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Limit {
    /// Case file; `percuss new` writes one to start from
    #[arg(value_name = "CASE.toml", required_unless_present = "tests")]
    case: Option<PathBuf>,
    /// Search with this model only; may be given several times. `axi` runs on the mesh of the case when it is named
    #[arg(long, value_name = "NAME", requires = "case")]
    #[arg(value_parser = PossibleValuesParser::new(MODELS.iter().map(|model| model.name())))]
    model: Vec<String>,
    /// Range of impact velocities to search, in m/s unless a unit follows
    // A negative velocity gets the error that names the allowed range.
    #[arg(long, value_name = "FROM..TO", default_value = "0..2000", requires = "case", value_parser = values::range)]
    #[arg(allow_hyphen_values = true)]
    velocity: Range,
    /// Largest bracket between partial and complete penetration: a velocity, or a percentage
    #[arg(long, value_name = "SPEED", default_value = "0.1 m/s", requires = "case", value_parser = values::tolerance)]
    #[arg(allow_hyphen_values = true)]
    tolerance: Tolerance,
    /// Residual velocities to compute above the limit, up to 2.5 times the limit; 0 for none
    #[arg(long, value_name = "COUNT", default_value = "12", requires = "case")]
    #[arg(value_parser = values::points, allow_hyphen_values = true)]
    points: u16,
    /// Meshes of the axisymmetric limit, whatever they cost [default: standard, within 60 s of processor time]
    #[arg(
        long,
        value_name = "MESHES",
        requires = "case",
        conflicts_with = "fast"
    )]
    #[arg(value_parser = PossibleValuesParser::new(ReferenceMeshes::ALL.map(ReferenceMeshes::name)))]
    reference: Option<String>,
    /// Leave out the axisymmetric limit
    #[arg(long, requires = "case")]
    fast: bool,
    /// CSV file of tests with partial or complete penetration
    #[arg(long, value_name = "FILE.csv")]
    tests: Option<PathBuf>,
    /// Largest span of the velocities that V50 is the mean of [default: 125 ft/s]
    #[arg(long, value_name = "SPEED", requires = "tests", value_parser = values::span)]
    #[arg(allow_hyphen_values = true)]
    span: Option<f64>,
    /// Print one JSON object and nothing else on standard output
    #[arg(long)]
    json: bool,
    /// Write numbers and figures to a folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    pub figures: FigureArgs,
    /// No table and no progress: lines of NAME=VALUE pairs
    #[arg(long, short)]
    quiet: bool,
}

/// Output of `--json`. The names are stable.
#[derive(Serialize)]
struct LimitRecord<'a> {
    #[serde(flatten)]
    limits: Option<&'a Limits>,
    v50: Option<&'a V50>,
    tests: Option<&'a [Test]>,
}

/// Result of the command and the files that it wrote.
struct LimitOutput {
    case: Option<(Scenario, Limits)>,
    tests: Option<(Vec<Test>, V50)>,
    files: Vec<PathBuf>,
}

impl LimitOutput {
    fn record(&self) -> LimitRecord<'_> {
        LimitRecord {
            limits: self.case.as_ref().map(|(_, limits)| limits),
            v50: self.tests.as_ref().map(|(_, v50)| v50),
            tests: self.tests.as_ref().map(|(tests, _)| &**tests),
        }
    }
}

impl Limit {
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
        match &found.case {
            Some((_, limits)) if found.tests.is_none() && no_model_applies(limits) => {
                let mut reasons = table::reasons(limits);
                let axisymmetric = limits.axisymmetric.as_ref();
                let reason = axisymmetric.and_then(|limit| limit.reason.as_ref());
                reasons.extend(reason.map(|reason| format!("{}: {reason}", axisymmetric::MODEL)));
                Err(Failure::NoResult(reasons))
            }
            _ => Ok(()),
        }
    }

    /// Output of --json; a case to which no model applies is no failure here.
    pub fn execute(
        &self,
        virtual_files: &VirtualFiles,
        on_progress: ProgressCallback<'_>,
    ) -> Result<Response, Failure> {
        let found = self.find(virtual_files, on_progress, &|_| ())?;
        Response::json_of(&found.record(), found.files.clone())
    }

    fn find(
        &self,
        virtual_files: &VirtualFiles,
        on_progress: ProgressCallback<'_>,
        tell: &dyn Fn(Estimate),
    ) -> Result<LimitOutput, Failure> {
        super::axi_named::refuse_with_fast(self.fast, &self.model)?;
        let document = self.case.as_ref().map(|path| virtual_files.read(path));
        let document = document.transpose()?;
        let scenario = document.as_ref().map(case::scenario).transpose()?;
        let tests = self.tests.as_ref().map(v50::read).transpose()?;
        let folder = RunFolder::wanted(
            self.out.as_deref(),
            document.as_ref(),
            self.figures.formats(),
        )?;
        let tests = tests.map(|file| {
            if let Some(path) = &self.tests {
                note_columns(path, &file);
            }
            let tests = file.tests;
            let v50 = v50::estimate(&tests, self.span.unwrap_or(v50::SPAN));
            (tests, v50)
        });
        let case = match scenario {
            Some(scenario) => {
                let models = by_models::named(&self.model);
                let of_models = models.iter().map(|model| cost::of_run(*model, &scenario));
                tell(of_models.sum::<Estimate>().times(RUNS));
                let limits = self.search(&scenario, on_progress)?;
                Some((scenario, limits))
            }
            None => None,
        };
        let mut found = LimitOutput {
            case,
            tests,
            files: Vec::new(),
        };
        if let Some(folder) = folder {
            found.files = self.write(folder, &found)?;
        }
        Ok(found)
    }

    fn search(
        &self,
        scenario: &Scenario,
        on_progress: ProgressCallback<'_>,
    ) -> Result<Limits, Failure> {
        let models = by_models::named(&self.model);
        let search = Search {
            range: self.velocity,
            tolerance: self.tolerance,
            points: usize::from(self.points),
            axisymmetric: self.axisymmetric(),
        };
        let mut report = |now: limit::Progress| {
            let words = format!("{} runs", now.finished);
            on_progress(now.fraction, &words)
        };
        let mut watch = Observer {
            progress: Some(&mut report),
        };
        Ok(limit::limits(&models, scenario, &search, &mut watch)?)
    }

    /// Axisymmetric limit that is wanted.
    fn axisymmetric(&self) -> Option<Request> {
        let named = self.reference.as_deref().and_then(ReferenceMeshes::named);
        match named {
            Some(meshes) => Some(Request::whole(meshes)),
            None if self.fast || !self.model.is_empty() => None,
            None => Some(Request::unasked()),
        }
    }

    fn write(&self, mut folder: RunFolder, found: &LimitOutput) -> Result<Vec<PathBuf>, Failure> {
        folder.put("limit.json", output::json(&found.record())?.as_bytes())?;
        if let Some((scenario, limits)) = &found.case {
            folder.add(percuss_report::write_limits(folder.path(), limits)?);
            let figure = percuss_report::limit_figure(scenario, limits);
            folder.add_figures(figure.as_slice())?;
        }
        if let Some((tests, v50)) = &found.tests {
            let name = self.tests.as_deref().map_or_else(String::new, stem);
            folder.add_figures(&[percuss_report::v50_figure(&name, tests, v50)])?;
        }
        Ok(folder.written())
    }

    fn print(&self, found: &LimitOutput) -> Result<(), Failure> {
        let written = FileList::new(&found.files);
        if self.json {
            return written.print_json(&found.record(), self.quiet);
        }
        let mut text = String::new();
        if self.quiet {
            text += &found
                .case
                .as_ref()
                .map_or_else(String::new, |(_, limits)| table::lines(limits));
            text += &found
                .tests
                .as_ref()
                .map_or_else(String::new, |(_, v50)| table::v50_lines(v50));
            return output::print(&text);
        }
        if let Some((scenario, limits)) = &found.case {
            // Without a result there are reasons only, and they are the error.
            if found.tests.is_some() || !no_model_applies(limits) {
                text += &table::head(scenario, limits, self.tolerance);
                text += &table::text(limits);
            }
        }
        if let (Some((_, v50)), Some(path)) = (&found.tests, &self.tests) {
            text += &table::v50_text(&path.display().to_string(), v50);
        }
        written.print_under(text)
    }
}

fn stem(path: &Path) -> String {
    path.file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned()
}

/// Whether every model is inapplicable or failed; partial or complete penetration in the whole range is a result.
fn no_model_applies(limits: &Limits) -> bool {
    let silent = [LimitOutcome::NotApplicable, LimitOutcome::Failed];
    let meshes = limits.axisymmetric.iter().flat_map(|limit| &limit.meshes);
    let results = limits.results.iter().map(|limit| limit.outcome);
    results
        .chain(meshes.map(|mesh| mesh.outcome))
        .all(|outcome| silent.contains(&outcome))
}
