//! Model `power_balance`: perforation of plates by an upper bound of the power, with the fields' parameters minimised at each step.

mod bulge;
pub(super) mod fields;
mod flow;
mod forces;
mod history;
mod links;
mod motion;
#[cfg(test)]
mod tests;

use std::{cell::RefCell, collections::VecDeque};

use self::{
    fields::HoleStress,
    flow::Flow,
    motion::{Impact, Keep, Perforation},
};
use super::{
    plate_cavity::PLATES,
    plate_impact::{PLATE_NEVER_FLOWS, PlateImpact, plate_result, refuse, taken_as_rigid},
};
use crate::{
    Error, Refusal, Scenario,
    material::{
        Material, MaterialClass, cavity_expansion_pressure, cylindrical_cavity_pressure,
        tensile_strength,
    },
    options::PowerBalanceOptions,
    outcome::{BandQuantity, Detail, Outcome, RunResult, Termination},
    problem::Nose,
    regime::{ProjectileRegime, TargetKind},
    shapes::Shapes,
    solver::{Control, Model},
    validity::{FirstChoice, FittedTo, Measure, NoseKind, Outside, Range, ValidityDomain},
};

/// Perforation by a balance of power over velocity fields.
#[derive(Debug, Clone, Copy)]
pub struct PowerBalance;

/// Ranges of strength and of thickness for which the fields are made.
const RANGES: &[Range] = &[
    Range::RIGID_AGAINST_PLATE,
    Range {
        measure: Measure::ThicknessToDiameter,
        min: 0.05,
        max: 3.0,
        outside: Outside::NotApplicable,
        because: "a thinner plate tears as a membrane; in a thicker one the projectile does not feel both faces",
    },
    Range {
        measure: Measure::ThicknessToDiameter,
        min: 0.2,
        max: 2.0,
        outside: Outside::Warning,
        because: "the fields are those of plates between a membrane and a thick body",
    },
];

/// Those of noses other than flat. Below, limits do not fall with the thickness: a quarter of a plate had the limit of the whole, and a plate of
/// 0.2 diameters twice that of `axi`. Far above a limit, residual velocities of plates of 0.25 diameters are within 14 % of `axi`.
const RANGES_UNDER_A_NOSE: &[Range] = &[
    Range::RIGID_AGAINST_PLATE,
    Range {
        measure: Measure::ThicknessToDiameter,
        min: 0.25,
        max: 3.0,
        outside: Outside::NotApplicable,
        because: "a thinner plate stretches under a round or pointed nose until it tears; in a thicker one the projectile does not feel both faces",
    },
    Range {
        measure: Measure::ThicknessToDiameter,
        min: 0.6,
        max: 2.0,
        outside: Outside::Warning,
        because: "a thinner plate stretches under a round or pointed nose until it tears, which is left out: its limit is too high, and may fall with thickness",
    },
];

/// Deflection in thicknesses below which a plate counts as flat.
const NO_BULGE: f64 = 1e-3;

/// Plates under blunt noses: of the models compared with their published limits, this one errs least.
const BLUNT: FirstChoice = FirstChoice {
    projectile: ProjectileRegime::Rigid,
    targets: &[TargetKind::ThinPlate, TargetKind::Plate],
    noses: &[NoseKind::Flat],
    target_material: MaterialClass::Metal,
    because: "it follows a blunt projectile from sinking in to the exit of the plug, and no constant is fitted",
};

/// Where the model applies under flat ends.
const UNDER_FLAT_ENDS: ValidityDomain = ValidityDomain {
    predicts: &[BandQuantity::BallisticLimit, BandQuantity::ResidualVelocity],
    projectile: &[ProjectileRegime::Rigid, ProjectileRegime::Deforming],
    targets: TargetKind::PLATES,
    noses: NoseKind::ALL,
    ranges: RANGES,
    first_choice: &[
        BLUNT,
        FirstChoice {
            projectile: ProjectileRegime::Deforming,
            ..BLUNT
        },
    ],
    fitted_to: &[
        FittedTo {
            sources: &["borvik2002a"],
            because: "the rules that the band of a plug keeps its width, and that no damage of its record ends it, were found on this limit; no number was fitted",
        },
        FittedTo {
            sources: PLATES,
            because: "elastic bending and softening by heat were derived with errors at limits of the REL V50 database in view; no number was fitted",
        },
    ],
    notes: &[
        "normal impact; the plate has no edge, and bends elastically, without reflections, by up to its thickness",
        "hardening laws without temperature soften by heat, by the melting heat of such metals where the record has none",
        "a pointed or round nose opens a hole; it neither tears petals nor shears a plug: refused below 0.25 diameters, a warning below 0.5",
    ],
    ..ValidityDomain::OPEN
};

