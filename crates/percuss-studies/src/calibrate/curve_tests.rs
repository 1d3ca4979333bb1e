//! Calibration on curves against closed forms, by a model whose curve is a straight line.

use std::{fmt::Write, ops::ControlFlow};

use nalgebra::{Matrix2, Vector2};
use serde::Deserialize;

use super::*;
use crate::{
    Refusal, Scenario,
    case::Document,
    history::{History, Sample as HistorySample},
    model::{Control, Model},
    outcome::{Outcome, RunResult, Termination},
    sweep,
    validity::ValidityDomain,
};

/// The curve `depth = a + b t/T` with a and b in mm and T = 100 us, and the depth `a + b` at the end.
struct Line;

#[derive(Debug, Clone, Copy, Default, Deserialize)]
struct Numbers {
    a: f64,
    b: f64,
}

impl Model for Line {
    fn name(&self) -> &'static str {
        "line"
    }

    fn summary(&self) -> &'static str {
        "straight line"
    }

    fn validity(&self) -> &'static ValidityDomain {
        const {
            &ValidityDomain {
                predicts: &[crate::outcome::BandQuantity::DepthOfPenetration],
                ..ValidityDomain::OPEN
            }
        }
    }

    fn not_applicable(&self, _: &Scenario) -> Option<Refusal> {
        None
    }

    fn run(&self, scenario: &Scenario, _: &mut Control<'_>) -> Result<RunResult, crate::Error> {
        let Numbers { a, b } = scenario.extensions.read("line")?;
        let mut result = RunResult::new(self.name(), "", Outcome::AtRest, Termination::ClosedForm);
        result.depth_of_penetration = Some(1e-3 * (a + b));
        let sample = |part: f64| {
            let mut sample = HistorySample::default();
            sample.time = 1e-4 * part;
            sample.depth = 1e-3 * (a + b * part);
            sample
        };
        result.history = Some(History {
            samples: [0.0, 0.3, 1.0].map(sample).to_vec(),
            ..History::default()
        });
        Ok(result)
    }
}

const CASE: &str = "projectile = { material = 'copper', length = '20 mm', diameter = '5 mm', impact_velocity = '200 m/s' }\n\
                    target = { material = 'aluminium-2024-t351', thickness = 'semi-infinite' }\n\
                    extensions.line = { a = 1.0, b = 1.0 }\n";
const FLAT: [&str; 2] = ["extensions.line.a=-100..100", "extensions.line.b=-100..100"];
const TRUTH: [f64; 2] = [5.0, 3.0];
const GO_ON: Observer<'static> = &|_, _, _| ControlFlow::Continue(());
const NO_SAMPLE: Settings = Settings {
    sampling: None,
    seed: 0,
};

/// A standard normal number.
fn normal(seed: u64, index: usize) -> f64 {
    let bits = sweep::bits(sweep::stream(seed, 0xc0de, 0), index as u64);
    sweep::score(((bits >> 11) as f64 + 0.5) / (1_u64 << 53) as f64)
}

/// Errors of a standard deviation with an exponential autocorrelation, in equal steps of a part of the correlation time.
fn errors(seed: u64, count: usize, deviation: f64, steps_over_time: f64) -> Vec<f64> {
    let rho = (-steps_over_time).exp();
    let mut error = normal(seed, 0);
    let next = |index: usize| {
        if index > 0 {
            error = rho * error + (1.0 - rho * rho).sqrt() * normal(seed, index);
        }
        deviation * error
    };
    (0..count).map(next).collect()
}

/// A table of the line with the true numbers and errors over its time.
fn table(errors: &[f64]) -> String {
    let steps = (errors.len() - 1) as f64;
    let mut text = "time_us,depth_mm\n".to_owned();
    for (i, error) in errors.iter().enumerate() {
        let part = i as f64 / steps;
        let _ = writeln!(
            text,
            "{:?},{:?}",
            100.0 * part,
            TRUTH[0] + TRUTH[1] * part + error
        );
    }
    text
}

fn case(keys: &str, errors: &[f64], more: &str) -> Document {
    let curve = format!(
        "[[measured_curves]]\n{keys}\ncsv = '''\n{}'''\n",
        table(errors)
    );
    Document::new("case", format!("{CASE}{more}{curve}"))
}

fn problem(documents: &[Document], fitted: &[&str], noise: Noise) -> Result<Problem, crate::Error> {
    let mut observations = Observations::default();
    for document in documents {
        observations.add_case(document)?;
    }
    let fitted = fitted.iter().flat_map(|text| Fitted::read(text).unwrap());
    Problem::new(&Line, fitted.collect(), observations, noise)
}

