//! Maximum likelihood of the two numbers of a distribution.

use super::{Estimate, Pattern, Test, interval::interval, link::Link, velocities};
use crate::units::significant;

const ITERATIONS: usize = 200;
/// Part of the logarithm of the likelihood that a last step gains at most.
const CONVERGED: f64 = 1e-14;

/// `α + β x` with velocities x that were moved and scaled.
#[derive(Debug, Clone, Copy)]
struct Line {
    alpha: f64,
    beta: f64,
}

/// The estimate of maximum likelihood, or why there is none.
pub(super) fn likeliest(link: Link, tests: &[Test], pattern: Pattern) -> Estimate {
    let none = |reason: String| Estimate::none(link.method(), reason);
    match pattern {
        Pattern::Mixed => {}
        Pattern::Separated => {
            // Silvapulle's condition fails: the likelihood rises to its bound as the scatter shrinks to nothing.
            let gap = gap(tests);
            let (low, high) = interval(link, tests, 0.5 * (gap.0 + gap.1), bound(tests, gap));
            return Estimate {
                low_m_s: low,
                high_m_s: high,
                ..none(separated(gap))
            };
        }
        Pattern::Reversed => {
            return none("the partial penetrations are faster than the complete ones".to_owned());
        }
        Pattern::AllStopped => return none("there is no complete penetration".to_owned()),
        Pattern::AllPerforated => return none("there is no partial penetration".to_owned()),
    }
    let count = tests.len() as f64;
    let mean = tests.iter().map(|test| test.impact_velocity).sum::<f64>() / count;
    let square = |test: &Test| (test.impact_velocity - mean).powi(2);
    let unit = (tests.iter().map(square).sum::<f64>() / count).sqrt();
    let scaled: Vec<(f64, f64)> = tests
        .iter()
        .map(|test| ((test.impact_velocity - mean) / unit, sign(test)))
        .collect();
    let (line, log_likelihood) = climb(link, &scaled);
    if line.beta <= 0.0 {
        return none(
            "by these tests faster ones go through no more often than slower ones".to_owned(),
        );
    }
    let x50 = -line.alpha / line.beta;
    let v50 = mean + unit * x50;
    let (low, high) = interval(link, tests, v50, log_likelihood);
    Estimate {
        v50_m_s: Some(v50),
        standard_deviation_m_s: Some(unit / line.beta * link.standard_deviation()),
        standard_error_m_s: standard_error(link, &scaled, line).map(|error| unit * error),
        low_m_s: low,
        high_m_s: high,
        log_likelihood: Some(log_likelihood),
        ..Estimate::empty(link.method())
    }
}

/// Impact velocities of the fastest partial and of the slowest complete penetration [m/s].
fn gap(tests: &[Test]) -> (f64, f64) {
    (
        velocities(tests, false).fold(f64::MIN, f64::max),
        velocities(tests, true).fold(f64::MAX, f64::min),
    )
}

/// Bound of the logarithm of the likelihood of separated tests: of those at the one velocity that has both kinds, the chance of complete
/// penetration is the part that went through; all others are certain.
fn bound(tests: &[Test], (stopped, through): (f64, f64)) -> f64 {
    if stopped < through {
        return 0.0;
    }
    let count = |perforated| {
        let there = velocities(tests, perforated).filter(|velocity| *velocity == through);
        there.count() as f64
    };
    let [partial, complete] = [false, true].map(count);
    let log = |part: f64| part * (part / (partial + complete)).ln();
    log(partial) + log(complete)
}

fn separated((slower, faster): (f64, f64)) -> String {
    let (stopped, through) = (significant(slower, 6), significant(faster, 6));
    if slower == faster {
        return format!(
            "no zone of mixed results: partial and complete penetrations are both found at {stopped} m/s only, slower tests are partial and \
             faster ones complete; V50 there with a scatter of zero is the most likely one"
        );
    }
    format!(
        "no zone of mixed results: all tests up to {stopped} m/s are partial penetrations and all from {through} m/s are complete; \
         any V50 between them with a scatter of zero is equally likely"
    )
}

/// 1 for a complete penetration, −1 for a partial one.
pub(super) fn sign(test: &Test) -> f64 {
    match test.perforated {
        true => 1.0,
        false => -1.0,
    }
}

fn log_likelihood(link: Link, scaled: &[(f64, f64)], line: Line) -> f64 {
    let log = |(x, sign): &(f64, f64)| link.log_probability(sign * (line.alpha + line.beta * x));
    scaled.iter().map(log).sum()
}

/// Observed information of α and β: the entries αα, αβ and ββ; and the gradient of the logarithm of the likelihood.
fn information(link: Link, scaled: &[(f64, f64)], line: Line) -> ([f64; 3], [f64; 2]) {
    let (mut information, mut gradient) = ([0.0; 3], [0.0; 2]);
    for (x, sign) in scaled {
        let (slope, curvature) = link.slopes(sign * (line.alpha + line.beta * x));
        gradient[0] += sign * slope;
        gradient[1] += sign * slope * x;
        information[0] += curvature;
        information[1] += curvature * x;
        information[2] += curvature * x * x;
    }
    (information, gradient)
}

/// Newton's method with halved steps: the logarithm of the likelihood is concave for both distributions.
fn climb(link: Link, scaled: &[(f64, f64)]) -> (Line, f64) {
    let mut line = Line {
        alpha: 0.0,
        beta: 0.0,
    };
    let mut height = log_likelihood(link, scaled, line);
    for _ in 0..ITERATIONS {
        let ([aa, ab, bb], [ga, gb]) = information(link, scaled, line);
        let determinant = aa * bb - ab * ab;
        let (da, db) = (
            (bb * ga - ab * gb) / determinant,
            (aa * gb - ab * ga) / determinant,
        );
        let step = |part: f64| Line {
            alpha: line.alpha + part * da,
            beta: line.beta + part * db,
        };
        let halves = (0..60).map(|halvings| step(0.5_f64.powi(halvings)));
        let better = halves
            .map(|line| (line, log_likelihood(link, scaled, line)))
            .find(|(_, higher)| *higher >= height);
        let Some((next, higher)) = better else { break };
        let gained = higher - height;
        (line, height) = (next, higher);
        if gained <= CONVERGED * height.abs() {
            break;
        }
    }
    (line, height)
}

/// Standard error of `−α/β` from the observed information, to first order.
fn standard_error(link: Link, scaled: &[(f64, f64)], line: Line) -> Option<f64> {
    let ([aa, ab, bb], _) = information(link, scaled, line);
    let determinant = aa * bb - ab * ab;
    let x50 = -line.alpha / line.beta;
    // Variances of α and β and their covariance are bb, aa and −ab over the determinant.
    let variance = (bb + aa * x50 * x50 - 2.0 * ab * x50) / (determinant * line.beta * line.beta);
    (determinant > 0.0 && variance.is_finite()).then(|| variance.sqrt())
}
