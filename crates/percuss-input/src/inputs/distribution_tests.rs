use super::*;

const UNCUT: Cut = Cut::NONE;

#[test]
fn normal_scores_are_the_tabled_ones() {
    for (u, z) in [
        (0.5, 0.0),
        (0.841_344_746_068_542_9, 1.0),
        (0.975, 1.959_963_984_540_054),
        (0.995, 2.575_829_303_548_900_4),
        (0.001, -3.090_232_306_167_813_5),
        (1e-9, -5.997_807_015_007_686),
    ] {
        assert!((score(u) - z).abs() < 1e-14 * (1.0 + z.abs()) * 4.0, "{u}");
    }
    for i in 1..2000 {
        let u = f64::from(i) / 2000.0;
        assert!(
            (normal_probability(score(u)) / u - 1.0).abs() < 1e-14,
            "{u}"
        );
        // 1 - u is rounded.
        assert!((score(u) + score(1.0 - u)).abs() < 1e-12, "{u}");
    }
    let smallest = 2_f64.powi(-53);
    assert!((normal_probability(score(smallest)) / smallest - 1.0).abs() < 1e-12);
}

#[test]
fn quantiles_invert_their_distribution_functions() {
    let normal = Distribution::Normal {
        mean: 230.0,
        deviation: 5.0,
        cut: UNCUT,
    };
    let lognormal = Distribution::Lognormal {
        median: 2.7,
        deviation: 0.2,
        cut: UNCUT,
    };
    let uniform = Distribution::Uniform {
        from: -1.0,
        to: 3.0,
    };
    let triangular = Distribution::Triangular {
        from: 1.0,
        mode: 2.0,
        to: 5.0,
    };
    for i in 1..100 {
        let u = f64::from(i) / 100.0;
        let close = |found: f64| assert!((found - u).abs() < 1e-13, "{found} {u}");
        close(normal_probability((normal.quantile(u) - 230.0) / 5.0));
        close(normal_probability((lognormal.quantile(u) / 2.7).ln() / 0.2));
        close((uniform.quantile(u) + 1.0) / 4.0);
        let x = triangular.quantile(u);
        close(if x < 2.0 {
            (x - 1.0).powi(2) / 4.0
        } else {
            1.0 - (5.0 - x).powi(2) / 12.0
        });
    }
    assert_eq!(triangular.quantile(0.25), 2.0);
}

#[test]
fn a_cut_distribution_stays_inside_and_keeps_its_shape() {
    let cut = Cut { min: 1.0, max: 3.5 };
    let normal = Distribution::Normal {
        mean: 2.0,
        deviation: 1.0,
        cut,
    };
    let left = normal_probability(1.5) - normal_probability(-1.0);
    assert!((normal.part_left() - left).abs() < 1e-15);
    for i in 0..=1000 {
        let u = f64::from(i) / 1000.0;
        let x = normal.quantile(u);
        assert!((1.0..=3.5).contains(&x), "{x}");
        assert!(
            ((normal_probability(x - 2.0) - normal_probability(-1.0)) / left - u).abs() < 1e-13
        );
    }
    let lognormal = Distribution::Lognormal {
        median: 2.0,
        deviation: 0.5,
        cut: Cut {
            min: f64::NEG_INFINITY,
            max: 2.0,
        },
    };
    assert!((lognormal.part_left() - 0.5).abs() < 1e-15);
    assert!((lognormal.quantile(0.5) - 2.0 * (0.5 * score(0.25)).exp()).abs() < 1e-14);
}

/// Mean and variance by the midpoint rule against their closed forms.
#[test]
fn moments_are_the_closed_forms() {
    let moments = |distribution: Distribution| {
        let count = 200_000;
        let at = |i: i32| distribution.quantile((f64::from(i) + 0.5) / f64::from(count));
        let mean = (0..count).map(at).sum::<f64>() / f64::from(count);
        let square = (0..count).map(|i| at(i).powi(2)).sum::<f64>() / f64::from(count);
        (mean, square - mean * mean)
    };
    let (mean, variance) = moments(Distribution::Triangular {
        from: 0.0,
        mode: 1.0,
        to: 4.0,
    });
    assert!((mean - 5.0 / 3.0).abs() < 1e-6 && (variance - 13.0 / 18.0).abs() < 1e-6);
    let (mean, variance) = moments(Distribution::Lognormal {
        median: 1.0,
        deviation: 0.25,
        cut: UNCUT,
    });
    let s2: f64 = 0.0625;
    assert!((mean / (s2 / 2.0).exp() - 1.0).abs() < 1e-5, "{mean}");
    let exact = (s2.exp() - 1.0) * s2.exp();
    assert!((variance / exact - 1.0).abs() < 1e-3, "{variance}");
}

/// The density is the slope of the distribution function, which is to say one over the slope of the quantile.
#[test]
fn densities_are_slopes_of_their_distribution_functions() {
    let cut = Cut { min: 1.0, max: 3.5 };
    for distribution in [
        Distribution::Normal {
            mean: 2.0,
            deviation: 0.5,
            cut,
        },
        Distribution::Lognormal {
            median: 2.0,
            deviation: 0.3,
            cut,
        },
        Distribution::Uniform { from: 1.0, to: 4.0 },
        Distribution::Triangular {
            from: 1.0,
            mode: 2.0,
            to: 5.0,
        },
    ] {
        let slope = |u: f64| {
            let h = 1e-5;
            libm::log(2.0 * h / (distribution.quantile(u + h) - distribution.quantile(u - h)))
        };
        let density = |u: f64| distribution.ln_density(distribution.quantile(u));
        for u in [0.05, 0.2, 0.3, 0.6, 0.95] {
            let found = density(u) - density(0.4);
            assert!((found - (slope(u) - slope(0.4))).abs() < 1e-6, "{u}");
        }
        assert_eq!(distribution.ln_density(0.99), f64::NEG_INFINITY);
        assert_eq!(distribution.ln_density(5.01), f64::NEG_INFINITY);
    }
}
