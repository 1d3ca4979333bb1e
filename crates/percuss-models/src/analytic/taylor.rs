//! Model `taylor`: a rigid, perfectly plastic rod on a rigid wall, shortened by a plastic front that moves.

use std::borrow::Cow;

use super::{
    deep_penetration::termination,
    dynamic_yield::{DynamicYield, Shortening, dynamic_yield},
    gauss::integral,
};
use crate::{
    Error, Refusal, Scenario,
    bisection::bisect_ratio,
    outcome::{BandQuantity, Detail, Outcome, RunResult},
    regime::{ProjectileRegime, TargetKind, struck_end_strain},
    solver::{Control, Model},
    validity::{Measure, NoseKind, Outside, Range, ValidityDomain},
};

/// Panels of the deformed part; the integrand falls by less than e² over one.
const PANELS: u32 = 24;
const BISECTIONS: u32 = 100;

/// A rod after its impact on a wall; lengths over the initial length.
///
/// Momentum and mass across the front give `ρv²/Y = e²/(1 − e)`, `e = 1 − A₀/A`; the rear shortens by `dh = h d(ρv²/Y)/(2e)`. Hence
/// `ln(1/h²) = 1/(1 − e) − 1 − ln(1 − e)` in closed form, and the deformed part is `∫ (1 − e) dh` \[taylor1948\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TaylorRod {
    /// `1 − A₀/A` at the struck end.
    pub strain: f64,
    /// Length of the rear that the front has not reached.
    pub rear: f64,
    /// Final length.
    pub length: f64,
}

impl TaylorRod {
    /// The rod for `ρV²/Y`.
    pub fn new(number: f64) -> Self {
        if number <= 0.0 {
            return Self {
                strain: 0.0,
                rear: 1.0,
                length: 1.0,
            };
        }
        let strain = struck_end_strain(number);
        // 1 − e without the loss of digits where e is near 1.
        let left = strain * strain / number;
        let whole = 1.0 / left - 1.0 - left.ln();
        // In u = ln(1 − e): ∫ (1 − e) dh = ∫ h (2 − e)/2 du from u(V) to 0.
        let from = left.ln();
        // A fast rod has all of its deformed part near u(V): the integrand falls by e^−40 over `(1 − e^−x)/left + x = 80`.
        let span = if 80.0 * left < 1.0 {
            (-(-80.0 * left).ln_1p()).min(-from)
        } else {
            -from
        };
        let integrand = |u: f64| {
            let left = u.exp();
            (-(whole - (1.0 / left - 1.0 - u)) / 2.0).exp() * (1.0 + left) / 2.0
        };
        let deformed = integral(from, from + span, PANELS, integrand);
        let rear = (-whole / 2.0).exp();
        Self {
            strain,
            rear,
            length: rear + deformed,
        }
    }

    fn shortening(&self) -> Shortening {
        let deformed = self.length - self.rear;
        let strain = if deformed > 0.0 {
            ((1.0 - self.rear) / deformed).ln().max(0.0)
        } else {
            0.0
        };
        Shortening {
            length: self.length,
            strain,
        }
    }
}

/// Dynamic yield stress [Pa] of a rod from its density [kg/m3], impact velocity [m/s] and final over initial length, by
/// [`TaylorRod`]; `None` unless the length is between 0 and 1 and the speed above 0.
pub fn taylor_yield_stress(density: f64, speed: f64, length_ratio: f64) -> Option<f64> {
    let valid = length_ratio > 0.0 && length_ratio < 1.0 && speed > 0.0 && density > 0.0;
    if !valid {
        return None;
    }
    let (low, high) = (1e-9, 1e3);
    if TaylorRod::new(low).length < length_ratio || TaylorRod::new(high).length > length_ratio {
        return None;
    }
    let is_longer = |number: f64| TaylorRod::new(number).length > length_ratio;
    let (low, high) = bisect_ratio(low, high, BISECTIONS, is_longer);
    Some(density * speed * speed / (low * high).sqrt())
}

/// G. I. Taylor's rod on a wall \[taylor1948\].
#[derive(Debug, Clone, Copy)]
pub struct Taylor;

impl Model for Taylor {
    fn name(&self) -> &'static str {
        "taylor"
    }

    fn label(&self) -> Cow<'static, str> {
        Cow::Borrowed("Taylor")
    }

    fn summary(&self) -> &'static str {
        "final length of a rigid-plastic rod on a rigid wall, moving plastic front"
    }

    fn validity(&self) -> &'static ValidityDomain {
        WALL
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        self.yield_stress(scenario).err()
    }

    fn run(&self, scenario: &Scenario, _: &mut Control<'_>) -> Result<RunResult, Error> {
        let dynamic = self
            .yield_stress(scenario)
            .map_err(|refusal| Error::not_applicable(self.name(), refusal))?;
        let rod = &scenario.projectile;
        let number = rod.material.density.si() * scenario.impact_velocity.powi(2) / dynamic.stress;
        let shape = TaylorRod::new(number);
        let mut result = on_wall(
            self.name(),
            "moving-front",
            scenario,
            &dynamic,
            shape.length,
        );
        if result.projectile_final_length != Some(rod.length) {
            result.projectile_final_diameter = Some(rod.diameter / (1.0 - shape.strain).sqrt());
            result.details.push(Detail::new(
                "undeformed rear",
                "mm",
                shape.rear * rod.length * 1e3,
            ));
        }
        Ok(result)
    }
}

impl Taylor {
    fn yield_stress(self, scenario: &Scenario) -> Result<DynamicYield, Refusal> {
        let given = scenario.options.taylor.dynamic_yield_stress;
        dynamic_yield(scenario, given, self.name(), |number| {
            TaylorRod::new(number).shortening()
        })
    }
}

