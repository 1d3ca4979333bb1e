//! Documented defaults: writing one down changes no result.

use percuss::{
    case,
    model::{self, Control},
};

/// A flat rod on a plate.
const ROD: [&str; 2] = [
    "material = 'copper', length = '12.74 mm', diameter = '4.8 mm', velocity = '400 m/s'",
    "material = 'aluminium-2024-t351', thickness = '10 mm'",
];

fn bits([projectile, target]: [&str; 2], model: &str, options: &str) -> [Option<u64>; 4] {
    let text = format!("projectile = {{ {projectile} }}\ntarget = {{ {target} }}\n{options}\n");
    let scenario = case::load_str("case", &text).unwrap_or_else(|error| panic!("{error}"));
    let model = model::model(model).unwrap();
    let result = model::run(model, &scenario, &mut Control::default()).unwrap();
    let numbers = [
        result.depth_of_penetration,
        result.residual_velocity,
        result.peak_force,
        result.projectile_final_length,
    ];
    numbers.map(|number| number.map(f64::to_bits))
}

/// Defaults as lines after a head, which opens their table and may keep a run short.
fn unchanged(shot: [&str; 2], model: &str, head: &str, defaults: &[&str]) {
    let run = |default: &str| bits(shot, model, &format!("{head}\n{default}"));
    let without = run("");
    assert!(without.iter().any(Option::is_some), "{model}");
    for default in defaults {
        assert_eq!(run(default), without, "{model}: {default}");
    }
}

#[test]
fn of_formulae() {
    let ogive = "material = '4340-johnson-cook', length = '40 mm', diameter = '8 mm', velocity = '150 m/s', nose = { ogive = { crh = 3.0 } }";
    let thick = "material = '6061-t6-lesuer', thickness = '200 mm'";
    let plate = "material = '6061-t6-lesuer', thickness = '12 mm'";
    let concrete = "material = 'concrete-35-forrestal', thickness = 'semi-infinite'";
    for (shot, model, defaults) in [
        (
            [ogive, thick],
            "forrestal",
            &[
                "cavity = 'incompressible'",
                "friction = 0.0",
                "entry = 'embedded'",
            ][..],
        ),
        (
            [ogive, concrete],
            "forrestal_concrete",
            &["crater_depth_to_diameter = 2.0"],
        ),
        (
            [ogive, plate],
            "plate_cavity",
            &["cavity = 'cylinder'", "inertia = 1.5"],
        ),
        (
            [ROD[0], "rigid_wall = true"],
            "wilkins_guinan",
            &["front_to_length = 0.12"],
        ),
    ] {
        unchanged(shot, model, &format!("[{model}]"), defaults);
    }
}

#[test]
fn of_the_published_scheme() {
    let shot = [
        ROD[0],
        "material = 'aluminium-2024-t351', thickness = '25 mm'",
    ];
    unchanged(
        shot,
        "chain",
        "[chain]\nscheme = 'published'\n[chain.published]",
        &[
            "interface = 'chain'",
            "contact_spring = 'half-elements'",
            "time_step = 'table-1'",
            "border_shear = 'friction'",
            "small_strain = 'power-law'",
        ],
    );
}

#[test]
fn of_plane_impacts() {
    let shot = [
        "material = 'ofhc-copper-johnson-cook', length = '2 mm', diameter = '40 mm', velocity = '400 m/s'",
        "material = 'ofhc-copper-johnson-cook', thickness = '4 mm', back_face = 'free'",
    ];
    unchanged(
        shot,
        "fdm",
        "[fdm]\ngeometry = 'planar'",
        &[
            "projectile_elements = 200",
            "courant = 0.7",
            "artificial_viscosity = { linear = 0.1, quadratic = 2.0 }",
            "max_steps = 20000000",
        ],
    );
}

#[test]
fn of_finite_differences() {
    unchanged(
        ROD,
        "fdm",
        "[fdm]",
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

/// A strong artificial viscosity needs half the default Courant number.
#[test]
fn of_finite_differences_whose_energy_balance_does_not_close_at_it() {
    let run = |options: &str| {
        let text = format!(
            "projectile = {{ material = '6061-t6-lesuer', length = '12.74 mm', diameter = '4.8 mm', velocity = '230 m/s' }}\n\
             target = {{ material = '4340-johnson-cook', thickness = '20 mm' }}\n\
             fdm.artificial_viscosity = {{ linear = 2.0, quadratic = 0.0 }}\n{options}\n"
        );
        let scenario = case::load_str("case", &text).unwrap();
        let model = model::model("fdm").unwrap();
        model::run(model, &scenario, &mut Control::default())
    };
    let without = run("").unwrap();
    let reduced =
        |warning: &String| warning.contains("Courant number was reduced from 0.7 to 0.35");
    assert!(
        without.warnings.iter().any(reduced),
        "{:?}",
        without.warnings
    );
    // The default of the chain is another one, and not the grid's.
    for default in ["fdm.courant = 0.7", "chain.courant = 0.5"] {
        let with = run(default).unwrap();
        assert_eq!(
            with.depth_of_penetration, without.depth_of_penetration,
            "{default}"
        );
        assert_eq!(with.warnings, without.warnings, "{default}");
    }
    // A number of the case's own is kept, and the run fails with it.
    let error = run("fdm.courant = 0.71").unwrap_err().to_string();
    assert!(error.contains("lower `fdm.courant`"), "{error}");
}

#[test]
fn of_the_axisymmetric_model() {
    unchanged(
        ROD,
        "axi",
        "[axi]\ncells_per_radius = 3\nend_time = '4 us'",
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