/// Posterior mean and covariance of a and b for errors of one standard deviation, each value counting as `weight` ones; the prior has the
/// information of `more`.
fn exact(
    errors: &[f64],
    weight: f64,
    deviation: f64,
    more: (Matrix2<f64>, Vector2<f64>),
) -> (Vector2<f64>, Matrix2<f64>) {
    let steps = (errors.len() - 1) as f64;
    let (mut information, mut score) = more;
    for (i, error) in errors.iter().enumerate() {
        let part = i as f64 / steps;
        let row = Vector2::new(1.0, part);
        let factor = weight / deviation.powi(2);
        information += factor * row * row.transpose();
        score += factor * (TRUTH[0] + TRUTH[1] * part + error) * row;
    }
    let covariance = information.try_inverse().unwrap();
    (covariance * score, covariance)
}

const NO_PRIOR: (Matrix2<f64>, Vector2<f64>) =
    (Matrix2::new(0.0, 0.0, 0.0, 0.0), Vector2::new(0.0, 0.0));

#[test]
fn the_posterior_of_a_line_is_the_closed_form() {
    let errors = errors(3, 101, 0.2, 0.25);
    // 1 us between the values and a correlation time of 4 us.
    let weight = 0.125_f64.tanh();
    let keys = "uncertainty = '0.2 mm'\ncorrelation_time = '4 us'";
    let problem = problem(&[case(keys, &errors, "")], &FLAT, Noise::Stated).unwrap();
    let settings = Settings {
        sampling: Some(Sampling {
            ensembles: 4,
            walkers: 16,
            steps: 2000,
            burn_in: 500,
        }),
        seed: 1,
    };
    let found = run(&problem, &settings, GO_ON).unwrap();
    let (mean, covariance) = exact(&errors, weight, 0.2, NO_PRIOR);
    let curve = &found.curves[0];
    assert!(
        (curve.effective_values - 101.0 * weight).abs() < 1e-9,
        "{}",
        curve.effective_values
    );
    for (i, parameter) in found.parameters.iter().enumerate() {
        let deviation = covariance[(i, i)].sqrt();
        assert!(
            (parameter.best - mean[i]).abs() < 1e-5 * deviation,
            "{parameter:?} {}",
            mean[i]
        );
        let error = parameter.standard_error.unwrap();
        assert!(
            (error / deviation - 1.0).abs() < 1e-5,
            "{error} {deviation}"
        );
        let marginal = parameter.posterior.unwrap();
        assert!(
            (marginal.mean - mean[i]).abs() < 0.05 * deviation,
            "{marginal:?} {}",
            mean[i]
        );
        assert!(
            (marginal.standard_deviation / deviation - 1.0).abs() < 0.05,
            "{marginal:?} {deviation}"
        );
        let [low, _, high] = marginal.quantiles;
        assert!((low - (mean[i] - 1.96 * deviation)).abs() < 0.15 * deviation);
        assert!((high - (mean[i] + 1.96 * deviation)).abs() < 0.15 * deviation);
    }
    let correlation = covariance[(0, 1)] / (covariance[(0, 0)] * covariance[(1, 1)]).sqrt();
    assert!((found.correlations[0][1] - correlation).abs() < 0.03);
    // The bands of the curve at its end: of a + b, and of a measured value.
    let sum = Vector2::new(1.0, 1.0);
    let model = (sum.transpose() * covariance * sum)[0];
    let half = |band: &Option<[Vec<f64>; 2]>| {
        let [low, high] = band.as_ref().unwrap();
        0.5 * (high[100] - low[100]) / 1.96
    };
    let points = &curve.points;
    assert!((half(&points.model_band) / model.sqrt() - 1.0).abs() < 0.1);
    assert!((half(&points.predictive_band) / (model + 0.04).sqrt() - 1.0).abs() < 0.02);
    assert!(curve.inside.unwrap() > 0.85 && found.training.is_none());
    // The norm is that of `run`.
    let rms = |curve: &CurveError| curve.rms_difference.unwrap();
    assert!(rms(&curve.best.unwrap()) < rms(&curve.before.unwrap()));
    let again = run(&problem, &settings, GO_ON).unwrap();
    assert_eq!(
        again.parameters, found.parameters,
        "the same seed gives the same bits"
    );
    assert_eq!(again.curves, found.curves);
}

