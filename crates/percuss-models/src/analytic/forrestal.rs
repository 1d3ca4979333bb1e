//! Model `forrestal`: a rigid rod in a thick metal target, resisted by the pressure of a spherical cavity that expands.

use std::borrow::Cow;

use super::{
    cavity_expansion::CavityExpansion,
    deep_penetration::{DeepPenetration, NEVER_YIELDS, NOT_ONE_TARGET, at_rest, never_yields},
    nose_load::NoseLoad,
    rigid_motion::{RigidMotion, Stop},
};
use crate::{
    Error, Refusal, Scenario,
    material::{MaterialClass, cavity_expansion_pressure},
    options::{Cavity, Entry, ForrestalOptions},
    outcome::{Band, BandQuantity, Detail, RunResult},
    regime::{ProjectileRegime, TargetKind},
    solver::{Control, Model},
    units::{Pressure, Velocity, significant},
    validity::{FirstChoice, Measure, NoseKind, Outside, Range, ValidityDomain},
};

/// Rigid rods in thick metal targets \[forrestal1988, forrestal1995\].
#[derive(Debug, Clone, Copy)]
pub struct Forrestal;

/// `R + b v_n²` on the nose, and what is to be said of it.
struct Resistance {
    strength: f64,
    coefficient: f64,
    warning: Option<String>,
}

impl Forrestal {
    fn resistance(case: &DeepPenetration<'_>, cavity: Cavity, steepest: f64) -> Option<Resistance> {
        match cavity {
            Cavity::Incompressible => Some(Resistance {
                strength: cavity_expansion_pressure(case.target)?,
                coefficient: 1.5,
                warning: None,
            }),
            Cavity::Compressible => {
                let speed = steepest * case.speed;
                let fit = CavityExpansion::of(case.target)?.fit(speed);
                let warning = (speed > fit.largest_speed).then(|| {
                    format!(
                        "the compressible cavity expansion has no plastic shock and ends at {}: B is fitted up to there, and the nose \
                         expands the target at up to {}",
                        rounded(fit.largest_speed),
                        rounded(speed)
                    )
                });
                Some(Resistance {
                    strength: fit.strength,
                    coefficient: fit.inertia,
                    warning: warning.filter(|_| case.speed > 0.0),
                })
            }
        }
    }

    fn stop(
        case: &DeepPenetration<'_>,
        options: &ForrestalOptions,
        resistance: &Resistance,
    ) -> Stop {
        let motion = RigidMotion {
            mass: case.rod.mass,
            nose: nose(case, options),
            strength: resistance.strength,
            inertia: resistance.coefficient * case.target.density.si(),
        };
        match options.entry() {
            Entry::Embedded => motion.embedded(case.speed),
            Entry::Gradual => motion.gradual(case.speed),
        }
    }

    /// Yield stress that `a` multiplies [Pa].
    fn yield_stress(case: &DeepPenetration<'_>, options: &ForrestalOptions) -> Option<f64> {
        let law = case.target.strength.law();
        options
            .yield_stress
            .map(Pressure::si)
            .or_else(|| law.initial_yield_stress(case.target))
    }
}

fn nose(case: &DeepPenetration<'_>, options: &ForrestalOptions) -> NoseLoad {
    NoseLoad::new(case.rod.nose, case.rod.diameter, options.friction())
}

fn rounded(speed: f64) -> Velocity {
    Velocity::new(significant(speed, 3).parse().unwrap_or(speed))
}

