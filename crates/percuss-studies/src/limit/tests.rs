use std::ops::ControlFlow;

use super::*;
use crate::{
    analytic::{AwerbuchBodner, PlateCavity, Plugging, PowerBalance, RechtIpson},
    case,
    chain::Chain,
    model::Control,
    outcome::{Outcome, RunResult, Termination},
    validity::ValidityDomain,
};

pub(super) const BLUNT: &str = r#"
    projectile = { material = "tool-steel-hrc53", mass = "197 g", diameter = "20 mm", impact_velocity = "300 m/s" }
    target = { material = "weldox-460-e", thickness = "12 mm" }
"#;
const OGIVE: &str = r#"
    projectile = { material = "rigid", mass = "197 g", diameter = "20 mm", nose = { ogive = { crh = 3.0 } }, impact_velocity = "300 m/s" }
    target = { material = "aluminium-2024-t351", thickness = "26 mm" }
    materials.rigid = { name = "rigid", density = "7850 kg/m3", youngs_modulus = "210 GPa", poissons_ratio = 0.3, strength = { elastic = {} } }
"#;

pub(super) fn scenario(text: &str) -> Scenario {
    case::load_str("plate", text).unwrap_or_else(|error| panic!("{error}"))
}

pub(super) fn search(from: f64, to: f64, points: usize) -> Search {
    Search {
        axisymmetric: None,
        range: Range { from, to },
        points,
        tolerance: Tolerance::Absolute(0.5),
    }
}

fn one(model: &dyn Model, scenario: &Scenario, search: &Search) -> ModelLimit {
    let mut found = limits(&[model], scenario, search, &mut Observer::default()).unwrap();
    found.results.remove(0)
}

/// A model whose runs end as a function of the velocity says.
struct Made {
    outcome: fn(f64) -> Outcome,
    stated: Option<f64>,
}

impl Model for Made {
    fn name(&self) -> &'static str {
        "made"
    }
    fn summary(&self) -> &'static str {
        "made for tests"
    }
    fn validity(&self) -> &'static ValidityDomain {
        &ValidityDomain::OPEN
    }
    fn run(&self, scenario: &Scenario, _: &mut Control<'_>) -> Result<RunResult, Error> {
        let velocity = scenario.impact_velocity;
        let outcome = (self.outcome)(velocity);
        if outcome == Outcome::NotApplicable {
            return Err(Error::not_applicable("made", "too fast for it"));
        }
        Ok({
            let mut result = RunResult::new("made", "", outcome, Termination::ClosedForm);
            result.residual_velocity = Some(velocity);
            result.ballistic_limit = self.stated;
            result
        })
    }
}

fn made(outcome: fn(f64) -> Outcome) -> Made {
    Made {
        outcome,
        stated: None,
    }
}

fn over(velocity: f64, limit: f64) -> Outcome {
    match velocity > limit {
        true => Outcome::Perforated,
        false => Outcome::AtRest,
    }
}

/// The closed form of a model and the change of its own runs are found apart from each other and have to agree.
#[test]
fn bracketing_agrees_with_every_limit_in_closed_form() {
    let blunt = scenario(BLUNT);
    let fine = Search {
        tolerance: Tolerance::Absolute(1e-6),
        ..search(0.0, 2000.0, 0)
    };
    let sharp = scenario(OGIVE);
    // Awerbuch and Bodner's model states a root of its own integration in time.
    let cases: [(&dyn Model, &Scenario, f64); 4] = [
        (&Plugging, &blunt, 1e-6),
        (&AwerbuchBodner, &blunt, 1e-5),
        (&PlateCavity, &sharp, 1e-6),
        (&PowerBalance, &sharp, 1e-3),
    ];
    for (model, scenario, slack) in cases {
        let found = one(model, scenario, &fine);
        assert_eq!(found.outcome, LimitOutcome::Found, "{found:?}");
        let limit = found.stated_limit_m_s.unwrap();
        let bracket = found.bracket.unwrap();
        assert!(bracket.perforated_m_s - bracket.stopped_m_s <= 1e-6);
        assert!(
            bracket.stopped_m_s <= limit + slack && limit - slack <= bracket.perforated_m_s,
            "{}: {limit} and {bracket:?}",
            model.name()
        );
        assert!((found.ballistic_limit_m_s.unwrap() - limit).abs() <= slack);
    }
}

