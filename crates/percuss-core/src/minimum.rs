//! Minimum of a function of one number.

/// Place of the least value of a function between two places that enclose one minimum: golden section.
pub fn least(mut low: f64, mut high: f64, steps: u32, mut value: impl FnMut(f64) -> f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    let (mut left, mut right) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
    let (mut at_left, mut at_right) = (value(left), value(right));
    for _ in 0..steps {
        if at_left < at_right {
            (high, right, at_right) = (right, left, at_left);
            left = high - GOLDEN * (high - low);
            at_left = value(left);
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = low + GOLDEN * (high - low);
            at_right = value(right);
        }
    }
    if at_left < at_right { left } else { right }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_minimum_of_a_parabola_is_its_vertex() {
        let place = least(-3.0, 8.0, 60, |x| (x - 1.25).powi(2));
        assert!((place - 1.25).abs() < 1e-7, "{place}");
        assert!((least(2.0, 8.0, 60, |x| x) - 2.0).abs() < 1e-9);
    }
}
