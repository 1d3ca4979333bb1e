//! What a run says: how the shot ended, the numbers, the books and the warnings.

use serde::Serialize;

use crate::{
    history::History,
    ledger::{EnergyLedger, MomentumLedger},
};

/// How a shot ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// The projectile stopped: its mean speed is within 1 % of the impact speed around zero.
    AtRest,
    /// The projectile left the target backwards.
    Rebounded,
    /// The target moved away from the projectile, which still moves forward.
    Separated,
    /// The crater floor passed the original back face of the target.
    Perforated,
    /// Nothing of the projectile is left.
    ProjectileEroded,
    /// The run ended before the shot did.
    OutOfTime,
    /// The model does not apply.
    NotApplicable,
}

impl Outcome {
    /// The outcome in words.
    pub fn in_words(self) -> &'static str {
        match self {
            Self::AtRest => "at rest",
            Self::Rebounded => "rebounded",
            Self::Separated => "separated, moving forward",
            Self::Perforated => "perforated",
            Self::ProjectileEroded => "projectile eroded",
            Self::OutOfTime => "out of time",
            Self::NotApplicable => "not applicable",
        }
    }
}

/// Why a run was ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Termination {
    /// The tip has stopped and neither depth nor dissipated energy grew over a round trip of a wave in the projectile.
    Quiescent,
    /// Projectile and target have parted, will not meet again, and what still rings in them dissipates next to nothing.
    Parted,
    /// The tip's speed reached zero (scheme `published`, paper section 3.6).
    TipStopped,
    /// The crater floor passed the original back face.
    PassedBackFace,
    /// The last element of the projectile eroded.
    ProjectileConsumed,
    /// `end_time` was reached.
    EndTime,
    /// `max_steps` was reached.
    StepLimit,
    /// Nothing moves: the impact speed is zero.
    NothingMoves,
}

impl Termination {
    /// The reason in words.
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Quiescent => {
                "tip stopped; neither depth nor dissipation grew over a round trip of a wave"
            }
            Self::Parted => "projectile and target have parted and will not meet again",
            Self::TipStopped => "the tip's speed reached zero",
            Self::PassedBackFace => "crater floor passed the original back face",
            Self::ProjectileConsumed => "last element of the projectile eroded",
            Self::EndTime => "end_time reached",
            Self::StepLimit => "max_steps reached",
            Self::NothingMoves => "impact speed is zero",
        }
    }
}

/// The result of one model on one case.
#[derive(Debug, Clone, PartialEq)]
pub struct RunResult {
    /// Name of the model.
    pub model: &'static str,
    /// Scheme of the model.
    pub scheme: &'static str,
    /// How the shot ended.
    pub outcome: Outcome,
    /// Why the run was ended.
    pub termination: Termination,
    /// Depth of the crater floor below the original face when the projectile's momentum is used up [m].
    ///
    /// The largest depth reached when the run ends before that; `None` for a rigid wall.
    pub depth_of_penetration: Option<f64>,
    /// Largest depth of the crater floor at any time, elastic deflection included [m]; `None` for a rigid wall.
    pub largest_depth: Option<f64>,
    /// Depth that plastic flow and erosion leave once the load is gone [m]; `None` where the model cannot tell.
    pub permanent_depth: Option<f64>,
    /// Mean speed of what is left of the projectile at the end, forward positive [m/s].
    pub residual_velocity: f64,
    /// Length of what is left of the projectile, unloaded [m].
    pub projectile_final_length: f64,
    /// Largest diameter of what is left of the projectile, unloaded [m]; `None` where the model has no diameter.
    pub projectile_final_diameter: Option<f64>,
    /// Mass left of the projectile [kg].
    pub projectile_final_mass: f64,
    /// Time at which the projectile's momentum was used up [s]; `None` when it was not.
    pub time_to_rest: Option<f64>,
    /// Largest force between projectile and target [N].
    pub peak_force: f64,
    /// Time at the end [s].
    pub end_time: f64,
    /// Time steps taken.
    pub steps: u64,
    /// First time step [s].
    pub first_time_step: f64,
    /// Smallest time step [s].
    pub smallest_time_step: f64,
    /// Elements that eroded: projectile, target.
    pub eroded_elements: (usize, usize),
    /// Largest plastic strain reached: projectile, target.
    pub largest_plastic_strain: (f64, f64),
    /// Largest temperature reached [K]: projectile, target.
    pub largest_temperature: (f64, f64),
    /// Energy book at the end.
    pub energy: EnergyLedger,
    /// Momentum book at the end.
    pub momentum: MomentumLedger,
    /// Largest energy residual that was seen during the run.
    pub energy_residual: f64,
    /// Largest momentum residual that was seen during the run.
    pub momentum_residual: f64,
    /// What a user should know before relying on the numbers.
    pub warnings: Vec<String>,
    /// Time histories, when they were asked for.
    pub history: Option<History>,
}
