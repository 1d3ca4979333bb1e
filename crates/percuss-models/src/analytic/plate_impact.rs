//! A case at one metal plate, as the models of perforation see it.

use std::f64::consts::PI;

use crate::{
    Error, Refusal,
    material::Material,
    outcome::{Outcome, RunResult, Termination},
    regime::{ProjectileRegime, Regime},
    scenario::Scenario,
};

/// Why a plate has no strength to work with.
pub(super) const PLATE_NEVER_FLOWS: &str = "the plate's strength law never flows";

/// Projectile and plate.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlateImpact<'a> {
    /// Mass of the projectile [kg].
    pub mass: f64,
    /// Impact velocity [m/s].
    pub speed: f64,
    /// Diameter of the shank [m].
    pub diameter: f64,
    /// Thickness of the plate along the path, which is more than the plate's own for an oblique one [m].
    pub thickness: f64,
    /// Material of the plate.
    pub plate: &'a Material,
}

impl<'a> PlateImpact<'a> {
    /// The case of a case; `None` unless one plate is struck.
    pub fn of(scenario: &'a Scenario) -> Option<Self> {
        let layer = scenario.only_layer()?;
        Some(Self {
            mass: scenario.projectile.mass,
            speed: scenario.impact_velocity,
            diameter: scenario.projectile.diameter,
            thickness: layer.thickness? / scenario.obliquity.cos(),
            plate: &layer.material,
        })
    }

    /// Cross-sectional area of the shank [m2].
    pub fn area(&self) -> f64 {
        PI * self.diameter * self.diameter / 4.0
    }

    /// Mass of the plate in line with the shank [kg].
    pub fn plug_mass(&self) -> f64 {
        self.plate.density.si() * self.area() * self.thickness
    }

    /// Thickness of the plate in diameters of the shank.
    pub fn thickness_to_diameter(&self) -> f64 {
        self.thickness / self.diameter
    }
}

/// The error of a model that was run on a case that it had not been asked about.
pub(super) fn refuse(model: &'static str, refusal: impl Into<Refusal>) -> Error {
    Error::not_applicable(model, refusal)
}

/// Says that a projectile was taken as rigid although it would not stay so.
pub(super) fn taken_as_rigid(scenario: &Scenario) -> Option<String> {
    let regime = Regime::of(scenario);
    (regime.projectile != ProjectileRegime::Rigid).then(|| {
        format!(
            "the projectile is taken as rigid, but in a thick target it would be {}: {}",
            regime.projectile.describe(),
            regime.because
        )
    })
}

/// The result of a case at a plate with a known ballistic limit and residual speed [m/s].
pub(super) fn plate_result(
    model: &'static str,
    scheme: &'static str,
    speed: f64,
    ballistic_limit: f64,
    residual: f64,
) -> RunResult {
    let (outcome, termination) = if speed == 0.0 {
        (Outcome::AtRest, Termination::NothingMoves)
    } else if speed > ballistic_limit {
        (Outcome::Perforated, Termination::ClosedForm)
    } else {
        (Outcome::AtRest, Termination::ClosedForm)
    };
    let mut result = RunResult::new(model, scheme, outcome, termination);
    result.residual_velocity = Some(residual);
    result.ballistic_limit = Some(ballistic_limit);
    result
}
