//! Constants of the materials of a case, with the keys under which they can be varied and fitted.

use std::collections::BTreeMap;

use percuss::{Scenario, material::Material, scenario::TargetBody};
use serde::Serialize;
use serde_json::Value;

/// A constant of a material.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(crate) struct Constant {
    /// Dotted key in the case.
    pub(crate) key: String,
    /// Its value as a case has it.
    pub(crate) value: String,
}

/// The materials that a case names, with the values of its keys: the projectile's, then those that are struck, each once.
pub(crate) fn named<'a>(
    values: &'a BTreeMap<String, Value>,
    scenario: &'a Scenario,
) -> Vec<(&'a str, &'a Material)> {
    let said = |key: &str| values.get(key).and_then(Value::as_str);
    let mut bodies = vec![(said("projectile.material"), &*scenario.projectile.material)];
    if let TargetBody::Layers { layers, .. } = &scenario.target {
        bodies.extend(layers.iter().enumerate().map(|(i, layer)| {
            let key = format!("target.layers.{i}.material");
            (said("target.material").or(said(&key)), &*layer.material)
        }));
    }
    let mut named: Vec<(&str, &Material)> = Vec::new();
    for (name, material) in bodies {
        let Some(name) = name else { continue };
        // A key takes a part of digits alone for a place in a list.
        let in_a_key = name.contains(|c: char| !c.is_ascii_digit()) && !name.contains('.');
        if in_a_key && named.iter().all(|(before, _)| *before != name) {
            named.push((name, material));
        }
    }
    named
}

/// The constants of a material by their keys within its record, with the units that they are written in.
pub(crate) fn of(material: &Material) -> Vec<Constant> {
    let mut constants = Vec::new();
    if let Ok(record) = serde_json::to_value(material) {
        collect("", &record, &mut constants);
    }
    constants
}

/// The constants of all materials that a case names, by their keys in the case.
pub(crate) fn all(values: &BTreeMap<String, Value>, scenario: &Scenario) -> Vec<Constant> {
    let of_material = |(name, material): (&str, &Material)| {
        let in_case = |constant: Constant| Constant {
            key: format!("materials.{name}.{}", constant.key),
            ..constant
        };
        of(material).into_iter().map(in_case).collect::<Vec<_>>()
    };
    named(values, scenario)
        .into_iter()
        .flat_map(of_material)
        .collect()
}

fn collect(key: &str, value: &Value, constants: &mut Vec<Constant>) {
    let add = |value: String| Constant {
        key: key.to_owned(),
        value,
    };
    match value {
        Value::Object(entries) => {
            for (name, inner) in entries {
                let inner_key = format!("{key}.{name}");
                collect(inner_key.trim_start_matches('.'), inner, constants);
            }
        }
        Value::Number(number) => constants.push(add(number.to_string())),
        Value::String(text) if quantity(text).is_some() => constants.push(add(text.clone())),
        _ => {}
    }
}

/// Number and unit of a quantity.
pub(crate) fn quantity(text: &str) -> Option<(f64, &str)> {
    let at = text.find(|c: char| c.is_whitespace() || c.is_alphabetic() && c != 'e')?;
    let (number, unit) = text.split_at(at);
    let unit = unit.trim();
    // A name may begin with a number too.
    let number = number.trim().parse().ok()?;
    (!unit.contains(char::is_whitespace)).then_some((number, unit))
}

#[cfg(test)]
mod tests {
    use percuss::case;

    use super::*;
    use crate::{cases, form};

    #[test]
    fn quantities_fall_into_number_and_unit() {
        assert_eq!(quantity("230 m/s"), Some((230.0, "m/s")));
        assert_eq!(quantity("2e2m/s"), Some((200.0, "m/s")));
        for text in ["semi-infinite", "35 MPa concrete"] {
            assert_eq!(quantity(text), None);
        }
    }

    /// What the page offers is what a sweep can vary.
    #[test]
    fn every_constant_of_every_ready_case_can_be_varied() {
        for case in cases::all() {
            let scenario = case::load_str(case.name(), case.text()).unwrap();
            let values = form::values(case.text());
            let constants = all(&values, &scenario);
            for Constant { key, value } in &constants {
                let value = match quantity(value) {
                    Some(_) => format!("\"{value}\""),
                    None => value.clone(),
                };
                let text = format!(
                    "base = ''\nmodel = 'taylor'\ndesign = 'grid'\n[[parameter]]\nkey = '{key}'\nvalues = [{value}]"
                );
                let file = case::Document::new("sweep.toml", text);
                let of = case::Document::new(case.name(), case.text());
                let sweep = percuss::sweep::Sweep::of(&file, &of);
                assert!(sweep.is_ok(), "{}: {key} = {value}: {sweep:?}", case.name());
            }
            if case.name() == "paper-table1" {
                let wanted = "materials.aluminium-2024-t351.strength.power_law.coefficient";
                assert!(constants.iter().any(|constant| constant.key == wanted));
            }
        }
    }
}
