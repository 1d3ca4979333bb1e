use super::*;
use crate::Error;

fn tests(stopped: &[f64], perforated: &[f64]) -> Vec<Test> {
    let test = |velocity: &f64, perforated| Test {
        impact_velocity: *velocity,
        perforated,
    };
    let stopped = stopped.iter().map(|velocity| test(velocity, false));
    stopped
        .chain(perforated.iter().map(|velocity| test(velocity, true)))
        .collect()
}

fn by(method: Method, tests: &[Test]) -> Estimate {
    estimate(tests, SPAN).of(method).unwrap().clone()
}

/// Tests at two velocities: as many numbers as unknowns, so that the most likely probabilities are the parts that went through.
#[test]
fn at_two_velocities_the_likeliest_chances_are_the_observed_parts() {
    // 1 of 4 at 200 m/s, 3 of 4 at 210 m/s.
    let even = tests(&[200.0, 200.0, 200.0, 210.0], &[200.0, 210.0, 210.0, 210.0]);
    let logit = by(Method::Logit, &even);
    assert!((logit.v50_m_s.unwrap() - 205.0).abs() < 1e-9);
    // logit(3/4) = ln 3: the scale is 10/(2 ln 3), the standard deviation π/√3 of it.
    let scale = 10.0 / (2.0 * 3.0_f64.ln());
    let deviation = scale * std::f64::consts::PI / 3.0_f64.sqrt();
    assert!((logit.standard_deviation_m_s.unwrap() / deviation - 1.0).abs() < 1e-8);
    let log = 2.0 * (4.0 * 0.75_f64.ln()) - 2.0 * (0.75_f64.ln() - 0.25_f64.ln());
    assert!((logit.log_likelihood.unwrap() - log).abs() < 1e-9);
    // The information of one test is p (1 − p) = 3/16: α has the variance 1/(8·3/16), and V50 is −α/β.
    let error = scale * (1.0 / (8.0 * 3.0 / 16.0_f64)).sqrt();
    assert!((logit.standard_error_m_s.unwrap() / error - 1.0).abs() < 1e-6);

    // 1 of 5 at 200 m/s, 4 of 6 at 212 m/s; Φ⁻¹(1/5) = −0.8416212, Φ⁻¹(2/3) = 0.4307273.
    let uneven = tests(
        &[200.0, 200.0, 200.0, 200.0, 212.0, 212.0],
        &[200.0, 212.0, 212.0, 212.0, 212.0],
    );
    let probit = by(Method::Probit, &uneven);
    let deviation = 12.0 / (0.430_727_3 + 0.841_621_2);
    assert!((probit.standard_deviation_m_s.unwrap() / deviation - 1.0).abs() < 1e-6);
    assert!((probit.v50_m_s.unwrap() - (200.0 + 0.841_621_2 * deviation)).abs() < 1e-5);
}

#[test]
fn symmetric_tests_have_their_middle_for_v50() {
    let symmetric = tests(&[180.0, 184.0, 188.0], &[186.0, 190.0, 194.0]);
    for method in [Method::Probit, Method::Logit, Method::MeanOfExtremes] {
        let found = by(method, &symmetric);
        assert!((found.v50_m_s.unwrap() - 187.0).abs() < 1e-7, "{found:?}");
        if let (Some(low), Some(high)) = (found.low_m_s, found.high_m_s) {
            assert!((low + high - 2.0 * 187.0).abs() < 1e-6, "{found:?}");
            assert!(low < 184.0);
        }
    }
}

/// At the ends of the interval the likelihood, by brute force over the scatter, is down by the half of chi-square.
#[test]
fn at_the_ends_of_the_interval_the_likelihood_is_down_by_half_of_chi_square() {
    let mixed = tests(
        &[160.0, 166.0, 170.0, 174.0, 176.0, 183.0],
        &[179.0, 181.0, 188.0, 192.0, 195.0, 199.0],
    );
    for link in [Link::Probit, Link::Logit] {
        let found = by(link.method(), &mixed);
        let best = |v50: f64| {
            (1..40_000)
                .map(|i| 0.005 * f64::from(i))
                .map(|scale| {
                    let log = |s: &Test| {
                        link.log_probability(fit::sign(s) * (s.impact_velocity - v50) / scale)
                    };
                    mixed.iter().map(log).sum::<f64>()
                })
                .fold(f64::MIN, f64::max)
        };
        assert!((best(found.v50_m_s.unwrap()) - found.log_likelihood.unwrap()).abs() < 1e-6);
        for end in [found.low_m_s.unwrap(), found.high_m_s.unwrap()] {
            let fall = 2.0 * (found.log_likelihood.unwrap() - best(end));
            assert!((fall - 3.841_459).abs() < 1e-4, "{link:?} {end} {fall}");
        }
    }
}

