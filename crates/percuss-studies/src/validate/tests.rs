use std::{ops::ControlFlow, sync::Mutex};

use super::*;
use crate::{
    experiments::{self, Kind, Split},
    made_up::MadeUp,
    material::references,
    model::{Control, MODELS},
    outcome::{BandQuantity, Outcome, RunResult, Termination},
    validity::{FittedTo, ValidityDomain},
};

/// A model whose ballistic limit is ten times the thickness in mm; it gives 450 m/s for 45 mm.
const MADE_UP: MadeUp = MadeUp {
    name: "made_up",
    validity: ValidityDomain {
        predicts: &[BandQuantity::BallisticLimit],
        fitted_to: &[FittedTo {
            sources: &["one"],
            because: "it was made up there",
        }],
        ..ValidityDomain::OPEN
    },
    result: |scenario| {
        let thickness = scenario.target_thickness().unwrap_or(f64::NAN);
        Ok({
            let mut result = RunResult::new("", "", Outcome::AtRest, Termination::ClosedForm);
            result.ballistic_limit = Some(1e4 * thickness).filter(|limit| *limit < 900.0);
            result
        })
    },
};

const FILE: &str = "\
id,source,kind,projectile_material,diameter_mm,mass_g,impact_velocity_m_s,target_material,thickness_mm,measured,unit,flag,duplicate_of,obliquity_deg
a,one,ballistic_limit,apm2-core 4340,6.2,5.3,,aluminium-2024-t351,45,500,m/s,,,
b,one,ballistic_limit,apm2-core,6.2,5.3,,aluminium-2024-t351,44,400,m/s,,,
c,two,ballistic_limit,apm2-core,6.2,5.3,,aluminium-2024-t351,20,100,m/s,,,
d,two,ballistic_limit,apm2-core,6.2,5.3,,aluminium-2024-t351,20,1,m/s,suspect,,
e,two,ballistic_limit,apm2-core,6.2,5.3,,aluminium-2024-t351,20,100,m/s,,c,
f,two,ballistic_limit,apm2-core,6.2,5.3,,aluminium-2024-t351,20,100,m/s,,,30
g,two,ballistic_limit,apm2-core,6.2,5.3,,aluminium-2024-t351,95,100,m/s,,,
h,two,depth,apm2-core,6.2,5.3,300,aluminium-2024-t351,95,3,mm,,,
";

fn made_up() -> Validation {
    let tests = experiments::read_str("made-up.csv", FILE, Library::built_in()).unwrap();
    let go_on = |_| ControlFlow::Continue(());
    run(&[&MADE_UP], &tests, Library::built_in(), &go_on).unwrap()
}

fn close(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-12, "{a} {b}");
}

#[test]
fn statistics_have_their_known_values() {
    let validation = made_up();
    let all = statistics(&validation, Grouping::All);
    assert_eq!(all.len(), 1, "{all:?}");
    // Errors of a, b and c: -0.1, +0.1, +1.0.
    let errors = &all[0].errors;
    assert_eq!((errors.count, errors.worst_id.as_str()), (3, "c"));
    close(errors.bias, 1.0 / 3.0);
    close(errors.rms, (1.02_f64 / 3.0).sqrt());
    close(errors.median_absolute, 0.1);
    close(errors.worst, 1.0);
    let by_source = statistics(&validation, Grouping::Source);
    let found: Vec<(&str, usize)> = by_source
        .iter()
        .map(|g| (g.value.as_str(), g.errors.count))
        .collect();
    assert_eq!(found, [("one", 2), ("two", 1)]);
    close(by_source[0].errors.bias, 0.0);
    close(by_source[0].errors.rms, 0.1);
    // A rival record has its own line and counts nowhere else.
    let by_record = statistics(&validation, Grouping::Record);
    let found: Vec<(&str, usize)> = by_record
        .iter()
        .map(|g| (g.value.as_str(), g.errors.count))
        .collect();
    assert_eq!(
        found,
        [
            ("apm2-core 4340; 4340", 1),
            ("apm2-core 4340; apm2-core", 1),
            ("apm2-core; apm2-core", 2)
        ]
    );
}

