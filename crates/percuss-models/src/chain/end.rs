//! End of a run of the column, and its outcome.

use serde::{Deserialize, Serialize};

use super::{
    part::Role,
    state::{BoundaryCondition, State},
};
use crate::{
    outcome::{Outcome, REST_FRACTION, Termination},
    scenario::{Scenario, TargetBody},
    solver::monitor::RunMonitor,
    units::significant,
};

/// Section of the initial energy that may still dissipate in a window of a run whose bodies touch.
const QUIET_FRACTION: f64 = 1e-6;
/// The same after separation: vibrations then change neither depth nor velocity.
const PARTED_FRACTION: f64 = 1e-4;

/// One round trip of a wave in the projectile, in which a run that is over changes no more.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(super) struct Window {
    /// Whether the projectile touched the target at any time since the window began.
    pub(super) touched: bool,
    /// How often ends had met when the window began.
    meetings: u64,
    start: f64,
    dissipation: f64,
    depth: f64,
    /// Time at which the crater floor passed the original rear face.
    passed_back_face: Option<f64>,
}

impl Window {
    /// Includes a step: whether projectile and target touch.
    #[inline(always)]
    pub(super) fn follow(&mut self, state: &State, scenario: &Scenario) -> bool {
        if self.passed_back_face.is_none()
            && scenario.target_thickness().is_some()
            && state.passed_back_face()
        {
            self.passed_back_face = Some(state.time);
        }
        let Some(tip) = state.tip_segment() else {
            return false;
        };
        let touches =
            state.tip_friction > 0.0 || state.interfaces.get(tip).is_some_and(|j| j.closed);
        self.touched |= touches;
        touches
    }

    /// Time at which the window ends.
    pub(super) fn end_time(&self, scenario: &Scenario) -> f64 {
        let rod = &scenario.projectile;
        self.start + 2.0 * rod.length / rod.material.bar_wave_speed()
    }

    /// Why a run is over at the end of a window, if it is.
    pub(super) fn end(
        &mut self,
        state: &State,
        scenario: &Scenario,
        monitor: &RunMonitor,
        end_time: f64,
    ) -> Option<Termination> {
        if !self.is_quiet(state, scenario, monitor, end_time) {
            return None;
        }
        let tip = state.tip_segment().map(|tip| state.interfaces.get(tip));
        Some(match tip {
            Some(_) if state.left_the_plate() => Termination::PlugFree,
            Some(Some(interface)) if !interface.closed => Termination::Parted,
            Some(_) => Termination::Quiescent,
            None => Termination::ProjectileConsumed,
        })
    }

    fn is_quiet(
        &mut self,
        state: &State,
        scenario: &Scenario,
        monitor: &RunMonitor,
        end_time: f64,
    ) -> bool {
        if state.time < self.end_time(scenario) {
            return false;
        }
        let accumulated = &state.accumulated;
        let dissipation = accumulated.plastic[0]
            + accumulated.plastic[1]
            + accumulated.kicks.friction.work
            + accumulated.viscous_work
            + accumulated.fracture_work
            + accumulated.eroded_energy
            + state.plug_dissipation();
        let flow = (dissipation - self.dissipation) / accumulated.initial_energy;
        let deepening = monitor.largest_depth > self.depth * (1.0 + 1e-9);
        // Where the target is free to fly, its pieces also count.
        let met = state.end == BoundaryCondition::Free && state.meetings != self.meetings;
        let touched = self.touched || met;
        self.meetings = state.meetings;
        self.start = state.time;
        self.dissipation = dissipation;
        self.depth = monitor.largest_depth;
        self.touched = false;
        let (mass, momentum) = state.projectile_motion();
        if mass == 0.0 {
            return flow <= QUIET_FRACTION && !deepening;
        }
        let meets =
            |from: usize| approaches(state, from, end_time - state.time, scenario.impact_velocity);
        if !touched {
            return flow <= PARTED_FRACTION && !meets(0);
        }
        if state.left_the_plate()
            && let (Some(tip), Some(face)) = (state.tip_segment(), state.face_segment())
        {
            // Projectile and plug may fly on together; pieces of one of them that meet among themselves change nothing.
            let [tip_speed, face_speed] =
                [tip, face].map(|s| state.mean_velocity(state.segments[s]));
            let together =
                (tip_speed - face_speed).abs() <= REST_FRACTION * scenario.impact_velocity;
            let parted = !state.interfaces[tip].closed && !meets(0);
            return flow <= PARTED_FRACTION && (parted || together && !meets(face));
        }
        // A projectile that is still being pushed back has not got its rebound speed yet.
        let still = (momentum / mass).abs() <= REST_FRACTION * scenario.impact_velocity;
        let layers_rest = || state.tip_segment().is_none_or(|tip| !meets(tip + 1));
        monitor.at_rest.is_some() && !deepening && still && flow <= QUIET_FRACTION && layers_rest()
    }

