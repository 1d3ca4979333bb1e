//! Time histories of a case in three stages.

use super::stages::{Impact, MotionState, Perforation};
use crate::{
    history::{History, Sample},
    ledger::{EnergyLedger, MomentumLedger},
};

/// Histories of a case with a projectile of this length [m].
pub(super) fn of(impact: &Impact, case: &Perforation, length: f64) -> History {
    let Some((first, _)) = case.moments.first() else {
        return History::default();
    };
    let speed = first.speed;
    let samples = case
        .moments
        .iter()
        .zip(0..)
        .map(|((moment, force), step)| sample(impact, moment, *force, step, speed, length))
        .collect();
    History {
        samples,
        profiles: Vec::new(),
        gauges: Vec::new(),
    }
}

fn sample(
    impact: &Impact,
    moment: &MotionState,
    contact_force: f64,
    step: u64,
    impact_velocity: f64,
    length: f64,
) -> Sample {
    let kinetic_projectile = 0.5 * impact.mass * moment.speed.powi(2);
    Sample {
        time: moment.time,
        step,
        tip_velocity: moment.speed,
        tail_velocity: moment.speed,
        interface_velocity: moment.speed,
        back_velocity: f64::NAN,
        mean_velocity: moment.speed,
        tip_position: moment.depth,
        depth: moment.depth,
        projectile_length: length,
        contact_force,
        back_force: 0.0,
        energy: EnergyLedger {
            initial: 0.5 * impact.mass * impact_velocity.powi(2),
            kinetic_projectile,
            kinetic_target: impact.kinetic_energy(moment) - kinetic_projectile,
            plastic_target: moment.crushing_work,
            border_shear: moment.shear_work,
            contact: moment.capture,
            ..EnergyLedger::default()
        },
        momentum: MomentumLedger {
            initial: impact.mass * impact_velocity,
            projectile: impact.mass * moment.speed,
            target: impact.target_momentum(moment),
            border_shear: moment.impulse,
            ..MomentumLedger::default()
        },
    }
}
