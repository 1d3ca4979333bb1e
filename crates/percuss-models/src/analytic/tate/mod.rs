//! Model `tate`: the long rod of Alekseevskii and Tate, eroding, rigid or stopped at the face.

mod equations;
#[cfg(test)]
mod exact;

use std::borrow::Cow;

pub use equations::{Phase, Rods, Stop};

use super::{
    deep_penetration::{NOT_ONE_TARGET, never_yields},
    long_rod::{LongRod, at_rest, rests_on, sharp_and_rigid, strength},
};
use crate::{
    Error, Refusal, Scenario,
    material::{Material, MaterialClass, cavity_expansion_pressure},
    outcome::{Band, BandQuantity, Detail, RunResult},
    regime::{ProjectileRegime, STRENGTH_STRAIN, TargetKind},
    solver::{Control, Model},
    units::Pressure,
    validity::{FirstChoice, Measure, NoseKind, Outside, Range, ValidityDomain},
};

/// The long rod of Alekseevskii and Tate.
#[derive(Debug, Clone, Copy)]
pub struct Tate;

/// Range of length to diameter of a long rod, and of speeds, shared by the models of eroding rods.
pub(super) const LONG_ROD: &[Range] = &[
    Range::STEADY_FLOW,
    Range {
        measure: Measure::FlatRodLengthToDiameter,
        min: 10.0,
        max: f64::INFINITY,
        outside: Outside::Warning,
        because: "entry and the last diameters of a shorter rod add depth that steady flow does not give",
    },
    Range {
        measure: Measure::ImpactSpeed,
        min: 0.0,
        max: 5000.0,
        outside: Outside::Warning,
        because: "compressibility and melting are left out",
    },
];

impl Tate {
    /// The rod and target of a case.
    ///
    /// # Errors
    /// What is missing.
    pub fn rods(scenario: &Scenario) -> Result<Rods, Refusal> {
        let rod = LongRod::of(scenario).ok_or(NOT_ONE_TARGET)?;
        let options = &scenario.options.tate;
        let resistance = options
            .target_resistance
            .map(Pressure::si)
            .or_else(|| cavity_expansion_pressure(rod.target))
            .ok_or_else(|| never_yields(Some("`tate.target_resistance`")))?;
        let (projectile_density, target_density) = rod.densities();
        Ok(Rods {
            projectile_density,
            target_density,
            projectile_strength: strength(
                options.projectile_strength,
                rod.projectile,
                "projectile",
                "tate.projectile_strength",
            )?,
            target_resistance: resistance,
        })
    }
}

/// Factor on the static yield stress of a rod in Tate's estimate of Y.
const DYNAMIC_FACTOR: f64 = 1.7;

/// Tate's estimate of the strength of a rod from its yield stress, `Y = 1.7 σ_y` \[tate1986\] [Pa].
fn estimated_strength(material: &Material) -> Option<f64> {
    let yield_stress = material.strength.law().initial_yield_stress(material)?;
    Some(DYNAMIC_FACTOR * yield_stress)
}

/// Tate's estimate of the resistance of a target, `R = σ [2/3 + ln(0.57 E/σ)]` \[tate1986\], with the flow stress at a
/// plastic strain of 0.1 for σ [Pa].
fn estimated_resistance(material: &Material) -> Option<f64> {
    let flow_stress = material.flow_stress(STRENGTH_STRAIN)?;
    let ratio = 0.57 * material.youngs_modulus.si() / flow_stress;
    Some(flow_stress * (2.0 / 3.0 + ratio.ln()))
}

/// The range of depths [m] over the other ways to estimate what a case does not give.
fn band(
    scenario: &Scenario,
    rod: &LongRod<'_>,
    rods: Rods,
    depth: f64,
) -> Result<Option<Band>, Error> {
    let options = &scenario.options.tate;
    let mut strengths = vec![rods.projectile_strength];
    let mut resistances = vec![rods.target_resistance];
    if options.projectile_strength.is_none() {
        strengths.extend(estimated_strength(rod.projectile));
    }
    if options.target_resistance.is_none() {
        resistances.extend(estimated_resistance(rod.target).filter(|resistance| *resistance > 0.0));
    }
    let (mut low, mut high) = (depth, depth);
    for &projectile_strength in &strengths {
        for &target_resistance in &resistances {
            let other = Rods {
                projectile_strength,
                target_resistance,
                ..rods
            };
            let depth = other.penetrate(rod.speed, rod.length)?.depth;
            low = low.min(depth);
            high = high.max(depth);
        }
    }
    Ok((low < high).then_some(Band {
        quantity: BandQuantity::DepthOfPenetration,
        low: low * 1e3,
        high: high * 1e3,
        basis: "Y as the flow stress at a plastic strain of 0.1 or as 1.7 times the yield stress, R from cavity expansion or \
                from Tate's estimate",
    }))
}

