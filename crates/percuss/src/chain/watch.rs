//! When a shot is over, and how it ended.

use super::state::{End, State};
use crate::{
    outcome::{Outcome, Termination},
    scenario::{Scenario, TargetBody},
};

/// Part of the impact speed below which a projectile counts as stopped.
const REST_FRACTION: f64 = 0.01;
/// Part of the initial energy that may still dissipate in a window of a run whose bodies touch.
const QUIET_FRACTION: f64 = 1e-6;
/// The same when they have parted: what rings inside them then changes neither depth nor speed.
const PARTED_FRACTION: f64 = 1e-4;

/// What is followed during a run.
#[derive(Debug, Default)]
pub(super) struct Watch {
    pub(super) largest_depth: f64,
    pub(super) peak_force: f64,
    pub(super) first_time_step: f64,
    pub(super) smallest_time_step: f64,
    pub(super) energy_residual: f64,
    pub(super) momentum_residual: f64,
    /// Time and depth at which the projectile's momentum was first used up.
    pub(super) at_rest: Option<(f64, f64)>,
    /// Whether the projectile touched the target at any time since the window began.
    touched: bool,
    window_start: f64,
    window_dissipation: f64,
    window_depth: f64,
}

impl Watch {
    /// Keeps up extremes and the state of the projectile after a step.
    pub(super) fn follow(&mut self, state: &State, impact_speed: f64) {
        let depth = state.depth();
        self.largest_depth = self.largest_depth.max(depth);
        self.peak_force = self.peak_force.max(state.contact_force);
        if state.step == 1 {
            self.first_time_step = state.time_step;
            self.smallest_time_step = state.time_step;
        }
        self.smallest_time_step = self.smallest_time_step.min(state.time_step);
        let Some(tip) = state.tip_segment() else {
            return;
        };
        self.touched |= state.tip_friction > 0.0 || state.closed.get(tip) == Some(&true);
        // The tail is the last to hear of the impact: no need to sum up before it slows down.
        let tail = state.segments[0].first_node;
        if self.at_rest.is_none()
            && state.nodes[tail].velocity < 0.5 * impact_speed
            && state.projectile_motion().1 <= 0.0
        {
            self.at_rest = Some((state.time, depth));
        }
    }

    /// Whether the shot is over: looked at once in a round trip of a wave in the projectile.
    pub(super) fn is_quiet(&mut self, state: &State, scenario: &Scenario, end_time: f64) -> bool {
        let rod = &scenario.projectile;
        let window = 2.0 * rod.length / rod.material.bar_wave_speed();
        if state.time < self.window_start + window {
            return false;
        }
        let books = &state.books;
        let dissipation = books.plastic[0]
            + books.plastic[1]
            + books.friction_work
            + books.viscous_work
            + books.eroded_energy
            + state.plug_dissipation();
        let flow = (dissipation - self.window_dissipation) / books.initial_energy;
        let deepening = self.largest_depth > self.window_depth * (1.0 + 1e-9);
        let touched = self.touched;
        self.window_start = state.time;
        self.window_dissipation = dissipation;
        self.window_depth = self.largest_depth;
        self.touched = false;
        let (mass, momentum) = state.projectile_motion();
        if mass == 0.0 {
            return flow <= QUIET_FRACTION && !deepening;
        }
        if !touched {
            return flow <= PARTED_FRACTION && !approaches(state, end_time - state.time);
        }
        if state.plug_is_free() {
            // Projectile and plug may fly on together.
            let apart = (momentum / mass - state.plug_motion().1).abs();
            return flow <= PARTED_FRACTION && apart <= REST_FRACTION * scenario.impact_speed;
        }
        // A projectile that is still being pushed back has not got its rebound speed yet.
        let still = (momentum / mass).abs() <= REST_FRACTION * scenario.impact_speed;
        self.at_rest.is_some() && !deepening && still && flow <= QUIET_FRACTION
    }

    /// How a run ended that was ended for a reason.
    pub(super) fn outcome(
        &self,
        termination: Termination,
        state: &State,
        impact_speed: f64,
    ) -> Outcome {
        let (mass, momentum) = state.projectile_motion();
        match termination {
            Termination::PassedBackFace => return Outcome::Perforated,
            Termination::NothingMoves => return Outcome::AtRest,
            _ if mass == 0.0 => return Outcome::ProjectileEroded,
            Termination::EndTime | Termination::StepLimit if self.at_rest.is_none() => {
                return Outcome::OutOfTime;
            }
            _ => {}
        }
        let ratio = momentum / (mass * impact_speed);
        // What a plate still holds does not move away for good.
        if state.plug_is_free() && ratio > REST_FRACTION {
            return Outcome::Perforated;
        }
        if state.plug_is_held() && ratio > REST_FRACTION {
            return Outcome::AtRest;
        }
        if ratio < -REST_FRACTION {
            Outcome::Rebounded
        } else if ratio > REST_FRACTION {
            Outcome::Separated
        } else {
            Outcome::AtRest
        }
    }
}

/// Whether a piece of the projectile in free flight will meet what is ahead of it within a time.
fn approaches(state: &State, horizon: f64) -> bool {
    let Some(tip) = state.tip_segment() else {
        return false;
    };
    state
        .closed
        .iter()
        .enumerate()
        .take(tip + 1)
        .any(|(s, closed)| {
            let (behind, ahead) = (state.segments[s], state.segments[s + 1]);
            let gap =
                state.nodes[ahead.first_node].position - state.nodes[behind.last_node].position;
            // A target that is held vibrates about its place; anything else flies at its mean speed.
            let held = s == tip && (state.end != End::Free || state.plug_is_held());
            let away = if held {
                0.0
            } else {
                state.mean_velocity(ahead)
            };
            let approach = state.mean_velocity(behind) - away;
            !closed && approach > 0.0 && gap < approach * horizon
        })
}

/// What ends a run at once; an error when the modelled part of a semi-infinite target is used up.
pub(super) fn event(state: &State, scenario: &Scenario) -> Result<Option<Termination>, f64> {
    let TargetBody::Layers { layers, .. } = &scenario.target else {
        let gone = state.tip_segment().is_none();
        return Ok(gone.then_some(Termination::ProjectileConsumed));
    };
    let thickness: Option<f64> = layers.iter().map(|plate| plate.thickness).sum();
    match (thickness, state.face_segment()) {
        (None, None) => Err(state.depth()),
        (Some(_), None) => Ok(Some(Termination::PassedBackFace)),
        // A plug that is still held, or that the projectile still pushes, is no end.
        (Some(thickness), Some(_)) if state.hold.is_none() && state.depth() >= thickness => {
            Ok(Some(Termination::PassedBackFace))
        }
        _ => Ok(None),
    }
}
