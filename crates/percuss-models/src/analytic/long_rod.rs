//! Input of the models of long rods: a rod of one metal on a target of one metal.

use crate::{
    Refusal,
    error::NumericalError,
    material::Material,
    outcome::{Outcome, RunResult, Termination},
    problem::Nose,
    regime::{ProjectileRegime, Regime, STRENGTH_STRAIN},
    scenario::Scenario,
    units::{Pressure, significant},
};

use super::{deep_penetration::NOT_ONE_TARGET, ode::IntegrationError};

/// Why a model without noses does not apply to a sharp projectile that stays rigid; `None` for every other case.
pub(super) fn sharp_and_rigid(scenario: &Scenario) -> Option<Refusal> {
    let nose = scenario.projectile.nose;
    let sharp = matches!(nose, Nose::Cone { .. } | Nose::Ogive { .. });
    (sharp && Regime::of(scenario).projectile == ProjectileRegime::Rigid)
        .then(|| "it takes no account of the sharp nose of a rigid projectile".into())
}

/// Length over diameter up to which every integration ends.
const MOST_SLENDER: f64 = 10_000.0;

/// A flat-ended rod and the metal that it strikes.
#[derive(Debug, Clone, Copy)]
pub(super) struct LongRod<'a> {
    /// Length of the flat-ended rod of the same mass and diameter [m].
    pub(super) length: f64,
    pub(super) diameter: f64,
    pub(super) speed: f64,
    pub(super) projectile: &'a Material,
    pub(super) target: &'a Material,
}

impl<'a> LongRod<'a> {
    /// `None` when the target is not of one material.
    pub(super) fn of(scenario: &'a Scenario) -> Option<Self> {
        let plate = scenario.only_layer()?;
        let rod = &scenario.projectile;
        Some(Self {
            length: rod.mass / (rod.material.density.si() * rod.area()),
            diameter: rod.diameter,
            speed: scenario.impact_velocity,
            projectile: &rod.material,
            target: &plate.material,
        })
    }

    /// The rod of a case whose motion is integrated in steps of the time in which it advances by some of its diameter.
    ///
    /// # Errors
    /// More than one layer, or a rod so slender that the steps would not end.
    pub(super) fn to_integrate(scenario: &'a Scenario) -> Result<Self, Refusal> {
        let rod = Self::of(scenario).ok_or(NOT_ONE_TARGET)?;
        match rod.length / rod.diameter {
            slenderness if slenderness > MOST_SLENDER => Err(Refusal::new(format!(
                "it takes rods of up to {MOST_SLENDER} diameters, and this one has {}",
                significant(slenderness, 3)
            ))),
            _ => Ok(rod),
        }
    }

    /// Sets the length over all and the mass of a projectile of which so much of the flat-ended rod is left [m].
    pub(super) fn set_final(&self, scenario: &Scenario, left: f64, result: &mut RunResult) {
        // The nose goes first.
        let over_all = (scenario.projectile.length - (self.length - left)).max(0.0);
        result.projectile_final_length = Some(over_all);
        result.projectile_final_mass = Some(scenario.projectile.mass * left / self.length);
    }

    pub(super) fn densities(&self) -> (f64, f64) {
        (self.projectile.density.si(), self.target.density.si())
    }
}

/// Part of the impact velocity at which a speed counts as zero.
pub(super) const STOPPED: f64 = 1e-7;
/// Part of the length at which a rod counts as used up.
pub(super) const USED_UP: f64 = 1e-7;

/// Event of a rod that erodes from an impact at a speed [m/s] with a length [m]: not positive once its tail has slowed to its tip, its tip
/// stands still, or no length is left.
pub(super) fn erosion_ends([tail, tip, left]: [f64; 3], (speed, length): (f64, f64)) -> f64 {
    ((tail - tip) / speed - STOPPED)
        .min(tip / speed - STOPPED)
        .min(left / length - USED_UP)
}

/// Length [m] of a rod whose struck end has stopped before its tail came to rest: `L exp(−ρV²/2Y)`, the integral of `L dV/dt = −Y/ρ` and
/// `dL/dt = −V`.
pub(super) fn flattened(length: f64, tail: f64, density: f64, strength: f64) -> f64 {
    length * (-0.5 * density * tail * tail / strength).exp()
}

/// A strength that a case gives [Pa], or a material's flow stress at a plastic strain of 0.1, slow and at room temperature.
///
/// # Errors
/// The key to give when the material never yields.
pub(super) fn strength(
    given: Option<Pressure>,
    material: &Material,
    what: &str,
    key: &str,
) -> Result<f64, Refusal> {
    match (given, material.flow_stress(STRENGTH_STRAIN)) {
        (Some(given), _) => Ok(given.si()),
        (None, Some(stress)) => Ok(stress),
        (None, None) => Err(never_yields(what, key)),
    }
}

/// The refusal of a material that never yields, where a key can give its strength.
pub(super) fn never_yields(what: &str, key: &str) -> Refusal {
    Refusal::new(format!("the {what}'s material never yields"))
        .with_remedy(format!("give `{key}`, or another strength law"))
}

/// The result of a rod that has come to rest at a depth [m] with a length left [m].
pub(super) fn at_rest(
    model: &'static str,
    reference: &'static str,
    rod: &LongRod<'_>,
    (depth, left): (f64, f64),
) -> RunResult {
    let (outcome, termination) = if rod.speed == 0.0 {
        (Outcome::AtRest, Termination::NothingMoves)
    } else if left == 0.0 {
        (Outcome::ProjectileEroded, Termination::ProjectileConsumed)
    } else {
        (Outcome::AtRest, Termination::PenetrationStopped)
    };
    let mut result = RunResult::new(model, reference, outcome, termination);
    result.depth_of_penetration = Some(depth);
    result.residual_velocity = Some(0.0);
    result
}

/// The error of an integration that found no end.
pub(super) fn failure(stuck: IntegrationError) -> NumericalError {
    NumericalError {
        what: "the integration in time found no end".to_owned(),
        step: stuck.attempts.into(),
        time_us: stuck.time * 1e6,
        element: None,
        remedy: "report the case: every case in the model's range has an end".to_owned(),
    }
}

/// Strengths at which a depth was computed, as a warning of what it rests on.
pub(super) fn rests_on(projectile: f64, target: f64, source: &str) -> String {
    format!(
        "the depth rests on a projectile strength of {} MPa and a target resistance of {} MPa, {source}",
        significant(projectile * 1e-6, 4),
        significant(target * 1e-6, 4)
    )
}