/// The regime of both models of a rod on a wall.
pub(super) const WALL: &ValidityDomain = &ValidityDomain {
    predicts: &[BandQuantity::ProjectileFinalLength],
    projectile: &[ProjectileRegime::Rigid, ProjectileRegime::Deforming],
    targets: &[TargetKind::RigidWall],
    noses: &[NoseKind::Flat],
    ranges: &[Range {
        measure: Measure::LengthToDiameter,
        min: 2.0,
        max: f64::INFINITY,
        outside: Outside::Warning,
        because: "the theory has no lateral inertia: the rod must be longer than its spreading end",
    }],
    notes: &[
        "rigid, perfectly plastic rod: one flow stress stands for the strength law",
        "below the impact velocity at which an elastic wave reaches the yield stress the rod keeps its length",
    ],
    ..ValidityDomain::OPEN
};

/// The result of a rod that ends with a part of its length on a wall.
pub(super) fn on_wall(
    model: &'static str,
    scheme: &'static str,
    scenario: &Scenario,
    dynamic: &DynamicYield,
    length_ratio: f64,
) -> RunResult {
    let rod = &scenario.projectile;
    let impedance = rod.material.density.si() * rod.material.bar_wave_speed();
    let yields = impedance * scenario.impact_velocity > dynamic.stress;
    let mut result = {
        let mut result = RunResult::new(model, scheme, Outcome::AtRest, termination(scenario));
        result.residual_velocity = Some(0.0);
        result.projectile_final_length = Some(rod.length);
        result.projectile_final_mass = Some(rod.mass);
        result.details = vec![Detail::new(
            "dynamic yield stress",
            "MPa",
            dynamic.stress * 1e-6,
        )];
        result
    };
    if yields {
        result.projectile_final_length = Some(rod.length * length_ratio);
        result.details.extend([
            Detail::new("mean strain", "", dynamic.strain),
            Detail::new("mean strain rate", "1/s", dynamic.strain_rate),
        ]);
        result.warnings = dynamic.warnings(&rod.material);
    } else {
        result.projectile_final_diameter = Some(rod.diameter);
        if scenario.impact_velocity > 0.0 {
            result.outcome = Outcome::Rebounded;
            result.residual_velocity = Some(-scenario.impact_velocity);
            result.warnings.push(
                "an elastic wave of this speed does not reach the yield stress: the rod keeps its length and bounces".to_owned(),
            );
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_closed_form_solves_the_equations_of_the_front() {
        for number in [1e-4, 0.01, 0.3, 1.0, 4.0, 60.0, 1000.0] {
            let rod = TaylorRod::new(number);
            assert!((rod.strain.powi(2) / (1.0 - rod.strain) / number - 1.0).abs() < 1e-12);
            // d(ln h) = d(ρv²/Y)/(2e), in s = √(ρv²/Y) so that the integrand stays finite.
            let strain = |n: f64| 0.5 * (-n + (n * n + 4.0 * n).sqrt());
            let steps = 20_000;
            let step = number.sqrt() / f64::from(steps);
            let (mut rear, mut length) = (1.0_f64, 0.0);
            for i in (0..steps).rev() {
                let s = (f64::from(i) + 0.5) * step;
                let e = strain(s * s);
                let before = rear;
                rear *= (-s / e * step).exp();
                length += (before - rear) * (1.0 - e);
            }
            let error = rod.length / (rear + length) - 1.0;
            // The stepping loses digits over the many e-folds of a fast rod.
            let allowed = if number > 10.0 { 1e-4 } else { 1e-8 };
            println!(
                "ρV²/Y = {number}: Lf/L0 = {:.8}, error {error:.1e}",
                rod.length
            );
            assert!(
                error.abs() < allowed && (rod.rear / rear - 1.0).abs() < allowed,
                "{rod:?}"
            );
        }
    }

    #[test]
    fn at_low_speed_the_front_stands_still() {
        let number = 1e-6;
        let exact = -number / 2.0;
        let ratio = TaylorRod::new(number).length.ln() / exact;
        assert!((ratio - 1.0).abs() < 1e-3, "{ratio}");
        assert_eq!(TaylorRod::new(0.0).length, 1.0);
    }

    #[test]
    fn the_momentum_of_the_rod_is_the_impulse_of_the_wall() {
        // The deformed part stands still, so that the momentum is ρ h v, and the wall's pressure on the spread end is Y A:
        // d(h v)/dn against −Y/(ρ (1 − e)) dt, with dt = −ρ h dv/Y.
        let n = 1.0_f64;
        let (h, e) = (TaylorRod::new(2.0).rear, TaylorRod::new(n).strain);
        let d = 1e-6;
        let rear = |m: f64| {
            let left = 1.0 - TaylorRod::new(m).strain;
            h * ((1.0 / left - left.ln()) / 2.0).exp()
        };
        let change = rear(n + d) * (n + d).sqrt() - rear(n - d) * (n - d).sqrt();
        let impulse = rear(n) / (1.0 - e) * ((n + d).sqrt() - (n - d).sqrt());
        assert!((change / impulse - 1.0).abs() < 1e-6, "{change} {impulse}");
    }

    #[test]
    fn the_inverse_gives_the_yield_stress_back() {
        let (density, speed, yield_stress) = (8960.0, 150.0, 350e6);
        let length = TaylorRod::new(density * speed * speed / yield_stress).length;
        let found = taylor_yield_stress(density, speed, length).unwrap();
        assert!((found / yield_stress - 1.0).abs() < 1e-9, "{found}");
        assert!(taylor_yield_stress(density, speed, 1.0).is_none());
        assert!(taylor_yield_stress(density, 0.0, 0.8).is_none());
    }
}
