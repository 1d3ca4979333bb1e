//! Where a condition changes between two numbers, by halving the interval.

/// Ends of the interval after this many halvings: the condition holds below the change and not above it.
pub fn bisect(low: f64, high: f64, halvings: u32, is_below: impl FnMut(f64) -> bool) -> (f64, f64) {
    halve(low, high, halvings, f64::midpoint, is_below)
}

/// The same for positive numbers over decades: it goes to the geometric mean of the ends, which halves the logarithm of their ratio.
pub fn bisect_ratio(
    low: f64,
    high: f64,
    halvings: u32,
    is_below: impl FnMut(f64) -> bool,
) -> (f64, f64) {
    halve(
        low,
        high,
        halvings,
        |low, high| (low * high).sqrt(),
        is_below,
    )
}

fn halve(
    mut low: f64,
    mut high: f64,
    halvings: u32,
    middle: impl Fn(f64, f64) -> f64,
    mut is_below: impl FnMut(f64) -> bool,
) -> (f64, f64) {
    for _ in 0..halvings {
        let middle = middle(low, high);
        match is_below(middle) {
            true => low = middle,
            false => high = middle,
        }
    }
    (low, high)
}

/// Middle of the interval that [`bisect`] leaves.
pub fn bisected(low: f64, high: f64, halvings: u32, is_below: impl FnMut(f64) -> bool) -> f64 {
    let (low, high) = bisect(low, high, halvings, is_below);
    f64::midpoint(low, high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_encloses_the_change_and_is_halved_each_time() {
        let (low, high) = bisect(0.0, 2.0, 20, |x| x * x < 2.0);
        assert!(low * low < 2.0 && high * high >= 2.0);
        assert_eq!(high - low, 2.0 / f64::from(1 << 20));
        // The square of one of the two numbers around the root is below 2.
        let root = bisected(0.0, 2.0, 60, |x| x * x < 2.0);
        assert!((root - 2.0_f64.sqrt()).abs() <= f64::EPSILON, "{root}");
        let (low, high) = bisect_ratio(1.0, 1e6, 50, |x| x < 20.0);
        assert!(low < 20.0 && 20.0 <= high && high / low < 1.0 + 1e-13);
    }
}
