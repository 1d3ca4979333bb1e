use super::*;

/// Numbers from 0 to 1, evenly spread and without a pattern.
fn spread(count: u32) -> impl Iterator<Item = f64> {
    (0..count).map(|i| (f64::from(i) * 0.618_033_988_749_894_9).fract())
}

/// Distance in units of the last place of `exact`.
fn places(value: f64, exact: f64) -> f64 {
    let unit = f64::from_bits(exact.abs().to_bits() + 1) - exact.abs();
    ((value - exact) / unit).abs()
}

#[test]
fn powers_are_right_to_the_last_places() {
    let (mut sum, mut count) = (0.0, 0);
    for n in spread(300).chain([0.0, 1.0]) {
        for u in spread(400) {
            let x = 10.0_f64.powf(13.0 * u - 10.0);
            let off = places(power(x, n), x.powf(n));
            assert!(off <= 2.0, "{x}^{n} is off by {off} places");
            sum += off;
            count += 1;
        }
    }
    assert!(sum / f64::from(count) < 0.2, "{}", sum / f64::from(count));
}

#[test]
fn powers_that_are_known_exactly() {
    for x in spread(1000).map(|u| 1e-6 + 20.0 * u) {
        assert_eq!(power(x, 0.0), 1.0);
        assert!(places(power(x, 1.0), x) <= 2.0);
        assert!(places(power(x, 0.5), x.sqrt()) <= 2.0);
        assert!(places(power(x, 1.0 / 3.0), x.cbrt()) <= 2.0);
        assert!(places(power(x, 2.0), x * x) <= 4.0);
    }
    for k in -200..=200 {
        let product = power(2.0_f64.powi(k), 0.25) * power(2.0_f64.powi(-k), 0.25);
        assert!(places(product, 1.0) <= 4.0, "{k}");
        assert_eq!(power(2.0_f64.powi(4 * k), 0.25), 2.0_f64.powi(k));
    }
    assert_eq!(power(0.0, 0.1), 0.0);
    assert!(power(f64::NAN, 0.1).is_nan());
    assert_eq!(power(1.0, 0.7), 1.0);
}

#[test]
fn stages_take_zero_for_some_very_small_number() {
    for n in [0.05, 0.1, 0.25] {
        let result = Split::of(0.0).logarithm(Exponent::new(n)).raise();
        assert!(result > 0.0 && result <= 2.0_f64.powf(-1022.0 * n), "{n}");
    }
}

#[test]
fn a_power_never_falls_as_its_base_grows() {
    for n in [0.05, 0.1, 0.45, 1.0] {
        for x in spread(2000).map(|u| 1e-4 + u) {
            assert!(power(x * (1.0 + 4e-15 / n), n) >= power(x, n), "{x} {n}");
        }
    }
}

#[test]
fn strains_and_their_inverse_are_right_to_the_last_places() {
    for u in spread(20_000) {
        let a = 1.0 + 0.19 * (u - 0.5);
        // The difference is exact.
        let log = log_ratio(a, 1.0);
        assert!(places(log, (a - 1.0).ln_1p()) <= 3.0, "{a}");
        let strain = 0.1 * (u - 0.5);
        assert!(places(exponential(strain), strain.exp()) <= 1.0, "{strain}");
    }
    for large in [1.5_f64, 4.0, 0.2] {
        assert_eq!(log_ratio(large, 1.0), large.ln());
        assert_eq!(exponential(large), large.exp());
    }
    assert_eq!(log_ratio(3.0, 3.0), 0.0);
    assert_eq!(exponential(0.0), 1.0);
}
