//! Model `energy_balance`: a rod that deforms, erodes or stays rigid, by where its kinetic energy goes.

mod motion;
mod target;
#[cfg(test)]
mod tests;

use self::{
    motion::{Motion, Stop},
    target::Target,
};
use super::{
    cavity_expansion::effective_yield_stress,
    dynamic_yield::mean_flow_stress,
    impact_wave::ImpactWave,
    long_rod::{LongRod, at_rest, never_yields, rests_on, sharp_and_rigid},
    rod_flow::RodFlow,
};
use crate::{
    Error, Refusal, Scenario,
    material::Material,
    outcome::{BandQuantity, Detail, RunResult},
    regime::TargetKind,
    solver::{Control, Model},
    units::Pressure,
    validity::{Measure, Outside, Range, ValidityDomain},
};

/// A rod by the partition of its kinetic energy.
#[derive(Debug, Clone, Copy)]
pub struct EnergyBalance;

/// Plastic strain over which a flow stress is averaged: the mean strain of metal that spreads to the rod's own width.
const MEAN_STRAIN: f64 = 1.0;
/// Panels of the mean of a slow flow stress.
const PANELS: u32 = 50;

const RANGES: &[Range] = &[
    Range {
        measure: Measure::FlatRodLengthToDiameter,
        min: 0.5,
        max: f64::INFINITY,
        outside: Outside::NotApplicable,
        because: "a disc is not a rod that flows at its tip",
    },
    Range {
        measure: Measure::ImpactSpeed,
        min: 200.0,
        max: 4000.0,
        outside: Outside::Warning,
        because: "slower rods leave dents of the size of elastic motion, and faster ones compress and melt",
    },
    Range::INFINITE_BODY,
];

/// Factor of rate and heat on a flow stress: the mean at a rate [1/s], heated by its own work, over the slow isothermal mean.
fn dynamic_factor(material: &Material, rate: f64) -> Option<f64> {
    let fast = mean_flow_stress(material, MEAN_STRAIN, rate)?;
    let step = MEAN_STRAIN / f64::from(PANELS);
    let mut slow = 0.0;
    for i in 0..PANELS {
        slow += material.flow_stress((f64::from(i) + 0.5) * step)?;
    }
    Some(fast * f64::from(PANELS) / slow)
}

impl EnergyBalance {
    fn motion(scenario: &Scenario) -> Result<(LongRod<'_>, Motion), Refusal> {
        let rod = LongRod::to_integrate(scenario)?;
        let options = &scenario.options.energy_balance;
        let rate = rod.speed / rod.diameter;
        let strength = options
            .projectile_strength
            .map(Pressure::si)
            .or_else(|| mean_flow_stress(rod.projectile, MEAN_STRAIN, rate))
            .ok_or_else(|| never_yields("projectile", "energy_balance.projectile_strength"))?;
        let estimated =
            || Some(effective_yield_stress(rod.target)? * dynamic_factor(rod.target, rate)?);
        let target_strength = options
            .target_strength
            .map(Pressure::si)
            .or_else(estimated)
            .ok_or_else(|| never_yields("target", "energy_balance.target_strength"))?;
        let youngs_modulus = rod.target.youngs_modulus.si();
        if !(strength > 0.0 && target_strength > 0.0) {
            return Err("heat leaves no strength at this velocity".into());
        }
        if 3.0 * target_strength >= 2.0 * youngs_modulus {
            return Err("the target's strength is beyond two thirds of its Young's modulus".into());
        }
        let (density, target_density) = rod.densities();
        let motion = Motion {
            rod: RodFlow {
                density,
                strength,
                area: scenario.projectile.area(),
            },
            target: Target {
                density: target_density,
                strength: target_strength,
                youngs_modulus,
                entry: options.entry(),
            },
            wave: ImpactWave::of(rod.projectile, rod.target),
            mass_factor: 1.0,
        };
        Ok((rod, motion))
    }
}

impl Model for EnergyBalance {
    fn name(&self) -> &'static str {
        "energy_balance"
    }

    fn summary(&self) -> &'static str {
        "rod by the partition of its energy: flow of the rod, debris, pressing and flow of the target, first shock"
    }

    fn validity(&self) -> &'static ValidityDomain {
        const {
            &ValidityDomain {
                predicts: &[BandQuantity::DepthOfPenetration],
                targets: TargetKind::DEEP,
                ranges: RANGES,
                sees_back_face: false,
                notes: &[
                    "normal impact; the shape of the nose is left out: a rod with a nose counts as the flat-ended one of its mass",
                    "the floor of the crater is pressed evenly; metal that has left it takes no further part",
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
        if rod.speed == 0.0 {
            return Ok(at_rest(self.name(), "", &rod, (0.0, rod.length)));
        }
        let stop = motion.penetrate(rod.speed, rod.length)?;
        let mut result = at_rest(self.name(), "", &rod, (stop.depth, stop.length));
        result.time_to_rest = Some(stop.time);
        result.end_time = Some(stop.time);
        result.details = details(scenario, &motion, &stop);
        result.warnings.push(rests_on(
            motion.rod.strength,
            motion.target.deep(),
            "from flow stresses at the rate V/D: `energy_balance.projectile_strength` and `energy_balance.target_strength` replace them",
        ));
        Ok(result)
    }
}

/// Strengths, shares of the kinetic energy and the crater.
fn details(scenario: &Scenario, motion: &Motion, stop: &Stop) -> Vec<Detail> {
    let rod = &scenario.projectile;
    let energy = 0.5 * rod.mass * scenario.impact_velocity.powi(2);
    let shares = &stop.shares;
    let percent = |part: f64| 100.0 * part / energy;
    let volume = shares.target() / motion.target.deep();
    vec![
        Detail::new("projectile strength", "MPa", motion.rod.strength * 1e-6),
        Detail::new("target flow stress", "MPa", motion.target.strength * 1e-6),
        Detail::new(
            "energy per crater volume",
            "MPa",
            motion.target.deep() * 1e-6,
        ),
        Detail::new(
            "energy: plastic work in the rod",
            "%",
            percent(shares.rod_plastic),
        ),
        Detail::new("energy: debris of the rod", "%", percent(shares.debris)),
        Detail::new("energy: first contact", "%", percent(shares.shock)),
        Detail::new("energy: pressing the target", "%", percent(shares.pressing)),
        Detail::new("energy: flow of the target", "%", percent(shares.flow)),
        Detail::new("energy: balance error", "", shares.total() / energy - 1.0),
        Detail::new("crater volume", "cm3", volume * 1e6),
        Detail::new("crater floor to rod diameter", "", stop.spread.sqrt()),
        Detail::new("depth after the rod flows", "mm", stop.after_erosion * 1e3),
    ]
}
