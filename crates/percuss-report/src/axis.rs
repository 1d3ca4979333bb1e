//! Axes of a chart.

/// Part of the extent of the data that an axis leaves free on either side.
const MARGIN: f64 = 0.04;
/// A logarithmic axis of less than so many decades need not end at whole ones.
const DECADES: f64 = 2.0;
/// Relative difference of numbers that an axis does not tell apart.
const SAME: f64 = 1e-6;

/// Axis: label with the unit in parentheses, scale and range.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    pub(crate) label: String,
    pub(crate) log: bool,
    range: Option<(f64, f64)>,
    tight: bool,
    pub(crate) names: Vec<String>,
    pub(crate) downward: bool,
}

impl Axis {
    /// A linear axis whose range is chosen from the data.
    pub fn new(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            log: false,
            range: None,
            tight: false,
            names: Vec::new(),
            downward: false,
        }
    }

    /// Makes the scale logarithmic; values that are not positive are left out.
    pub fn log(mut self) -> Self {
        self.log = true;
        self
    }

    /// Ends the axis where the data end.
    pub fn tight(mut self) -> Self {
        self.tight = true;
        self
    }

    /// Counts downwards: a value stands at its negative.
    pub(crate) fn downward(mut self) -> Self {
        self.downward = true;
        self
    }

    /// Writes names at 1, 2, 3, … instead of numbers.
    pub fn names(mut self, names: impl IntoIterator<Item = String>) -> Self {
        self.names = names.into_iter().collect();
        self
    }

    /// Sets the range.
    pub fn range(mut self, from: f64, to: f64) -> Self {
        self.range = Some((from, to));
        self
    }

    /// Sets the range to an extent and parts of it more at either end, unless it is set.
    pub(crate) fn range_around(mut self, (low, high): (f64, f64), more: (f64, f64)) -> Self {
        // An extent without a length has none to take parts of.
        let span = if high > low {
            high - low
        } else {
            low.abs().max(1.0)
        };
        self.range
            .get_or_insert((low - more.0 * span, high + more.1 * span));
        self
    }

    /// Gives data that start at zero the margin that other data have, unless the range is set.
    pub(crate) fn clear_of_zero(self, extent: (f64, f64)) -> Self {
        match extent.0 == 0.0 && !self.tight && !self.log {
            true => self.range_around(extent, (MARGIN, MARGIN)),
            false => self,
        }
    }

    /// Whether a value can be shown.
    pub(crate) fn shows(&self, value: f64) -> bool {
        value.is_finite() && (!self.log || value > 0.0)
    }

    /// The range to draw for these values; `None` leaves a logarithmic axis its decades.
    pub(crate) fn fixed_range(&self, extent: (f64, f64)) -> Option<(f64, f64)> {
        if self.range.is_some() {
            return self.range;
        }
        let (low, high) = extent;
        if self.log {
            let few = (high / low).log10() < DECADES;
            return few.then(|| (round_below(low), 1.0 / round_below(1.0 / high)));
        }
        // Values that differ by rounding errors only are one value.
        let size = low.abs().max(high.abs());
        if high - low <= SAME * size {
            return Some(match size {
                0.0 => (0.0, 1.0),
                _ => (low - 0.1 * size, high + 0.1 * size),
            });
        }
        if self.tight {
            return Some(extent);
        }
        let margin = MARGIN * (high - low);
        // Data that start at zero start on the axis.
        let below = if low == 0.0 { 0.0 } else { low - margin };
        Some((below, high + margin))
    }

    /// Smallest and largest of the values that can be shown; the unit decade or interval if there are none.
    pub(crate) fn extent(&self, values: impl Iterator<Item = f64>) -> (f64, f64) {
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        let extent = values
            .filter(|value| self.shows(*value))
            .fold(none, |(low, high), v| (low.min(v), high.max(v)));
        match (extent.0 <= extent.1, self.log) {
            (true, _) => extent,
            (false, true) => (1.0, 10.0),
            (false, false) => (0.0, 1.0),
        }
    }
}

/// The next number below that is 1, 2 or 5 times a power of ten, with a margin.
fn round_below(value: f64) -> f64 {
    let value = value * (1.0 - MARGIN);
    let decade = 10_f64.powf(value.log10().floor());
    let factors = [5.0, 2.0, 1.0];
    let factor = factors.into_iter().find(|factor| factor * decade <= value);
    factor.unwrap_or(1.0) * decade
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_logarithmic_axes_end_at_round_numbers_clear_of_the_data() {
        let range = |low, high| Axis::new("").log().fixed_range((low, high)).unwrap();
        let near = |a: (f64, f64), b: (f64, f64)| {
            assert!(
                (a.0 / b.0 - 1.0).abs() < 1e-12 && (a.1 / b.1 - 1.0).abs() < 1e-12,
                "{a:?}"
            );
        };
        near(range(40.0, 320.0), (20.0, 500.0));
        near(range(20.0, 500.0), (10.0, 1000.0));
        near(range(0.003, 0.003), (0.002, 0.005));
        assert_eq!(Axis::new("").log().fixed_range((1.0, 1000.0)), None);
    }
}
