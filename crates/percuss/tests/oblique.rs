//! Models of perforation under oblique impact: exact relations, who takes it, and measured limits.

use crate::common::plates::{METAL, OGIVE, refusal, run, scenario, try_run};
use percuss::{Scenario, model};

/// A case with its path at an angle to the normal [deg].
fn oblique(scenario: &Scenario, degrees: f64) -> Scenario {
    Scenario {
        obliquity: f64::to_radians(degrees),
        ..scenario.clone()
    }
}

/// Along a straight path the hole has the length h/cos θ: the limit is that of a plate as thick.
#[test]
fn an_oblique_hole_is_as_long_as_the_path() {
    for more in ["plate_cavity = { inertia = 0.0 }", ""] {
        let normal = scenario(OGIVE, 300.0, 20.0, METAL, more);
        let limit = |scenario: &Scenario| run("plate_cavity", scenario).ballistic_limit.unwrap();
        for degrees in [10.0_f64, 30.0, 50.0] {
            let secant = 1.0 / degrees.to_radians().cos();
            let thicker = scenario(OGIVE, 300.0, 20.0 * secant, METAL, more);
            let ratio = limit(&oblique(&normal, degrees)) / limit(&thicker);
            assert!((ratio - 1.0).abs() < 1e-12, "{degrees}: {ratio}");
            if !more.is_empty() {
                // Without inertia the work is the volume of the hole times a pressure.
                let ratio = limit(&oblique(&normal, degrees)) / limit(&normal);
                assert!((ratio - secant.sqrt()).abs() < 1e-12, "{degrees}: {ratio}");
            }
        }
    }
}

#[test]
fn oblique_impact_is_for_models_that_take_it() {
    let sharp = scenario(OGIVE, 400.0, 20.0, METAL, "");
    let flat = scenario("\"flat\"", 400.0, 12.0, METAL, "");
    // A given limit is that of the oblique path; without one, plate_cavity's is taken.
    let through = run("recht_ipson", &oblique(&sharp, 30.0));
    let limit = run("plate_cavity", &oblique(&sharp, 30.0))
        .ballistic_limit
        .unwrap();
    let expected = (400.0_f64.powi(2) - limit.powi(2)).sqrt();
    assert!((through.residual_velocity.unwrap() / expected - 1.0).abs() < 1e-12);
    let warned = run("plate_cavity", &oblique(&sharp, 45.0)).warnings;
    assert!(
        warned.iter().any(|w| w.contains("the path turns")),
        "{warned:?}"
    );
    assert!(refusal("plate_cavity", &oblique(&sharp, 65.0)).contains("glance off"));
    assert!(refusal("recht_ipson", &oblique(&flat, 30.0)).contains("it takes oblique impact of hemisphere, cone or ogive noses, and this flat nose strikes at 30 deg"));
    let all = model::MODELS.iter().map(|model| model.name());
    for name in all.filter(|name| !["plate_cavity", "recht_ipson"].contains(name)) {
        for scenario in [&sharp, &flat] {
            let reason = refusal(name, &oblique(scenario, 30.0));
            assert!(!reason.is_empty(), "{name}");
        }
    }
    assert!(refusal("plugging", &oblique(&flat, 30.0)).contains("it takes normal impact"));
    assert!(refusal("lambert_jonas", &oblique(&sharp, 30.0)).contains("it takes normal impact"));
}

/// Limits measured at an angle, none of which any constant was fitted to: as far off as those at normal impact.
#[test]
fn oblique_limits_come_out_as_well_as_normal_ones() {
    use percuss::{experiments, material::Library};
    let library = Library::built_in();
    let mut errors: [Vec<f64>; 2] = [Vec::new(), Vec::new()];
    for shot in experiments::built_in().iter().filter(|shot| shot.counts()) {
        if shot.kind != experiments::Kind::BallisticLimit || shot.projectile_materials.is_empty() {
            continue;
        }
        let Ok(scenario) = shot.scenario(&shot.projectile_materials[0], library) else {
            continue;
        };
        let index = match shot.obliquity_deg {
            0.0 => 0,
            30.0 => 1,
            _ => continue,
        };
        if let Ok(result) = try_run("plate_cavity", &scenario) {
            errors[index].push(result.ballistic_limit.unwrap() / shot.measured - 1.0);
        }
    }
    let rms = |e: &[f64]| (e.iter().map(|e| e * e).sum::<f64>() / e.len() as f64).sqrt();
    let [normal, thirty] = &errors;
    assert!(
        normal.len() > 400 && thirty.len() > 150,
        "{} {}",
        normal.len(),
        thirty.len()
    );
    assert!(
        rms(thirty) < 0.08 && (rms(thirty) - rms(normal)).abs() < 0.02,
        "{} {}",
        rms(normal),
        rms(thirty)
    );
}
