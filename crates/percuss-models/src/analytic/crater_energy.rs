//! Model `crater_energy`: the kinetic energy of the projectile pays for the volume of the crater.

use super::{
    deep_penetration::{DeepPenetration, NOT_ONE_TARGET, at_rest, never_yields, termination},
    nose_load::NoseLoad,
    rigid_motion::RigidMotion,
    tate::{Phase, Rods},
};
use crate::{
    Error, Refusal, Scenario,
    material::cavity_expansion_pressure,
    outcome::{BandQuantity, Detail, Outcome, RunResult},
    regime::{ProjectileRegime, Regime, STRENGTH_STRAIN, TargetKind},
    solver::{Control, Model},
    units::Pressure,
    validity::{Range, ValidityDomain},
};

/// `½ m V² = R × volume of the crater`: the class of energy balances for thick targets.
#[derive(Debug, Clone, Copy)]
pub struct CraterEnergy;

impl CraterEnergy {
    fn resistance(scenario: &Scenario) -> Result<f64, Refusal> {
        let case = DeepPenetration::of(scenario).ok_or(NOT_ONE_TARGET)?;
        scenario
            .options
            .crater_energy
            .resistance
            .map(Pressure::si)
            .or_else(|| cavity_expansion_pressure(case.target))
            .ok_or_else(|| never_yields(Some("`crater_energy.resistance`")))
    }
}

/// Speed of the bottom of a crater in steady flow [m/s]: `½ρ_p(V−U)² + Y = ½ρ_t U² + R`, between 0 and V.
fn crater_speed(rods: &Rods, speed: f64) -> f64 {
    match rods.phase(speed) {
        Phase::Eroding => rods.penetration_speed(speed),
        Phase::Rigid => speed,
        Phase::Flattening => 0.0,
    }
}

/// Area of a crater over that of the rod that flows out in it: `1 + 2ρ_p(V−U)²/R`.
///
/// The rod's section holds its own against R. In the frame of the crater's bottom the projectile comes in at V − U and is turned
/// back at the same speed, so that it pushes with `2ρ_p A (V−U)²` more; the crater is as wide as R allows under that force.
fn crater_growth(density: f64, relative_speed: f64, resistance: f64) -> f64 {
    1.0 + 2.0 * density * relative_speed * relative_speed / resistance
}

