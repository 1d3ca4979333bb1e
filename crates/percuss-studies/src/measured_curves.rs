//! Measured curves against those of a run.
//!
//! Both are taken as linear between their points. Over the time that both cover, with no shift of time, the differences are exact: the
//! largest one is at a point of either curve, and the mean square is the integral of squared straight lines.

use serde::Serialize;

use crate::{
    history::{ELEMENT_COLUMNS, History, HistoryColumn, Read, SAMPLE_COLUMNS},
    outcome::RunResult,
    scenario::{MeasuredCurve, Scenario},
    units::significant,
};

/// How far a curve of a run is from a measured one. The names are stable.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CurveComparison {
    /// Name of the measured curve.
    pub name: String,
    /// Name of the gauge; null for a quantity of the history.
    pub gauge: Option<String>,
    /// Quantity, without its unit.
    pub quantity: &'static str,
    /// Unit of the differences.
    pub unit: &'static str,
    /// Number of measured values.
    pub values: usize,
    /// Start of the time that both curves cover [us].
    pub from_us: Option<f64>,
    /// End of that time [us].
    pub to_us: Option<f64>,
    /// Shift of the measured times [us]: always 0.
    pub time_shift_us: f64,
    /// Largest difference, in its unit.
    pub largest_difference: Option<f64>,
    /// Root of the mean square of the differences over that time, in its unit.
    pub rms_difference: Option<f64>,
    /// That over the root mean square of the measured curve; null where it is 0.
    pub relative_rms_difference: Option<f64>,
    /// Columns of the measured table that nothing reads.
    pub unread_columns: Vec<String>,
    /// Columns of the measured table with other names or units than those of the program.
    #[serde(skip)]
    pub read_as: Vec<String>,
    /// Why there are no differences; null where there are.
    pub reason: Option<String>,
    /// Whether the difference is less than half as large with the other sign of the measured values.
    #[serde(skip)]
    pub has_opposite_sign: bool,
    /// Curve of the run in SI units; empty where it has none. Only figures need it.
    #[serde(skip)]
    pub computed: Points,
}

/// Points of a curve: times [s] and values in SI units.
pub type Points = Vec<(f64, f64)>;

/// Differences of all measured curves of a case from a run of it.
pub fn compare_curves(scenario: &Scenario, result: &RunResult) -> Vec<CurveComparison> {
    let curves = scenario.measured_curves.iter();
    curves.map(|curve| compare_curve(curve, result)).collect()
}

pub(crate) fn compare_curve(curve: &MeasuredCurve, result: &RunResult) -> CurveComparison {
    let (points, mut reason) = match computed(curve, result.history.as_ref()) {
        Ok(found) => (found.points, None),
        Err(reason) => (Points::new(), Some(reason)),
    };
    let mut difference = None;
    if reason.is_none() {
        match Difference::of(&points, &curve.points) {
            Ok(found) => difference = Some(found),
            Err(why) => reason = Some(why),
        }
    }
    let of = |read: fn(&Difference) -> f64| difference.as_ref().map(read);
    let in_unit = |value: f64| curve.unit.of_si(value);
    CurveComparison {
        name: curve.name.clone(),
        gauge: curve.gauge.clone(),
        quantity: curve.quantity,
        unit: curve.unit.symbol,
        values: curve.points.len(),
        from_us: of(|d| d.from * 1e6),
        to_us: of(|d| d.to * 1e6),
        time_shift_us: 0.0,
        largest_difference: of(|d| d.largest).map(in_unit),
        rms_difference: of(|d| d.rms).map(in_unit),
        relative_rms_difference: of(|d| d.rms / d.measured_rms).filter(|part| part.is_finite()),
        unread_columns: curve.unread_columns.clone(),
        read_as: curve.read_as.clone(),
        reason,
        has_opposite_sign: difference.is_some_and(|d| d.mirrored_rms < 0.5 * d.rms),
        computed: points,
    }
}

/// The curve of a run that a measured one is compared with.
#[derive(Debug)]
pub(crate) struct Computed {
    /// Its points: at least one.
    pub(crate) points: Points,
    /// Whether it ends before the run does: the material of its gauge erodes.
    pub(crate) erodes: bool,
}

/// The curve of a run that a measured one is compared with.
///
/// # Errors
/// The reason, where the run has none.
pub(crate) fn computed(
    curve: &MeasuredCurve,
    history: Option<&History>,
) -> Result<Computed, String> {
    let history = history.filter(|history| !history.samples.is_empty());
    let Some(history) = history else {
        return Err("the model keeps no history".to_owned());
    };
    let all: Points = match &curve.gauge {
        None => {
            let times = history.samples.iter().map(|sample| sample.time);
            times
                .zip(values(SAMPLE_COLUMNS, curve.quantity, &history.samples))
                .collect()
        }
        Some(name) => {
            let gauge = history.gauges.iter().find(|gauge| gauge.name == *name);
            let Some(gauge) = gauge else {
                return Err(format!("the model has no gauge `{name}`"));
            };
            let values = values(ELEMENT_COLUMNS, curve.quantity, &gauge.states);
            gauge.times.iter().copied().zip(values).collect()
        }
    };
    // A gauge has numbers until its material erodes.
    let end = all.last().map(|point| point.0);
    let there = all.into_iter().skip_while(|(_, value)| !value.is_finite());
    let points: Points = there.take_while(|(_, value)| value.is_finite()).collect();
    match points.last() {
        None => Err(format!("the model gives no `{}`", curve.quantity)),
        Some(last) => Ok(Computed {
            erodes: Some(last.0) != end,
            points,
        }),
    }
}

