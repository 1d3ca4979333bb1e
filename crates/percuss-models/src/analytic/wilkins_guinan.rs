//! Model `wilkins_guinan`: a rod on a rigid wall whose plastic front stands still a fixed part of its length from the wall.

use std::borrow::Cow;

use super::{
    dynamic_yield::{DynamicYield, Shortening, dynamic_yield},
    taylor::{WALL, on_wall},
};
use crate::{
    Error, Refusal, Scenario,
    outcome::{Detail, RunResult},
    solver::{Control, Model},
    validity::{FittedTo, ValidityDomain},
};

/// Final over initial length of a rod for `ρV²/Y`: `(1 − h) exp(−ρV²/(2Y)) + h`, h the distance of the front from the wall over the
/// initial length.
///
/// The rear, `L − h L₀` long, is slowed down by Y over its section: `ρ (L − h L₀) dv/dt = −Y`, `dL/dt = −v` \[wilkins1973\].
pub fn wilkins_guinan_length(number: f64, front: f64) -> f64 {
    (1.0 - front) * (-number / 2.0).exp() + front
}

/// Dynamic yield stress [Pa] of a rod from its density [kg/m3], impact velocity [m/s], final over initial length, and the front's
/// distance from the wall over the initial length; `None` unless the final length is between the front and 1.
pub fn wilkins_guinan_yield_stress(
    density: f64,
    speed: f64,
    length_ratio: f64,
    front: f64,
) -> Option<f64> {
    (length_ratio > front && length_ratio < 1.0 && speed > 0.0 && density > 0.0)
        .then(|| density * speed * speed / (2.0 * ((1.0 - front) / (length_ratio - front)).ln()))
}

/// Wilkins and Guinan's rod on a wall \[wilkins1973\].
#[derive(Debug, Clone, Copy)]
pub struct WilkinsGuinan;

impl WilkinsGuinan {
    fn front(scenario: &Scenario) -> f64 {
        scenario.options.wilkins_guinan.front_to_length()
    }

    fn yield_stress(self, scenario: &Scenario) -> Result<DynamicYield, Refusal> {
        let given = scenario.options.wilkins_guinan.dynamic_yield_stress;
        let front = Self::front(scenario);
        dynamic_yield(scenario, given, self.name(), |number| {
            let length = wilkins_guinan_length(number, front);
            // What passed the front, 1 − (L_f − h) of the initial length, now is h long. A front on the wall leaves no such part:
            // its strain is that of the whole rod.
            let strain = if front > 0.0 {
                ((1.0 - length + front) / front).ln()
            } else {
                number / 2.0
            };
            Shortening { length, strain }
        })
    }
}

impl Model for WilkinsGuinan {
    fn name(&self) -> &'static str {
        "wilkins_guinan"
    }

    fn label(&self) -> Cow<'static, str> {
        Cow::Borrowed("Wilkins–Guinan")
    }

    fn summary(&self) -> &'static str {
        "final length of a rigid-plastic rod on a rigid wall, plastic front at a fixed distance"
    }

    fn validity(&self) -> &'static ValidityDomain {
        const {
            &ValidityDomain {
                fitted_to: &[FittedTo {
                    sources: &["wilkins1973"],
                    because: "the place of the plastic front, 0.12 of the length, was found there",
                }],
                ..*WALL
            }
        }
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        self.yield_stress(scenario).err()
    }

    fn run(&self, scenario: &Scenario, _: &mut Control<'_>) -> Result<RunResult, Error> {
        let dynamic = self
            .yield_stress(scenario)
            .map_err(|refusal| Error::not_applicable(self.name(), refusal))?;
        let rod = &scenario.projectile;
        let front = Self::front(scenario);
        let number = rod.material.density.si() * scenario.impact_velocity.powi(2) / dynamic.stress;
        let length = wilkins_guinan_length(number, front);
        let mut result = on_wall(self.name(), "standing-front", scenario, &dynamic, length);
        let front_mm = front * rod.length * 1e3;
        result
            .details
            .push(Detail::new("front to wall", "mm", front_mm));
        Ok(result)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_front_on_the_wall_gives_the_logarithm() {
        for number in [0.0, 0.1, 1.0] {
            assert!((wilkins_guinan_length(number, 0.0).ln() + number / 2.0).abs() < 1e-15);
            assert!(wilkins_guinan_length(number, 0.12) >= wilkins_guinan_length(number, 0.0));
        }
        assert_eq!(wilkins_guinan_length(0.0, 0.12), 1.0);
    }

    #[test]
    fn the_inverse_gives_the_yield_stress_back() {
        let (density, speed, yield_stress): (f64, f64, f64) = (8960.0, 183.0, 400e6);
        let length = wilkins_guinan_length(density * speed.powi(2) / yield_stress, 0.12);
        let found = wilkins_guinan_yield_stress(density, speed, length, 0.12).unwrap();
        assert!((found / yield_stress - 1.0).abs() < 1e-12);
        assert!(wilkins_guinan_yield_stress(density, speed, 0.11, 0.12).is_none());
    }
}
