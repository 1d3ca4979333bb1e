//! Defaults of options: writing one down changes no result, and the schema has the default that a run uses.

use percuss::{
    case,
    model::{self, Control},
    options::{ChainOptions, FdmOptions, MAX_STEPS},
};
use serde_json::Value;

/// A flat rod on a plate.
const ROD: [&str; 2] = [
    "material = 'copper', length = '12.74 mm', diameter = '4.8 mm', impact_velocity = '400 m/s'",
    "material = 'aluminium-2024-t351', thickness = '10 mm'",
];
const THICK: [&str; 2] = [
    ROD[0],
    "material = 'aluminium-2024-t351', thickness = '25 mm'",
];
const OGIVE: &str = "material = '4340-johnson-cook', length = '40 mm', diameter = '8 mm', impact_velocity = '150 m/s', nose = { ogive = { crh = 3.0 } }";

/// A run that shows whether a default changes it.
struct Try {
    shot: [&'static str; 2],
    model: &'static str,
    /// The table whose defaults it tries.
    table: &'static str,
    /// Options beside them, which may keep the run short.
    options: &'static str,
    /// Keys that are not for a case with these options: another one tries them.
    refused: &'static [&'static str],
}

impl Try {
    fn tries(&self, table: &str, key: &str) -> bool {
        self.table == table && !is_given(self.options, key) && !self.refused.contains(&key)
    }
}

const fn of_formula(model: &'static str, shot: [&'static str; 2]) -> Try {
    Try {
        shot,
        model,
        table: model,
        options: "",
        refused: &[],
    }
}

/// A long rod that erodes.
const LONG: [&str; 2] = [
    "material = 'tungsten-alloy-steinberg', length = '50 mm', diameter = '5 mm', impact_velocity = '1500 m/s'",
    "material = '4340-johnson-cook', thickness = '200 mm'",
];

const PLATE: [&str; 2] = [
    "material = 'tool-steel-hrc53', length = '20 mm', diameter = '20 mm', impact_velocity = '500 m/s'",
    "material = 'weldox-460-e', thickness = '12 mm', back_face = 'free'",
];

/// A hard pin on an elastic plate, both of own materials.
const PIN: [&str; 2] = [
    "material = 'hard', length = '20 mm', diameter = '10 mm', impact_velocity = '20 m/s'",
    "material = 'hard', thickness = '10 mm', back_face = 'free'",
];
const HARD: &str = "materials.hard = { name = 'Elastic', density = '2500 kg/m3', youngs_modulus = '70 GPa', poissons_ratio = 0.22, strength.elastic = {}, \
     fracture = { energy = '8 J/m2', tensile_strength = '41 MPa' } }";

/// A strip of metal on a wall.
const BAR: [&str; 2] = [
    "material = 'copper', length = '12 mm', diameter = '4 mm', impact_velocity = '150 m/s'",
    "rigid_wall = true",
];
/// Options of `particles` for the stress of particles alone, and for springs alone.
const OF_STRESS: &[&str] = &[
    "equation_of_state",
    "artificial_viscosity",
    "rate_effects",
    "adiabatic_heating",
    "heat_fraction",
];
const OF_SPRINGS: &[&str] = &[
    "outline",
    "failure_criterion",
    "restitution",
    "friction",
    "amplitude",
    "seed",
];

const TRIES: [Try; 15] = [
    Try {
        shot: THICK,
        model: "chain",
        table: "chain",
        options: "target_resistance = 'expanding-cavity'",
        refused: &[],
    },
    Try {
        shot: ROD,
        model: "chain",
        table: "chain",
        options: "target_resistance = 'column'",
        refused: &[],
    },
    Try {
        shot: THICK,
        model: "chain",
        table: "chain.published",
        options: "chain.scheme = 'published'",
        refused: &[],
    },
    Try {
        shot: ROD,
        model: "fdm",
        table: "fdm",
        options: "",
        refused: &[],
    },
    Try {
        shot: PLATE,
        model: "axi",
        table: "axi",
        options: "cells_per_radius = 3\nend_time = '40 us'",
        refused: &[],
    },
    Try {
        shot: PLATE,
        model: "axi",
        table: "axi",
        options: "end_time = '0.2 us'",
        refused: &[],
    },
    Try {
        shot: PIN,
        model: "particles",
        table: "particles",
        options: HARD,
        refused: OF_STRESS,
    },
    Try {
        shot: BAR,
        model: "particles",
        table: "particles",
        options: "formulation = 'particle-stress'\nend_time = '10 us'",
        refused: OF_SPRINGS,
    },
    of_formula(
        "forrestal",
        [OGIVE, "material = '6061-t6-lesuer', thickness = '200 mm'"],
    ),
    of_formula(
        "forrestal_concrete",
        [
            OGIVE,
            "material = 'concrete-35-forrestal', thickness = 'semi-infinite'",
        ],
    ),
    of_formula(
        "plate_cavity",
        [OGIVE, "material = '6061-t6-lesuer', thickness = '12 mm'"],
    ),
    of_formula("wilkins_guinan", [ROD[0], "rigid_wall = true"]),
    of_formula("power_balance", PLATE),
    of_formula("energy_balance", LONG),
    of_formula("momentum_balance", LONG),
];

