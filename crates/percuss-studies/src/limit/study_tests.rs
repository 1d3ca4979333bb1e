//! Rear face, limits that are inputs, and recommendation of a study of ballistic limits.

use super::{
    tests::{BLUNT, scenario, search},
    *,
};
use crate::{
    analytic::{AwerbuchBodner, LambertJonas, Plugging, PowerBalance, RechtIpson},
    case::RearFaceCondition,
    chain::Chain,
    scenario::TargetBody,
};

const FREE: &str = "back_face = \"free\"";
const FIXED: &str = "back_face = \"fixed\"";
/// A plate whose column is perforated by a fast rod.
const SHEET: &str = r#"
    projectile = { material = "copper", length = "20 mm", diameter = "5 mm", impact_velocity = "300 m/s" }
    target = { material = "aluminium-2024-t351", thickness = "5 mm"BACK }
    chain = { projectile_elements = 10, target_elements = 8 }
"#;

fn sheet(back: &str) -> Scenario {
    let back = match back {
        "" => String::new(),
        back => format!(", {back}"),
    };
    scenario(&SHEET.replace("BACK", &back))
}

/// A rear face that the case leaves open is that of a case that says it is free, to the last bit.
#[test]
fn a_rear_face_that_is_not_given_is_free() {
    let search = search(0.0, 1500.0, 3);
    let of =
        |back: &str| limits(&[&Chain], &sheet(back), &search, &mut Observer::default()).unwrap();
    let (open, free) = (of(""), of(FREE));
    assert_eq!(open.results[0].outcome, LimitOutcome::Found, "{open:?}");
    assert_eq!(open.results, free.results);
    let assumed = |assumed| {
        Some(RearFace {
            condition: RearFaceCondition::Free,
            assumed,
        })
    };
    assert_eq!(
        (open.rear_face, free.rear_face),
        (assumed(true), assumed(false))
    );
    assert!(
        open.rear_face
            .unwrap()
            .describe()
            .unwrap()
            .contains("taken as free")
    );
    assert_eq!(free.rear_face.unwrap().describe(), None);
    // A run of the same case keeps its own default.
    let TargetBody::Layers { back_face, .. } = sheet("").target else {
        panic!("a plate has layers");
    };
    assert_eq!(back_face, RearFaceCondition::Fixed);
}

/// The target resistance model of a case that gives none is chosen again for the free rear face.
#[test]
fn a_free_rear_face_is_the_one_that_a_case_would_write_down() {
    let thick = |back: &str| {
        scenario(&format!(
            "projectile = {{ material = 'copper', length = '20 mm', diameter = '5 mm', impact_velocity = '300 m/s' }}\n\
             target = {{ material = 'aluminium-2024-t351', thickness = '26 mm'{back} }}"
        ))
    };
    let assumed = with_free_rear_face(&thick("")).unwrap();
    let written = thick(", back_face = 'free'");
    assert_eq!(
        (&assumed.target, &assumed.options),
        (&written.target, &written.options)
    );
    assert_eq!(with_free_rear_face(&written), None);
    let semi_infinite = "projectile = { material = 'copper', length = '20 mm', diameter = '5 mm', impact_velocity = '300 m/s' }\n\
                         target = { material = 'copper', thickness = 'semi-infinite' }";
    assert_eq!(with_free_rear_face(&scenario(semi_infinite)), None);
}

#[test]
fn nothing_leaves_through_a_fixed_rear_face() {
    let models: [&dyn Model; 2] = [&Chain, &Plugging];
    let found = limits(
        &models,
        &sheet(FIXED),
        &search(0.0, 1500.0, 3),
        &mut Observer::default(),
    );
    let found = found.unwrap();
    for entry in &found.results {
        assert_eq!(
            (entry.outcome, entry.runs),
            (LimitOutcome::NeverPerforates, 0)
        );
        let reason = entry.reason.as_deref().unwrap();
        assert!(reason.starts_with("perforation is impossible"), "{reason}");
    }
    let said = found.rear_face.unwrap().describe().unwrap();
    assert!(said.contains("fixes the rear face"), "{said}");
}

