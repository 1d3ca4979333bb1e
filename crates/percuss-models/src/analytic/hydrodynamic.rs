//! Model `hydrodynamic`: the depth that a rod without strength makes in a target without strength.

use super::{
    deep_penetration::NOT_ONE_TARGET,
    long_rod::{LongRod, at_rest},
};
use crate::{
    Error, Refusal, Scenario,
    outcome::{BandQuantity, Detail, Outcome, RunResult, Termination},
    regime::{ProjectileRegime, TargetKind},
    solver::{Control, Model},
    validity::{Measure, Outside, Range, ValidityDomain},
};

/// The hydrodynamic limit `P = L √(ρ_p/ρ_t)`.
///
/// Two incompressible jets that meet have equal stagnation pressures, `½ρ_p(V − U)² = ½ρ_t U²`, and the rod lasts `L/(V − U)`
/// \[birkhoff1948\].
#[derive(Debug, Clone, Copy)]
pub struct Hydrodynamic;

impl Model for Hydrodynamic {
    fn name(&self) -> &'static str {
        "hydrodynamic"
    }

    fn summary(&self) -> &'static str {
        "hydrodynamic limit: a rod and a target without strength"
    }

    fn validity(&self) -> &'static ValidityDomain {
        const {
            &ValidityDomain {
                predicts: &[BandQuantity::DepthOfPenetration],
                projectile: &[ProjectileRegime::Eroding],
                targets: TargetKind::DEEP,
                ranges: &[
                    Range::STEADY_FLOW,
                    Range {
                        measure: Measure::ImpactSpeed,
                        min: 3000.0,
                        max: f64::INFINITY,
                        outside: Outside::Warning,
                        because: "strength is not small against the pressure at the tip: the limit is not reached",
                    },
                ],
                sees_back_face: false,
                notes: &[
                    "the limit that the models with strength tend to at high speed; it is independent of the impact velocity",
                ],
                ..ValidityDomain::OPEN
            }
        }
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        LongRod::of(scenario)
            .is_none()
            .then(|| NOT_ONE_TARGET.into())
    }

    fn run(&self, scenario: &Scenario, _: &mut Control<'_>) -> Result<RunResult, Error> {
        let rod = LongRod::of(scenario)
            .ok_or_else(|| Error::not_applicable(self.name(), NOT_ONE_TARGET))?;
        let (projectile, target) = rod.densities();
        let ratio = (projectile / target).sqrt();
        if rod.speed == 0.0 {
            return Ok(at_rest(self.name(), "", &rod, (0.0, rod.length)));
        }
        let speed = rod.speed * ratio / (1.0 + ratio);
        let mut result = RunResult::new(
            self.name(),
            "",
            Outcome::ProjectileEroded,
            Termination::ClosedForm,
        );
        result.depth_of_penetration = Some(rod.length * ratio);
        result.residual_velocity = Some(0.0);
        result.projectile_final_length = Some(0.0);
        result.projectile_final_mass = Some(0.0);
        result.time_to_rest = Some(rod.length / (rod.speed - speed));
        result.end_time = result.time_to_rest;
        result.details = vec![
            Detail::new("steady P/L", "", ratio),
            Detail::new("penetration speed U", "m/s", speed),
        ];
        Ok(result)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case;

    #[test]
    fn depth_and_time_are_those_of_two_jets() {
        let scenario = case::load_str(
            "jet",
            r#"
            projectile = { material = "a", length = "100 mm", diameter = "5 mm", impact_velocity = "6 km/s" }
            target = { material = "b", thickness = "semi-infinite" }
            [materials.a]
            name = "a"
            density = "8000 kg/m3"
            youngs_modulus = "200 GPa"
            poissons_ratio = 0.3
            strength.perfectly_plastic = { flow_stress = "500 MPa" }
            [materials.b]
            name = "b"
            density = "2000 kg/m3"
            youngs_modulus = "70 GPa"
            poissons_ratio = 0.3
            strength.perfectly_plastic = { flow_stress = "300 MPa" }
            "#,
        )
        .unwrap();
        let result = Hydrodynamic
            .run(&scenario, &mut Control::default())
            .unwrap();
        assert!((result.depth_of_penetration.unwrap() - 0.2).abs() < 1e-12);
        // U = 2/3 V, so that the depth is U times the time.
        assert!((result.time_to_rest.unwrap() - 0.2 / 4000.0).abs() < 1e-15);
    }
}
