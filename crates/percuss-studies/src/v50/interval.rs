//! Interval of the likelihood ratio: every V50 at which the tests are not much less likely than at the best one.

use super::{Test, fit::sign, link::Link};
use crate::bisection::bisected;

/// Value that a chi-square variable of one degree of freedom stays below with a probability of 0.95.
const CHI_SQUARE: f64 = 3.841_458_820_694_124;
/// Spreads of the velocities beyond which an end is looked for no further.
const FARTHEST: f64 = 1e4;
/// Halvings that bring the place of an end, or the best scatter, to one part in 10¹³.
const HALVINGS: u32 = 45;

/// Ends of the interval [m/s], given a V50 that is as likely as any and the logarithm of its likelihood; `None` for an end that
/// does not exist. The profile rises to that V50 and falls beyond it, for the likelihood is concave in the line that it belongs to.
pub(super) fn interval(
    link: Link,
    tests: &[Test],
    best: f64,
    highest: f64,
) -> (Option<f64>, Option<f64>) {
    let outside = |v50: f64| 2.0 * (highest - profile(link, tests, v50)) > CHI_SQUARE;
    let slowest = tests
        .iter()
        .map(|s| s.impact_velocity)
        .fold(f64::MAX, f64::min);
    let fastest = tests
        .iter()
        .map(|s| s.impact_velocity)
        .fold(f64::MIN, f64::max);
    let spread = fastest - slowest;
    let end = |direction: f64| {
        let mut step = 1e-3 * spread;
        let mut near = best;
        while step < FARTHEST * spread {
            let far = best + direction * step;
            if outside(far) {
                return Some(bisected(near, far, HALVINGS, |v50| !outside(v50)));
            }
            near = far;
            step *= 1.5;
        }
        None
    };
    (end(-1.0), end(1.0))
}

/// Largest logarithm of the likelihood at this V50 [m/s], over all scatters.
fn profile(link: Link, tests: &[Test], v50: f64) -> f64 {
    let distances: Vec<f64> = tests
        .iter()
        .map(|test| sign(test) * (test.impact_velocity - v50))
        .collect();
    let at = |steepness: f64| -> f64 {
        let logs = distances
            .iter()
            .map(|d| link.log_probability(steepness * d));
        logs.sum()
    };
    if distances.iter().all(|distance| *distance >= 0.0) {
        // No scatter at all is best; tests at this very velocity go either way.
        let even = distances
            .iter()
            .filter(|distance| **distance == 0.0)
            .count();
        return even as f64 * link.log_probability(0.0);
    }
    let slope = |steepness: f64| -> f64 {
        let slopes = distances.iter().map(|d| d * link.slopes(steepness * d).0);
        slopes.sum()
    };
    if slope(0.0) <= 0.0 {
        return at(0.0);
    }
    // The slope falls: the highest place lies where it changes its sign.
    let largest = distances.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
    let mut high = 1.0 / largest;
    while slope(high) > 0.0 {
        high *= 2.0;
    }
    at(bisected(0.0, high, HALVINGS, |steepness| {
        slope(steepness) > 0.0
    }))
}
