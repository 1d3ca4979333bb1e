//! Control variate: mean and spread by a few axisymmetric runs and the many runs of the one-dimensional model.
//!
//! The axisymmetric number `y` follows that of the model, `x`, by a straight line fitted to `m` draws, `y = a + b x + r`. Over all draws
//!
//! - the mean is `a + b x̄`, with the standard error of the regression at `x̄` and that of `b x̄`;
//! - the variance is `b² var(x) + var(r)`, with a jackknife error;
//! - percentiles are those of `a + b x + r`, of every draw with every residual.

use std::ops::ControlFlow;

use rayon::prelude::*;
use serde::Serialize;

use super::{
    quantity::quantity,
    result::{Draw, Uncertainty},
    study::Study,
};
use crate::{
    Error,
    axisymmetric::{AxisymmetricAnswer, ReferenceMeshes, Request, main_number},
    bisection::bisect,
    cost,
    jobs::Jobs,
    outcome::BandQuantity,
    statistics::{mean, sorted, variance},
    summary::ResultNumber,
    sweep::SweepRun,
};

/// Fewest draws with an axisymmetric number that a line is fitted to.
pub const FEWEST_POINTS: usize = 4;
/// Most of them.
pub const MOST_POINTS: usize = 256;

/// Mean and spread of a number, corrected by axisymmetric runs. In the unit of the number's name.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AxisymmetricSpread {
    /// Name of the number.
    pub quantity: &'static str,
    /// Draws with both numbers, by that of the model.
    pub points: Vec<AxisymmetricPoint>,
    /// Draws whose axisymmetric run has another main number or none.
    pub left_out: usize,
    /// Slope and intercept of the line.
    pub slope: f64,
    /// Axisymmetric number where that of the model is 0.
    pub intercept: f64,
    /// Correlation of the two numbers over the points.
    pub correlation: f64,
    /// Mean.
    pub mean: f64,
    /// Its standard error.
    pub standard_error: f64,
    /// Standard deviation.
    pub standard_deviation: f64,
    /// Its standard error.
    pub standard_deviation_error: f64,
    /// 5th percentile.
    pub p05: f64,
    /// Median.
    pub p50: f64,
    /// 95th percentile.
    pub p95: f64,
    /// Mean discretisation uncertainty of the axisymmetric numbers.
    pub discretisation_uncertainty: Option<f64>,
}

/// A draw with both numbers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct AxisymmetricPoint {
    /// Number of the model.
    pub model_value: f64,
    /// Axisymmetric number, in the limit of its meshes.
    pub value: f64,
    /// Its discretisation uncertainty.
    pub uncertainty: Option<f64>,
}

/// Corrects an analysis by `points` axisymmetric runs, at draws that are spread evenly over the quantiles of the model's number.
/// `progress` gets the fraction done, from any thread but never from two at once; [`ControlFlow::Break`] stops the runs.
///
/// # Errors
/// [`Error::Cancelled`]. The inner error is the reason why there is no correction.
pub fn correct(
    study: &Study,
    found: &Uncertainty,
    points: usize,
    progress: &mut (dyn FnMut(f64) -> ControlFlow<()> + Send),
) -> Result<Result<AxisymmetricSpread, String>, Error> {
    let main = main_number(&study.scenario, found.nominal.outcome);
    let Some(number) = quantity(main.name()) else {
        return Ok(Err(format!("`axi` gives no {}", main.describe())));
    };
    let draws = chosen(&found.draws, number, points);
    if draws.len() < FEWEST_POINTS {
        return Ok(Err(format!(
            "{} draws have a {}, and a line needs {FEWEST_POINTS}",
            draws.len(),
            number.label
        )));
    }
    // What is stopped lies on no line through what perforates.
    let is_stopped = |draw: &Draw| draw.value(number) == Some(0.0);
    if main == BandQuantity::ResidualVelocity && found.draws.iter().any(is_stopped) {
        return Ok(Err(
            "some draws are stopped and others perforate: a straight line from model to `axi` holds for one of them only".to_owned(),
        ));
    }
    let jobs = Jobs::new(vec![1.0; draws.len()], progress);
    let memory = Request::default().memory(&study.scenario);
    let answers: Vec<Result<AxisymmetricAnswer, Error>> = cost::within_memory(memory, || {
        draws
            .par_iter()
            .with_max_len(1)
            .enumerate()
            .map(|(place, (_, draw))| {
                let answer = answer_of(study, draw, &mut |fraction| jobs.report(place, fraction))?;
                let _ = jobs.report(place, 1.0);
                Ok(answer)
            })
            .collect()
    });
    let mut both = Vec::new();
    let mut reason = String::new();
    for ((value, _), answer) in draws.iter().zip(answers) {
        let answer = answer?;
        let is_usable = answer.quantity == Some(main) && answer.doubt.is_none();
        match answer.value.filter(|_| is_usable) {
            Some(own) => both.push(AxisymmetricPoint {
                model_value: *value,
                value: own,
                uncertainty: answer.uncertainty,
            }),
            None => reason = answer.remark().unwrap_or_default().to_owned(),
        }
    }
    if both.len() < FEWEST_POINTS {
        return Ok(Err(format!(
            "{} of {} axisymmetric runs have a {}, and a line needs {FEWEST_POINTS}{}",
            both.len(),
            draws.len(),
            number.label,
            if reason.is_empty() {
                String::new()
            } else {
                format!(": {reason}")
            }
        )));
    }
    let model: Vec<f64> = found
        .draws
        .iter()
        .filter_map(|draw| draw.value(number))
        .collect();
    Ok(spread(number.name, both, draws.len(), &model)
        .ok_or_else(|| format!("the {} of the model is the same in all runs", number.label)))
}