fn impact(scenario: &Scenario, case: &PlateImpact<'_>) -> Option<Impact> {
    let options = &scenario.options.power_balance;
    let plate = case.plate;
    let nominal_rate = order_of_limit(case)? / case.diameter;
    let flow = Flow::new(plate, options, nominal_rate);
    Some(Impact {
        mass: case.mass,
        diameter: case.diameter,
        nose: scenario.projectile.nose,
        thickness: case.thickness,
        density: plate.density.si(),
        impedance: flexural_impedance(plate, case.thickness),
        hole_stress: HoleStress::new(&flow, nominal_rate),
        flow,
        cavity_pressures: [
            cavity_expansion_pressure(plate)?,
            cylindrical_cavity_pressure(plate)?,
        ],
        indentation: options.indentation(),
        bulging: options.bulging(),
    })
}

/// `8 √(ρ h D)`, `D = E h³/12(1 − ν²)`: force over velocity at the middle of an infinite elastic plate [N s/m] \[zener1941\].
fn flexural_impedance(plate: &Material, thickness: f64) -> f64 {
    let modulus = plate.youngs_modulus.si() / (1.0 - plate.poissons_ratio.powi(2));
    let stiffness = modulus * thickness.powi(3) / 12.0;
    8.0 * (plate.density.si() * thickness * stiffness).sqrt()
}

/// A speed of the order of the ballistic limit [m/s]: that of the work of the plate's strength over the hole; `None` for a plate that never flows.
fn order_of_limit(case: &PlateImpact<'_>) -> Option<f64> {
    let work = tensile_strength(case.plate)? * case.area() * case.thickness;
    Some((2.0 * work / case.mass).sqrt())
}

/// What a ballistic limit depends on.
#[derive(Debug, Clone, PartialEq)]
struct LimitCase {
    plate: Material,
    thickness: f64,
    mass: f64,
    diameter: f64,
    nose: Nose,
    options: PowerBalanceOptions,
}

/// Ballistic limits that are remembered.
const MOST_KNOWN: usize = 8;

thread_local! {
    /// The last ballistic limits [m/s], the latest first.
    static KNOWN: RefCell<VecDeque<(LimitCase, f64)>> = const { RefCell::new(VecDeque::new()) };
}

/// Ballistic limit [m/s], remembered: it is the same at every impact velocity, and takes as long as a dozen runs.
fn ballistic_limit(scenario: &Scenario, case: &PlateImpact<'_>, impact: &Impact) -> f64 {
    let of = LimitCase {
        plate: case.plate.clone(),
        thickness: case.thickness,
        mass: case.mass,
        diameter: case.diameter,
        nose: scenario.projectile.nose,
        options: scenario.options.power_balance.clone(),
    };
    KNOWN.with_borrow_mut(|known| {
        if let Some((_, limit)) = known.iter().find(|(other, _)| *other == of) {
            return *limit;
        }
        let limit = impact.ballistic_limit(order_of_limit(case).unwrap_or(case.speed));
        known.push_front((of, limit));
        known.truncate(MOST_KNOWN);
        limit
    })
}