#[test]
fn the_curve_of_recht_and_ipson_is_one_of_lambert_and_jonas() {
    let text = format!("{BLUNT}recht_ipson = {{ ballistic_limit = \"184.5 m/s\" }}\n");
    let found = one(&RechtIpson, &scenario(&text), &search(0.0, 2000.0, 12));
    assert_eq!((found.curve.len(), found.runs), (12, 12));
    let last = found.curve[11];
    assert!((last.impact_velocity_m_s - 2.5 * 184.5).abs() < 1e-9);
    let fit = found.fit.unwrap();
    // p = 2 and a = m/(m + m_p) with the plug of 29.594 g.
    assert!((fit.p - 2.0).abs() < 1e-6, "{fit:?}");
    assert!((fit.a - 197.0 / (197.0 + 29.594)).abs() < 1e-5, "{fit:?}");
    assert!((fit.ballistic_limit_m_s - 184.5).abs() < 1e-5, "{fit:?}");
    assert!(fit.rms_m_s < 1e-6);
}

#[test]
fn the_fit_recovers_other_exponents_and_is_no_curve_for_three_points() {
    for (a, p, limit) in [(0.8, 2.6, 312.0), (1.0, 1.4, 90.0), (0.55, 6.0, 900.0)] {
        let known = LambertJonasFit {
            a,
            p,
            ballistic_limit_m_s: limit,
            rms_m_s: 0.0,
        };
        let points: Vec<CurvePoint> = (1..=8)
            .map(|i| limit * (1.0 + 0.15 * f64::from(i)))
            .map(|velocity| CurvePoint {
                impact_velocity_m_s: velocity,
                residual_velocity_m_s: known.at(velocity),
            })
            .collect();
        let fit = fit_lambert_jonas(&points).unwrap();
        assert!((fit.a / a - 1.0).abs() < 1e-6, "{fit:?}");
        assert!((fit.p / p - 1.0).abs() < 1e-5, "{fit:?}");
        assert!(
            (fit.ballistic_limit_m_s / limit - 1.0).abs() < 1e-6,
            "{fit:?}"
        );
        assert_eq!(fit_lambert_jonas(&points[..3]), None);
        let fixed = fit_lambert_jonas_from(limit, &points[..3]).unwrap();
        assert!((fixed.a / a - 1.0).abs() < 1e-6, "{fixed:?}");
        assert!((fixed.p / p - 1.0).abs() < 1e-6, "{fixed:?}");
        assert_eq!(fixed.ballistic_limit_m_s, limit);
        assert_eq!(fit_lambert_jonas_from(limit, &points[..2]), None);
    }
}

#[test]
fn the_curve_of_a_model_starts_at_the_limit_that_it_found() {
    // Residual velocities that jump at the limit, by 50 m/s: a free limit would be lower.
    let leaves = |velocity: f64| 50.0 + 0.9 * (velocity - 210.0);
    let points: Vec<CurvePoint> = (0..12)
        .map(|i| 212.0 + 20.0 * f64::from(i))
        .map(|velocity| CurvePoint {
            impact_velocity_m_s: velocity,
            residual_velocity_m_s: leaves(velocity),
        })
        .collect();
    let free = fit_lambert_jonas(&points).unwrap();
    assert!(free.ballistic_limit_m_s < 209.0, "{free:?}");
    let fixed = fit_lambert_jonas_from(210.0, &points).unwrap();
    assert_eq!((fixed.ballistic_limit_m_s, fixed.at(210.0)), (210.0, 0.0));
    assert!(
        fixed.at(210.1) > 0.0 && fixed.rms_m_s >= free.rms_m_s,
        "{fixed:?}"
    );
    // The least sum of squares: no neighbour within the bounds is better.
    let squares = |a: f64, p: f64| -> f64 {
        let curve = LambertJonasFit { a, p, ..fixed };
        points
            .iter()
            .map(|point| {
                (curve.at(point.impact_velocity_m_s) - point.residual_velocity_m_s).powi(2)
            })
            .sum()
    };
    let best = squares(fixed.a, fixed.p);
    for (a, p) in [(1.001, 1.0), (0.999, 1.0), (1.0, 1.001), (1.0, 0.999)] {
        assert!(
            squares(a * fixed.a, p * fixed.p) >= best,
            "{fixed:?} {a} {p}"
        );
    }
    let found = one(&Plugging, &scenario(BLUNT), &search(0.0, 800.0, 12));
    let limit = found.ballistic_limit_m_s.unwrap();
    let fit = found.fit.unwrap();
    assert_eq!((fit.ballistic_limit_m_s, fit.at(limit)), (limit, 0.0));
}

