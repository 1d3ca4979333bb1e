//! Model `plugging`: plugging criterion, plugging work, ballistic limit and residual velocity.

use std::f64::consts::PI;

use super::plate_impact::{PLATE_NEVER_FLOWS, PlateImpact, plate_result, refuse, taken_as_rigid};
use crate::{
    Error, Refusal, Scenario,
    material::{Material, tensile_strength},
    outcome::{Band, BandQuantity, Detail, RunResult},
    regime::{ProjectileRegime, THIN, TargetKind},
    solver::{Control, Model},
    validity::{Measure, NoseKind, Outside, Range, ValidityDomain},
};

/// Shearing out a plug.
#[derive(Debug, Clone, Copy)]
pub struct Plugging;

/// Thickness in diameters above which no plug is computed.
const THICKEST_PLUG: f64 = 1.5;

/// Shear strength of a metal: its tensile strength over √3 (von Mises) [Pa]; `None` for a law that never flows.
fn shear_strength(material: &Material) -> Option<f64> {
    Some(tensile_strength(material)? / 3.0_f64.sqrt())
}

/// Work to shear out a plug [J]: `∫₀ʰ τ π D (h − s) ds = τ π D h²/2`.
fn shear_work(case: &PlateImpact<'_>, shear_strength: f64) -> f64 {
    shear_strength * PI * case.diameter * case.thickness.powi(2) / 2.0
}

/// Speed [m/s] at which the energy that the plug's capture leaves over is the work `W`: `√(2 W (m + m_p))/m`.
fn limit_of_work(case: &PlateImpact<'_>, work: f64) -> f64 {
    (2.0 * work * (case.mass + case.plug_mass())).sqrt() / case.mass
}

/// Shear strength [Pa] that a case gives or its plate implies; `None` when it gives none and the plate never flows.
fn strength_of(scenario: &Scenario, case: &PlateImpact<'_>) -> Option<f64> {
    match scenario.options.plugging.shear_strength {
        Some(given) => Some(given.si()),
        None => shear_strength(case.plate),
    }
}

/// Ballistic limit of a case [m/s]; `None` when the plate never flows or there is no plate.
pub(super) fn ballistic_limit(scenario: &Scenario) -> Option<f64> {
    let case = PlateImpact::of(scenario)?;
    let strength = strength_of(scenario, &case)?;
    Some(limit_of_work(&case, shear_work(&case, strength)))
}

/// Common speed of projectile and plug behind the plate [m/s] \[recht1963\].
fn residual_with_plug(case: &PlateImpact<'_>, ballistic_limit: f64) -> f64 {
    let excess = (case.speed.powi(2) - ballistic_limit.powi(2)).max(0.0);
    case.mass / (case.mass + case.plug_mass()) * excess.sqrt()
}

/// Ranges of the models of plugs.
pub(super) const PLUG_RANGES: &[Range] = &[
    Range::RIGID_AGAINST_PLATE,
    Range {
        measure: Measure::ThicknessToDiameter,
        min: 0.0,
        max: THICKEST_PLUG,
        outside: Outside::NotApplicable,
        because: "a thicker plate is indented before a plug can move",
    },
    Range {
        measure: Measure::ThicknessToDiameter,
        min: 0.1,
        max: THIN,
        outside: Outside::Warning,
        because: "plugging is favoured below √3/2 of a diameter; a plate much thinner than the projectile bends instead",
    },
];

impl Model for Plugging {
    fn name(&self) -> &'static str {
        "plugging"
    }

    fn summary(&self) -> &'static str {
        "plates struck by blunt projectiles: criterion of plugging, work to shear a plug, energy and momentum of the plug"
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
                    "normal impact; the whole thickness shears along the rim at a constant stress",
                    "bending of the plate, indentation, rate and heat are left out: see the validation report for how far measured limits lie off",
                ],
                ..ValidityDomain::OPEN
            }
        }
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        ballistic_limit(scenario)
            .is_none()
            .then(|| Refusal::new(PLATE_NEVER_FLOWS).with_remedy("give `plugging.shear_strength`"))
    }

    fn run(&self, scenario: &Scenario, _: &mut Control<'_>) -> Result<RunResult, Error> {
        let inputs =
            PlateImpact::of(scenario).and_then(|case| Some((strength_of(scenario, &case)?, case)));
        let Some((strength, case)) = inputs else {
            return Err(refuse(
                self.name(),
                "it takes one plate of a metal that flows",
            ));
        };
        let work = shear_work(&case, strength);
        let limit = limit_of_work(&case, work);
        let residual = residual_with_plug(&case, limit);
        let mut result = plate_result(self.name(), "plug", case.speed, limit, residual);
        if case.speed <= limit {
            // What is left of the energy after the capture has sheared this far: h s − s²/2 is its part of h²/2.
            let part = (case.speed / limit).powi(2);
            result.depth_of_penetration = Some(case.thickness * (1.0 - (1.0 - part).sqrt()));
        }
        if scenario.options.plugging.shear_strength.is_none() {
            let law = case.plate.strength.law();
            let at = |stress: Option<f64>| {
                stress.map(|s| limit_of_work(&case, shear_work(&case, s / 3.0_f64.sqrt())))
            };
            let low = at(law.initial_yield_stress(case.plate));
            let high = at(law.flow_stress_at_unit_strain(case.plate));
            result.band = low.zip(high).map(|(low, high)| Band {
                quantity: BandQuantity::BallisticLimit,
                low: low.min(limit),
                high: high.max(limit),
                basis: "shear at the yield stress, and at the flow stress of unit strain",
            });
            result.warnings.push(
                "shear strength taken as the plate's tensile strength over √3; `plugging.shear_strength` sets another"
                    .to_owned(),
            );
        }
        let ratio = case.thickness_to_diameter();
        result.details = vec![
            Detail::new("shear strength", "MPa", strength * 1e-6),
            Detail::new("work to shear the plug", "J", work),
            Detail::new("mass of the plug", "g", case.plug_mass() * 1e3),
            Detail::new(
                "thickness over the limit of plugging",
                "",
                ratio / (3.0_f64.sqrt() / 2.0),
            ),
        ];
        result.warnings.extend(taken_as_rigid(scenario));
        Ok(result)
    }
}
