//! Mean, variance and quantiles of samples.

/// Values in rising order.
pub fn sorted(values: impl IntoIterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.into_iter().collect();
    values.sort_by(f64::total_cmp);
    values
}

/// Quantile of values in rising order, interpolated linearly between neighbours (NumPy's default).
///
/// # Panics
/// Without values, and for a part that is not from 0 to 1.
pub fn quantile(sorted: &[f64], part: f64) -> f64 {
    let place = part * (sorted.len() - 1) as f64;
    let below = place.floor() as usize;
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (place - below as f64) * (sorted[above] - sorted[below])
}

/// Mean of values; not a number without any.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Unbiased variance of values about a centre, their mean; not a number for fewer than two.
pub fn variance(values: &[f64]) -> f64 {
    let centre = mean(values);
    let squares: f64 = values.iter().map(|value| (value - centre).powi(2)).sum();
    squares / (values.len() as f64 - 1.0)
}

/// Numbers from one to another in so many even intervals; both ends are exact.
pub fn evenly(from: f64, to: f64, intervals: u64) -> impl Iterator<Item = f64> {
    (0..=intervals).map(move |i| match i {
        i if i == intervals => to,
        i => from + (to - from) * i as f64 / intervals as f64,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_linear_between_the_values_in_order() {
        let values = sorted([9.0, -1.0, 4.0, 1.0]);
        assert_eq!(values, [-1.0, 1.0, 4.0, 9.0]);
        // Numbers of numpy.quantile([9, -1, 4, 1], part).
        for (part, expected) in [
            (0.0, -1.0),
            (0.25, 0.5),
            (0.5, 2.5),
            (0.75, 5.25),
            (1.0, 9.0),
        ] {
            assert_eq!(quantile(&values, part), expected, "{part}");
        }
        assert_eq!(quantile(&[3.0], 0.3), 3.0);
        assert_eq!(quantile(&sorted([3.0, 1.0, 2.0]), 0.5), 2.0);
    }

    #[test]
    fn mean_and_variance_of_whole_numbers_are_exact() {
        let values: Vec<f64> = (1..=9).map(f64::from).collect();
        // Variance of 1 to n: n (n + 1) / 12.
        assert_eq!((mean(&values), variance(&values)), (5.0, 7.5));
        assert!(mean(&[]).is_nan() && variance(&[1.0]).is_nan());
    }
}
