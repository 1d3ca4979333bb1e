//! Comparisons of models made up for the purpose.

use std::{ops::ControlFlow, sync::Mutex};

use super::{Observer, compare};
use crate::{
    Error, NumericalError, Scenario,
    axisymmetric::{self, ReferenceMeshes, Request},
    case,
    made_up::MadeUp,
    material::MaterialClass,
    model::{self, Control, Model},
    outcome::{BandQuantity, Outcome, RunResult, Termination},
    regime::{ProjectileRegime, Regime, TargetKind},
    validity::{FirstChoice, Measure, NoseKind, Outside, Range, ValidityDomain},
};

fn result(outcome: Outcome, depth: f64, residual: f64) -> RunResult {
    let mut result = RunResult::new("", "", outcome, Termination::ClosedForm);
    result.depth_of_penetration = Some(depth);
    result.residual_velocity = Some(residual);
    result
}

fn deep(scenario: &Scenario) -> Result<RunResult, Error> {
    Ok(result(
        Outcome::AtRest,
        1e-6 * scenario.impact_velocity,
        0.0,
    ))
}

fn through(scenario: &Scenario) -> Result<RunResult, Error> {
    Ok(result(
        Outcome::Perforated,
        1e-2,
        0.5 * scenario.impact_velocity,
    ))
}

fn fails(_: &Scenario) -> Result<RunResult, Error> {
    Err(NumericalError {
        what: "the depth is not finite".to_owned(),
        step: 7,
        time_us: 1.0,
        element: None,
        remedy: "none".to_owned(),
    }
    .into())
}

const fn first_choice(projectile: ProjectileRegime) -> FirstChoice {
    FirstChoice {
        projectile,
        targets: TargetKind::ALL,
        noses: NoseKind::ALL,
        target_material: MaterialClass::Metal,
        because: "it is made up for it",
    }
}

const SLOW: ValidityDomain = ValidityDomain {
    ranges: &[Range {
        measure: Measure::ImpactSpeed,
        min: 0.0,
        max: 300.0,
        outside: Outside::NotApplicable,
        because: "it is slow",
    }],
    ..ValidityDomain::OPEN
};

const OPEN: MadeUp = MadeUp {
    name: "open",
    validity: ValidityDomain::OPEN,
    result: deep,
};

/// A copper rod of 5 mm on a target: deforming below some 300 m/s, eroding above.
fn scenario(target: &str, more: &str) -> Scenario {
    case::load_str(
        "run",
        &format!(
            "projectile = {{ material = 'copper', length = '20 mm', diameter = '5 mm', impact_velocity = '200 m/s' }}\n\
             target = {{ {target} }}\n{more}"
        ),
    )
    .unwrap()
}

const SEMI_INFINITE: &str = "material = 'aluminium-2024-t351', thickness = 'semi-infinite'";

#[test]
fn entries_stand_in_order_and_a_failure_stops_nothing() {
    let failing = MadeUp {
        name: "failing",
        result: fails,
        ..OPEN
    };
    let slow = MadeUp {
        name: "slow",
        validity: SLOW,
        ..OPEN
    };
    let models: [&dyn Model; 3] = [&failing, &slow, &OPEN];
    let velocities: Vec<f64> = (1..=40).map(|i| 20.0 * f64::from(i)).collect();
    let comparison = compare(
        &models,
        None,
        &scenario(SEMI_INFINITE, ""),
        &velocities,
        &mut Observer::default(),
    )
    .unwrap();
    assert_eq!(comparison.velocities(), velocities);
    assert_eq!(comparison.models(), ["failing", "slow", "open"]);
    for (i, &velocity) in velocities.iter().enumerate() {
        let [failing, slow, open] = comparison.at_impact_velocity(i) else {
            panic!("{} entries", comparison.at_impact_velocity(i).len());
        };
        assert_eq!(failing.outcome, Outcome::Failed);
        assert!(
            failing
                .reason
                .as_ref()
                .unwrap()
                .contains("not finite at step 7")
        );
        assert_eq!(slow.is_result(), velocity <= 300.0);
        assert_eq!(slow.reason.is_some(), velocity > 300.0);
        assert_eq!(open.impact_velocity_m_s, velocity);
        assert!((open.depth_of_penetration_mm.unwrap() - 1e-3 * velocity).abs() < 1e-12);
        assert_eq!(comparison.recommended[i].impact_velocity_m_s, velocity);
    }
    assert_eq!(comparison.quantities, [BandQuantity::DepthOfPenetration]);
    assert!(comparison.has_results());
    let none = compare(
        &models[..1],
        None,
        &scenario(SEMI_INFINITE, ""),
        &[100.0],
        &mut Observer::default(),
    );
    assert!(!none.unwrap().has_results());
}