/// Keys of options that are given beside the defaults, so that none of them is tried.
fn is_given(options: &str, key: &str) -> bool {
    options
        .lines()
        .any(|line| line.split(' ').next() == Some(key))
}

fn run(shot: [&str; 2], model: &str, options: &str) -> [Option<u64>; 4] {
    let [projectile, target] = shot;
    let text = format!("projectile = {{ {projectile} }}\ntarget = {{ {target} }}\n{options}\n");
    let scenario = case::load_str("case", &text).unwrap_or_else(|error| panic!("{text}{error}"));
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

/// Defaults, each by itself after options, change nothing.
fn unchanged(shot: [&str; 2], model: &str, options: &str, defaults: &[String]) {
    let without = run(shot, model, options);
    assert!(without.iter().any(Option::is_some), "{model}");
    for default in defaults {
        let with = run(shot, model, &format!("{options}\n{default}"));
        assert_eq!(with, without, "{model}: {default}");
    }
}

/// The schema of a table of options, by its dotted key.
fn table<'a>(schema: &'a Value, key: &str) -> &'a Value {
    key.split('.').fold(schema, |table, key| {
        let reference = table["properties"][key]["$ref"].as_str().unwrap();
        schema.pointer(reference.trim_start_matches('#')).unwrap()
    })
}

/// Keys with a default in the schema, each with its default as TOML.
fn defaults_in_schema(schema: &Value, table_key: &str) -> Vec<(String, String)> {
    let properties = table(schema, table_key)["properties"].as_object().unwrap();
    let defaults = properties.iter().filter_map(|(key, property)| {
        let default = toml::Value::try_from(property.get("default")?).unwrap();
        Some((key.clone(), default.to_string()))
    });
    defaults.collect()
}

/// Tables of options in the schema by their dotted keys.
fn tables_of_options(schema: &Value) -> Vec<String> {
    let models = model::MODELS.iter().map(|model| model.name().to_owned());
    let models = models.filter(|model| schema["properties"].get(model).is_some());
    models
        .chain(["chain.published".to_owned(), "chain.shear_band".to_owned()])
        .collect()
}

fn check(index: usize) {
    let of = &TRIES[index];
    let schema = case::schema();
    let line = |key: &str, value: &str| format!("{}.{key} = {value}", of.table);
    let options: String = of
        .options
        .lines()
        .map(|option| match option.split_once(" = ") {
            Some((key, value)) if !key.contains('.') => line(key, value) + "\n",
            _ => option.to_owned() + "\n",
        })
        .collect();
    let defaults = defaults_in_schema(&schema, of.table).into_iter();
    let defaults: Vec<String> = defaults
        .filter(|(key, _)| of.tries(of.table, key))
        .map(|(key, default)| line(&key, &default))
        .collect();
    assert!(!defaults.is_empty(), "{}", of.table);
    unchanged(of.shot, of.model, &options, &defaults);
}

#[test]
fn of_the_expanding_cavity() {
    check(0);
}

#[test]
fn of_the_column() {
    check(1);
}

#[test]
fn of_the_published_scheme() {
    check(2);
}

#[test]
fn of_finite_differences() {
    check(3);
}

#[test]
fn of_the_axisymmetric_model() {
    check(4);
    check(5);
}

#[test]
fn of_particles() {
    check(6);
    check(7);
}

#[test]
fn of_formulae() {
    (8..TRIES.len()).for_each(check);
}

