//! Model `lambert_jonas`: residual velocity from a ballistic limit by the three-parameter form.

use std::borrow::Cow;

use super::{
    limit::{input_limit, limit},
    plate_impact::{PlateImpact, plate_result, refuse},
};
use crate::{
    Error, Refusal, Scenario,
    outcome::{BandQuantity, Detail, RunResult},
    regime::TargetKind,
    solver::{Control, InputLimit, Model},
    validity::ValidityDomain,
};

/// Lambert and Jonas's residual velocity.
#[derive(Debug, Clone, Copy)]
pub struct LambertJonas;

impl Model for LambertJonas {
    fn name(&self) -> &'static str {
        "lambert_jonas"
    }

    fn label(&self) -> Cow<'static, str> {
        Cow::Borrowed("Lambert–Jonas")
    }

    fn summary(&self) -> &'static str {
        "residual velocity behind a plate from a ballistic limit: v_r = a (v^p - v_bl^p)^(1/p)"
    }

    fn validity(&self) -> &'static ValidityDomain {
        const {
            &ValidityDomain {
                predicts: &[BandQuantity::ResidualVelocity],
                targets: TargetKind::PLATES,
                notes: &[
                    "normal impact",
                    "a form with three parameters: it interpolates between measured points and explains nothing",
                ],
                ..ValidityDomain::OPEN
            }
        }
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        limit(
            scenario,
            scenario.options.lambert_jonas.ballistic_limit,
            self.name(),
        )
        .err()
    }

    fn input_limit(&self, scenario: &Scenario) -> Option<InputLimit> {
        let given = scenario.options.lambert_jonas.ballistic_limit;
        input_limit(scenario, given, self.name())
    }

    fn run(&self, scenario: &Scenario, _: &mut Control<'_>) -> Result<RunResult, Error> {
        let options = &scenario.options.lambert_jonas;
        let limit = limit(scenario, options.ballistic_limit, self.name())
            .map_err(|reason| refuse(self.name(), reason))?;
        let case =
            PlateImpact::of(scenario).ok_or_else(|| refuse(self.name(), "it takes one plate"))?;
        let a = options
            .a
            .unwrap_or(case.mass / (case.mass + case.plug_mass() / 3.0));
        let p = options
            .p
            .unwrap_or(2.0 + case.thickness_to_diameter() / 3.0);
        let residual = if case.speed > limit.speed {
            // Through the ratio, so that a large p does not overflow.
            let ratio = (limit.speed / case.speed).powf(p);
            a * case.speed * (1.0 - ratio).powf(1.0 / p)
        } else {
            0.0
        };
        let mut result = plate_result(self.name(), "", case.speed, limit.speed, residual);
        // What the model starts from is no prediction of it.
        result.ballistic_limit = None;
        result.details = vec![
            limit.detail,
            Detail::new("factor a", "", a),
            Detail::new("exponent p", "", p),
        ];
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