#[test]
fn a_comparison_is_the_same_every_time() {
    let velocities = [100.0, 200.0, 400.0];
    let scenario = scenario(SEMI_INFINITE, "");
    let one = compare(
        &model::fast_models(),
        None,
        &scenario,
        &velocities,
        &mut Observer::default(),
    )
    .unwrap();
    let two = compare(
        &model::fast_models(),
        None,
        &scenario,
        &velocities,
        &mut Observer::default(),
    )
    .unwrap();
    assert_eq!(one, two);
    let alone = model::run(
        model::model("chain").unwrap(),
        &scenario,
        &mut Control::default(),
    );
    let depth = alone.unwrap().depth_of_penetration.unwrap() * 1e3;
    let compared = one.of_model("chain").nth(1).unwrap();
    assert_eq!(compared.depth_of_penetration_mm, Some(depth));
}

#[test]
fn the_leading_quantity_follows_from_the_target() {
    let wide = MadeUp {
        name: "through",
        result: through,
        ..OPEN
    };
    let leading = |model: &MadeUp, target: &str| {
        compare(
            &[model],
            None,
            &scenario(target, ""),
            &[200.0],
            &mut Observer::default(),
        )
        .unwrap()
        .quantities
    };
    let plate = "material = 'copper', thickness = '10 mm'";
    let thin = "material = 'copper', thickness = '4 mm'";
    assert_eq!(leading(&OPEN, plate), [BandQuantity::DepthOfPenetration]);
    assert_eq!(leading(&wide, plate), [BandQuantity::ResidualVelocity]);
    assert_eq!(leading(&OPEN, thin), [BandQuantity::ResidualVelocity]);
    // What nothing gives cannot lead.
    assert_eq!(
        leading(&OPEN, "rigid_wall = true"),
        [BandQuantity::DepthOfPenetration]
    );
    let chain = model::model("chain").unwrap();
    let wall = compare(
        &[chain],
        None,
        &scenario("rigid_wall = true", ""),
        &[90.0],
        &mut Observer::default(),
    );
    assert_eq!(
        wall.unwrap().quantities,
        [BandQuantity::ProjectileFinalLength]
    );
}

#[test]
fn a_first_choice_is_recommended_if_it_gives_a_result() {
    const DEFORMING: &[FirstChoice] = &[first_choice(ProjectileRegime::Deforming)];
    const ERODING: &[FirstChoice] = &[first_choice(ProjectileRegime::Eroding)];
    let validity = |first_choice| ValidityDomain {
        first_choice,
        ..ValidityDomain::OPEN
    };
    let deforming = MadeUp {
        name: "deforming",
        validity: validity(DEFORMING),
        ..OPEN
    };
    let eroding = MadeUp {
        name: "eroding",
        validity: validity(ERODING),
        ..OPEN
    };
    let failing = MadeUp {
        name: "failing",
        validity: validity(ERODING),
        result: fails,
    };
    let at = |models: &[&dyn Model], velocity: f64| {
        let scenario = scenario(SEMI_INFINITE, "");
        let comparison = compare(
            models,
            None,
            &scenario,
            &[velocity],
            &mut Observer::default(),
        )
        .unwrap();
        let recommendation = comparison.recommended[0].clone();
        let names: Vec<&str> = recommendation
            .models
            .iter()
            .map(|choice| choice.model)
            .collect();
        (
            names.join(" "),
            recommendation.note.unwrap_or_default(),
            comparison.regime[0].regime.clone(),
        )
    };
    let (names, note, regime) = at(&[&OPEN, &deforming, &eroding], 1500.0);
    assert_eq!(
        (names.as_str(), note.as_str()),
        ("eroding", ""),
        "{regime:?}"
    );
    let (names, note, _) = at(&[&OPEN, &deforming, &failing], 1500.0);
    assert_eq!(names, "");
    assert!(
        note.starts_with("`failing` would be a first choice, but"),
        "{note}"
    );
    assert!(note.contains("take the spread"), "{note}");
    let (names, note, _) = at(&[&OPEN], 1500.0);
    assert_eq!(names, "");
    assert!(note.contains("one gives a result"), "{note}");
}

