//! Sweep files.

use std::path::Path;

use super::{
    BatchKernel, Sweep,
    file::SweepFile,
    points::{MAX_RUNS, Points},
    sobol::MAX_DIMENSIONS,
    written_values::check_values,
};
use crate::{
    Error,
    case::{Document, Template},
    check::{Check, Diagnostic},
    error::nearest,
    inputs::{Axis, Design, resolve},
    lanes::LANES,
    model::{MODELS, model, why_unread},
};

const OTHER_MODEL: &str =
    "vary a number that the model reads, or name the model of that table under `model`";

/// Most runs in a block that is chosen by itself: one file of the result holds a block.
const LARGEST_BLOCK: u64 = 1024;
/// Blocks that there are at least, where there are as many runs: they are what threads share.
const BLOCKS: u64 = 64;
/// Runs that a block of runs computed side by side has at least, where there are as many: twice the lanes, as fewer leave them empty.
const SIDE_BY_SIDE: u64 = 2 * LANES as u64;

pub(super) fn load(path: &Path) -> Result<Sweep, Error> {
    let directory = path.parent().unwrap_or(Path::new(""));
    let mut sweep = read(&Document::read(path)?, |base| {
        Document::read(directory.join(base))
    })?;
    sweep.base = directory.join(&sweep.base);
    Ok(sweep)
}

/// Reads a sweep; `open` gives the case that it names.
pub(super) fn read(
    document: &Document,
    open: impl FnOnce(&Path) -> Result<Document, Error>,
) -> Result<Sweep, Error> {
    let file: SweepFile = document.parse()?;
    let mut diagnostics = Vec::new();
    let mut check = Check::new(&mut diagnostics);
    check_model(&file, &mut check);
    if file.parameter.is_empty() {
        let help = "write one under [[parameter]]: key = \"projectile.impact_velocity\" and values = [\"200 m/s\", \"230 m/s\"]";
        check.fail("parameter", "the sweep varies nothing", help);
    }
    let correlation = file.correlation.as_ref();
    let (axes, copula) = resolve(&file.parameter, correlation, file.design, &mut check);
    let runs = check_design(&file, &axes, &mut check);
    document.report(diagnostics)?;

    let base = open(&file.base).and_then(|case| Template::of(&case));
    let template = base.map_err(|error| match error {
        // The sweep names the file, so the place in the sweep is what a user has to look at.
        error @ Error::Read { .. } => {
            let (message, remedy) = error.message_and_help();
            let help = "the path of the base case is relative to the sweep file";
            let help = match remedy.as_str() {
                "" => help.to_owned(),
                remedy => format!("{remedy}; {help}"),
            };
            let diagnostic = Diagnostic::at("base", message, help).of_case_file();
            document.place(diagnostic).into()
        }
        other => other,
    })?;
    let model = model(&file.model)?;
    let mut diagnostics = Vec::new();
    let mut check = Check::new(&mut diagnostics);
    check_values(&axes, &template, &mut check);
    for (i, axis) in axes.iter().enumerate() {
        if let Some(why) = why_unread(model, &axis.key) {
            check.fail(&format!("parameter.{i}.key"), why, OTHER_MODEL);
        }
    }
    document.report(diagnostics)?;

    let canonical: toml::Table = document.parse()?;
    let mut sweep = Sweep {
        title: file.title,
        base: file.base,
        model,
        points: Points::new(file.design, runs, file.seed.unwrap_or(0), axes.len()),
        seed: file.seed.unwrap_or(0),
        block_size: 1,
        content: canonical.to_string(),
        axes,
        copula,
        template,
    };
    sweep.block_size = file.block_size.unwrap_or_else(|| block_size(&sweep));
    Ok(sweep)
}

/// Runs in a block where the file does not say: the file and the case alone decide, so that every machine has the same blocks.
fn block_size(sweep: &Sweep) -> u64 {
    let runs = sweep.runs();
    let first = sweep.run(0).scenario;
    let least = match first.is_ok_and(|first| BatchKernel::takes(sweep.model, &first)) {
        true => SIDE_BY_SIDE,
        false => 1,
    };
    let blocks = (runs / least).clamp(1, BLOCKS);
    runs.div_ceil(blocks).min(LARGEST_BLOCK)
}

fn check_model(file: &SweepFile, check: &mut Check<'_>) {
    if model(&file.model).is_err() {
        let names: Vec<&str> = MODELS.iter().map(|model| model.name()).collect();
        let near = nearest(&file.model, names.iter().copied())
            .map_or_else(String::new, |near| format!("did you mean `{near}`? "));
        check.fail(
            "model",
            format!("no model is named `{}`", file.model),
            format!("{near}models: {}", names.join(", ")),
        );
    }
}

/// Checks how the runs are chosen; returns their number.
fn check_design(file: &SweepFile, axes: &[Axis], check: &mut Check<'_>) -> u64 {
    let mut runs = file.samples.unwrap_or(1);
    match (file.design, file.samples) {
        (Design::Grid, Some(_)) => check.fail(
            "samples",
            "a grid has as many runs as its lists make",
            "remove samples, or use design = \"latin-hypercube\" or \"sobol\"",
        ),
        (Design::Grid, None) => {
            let counts = axes.iter().filter_map(Axis::count);
            runs = counts.fold(1, u64::saturating_mul);
            if runs > MAX_RUNS {
                let message = format!("the grid has more than {MAX_RUNS} runs");
                check.fail("design", message, "give fewer values");
            }
        }
        (_, None) => check.fail(
            "samples",
            "the number of runs is missing",
            "add samples = 1024, or as many as you want",
        ),
        (_, Some(samples)) if !(1..=MAX_RUNS).contains(&samples) => check.fail(
            "samples",
            format!("{samples} is out of range"),
            format!("allowed: 1 to {MAX_RUNS}"),
        ),
        _ => {}
    }
    if file.design == Design::Grid && file.seed.is_some() {
        check.fail("seed", "a grid draws nothing at random", "remove seed");
    }
    if file.design == Design::Sobol && file.parameter.len() > MAX_DIMENSIONS {
        check.fail(
            "parameter",
            format!(
                "{} parameters are more than there are Sobol' points for",
                file.parameter.len()
            ),
            format!("vary {MAX_DIMENSIONS} at most, or use design = \"latin-hypercube\""),
        );
    }
    if file
        .block_size
        .is_some_and(|size| !(1..=1 << 20).contains(&size))
    {
        check.fail(
            "block_size",
            "the block size is out of range",
            "allowed: 1 to 1048576",
        );
    }
    runs
}
