//! Model `momentum_balance`: a long rod against the momentum of the target's plastic zone.

mod motion;
#[cfg(test)]
mod tests;
mod zone;

use self::{motion::Motion, zone::Zone};
use super::{
    cavity_expansion::CavityExpansion,
    impact_wave::ImpactWave,
    long_rod::{LongRod, at_rest, never_yields, rests_on, sharp_and_rigid, strength},
    rod_flow::RodFlow,
};
use crate::{
    Error, Refusal, Scenario,
    outcome::{BandQuantity, Detail, RunResult},
    regime::TargetKind,
    solver::{Control, Model},
    units::{Length, Pressure},
    validity::{Measure, Outside, Range, ValidityDomain},
};

/// A long rod by the momentum of rod and target on their axis.
#[derive(Debug, Clone, Copy)]
pub struct MomentumBalance;

const RANGES: &[Range] = &[
    Range {
        measure: Measure::FlatRodLengthToDiameter,
        min: 1.0,
        max: f64::INFINITY,
        outside: Outside::NotApplicable,
        because: "the tail has to feel the floor through a rod",
    },
    Range {
        measure: Measure::FlatRodLengthToDiameter,
        min: 3.0,
        max: f64::INFINITY,
        outside: Outside::Warning,
        because: "the mushroom of a shorter rod is as long as the rod",
    },
    Range {
        measure: Measure::ImpactSpeed,
        min: 0.0,
        max: 4000.0,
        outside: Outside::Warning,
        because: "melting and the compression of the rod are left out",
    },
    Range::INFINITE_BODY,
];

impl MomentumBalance {
    fn motion(scenario: &Scenario) -> Result<(LongRod<'_>, Motion), Refusal> {
        let rod = LongRod::to_integrate(scenario)?;
        let options = &scenario.options.momentum_balance;
        let own = strength(
            options.projectile_strength,
            rod.projectile,
            "projectile",
            "momentum_balance.projectile_strength",
        )?;
        // The record's own flow stress is needed only where the case gives none.
        let body = match options.target_strength {
            Some(given) => Some(CavityExpansion {
                density: rod.target.density.si(),
                youngs_modulus: rod.target.youngs_modulus.si(),
                poissons_ratio: rod.target.poissons_ratio,
                yield_stress: Pressure::si(given),
            }),
            None => CavityExpansion::of(rod.target),
        };
        let body =
            body.ok_or_else(|| never_yields("target", "momentum_balance.target_strength"))?;
        let mut motion = Motion {
            rod: RodFlow {
                density: rod.projectile.density.si(),
                strength: own,
                area: scenario.projectile.area(),
            },
            zone: Zone::new(&body, options.shear()),
            radius: 0.5 * rod.diameter,
            wave: ImpactWave::of(rod.projectile, rod.target),
            slice: 0.5 * rod.diameter,
        };
        let extent = motion.zone.extent(0.0);
        if extent.is_nan() || extent <= 1.0 {
            return Err(
                "the target's strength is so near its stiffness that no plastic zone forms".into(),
            );
        }
        // A rod that stays rigid has a floor of its own width.
        let arriving = rod.speed - motion.first_speed(rod.speed);
        motion.radius = options.crater_radius.map_or_else(
            || motion.radius * motion.rod.turned(arriving).spread.sqrt(),
            Length::si,
        );
        Ok((rod, motion))
    }
}

impl Model for MomentumBalance {
    fn name(&self) -> &'static str {
        "momentum_balance"
    }

    fn summary(&self) -> &'static str {
        "long rod against the momentum of the target's plastic zone, from impact to the flow after the rod"
    }

    fn validity(&self) -> &'static ValidityDomain {
        const {
            &ValidityDomain {
                predicts: &[
                    BandQuantity::DepthOfPenetration,
                    BandQuantity::ProjectileFinalLength,
                ],
                targets: TargetKind::DEEP,
                ranges: RANGES,
                sees_back_face: false,
                notes: &[
                    "normal impact; the shape of the nose is left out: a rod with a nose counts as the flat-ended one of its mass",
                    "a rigid rod carries a rounded cap: half the stagnation pressure of a flat face",
                ],
                ..ValidityDomain::OPEN
            }
        }
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        sharp_and_rigid(scenario).or_else(|| Self::motion(scenario).err())
    }

    fn run(&self, scenario: &Scenario, _: &mut Control<'_>) -> Result<RunResult, Error> {
        let (rod, motion) = Self::motion(scenario)
            .map_err(|refusal| Error::not_applicable(self.name(), refusal))?;
        let stop = match rod.speed == 0.0 {
            true => None,
            false => Some(motion.penetrate(rod.speed, rod.length)?),
        };
        let (depth, left) = stop.map_or((0.0, rod.length), |stop| (stop.depth, stop.length));
        let mut result = at_rest(self.name(), "", &rod, (depth, left));
        rod.set_final(scenario, left, &mut result);
        let Some(stop) = stop else {
            return Ok(result);
        };
        let extent = motion.zone.extent(stop.first_speed);
        result.details = vec![
            Detail::new("projectile strength", "MPa", motion.rod.strength * 1e-6),
            Detail::new("target flow stress", "MPa", motion.zone.strength * 1e-6),
            Detail::new("crater radius", "mm", motion.radius * 1e3),
            Detail::new("floor speed at impact", "m/s", stop.first_speed),
            Detail::new("extent of the plastic zone at impact", "", extent),
            Detail::new(
                "target resistance at impact",
                "MPa",
                motion.zone.resistance(extent) * 1e-6,
            ),
            Detail::new("depth after the erosion", "mm", stop.after_erosion * 1e3),
            Detail::new("momentum balance error", "", stop.balance_error),
        ];
        result.warnings.push(rests_on(
            motion.rod.strength,
            motion.zone.resistance(motion.zone.extent(0.0)),
            "which falls with the speed of the floor; the strengths are `momentum_balance.projectile_strength` and \
             `momentum_balance.target_strength`",
        ));
        Ok(result)
    }
}
