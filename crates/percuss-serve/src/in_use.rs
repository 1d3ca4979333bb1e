//! Values in use where a case gives none and the schema has no single default: they depend on the rest of the case.

use std::collections::BTreeMap;

use percuss::{
    Scenario,
    chain::resistance_model_in_use,
    options::{ChainOptions, Geometry},
    problem::LayerInterface,
    scenario::TargetBody,
    units::{Angle, Length, Mass, Temperature, significant},
};

/// Digits of a number in the form.
const DIGITS: usize = 4;

/// Values by dotted key, as the form shows them.
pub(crate) fn of(scenario: &Scenario) -> BTreeMap<String, String> {
    let mut values = BTreeMap::new();
    let mut add = |key: &str, value: String| {
        values.insert(key.to_owned(), value);
    };
    let rod = &scenario.projectile;
    add("projectile.length", length(rod.length));
    add("projectile.mass", Mass::new(rounded(rod.mass)).to_string());
    add(
        "projectile.obliquity",
        Angle::new(scenario.obliquity).to_string(),
    );
    let room = rod.material.room_temperature;
    let temperature = rod.temperature.map_or(room, Temperature::new);
    add("projectile.temperature", temperature.to_string());
    if let TargetBody::Layers {
        layers,
        back_face,
        column_diameter,
        ..
    } = &scenario.target
    {
        add("target.back_face", back_face.name().to_owned());
        add("target.column_diameter", length(*column_diameter));
        for (i, layer) in layers.iter().enumerate() {
            let key = |name: &str| format!("target.layers.{i}.{name}");
            let interface = match layer.interface {
                LayerInterface::Sliding => "sliding",
                LayerInterface::Bonded => "bonded",
            };
            let diameter = layer.column_diameter.unwrap_or(*column_diameter);
            add(&key("gap"), length(layer.gap));
            add(&key("interface"), interface.to_owned());
            add(&key("column_diameter"), length(diameter));
        }
    }
    let chain = &scenario.options.chain;
    if let Some(resistance) = resistance_model_in_use(scenario) {
        add("chain.target_resistance", resistance.name().to_owned());
    }
    add(
        "chain.projectile_elements",
        chain.projectile_elements().to_string(),
    );
    add("chain.target_elements", chain.target_elements().to_string());
    if scenario.options.fdm.geometry == Geometry::Rod {
        for (name, value) in of_rod(chain) {
            add(&format!("fdm.{name}"), value);
        }
    }
    values
}

/// Options that a rod of finite differences takes from the chain.
fn of_rod(chain: &ChainOptions) -> [(&'static str, String); 4] {
    [
        (
            "projectile_elements",
            chain.projectile_elements().to_string(),
        ),
        ("target_elements", chain.target_elements().to_string()),
        ("border_shear", chain.border_shear().to_string()),
        ("max_steps", chain.max_steps().to_string()),
    ]
}

/// A length with its unit.
fn length(si: f64) -> String {
    Length::new(rounded(si)).to_string()
}

/// A number that was computed, without the digits of its rounding errors.
fn rounded(si: f64) -> f64 {
    significant(si, DIGITS).parse().unwrap_or(si)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;

    #[test]
    fn defaults_that_depend_on_the_case_have_their_values() {
        let text = "projectile = { material = 'copper', length = '20 mm', diameter = '5 mm', impact_velocity = '300 m/s' }\n\
            target = { material = 'rha', thickness = 'semi-infinite' }\n";
        let of_text = |text: &str| of(&percuss::case::load_str("case", text).unwrap());
        let values = of_text(text);
        for (key, value) in [
            ("chain.target_resistance", "expanding-cavity"),
            ("chain.target_elements", "80"),
            ("target.back_face", "non-reflecting"),
            ("target.column_diameter", "5 mm"),
            ("fdm.target_elements", "80"),
        ] {
            assert_eq!(values[key], value, "{key}");
        }
        let blunted = text.replace(
            "diameter = '5 mm'",
            "diameter = '5 mm', nose = 'hemisphere'",
        );
        let values = of_text(&blunted);
        assert_eq!(values["chain.target_resistance"], "column");
        let plate = text.replace("semi-infinite", "12 mm");
        assert_eq!(of_text(&plate)["target.back_face"], "fixed");
    }

    #[test]
    fn every_ready_case_has_them() {
        for case in cases::all() {
            let scenario = percuss::case::load_str(case.name(), case.text()).unwrap();
            assert!(
                of(&scenario).contains_key("projectile.mass"),
                "{}",
                case.name()
            );
        }
    }
}
