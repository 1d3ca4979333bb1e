//! Model `lambert_jonas`: residual velocity from a ballistic limit by the three-parameter form.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    limit::{InputLimit, limit},
    plate_shot::{PlateShot, plate_result, refuse},
};
use crate::{
    Error, Scenario,
    case::Target,
    check::{Check, limits},
    guard::Guard,
    model::{Control, Model},
    outcome::{BandQuantity, Detail, RunResult},
    regime::TargetKind,
    units::Velocity,
};

/// Lambert and Jonas's residual velocity.
#[derive(Debug, Clone, Copy)]
pub struct LambertJonas;

/// Options of the model `lambert_jonas`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct LambertJonasOptions {
    /// Ballistic limit [m/s]; that of `plugging` (flat noses) or `plate_cavity` (sharp ones) when not given.
    pub ballistic_limit: Option<Velocity>,
    /// Factor a; `m/(m + m_p/3)` with the mass m_p of plate in line with the shank when not given.
    pub a: Option<f64>,
    /// Exponent p; `2 + h/(3D)` when not given.
    pub p: Option<f64>,
}

impl LambertJonasOptions {
    pub(crate) fn check(&self, check: &mut Check<'_>, _: &Target) {
        if let Some(limit) = self.ballistic_limit {
            check.quantity("ballistic_limit", limit, limits::IMPACT_SPEED);
        }
        if let Some(a) = self.a {
            check.number("a", a, limits::RESIDUAL_FACTOR);
        }
        if let Some(p) = self.p {
            check.number("p", p, limits::RESIDUAL_EXPONENT);
        }
    }
}

impl Model for LambertJonas {
    fn name(&self) -> &'static str {
        "lambert_jonas"
    }

    fn summary(&self) -> &'static str {
        "residual velocity behind a plate from a ballistic limit: v_r = a (v^p - v_bl^p)^(1/p)"
    }

    fn guard(&self) -> &'static Guard {
        const {
            &Guard {
                predicts: &[BandQuantity::ResidualVelocity],
                targets: TargetKind::PLATES,
                notes: &[
                    "normal impact",
                    "a form with three parameters: it interpolates between measured points and explains nothing",
                ],
                ..Guard::OPEN
            }
        }
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<String> {
        limit(
            scenario,
            scenario.options.lambert_jonas.ballistic_limit,
            self.name(),
        )
        .err()
    }

    fn input_limit(&self, scenario: &Scenario) -> Option<InputLimit> {
        let given = scenario.options.lambert_jonas.ballistic_limit;
        InputLimit::of(scenario, given, self.name())
    }

    fn run(&self, scenario: &Scenario, _: &mut Control<'_>) -> Result<RunResult, Error> {
        let options = &scenario.options.lambert_jonas;
        let limit = limit(scenario, options.ballistic_limit, self.name())
            .map_err(|reason| refuse(self.name(), reason))?;
        let shot =
            PlateShot::of(scenario).ok_or_else(|| refuse(self.name(), "it takes one plate"))?;
        let a = options
            .a
            .unwrap_or(shot.mass / (shot.mass + shot.plug_mass() / 3.0));
        let p = options
            .p
            .unwrap_or(2.0 + shot.thickness_to_diameter() / 3.0);
        let residual = if shot.speed > limit.speed {
            // Through the ratio, so that a large p does not overflow.
            let ratio = (limit.speed / shot.speed).powf(p);
            a * shot.speed * (1.0 - ratio).powf(1.0 / p)
        } else {
            0.0
        };
        let mut result = plate_result(self.name(), "", shot.speed, limit.speed, residual);
        // What the model starts from is no prediction of it.
        result.ballistic_limit = None;
        let detail = |name, value| Detail {
            name,
            unit: "",
            value,
        };
        result.details = vec![limit.detail, detail("factor a", a), detail("exponent p", p)];
        result.warnings.extend(limit.warnings);
        if options.a.is_none() || options.p.is_none() {
            result.warnings.push(
                "a and p that are not given follow a rule for long rods that is reconstructed from memory; measured points give better ones"
                    .to_owned(),
            );
        }
        Ok(result)
    }
}
