//! V50 as the mean of equal numbers of the fastest partial and the slowest complete penetrations \[milstd662f\].

use super::{Estimate, Method, Test, velocities};
use crate::{statistics::sorted, units::significant};

/// Fewest tests of either kind.
const FEWEST: usize = 2;

/// The mean over as many tests as lie within a span [m/s].
pub(super) fn of_extremes(tests: &[Test], span: f64) -> Estimate {
    let [mut stopped, perforated] = [false, true].map(|of| sorted(velocities(tests, of)));
    stopped.reverse();
    let method = Method::MeanOfExtremes;
    let most = stopped.len().min(perforated.len());
    if most < FEWEST {
        return Estimate::none(
            method,
            format!("it takes {FEWEST} tests of either kind or more"),
        );
    }
    let used = |count: usize| stopped[..count].iter().chain(&perforated[..count]).copied();
    let span_of = |count: usize| {
        let (low, high) = used(count).fold((f64::MAX, f64::MIN), |(low, high), velocity| {
            (low.min(velocity), high.max(velocity))
        });
        high - low
    };
    // Rounding of velocities that were given in other units must not decide.
    let fits = |count: &usize| span_of(*count) <= span * (1.0 + 1e-9);
    let Some(count) = (FEWEST..=most).rev().find(fits) else {
        return Estimate::none(
            method,
            format!(
                "the {FEWEST} fastest partial and the {FEWEST} slowest complete penetrations span {} m/s, more than {} m/s",
                significant(span_of(FEWEST), 4),
                significant(span, 4)
            ),
        );
    };
    Estimate {
        v50_m_s: Some(used(count).sum::<f64>() / (2 * count) as f64),
        tests_used: Some(2 * count),
        span_m_s: Some(span_of(count)),
        ..Estimate::empty(method)
    }
}
