//! Time histories of a perforation by least power.

use super::motion::{Impact, MotionState, Perforation};
use crate::{
    history::{History, Sample},
    ledger::{EnergyLedger, MomentumLedger},
};

/// Histories of a case at an impact velocity [m/s] with a projectile of this length [m].
pub(super) fn of(impact: &Impact, run: &Perforation, speed: f64, length: f64) -> History {
    let samples = run.moments.iter().zip(1..);
    History {
        samples: samples
            .map(|(moment, step)| sample(impact, moment, step, speed, length))
            .collect(),
        profiles: Vec::new(),
        gauges: Vec::new(),
    }
}

fn sample(impact: &Impact, moment: &MotionState, step: u64, speed: f64, length: f64) -> Sample {
    let [velocity, plug, plate] = moment.velocities;
    let depth = moment.sunk + moment.slip + moment.deflection + moment.flexure;
    let mut sample = Sample::default();
    sample.time = moment.time;
    sample.step = step;
    sample.tip_velocity = velocity;
    sample.tail_velocity = velocity;
    sample.interface_velocity = velocity;
    sample.back_velocity = if impact.plug_mass(moment) > 0.0 {
        plug
    } else {
        plate
    };
    sample.mean_velocity = velocity;
    sample.tip_position = depth;
    sample.depth = depth;
    sample.projectile_length = length;
    sample.contact_force = moment.force;
    sample.energy = energy(impact, moment, speed);
    sample.momentum = momentum(impact, moment, speed);
    sample
}

pub(super) fn energy(impact: &Impact, moment: &MotionState, speed: f64) -> EnergyLedger {
    let [projectile, plug, plate] = impact.kinetic_energy(moment);
    let mut energy = EnergyLedger::default();
    energy.initial = 0.5 * impact.mass * speed * speed;
    energy.kinetic_projectile = projectile;
    energy.kinetic_target = plug;
    energy.kinetic_plate = plate;
    energy.plastic_target = moment.local_work;
    energy.border_shear = moment.rim_work;
    energy.plastic_plate = moment.dish_work;
    energy.elastic_plate = moment.wave_work;
    energy.contact = moment.capture;
    energy.eroded = moment.displaced;
    energy
}

pub(super) fn momentum(impact: &Impact, moment: &MotionState, speed: f64) -> MomentumLedger {
    let [projectile, plug, plate] = moment.velocities;
    let mut momentum = MomentumLedger::default();
    momentum.initial = impact.mass * speed;
    momentum.projectile = impact.mass * projectile;
    momentum.target = impact.plug_mass(moment) * plug;
    momentum.eroded = moment.displaced_momentum;
    if impact.bulging {
        momentum.plate = impact.dish().momentum(moment.edge) * plate;
        momentum.support = moment.impulse - momentum.plate;
    } else {
        momentum.border_shear = moment.impulse;
    }
    momentum
}