/// A curve, a value and a normal prior count as in the closed form of all three.
#[test]
fn curve_value_and_prior_add_their_information() {
    let errors = errors(8, 41, 0.2, 1.0);
    let value = "[[experiments]]\nimpact_velocity = '200 m/s'\ndepth_of_penetration = '8.3 mm'\nuncertainty = '0.05 mm'\nsource = 'x'\n";
    let keys = "uncertainty = '0.2 mm'\ncorrelation_time = '2.5 us'";
    let priors = "[[parameter]]\nkey = 'extensions.line.a'\nuniform = { from = -100, to = 100 }\n\
                  [[parameter]]\nkey = 'extensions.line.b'\nnormal = { mean = 2.5, standard_deviation = 0.3 }\n";
    let fitted = Fitted::read_with("p.toml", |_| Ok(Document::new("p.toml", priors))).unwrap();
    let mut observations = Observations::default();
    observations.add_case(&case(keys, &errors, value)).unwrap();
    let problem = Problem::new(&Line, fitted, observations, Noise::Stated).unwrap();
    let found = run(&problem, &NO_SAMPLE, GO_ON).unwrap();
    let sum = Vector2::new(1.0, 1.0);
    let of_value = 0.05_f64.powi(-2) * sum * sum.transpose();
    let of_prior = Matrix2::new(0.0, 0.0, 0.0, 0.3_f64.powi(-2));
    let score = 0.05_f64.powi(-2) * 8.3 * sum + Vector2::new(0.0, 2.5 * 0.3_f64.powi(-2));
    let (mean, covariance) = exact(&errors, 0.5_f64.tanh(), 0.2, (of_value + of_prior, score));
    for (i, parameter) in found.parameters.iter().enumerate() {
        let deviation = covariance[(i, i)].sqrt();
        assert!(
            (parameter.best - mean[i]).abs() < 1e-4 * deviation,
            "{parameter:?} {}",
            mean[i]
        );
        assert!((parameter.standard_error.unwrap() / deviation - 1.0).abs() < 1e-4);
    }
    assert_eq!((found.predictions.len(), found.curves.len()), (1, 1));
    assert!(found.training.is_some());
}

/// Part of the seeds whose 95 % interval has the true a and b, for curves of 200 values over 100 us and errors with a correlation time.
fn coverage(correlation_time_us: f64, keys: &str, noise: Noise) -> [f64; 2] {
    const SEEDS: u64 = 400;
    let mut inside = [0; 2];
    for seed in 0..SEEDS {
        let step_over_time = 100.0 / 199.0 / correlation_time_us;
        let errors = errors(1000 + seed, 200, 0.2, step_over_time);
        let problem = problem(&[case(keys, &errors, "")], &FLAT, noise).unwrap();
        let found = run(&problem, &NO_SAMPLE, GO_ON).unwrap();
        for (i, parameter) in found.parameters.iter().enumerate() {
            let reach = 1.96 * parameter.standard_error.unwrap();
            inside[i] += i32::from((parameter.best - TRUTH[i]).abs() < reach);
        }
    }
    inside.map(|count| f64::from(count) / SEEDS as f64)
}

#[test]
fn intervals_cover_the_truth_as_often_as_they_say() {
    let stated = "uncertainty = '0.2 mm'\n";
    for (time, keys, noise, at_least, at_most) in [
        (
            2.0,
            format!("{stated}correlation_time = '2 us'"),
            Noise::Stated,
            0.92,
            0.98,
        ),
        (
            2.0,
            "correlation_time = '2 us'".to_owned(),
            Noise::Estimated,
            0.91,
            0.98,
        ),
        (2.0, stated.to_owned(), Noise::Stated, 0.85, 0.98),
        (2.0, String::new(), Noise::Estimated, 0.85, 0.98),
        (8.0, String::new(), Noise::Estimated, 0.75, 0.98),
        (0.01, String::new(), Noise::Estimated, 0.92, 0.99),
        // As if all values were independent: far too narrow.
        (
            2.0,
            format!("{stated}correlation_time = '0 us'"),
            Noise::Stated,
            0.3,
            0.7,
        ),
    ] {
        let found = coverage(time, &keys, noise);
        println!("{time} us, {keys:?}, {noise:?}: {found:?}");
        for part in found {
            assert!(
                (at_least..=at_most).contains(&part),
                "{time} {keys} {noise:?}: {found:?}"
            );
        }
    }
}
