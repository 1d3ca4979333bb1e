//! Model `plate_cavity`: a sharp rigid projectile opens a hole through a plate by expanding a cavity.

use super::{
    nose_shape::tip_depth,
    plate_impact::{PlateImpact, plate_result, refuse},
};
use crate::{
    Error, Refusal, Scenario,
    material::{
        Material, MaterialClass, cavity_expansion_pressure, cylindrical_cavity_pressure,
        tensile_strength,
    },
    options::{CavityShape, PlateCavityOptions},
    outcome::{Band, BandQuantity, Detail, RunResult},
    regime::{ProjectileRegime, TargetKind, nose_factor},
    solver::{Control, Model},
    units::{Pressure, significant},
    validity::{FirstChoice, FittedTo, Measure, NoseKind, Outside, Range, ValidityDomain},
};

/// Ductile hole enlargement by cavity expansion.
#[derive(Debug, Clone, Copy)]
pub struct PlateCavity;

/// Brinell hardness above which a steel plate may break the core or give a plug.
const HARD: f64 = 300.0;
/// Tensile strength of a steel of that hardness [Pa].
const HARD_STRENGTH: f64 = 1.0e9;

/// Sources of the REL V50 database, whose limits were in view when the form of the inertial pressure was chosen.
pub(super) const PLATES: &[&str] = &[
    "cheeseman2008",
    "forrestal2014",
    "forrestal2021",
    "fras2015",
    "gallardy2012",
    "gallardy2015",
    "gallardy2016",
    "gallardy2017",
    "gooch2007",
    "gooch2019",
    "grubinskas1993",
    "jones2004",
    "jones2016",
    "ryan2015",
    "ryan2016",
    "ryan2018",
    "showalter2008a",
    "showalter2008b",
];

/// Numbers of a perforation that do not depend on the impact velocity.
#[derive(Debug, Clone, Copy)]
pub(super) struct Passage {
    /// Quasi-static pressure of the cavity [Pa].
    resistance: f64,
    /// Shape factor of the inertial pressure.
    shape: f64,
    /// `2 π a² h B N ρ / m`.
    inertia: f64,
    /// Ballistic limit without inertia [m/s].
    slow_limit: f64,
}

impl Passage {
    fn new(scenario: &Scenario, case: &PlateImpact<'_>, coefficient: f64) -> Option<Self> {
        let resistance = match scenario.options.plate_cavity.cavity {
            CavityShape::Cylinder => cylindrical_cavity_pressure(case.plate)?,
            CavityShape::Sphere => cavity_expansion_pressure(case.plate)?,
        };
        let shape = nose_factor(scenario.projectile.nose);
        Some(Self {
            resistance,
            shape,
            inertia: 2.0 * case.plug_mass() * coefficient * shape / case.mass,
            slow_limit: (2.0 * resistance * case.area() * case.thickness / case.mass).sqrt(),
        })
    }

    /// With the default inertial coefficient, or the case's own.
    pub(super) fn of(scenario: &Scenario) -> Option<Self> {
        let case = PlateImpact::of(scenario)?;
        let coefficient = scenario.options.plate_cavity.inertia();
        Self::new(scenario, &case, coefficient)
    }

    /// Ballistic limit [m/s].
    pub(super) fn ballistic_limit(&self) -> f64 {
        let growth = if self.inertia > 0.0 {
            self.inertia.exp_m1() / self.inertia
        } else {
            1.0
        };
        self.slow_limit * growth.sqrt()
    }

    /// Speed behind the plate [m/s].
    fn residual(&self, speed: f64) -> f64 {
        let excess = speed * speed - self.ballistic_limit().powi(2);
        (excess.max(0.0) * (-self.inertia).exp()).sqrt()
    }

    /// Part of the hole that is opened when a projectile that does not get through has stopped.
    fn part_opened(&self, speed: f64) -> f64 {
        let slow = (speed / self.slow_limit).powi(2);
        if self.inertia > 0.0 {
            (self.inertia * slow).ln_1p() / self.inertia
        } else {
            slow
        }
    }
}

/// Ballistic limit [m/s] with the inertial coefficient `ln(2c/v) − 1/2` of a cylinder that grows at the speed v in an unbounded
/// elastic-plastic body with the dilatational wave speed c: more than a plate can offer.
fn unbounded_limit(scenario: &Scenario, case: &PlateImpact<'_>) -> Option<f64> {
    let plate = case.plate;
    let wave =
        ((plate.bulk_modulus() + 4.0 / 3.0 * plate.shear_modulus()) / plate.density.si()).sqrt();
    let mut limit = Passage::new(scenario, case, 0.0)?.slow_limit;
    for _ in 0..50 {
        let growth_speed = limit * nose_factor(scenario.projectile.nose).sqrt();
        let coefficient = ((2.0 * wave / growth_speed).ln() - 0.5).max(PlateCavityOptions::INERTIA);
        limit = Passage::new(scenario, case, coefficient)?.ballistic_limit();
    }
    Some(limit)
}