#[test]
fn a_neighbouring_regime_is_named() {
    const RIGID: &[FirstChoice] = &[first_choice(ProjectileRegime::Rigid)];
    const DEFORMING: &[FirstChoice] = &[first_choice(ProjectileRegime::Deforming)];
    let rigid = MadeUp {
        name: "rigid",
        validity: ValidityDomain {
            first_choice: RIGID,
            ..ValidityDomain::OPEN
        },
        ..OPEN
    };
    let soft = MadeUp {
        name: "soft",
        validity: ValidityDomain {
            first_choice: DEFORMING,
            ..ValidityDomain::OPEN
        },
        ..OPEN
    };
    // A perfectly plastic rod of 400 MPa against 500 MPa: it deforms, and 500 is within 1.5 × 400.
    let text = "projectile = { material = 'm', length = '20 mm', diameter = '5 mm', impact_velocity = '100 m/s' }\n\
                target = { constant_pressure = '500 MPa' }\n\
                [materials.m]\nname = 'm'\ndensity = '8000 kg/m3'\nyoungs_modulus = '200 GPa'\npoissons_ratio = 0.3\n\
                strength.perfectly_plastic.flow_stress = '400 MPa'";
    let scenario = case::load_str("edge", text).unwrap();
    let recommend = |models: &[&dyn Model]| {
        let comparison =
            compare(models, None, &scenario, &[100.0], &mut Observer::default()).unwrap();
        let recommendation = comparison.recommended[0].clone();
        (recommendation.models[0].model, recommendation.note.unwrap())
    };
    let (model, note) = recommend(&[&rigid, &soft]);
    assert_eq!(model, "soft");
    assert_eq!(
        note,
        "the projectile may also be rigid, for which `rigid` is the first choice: compare both"
    );
    let (model, note) = recommend(&[&rigid]);
    assert_eq!(model, "rigid");
    assert!(
        note.starts_with("no first choice for deforming projectiles"),
        "{note}"
    );
    // For a flat rod that erodes the model of a rigid one is no stand-in.
    let text = "projectile = { material = 'm', length = '50 mm', diameter = '10 mm', impact_velocity = '300 m/s' }\n\
                target = { material = 't', thickness = 'semi-infinite' }\n\
                [materials.m]\nname = 'm'\ndensity = '7850 kg/m3'\nyoungs_modulus = '200 GPa'\npoissons_ratio = 0.3\n\
                strength.perfectly_plastic.flow_stress = '1000 MPa'\n\
                [materials.t]\nname = 't'\ndensity = '2700 kg/m3'\nyoungs_modulus = '70 GPa'\npoissons_ratio = 0.33\n\
                strength.perfectly_plastic.flow_stress = '300 MPa'";
    let eroding = case::load_str("eroding", text).unwrap();
    let regime = Regime::of(&eroding);
    let stress_is_close = (ProjectileRegime::Eroding, Some(ProjectileRegime::Rigid));
    assert_eq!((regime.projectile, regime.neighbour), stress_is_close);
    let models: [&dyn Model; 2] = [&rigid, &soft];
    let comparison = compare(&models, None, &eroding, &[300.0], &mut Observer::default()).unwrap();
    assert!(comparison.recommended[0].models.is_empty());
    // Outside its range nothing is recommended, whether there is another one or not.
    const LONG: &[Range] = &[Range {
        measure: Measure::LengthToDiameter,
        min: 10.0,
        max: f64::INFINITY,
        outside: Outside::Warning,
        because: "it is made up",
    }];
    let long = MadeUp {
        name: "long",
        validity: ValidityDomain {
            ranges: LONG,
            first_choice: DEFORMING,
            ..ValidityDomain::OPEN
        },
        ..OPEN
    };
    let (model, note) = recommend(&[&rigid, &long]);
    assert_eq!(model, "rigid");
    assert!(
        note.starts_with("`long` would be a first choice, but length to diameter is 4"),
        "{note}"
    );
    let comparison = compare(
        &[&long],
        None,
        &scenario,
        &[100.0],
        &mut Observer::default(),
    );
    let alone = comparison.unwrap().recommended[0].clone();
    let note = alone.note.unwrap();
    assert!(alone.models.is_empty());
    assert!(
        note.starts_with("`long` would be a first choice, but length to diameter is 4")
            && note.ends_with("one gives a result"),
        "{note}"
    );
}

#[test]
fn measured_values_are_found_by_their_velocity() {
    let more = "[[experiments]]\nimpact_velocity = '200 m/s'\ndepth_of_penetration = '4 mm'\nsource = 'a'\n\
                [[experiments]]\nimpact_velocity = '200.1 m/s'\ndepth_of_penetration = '5 mm'\nuncertainty = '1 mm'\nsource = 'a'\n";
    let scenario = scenario(SEMI_INFINITE, more);
    let comparison = compare(
        &[&OPEN],
        None,
        &scenario,
        &[200.0, 300.0],
        &mut Observer::default(),
    )
    .unwrap();
    let depth = BandQuantity::DepthOfPenetration;
    assert_eq!(comparison.measured(depth, 200.0), Some((4.5, 2)));
    assert_eq!(comparison.measured(depth, 300.0), None);
    assert_eq!(
        comparison.measured(BandQuantity::ResidualVelocity, 200.0),
        None
    );
    assert_eq!(comparison.experiments[1].uncertainty, Some(1.0));
}

