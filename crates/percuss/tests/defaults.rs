//! Documented defaults: writing one down changes no result.

use percuss::{
    case,
    model::{self, Control},
};

fn bits(model: &str, options: &str) -> [Option<u64>; 3] {
    let text = format!(
        "projectile = {{ material = 'copper', length = '12.74 mm', diameter = '4.8 mm', velocity = '400 m/s' }}\n\
         target = {{ material = 'aluminium-2024-t351', thickness = '10 mm' }}\n{options}\n"
    );
    let scenario = case::load_str("case", &text).unwrap_or_else(|error| panic!("{error}"));
    let model = model::model(model).unwrap();
    let result = model::run(model, &scenario, &mut Control::default()).unwrap();
    let numbers = [
        result.depth_of_penetration,
        result.residual_velocity,
        result.peak_force,
    ];
    numbers.map(|number| number.map(f64::to_bits))
}

/// `more` keeps a run short; the options of the chain have a test of their own beside its default target resistance.
fn unchanged(model: &str, more: &str, defaults: &[&str]) {
    let run = |default: &str| bits(model, &format!("[{model}]\n{more}\n{default}"));
    let without = run("");
    assert!(without[0].is_some());
    for default in defaults {
        assert_eq!(run(default), without, "{model}.{default}");
    }
}

#[test]
fn of_finite_differences() {
    unchanged(
        "fdm",
        "",
        &[
            "geometry = 'rod'",
            "projectile_elements = 40",
            "constraint_factor = 2.7",
            "border_shear = 0.577",
            "courant = 0.7",
            "artificial_viscosity = { linear = 0.0, quadratic = 0.0 }",
            "max_steps = 20000000",
        ],
    );
}

#[test]
fn of_the_axisymmetric_model() {
    unchanged(
        "axi",
        "cells_per_radius = 3\nend_time = '4 us'",
        &[
            "particles_per_side = 2",
            "edge = 'non-reflecting'",
            "contact = 'frictional'",
            "friction = 0.0",
            "equation_of_state = 'linear'",
            "courant = 0.5",
            "artificial_viscosity = { linear = 0.06, quadratic = 1.2 }",
            "rate_effects = true",
            "adiabatic_heating = true",
            "heat_fraction = 0.9",
            "damage = false",
            "erode_failed = false",
            "spall = false",
            "max_steps = 20000000",
        ],
    );
}
