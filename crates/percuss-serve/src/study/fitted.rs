//! Calibration of parameters against the experiments of a case.

use std::{
    ops::ControlFlow,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

use percuss::{
    calibrate::{
        Calibrated, Fitted, Noise, Observations, Problem as Calibration, Sampling, Settings, Stage,
        Stages,
    },
    case::Document,
    units::shorten,
};
use percuss_report::{calibration, parameter_label};
use serde_json::json;

use super::{Job, Study, csv_files, runs::watched};
use crate::{events::pretty, problem::Problem, request::Fitting};

/// Most numbers that are fitted, and measured values that they are fitted to.
const MOST_FITTED: usize = 8;
const MOST_VALUES: usize = 64;
/// Ensembles that are sampled, and most steps of their walkers.
const ENSEMBLES: usize = 4;
const STEPS: std::ops::RangeInclusive<usize> = 4..=2400;
/// Name of the file of what is fitted.
const FILE: &str = "fit.toml";

pub(super) fn fitted(job: &Job<'_>) -> Result<Study, Problem> {
    let asked = job.asked;
    let case = job.read()?;
    let model = job.model(&case.scenario)?;
    if model.cost() == percuss::model::CostClass::Minutes {
        return Err(Problem::refused(
            format!(
                "the model `{}` takes too long for the many runs of a calibration",
                model.name()
            ),
            "select another model, or use `percuss calibrate`",
        ));
    }
    let Fitting {
        file,
        noise,
        steps,
        seed,
        hold_out,
    } = &asked.fit;
    let noise: Noise = noise.parse().map_err(|help: &str| {
        Problem::refused(format!("`{}` is no scatter", shorten(noise)), help)
    })?;
    if let Some(steps) = steps
        && !STEPS.contains(steps)
    {
        return Err(Problem::refused(
            format!("{steps} steps are out of range"),
            format!(
                "the page allows {} to {}; use `percuss calibrate` for more",
                STEPS.start(),
                STEPS.end()
            ),
        ));
    }
    let parameters = Fitted::read_with(FILE, |_| Ok(Document::new(FILE, file.as_str())))?;
    let mut observations = Observations::default();
    observations.add_case(&Document::new(asked.name(), case.text.as_str()))?;
    observations.hold_out(hold_out)?;
    few(parameters.len(), MOST_FITTED, "fitted numbers")?;
    few(observations.used.len(), MOST_VALUES, "measured values")?;
    let curves = observations.curves.iter().map(|set| set.curves.len());
    few(curves.sum(), MOST_VALUES, "measured curves")?;

    let ended = Arc::new(AtomicBool::new(false));
    let stages = Stages {
        sampled: steps.is_some(),
        ..Stages::default()
    };
    let hear = |stage: Stage, part: f64, runs: u64| {
        job.events
            .progress(stages.of_whole(stage, part), &stage.describe(runs));
        match ended.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    };
    let found = watched(job, &ended, || {
        let problem =
            Calibration::stoppable(model, parameters, observations, noise, Arc::clone(&ended))?;
        let sampling = steps.map(|steps| Sampling::of(&problem, ENSEMBLES, None, steps));
        let settings = Settings {
            sampling: sampling.transpose()?,
            seed: *seed,
        };
        Calibrated::of(&problem, &settings, None, &hear)
    })
    .map_err(|error| job.stop.problem(error))?;

    let texts = [
        Some(("calibration.json", pretty(&found))),
        found.toml().map(|text| ("material.toml", text)),
        Some((FILE, file.clone())),
    ];
    let texts = texts.into_iter().flatten();
    let files: Vec<_> = csv_files(calibration::tables(&found.calibration)?)
        .chain(texts.map(|(name, text)| (name.to_owned(), text)))
        .collect();
    let charts = calibration::charts(&found.calibration);
    let pictures = calibration::sample_figures(&found.calibration);
    let parameters = &found.calibration.parameters;
    let labels: Vec<String> = parameters
        .iter()
        .map(|parameter| parameter_label(&parameter.key, &parameter.unit))
        .collect();
    let record = json!({ "calibration": found, "labels": labels, "material": found.toml() });
    Ok(Study::new(record, &charts, files).with_pictures(pictures))
}

fn few(count: usize, most: usize, what: &str) -> Result<(), Problem> {
    match count <= most {
        true => Ok(()),
        false => Err(Problem::refused(
            format!("there are {count} {what}"),
            format!("the page allows up to {most}; use `percuss calibrate` for more"),
        )),
    }
}
