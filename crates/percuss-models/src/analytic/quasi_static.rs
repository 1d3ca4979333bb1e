//! Model `cavity_expansion`: a rigid projectile against the quasi-static pressure of an expanding spherical cavity.

use super::{
    cavity_expansion::CavityExpansion,
    deep_penetration::{DeepPenetration, NEVER_YIELDS, NOT_ONE_TARGET, at_rest, never_yields},
    nose_load::NoseLoad,
    rigid_motion::RigidMotion,
};
use crate::{
    Error, Refusal, Scenario,
    material::cavity_expansion_pressure,
    outcome::{Band, BandQuantity, Detail, RunResult},
    regime::{ProjectileRegime, TargetKind},
    solver::{Control, Model},
    units::significant,
    validity::{Range, ValidityDomain},
};

/// Dynamic pressure over the quasi-static one from which on a depth without inertia is warned of.
const INERTIA_MATTERS: f64 = 0.1;

/// Quasi-static spherical cavity expansion \[bishop1945, hill1950\].
#[derive(Debug, Clone, Copy)]
pub struct QuasiStatic;

impl Model for QuasiStatic {
    fn name(&self) -> &'static str {
        "cavity_expansion"
    }

    fn summary(&self) -> &'static str {
        "rigid projectile against the quasi-static pressure of spherical cavity expansion"
    }

    fn validity(&self) -> &'static ValidityDomain {
        const {
            &ValidityDomain {
                predicts: &[BandQuantity::DepthOfPenetration],
                projectile: &[ProjectileRegime::Rigid],
                targets: TargetKind::DEEP,
                ranges: &[Range::INFINITE_CAVITY],
                sees_back_face: false,
                notes: &[
                    "no inertia of the target: good at low speed, too deep at high speed",
                    "the whole nose is loaded from first contact; frictionless",
                ],
                ..ValidityDomain::OPEN
            }
        }
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        match DeepPenetration::of(scenario) {
            None => Some(NOT_ONE_TARGET.into()),
            Some(case) if cavity_expansion_pressure(case.target).is_none() => {
                Some(never_yields(None))
            }
            Some(_) => None,
        }
    }

    fn run(&self, scenario: &Scenario, _: &mut Control<'_>) -> Result<RunResult, Error> {
        let refuse = |reason: &str| Error::not_applicable(self.name(), reason);
        let case = DeepPenetration::of(scenario).ok_or_else(|| refuse(NOT_ONE_TARGET))?;
        let pressure =
            cavity_expansion_pressure(case.target).ok_or_else(|| refuse(NEVER_YIELDS))?;
        let body = CavityExpansion::of(case.target).ok_or_else(|| refuse(NEVER_YIELDS))?;
        let nose = NoseLoad::new(case.rod.nose, case.rod.diameter, 0.0);
        let against = |strength: f64| {
            let motion = RigidMotion {
                mass: case.rod.mass,
                nose,
                strength,
                inertia: 0.0,
            };
            motion.embedded(case.speed)
        };
        let compressible = body.static_pressure();
        let stop = against(pressure);
        let other = against(compressible).depth;
        let mut result = at_rest(self.name(), "incompressible", scenario, stop);
        let dynamic = 1.5 * nose.factors().1 * case.target.density.si() * case.speed.powi(2);
        result.details = vec![
            Detail::new("quasi-static pressure", "MPa", pressure * 1e-6),
            Detail::new("compressible pressure", "MPa", compressible * 1e-6),
            Detail::new("effective yield stress", "MPa", body.yield_stress * 1e-6),
            Detail::new("dynamic to static pressure", "", dynamic / pressure),
        ];
        if case.speed > 0.0 {
            result.band = Some(Band {
                quantity: BandQuantity::DepthOfPenetration,
                low: other.min(stop.depth) * 1e3,
                high: other.max(stop.depth) * 1e3,
                basis: "incompressible to compressible target",
            });
        }
        if dynamic > INERTIA_MATTERS * pressure {
            result.warnings.push(format!(
                "the inertia of the target, which this model leaves out, would add {} % to the pressure at impact: the depth is too large; \
                 model `forrestal` has it",
                significant(100.0 * dynamic / pressure, 2)
            ));
        }
        Ok(result)
    }
}
