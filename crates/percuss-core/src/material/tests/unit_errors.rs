//! Unit errors of a factor of 1000 are detected.

use super::*;

/// The unit error.
const K: f64 = 1e3;

/// Every quantity of a record that a unit error can affect, as a path into its file form.
///
/// Left out: the reference strain rate, which may be anything from quasi-static to shock, and the room temperature.
fn quantities(table: &toml::Table) -> Vec<Vec<String>> {
    let own = [
        "density",
        "youngs_modulus",
        "yield_stress",
        "specific_heat",
        "melting_temperature",
    ];
    let own = own.iter().filter(|key| table.contains_key(**key));
    let mut paths: Vec<Vec<String>> = own.map(|key| vec![(*key).to_owned()]).collect();
    for (law, parameters) in table["strength"].as_table().unwrap() {
        for (key, value) in parameters.as_table().unwrap() {
            // A zero stays a zero.
            let quantity = value
                .as_str()
                .is_some_and(|text| text.contains(' ') && !text.starts_with("0 "));
            if quantity && key != "reference_rate" {
                paths.push(vec!["strength".to_owned(), law.clone(), key.clone()]);
            }
        }
    }
    paths
}

fn scaled(table: &toml::Table, path: &[String], factor: f64) -> Material {
    let mut table = table.clone();
    let (last, parents) = path.split_last().unwrap();
    let mut inner = &mut table;
    for key in parents {
        inner = inner[key].as_table_mut().unwrap();
    }
    let text = inner[last].as_str().unwrap();
    let (number, unit) = text.split_once(' ').unwrap();
    let number = number.parse::<f64>().unwrap() * factor;
    inner[last] = format!("{number:e} {unit}").into();
    table.try_into().unwrap()
}

/// Slips that no check can tell from another solid, each with the reason.
const UNDETECTABLE: &[(&str, &str, f64)] = &[
    // With n = 1, B is a plain tangent modulus, and 50 MPa is as common as the 50 GPa that keeps this core rigid.
    ("apm2-core-flores-johnson", "strength.johnson_cook.b", 1e-3),
    // 420 MPa behind a shock is a fourteenth of the modulus; 420 kPa would be a very soft solid, and some are.
    (
        "pmma-steinberg",
        "strength.perfectly_plastic.flow_stress",
        1e-3,
    ),
];

#[test]
fn a_slip_of_1000_is_caught() {
    let mut missed = Vec::new();
    let mut tried = 0;
    for MaterialEntry { id, material, .. } in built_in() {
        let table = toml::Table::try_from(&**material).unwrap();
        for path in quantities(&table) {
            for factor in [K, 1.0 / K] {
                tried += 1;
                if diagnostics(&scaled(&table, &path, factor)).is_empty() {
                    missed.push((id.clone(), path.join("."), factor));
                }
            }
        }
    }
    let expected: Vec<_> = UNDETECTABLE
        .iter()
        .map(|(id, key, factor)| (id.to_string(), key.to_string(), *factor))
        .collect();
    assert_eq!(missed, expected);
    // Density, modulus and at least one stress of every record, both ways.
    assert!(tried >= 6 * built_in().count(), "{tried} unit errors tried");
}