/// At each of 21 velocities as many of 100 tests go through as a known distribution says, rounded.
#[test]
fn known_numbers_are_recovered() {
    let (v50, deviation) = (300.0, 8.0);
    let made = |link: Link| -> Vec<Test> {
        let velocities = (0..21).map(|i| 284.0 + 1.6 * f64::from(i));
        let at = |velocity: f64| {
            let z = (velocity - v50) / deviation * link.standard_deviation();
            let through = (100.0 * link.probability(z)).round() as usize;
            (0..100).map(move |i| Test {
                impact_velocity: velocity,
                perforated: i < through,
            })
        };
        velocities.flat_map(at).collect()
    };
    for link in [Link::Probit, Link::Logit] {
        let found = by(link.method(), &made(link));
        assert!((found.v50_m_s.unwrap() - v50).abs() < 1e-6, "{found:?}");
        assert!(
            (found.standard_deviation_m_s.unwrap() / deviation - 1.0).abs() < 0.01,
            "{found:?}"
        );
        // With so many tests the interval is that of the standard error.
        let wide = found.high_m_s.unwrap() - found.low_m_s.unwrap();
        let error = found.standard_error_m_s.unwrap();
        assert!(
            (wide / (2.0 * 1.959_964 * error) - 1.0).abs() < 0.005,
            "{found:?}"
        );
    }
}

#[test]
fn a_change_of_origin_and_unit_changes_nothing_else() {
    let (stopped, perforated) = ([160.0, 166.0, 170.0, 183.0], [181.0, 188.0, 192.0, 199.0]);
    let scaled = |velocities: [f64; 4]| velocities.map(|v| 1000.0 + 3.0 * v);
    let one = by(Method::Probit, &tests(&stopped, &perforated));
    let other = by(
        Method::Probit,
        &tests(&scaled(stopped), &scaled(perforated)),
    );
    for (a, b) in [
        (one.v50_m_s, other.v50_m_s),
        (one.low_m_s, other.low_m_s),
        (one.high_m_s, other.high_m_s),
    ] {
        assert!((1000.0 + 3.0 * a.unwrap() - b.unwrap()).abs() < 1e-6);
    }
    let ratio = other.standard_deviation_m_s.unwrap() / one.standard_deviation_m_s.unwrap();
    assert!((ratio - 3.0).abs() < 1e-8);
}

#[test]
fn separated_tests_have_no_likeliest_v50_but_an_interval_and_a_mean() {
    let apart = tests(&[170.0, 175.0, 180.0, 182.0], &[186.0, 190.0, 193.0, 199.0]);
    let v50 = estimate(&apart, SPAN);
    assert_eq!(v50.pattern, Pattern::Separated);
    assert_eq!(
        (v50.highest_stopped_m_s, v50.lowest_perforated_m_s),
        (Some(182.0), Some(186.0))
    );
    for method in [Method::Probit, Method::Logit] {
        let none = v50.of(method).unwrap();
        assert_eq!((none.v50_m_s, none.standard_deviation_m_s), (None, None));
        assert!(
            none.reason
                .as_ref()
                .unwrap()
                .contains("no zone of mixed results")
        );
        assert!(
            none.low_m_s.unwrap() < 182.0 && none.high_m_s.unwrap() > 186.0,
            "{none:?}"
        );
    }
    let mean = v50.of(Method::MeanOfExtremes).unwrap();
    assert_eq!((mean.v50_m_s, mean.tests_used), (Some(184.375), Some(8)));
    // A test of either kind at one velocity is no zone of mixed results.
    let touching = tests(&[170.0, 180.0], &[180.0, 190.0]);
    assert_eq!(estimate(&touching, SPAN).pattern, Pattern::Separated);
    let reason = by(Method::Probit, &touching).reason.unwrap();
    assert!(reason.contains("both found at 180 m/s only"), "{reason}");
    // Two tests bound nothing.
    let two = by(Method::Probit, &tests(&[180.0], &[190.0]));
    assert_eq!((two.low_m_s, two.high_m_s), (None, None));
}

