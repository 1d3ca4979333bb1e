//! Captions of figures: the case in one line.

use percuss::{Scenario, scenario::TargetBody, units::significant};

/// Significant digits of a caption's numbers.
const DIGITS: usize = 4;

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
                significant(pressure * 1e-6, DIGITS)
            )
        }
        TargetBody::Layers { layers, .. } => {
            let name = |layer: &percuss::scenario::Plate| {
                let gap = match layer.gap {
                    0.0 => String::new(),
                    gap => format!("{} mm gap + ", significant(gap * 1e3, DIGITS)),
                };
                match layer.thickness {
                    Some(thickness) => {
                        let thickness = significant(thickness * 1e3, DIGITS);
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
        significant(rod.length * 1e3, DIGITS),
        significant(rod.diameter * 1e3, DIGITS),
        rod.material_id,
        speed.map_or_else(String::new, |speed| format!(
            " at {} m/s",
            significant(speed, DIGITS)
        )),
    )
}

/// Case in one line, then numbers.
pub(crate) fn caption_with(scenario: &Scenario, numbers: &str) -> String {
    format!("{}; {numbers}", caption(scenario, None))
}
