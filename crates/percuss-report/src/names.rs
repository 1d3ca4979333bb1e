//! Names of quantities and parameters in figures, with units in parentheses.

pub(crate) use percuss::quote::capitalized;
use percuss::{material::Library, summary::result_number, units::ResultUnit};

/// Most characters of the name of a material in a legend.
const MATERIAL_CHARS: usize = 30;

/// Name of a material in a legend: that of its record where it is short enough, otherwise its id.
pub fn material_label<'a>(name: &'a str, id: &'a str) -> &'a str {
    match name.chars().count() <= MATERIAL_CHARS {
        true => name,
        false => id,
    }
}

/// The same of a material of the library; the id of another one.
pub(crate) fn library_material(id: &str) -> &str {
    let entry = Library::built_in().iter().find(|entry| entry.id == id);
    entry.map_or(id, |entry| material_label(&entry.material.name, id))
}

/// Name with a capital first letter, and its unit in parentheses.
pub(crate) fn with_unit(name: &str, unit: &str) -> String {
    let name = capitalized(name);
    match unit {
        "" => name,
        "us" => format!("{name} (µs)"),
        unit => format!("{name} ({unit})"),
    }
}

/// Name of a parameter of a case by its dotted key, and its unit in parentheses, as charts have it.
pub fn parameter_label(key: &str, unit: &str) -> String {
    with_unit(&parameter(key), unit)
}

/// Name and unit of a column of results.
pub(crate) fn result_column(column: &str) -> (String, &'static str) {
    let (words, unit) = ResultUnit::split(column);
    match result_number(column) {
        Some(number) => (number.label.to_owned(), number.unit.symbol),
        None => (words.replace('_', " "), unit.symbol),
    }
}

/// Name of a parameter of a case by its dotted key.
pub(crate) fn parameter(key: &str) -> String {
    let parts: Vec<&str> = key.split('.').collect();
    let words = |part: &str| {
        let words = part.replace('_', " ");
        words
            .replace("youngs", "Young's")
            .replace("poissons", "Poisson's")
    };
    capitalized(&match parts.as_slice() {
        ["projectile", "velocity" | "impact_velocity"] => "impact velocity".to_owned(),
        ["projectile", rest @ ..] => format!("projectile {}", words(&rest.join(", "))),
        ["target", "layers", layer, rest @ ..] => {
            format!("{}, layer {layer}", words(&rest.join(", ")))
        }
        ["target", rest @ ..] => format!("target {}", words(&rest.join(", "))),
        ["materials", id, "strength", law, name] => {
            format!("{} {}, {id}", law_name(law), constant(name))
        }
        ["materials", id, rest @ ..] => format!("{}, {id}", words(&rest.join(", "))),
        [_, rest @ ..] if !rest.is_empty() => words(&rest.join(", ")),
        _ => words(key),
    })
}

/// Name of a strength law: `johnson_cook` is Johnson-Cook.
fn law_name(law: &str) -> String {
    match law {
        "johnson_cook" => "Johnson-Cook".to_owned(),
        "steinberg_guinan" => "Steinberg-Guinan".to_owned(),
        law => law.replace('_', "-"),
    }
}

/// Name of a constant of a strength law; A, B and C are capital letters, as in their sources.
fn constant(name: &str) -> String {
    match name {
        "a" | "b" | "c" => name.to_uppercase(),
        name => name.replace('_', " "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_have_names_instead_of_keys() {
        for (key, name) in [
            ("projectile.impact_velocity", "Impact velocity"),
            ("projectile.velocity", "Impact velocity"),
            ("projectile.length", "Projectile length"),
            ("target.thickness", "Target thickness"),
            ("target.layers.1.thickness", "Thickness, layer 1"),
            (
                "materials.ti64-jc.strength.johnson_cook.a",
                "Johnson-Cook A, ti64-jc",
            ),
            (
                "materials.copper.strength.power_law.coefficient",
                "Power-law coefficient, copper",
            ),
            ("materials.copper.density", "Density, copper"),
            ("materials.copper.youngs_modulus", "Young's modulus, copper"),
            ("materials.copper.poissons_ratio", "Poisson's ratio, copper"),
            ("chain.constraint_factor", "Constraint factor"),
            (
                "chain.artificial_viscosity.linear",
                "Artificial viscosity, linear",
            ),
        ] {
            assert_eq!(parameter(key), name);
        }
    }

    #[test]
    fn materials_have_their_names_unless_these_are_long() {
        assert_eq!(
            library_material("4340-johnson-cook"),
            "4340 steel (Johnson–Cook)"
        );
        // "304 stainless steel (Steinberg–Guinan)" is longer than a legend shows.
        assert_eq!(library_material("304-steinberg"), "304-steinberg");
        assert_eq!(library_material("mine"), "mine");
    }

    #[test]
    fn units_are_in_parentheses() {
        assert_eq!(with_unit("impact velocity", "m/s"), "Impact velocity (m/s)");
        assert_eq!(with_unit("time", "us"), "Time (µs)");
        assert_eq!(with_unit("damage", ""), "Damage");
    }

    #[test]
    fn columns_have_the_labels_of_their_results() {
        let (name, unit) = result_column("depth_of_penetration_mm");
        assert_eq!(with_unit(&name, unit), "Depth of penetration (mm)");
        let (name, unit) = result_column("band_low");
        assert_eq!(with_unit(&name, unit), "Band low");
    }
}
