//! Measurements of a case, in SI units and checked against its target.

use percuss_core::{Error, Scenario, outcome::BandQuantity};

use crate::case;

fn load(target: &str, experiment: &str) -> Result<Scenario, Error> {
    case::load_str(
        "shot",
        &format!(
            "projectile = {{ material = 'copper', length = '20 mm', diameter = '5 mm', impact_velocity = '230 m/s' }}\n\
             target = {{ {target} }}\n[[experiments]]\n{experiment}"
        ),
    )
}

const PLATE: &str = "material = 'aluminium-2024-t351', thickness = '5 mm'";

#[test]
fn measured_values_are_in_si_units() {
    let text = "impact_velocity = '0.5 km/s'\ndepth_of_penetration = '4 mm'\nuncertainty = '100 um'\nsource = ['a', 'b']\nnote = 'n'";
    let scenario = load(PLATE, text).unwrap();
    let [experiment] = scenario.experiments.as_slice() else {
        panic!("{:?}", scenario.experiments);
    };
    assert_eq!(experiment.quantity, BandQuantity::DepthOfPenetration);
    assert_eq!(experiment.impact_velocity, Some(500.0));
    assert!((experiment.value - 4e-3).abs() < 1e-18);
    assert!((experiment.uncertainty.unwrap() - 1e-4).abs() < 1e-18);
    assert_eq!(experiment.sources, ["a", "b"]);
    assert_eq!(experiment.note, "n");
    assert!(!scenario.at_impact_velocity(1.0).experiments.is_empty());
}

#[test]
fn a_ballistic_limit_needs_no_speed() {
    let scenario = load(PLATE, "ballistic_limit = '1000 ft/s'\nsource = 'a'").unwrap();
    let experiment = &scenario.experiments[0];
    assert_eq!(experiment.impact_velocity, None);
    assert!((experiment.value - 304.8).abs() < 1e-9);
}

#[test]
fn what_a_target_cannot_have_is_refused() {
    let speed = "impact_velocity = '300 m/s'\nsource = 'a'\n";
    let semi_infinite = "material = 'copper', thickness = 'semi-infinite'";
    for (target, quantity, words) in [
        (
            "rigid_wall = true",
            "depth_of_penetration = '1 mm'",
            "a rigid wall has no depth",
        ),
        (
            semi_infinite,
            "ballistic_limit = '1 m/s'",
            "a semi-infinite target has no ballistic limit",
        ),
        (
            "constant_pressure = '1 GPa'",
            "residual_velocity = '1 m/s'",
            "a constant pressure has no residual velocity",
        ),
        (
            PLATE,
            "residual_velocity = '301 m/s'",
            "larger than the impact velocity",
        ),
    ] {
        let error = load(target, &format!("{speed}{quantity}")).unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
    }
}