#[test]
fn what_is_not_counted_says_why() {
    let validation = made_up();
    let of = |id: &str| {
        let found = validation
            .predictions
            .iter()
            .find(|p| validation.test(p).id == id);
        found.unwrap_or_else(|| panic!("{id}"))
    };
    let expected = [
        ("d", Standing::Flagged, ""),
        ("e", Standing::Repeated, ""),
        ("f", Standing::NotApplicable, "30 deg"),
        ("g", Standing::NotGiven, "gives no ballistic limit"),
        ("h", Standing::NotGiven, "gives no depth"),
    ];
    for (id, standing, reason) in expected {
        let prediction = of(id);
        assert_eq!(prediction.standing, standing, "{id}");
        assert!(
            prediction.reason.as_deref().unwrap_or("").contains(reason),
            "{prediction:?}"
        );
    }
    assert_eq!(of("d").predicted, Some(200.0));
    let coverage = coverage(&validation);
    assert_eq!(coverage[0].kind, Kind::BallisticLimit);
    assert_eq!(
        (coverage[0].total(), coverage[0].count(Standing::Counted)),
        (7, 3)
    );
    assert_eq!(coverage[1].reason, Some(("gives no depth".to_owned(), 1)));
}

#[test]
fn a_model_is_not_blind_to_what_it_was_fitted_to() {
    let validation = made_up();
    for prediction in &validation.predictions {
        let blind = prediction.split == Split::Blind;
        assert_eq!(blind, validation.test(prediction).source == "two");
    }
    let by_split = statistics(&validation, Grouping::Split);
    let found: Vec<(&str, usize)> = by_split
        .iter()
        .map(|g| (g.value.as_str(), g.errors.count))
        .collect();
    assert_eq!(found, [("blind", 1), ("calibration", 2)]);
    assert_eq!(
        validation.fitted_to[0][0].describe(),
        "not blind to one: it was made up there"
    );
}

#[test]
fn what_models_were_fitted_to_is_in_the_bibliography() {
    let fitted = MODELS.iter().flat_map(|model| model.validity().fitted_to);
    for source in fitted.flat_map(|fitted| fitted.sources) {
        assert!(references().contains_key(*source), "{source}");
    }
}

#[test]
fn plate_cavity_is_blind_to_no_limit_of_the_database() {
    let model = crate::model::model("plate_cavity").unwrap();
    for test in experiments::built_in()
        .iter()
        .filter(|test| test.read_at.contains("10.17632/4f92y6jzzh.2"))
    {
        assert!(
            model.validity().is_fitted_to(&test.source),
            "{}",
            test.source
        );
    }
}

#[test]
fn an_even_number_of_errors_has_its_median_between() {
    let errors = Errors::of([(0.1, "a"), (-0.4, "b"), (0.2, "c"), (0.3, "d")]).unwrap();
    close(errors.median_absolute, 0.25);
    close(errors.worst, -0.4);
    assert_eq!(errors.worst_id, "b");
    assert_eq!(Errors::of([]), None);
}

#[test]
fn a_validation_can_be_watched_and_stopped() {
    let tests = experiments::read_str("made-up.csv", FILE, Library::built_in()).unwrap();
    let seen = Mutex::new(Vec::new());
    let observer = |fraction: f64| {
        seen.lock().unwrap().push(fraction);
        ControlFlow::Continue(())
    };
    run(&[&MADE_UP], &tests, Library::built_in(), &observer).unwrap();
    let seen = seen.into_inner().unwrap();
    assert_eq!(seen.len(), 9);
    close(seen.iter().copied().fold(0.0, f64::max), 1.0);
    let stop = |_| ControlFlow::Break(());
    let stopped = run(&[&MADE_UP], &tests, Library::built_in(), &stop);
    assert!(
        matches!(stopped, Err(Error::Cancelled { .. })),
        "{stopped:?}"
    );
}

#[test]
fn a_ballistic_limit_does_not_see_the_measured_one() {
    // Limits are computed from an impact at the measured limit: a model that uses that velocity would not be blind.
    for model in MODELS.iter().filter(|model| {
        model
            .validity()
            .predicts
            .contains(&BandQuantity::BallisticLimit)
    }) {
        for test in experiments::built_in()
            .iter()
            .filter(|s| s.kind == Kind::BallisticLimit && s.no_case().is_none())
            .step_by(100)
        {
            let scenario = test
                .scenario(&test.projectile_materials[0], Library::built_in())
                .unwrap();
            let limit = |velocity: f64| {
                let result = crate::model::run(
                    *model,
                    &scenario.at_impact_velocity(velocity),
                    &mut Control::default(),
                );
                result.ok().and_then(|result| result.ballistic_limit)
            };
            let velocity = test.impact_velocity;
            if let (Some(a), Some(b)) = (limit(velocity), limit(1.02 * velocity)) {
                assert!(
                    (a / b - 1.0).abs() < 1e-6,
                    "{} {}: {a} {b}",
                    model.name(),
                    test.id
                );
            }
        }
    }
}
