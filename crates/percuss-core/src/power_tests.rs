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
        type Output = Vec<[u64; 4]>;
        #[inline(always)]
        fn call(self) -> Vec<[u64; 4]> {
            let mut bits = vec![[0; 4]; 4000];
            for (i, bits) in bits.iter_mut().enumerate() {
                let (x, n) = (1e-5 * (i * i) as f64, 2.5e-4 * i as f64);
                let all = [
                    power_here(x, n),
                    ln(x),
                    exponential(4.0 * n - x),
                    log_ratio(x, n),
                ];
                *bits = all.map(f64::to_bits);
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
        assert_eq!(power(x, n).to_bits(), expected[0]);
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
fn logarithms_are_right_to_the_last_place_over_the_full_range() {
    let mut worst = 0.0_f64;
    for u in spread(200_000) {
        // All positive numbers, subnormal ones included, and once more those near 1.
        for x in [
            2.0_f64.powf(2098.0 * u - 1074.0),
            0.5 + u,
            1.0 + 1e-3 * (u - 0.5),
        ] {
            let off = places(ln(x), x.ln());
            worst = worst.max(off);
            assert!(off <= 1.0, "{x:e} is off by {off}");
            if x >= f64::MIN_POSITIVE {
                assert_eq!(ln_of_normal(x), ln(x));
            }
        }
    }
    assert!(worst > 0.0, "it is that of libm");
    for k in -1074..=1023 {
        let power_of_two = 2.0_f64.powf(f64::from(k));
        assert!(places(ln(power_of_two), power_of_two.ln()) <= 1.0, "2^{k}");
    }
    assert_eq!(ln(1.0).to_bits(), 0.0_f64.to_bits());
    for least in [f64::from_bits(1), f64::MIN_POSITIVE, f64::MAX] {
        assert!(places(ln(least), least.ln()) <= 1.0);
    }
}

#[test]
fn logarithms_at_the_limits_of_the_range() {
    assert_eq!(ln(0.0), f64::NEG_INFINITY);
    assert_eq!(ln(-0.0), f64::NEG_INFINITY);
    assert_eq!(ln(f64::INFINITY), f64::INFINITY);
    for x in [-1.0, -f64::MIN_POSITIVE, f64::NEG_INFINITY, f64::NAN] {
        assert!(ln(x).is_nan(), "{x}");
    }
}

#[test]
fn exponentials_are_right_to_the_last_place_over_the_full_range() {
    let mut worst = 0.0_f64;
    for u in spread(200_000) {
        for x in [1417.0 * u - 708.0, 2.0 * u - 1.0, 1e-3 * (u - 0.5)] {
            let off = places(exponential(x), x.exp());
            worst = worst.max(off);
            assert!(off <= 1.0, "{x:e} is off by {off}");
        }
        // The spacing of subnormal numbers grows beside them.
        let small = -708.0 - 38.0 * u;
        let off = (exponential(small) - small.exp()).abs();
        assert!(off <= 1.2e-16 * small.exp() + 5e-324, "{small}");
    }
    assert!(worst > 0.0, "it is that of libm");
    assert_eq!(exponential(0.0), 1.0);
    assert_eq!(exponential(-0.0), 1.0);
    assert_eq!(exponential(f64::MIN_POSITIVE), 1.0);
}

#[test]
fn exponentials_at_the_limits_of_the_range() {
    // The largest that does not overflow.
    let largest = f64::MAX.ln();
    assert!(places(exponential(largest), largest.exp()) <= 1.0);
    for x in [709.79, 710.0, 1e4, f64::MAX, f64::INFINITY] {
        assert_eq!(exponential(x), f64::INFINITY, "{x}");
    }
    for x in [-745.2, -746.0, -1e4, f64::MIN, f64::NEG_INFINITY] {
        assert_eq!(exponential(x).to_bits(), 0.0_f64.to_bits(), "{x}");
    }
    assert_eq!(exponential(-745.0), f64::from_bits(1));
    assert!(exponential(f64::NAN).is_nan());
}

#[test]
fn logarithms_of_ratios_are_right_however_close_the_numbers_are() {
    for u in spread(50_000) {
        let a = 1.0 + 0.19 * (u - 0.5);
        // The difference is exact.
        let log = log_ratio(a, 1.0);
        assert!(places(log, (a - 1.0).ln_1p()) <= 3.0, "{a}");
        let close = 1.0 + 1e-9 * (u - 0.5);
        let log = log_ratio(close, 1.0);
        assert!(places(log, (close - 1.0).ln_1p()) <= 3.0, "{close}");
        for a in [2.0_f64.powf(2043.0 * u - 1021.0), 0.2 + 4.8 * u] {
            assert!(places(log_ratio(a, 1.0), a.ln()) <= 3.0, "{a:e}");
        }
        let (a, b) = (10.0_f64.powf(300.0 * u - 150.0), 3.7e-3_f64);
        let exact = a.ln() - b.ln();
        assert!((log_ratio(a, b) - exact).abs() <= 1e-15 * (a.ln().abs() + b.ln().abs()));
    }
    assert_eq!(log_ratio(3.0, 3.0), 0.0);
    // The ends of the range.
    let [least, most] = [2.0_f64.powi(-1021), 2.0_f64.powi(1022)];
    for a in [least, most, 1.9 * least, 0.6 * most] {
        for b in [f64::MIN_POSITIVE, least, 1.0, most, f64::MAX] {
            let exact = a.ln() - b.ln();
            assert!((log_ratio(a, b) - exact).abs() < 1e-12, "{a:e} {b:e}");
        }
        assert_eq!(log_ratio(a, a), 0.0);
    }
    assert!(log_ratio(-1.0, 2.0).is_nan() && log_ratio(2.0, -1.0).is_nan());
    assert!(log_ratio(0.0, 2.0).is_nan() && log_ratio(f64::NAN, 2.0).is_nan());
}

#[test]
fn an_exponential_undoes_a_logarithm() {
    for u in spread(50_000) {
        let x = 10.0_f64.powf(600.0 * u - 300.0);
        let log = ln(x);
        let off = (exponential(log) / x - 1.0).abs();
        assert!(off <= 2.3e-16 * (1.0 + log.abs()), "{x:e}");
    }
}
