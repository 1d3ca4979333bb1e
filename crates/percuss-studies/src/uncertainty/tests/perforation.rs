//! The probability of perforation where it is known.

use std::f64::consts::FRAC_1_SQRT_2;

use super::*;

const PLATE: &str = "
projectile = { material = 'tool-steel-hrc53', mass = '197 g', diameter = '20 mm', impact_velocity = '187 m/s' }
target = { material = 'weldox-460-e', thickness = '12 mm', back_face = 'free' }
recht_ipson = { ballistic_limit = '184.5 m/s' }
";

/// A target that is perforated above a known velocity, by velocities of a known distribution.
#[test]
fn the_chance_of_perforation_is_exact() {
    let inputs = "[[uncertainty.parameter]]
key = 'projectile.impact_velocity'
normal = { mean = '187 m/s', standard_deviation = '5 m/s' }";
    let study = load(&format!("{PLATE}{inputs}")).unwrap();
    let model = model("recht_ipson").unwrap();
    let observer = Observer {
        stop: &AtomicBool::new(false),
        progress: &|_, _| {},
    };
    let settings = settings(1024);
    let found = analyse(
        &study,
        model,
        &ScalarKernel::new(model),
        &settings,
        &observer,
    )
    .unwrap();
    let exact = 0.5 * libm::erfc(-0.5 * FRAC_1_SQRT_2);
    let perforation = found.perforation.unwrap();
    assert!(
        (perforation.probability - exact).abs() <= 1.0 / 1024.0,
        "{perforation:?}"
    );
    assert!(perforation.low < exact && exact < perforation.high);
    assert_eq!(perforation.undecided, 0);
    let residual = &found.quantities[0];
    assert_eq!(residual.quantity, "residual_velocity_m_s");
    // What is stopped counts as 0.
    assert_eq!(
        (residual.statistics.runs, residual.statistics.smallest),
        (1024, 0.0)
    );
}
