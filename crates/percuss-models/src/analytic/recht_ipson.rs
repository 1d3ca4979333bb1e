//! Model `recht_ipson`: residual velocity from a ballistic limit by energy and momentum.

use std::borrow::Cow;

use super::{
    limit::{input_limit, limit},
    plate_impact::{PlateImpact, plate_result, refuse, taken_as_rigid},
};
use crate::{
    Error, Refusal, Scenario,
    outcome::{BandQuantity, Detail, RunResult},
    regime::{ProjectileRegime, TargetKind},
    solver::{Control, InputLimit, Model},
    validity::{NoseKind, ValidityDomain},
};

/// Recht and Ipson's residual velocity.
#[derive(Debug, Clone, Copy)]
pub struct RechtIpson;

impl Model for RechtIpson {
    fn name(&self) -> &'static str {
        "recht_ipson"
    }

    fn label(&self) -> Cow<'static, str> {
        Cow::Borrowed("Recht–Ipson")
    }

    fn summary(&self) -> &'static str {
        "residual velocity behind a plate from a ballistic limit, by energy and momentum"
    }

    fn validity(&self) -> &'static ValidityDomain {
        const {
            &ValidityDomain {
                predicts: &[BandQuantity::ResidualVelocity],
                projectile: &[ProjectileRegime::Rigid, ProjectileRegime::Deforming],
                targets: TargetKind::PLATES,
                oblique_noses: NoseKind::SHARP,
                notes: &[
                    "the work that the plate takes does not depend on the speed",
                    "a flat nose drives a plug of its own diameter through the whole thickness; a sharp nose leaves the metal in the plate",
                ],
                ..ValidityDomain::OPEN
            }
        }
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        limit(
            scenario,
            scenario.options.recht_ipson.ballistic_limit,
            self.name(),
        )
        .err()
    }

    fn input_limit(&self, scenario: &Scenario) -> Option<InputLimit> {
        let given = scenario.options.recht_ipson.ballistic_limit;
        input_limit(scenario, given, self.name())
    }

    fn run(&self, scenario: &Scenario, _: &mut Control<'_>) -> Result<RunResult, Error> {
        let given = scenario.options.recht_ipson.ballistic_limit;
        let limit =
            limit(scenario, given, self.name()).map_err(|reason| refuse(self.name(), reason))?;
        let case =
            PlateImpact::of(scenario).ok_or_else(|| refuse(self.name(), "it takes one plate"))?;
        let plug = match NoseKind::of(scenario.projectile.nose) {
            NoseKind::Flat => case.plug_mass(),
            _ => 0.0,
        };
        let factor = case.mass / (case.mass + plug);
        let excess = (case.speed.powi(2) - limit.speed.powi(2)).max(0.0);
        let residual = factor * excess.sqrt();
        let mut result = plate_result(self.name(), "", case.speed, limit.speed, residual);
        // What the model starts from is no prediction of it.
        result.ballistic_limit = None;
        // Energy: ½mV² = capture + work + ½(m + m_p)V_r², and the work is what the limit leaves after the capture.
        result.details = vec![
            limit.detail,
            Detail::new("mass of the plug", "g", plug * 1e3),
            Detail::new(
                "work that the plate takes",
                "J",
                0.5 * case.mass * factor * limit.speed.powi(2),
            ),
            Detail::new(
                "energy lost to the capture of the plug",
                "J",
                0.5 * case.mass * (1.0 - factor) * case.speed.powi(2),
            ),
        ];
        result.warnings.extend(limit.warnings);
        result.warnings.extend(taken_as_rigid(scenario));
        Ok(result)
    }
}
