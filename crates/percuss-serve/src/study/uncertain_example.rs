//! An example of what could be uncertain in a case, to be changed by its user.

use percuss::{Scenario, material::Material, scenario::TargetBody, units::significant};
use serde_json::Value;

use crate::form;

/// Units of stress.
const STRESSES: [&str; 4] = ["Pa", "kPa", "MPa", "GPa"];

/// The text of a case with a table `uncertainty` at its end, whose spreads are assumptions and say so.
pub(super) fn with_example(text: &str, scenario: &Scenario) -> String {
    let values = form::values(text);
    let said = |key: &str| values.get(key).and_then(Value::as_str);
    let mut example = String::from(
        "\n# What is uncertain, for `percuss uncertainty` and the button `Uncertainty`. The spreads are assumptions: put yours in their place.\n",
    );
    let mut add = |key: &str, distribution: &str| {
        example += &format!("[[uncertainty.parameter]]\nkey = \"{key}\"\n{distribution}\n\n");
    };
    if let Some((speed, unit)) = said("projectile.velocity").and_then(parts) {
        let deviation = significant(0.01 * speed, 3);
        let mean = significant(speed, 6);
        add(
            "projectile.velocity",
            &format!(
                "normal = {{ mean = \"{mean} {unit}\", standard_deviation = \"{deviation} {unit}\" }} # 1 %"
            ),
        );
    }
    if let Some((diameter, unit)) = said("projectile.diameter").and_then(parts) {
        let (from, to) = (
            significant(0.995 * diameter, 4),
            significant(1.005 * diameter, 4),
        );
        add(
            "projectile.diameter",
            &format!(
                "uniform = {{ from = \"{from} {unit}\", to = \"{to} {unit}\" }} # half a percent either way"
            ),
        );
    }
    let struck = match &scenario.target {
        TargetBody::Layers { layers, .. } => layers.first().map(|layer| &*layer.material),
        _ => None,
    };
    let of_target = ["target.material", "target.layers.0.material"]
        .into_iter()
        .find_map(said);
    let bodies = [
        (
            said("projectile.material"),
            Some(&*scenario.projectile.material),
        ),
        (of_target, struck),
    ];
    let mut seen: Vec<&str> = Vec::new();
    for (name, material) in bodies {
        let (Some(name), Some(material)) = (name, material) else {
            continue;
        };
        // A key takes a part of digits alone for a place in a list.
        let in_a_key = name.contains(|c: char| !c.is_ascii_digit()) && !name.contains('.');
        if seen.contains(&name) || !in_a_key {
            continue;
        }
        seen.push(name);
        if let Some((key, median)) = strength(material) {
            add(
                &format!("materials.{name}.strength.{key}"),
                &format!(
                    "lognormal = {{ median = \"{median}\", log_standard_deviation = 0.05 }} # about 5 %"
                ),
            );
        }
    }
    format!("{}\n{}\n", text.trim_end(), example.trim_end())
}

/// Number and unit of a quantity.
fn parts(quantity: &str) -> Option<(f64, &str)> {
    let at = quantity.find(|c: char| c.is_whitespace() || c.is_alphabetic() && c != 'e')?;
    let (number, unit) = quantity.split_at(at);
    Some((number.trim().parse().ok()?, unit.trim()))
}

/// The first stress among the numbers of a strength law, by its key within the law, and its value.
fn strength(material: &Material) -> Option<(String, String)> {
    let record = serde_json::to_value(&material.strength).ok()?;
    let (law, numbers) = record.as_object()?.iter().next()?;
    numbers.as_object()?.iter().find_map(|(key, value)| {
        let text = value.as_str()?;
        let (number, unit) = parts(text)?;
        let stress = STRESSES.contains(&unit) && number > 0.0;
        stress.then(|| (format!("{law}.{key}"), text.to_owned()))
    })
}

#[cfg(test)]
mod tests {
    use percuss::{case::Document, uncertainty::Study};

    use super::*;
    use crate::cases;

    #[test]
    fn every_ready_case_can_have_one() {
        for case in cases::all() {
            let name = case.name();
            let scenario = percuss::case::load_str(name, case.text()).unwrap();
            if case.text().contains("[[uncertainty.parameter]]") {
                continue;
            }
            let text = with_example(case.text(), &scenario);
            assert!(text.starts_with(case.text().trim_end()), "{name}");
            let study = Study::of(&Document::new(name, text)).unwrap();
            let keys: Vec<&str> = study.axes.iter().map(|axis| axis.key.as_str()).collect();
            assert_eq!(keys[0], "projectile.velocity", "{name}");
            if name == "paper-table1" {
                assert_eq!(keys[1], "projectile.diameter");
                assert_eq!(keys[2], "materials.copper.strength.power_law.coefficient");
                assert!(keys[3].starts_with("materials.aluminium-2024-t351"));
            }
        }
    }

    #[test]
    fn quantities_fall_into_number_and_unit() {
        assert_eq!(parts("230 m/s"), Some((230.0, "m/s")));
        assert_eq!(parts("2e2m/s"), Some((200.0, "m/s")));
        assert_eq!(parts("semi-infinite"), None);
    }
}