/// Draws at evenly spread quantiles of a number, with its values.
fn chosen<'a>(draws: &'a [Draw], number: &ResultNumber, points: usize) -> Vec<(f64, &'a Draw)> {
    let mut given: Vec<(f64, &Draw)> = draws
        .iter()
        .filter_map(|draw| Some((draw.value(number)?, draw)))
        .collect();
    given.sort_by(|a, b| a.0.total_cmp(&b.0));
    let count = points.min(given.len());
    (0..count)
        .map(|i| given[(2 * i + 1) * given.len() / (2 * count)])
        .collect()
}

fn answer_of(
    study: &Study,
    draw: &Draw,
    progress: &mut (dyn FnMut(f64) -> ControlFlow<()> + Send),
) -> Result<AxisymmetricAnswer, Error> {
    let run = SweepRun::new(&study.template, &study.axes, 0, draw.inputs.clone(), &[]);
    match run.scenario {
        Ok(scenario) => Request::default().answer(&scenario, progress),
        Err(reason) => Ok(AxisymmetricAnswer::without(
            ReferenceMeshes::default(),
            reason,
        )),
    }
}

/// Straight line through points by least squares: intercept, slope, and correlation; `None` where all `x` are the same.
fn line(points: &[AxisymmetricPoint]) -> Option<(f64, f64, f64)> {
    let xs: Vec<f64> = points.iter().map(|point| point.model_value).collect();
    let ys: Vec<f64> = points.iter().map(|point| point.value).collect();
    let (x, y) = (mean(&xs), mean(&ys));
    let sum = |term: fn(f64, f64) -> f64| -> f64 {
        xs.iter().zip(&ys).map(|(a, b)| term(a - x, b - y)).sum()
    };
    let (xx, xy, yy) = (sum(|a, _| a * a), sum(|a, b| a * b), sum(|_, b| b * b));
    let slope = xy / xx;
    let correlation = if yy > 0.0 { xy / (xx * yy).sqrt() } else { 0.0 };
    (xx > 0.0).then_some((y - slope * x, slope, correlation))
}

/// Standard deviation of the axisymmetric number over all draws, and the residuals of the points, with the variance of the line's error.
fn deviation(points: &[AxisymmetricPoint], variance_of_model: f64) -> Option<(f64, Vec<f64>, f64)> {
    let (intercept, slope, _) = line(points)?;
    let residuals: Vec<f64> = points
        .iter()
        .map(|point| point.value - intercept - slope * point.model_value)
        .collect();
    let squares: f64 = residuals.iter().map(|r| r * r).sum();
    let left = squares / (points.len() as f64 - 2.0);
    Some((
        (slope * slope * variance_of_model + left).sqrt(),
        residuals,
        left,
    ))
}

