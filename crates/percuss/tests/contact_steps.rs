//! Contacts that begin and end within time steps: plates of particles at the default Courant number.

use percuss::{
    case,
    model::{self, Control},
};

/// A plate under a rigid projectile.
fn plate(projectile: &str, target: &str, options: &str) -> String {
    format!(
        "projectile = {{ material = 'hard', {projectile} }}\n\
         target = {{ {target}, back_face = 'free' }}\n\
         particles = {{ {options} }}\n\
         materials.hard = {{ name = 'Elastic', density = '7800 kg/m3', youngs_modulus = '200 GPa', poissons_ratio = 0.3, strength.elastic = {{}} }}\n"
    )
}

/// Energy that the balance misses at most, over that of the impact, of runs which were repeated while contacts began and ended with steps: then it was
/// 1.0e-3 to 2.5e-3.
#[test]
fn runs_of_plates_are_not_repeated() {
    let metal = |speed: f64, material: &str, thickness: f64, rest: &str| {
        plate(
            &format!(
                "length = '7.5 mm', diameter = '5 mm', impact_velocity = '{speed} m/s', nose = 'hemisphere'"
            ),
            &format!("material = '{material}', thickness = '{thickness} mm'"),
            &format!("formulation = 'particle-stress', width = '30 mm', {rest}"),
        )
    };
    let in_space = plate(
        "length = '6 mm', diameter = '4 mm', impact_velocity = '20 m/s', nose = 'hemisphere'",
        "material = 'alumina-98-makeitfrom', thickness = '4 mm'",
        "space = '3d', spacing = '0.7 mm', width = '14 mm', packing = 'body-centred-cubic'",
    );
    for text in [
        metal(238.0, "weldox-460-e", 6.0, "spacing = '0.8 mm'"),
        metal(
            153.6,
            "copper",
            10.0,
            "spacing = '0.5 mm', packing = 'irregular'",
        ),
        in_space,
    ] {
        let scenario = case::load_str("plate", &text).unwrap_or_else(|error| panic!("{error}"));
        let result = model::model("particles")
            .unwrap()
            .run(&scenario, &mut Control::default())
            .unwrap();
        let error = result.numerics.unwrap().energy_residual;
        println!("{error:.1e}\n{text}");
        assert!(error < 5e-4, "{error:e}\n{text}");
        let repeated = result.warnings.iter().any(|text| text.contains("Courant"));
        assert!(!repeated, "{:?}\n{text}", result.warnings);
    }
}
