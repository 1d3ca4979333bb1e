//! Captions of figures: the case in one line, and numbers to four digits.

use percuss::{Scenario, scenario::TargetBody};

/// Case in one line: its title, or projectile and target with the impact velocity [m/s], where there is one.
pub(crate) fn caption(scenario: &Scenario, speed: Option<f64>) -> String {
    if !scenario.title.trim().is_empty() {
        return scenario.title.clone();
    }
    let rod = &scenario.projectile;
    let target = match &scenario.target {
        TargetBody::RigidWall => "on a rigid wall".to_owned(),
        TargetBody::ConstantPressure(pressure) => {
            format!(
                "against a constant pressure of {} MPa",
                significant(pressure * 1e-6)
            )
        }
        TargetBody::Layers { layers, .. } => {
            let name = |layer: &percuss::scenario::Plate| {
                let gap = match layer.gap {
                    0.0 => String::new(),
                    gap => format!("{} mm gap + ", significant(gap * 1e3)),
                };
                match layer.thickness {
                    Some(thickness) => {
                        let thickness = significant(thickness * 1e3);
                        format!("{gap}{thickness} mm {}", layer.material_id)
                    }
                    None => format!("{gap}thick {}", layer.material_id),
                }
            };
            let layers: Vec<String> = layers.iter().map(name).collect();
            format!("on {}", layers.join(" + "))
        }
    };
    format!(
        "{} mm × {} mm {}{} {target}",
        significant(rod.length * 1e3),
        significant(rod.diameter * 1e3),
        rod.material_id,
        speed.map_or_else(String::new, |speed| format!(
            " at {} m/s",
            significant(speed)
        )),
    )
}

/// Case in one line, then numbers.
pub(crate) fn caption_with(scenario: &Scenario, numbers: &str) -> String {
    format!("{}; {numbers}", caption(scenario, None))
}

/// A number to four significant digits, without trailing zeros.
pub(crate) fn significant(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let decimals = (3.0 - value.abs().log10().floor()).max(0.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_four_digits() {
        for (value, text) in [
            (12.74, "12.74"),
            (230.0, "230"),
            (0.0, "0"),
            (12345.6, "12346"),
            (0.001_234_56, "0.001235"),
            (-25.000_001, "-25"),
        ] {
            assert_eq!(significant(value), text);
        }
    }
}
