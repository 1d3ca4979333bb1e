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
    let mut sample = Sample::default();
    sample.time = moment.time;
    sample.step = step;
    sample.tip_velocity = moment.speed;
    sample.tail_velocity = moment.speed;
    sample.interface_velocity = moment.speed;
    sample.back_velocity = f64::NAN;
    sample.mean_velocity = moment.speed;
    sample.tip_position = moment.depth;
    sample.depth = moment.depth;
    sample.projectile_length = length;
    sample.contact_force = contact_force;
    sample.back_force = 0.0;
    sample.energy = {
        let mut energy = EnergyLedger::default();
        energy.initial = 0.5 * impact.mass * impact_velocity.powi(2);
        energy.kinetic_projectile = kinetic_projectile;
        energy.kinetic_target = impact.kinetic_energy(moment) - kinetic_projectile;
        energy.plastic_target = moment.crushing_work;
        energy.border_shear = moment.shear_work;
        energy.contact = moment.capture;
        energy
    };
    sample.momentum = {
        let mut momentum = MomentumLedger::default();
        momentum.initial = impact.mass * impact_velocity;
        momentum.projectile = impact.mass * moment.speed;
        momentum.target = impact.target_momentum(moment);
        momentum.border_shear = moment.impulse;
        momentum
    };
    sample
}