#[test]
fn never_and_always_are_outcomes() {
    let case = scenario(BLUNT);
    let never = one(
        &made(|_| Outcome::Rebounded),
        &case,
        &search(0.0, 800.0, 12),
    );
    assert_eq!(never.outcome, LimitOutcome::NeverPerforates);
    assert!(never.reason.unwrap().contains("up to 800 m/s"));
    assert_eq!((never.ballistic_limit_m_s, never.runs), (None, 16));
    let always = one(
        &made(|_| Outcome::Perforated),
        &case,
        &search(100.0, 800.0, 12),
    );
    assert_eq!(always.outcome, LimitOutcome::AlwaysPerforates);
    assert!(always.reason.unwrap().contains("from 100 m/s on"));
}

#[test]
fn perforation_that_is_not_monotone_is_said_so() {
    let gap = |velocity| match velocity {
        ..=500.0 => over(velocity, 210.0),
        _ => over(velocity, 900.0),
    };
    let found = one(&made(gap), &scenario(BLUNT), &search(0.0, 1600.0, 6));
    assert_eq!(found.outcome, LimitOutcome::Found);
    assert!((found.ballistic_limit_m_s.unwrap() - 210.0).abs() < 0.5);
    let said = found.warnings.iter().find(|w| w.contains("not monotone"));
    // The curve ends at 525 m/s, which is stopped.
    assert!(said.unwrap().contains("at 524.9 to 900 m/s"), "{said:?}");
    let reversed = one(
        &made(|velocity| match velocity < 400.0 {
            true => Outcome::Perforated,
            false => Outcome::AtRest,
        }),
        &scenario(BLUNT),
        &search(100.0, 1600.0, 6),
    );
    assert_eq!(reversed.outcome, LimitOutcome::Undecided);
    assert!(reversed.reason.unwrap().contains("above it"));
}

#[test]
fn velocities_without_an_answer_are_named() {
    let upper = |velocity| match velocity {
        ..=1000.0 => over(velocity, 300.0),
        _ => Outcome::NotApplicable,
    };
    let found = one(&made(upper), &scenario(BLUNT), &search(0.0, 1600.0, 4));
    assert_eq!(found.outcome, LimitOutcome::Found);
    let said = found
        .warnings
        .iter()
        .find(|w| w.contains("gives no answer"));
    assert!(said.unwrap().contains("1100 to 1600 m/s"), "{said:?}");
    assert!(said.unwrap().contains("too fast for it"));

    let zone = |velocity| match velocity {
        ..=300.0 => Outcome::AtRest,
        ..=450.0 => Outcome::Separated,
        _ => Outcome::Perforated,
    };
    let wide = one(&made(zone), &scenario(BLUNT), &search(0.0, 1600.0, 4));
    let bracket = wide.bracket.unwrap();
    assert!(bracket.stopped_m_s > 299.5 && bracket.perforated_m_s < 450.5);
    assert!(
        wide.warnings
            .iter()
            .any(|w| w.contains("inside the bracket"))
    );

    let unbounded = |velocity| match velocity {
        0.0 => Outcome::AtRest,
        ..=450.0 => Outcome::Separated,
        _ => Outcome::Perforated,
    };
    let none = one(&made(unbounded), &scenario(BLUNT), &search(0.0, 1600.0, 4));
    assert_eq!(none.outcome, LimitOutcome::Undecided);
    assert_eq!((none.ballistic_limit_m_s, none.bracket), (None, None));
    let reason = none.reason.unwrap();
    let words = "m/s; from 0.";
    assert!(
        reason.starts_with("complete penetration at 45") && reason.contains(words),
        "{reason}"
    );

    let nowhere = one(
        &made(|_| Outcome::NotApplicable),
        &scenario(BLUNT),
        &search(0.0, 1600.0, 4),
    );
    assert_eq!(nowhere.outcome, LimitOutcome::NotApplicable);
    assert_eq!(nowhere.reason.as_deref(), Some("too fast for it"));
}

