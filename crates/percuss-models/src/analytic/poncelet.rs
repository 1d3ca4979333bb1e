//! Model `poncelet`: momentum balance of a rigid projectile against strength and drag.

use std::borrow::Cow;

use super::{
    deep_penetration::{DeepPenetration, NOT_ONE_TARGET, at_rest, never_yields},
    nose_load::NoseLoad,
    rigid_motion::RigidMotion,
};
use crate::{
    Error, Refusal, Scenario,
    material::cavity_expansion_pressure,
    options::PonceletOptions,
    outcome::{BandQuantity, Detail, RunResult},
    problem::Nose,
    regime::{ProjectileRegime, TargetKind, nose_factor},
    scenario::TargetBody,
    solver::{Control, Model},
    units::Pressure,
    validity::{Range, ValidityDomain},
};

/// `m V dV/dx = −A (R + C ρ V²)`: the class of momentum balances for thick targets.
#[derive(Debug, Clone, Copy)]
pub struct Poncelet;

impl Poncelet {
    /// R [Pa] and C ρ [kg/m3].
    fn resistance(scenario: &Scenario) -> Result<(f64, f64), Refusal> {
        let options = &scenario.options.poncelet;
        if let TargetBody::ConstantPressure(pressure) = scenario.target {
            if *options != PonceletOptions::default() {
                let reason = "a constant pressure is the resistance, and has no drag";
                return Err(Refusal::new(reason).with_remedy("remove the table `poncelet`"));
            }
            return Ok((pressure, 0.0));
        }
        let case = DeepPenetration::of(scenario).ok_or(NOT_ONE_TARGET)?;
        let resistance = options
            .resistance
            .map(Pressure::si)
            .or_else(|| cavity_expansion_pressure(case.target))
            .ok_or_else(|| never_yields(Some("`poncelet.resistance`")))?;
        let drag = options.drag.unwrap_or_else(|| nose_factor(case.rod.nose));
        Ok((resistance, drag * case.target.density.si()))
    }
}

impl Model for Poncelet {
    fn name(&self) -> &'static str {
        "poncelet"
    }

    fn label(&self) -> Cow<'static, str> {
        Cow::Borrowed("Poncelet")
    }

    fn summary(&self) -> &'static str {
        "momentum balance of a rigid projectile against strength and drag"
    }

    fn validity(&self) -> &'static ValidityDomain {
        const {
            &ValidityDomain {
                predicts: &[BandQuantity::DepthOfPenetration],
                projectile: &[ProjectileRegime::Rigid],
                targets: &[
                    TargetKind::SemiInfinite,
                    TargetKind::ThickPlate,
                    TargetKind::Plate,
                    TargetKind::ConstantPressure,
                ],
                ranges: &[Range::INFINITE_BODY],
                sees_back_face: false,
                notes: &[
                    "the cross-section of the shank is loaded from first contact",
                    "drag by Newton's impact theory: the target in the way takes on the speed of the surface, and nothing flows ahead of it",
                ],
                ..ValidityDomain::OPEN
            }
        }
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        Self::resistance(scenario).err()
    }

    fn run(&self, scenario: &Scenario, _: &mut Control<'_>) -> Result<RunResult, Error> {
        let (strength, inertia) = Self::resistance(scenario)
            .map_err(|refusal| Error::not_applicable(self.name(), refusal))?;
        // The drag coefficient has the nose in it already.
        let motion = RigidMotion {
            mass: scenario.projectile.mass,
            nose: NoseLoad::new(Nose::Flat, scenario.projectile.diameter, 0.0),
            strength,
            inertia,
        };
        let stop = motion.embedded(scenario.impact_velocity);
        let mut result = at_rest(self.name(), "momentum-balance", scenario, stop);
        result.details = vec![
            Detail::new("resistance R", "MPa", strength * 1e-6),
            Detail::new("drag C rho", "kg/m3", inertia),
        ];
        Ok(result)
    }
}
