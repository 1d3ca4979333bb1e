use std::collections::BTreeSet;

use super::{RESULT_FIELDS, ResultRecord, Role, result_number, result_numbers};
use crate::{
    case,
    model::{self, Control},
    outcome::{BandQuantity, Outcome, RunResult},
    scenario::Scenario,
    units::ResultUnit,
};

const CASE: &str = "projectile = { material = 'copper', length = '12.74 mm', diameter = '4.8 mm', impact_velocity = '230 m/s' }\n\
                    target = { material = 'aluminium-2024-t351', thickness = '25 mm' }\n";

fn run() -> (Scenario, RunResult) {
    let scenario = case::load_str("case", CASE).unwrap();
    let chain = model::model("chain").unwrap();
    let result = model::run(chain, &scenario, &mut Control::default()).unwrap();
    (scenario, result)
}

#[test]
fn json_has_the_fields_of_the_list_and_their_numbers() {
    let (scenario, result) = run();
    let record = ResultRecord::new(&scenario, &result);
    let json = serde_json::to_value(&record).unwrap();
    let json = json.as_object().unwrap();
    let names: BTreeSet<&str> = RESULT_FIELDS.iter().map(|field| field.name).collect();
    assert_eq!(names.len(), RESULT_FIELDS.len());
    assert_eq!(names, json.keys().map(String::as_str).collect());
    for number in result_numbers() {
        assert_eq!(json[number.name].as_f64(), number.of(&record), "{number:?}");
    }
    for field in RESULT_FIELDS.iter().filter(|field| field.number.is_none()) {
        assert!(!json[field.name].is_number(), "{field:?}");
    }
}

/// Factors between SI units and those of the names, written by hand.
#[test]
fn numbers_are_in_the_unit_of_their_name() {
    let (scenario, result) = run();
    let record = ResultRecord::new(&scenario, &result);
    let numerics = result.numerics();
    for (name, expected) in [
        ("impact_velocity_m_s", Some(230.0)),
        (
            "impact_energy_j",
            Some(0.5 * scenario.projectile.mass * 230.0_f64.powi(2)),
        ),
        (
            "depth_of_penetration_mm",
            result.depth_of_penetration.map(|x| x * 1e3),
        ),
        (
            "projectile_final_mass_g",
            result.projectile_final_mass.map(|x| x * 1e3),
        ),
        ("time_to_rest_us", result.time_to_rest.map(|x| x * 1e6)),
        ("peak_force_kn", result.peak_force.map(|x| x * 1e-3)),
        ("time_step_ns", Some(numerics.first_time_step * 1e9)),
        ("steps", Some(numerics.steps as f64)),
        ("target_temperature_k", Some(numerics.largest_temperature.1)),
    ] {
        let number = result_number(name).unwrap();
        assert!(expected.is_some(), "{name}");
        assert_eq!(number.of(&record), expected, "{name}");
    }
    for number in result_numbers() {
        assert_eq!(ResultUnit::split(number.name).1, number.unit, "{number:?}");
    }
}

#[test]
fn a_number_has_a_label_and_a_description_of_its_own() {
    let mut labels = BTreeSet::new();
    for field in RESULT_FIELDS {
        let description = field.description();
        assert!(
            description.ends_with('.') && !description.contains("  "),
            "{field:?}"
        );
    }
    for number in result_numbers() {
        assert!(labels.insert(number.label), "{number:?}");
    }
    assert!(result_numbers().any(|number| number.role == Role::Main));
}

#[test]
fn a_case_without_a_result_has_the_numbers_of_the_case_alone() {
    let (scenario, _) = run();
    let taylor = model::model("taylor").unwrap();
    let error = model::run(taylor, &scenario, &mut Control::default()).unwrap_err();
    let record = ResultRecord::without_result(&scenario, "taylor", &error);
    assert_eq!(record.outcome, Outcome::NotApplicable);
    for number in result_numbers() {
        let given = number.role == Role::Input;
        assert_eq!(number.of(&record).is_some(), given, "{number:?}");
    }
}

/// What experiments and ranges are given of are results too, with the same names and units.
#[test]
fn measured_quantities_are_main_results() {
    let (scenario, result) = run();
    let record = ResultRecord::new(&scenario, &result);
    for quantity in BandQuantity::ALL {
        let name = serde_json::to_value(quantity).unwrap();
        let number = result_number(name.as_str().unwrap()).unwrap();
        assert_eq!(number.role, Role::Main);
        assert_eq!(number.unit.symbol, quantity.unit());
        assert_eq!(quantity.in_unit(0.3), number.unit.of_si(0.3));
        assert_eq!(number.of(&record), record.value(*quantity));
        assert_eq!(
            record.value(*quantity),
            result.measurable(*quantity).map(|si| quantity.in_unit(si))
        );
    }
}