/// Mean and spread over all draws, `model`, by the line through some of them.
fn spread(
    quantity: &'static str,
    points: Vec<AxisymmetricPoint>,
    runs: usize,
    model: &[f64],
) -> Option<AxisymmetricSpread> {
    let (intercept, slope, correlation) = line(&points)?;
    let (centre, var) = (mean(model), variance(model));
    let (standard_deviation, residuals, left) = deviation(&points, var)?;
    let count = points.len() as f64;
    let xs: Vec<f64> = points.iter().map(|point| point.model_value).collect();
    let off = centre - mean(&xs);
    let of_line = left * (1.0 / count + off * off / (variance(&xs) * (count - 1.0)));
    let of_draws = slope * slope * var / model.len() as f64;
    let without: Vec<f64> = (0..points.len())
        .filter_map(|place| {
            let mut rest = points.clone();
            rest.remove(place);
            Some(deviation(&rest, var)?.0)
        })
        .collect();
    // With two degrees of freedom less, residuals of the points are smaller than those of other draws.
    let wider = (count / (count - 2.0)).sqrt();
    let ordered = sorted(model.iter().map(|x| intercept + slope * x));
    let residuals: Vec<f64> = residuals.iter().map(|residual| wider * residual).collect();
    let percentile = |probability| quantile_of_sums(&ordered, &residuals, probability);
    let uncertainties: Vec<f64> = points
        .iter()
        .filter_map(|point| point.uncertainty)
        .collect();
    Some(AxisymmetricSpread {
        quantity,
        left_out: runs - points.len(),
        slope,
        intercept,
        correlation,
        mean: intercept + slope * centre,
        standard_error: (of_line + of_draws).sqrt(),
        standard_deviation,
        standard_deviation_error: (variance(&without) * (count - 1.0).powi(2) / count).sqrt(),
        p05: percentile(0.05),
        p50: percentile(0.5),
        p95: percentile(0.95),
        discretisation_uncertainty: (!uncertainties.is_empty()).then(|| mean(&uncertainties)),
        points,
    })
}

/// Quantile of the sums of every one of some numbers in ascending order with every one of others.
///
/// The draws are a sequence that fills space evenly: taken in turn, a residual would meet one part of the range alone.
fn quantile_of_sums(ordered: &[f64], others: &[f64], probability: f64) -> f64 {
    let rank = probability * (ordered.len() * others.len() - 1) as f64;
    let at = |rank: f64| {
        // The smallest sum that at least so many sums do not exceed.
        let below = |limit: f64| -> usize {
            let count = |other: &f64| ordered.partition_point(|one| one + other <= limit);
            others.iter().map(count).sum()
        };
        let (smallest, largest) = (ordered[0], ordered[ordered.len() - 1]);
        let ends = others
            .iter()
            .fold((f64::MAX, f64::MIN), |(low, high), other| {
                (low.min(smallest + other), high.max(largest + other))
            });
        let has_fewer = |limit: f64| below(limit) as f64 <= rank;
        if !has_fewer(ends.0) {
            return ends.0;
        }
        bisect(ends.0, ends.1, 100, has_fewer).1
    };
    let (low, part) = (rank.floor(), rank.fract());
    (1.0 - part) * at(low) + part * at(rank.ceil())
}

impl AxisymmetricSpread {
    /// Its number.
    ///
    /// # Panics
    /// Never: it is one of the list.
    pub fn what(&self) -> &'static ResultNumber {
        quantity(self.quantity).expect("a quantity of the list")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of a normal distribution, by a congruential generator and twelve uniform ones each.
    struct Normal(u64);