/// Three of six tests at one velocity go through, slower ones never and faster ones always: by brute force over the scatter, the likelihood at the
/// ends is down by half of chi-square from its bound, 6 ln ½. With one of ten, V50 lies above that velocity and not below it.
#[test]
fn the_interval_of_tests_that_go_either_way_at_one_velocity_has_a_width() {
    let even = tests(
        &[100.0, 105.0, 110.0, 110.0, 110.0],
        &[110.0, 110.0, 110.0, 115.0, 120.0],
    );
    for link in [Link::Probit, Link::Logit] {
        let found = by(link.method(), &even);
        let best = |v50: f64| {
            let log = |scale: f64| -> f64 {
                let one = |s: &Test| {
                    link.log_probability(fit::sign(s) * (s.impact_velocity - v50) / scale)
                };
                even.iter().map(one).sum()
            };
            (1..40_000)
                .map(|i| log(0.005 * f64::from(i)))
                .fold(f64::MIN, f64::max)
        };
        let (low, high) = (found.low_m_s.unwrap(), found.high_m_s.unwrap());
        assert!(
            (low + high - 220.0).abs() < 1e-6 && high > 115.0,
            "{low} {high}"
        );
        for end in [low, high] {
            let fall = 2.0 * (6.0 * 0.5_f64.ln() - best(end));
            assert!((fall - 3.841_459).abs() < 1e-4, "{link:?} {end} {fall}");
        }
    }
    let mut few = tests(&[100.0, 105.0], &[110.0, 115.0, 120.0]);
    few.extend(tests(&[110.0; 9], &[]));
    let found = by(Method::Probit, &few);
    let (low, high) = (found.low_m_s.unwrap(), found.high_m_s.unwrap());
    assert!((low - 110.0).abs() < 1e-6 && high > 111.0, "{low} {high}");
}

#[test]
fn the_mean_takes_as_many_pairs_as_the_span_allows() {
    let many = tests(&[150.0, 178.0, 182.0, 188.0], &[184.0, 190.0, 194.0, 240.0]);
    let of = |span| {
        estimate(&many, span)
            .of(Method::MeanOfExtremes)
            .unwrap()
            .clone()
    };
    let (two, three) = (of(12.0), of(38.1));
    assert_eq!((two.tests_used, two.v50_m_s), (Some(4), Some(186.0)));
    assert_eq!((two.span_m_s, three.span_m_s), (Some(8.0), Some(16.0)));
    assert_eq!(
        three.v50_m_s,
        Some((178.0 + 182.0 + 188.0 + 184.0 + 190.0 + 194.0) / 6.0)
    );
    let none = of(7.0);
    assert_eq!(none.v50_m_s, None);
    assert!(none.reason.unwrap().contains("span 8 m/s, more than 7 m/s"));
}

#[test]
fn tests_of_one_kind_and_reversed_ones_give_reasons() {
    for (kind, pattern, words) in [
        (
            tests(&[180.0, 190.0], &[]),
            Pattern::AllStopped,
            "there is no complete penetration",
        ),
        (
            tests(&[], &[180.0, 190.0]),
            Pattern::AllPerforated,
            "there is no partial penetration",
        ),
        (
            tests(&[190.0, 195.0], &[180.0]),
            Pattern::Reversed,
            "the partial penetrations are faster",
        ),
    ] {
        let v50 = estimate(&kind, SPAN);
        assert_eq!(v50.pattern, pattern);
        assert!(v50.estimates[0].reason.as_ref().unwrap().contains(words));
        assert!(v50.estimates.iter().all(|entry| entry.v50_m_s.is_none()));
    }
    // Mixed, and yet the faster ones are stopped more often.
    let falling = tests(&[180.0, 195.0, 196.0, 197.0], &[178.0, 179.0, 181.0, 196.5]);
    let none = by(Method::Logit, &falling);
    assert!(none.reason.unwrap().contains("no more often"));
}

#[test]
fn velocities_have_the_unit_of_their_column_and_results_several_words() {
    let read = |text: &str| read_str("tests.csv", text).unwrap();
    let (feet, metres) = (
        read("Velocity (ft/s),perforated\n1000,CP\n900,PP\n"),
        read("impact_velocity_m_s,perforated\n304.8,Yes\n274.32,0\n"),
    );
    for (feet, metres) in feet.iter().zip(&metres) {
        assert!((feet.impact_velocity - metres.impact_velocity).abs() < 1e-9);
        assert_eq!(feet.perforated, metres.perforated);
    }
    assert_eq!(
        feet,
        read("impact_velocity_ft_s,perforated\n1000,complete\n900,partial\n")
    );
}

