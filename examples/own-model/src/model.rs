//! Model `constant_resistance`: a rigid projectile against a constant pressure, `P = m V² / (2 A p)`.

use percuss::{
    Error, Refusal, Scenario,
    model::{Control, Model},
    outcome::{Outcome, RunResult, Termination},
    validity::ValidityDomain,
};
use serde::Deserialize;

/// Table `[extensions.constant_resistance]` of a case.
#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Options {
    /// Pressure on the face of the projectile [GPa].
    pub pressure_gpa: Option<f64>,
}

/// A rigid projectile against a constant pressure.
#[derive(Debug, Clone, Copy)]
pub struct ConstantResistance;

impl ConstantResistance {
    fn pressure(self, scenario: &Scenario) -> Result<f64, Refusal> {
        let options: Options = scenario
            .extensions
            .read(self.name())
            .map_err(|error| Refusal::new(error.to_string()))?;
        match options.pressure_gpa {
            Some(pressure) if pressure > 0.0 => Ok(1e9 * pressure),
            _ => Err(Refusal::new("the pressure is missing or not positive")
                .with_remedy("give `extensions.constant_resistance.pressure_gpa`")),
        }
    }
}

impl Model for ConstantResistance {
    fn name(&self) -> &'static str {
        "constant_resistance"
    }

    fn summary(&self) -> &'static str {
        "rigid projectile against a constant pressure"
    }

    fn validity(&self) -> &'static ValidityDomain {
        const {
            &ValidityDomain {
                notes: &["the projectile does not deform"],
                ..ValidityDomain::OPEN
            }
        }
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        self.pressure(scenario).err()
    }

    fn run(&self, scenario: &Scenario, _: &mut Control<'_>) -> Result<RunResult, Error> {
        let pressure = self
            .pressure(scenario)
            .map_err(|refusal| Error::not_applicable(self.name(), refusal))?;
        let rod = &scenario.projectile;
        let energy = 0.5 * rod.mass * scenario.impact_velocity.powi(2);
        let mut result = RunResult::new(self.name(), "", Outcome::AtRest, Termination::ClosedForm);
        result.depth_of_penetration = Some(energy / (rod.area() * pressure));
        Ok(result)
    }
}
