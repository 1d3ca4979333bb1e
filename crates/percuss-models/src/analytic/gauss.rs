//! Gauss–Legendre quadrature.

/// Points from the middle of a panel, over half of its width, and weights.
const POINTS: [(f64, f64); 5] = [
    (0.0, 128.0 / 225.0),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_08),
    (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
];

/// Integral of a function over panels of equal width, of five points each: exact for polynomials up to the ninth degree.
pub(super) fn integral(from: f64, to: f64, panels: u32, function: impl Fn(f64) -> f64) -> f64 {
    let half = 0.5 * (to - from) / f64::from(panels);
    (0..panels)
        .map(|i| {
            let middle = from + f64::from(2 * i + 1) * half;
            let at = |(x, weight): (f64, f64)| weight * function(middle + x * half);
            half * POINTS.map(at).iter().sum::<f64>()
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_of_the_ninth_degree_are_exact() {
        for degree in 0..=9 {
            let power = f64::from(degree);
            let exact = (3_f64.powf(power + 1.0) - 1.0) / (power + 1.0);
            let found = integral(1.0, 3.0, 1, |x| x.powi(degree));
            assert!((found / exact - 1.0).abs() < 1e-14, "{degree}: {found}");
        }
        let tenth = integral(-1.0, 1.0, 1, |x| x.powi(10));
        assert!((tenth * 5.5 - 1.0).abs() > 1e-3, "{tenth}");
    }
}
