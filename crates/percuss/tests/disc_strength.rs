//! Disc pressed at its rim: the load at which it splits gives the tensile strength.

use std::f64::consts::PI;

use percuss::{
    case,
    model::{self, Control},
};

/// Tensile strength of the material [MPa].
const STRENGTH: f64 = 41.0;
const DIAMETER: f64 = 5e-3;

/// Largest `2 P/(π D t)` over the strength, of a glass disc of 50 particles across.
fn strength(criterion: &str, seed: u32) -> f64 {
    let text = format!(
        r#"
        projectile = {{ material = "hard", mass = "200 g", diameter = "10 mm", impact_velocity = "1 m/s" }}
        target = {{ material = "glass", thickness = "5 mm", back_face = "fixed" }}
        particles = {{ spacing = "0.1 mm", outline = "disc", end_time = "22 us", seed = {seed}, failure_criterion = "{criterion}" }}
        [materials.hard]
        name = "Elastic"
        density = "7800 kg/m3"
        youngs_modulus = "1500 GPa"
        poissons_ratio = 0.22
        strength.elastic = {{}}
        [materials.glass]
        name = "Glass, fracture energy twice that of float glass"
        density = "2530 kg/m3"
        youngs_modulus = "72 GPa"
        poissons_ratio = 0.23
        strength.elastic = {{}}
        fracture = {{ energy = "15 J/m2", tensile_strength = "{STRENGTH} MPa" }}
        "#
    );
    let scenario = case::load_str("disc", &text).unwrap_or_else(|error| panic!("{error}"));
    let particles = model::model("particles").unwrap();
    let result = model::run(particles, &scenario, &mut Control::default()).unwrap();
    assert!(result.numerics().energy_residual < 1e-3);
    assert!(result.cracks.unwrap().broken_bonds > 0);
    let mut details = result.details.iter();
    let ratio = details.find(|d| d.name.starts_with("area of the lattice"));
    assert!((ratio.unwrap().value - 0.957).abs() < 0.01, "{ratio:?}");
    2.0 * result.peak_force.unwrap() / (PI * DIAMETER) / (STRENGTH * 1e6)
}

/// Along the loaded diameter three times the tension presses across it. By the principal stress the disc has its tensile strength; bonds that fail by
/// their elongation have half of it.
#[test]
fn a_disc_splits_at_its_tensile_strength_by_the_principal_stress() {
    let mean = |criterion: &str| {
        let found = [1, 2, 3].map(|seed| strength(criterion, seed));
        println!("{criterion}: {found:.3?}");
        found.iter().sum::<f64>() / 3.0
    };
    let (by_stress, by_elongation) = (mean("principal-stress"), mean("elongation"));
    assert!((by_stress - 1.0).abs() < 0.1, "{by_stress}");
    assert!(by_elongation < 0.6, "{by_elongation}");
}