impl Model for Tate {
    fn name(&self) -> &'static str {
        "tate"
    }

    fn label(&self) -> Cow<'static, str> {
        Cow::Borrowed("Alekseevskii–Tate")
    }

    fn summary(&self) -> &'static str {
        "long rod of Alekseevskii and Tate: steady flow at the tip, eroding or rigid"
    }

    fn validity(&self) -> &'static ValidityDomain {
        const {
            &ValidityDomain {
                predicts: &[
                    BandQuantity::DepthOfPenetration,
                    BandQuantity::ProjectileFinalLength,
                ],
                projectile: &[ProjectileRegime::Eroding, ProjectileRegime::Rigid],
                targets: TargetKind::DEEP,
                ranges: LONG_ROD,
                sees_back_face: false,
                first_choice: &[FirstChoice {
                    projectile: ProjectileRegime::Eroding,
                    targets: TargetKind::DEEP,
                    noses: NoseKind::ALL,
                    target_material: MaterialClass::Metal,
                    because: "it is the balance of pressures at the tip of a long eroding rod, and nothing in it is fitted here",
                }],
                notes: &[
                    "normal impact; the shape of the nose is left out: a rod with a nose counts as the flat-ended one of its mass",
                    "entry, the flow that goes on after the rod is used up, and compressibility are left out",
                ],
                ..ValidityDomain::OPEN
            }
        }
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        sharp_and_rigid(scenario).or_else(|| Self::rods(scenario).err())
    }

    fn run(&self, scenario: &Scenario, _: &mut Control<'_>) -> Result<RunResult, Error> {
        let refuse = |refusal: Refusal| Error::not_applicable(self.name(), refusal);
        let rods = Self::rods(scenario).map_err(refuse)?;
        let rod = LongRod::of(scenario).ok_or_else(|| refuse(NOT_ONE_TARGET.into()))?;
        let stop = rods.penetrate(rod.speed, rod.length)?;
        let reached = (stop.depth, stop.length);
        let mut result = at_rest(self.name(), "alekseevskii-tate", &rod, reached);
        rod.set_final(scenario, stop.length, &mut result);
        // A rod that is weaker than the target goes on flattening at its face: what is left of that takes no part in the depth,
        // and its time is not followed.
        let flattens = rods.target_resistance > rods.projectile_strength
            && rod.speed > 0.0
            && stop.length > 0.0;
        result.time_to_rest = (!flattens).then_some(stop.time);
        result.end_time = result.time_to_rest;
        result.band = band(scenario, &rod, rods, stop.depth)?;
        result.details = vec![
            Detail::new(
                "projectile strength Y",
                "MPa",
                rods.projectile_strength * 1e-6,
            ),
            Detail::new("target resistance R", "MPa", rods.target_resistance * 1e-6),
            Detail::new("threshold speed", "m/s", rods.threshold()),
            Detail::new(
                "hydrodynamic P/L",
                "",
                (rods.projectile_density / rods.target_density).sqrt(),
            ),
            Detail::new("depth made rigid", "mm", stop.rigid_depth * 1e3),
            Detail::new(
                "tail speed at the end of erosion",
                "m/s",
                stop.hand_over_speed,
            ),
        ];
        if rods.phase(rod.speed) == Phase::Eroding {
            let speed = rods.penetration_speed(rod.speed);
            result.details.extend([
                Detail::new("initial penetration speed U", "m/s", speed),
                Detail::new("steady P/L", "", speed / rods.erosion_speed(rod.speed)),
            ]);
        }
        let options = &scenario.options.tate;
        let estimated = match (options.projectile_strength, options.target_resistance) {
            (None, None) => {
                "estimated from the strength laws: `tate.projectile_strength` and `tate.target_resistance` replace them"
            }
            (None, Some(_)) => {
                "the first estimated from the strength law: `tate.projectile_strength` replaces it"
            }
            (Some(_), None) => {
                "the second estimated from the strength law: `tate.target_resistance` replaces it"
            }
            (Some(_), Some(_)) => "both given",
        };
        result.warnings.push(rests_on(
            rods.projectile_strength,
            rods.target_resistance,
            estimated,
        ));
        if rods.phase(rod.speed) == Phase::Flattening && rod.speed > 0.0 {
            result.warnings.push(
                "the rod is too slow for its strength to penetrate: it erodes on the face of the target".to_owned(),
            );
        }
        Ok(result)
    }
}