fn values<'a, R>(
    columns: &'static [HistoryColumn<R>],
    quantity: &'a str,
    rows: &'a [R],
) -> impl Iterator<Item = f64> + 'a {
    let column = columns.iter().find(|column| column.quantity == quantity);
    rows.iter()
        .map(move |row| match column.map(|column| &column.read) {
            Some(Read::Number(read)) => read(row),
            _ => f64::NAN,
        })
}

/// Differences of two curves in SI units.
#[derive(Debug, PartialEq)]
struct Difference {
    from: f64,
    to: f64,
    largest: f64,
    rms: f64,
    /// With the other sign of the measured values.
    mirrored_rms: f64,
    measured_rms: f64,
}

impl Difference {
    fn of(computed: &[(f64, f64)], measured: &[(f64, f64)]) -> Result<Self, String> {
        let ends = |points: &[(f64, f64)]| Some((points.first()?.0, points.last()?.0));
        let (Some(of_run), Some(of_test)) = (ends(computed), ends(measured)) else {
            return Err("a curve has no values".to_owned());
        };
        let (from, to) = (of_run.0.max(of_test.0), of_run.1.min(of_test.1));
        if from >= to {
            let time = |time: f64| significant(time * 1e6, 4);
            return Err(format!(
                "the run covers {} to {} us and the test {} to {} us, without a common time",
                time(of_run.0),
                time(of_run.1),
                time(of_test.0),
                time(of_test.1)
            ));
        }
        let mut times: Vec<f64> = computed
            .iter()
            .chain(measured)
            .map(|point| point.0)
            .collect();
        times.retain(|time| (from..=to).contains(time));
        times.extend([from, to]);
        times.sort_by(f64::total_cmp);
        times.dedup();
        let pairs: Points = times
            .iter()
            .map(|time| {
                let value = at(measured, *time);
                (at(computed, *time) - value, value)
            })
            .collect();
        let mean_square = |read: fn(&(f64, f64)) -> f64| {
            let steps = times.windows(2).zip(pairs.windows(2));
            let integral: f64 = steps
                .map(|(t, pair)| {
                    let (a, b) = (read(&pair[0]), read(&pair[1]));
                    (t[1] - t[0]) * (a * a + a * b + b * b) / 3.0
                })
                .sum();
            integral / (to - from)
        };
        Ok(Self {
            from,
            to,
            largest: pairs.iter().map(|pair| pair.0.abs()).fold(0.0, f64::max),
            rms: mean_square(|pair| pair.0).sqrt(),
            mirrored_rms: mean_square(|pair| pair.0 + 2.0 * pair.1).sqrt(),
            measured_rms: mean_square(|pair| pair.1).sqrt(),
        })
    }
}

/// Value of a curve at a time: that of its end before and after it.
pub(crate) fn at(points: &[(f64, f64)], time: f64) -> f64 {
    let after = points.partition_point(|point| point.0 < time);
    let (Some(next), before) = (points.get(after), after.checked_sub(1)) else {
        return points.last().map_or(f64::NAN, |point| point.1);
    };
    match before.and_then(|before| points.get(before)) {
        Some(before) if next.0 > time => {
            let part = (time - before.0) / (next.0 - before.0);
            before.1 + part * (next.1 - before.1)
        }
        _ => next.1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `2 t` against `t` and a constant, whose integrals are known.
    #[test]
    fn differences_of_straight_lines_are_exact() {
        let computed = [(0.0, 0.0), (0.25, 0.5), (3.0, 6.0)];
        let measured = [(1.0, 1.0), (1.7, 1.7), (2.0, 2.0), (9.0, 9.0)];
        let found = Difference::of(&computed, &measured).unwrap();
        // The difference is t, from 1 to 3.
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-14 * b, "{a} is not {b}");
        near(found.rms, (26.0_f64 / 6.0).sqrt());
        near(found.measured_rms, (26.0_f64 / 6.0).sqrt());
        assert_eq!((found.from, found.to, found.largest), (1.0, 3.0, 3.0));
    }

    #[test]
    fn an_opposite_sign_is_noticed() {
        let found = |sign: f64| {
            let computed = [(0.0, 0.0), (1.0, 100.0), (2.0, 90.0)];
            let measured = computed.map(|(time, value)| (time, sign * 1.1 * value));
            let found = Difference::of(&computed, &measured).unwrap();
            (
                found.rms / found.measured_rms,
                found.mirrored_rms / found.measured_rms,
            )
        };
        let ((same, other), (opposite, mirrored)) = (found(1.0), found(-1.0));
        assert!((same - mirrored).abs() + (other - opposite).abs() < 1e-12);
        assert!(same < 0.1 && opposite > 1.9, "{same} {opposite}");
    }

    /// A peak between two samples of the run counts.
    #[test]
    fn the_largest_difference_is_at_a_point_of_either_curve() {
        let flat = [(0.0, 0.0), (2.0, 0.0)];
        let peak = [(0.0, 0.0), (1.0, -3.0), (2.0, 0.0)];
        for (computed, measured) in [(&flat[..], &peak[..]), (&peak, &flat)] {
            let found = Difference::of(computed, measured).unwrap();
            assert_eq!(found.largest, 3.0);
            assert!((found.rms - 3.0_f64.sqrt()).abs() < 1e-15);
        }
    }

    #[test]
    fn curves_without_a_common_time_are_not_compared() {
        let reason = Difference::of(&[(0.0, 1.0), (1e-6, 1.0)], &[(1e-6, 1.0), (2e-6, 1.0)]);
        assert!(
            reason
                .unwrap_err()
                .contains("0 to 1 us and the test 1 to 2 us")
        );
    }
}
