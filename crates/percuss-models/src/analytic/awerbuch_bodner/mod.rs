//! Model `awerbuch_bodner`: perforation of a plate by a blunt projectile in three stages (reconstructed).

mod history;
mod stages;
#[cfg(test)]
mod tests;

use std::{borrow::Cow, f64::consts::PI};

use self::stages::Impact;
use super::{
    plate_impact::{PLATE_NEVER_FLOWS, PlateImpact, plate_result, refuse, taken_as_rigid},
    plugging::PLUG_RANGES,
};
use crate::{
    Error, Refusal, Scenario,
    material::tensile_strength,
    options::AwerbuchBodnerOptions,
    outcome::{Band, BandQuantity, Detail, Outcome, RunResult, Termination},
    regime::{ProjectileRegime, TargetKind},
    solver::{Control, Model},
    units::Pressure,
    validity::{NoseKind, ValidityDomain},
};

/// Perforation in three stages.
#[derive(Debug, Clone, Copy)]
pub struct AwerbuchBodner;

/// Factor on the strength under a flat face that the plate around it confines \[woodward1982\].
const CONFINEMENT: f64 = 2.7;

/// The impact with a strength [Pa] for what the options do not give.
fn impact(scenario: &Scenario, case: &PlateImpact<'_>, strength: f64) -> Impact {
    let options = &scenario.options.awerbuch_bodner;
    let crushing = options
        .crushing_stress
        .map_or(CONFINEMENT * strength, Pressure::si);
    let shear = options
        .shear_strength
        .map_or(strength / 3.0_f64.sqrt(), Pressure::si);
    Impact {
        mass: case.mass,
        area: case.area(),
        thickness: case.thickness,
        density: case.plate.density.si(),
        crushing_force: crushing * case.area(),
        rim_force: shear * PI * case.diameter,
    }
}

impl Impact {
    /// Ballistic limit of shear alone, as model `plugging` has it [m/s].
    fn plugging_limit(&self) -> f64 {
        let work = self.rim_force * self.thickness.powi(2) / 2.0;
        (2.0 * work * self.joint_mass()).sqrt() / self.mass
    }
}

impl Model for AwerbuchBodner {
    fn name(&self) -> &'static str {
        "awerbuch_bodner"
    }

    fn label(&self) -> Cow<'static, str> {
        Cow::Borrowed("Awerbuch–Bodner")
    }

    fn summary(&self) -> &'static str {
        "perforation of plates by blunt rigid projectiles in three stages: crushing, plug gathering speed, plug sheared out"
    }

    fn validity(&self) -> &'static ValidityDomain {
        const {
            &ValidityDomain {
                predicts: &[BandQuantity::BallisticLimit, BandQuantity::ResidualVelocity],
                projectile: &[ProjectileRegime::Rigid, ProjectileRegime::Deforming],
                targets: TargetKind::PLATES,
                noses: &[NoseKind::Flat],
                ranges: PLUG_RANGES,
                notes: &[
                    "normal impact; reconstructed: the original paper could not be read",
                    "bending of the plate, rate and heat are left out: see the validation report for how far measured limits lie off",
                ],
                ..ValidityDomain::OPEN
            }
        }
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        let case = PlateImpact::of(scenario)?;
        let options = &scenario.options.awerbuch_bodner;
        let given = options.crushing_stress.is_some() && options.shear_strength.is_some();
        (!given && tensile_strength(case.plate).is_none()).then(|| {
            Refusal::new(PLATE_NEVER_FLOWS).with_remedy(
                "give `awerbuch_bodner.crushing_stress` and `awerbuch_bodner.shear_strength`",
            )
        })
    }

    fn run(&self, scenario: &Scenario, control: &mut Control<'_>) -> Result<RunResult, Error> {
        let case =
            PlateImpact::of(scenario).ok_or_else(|| refuse(self.name(), "it takes one plate"))?;
        let strength = tensile_strength(case.plate).unwrap_or(0.0);
        let impact = impact(scenario, &case, strength);
        let limit = impact.ballistic_limit(impact.plugging_limit());
        let mut result = plate_result(self.name(), "three stages", case.speed, limit, 0.0);
        result.details = vec![
            Detail::new(
                "crushing stress",
                "MPa",
                impact.crushing_force / impact.area * 1e-6,
            ),
            Detail::new(
                "shear strength",
                "MPa",
                impact.rim_force / (PI * case.diameter) * 1e-6,
            ),
            Detail::new("mass of the plug", "g", case.plug_mass() * 1e3),
        ];
        result.band = band(scenario, &case);
        if case.speed > 0.0 {
            let run = impact.case(case.speed, true);
            result.outcome = match run.contact_time {
                Some(_) => Outcome::Perforated,
                None => Outcome::AtRest,
            };
            result.termination = match run.contact_time {
                Some(_) => Termination::LeftTarget,
                None => Termination::PenetrationStopped,
            };
            result.residual_velocity = Some(run.last.speed);
            result.peak_force = run.moments.iter().map(|(_, force)| *force).reduce(f64::max);
            result.end_time = Some(run.last.time);
            result.details.extend([
                Detail::new("plug starts to move", "us", run.plug_starts.time * 1e6),
                Detail::new("one body from", "us", run.one_body.time * 1e6),
                Detail::new("crushed thickness", "mm", run.one_body.crushed * 1e3),
                Detail::new("work of crushing", "J", run.last.crushing_work),
                Detail::new("energy lost to capture", "J", run.last.capture),
                Detail::new("work of shear", "J", run.last.shear_work),
            ]);
            match run.contact_time {
                Some(time) => result
                    .details
                    .push(Detail::new("contact time", "us", time * 1e6)),
                None => {
                    result.depth_of_penetration = Some(run.last.depth);
                    result.time_to_rest = Some(run.last.time);
                }
            }
            if control.record {
                result.history = Some(history::of(&impact, &run, scenario.projectile.length));
            }
        } else {
            result.depth_of_penetration = Some(0.0);
        }
        result.warnings.push(
            "model `awerbuch_bodner` is reconstructed: the original paper could not be read; its page states what is assumed"
                .to_owned(),
        );
        result.warnings.extend(taken_as_rigid(scenario));
        Ok(result)
    }
}

/// Range of the ballistic limit between the yield stress and the flow stress at unit strain, where neither stress is given.
fn band(scenario: &Scenario, case: &PlateImpact<'_>) -> Option<Band> {
    if scenario.options.awerbuch_bodner != AwerbuchBodnerOptions::default() {
        return None;
    }
    let law = case.plate.strength.law();
    let at = |strength: f64| {
        let impact = impact(scenario, case, strength);
        impact.ballistic_limit(impact.plugging_limit())
    };
    let middle = at(tensile_strength(case.plate)?);
    Some(Band {
        quantity: BandQuantity::BallisticLimit,
        low: at(law.initial_yield_stress(case.plate)?).min(middle),
        high: at(law.flow_stress_at_unit_strain(case.plate)?).max(middle),
        basis: "both stresses from the yield stress, and from the flow stress at unit strain",
    })
}