impl Model for Forrestal {
    fn name(&self) -> &'static str {
        "forrestal"
    }

    fn label(&self) -> Cow<'static, str> {
        Cow::Borrowed("Forrestal")
    }

    fn summary(&self) -> &'static str {
        "rigid rod in a thick metal target, resisted by spherical cavity expansion"
    }

    fn validity(&self) -> &'static ValidityDomain {
        const {
            &ValidityDomain {
                predicts: &[BandQuantity::DepthOfPenetration],
                projectile: &[ProjectileRegime::Rigid],
                targets: TargetKind::DEEP,
                ranges: &[
                    Range {
                        measure: Measure::LengthToDiameter,
                        min: 2.0,
                        max: f64::INFINITY,
                        outside: Outside::Warning,
                        because: "a short projectile spends much of its path entering, under a free surface",
                    },
                    Range::INFINITE_CAVITY,
                ],
                sees_back_face: false,
                first_choice: &[FirstChoice {
                    projectile: ProjectileRegime::Rigid,
                    targets: TargetKind::DEEP,
                    noses: NoseKind::ALL,
                    target_material: MaterialClass::Metal,
                    because: "the resistance to a rigid nose follows from the target's own strength law",
                }],
                notes: &[
                    "strength of the target slow and at room temperature; neither spall nor a free surface",
                    "frictionless unless `forrestal.friction` says otherwise",
                    "a flat end carries a cap of dead metal in truth, which makes it less blunt than the model takes it",
                ],
                ..ValidityDomain::OPEN
            }
        }
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        let Some(case) = DeepPenetration::of(scenario) else {
            return Some(NOT_ONE_TARGET.into());
        };
        let options = &scenario.options.forrestal;
        let given = options.a.is_some() && options.yield_stress.is_some();
        (cavity_expansion_pressure(case.target).is_none() && !(given && options.b.is_some())).then(
            || {
                never_yields(Some(
                    "`forrestal.a`, `forrestal.yield_stress` and `forrestal.b`",
                ))
            },
        )
    }

    fn run(&self, scenario: &Scenario, _: &mut Control<'_>) -> Result<RunResult, Error> {
        let refuse = |reason: &str| Error::not_applicable(self.name(), reason);
        let case = DeepPenetration::of(scenario).ok_or_else(|| refuse(NOT_ONE_TARGET))?;
        let options = &scenario.options.forrestal;
        let nose = nose(&case, options);
        let cavity = options.cavity();
        let given = options
            .a
            .and_then(|a| Some(a * Self::yield_stress(&case, options)?));
        let resistance = match (given, options.b) {
            (Some(strength), Some(coefficient)) => Resistance {
                strength,
                coefficient,
                warning: None,
            },
            _ => {
                let computed = Self::resistance(&case, cavity, nose.steepest())
                    .ok_or_else(|| refuse(NEVER_YIELDS))?;
                Resistance {
                    strength: given.unwrap_or(computed.strength),
                    coefficient: options.b.unwrap_or(computed.coefficient),
                    warning: computed.warning.filter(|_| options.b.is_none()),
                }
            }
        };
        let stop = Self::stop(&case, options, &resistance);
        let entry = options.entry();
        let scheme = match (given, options.b, cavity) {
            (Some(_), Some(_), _) => "given-coefficients",
            (_, _, Cavity::Incompressible) => "incompressible",
            (_, _, Cavity::Compressible) => "compressible",
        };
        let mut result = at_rest(self.name(), scheme, scenario, stop);
        let (strength_factor, inertia_factor) = nose.factors();
        result.details = vec![
            Detail::new("target resistance A Y", "MPa", resistance.strength * 1e-6),
            Detail::new("inertia coefficient B", "", resistance.coefficient),
            Detail::new("strength factor M", "", strength_factor),
            Detail::new("inertia factor N", "", inertia_factor),
        ];
        if let Some(yield_stress) = Self::yield_stress(&case, options) {
            let coefficient = resistance.strength / yield_stress;
            result
                .details
                .push(Detail::new("strength coefficient A", "", coefficient));
        }
        if given.is_none() && options.b.is_none() && case.speed > 0.0 {
            let other = match cavity {
                Cavity::Incompressible => Cavity::Compressible,
                Cavity::Compressible => Cavity::Incompressible,
            };
            result.band = Self::resistance(&case, other, nose.steepest()).map(|other| {
                let other = Self::stop(&case, options, &other).depth;
                Band {
                    quantity: BandQuantity::DepthOfPenetration,
                    low: other.min(stop.depth) * 1e3,
                    high: other.max(stop.depth) * 1e3,
                    basis: "incompressible to compressible target",
                }
            });
        }
        result.warnings.extend(resistance.warning);
        if entry == Entry::Embedded && case.speed > 0.0 && stop.depth < nose.length() {
            result.warnings.push(
                "the nose is longer than the depth and was taken to be fully embedded: entry = \"gradual\" is the better choice here"
                    .to_owned(),
            );
        }
        Ok(result)
    }
}