impl Model for CraterEnergy {
    fn name(&self) -> &'static str {
        "crater_energy"
    }

    fn summary(&self) -> &'static str {
        "crater volume times resistance equals the projectile's kinetic energy"
    }

    fn validity(&self) -> &'static ValidityDomain {
        const {
            &ValidityDomain {
                predicts: &[BandQuantity::DepthOfPenetration],
                targets: TargetKind::DEEP,
                ranges: &[Range::INFINITE_BODY],
                sees_back_face: false,
                notes: &[
                    "all kinetic energy goes into the crater, which has the same width at every depth",
                    "a rigid projectile leaves its own shape; the crater of one that flows grows by the thrust of the flow",
                ],
                ..ValidityDomain::OPEN
            }
        }
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        Self::resistance(scenario).err()
    }

    fn run(&self, scenario: &Scenario, _: &mut Control<'_>) -> Result<RunResult, Error> {
        let refuse = |refusal: Refusal| Error::not_applicable(self.name(), refusal);
        let resistance = Self::resistance(scenario).map_err(refuse)?;
        let case = DeepPenetration::of(scenario).ok_or_else(|| refuse(NOT_ONE_TARGET.into()))?;
        let rod = case.rod;
        let energy = 0.5 * rod.mass * case.speed * case.speed;
        let given = scenario.options.crater_energy.crater_to_projectile_diameter;
        let classified = Regime::of(scenario);
        let regime = classified.projectile;
        let strength = rod.material.flow_stress(STRENGTH_STRAIN);
        let (mut result, growth) = match (regime, given, strength) {
            (ProjectileRegime::Rigid, None, _) | (_, None, None) => {
                let motion = RigidMotion {
                    mass: rod.mass,
                    nose: NoseLoad::new(rod.nose, rod.diameter, 0.0),
                    strength: resistance,
                    inertia: 0.0,
                };
                let stop = motion.gradual(case.speed);
                (at_rest(self.name(), "rigid", scenario, stop), 1.0)
            }
            (_, given, strength) => {
                let growth = match (given, strength) {
                    (Some(ratio), _) => ratio * ratio,
                    (None, strength) => {
                        let rods = Rods {
                            projectile_density: rod.material.density.si(),
                            target_density: case.target.density.si(),
                            projectile_strength: strength.unwrap_or(f64::INFINITY),
                            target_resistance: resistance,
                        };
                        let thrust = case.speed - crater_speed(&rods, case.speed);
                        crater_growth(rods.projectile_density, thrust, resistance)
                    }
                };
                let depth = energy / (resistance * growth * rod.area());
                let scheme = if given.is_some() {
                    "given-diameter"
                } else {
                    "grown-crater"
                };
                let end = termination(scenario);
                let mut result = RunResult::new(self.name(), scheme, Outcome::AtRest, end);
                result.depth_of_penetration = Some(depth);
                result.residual_velocity = Some(0.0);
                (result, growth)
            }
        };
        result.details = vec![
            Detail::new("resistance", "MPa", resistance * 1e-6),
            Detail::new("crater diameter ratio", "", growth.sqrt()),
            Detail::new("crater volume", "cm3", energy / resistance * 1e6),
        ];
        let rigid_or_not = [regime].into_iter().chain(classified.neighbour);
        if classified.neighbour.is_some()
            && rigid_or_not
                .into_iter()
                .any(|r| r == ProjectileRegime::Rigid)
        {
            result.warnings.push(
                "whether the projectile stays rigid is uncertain here, and this model's depth jumps there: compare \
                 with the models of the other regime"
                    .to_owned(),
            );
        }
        match regime {
            ProjectileRegime::Rigid => {}
            ProjectileRegime::Deforming => result.warnings.push(
                "the projectile deforms, and the energy that its own deformation takes is not taken off; the crater is as wide as in steady flow: \
                 a narrower one is deeper"
                    .to_owned(),
            ),
            ProjectileRegime::Eroding => result.warnings.push(
                "the projectile erodes, and the kinetic energy that its debris keeps is not taken off: the depth is too large where \
                 the densities of projectile and target differ"
                    .to_owned(),
            ),
        }
        Ok(result)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hydrodynamic_limit_is_the_square_of_the_mean_of_the_density_law() {
        // P/L = ½ρV²/(R growth) → V²/(4(V−U)²) = (1+λ)²/(4λ²), λ = √(ρt/ρp): 1 for equal densities, as it must be.
        for (projectile, target) in [
            (7850.0_f64, 7850.0_f64),
            (17_300.0, 7850.0),
            (2710.0, 7850.0),
        ] {
            let (speed, resistance, strength) = (1e6, 1e9, 1e9);
            let rods = Rods {
                projectile_density: projectile,
                target_density: target,
                projectile_strength: strength,
                target_resistance: resistance,
            };
            let bottom = crater_speed(&rods, speed);
            let growth = crater_growth(projectile, speed - bottom, resistance);
            let depth = 0.5 * projectile * speed * speed / (resistance * growth);
            let lambda = (target / projectile).sqrt();
            let exact = (1.0 + lambda).powi(2) / (4.0 * lambda * lambda);
            assert!((depth / exact - 1.0).abs() < 1e-5, "{depth} {exact}");
            // The debris flies at 2U − V; less its kinetic energy the balance gives 1/λ for any densities.
            let debris = 2.0 * bottom - speed;
            let without = depth * (1.0 - (debris / speed).powi(2));
            assert!((without * lambda - 1.0).abs() < 1e-5, "{without} {lambda}");
        }
    }

    #[test]
    fn a_crater_grows_from_the_rod() {
        assert_eq!(crater_growth(7850.0, 0.0, 1e9), 1.0);
        // At the limit of rigid penetration the bottom of the crater moves with the rod.
        let limit = (2.0 * (2e9 - 1e9) / 2710.0_f64).sqrt();
        let rods = Rods {
            projectile_density: 7850.0,
            target_density: 2710.0,
            projectile_strength: 2e9,
            target_resistance: 1e9,
        };
        assert_eq!(crater_speed(&rods, 0.99 * limit), 0.99 * limit);
        let bottom = crater_speed(&rods, 1.000001 * limit);
        assert!((bottom / limit - 1.0).abs() < 1e-3);
    }
}