#[test]
fn a_file_is_read_and_what_is_wrong_in_it_has_its_place() {
    let text =
        "impact_velocity_m_s,perforated,note\n184.3,yes,\n\n 184.8 , no ,\"stopped, just\"\n";
    let read = read_str("tests.csv", text).unwrap();
    assert_eq!(
        read,
        tests(&[184.8], &[184.3])
            .into_iter()
            .rev()
            .collect::<Vec<_>>()
    );
    let error = |text: &str| match read_str("tests.csv", text) {
        Err(Error::Input(error)) => (error.line(), error.key.clone(), error.to_string()),
        other => panic!("{other:?}"),
    };
    for (text, line, key, words) in [
        (
            "impact_velocity_m_s,perforated\n184,maybe\n",
            2,
            "perforated",
            "unknown value `maybe`",
        ),
        (
            "impact_velocity_m_s,perforated\n184,stopped\n",
            2,
            "perforated",
            "CP or PP",
        ),
        (
            "impact_velocity_m_s,perforated\n184,\n",
            2,
            "perforated",
            "`perforated` is empty",
        ),
        (
            "impact_velocity_m_s,perforated\n1,yes\nfast,no\n",
            3,
            "impact_velocity_m_s",
            "`fast` is no number",
        ),
        (
            "impact_velocity_m_s,perforated\n-5,no\n",
            2,
            "impact_velocity_m_s",
            "-5 m/s is out of range",
        ),
        (
            "impact_velocity_m_s,perforated\n99999,no\n",
            2,
            "impact_velocity_m_s",
            "allowed: 0 to 10000 m/s",
        ),
        (
            "velocity,perforated\n184,no\n",
            1,
            "velocity",
            "write `velocity (m/s)`; units: m/s",
        ),
        (
            "impact_velocity_m_s:perforated\n184:no\n",
            1,
            "",
            "separated by commas, semicolons or tabs",
        ),
        ("impact_velocity_m_s\n184\n", 1, "", "lacks `perforated`"),
        (
            "impact_velocity_m_s,holed\n184,yes\n",
            1,
            "",
            "`perforated` can also be named `result`, `outcome`",
        ),
        (
            "impact_velocity_m_s,perforated\n184,P\n",
            2,
            "perforated",
            "unknown value `P`",
        ),
        (
            "impact_velocity_m_s,impact_velocity_m_s\n1,2\n",
            1,
            "impact_velocity_m_s",
            "two columns",
        ),
        (
            "V0 (m/s),Vs [ft/s],Result\n1,2,CP\n",
            1,
            "Vs [ft/s]",
            "two columns are of `impact_velocity`: `V0 (m/s)` and `Vs [ft/s]`",
        ),
        (
            "impact_velocity_m_s,perforated\n184\n",
            2,
            "impact_velocity_m_s",
            "the row has 1 fields",
        ),
        ("impact_velocity_m_s,perforated\n", 1, "", "holds no test"),
    ] {
        let found = error(text);
        assert_eq!((found.0, found.1.as_str()), (line, key), "{text}");
        assert!(found.2.contains(words), "{words:?} is not in {:?}", found.2);
    }
}

/// A spreadsheet where a comma stands before decimals separates columns by semicolons.
#[test]
fn tables_of_spreadsheets_are_read() {
    let plain = "velocity (m/s),perforated\n184.3,no\n188.5,yes\n";
    let expected = read_str("tests.csv", plain).unwrap();
    for text in [
        "velocity (m/s);Result\r\n184,3;PP\r\n188,5;CP\r\n",
        "velocity (km/h);penetration\n663,48;partial\n678,6;complete\n",
        "impact_velocity_m_s\toutcome\n184.3\t0\n188.5\t1\n",
        "Velocity, m/s;Perforation?\n184,3;no\n188,5;yes\n",
        "\"Striking velocity, V_s [m/s]\",CP/PP\n184.3,PP\n188.5,CP\n",
        "V-impact km/s,Penetration\n.1843,Partial penetration\n.1885,COMPLETE\n",
        "# Range 2\n#\nV0 (m/s);Outcome\n184,3;partial\n188,5;complete penetration\n",
        "# V0_m_s,Outcome\n184.3,PP\n188.5,CP\n",
        "V0 (m/s),Perforation? (Y/N)\n184.3,N\n188.5,Y\n",
        "V0 (m/s),Result [C/P]\n184.3,P\n188.5,C\n",
    ] {
        let read = read_str("tests.csv", text).unwrap_or_else(|error| panic!("{error}"));
        for (read, expected) in read.iter().zip(&expected) {
            assert_eq!(read.perforated, expected.perforated, "{text}");
            assert!(
                (read.impact_velocity - expected.impact_velocity).abs() < 1e-9,
                "{text}"
            );
        }
    }
    for (text, words) in [
        (
            "velocity (m/s);result\n1,020;no\n1,040;yes\n",
            "decimals or between thousands",
        ),
        (
            "velocity (ft/s)\tresult\n2,750\tno\n995.5\tyes\n",
            "has a point before other decimals",
        ),
    ] {
        let error = read_str("tests.csv", text).unwrap_err().to_string();
        assert!(
            error.contains("is ambiguous") && error.contains(words),
            "{error}"
        );
    }
    // Other commas tell.
    let tabs = read_str(
        "tests.csv",
        "velocity (km/s)\tresult\n1,020\tno\n1,03\tyes\n",
    )
    .unwrap();
    assert!((tabs[0].impact_velocity - 1020.0).abs() < 1e-9);
    let error = read_str("tests.csv", "velocity (m/s);result\n1.184,3;no\n").unwrap_err();
    assert!(
        error.to_string().contains("`1.184,3` is no number"),
        "{error}"
    );
}