/// A model that starts from a limit repeats it: that is no prediction, whoever gives the limit.
#[test]
fn a_limit_that_is_an_input_is_none() {
    let given = "recht_ipson = { ballistic_limit = \"184.5 m/s\" }\n";
    let models: [&dyn Model; 3] = [&Plugging, &RechtIpson, &LambertJonas];
    let blunt = scenario(&format!("{BLUNT}{given}")).at_impact_velocity(1900.0);
    let found = limits(
        &models,
        &blunt,
        &search(0.0, 800.0, 6),
        &mut Observer::default(),
    )
    .unwrap();
    let [plugging, recht_ipson, lambert_jonas] = found.results.as_slice() else {
        panic!("{found:?}");
    };
    let range = found.range.unwrap();
    assert_eq!(
        (range.models, Some(range.lowest_m_s)),
        (1, plugging.ballistic_limit_m_s)
    );
    for (entry, limit, origin) in [
        (recht_ipson, 184.5, None),
        (lambert_jonas, 131.429_55, Some("plugging")),
    ] {
        assert_eq!(entry.outcome, LimitOutcome::Input);
        assert_eq!((entry.ballistic_limit_m_s, entry.bracket), (None, None));
        let input = entry.input_limit.unwrap();
        assert!(
            (input.ballistic_limit_m_s - limit).abs() < 1e-4,
            "{input:?}"
        );
        assert_eq!(input.computed_by, origin);
        assert_eq!(entry.curve.len(), 6);
    }
}

#[test]
fn the_first_choice_at_its_own_limit_is_recommended() {
    let models: [&dyn Model; 2] = [&PowerBalance, &AwerbuchBodner];
    let of = |scenario: &Scenario, models: &[&dyn Model]| {
        limits(
            models,
            scenario,
            &search(0.0, 1600.0, 0),
            &mut Observer::default(),
        )
        .unwrap()
    };
    let blunt = of(&scenario(BLUNT), &models);
    let names: Vec<_> = blunt
        .recommended
        .iter()
        .map(|choice| choice.model)
        .collect();
    assert_eq!(names, ["power_balance"], "{blunt:?}");
    assert!(blunt.is_recommended("power_balance") && blunt.note.is_none());
    // Too few limits of steel plates under flat noses are published; of aluminium plates there are enough.
    assert_eq!(
        blunt.without_expected_error(),
        ["power_balance", "awerbuch_bodner"]
    );
    let light = BLUNT.replace("weldox-460-e", "aluminium-2024-t351");
    let light = of(&scenario(&light), &models);
    let expected = light.results[0].expected_error.as_ref().unwrap();
    assert!(expected.errors.low < expected.errors.median, "{expected:?}");
    // The aluminium plates of published limits have no damage in their records, which changes no limit of these models.
    let damaged = BLUNT.replace("weldox-460-e", "6061-t6-lesuer");
    let damaged = of(&scenario(&damaged), &models);
    assert_eq!(damaged.without_expected_error(), Vec::<&str>::new());
    // The chain is a first choice for depths; its limits have not been compared with measured ones.
    let sheet = of(&sheet(""), &[&Chain]);
    assert_eq!(
        (sheet.recommended.len(), &sheet.results[0].expected_error),
        (0, &None)
    );
    let note = sheet.note.unwrap();
    assert!(note.contains("no model is the first choice"), "{note}");
}

/// A model outside its ranges does not come first where its error there is not known: a rod of tool steel deforms in three diameters of RHA.
#[test]
fn a_limit_outside_the_ranges_of_its_model_is_not_recommended() {
    let of = |thickness: f64| {
        let case = scenario(&format!(
            r#"
            projectile = {{ material = "tool-steel-hrc53", length = "60 mm", diameter = "10 mm", impact_velocity = "400 m/s" }}
            target = {{ material = "rha-class-1", thickness = "{thickness} mm" }}
            "#
        ));
        let search = search(0.0, 1600.0, 0);
        limits(&[&PowerBalance], &case, &search, &mut Observer::default()).unwrap()
    };
    assert!(of(15.0).is_recommended("power_balance"));
    let thick = of(30.0);
    assert_eq!(
        (thick.results[0].outcome, thick.recommended.len()),
        (LimitOutcome::Found, 0)
    );
}

