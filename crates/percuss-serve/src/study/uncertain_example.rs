//! Example of uncertain parameters of a case.

use percuss::{Scenario, material::Material, units::significant};
use serde_json::Value;

use crate::{
    constants::{self, quantity},
    form,
};

/// Units of stress.
const STRESSES: [&str; 4] = ["Pa", "kPa", "MPa", "GPa"];

/// The text of a case with a table `uncertainty` at its end, whose spreads are assumptions and say so.
pub(super) fn with_example(text: &str, scenario: &Scenario) -> String {
    let values = form::values(text);
    let said = |key: &str| values.get(key).and_then(Value::as_str);
    let mut example = String::from(
        "\n# Uncertain parameters for `percuss uncertainty` and the button `Uncertainty`. The distributions are assumptions: replace them by your own.\n",
    );
    let mut add = |key: &str, distribution: &str| {
        example += &format!("[[uncertainty.parameter]]\nkey = \"{key}\"\n{distribution}\n\n");
    };
    if let Some((speed, unit)) = said("projectile.impact_velocity").and_then(quantity) {
        let deviation = significant(0.01 * speed, 3);
        let mean = significant(speed, 6);
        add(
            "projectile.impact_velocity",
            &format!(
                "normal = {{ mean = \"{mean} {unit}\", standard_deviation = \"{deviation} {unit}\" }} # 1 %"
            ),
        );
    }
    if let Some((diameter, unit)) = said("projectile.diameter").and_then(quantity) {
        let (from, to) = (
            significant(0.995 * diameter, 4),
            significant(1.005 * diameter, 4),
        );
        add(
            "projectile.diameter",
            &format!("uniform = {{ from = \"{from} {unit}\", to = \"{to} {unit}\" }} # ±0.5 %"),
        );
    }
    // The projectile and what it strikes first.
    for (name, material) in constants::named(&values, scenario).into_iter().take(2) {
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

/// The first stress among the numbers of a strength law, by its key within the material's strength, and its value.
fn strength(material: &Material) -> Option<(String, String)> {
    constants::of(material).into_iter().find_map(|constant| {
        let key = constant.key.strip_prefix("strength.")?;
        let (number, unit) = quantity(&constant.value)?;
        let stress = STRESSES.contains(&unit) && number > 0.0;
        stress.then(|| (key.to_owned(), constant.value.clone()))
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
            assert_eq!(keys[0], "projectile.impact_velocity", "{name}");
            if name == "paper-table1" {
                assert_eq!(keys[1], "projectile.diameter");
                assert_eq!(keys[2], "materials.copper.strength.power_law.coefficient");
                assert!(keys[3].starts_with("materials.aluminium-2024-t351"));
            }
        }
    }
}