impl Model for PlateCavity {
    fn name(&self) -> &'static str {
        "plate_cavity"
    }

    fn summary(&self) -> &'static str {
        "perforation of plates by sharp rigid projectiles: ductile hole enlargement by cavity expansion"
    }

    fn validity(&self) -> &'static ValidityDomain {
        const {
            &ValidityDomain {
                predicts: &[BandQuantity::BallisticLimit, BandQuantity::ResidualVelocity],
                projectile: &[ProjectileRegime::Rigid],
                targets: TargetKind::PLATES,
                noses: NoseKind::SHARP,
                oblique_noses: NoseKind::SHARP,
                ranges: &[
                    Range {
                        measure: Measure::ThicknessToDiameter,
                        min: 0.33,
                        max: f64::INFINITY,
                        outside: Outside::NotApplicable,
                        because: "a thinner plate bends and opens in petals, which takes less work than a cavity",
                    },
                    Range {
                        measure: Measure::ThicknessToDiameter,
                        min: 0.0,
                        max: 50.0,
                        outside: Outside::NotApplicable,
                        because: "no projectile perforates a plate so thick, and the plate's inertia grows beyond all numbers",
                    },
                    Range {
                        measure: Measure::ThicknessToDiameter,
                        min: 1.0,
                        max: 10.0,
                        outside: Outside::Warning,
                        because: "a thinner plate also bends; in a thicker one the tip meets the pressure of a sphere",
                    },
                    Range {
                        measure: Measure::Obliquity,
                        min: 0.0,
                        max: 30.0,
                        outside: Outside::Warning,
                        because: "the path turns, which a straight one leaves out: at 45 deg measured limits are 17 % higher",
                    },
                    Range {
                        measure: Measure::Obliquity,
                        min: 0.0,
                        max: 60.0,
                        outside: Outside::NotApplicable,
                        because: "a projectile that strikes at a flatter angle may glance off",
                    },
                ],
                first_choice: &[FirstChoice {
                    projectile: ProjectileRegime::Rigid,
                    targets: TargetKind::PLATES,
                    noses: NoseKind::SHARP,
                    target_material: MaterialClass::Metal,
                    because: "sharp rigid projectiles open ductile plates by pushing the metal aside, and no constant is fitted",
                }],
                fitted_to: &[FittedTo {
                    sources: PLATES,
                    because: "the form of the inertial pressure, V sin θ instead of V tan θ, was chosen with limits of the REL V50 database in view",
                }],
                notes: &[
                    "no friction, no free faces, no heat; an oblique path is straight, and the hole along it is longer (reconstructed)",
                    "a plate that plugs, scabs or breaks the projectile is out of its reach",
                ],
                ..ValidityDomain::OPEN
            }
        }
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        Passage::of(scenario)
            .is_none()
            .then(|| "the plate's strength law never flows: no cavity opens in it".into())
    }

    fn run(&self, scenario: &Scenario, _: &mut Control<'_>) -> Result<RunResult, Error> {
        let (Some(case), Some(passage)) = (PlateImpact::of(scenario), Passage::of(scenario)) else {
            return Err(refuse(
                self.name(),
                "it takes one plate of a metal that flows",
            ));
        };
        let limit = passage.ballistic_limit();
        let residual = passage.residual(case.speed);
        let scheme = match scenario.options.plate_cavity.cavity {
            CavityShape::Cylinder => "cylindrical cavity",
            CavityShape::Sphere => "spherical cavity",
        };
        let mut result = plate_result(self.name(), scheme, case.speed, limit, residual);
        // Along an oblique path the tip has no depth that compares with others.
        if case.speed <= limit && scenario.obliquity == 0.0 {
            let part = passage.part_opened(case.speed).min(1.0);
            let rod = &scenario.projectile;
            let depth = if part > 0.0 {
                tip_depth(rod.nose, rod.diameter, case.thickness, part)
            } else {
                0.0
            };
            result.depth_of_penetration = Some(depth);
        }
        if scenario.options.plate_cavity == PlateCavityOptions::default() {
            result.band = unbounded_limit(scenario, &case).map(|high| Band {
                quantity: BandQuantity::BallisticLimit,
                low: passage.slow_limit,
                high,
                basis: "low: no inertia of the plate; high: the inertia of an unbounded plate",
            });
        }
        result.details = vec![
            Detail::new("resistance of the cavity", "MPa", passage.resistance * 1e-6),
            Detail::new("shape factor of the inertia", "", passage.shape),
            Detail::new("inertia number", "", passage.inertia),
            Detail::new("ballistic limit without inertia", "m/s", passage.slow_limit),
        ];
        result.warnings.extend(hard_plate(case.plate));
        Ok(result)
    }
}

/// Says that a plate is so hard that projectiles break or plates plug.
fn hard_plate(plate: &Material) -> Option<String> {
    let tail = "hard steel plates break armour-piercing cores or fail by plugging, which a cavity expansion does not model; \
                expect errors of tens of per cent";
    match (plate.brinell_hardness, tensile_strength(plate)) {
        (Some(hardness), _) if hardness > HARD => Some(format!(
            "the plate has a hardness of {} HB, more than {HARD}: {tail}",
            significant(hardness, 3)
        )),
        (None, Some(strength)) if strength > HARD_STRENGTH => Some(format!(
            "the plate has a tensile strength of {}, more than {}: {tail}",
            Pressure::new(strength),
            Pressure::new(HARD_STRENGTH)
        )),
        _ => None,
    }
}
