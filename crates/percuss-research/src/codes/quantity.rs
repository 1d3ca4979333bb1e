//! Quantities that are compared, and how each is read from a run.

use percuss::{
    history::Sample,
    outcome::{Detail, RunResult},
};
use serde::{Deserialize, Serialize};

/// A compared quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Quantity {
    /// Final length of the projectile.
    FinalLength,
    /// Final diameter of the projectile's foot.
    FootDiameter,
    /// Depth of penetration.
    Depth,
    /// Velocity at which the projectile rebounds.
    ReboundVelocity,
    /// Velocity of the projectile behind the plate.
    ResidualVelocity,
    /// Axial stress at the struck face, mean over its plateau.
    InterfaceStress,
    /// Largest velocity of the rear face before it unloads.
    FreeSurfaceVelocity,
    /// Time at which the rear face reaches 50 m/s.
    PrecursorArrival,
    /// Time at which the rear face reaches 350 m/s.
    PlasticArrival,
    /// Smallest velocity of the rear face after its largest.
    PullBackMinimum,
    /// Largest velocity of the rear face after the pull-back.
    VelocityAfterSpall,
    /// Excess of the stress over the law at the mean plastic strain rate.
    StressExcess,
}

/// Velocities of the rear face that mark the arrival of the elastic and of the plastic wave [m/s].
const PRECURSOR: f64 = 50.0;
const PLASTIC: f64 = 350.0;

impl Quantity {
    /// Name in tables.
    pub fn label(self) -> &'static str {
        match self {
            Self::FinalLength => "final length",
            Self::FootDiameter => "foot diameter",
            Self::Depth => "depth of penetration",
            Self::ReboundVelocity => "rebound velocity",
            Self::ResidualVelocity => "residual velocity",
            Self::InterfaceStress => "interface stress",
            Self::FreeSurfaceVelocity => "free-surface velocity",
            Self::PrecursorArrival => "arrival of the elastic wave",
            Self::PlasticArrival => "arrival of the plastic wave",
            Self::PullBackMinimum => "pull-back minimum",
            Self::VelocityAfterSpall => "free-surface velocity after spall",
            Self::StressExcess => "excess of the flow stress",
        }
    }

    /// Name in figures, where a row has little room.
    pub(super) fn short_label(self) -> &'static str {
        match self {
            Self::Depth => "depth",
            Self::FreeSurfaceVelocity => "free surface",
            Self::PrecursorArrival => "elastic wave",
            Self::PlasticArrival => "plastic wave",
            Self::PullBackMinimum => "pull-back",
            Self::VelocityAfterSpall => "after spall",
            _ => self.label(),
        }
    }

    /// Unit of the stored values.
    pub fn unit(self) -> &'static str {
        match self {
            Self::FinalLength | Self::FootDiameter | Self::Depth => "mm",
            Self::ReboundVelocity
            | Self::ResidualVelocity
            | Self::FreeSurfaceVelocity
            | Self::PullBackMinimum
            | Self::VelocityAfterSpall => "m/s",
            Self::InterfaceStress => "GPa",
            Self::PrecursorArrival | Self::PlasticArrival => "us",
            Self::StressExcess => "%",
        }
    }

    /// Whether it needs the histories of a run.
    pub(super) fn needs_history(self) -> bool {
        matches!(
            self,
            Self::FreeSurfaceVelocity
                | Self::PrecursorArrival
                | Self::PlasticArrival
                | Self::PullBackMinimum
                | Self::VelocityAfterSpall
        )
    }

    /// Its value in [`Self::unit`]; `None` where the run has none. [`Self::StressExcess`] is not a number of a result: see
    /// [`super::rate`].
    pub(super) fn of(self, result: &RunResult) -> Option<f64> {
        let mm = |length: Option<f64>| length.map(|length| 1e3 * length);
        let faces = || RearFace::of(result);
        match self {
            Self::FinalLength => mm(result.projectile_final_length),
            Self::FootDiameter => mm(result.projectile_final_diameter),
            Self::Depth => mm(result.depth_of_penetration),
            Self::ReboundVelocity => result.residual_velocity.map(|velocity| -velocity),
            Self::ResidualVelocity => result.residual_velocity,
            Self::InterfaceStress => detail(&result.details, "interface stress, plateau"),
            Self::FreeSurfaceVelocity => Some(faces()?.largest),
            Self::PrecursorArrival => arrival(result, PRECURSOR),
            Self::PlasticArrival => arrival(result, PLASTIC),
            Self::PullBackMinimum => Some(faces()?.smallest_after),
            Self::VelocityAfterSpall => Some(faces()?.largest_again),
            Self::StressExcess => None,
        }
    }
}

fn detail(details: &[Detail], name: &str) -> Option<f64> {
    let found = details.iter().find(|detail| detail.name == name);
    found.map(|detail| detail.value)
}

/// Extremes of the velocity of the rear face [m/s], in their order in time.
struct RearFace {
    largest: f64,
    smallest_after: f64,
    largest_again: f64,
}

impl RearFace {
    fn of(result: &RunResult) -> Option<Self> {
        let samples = &result.history.as_ref()?.samples;
        let velocity = |index: &usize| samples[*index].back_velocity;
        let by_velocity = |a: &usize, b: &usize| velocity(a).total_cmp(&velocity(b));
        let first = (0..samples.len()).max_by(by_velocity)?;
        let second = (first..samples.len()).min_by(by_velocity)?;
        let third = (second..samples.len()).max_by(by_velocity)?;
        Some(Self {
            largest: velocity(&first),
            smallest_after: velocity(&second),
            largest_again: velocity(&third),
        })
    }
}

/// First time [us] at which the rear face has a velocity [m/s].
fn arrival(result: &RunResult, velocity: f64) -> Option<f64> {
    let samples = &result.history.as_ref()?.samples;
    let reached = |pair: &&[Sample]| pair[1].back_velocity >= velocity;
    let pair = samples.windows(2).find(reached)?;
    let rise = pair[1].back_velocity - pair[0].back_velocity;
    let part = (velocity - pair[0].back_velocity) / rise;
    Some(1e6 * (pair[0].time + part * (pair[1].time - pair[0].time)))
}