#[test]
fn a_curve_that_jumps_at_the_limit_is_said_to_have_another_form() {
    // The made model loses no velocity at all.
    let model = made(|velocity| over(velocity, 300.0));
    let found = one(&model, &scenario(BLUNT), &search(0.0, 1600.0, 12));
    assert!(
        (found.curve[0].residual_velocity_m_s - found.curve[0].impact_velocity_m_s).abs() < 1e-12
    );
    let words = "do not follow the form of Lambert and Jonas";
    let said = found.warnings.iter().any(|w| w.contains(words));
    assert!(said, "{found:?}");
    let (fit, limit) = (found.fit.unwrap(), found.ballistic_limit_m_s.unwrap());
    assert_eq!((fit.ballistic_limit_m_s, fit.at(limit)), (limit, 0.0));
}

#[test]
fn a_stated_limit_that_runs_contradict_is_not_believed() {
    let model = Made {
        outcome: |velocity| over(velocity, 300.0),
        stated: Some(250.0),
    };
    let found = one(&model, &scenario(BLUNT), &search(0.0, 1600.0, 0));
    assert_eq!(found.stated_limit_m_s, Some(250.0));
    assert!((found.ballistic_limit_m_s.unwrap() - 300.0).abs() <= 0.25);
    assert!(found.warnings[0].contains("states a limit of 250 m/s"));
}

#[test]
fn what_has_no_back_or_says_nothing_of_perforation_is_not_applicable() {
    let wall = scenario(
        "projectile = { material = \"copper\", length = \"20 mm\", diameter = \"7 mm\", impact_velocity = \"200 m/s\" }\ntarget = { rigid_wall = true }",
    );
    let found = one(&Chain, &wall, &Search::default());
    assert_eq!(
        (found.outcome, found.runs),
        (LimitOutcome::NotApplicable, 0)
    );
    assert!(found.reason.unwrap().contains("no rear face"));
    let poncelet = one(
        &crate::analytic::Poncelet,
        &scenario(OGIVE),
        &Search::default(),
    );
    assert!(
        poncelet
            .reason
            .unwrap()
            .contains("does not predict perforation")
    );
}

#[test]
fn a_caller_can_stop_it() {
    let mut calls = 0;
    let mut stop = |now: Progress| {
        calls += 1;
        assert!((0.0..=1.0).contains(&now.fraction));
        match calls < 5 {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(()),
        }
    };
    let mut observer = Observer {
        progress: Some(&mut stop),
    };
    let models: [&dyn Model; 2] = [&Plugging, &AwerbuchBodner];
    let stopped = limits(&models, &scenario(BLUNT), &Search::default(), &mut observer);
    assert!(matches!(stopped, Err(Error::Cancelled { .. })));
}

/// The chain says by its shear band whether the plug is free: its limit is where it begins to be.
#[test]
fn the_chain_finds_the_limit_of_a_plug() {
    let blunt = |chain: &str| {
        scenario(&format!(
            r#"
            projectile = {{ material = "tool-steel-hrc53", mass = "197 g", diameter = "20 mm", impact_velocity = "300 m/s" }}
            target = {{ material = "weldox-460-e", thickness = "12 mm", back_face = "free", plate_diameter = "500 mm" }}
            chain = {{ projectile_elements = 20, target_elements = 12{chain} }}
            "#
        ))
    };
    let plug = blunt(", border_shear_law = \"shear-band\", dishing = true");
    let found = one(&Chain, &plug, &search(40.0, 300.0, 4));
    assert_eq!(found.outcome, LimitOutcome::Found, "{found:?}");
    let limit = found.ballistic_limit_m_s.unwrap();
    // By bracketing with a loop of its own, tests/plugging.rs has 224.4 m/s on this mesh.
    assert!((limit - 224.4).abs() < 1.5, "{limit}");
    let through = &found.curve;
    assert!(
        through
            .windows(2)
            .all(|pair| pair[0].residual_velocity_m_s < pair[1].residual_velocity_m_s)
    );
}
