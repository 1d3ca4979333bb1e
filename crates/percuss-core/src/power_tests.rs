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

/// What the documentation of [`power`] allows, as a part of the power.
fn allowed(x: f64, n: f64) -> f64 {
    1.7e-14 + 5e-15 * n.abs() + 1.6e-16 * (n * x.log2()).abs()
}

fn off(value: f64, exact: f64) -> f64 {
    (value / exact - 1.0).abs()
}

#[test]
fn powers_of_all_numbers_are_right_to_their_digits() {
    let mut largest = 0.0_f64;
    for n in spread(300).chain([0.0, 1.0]).flat_map(|n| [n, -n]) {
        for u in spread(400) {
            // All normal numbers, and once more those that strains are.
            for x in [
                2.0_f64.powf(2044.0 * u - 1022.0),
                10.0_f64.powf(7.0 * u - 6.0),
            ] {
                let off = off(power(x, n), x.powf(n));
                assert!(off <= allowed(x, n), "{x}^{n} is off by {off}");
                largest = largest.max(off / allowed(x, n));
            }
        }
    }
    assert!(largest > 0.5, "the bound is loose: {largest}");
}

#[test]
fn powers_beyond_one_are_off_by_more() {
    for n in [2.0, -3.5, 10.0, 60.0] {
        for x in spread(2000).map(|u| 10.0_f64.powf(5.0 * u - 3.0)) {
            assert!(off(power(x, n), x.powf(n)) <= allowed(x, n), "{x}^{n}");
        }
    }
}

#[test]
fn powers_that_are_known_exactly() {
    for x in spread(1000).map(|u| 1e-6 + 20.0 * u) {
        assert_eq!(power(x, 0.0), 1.0);
        assert!(off(power(x, 1.0), x) <= allowed(x, 1.0));
        assert!(off(power(x, 0.5), x.sqrt()) <= allowed(x, 0.5));
        assert!(off(power(x, 1.0 / 3.0), x.cbrt()) <= allowed(x, 0.4));
        assert!(off(power(x, 2.0), x * x) <= allowed(x, 2.0));
    }
    for k in -200..=200 {
        assert_eq!(power(2.0_f64.powi(4 * k), 0.25), 2.0_f64.powi(k));
    }
    assert_eq!(power(0.0, 0.1), 0.0);
    assert!(power(f64::NAN, 0.1).is_nan());
    assert_eq!(power(1.0, 0.7), 1.0);
}

#[test]
fn every_instruction_set_gives_the_same_bits() {
    struct All;
    impl NullaryFnOnce for All {
        type Output = Vec<u64>;
        #[inline(always)]
        fn call(self) -> Vec<u64> {
            let mut bits = vec![0; 4000];
            for (i, bits) in bits.iter_mut().enumerate() {
                let (x, n) = (1e-5 * (i * i) as f64, 2.5e-4 * i as f64);
                *bits = power_here(x, n).to_bits();
            }
            bits
        }
    }
    // Without fused multiply-add that is one in software.
    let expected = Arch::Scalar.dispatch(All);
    assert_eq!(Arch::new().dispatch(All), expected);
    #[cfg(target_arch = "x86_64")]
    {
        if let Some(avx2) = pulp::x86::V3::try_new() {
            assert_eq!(avx2.vectorize(All), expected);
        }
        if let Some(avx512) = pulp::x86::V4::try_new() {
            assert_eq!(avx512.vectorize(All), expected);
        }
    }
    for (i, expected) in expected.into_iter().enumerate() {
        let (x, n) = (1e-5 * (i * i) as f64, 2.5e-4 * i as f64);
        assert_eq!(power(x, n).to_bits(), expected);
    }
}

#[test]
fn stages_take_zero_for_some_very_small_number() {
    for n in [0.05, 0.1, 0.25] {
        let result = Split::of(0.0).logarithm(n).raise();
        assert!(result > 0.0 && result <= 2.0_f64.powf(-1022.0 * n), "{n}");
    }
}

#[test]
fn a_power_never_falls_as_its_base_grows_by_more_than_its_digits() {
    for n in [0.05, 0.1, 0.45, 1.0] {
        for x in spread(2000).map(|u| 1e-4 + u) {
            let next = x * (1.0 + 2.0 * allowed(x, n) / n);
            assert!(power(next, n) >= power(x, n), "{x} {n}");
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