    impl Normal {
        fn next(&mut self) -> f64 {
            let mut sum = -6.0;
            for _ in 0..12 {
                self.0 = self
                    .0
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1);
                sum += (self.0 >> 11) as f64 / (1_u64 << 53) as f64;
            }
            sum
        }
    }

    fn point(model_value: f64, value: f64) -> AxisymmetricPoint {
        AxisymmetricPoint {
            model_value,
            value,
            uncertainty: Some(0.1),
        }
    }

    #[test]
    fn numbers_on_a_line_give_the_exact_mean_and_spread() {
        let model = [1.0, 2.0, 4.0, 5.0, 8.0];
        let points = model[..4]
            .iter()
            .map(|x| point(*x, 3.0 + 0.5 * x))
            .collect();
        let found = spread("depth_of_penetration_mm", points, 5, &model).unwrap();
        assert_eq!((found.left_out, found.mean), (1, 5.0));
        let expected = 0.5 * variance(&model).sqrt();
        assert!((found.standard_deviation - expected).abs() < 1e-12);
        assert!(found.standard_deviation_error < 1e-9 && (found.correlation - 1.0).abs() < 1e-12);
        // What is left is that the draws are five only.
        assert!((found.standard_error - expected / 5.0_f64.sqrt()).abs() < 1e-12);
        assert_eq!(
            (found.p50, found.discretisation_uncertainty),
            (5.0, Some(0.1))
        );
        let same = vec![point(1.0, 1.0); 4];
        assert!(spread("depth_of_penetration_mm", same, 4, &model).is_none());
    }

    #[test]
    fn quantiles_of_sums_are_those_of_every_pair() {
        let ordered = [1.0, 2.0, 2.0, 5.0, 9.0];
        let others = [-0.5, 0.25, 3.0];
        let pairs = sorted(
            ordered
                .iter()
                .flat_map(|a| others.iter().map(move |b| a + b)),
        );
        for percent in 0..=100 {
            let probability = f64::from(percent) / 100.0;
            let found = quantile_of_sums(&ordered, &others, probability);
            let exact = crate::statistics::quantile(&pairs, probability);
            assert!((found - exact).abs() < 1e-9, "{percent}: {found} {exact}");
        }
    }

    /// Draws in turn from four quarters of the range, as of a sequence that fills space evenly: where each residual met one quarter alone, the 5th
    /// percentile would be that of the first quarter with its residual.
    #[test]
    fn percentiles_do_not_depend_on_the_order_of_the_draws() {
        let turn: Vec<f64> = (0..64)
            .map(|i| f64::from(i % 4) + f64::from(i / 4) / 16.0)
            .collect();
        let ordered = sorted(turn.iter().copied());
        let points = || {
            [0.5, 1.5, 2.5, 3.5]
                .into_iter()
                .zip([1.0, -1.0, -1.0, 1.0])
                .map(|(x, r)| point(x, x + r))
                .collect()
        };
        let of = |model: &[f64]| spread("depth_of_penetration_mm", points(), 4, model).unwrap();
        let (turn, ordered) = (of(&turn), of(&ordered));
        assert_eq!(
            [turn.p05, turn.p50, turn.p95],
            [ordered.p05, ordered.p50, ordered.p95]
        );
    }

    /// Of 400 made-up studies the mean lies within two standard errors in 88 to 98 %: 8 points have 6 degrees of freedom, 91 %. The
    /// spread is right in the mean, and its error is the scatter of the studies within a third.
    #[test]
    fn errors_are_those_of_repeated_studies() {
        let mut normal = Normal(1);
        let (mut inside, mut spreads, mut errors) = (0, Vec::new(), Vec::new());
        for _ in 0..400 {
            let model: Vec<f64> = (0..512).map(|_| 10.0 + normal.next()).collect();
            let truth = |x: f64, normal: &mut Normal| 2.0 + 1.5 * x + 0.5 * normal.next();
            let ordered = sorted(model.iter().copied());
            let points = (0..8)
                .map(|i| ordered[(2 * i + 1) * 32])
                .map(|x| point(x, truth(x, &mut normal)))
                .collect();
            let found = spread("depth_of_penetration_mm", points, 8, &model).unwrap();
            inside += usize::from((found.mean - 17.0).abs() < 2.0 * found.standard_error);
            spreads.push(found.standard_deviation);
            errors.push(found.standard_deviation_error);
        }
        println!("mean within two standard errors in {inside} of 400 studies");
        assert!((352..=392).contains(&inside), "{inside}");
        let exact = (1.5_f64.powi(2) + 0.25).sqrt();
        assert!(
            (mean(&spreads) / exact - 1.0).abs() < 0.02,
            "{}",
            mean(&spreads)
        );
        let ratio = mean(&errors) / variance(&spreads).sqrt();
        assert!((0.67..1.5).contains(&ratio), "{ratio}");
    }
}