impl Model for PowerBalance {
    fn name(&self) -> &'static str {
        "power_balance"
    }

    fn summary(&self) -> &'static str {
        "perforation of plates by rigid projectiles of any nose: sinking in, dishing, slip of a plug, by least power in each step"
    }

    fn validity(&self) -> &'static ValidityDomain {
        const { &UNDER_FLAT_ENDS }
    }

    fn validity_for(&self, scenario: &Scenario) -> &'static ValidityDomain {
        match scenario.projectile.nose {
            Nose::Flat => self.validity(),
            _ => {
                const {
                    &ValidityDomain {
                        ranges: RANGES_UNDER_A_NOSE,
                        ..UNDER_FLAT_ENDS
                    }
                }
            }
        }
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        let case = PlateImpact::of(scenario)?;
        tensile_strength(case.plate).is_none().then(|| {
            Refusal::new(PLATE_NEVER_FLOWS).with_remedy("give the plate a strength law that flows")
        })
    }

    fn run(&self, scenario: &Scenario, control: &mut Control<'_>) -> Result<RunResult, Error> {
        let built =
            PlateImpact::of(scenario).and_then(|case| Some((impact(scenario, &case)?, case)));
        let Some((impact, case)) = built else {
            let reason = "it takes one plate of a metal that flows";
            return Err(refuse(self.name(), reason));
        };
        let limit = ballistic_limit(scenario, &case, &impact);
        let mut result = plate_result(self.name(), "least power", case.speed, limit, 0.0);
        if case.speed > 0.0 {
            let keep = match control.record {
                true => Keep::Moments,
                false => Keep::Shape,
            };
            let run = impact.case(case.speed, keep);
            describe(&mut result, &impact, &run);
            if control.record {
                result.history = Some(history::of(
                    &impact,
                    &run,
                    case.speed,
                    scenario.projectile.length,
                ));
            }
        } else {
            result.depth_of_penetration = Some(0.0);
        }
        result.warnings.extend(taken_as_rigid(scenario));
        if !impact.indentation && scenario.projectile.nose != Nose::Flat {
            result.warnings.push(
                "`power_balance.indentation` has no effect: it is that of a flat face".to_owned(),
            );
        }
        Ok(result)
    }
}

/// Writes what a run found into the result.
fn describe(result: &mut RunResult, impact: &Impact, run: &Perforation) {
    let last = &run.last;
    (result.outcome, result.termination) = match run.perforated {
        true => (Outcome::Perforated, Termination::LeftTarget),
        false => (Outcome::AtRest, Termination::PenetrationStopped),
    };
    result.residual_velocity = Some(if run.perforated {
        last.velocities[0]
    } else {
        0.0
    });
    result.peak_force = Some(run.peak_force);
    result.end_time = Some(last.time);
    // Of a perforated plate, once it has come to rest.
    let bulge = run.bulge.depth();
    result.details = vec![
        Detail::new("sunk into the plate", "mm", last.sunk * 1e3),
        Detail::new("deflection of the plate at the rim", "mm", bulge * 1e3),
        Detail::new("elastic deflection", "mm", last.flexure * 1e3),
    ];
    if bulge > NO_BULGE * impact.thickness {
        let half = run.bulge.half_radius().map(|radius| {
            let name = "radius at half the deflection of the rim";
            Detail::new(name, "mm", radius * 1e3)
        });
        result.details.extend(half);
        result.shapes = Some(Shapes {
            crater: run.bulge.rings.clone(),
            projectile: Vec::new(),
        });
    }
    if impact.nose == Nose::Flat {
        result.details.extend([
            Detail::new("mass of the plug", "g", impact.plug_mass(last) * 1e3),
            Detail::new("slip of the plug", "mm", last.slip * 1e3),
            Detail::new("width of the band at the rim", "mm", last.rim.width * 1e3),
            Detail::new("work at the rim", "J", last.rim_work),
        ]);
    }
    result.details.extend([
        Detail::new("work of the local field", "J", last.local_work),
        Detail::new("work of bending and stretching", "J", last.dish_work),
        Detail::new("energy of elastic waves", "J", last.wave_work),
        Detail::new("energy of displaced metal", "J", last.displaced),
        Detail::new("energy lost where bodies join", "J", last.capture),
    ]);
    let names = ["plate bulges from", "plug slips from"];
    for (name, time) in names.into_iter().zip(run.stages) {
        if let Some(time) = time {
            result.details.push(Detail::new(name, "us", time * 1e6));
        }
    }
    if run.perforated {
        if impact.flat() {
            let plug = last.velocities[1];
            result
                .details
                .push(Detail::new("velocity of the plug", "m/s", plug));
        }
        result
            .details
            .push(Detail::new("contact time", "us", last.time * 1e6));
    } else {
        result.depth_of_penetration = Some(last.sunk + last.slip + bulge);
        result.time_to_rest = Some(last.time);
    }
}