    /// Outcome of a run that was ended for a reason, and its criterion.
    pub(super) fn outcome(
        &self,
        termination: Termination,
        state: &State,
        monitor: &RunMonitor,
        impact_velocity: f64,
    ) -> (Outcome, String) {
        let (mass, momentum) = state.projectile_motion();
        if let Some(time) = self.passed_back_face.filter(|_| state.hold.is_none()) {
            let words = format!(
                "the crater floor passed the original rear face at {} us",
                significant(time * 1e6, 4)
            );
            return (Outcome::Perforated, words);
        }
        if termination == Termination::NothingMoves {
            return (Outcome::AtRest, "the impact velocity is zero".to_owned());
        }
        let percent = REST_FRACTION * 100.0;
        let ratio = momentum / (mass * impact_velocity);
        let speed = match mass > 0.0 {
            true => format!(
                "the projectile's mean speed at the end is {} % of the impact velocity",
                significant(100.0 * ratio, 3)
            ),
            false => "no element of the projectile is left".to_owned(),
        };
        let follows = mass > 0.0 && ratio > REST_FRACTION;
        // What flies free is held no more, however the run was ended.
        if state.left_the_plate() {
            let (_, plug_speed) = state.plug_motion();
            let plug = plug_speed / impact_velocity;
            let free = match state.plug_free_since() {
                Some(time) => format!(
                    "the whole shear band had failed at {} us",
                    significant(time * 1e6, 4)
                ),
                None => "no border shear holds what is ahead of the projectile".to_owned(),
            };
            if follows {
                let words = format!("{free}, and {speed}, above {percent} %");
                return (Outcome::Perforated, words);
            }
            if plug > REST_FRACTION {
                let words = format!(
                    "{free}, and the plug leaves an open hole at {} % of the impact velocity, above {percent} %; {speed}",
                    significant(100.0 * plug, 3)
                );
                return (Outcome::Perforated, words);
            }
        }
        if mass == 0.0 {
            return (Outcome::ProjectileEroded, speed);
        }
        let unfinished = matches!(termination, Termination::EndTime | Termination::StepLimit);
        if unfinished && monitor.at_rest.is_none() && follows {
            let words = "the projectile still moved forward when the run was ended";
            return (Outcome::OutOfTime, words.to_owned());
        }
        // What a plate still holds does not move away for good.
        if state.plug_is_held() && follows {
            let words = format!("the shear band still holds the plug, although {speed}");
            return (Outcome::AtRest, words);
        }
        if ratio < -REST_FRACTION {
            let words = format!("{speed}, below -{percent} %");
            (Outcome::Rebounded, words)
        } else if follows {
            let words = format!("{speed}, above {percent} %, and it touches the target no more");
            (Outcome::Separated, words)
        } else {
            (Outcome::AtRest, format!("{speed}, within {percent} %"))
        }
    }
}

/// Whether pieces in free flight will meet within a time at one of the interfaces from a given one on.
///
/// A target with a fixed rear face rings without end: there only layers that approach by a hundredth of the impact velocity count.
fn approaches(state: &State, from: usize, horizon: f64, impact_velocity: f64) -> bool {
    let Some(tip) = state.tip_segment() else {
        return false;
    };
    let interfaces = state.interfaces.iter().enumerate().skip(from);
    interfaces
        .filter(|(_, interface)| !interface.closed)
        .any(|(s, _)| {
            let (behind, ahead) = (state.segments[s], state.segments[s + 1]);
            let gap =
                state.nodes.position[ahead.first_node] - state.nodes.position[behind.last_node];
            // A target that is held vibrates about its place; anything else flies at its mean speed.
            let back_is_held = state.end != BoundaryCondition::Free;
            let is_held = back_is_held || state.plug_is_held();
            if is_held && s > tip && behind.part == ahead.part {
                return false;
            }
            let ahead_is_held =
                is_held && s == tip || back_is_held && s + 2 == state.segments.len();
            let away = if ahead_is_held {
                0.0
            } else {
                state.mean_velocity(ahead)
            };
            let least = if is_held && s > tip {
                REST_FRACTION * impact_velocity
            } else {
                0.0
            };
            let approach = state.mean_velocity(behind) - away;
            approach > least && gap < approach * horizon
        })
}

impl State {
    /// What ends a run at once; an error when the modelled part of a semi-infinite target is used up.
    ///
    /// A crater floor that passes the rear face ends a run only while border shear still acts on the column, which has left the plate then.
    /// What nothing holds flies on until its pieces have separated finally.
    pub(super) fn event(&self, scenario: &Scenario) -> Result<Option<Termination>, f64> {
        let TargetBody::Layers { layers, .. } = &scenario.target else {
            let gone = self.tip_segment().is_none();
            return Ok(gone.then_some(Termination::ProjectileConsumed));
        };
        let finite = layers.iter().all(|plate| plate.thickness.is_some());
        match (finite, self.face_segment()) {
            (false, None) => Err(self.depth()),
            (true, None) => Ok(Some(Termination::PassedBackFace)),
            // A plug that is still held, or that the projectile still pushes, is no end.
            (true, Some(_))
                if self.hold.is_none() && self.passed_back_face() && !self.flies_free() =>
            {
                Ok(Some(Termination::PassedBackFace))
            }
            _ => Ok(None),
        }
    }

    /// Whether the crater floor has passed the original rear face.
    fn passed_back_face(&self) -> bool {
        self.face_segment().is_none() || self.depth() >= self.back_position
    }

    /// Whether neither a rear face nor border shear holds any of the target.
    fn flies_free(&self) -> bool {
        self.end == BoundaryCondition::Free
            && !self.plug_is_held()
            && self.segments.iter().all(|segment| {
                self.parts[segment.part].role == Role::Projectile
                    || self.nodes.friction[segment.first_node..=segment.last_node]
                        .iter()
                        .all(|friction| *friction == 0.0)
            })
    }

    /// Whether the target was held by border shear, friction or a band, and flies free now: a plug.
    pub(super) fn left_the_plate(&self) -> bool {
        let lost_impulse = || self.parts.iter().any(|part| part.friction_per_length > 0.0);
        (self.hold.is_some() || lost_impulse()) && self.flies_free()
    }
}