#[test]
fn progress_grows_to_the_end_and_can_stop_everything() {
    let seen = Mutex::new(Vec::new());
    let mut note = |now: super::Progress| {
        seen.lock().unwrap().push(now);
        ControlFlow::Continue(())
    };
    let mut observer = Observer {
        progress: Some(&mut note),
    };
    let scenario = scenario(SEMI_INFINITE, "");
    compare(
        &[&OPEN, &OPEN],
        None,
        &scenario,
        &[100.0, 200.0],
        &mut observer,
    )
    .unwrap();
    let seen = seen.into_inner().unwrap();
    assert!(
        seen.windows(2)
            .all(|pair| pair[0].fraction <= pair[1].fraction),
        "{seen:?}"
    );
    let last = seen.last().unwrap();
    assert_eq!((last.finished, last.total, last.fraction), (4, 4, 1.0));

    let mut stop = |now: super::Progress| match now.finished {
        0 => ControlFlow::Continue(()),
        _ => ControlFlow::Break(()),
    };
    let mut observer = Observer {
        progress: Some(&mut stop),
    };
    let stopped = compare(
        &[&OPEN, &OPEN],
        None,
        &scenario,
        &[100.0, 200.0],
        &mut observer,
    );
    assert!(matches!(stopped, Err(Error::Cancelled { .. })));
}

/// The entry of `axi` is the limit of its meshes with the discretisation uncertainty, and a first choice; beyond the budget it has the
/// reason.
#[test]
fn the_axisymmetric_answer_is_an_entry_with_its_range() {
    let scenario = case::load_str(
        "slow ball",
        "projectile = { material = 'copper', length = '5 mm', diameter = '5 mm', impact_velocity = '200 m/s' }\n\
         target = { material = 'aluminium-2024-t351', thickness = '25 mm' }\n\
         axi = { target_radius = '8 mm', target_depth = '8 mm' }\n",
    )
    .unwrap();
    let models: [&dyn Model; 1] = [crate::model::model("chain").unwrap()];
    let entry = |request: Request| {
        let mut observer = Observer::default();
        let found = compare(&models, Some(request), &scenario, &[200.0], &mut observer).unwrap();
        assert_eq!(found.models(), ["axi", "chain"]);
        let recommended = found.recommended[0].models.iter();
        let is_first = recommended.clone().any(|choice| choice.model == "axi");
        (found.results[0].clone(), is_first)
    };
    let (record, is_first) = entry(Request::default());
    let plan = axisymmetric::plan(&scenario, ReferenceMeshes::Standard, None).unwrap();
    let answer =
        axisymmetric::answer(&scenario, &plan, &mut |_| ControlFlow::Continue(())).unwrap();
    assert_eq!(
        record.depth_of_penetration_mm,
        answer.depth_of_penetration_mm
    );
    let band = record.band.unwrap();
    let width = 0.5 * (band.high - band.low);
    assert!((width - answer.uncertainty.unwrap()).abs() < 1e-12 && is_first);
    let (refused, is_first) = entry(Request {
        budget: Some(1e-6),
        ..Request::default()
    });
    let reason = refused.reason.unwrap();
    assert!(reason.contains("processor time") && !is_first, "{reason}");
}

/// Ceramics break, and only `particles` breaks them: others warn, and none is recommended, whatever its meshes say.
#[test]
fn no_model_that_keeps_brittle_materials_whole_is_recommended() {
    let scenario = case::load_str(
        "tile",
        r#"
        projectile = { material = "4340-johnson-cook", length = "8 mm", diameter = "8 mm", impact_velocity = "300 m/s" }
        target = { material = "alumina", thickness = "8 mm", back_face = "free" }
        "#,
    )
    .unwrap();
    let chain = model::model("chain").unwrap();
    let meshes = Some(Request::default());
    let found = compare(
        &[chain],
        meshes,
        &scenario,
        &[300.0],
        &mut Observer::default(),
    )
    .unwrap();
    assert!(found.recommended[0].models.is_empty());
    for record in &found.results {
        assert!(record.is_result());
        assert!(
            record
                .warnings
                .iter()
                .any(|said| said.contains("stays whole in this model"))
        );
    }
    let axi = &found.results[0].warnings[0];
    assert!(axi.starts_with("not to be relied on: alumina"), "{axi}");
}