/// A disc, a thin plate and a search by `axi` that take a second.
fn disc(budget: Option<f64>) -> (Scenario, Search) {
    let disc = scenario(
        r#"
        projectile = { material = "tool-steel-hrc53", length = "10 mm", diameter = "20 mm", impact_velocity = "300 m/s" }
        target = { material = "weldox-460-e", thickness = "5 mm" }
        axi = { target_radius = "30 mm" }
        "#,
    );
    let search = Search {
        tolerance: Tolerance::Relative(0.03),
        axisymmetric: Some(Request {
            budget,
            ..Request::default()
        }),
        ..search(100.0, 900.0, 0)
    };
    (disc, search)
}

/// The axisymmetric limit is the choice where no first choice has an expected error, but for flat noses; a plate without data of failure leaves it
/// out.
#[test]
fn the_axisymmetric_limit_is_recommended_where_no_other_one_is_judged() {
    let (steel, search) = disc(None);
    let by = |model: &dyn Model, case: &Scenario| {
        limits(&[model], case, &search, &mut Observer::default()).unwrap()
    };
    let of = |case: &Scenario| by(&PowerBalance, case);
    let chosen = |found: &Limits| Vec::from_iter(found.recommended.iter().map(|c| c.model));
    let found = by(&AwerbuchBodner, &steel);
    assert_eq!((chosen(&found), found.note), (vec!["axi"], None));
    // A first choice under a flat nose stands before it, with the range where they differ much.
    let found = of(&steel);
    assert_eq!(chosen(&found), ["power_balance"]);
    let axisymmetric = found.axisymmetric.as_ref().unwrap();
    assert_eq!(found.contradiction, axisymmetric.ballistic_limit_m_s);
    let note = found.note.unwrap();
    assert!(
        note.starts_with("the axisymmetric limit is 1.5 times"),
        "{note}"
    );
    let light = |failure_strain: Option<f64>| {
        let mut light = scenario(
            r#"
            projectile = { material = "tool-steel-hrc53", length = "10 mm", diameter = "20 mm", impact_velocity = "300 m/s" }
            target = { material = "aluminium-2024-t351", thickness = "5 mm" }
            axi = { target_radius = "30 mm" }
            "#,
        );
        light.options.axi.failure_strain = failure_strain;
        light
    };
    for case in [light(None), light(Some(1.0))] {
        let found = of(&case);
        assert!(
            found
                .axisymmetric
                .as_ref()
                .unwrap()
                .ballistic_limit_m_s
                .is_some()
        );
        assert!(found.results[0].expected_error.is_some());
        assert_eq!(chosen(&found), ["power_balance"]);
        // A plate that cannot fail has too high a limit by `axi`: that contradicts nothing.
        let cannot_fail = case.options.axi.failure_strain.is_none();
        assert!(!cannot_fail || found.contradiction.is_none());
    }
    // Where such a plate holds at every velocity, no other range of velocities is advised.
    let slow = Search {
        axisymmetric: search.axisymmetric,
        ..self::search(5.0, 10.0, 0)
    };
    let case = light(None);
    let held = limits(&[&PowerBalance], &case, &slow, &mut Observer::default()).unwrap();
    let reason = held.axisymmetric.unwrap().reason.unwrap();
    assert!(
        reason.contains("has no `damage` in its record") && !reason.contains("range"),
        "{reason}"
    );
}

/// Beyond the budget there is the cost and the remedy, and the other models have their limits.
#[test]
fn an_axisymmetric_limit_beyond_its_budget_is_left_out_with_the_reason() {
    let (steel, search) = disc(Some(0.01));
    let found = limits(&[&PowerBalance], &steel, &search, &mut Observer::default()).unwrap();
    let left_out = found.axisymmetric.unwrap();
    assert_eq!(
        (left_out.ballistic_limit_m_s, left_out.meshes.len()),
        (None, 0)
    );
    let reason = left_out.reason.unwrap();
    assert!(
        reason.contains("s of processor time") && reason.contains("--reference standard"),
        "{reason}"
    );
    assert_eq!(found.results[0].outcome, LimitOutcome::Found);
    assert_eq!(found.recommended[0].model, "power_balance");
}

