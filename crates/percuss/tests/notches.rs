//! Notches of model `particles`: what a run warns of.

use percuss::{
    case,
    model::{self, Control},
};

/// Warnings of a glass plate with a notch of a width.
fn warnings(width: &str) -> Vec<String> {
    let text = format!(
        r#"
        projectile = {{ material = "hard", length = "10 mm", diameter = "6 mm", impact_velocity = "20 m/s" }}
        target = {{ material = "hard", thickness = "6 mm", back_face = "free" }}
        particles = {{ spacing = "0.7 mm", width = "40 mm", end_time = "5 us", notches = [{{ from = ["3.2 mm", "6 mm"], to = ["3.2 mm", "3 mm"]{width} }}] }}
        [materials.hard]
        name = "Glass"
        density = "2500 kg/m3"
        youngs_modulus = "70 GPa"
        poissons_ratio = 0.22
        strength.elastic = {{}}
        fracture = {{ energy = "8 J/m2", tensile_strength = "40 MPa" }}
        "#
    );
    let scenario = case::load_str("plate", &text).unwrap_or_else(|error| panic!("{error}"));
    let particles = model::model("particles").unwrap();
    let result = model::run(particles, &scenario, &mut Control::default()).unwrap();
    result.warnings
}

/// A slot less wide than the spacing, 0.693 mm, is named with its remedy; a wider one and a cut are not.
#[test]
fn a_slot_narrower_than_the_spacing_is_named() {
    let names = |width: &str| -> Vec<String> {
        let is_narrow = |warning: &String| warning.contains("narrower");
        warnings(width).into_iter().filter(is_narrow).collect()
    };
    assert_eq!(
        names(r#", width = "0.6 mm""#),
        [
            "`particles.notches`: the slot of number 1 is narrower than the particles are apart, 0.693 mm, so that its faces can touch: \
          raise its `width` or reduce `particles.spacing`"
        ]
    );
    for wide in ["", r#", width = "0.8 mm""#] {
        assert!(names(wide).is_empty(), "{:?}", names(wide));
    }
}