#[test]
fn every_default_of_the_schema_is_tried() {
    let schema = case::schema();
    let mut tried = 0;
    for table in tables_of_options(&schema) {
        for (key, default) in defaults_in_schema(&schema, &table) {
            let is_tried = TRIES.iter().any(|of| of.tries(&table, &key));
            assert!(
                is_tried,
                "`{table}.{key}` = {default}: add a `Try` to `TRIES`"
            );
            tried += 1;
        }
    }
    assert!(tried > 40, "{tried}");
}

/// A default that is one number or word is in the schema; what depends on something else is in the description.
#[test]
fn every_option_has_a_default_or_its_description_says_when_it_has_none() {
    let schema = case::schema();
    for key in tables_of_options(&schema) {
        let table = table(&schema, &key);
        for (name, property) in table["properties"].as_object().unwrap() {
            let description = property["description"].as_str().unwrap_or_default();
            // A table has defaults of its own.
            if is_table(&schema, property) {
                continue;
            }
            let words = ["when not given", " Default: ", "instead of"];
            let said = words.iter().any(|words| description.contains(words));
            assert!(
                said != property.get("default").is_some(),
                "{key}.{name}: {description}"
            );
        }
    }
}

fn is_table(schema: &Value, property: &Value) -> bool {
    let reference = property["$ref"].as_str().unwrap_or_default();
    let definition = schema.pointer(reference.trim_start_matches('#'));
    definition.is_some_and(|of| of["properties"].is_object()) && property.get("default").is_none()
}

fn lines(defaults: &[&str]) -> Vec<String> {
    defaults.iter().map(|line| (*line).to_owned()).collect()
}

#[test]
fn of_the_courant_number_in_every_target_resistance_model() {
    let courant = ChainOptions::COURANT;
    for resistance in ["expanding-cavity", "column", "diverging"] {
        let options = format!("chain.target_resistance = '{resistance}'");
        unchanged(
            THICK,
            "chain",
            &options,
            &[format!("chain.courant = {courant:?}")],
        );
        let other = format!("{options}\nchain.courant = {:?}", 0.9 * courant);
        assert_ne!(run(THICK, "chain", &other), run(THICK, "chain", &options));
    }
}

#[test]
fn of_plane_impacts() {
    let shot = [
        "material = 'ofhc-copper-johnson-cook', length = '2 mm', diameter = '40 mm', impact_velocity = '400 m/s'",
        "material = 'ofhc-copper-johnson-cook', thickness = '4 mm', back_face = 'free'",
    ];
    let elements = FdmOptions::PLANAR_ELEMENTS;
    let viscosity = toml::Value::try_from(FdmOptions::PLANAR_VISCOSITY).unwrap();
    let defaults = [
        format!("fdm.projectile_elements = {elements}"),
        "fdm.courant = 0.7".to_owned(),
        format!("fdm.artificial_viscosity = {viscosity}"),
        format!("fdm.max_steps = {MAX_STEPS}"),
    ];
    unchanged(shot, "fdm", "fdm.geometry = 'planar'", &defaults);
}

#[test]
fn of_finite_differences_from_the_chain() {
    let defaults = lines(&[
        "fdm.projectile_elements = 40",
        "fdm.constraint_factor = 2.7",
        "fdm.border_shear = 0.577",
        "fdm.artificial_viscosity = { linear = 0.0, quadratic = 0.0 }",
        "fdm.max_steps = 20000000",
    ]);
    unchanged(ROD, "fdm", "", &defaults);
}

#[test]
fn of_spall_in_the_axisymmetric_model() {
    let short = "axi.cells_per_radius = 3\naxi.end_time = '4 us'";
    unchanged(ROD, "axi", short, &lines(&["axi.spall = false"]));
    let strong = format!("{short}\naxi.spall_strength = '1 GPa'");
    unchanged(ROD, "axi", &strong, &lines(&["axi.spall = true"]));
}

/// A strong artificial viscosity needs half the default Courant number.
#[test]
fn of_finite_differences_whose_energy_balance_does_not_close_at_it() {
    let run = |options: &str| {
        let text = format!(
            "projectile = {{ material = '6061-t6-lesuer', length = '12.74 mm', diameter = '4.8 mm', impact_velocity = '230 m/s' }}\n\
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