/// The coarsest mesh is searched about the limits of the other models, and everywhere where it has none there.
#[test]
fn limits_of_other_models_narrow_the_first_search() {
    let (steel, search) = disc(None);
    let first = |others: Option<LimitRange>| {
        let request = search.axisymmetric.unwrap();
        let free = with_free_rear_face(&steel).unwrap();
        let found =
            axisymmetric::on_meshes(&free, &request, &search, others, &mut Observer::default());
        found.unwrap().meshes[0]
    };
    let others = |lowest_m_s: f64, highest_m_s: f64| {
        Some(LimitRange {
            lowest_m_s,
            highest_m_s,
            models: 2,
        })
    };
    let everywhere = first(None);
    let limit = everywhere.ballistic_limit_m_s.unwrap();
    // A range of 0.9 limits takes one halving less than the whole one, a range of 1.6 limits as many: 19 runs.
    let near = first(others(0.6 * limit, 0.6 * limit));
    assert!(near.runs < everywhere.runs, "{near:?} {everywhere:?}");
    assert!((near.ballistic_limit_m_s.unwrap() / limit - 1.0).abs() < 0.06);
    let far = first(others(0.2 * limit, 0.3 * limit));
    assert_eq!(far.bracket, everywhere.bracket);
    assert!(far.runs > everywhere.runs);
}

/// The second and third mesh are searched about the limit of the one before, and progress counts on.
#[test]
fn the_axisymmetric_limit_has_three_meshes_and_an_uncertainty() {
    let (disc, search) = disc(None);
    let mut last = Progress {
        finished: 0,
        total: 0,
        fraction: 0.0,
    };
    let mut rises = true;
    let mut report = |now: Progress| {
        rises &= now.fraction >= last.fraction - 1e-12 && now.finished >= last.finished;
        last = now;
        std::ops::ControlFlow::Continue(())
    };
    let mut observer = Observer {
        progress: Some(&mut report),
    };
    let found = limits(&[&PowerBalance], &disc, &search, &mut observer).unwrap();
    let limit = found.axisymmetric.unwrap();
    println!("{limit:?}");
    assert!(rises && (last.fraction - 1.0).abs() < 1e-9);
    let cells: Vec<u32> = limit.meshes.iter().map(|m| m.cells_per_radius).collect();
    assert_eq!(cells, [3, 4, 6]);
    let runs: usize = limit.meshes.iter().map(|mesh| mesh.runs).sum();
    assert_eq!(last.finished, runs + found.results[0].runs);
    for mesh in &limit.meshes {
        let bracket = mesh.bracket.unwrap();
        let width = bracket.perforated_m_s - bracket.stopped_m_s;
        assert!(width <= 0.03 * bracket.perforated_m_s && width > 0.0);
    }
    let (value, uncertainty) = (
        limit.ballistic_limit_m_s.unwrap(),
        limit.uncertainty_m_s.unwrap(),
    );
    let finest = limit.meshes[2].ballistic_limit_m_s.unwrap();
    assert!((150.0..850.0).contains(&value) && uncertainty >= 0.07 * finest * (1.0 - 1e-12));
    // Without a plate there is a reason.
    let thick = scenario(
        r#"
        projectile = { material = "copper", length = "10 mm", diameter = "5 mm", impact_velocity = "300 m/s" }
        target = { material = "aluminium-2024-t351", thickness = "semi-infinite" }
        "#,
    );
    let none = limits(&[&PowerBalance], &thick, &search, &mut Observer::default()).unwrap();
    let none = none.axisymmetric.unwrap();
    assert_eq!((none.ballistic_limit_m_s, none.meshes.len()), (None, 0));
    assert!(none.reason.unwrap().contains("no rear face"), "a reason");
}
