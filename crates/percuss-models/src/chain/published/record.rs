//! Balances, histories, result and warnings of the published scheme.

use std::f64::consts::PI;

use super::{
    Published,
    springs::{Springs, single_plate},
};
use crate::{
    history::{ElementState, Profile, Sample},
    ledger::{EnergyLedger, MomentumLedger},
    options::Interface,
    outcome::{RunResult, Termination},
    solver::monitor::RunMonitor,
};

impl Published<'_> {
    pub(super) fn ledgers(&self) -> (EnergyLedger, MomentumLedger) {
        let kinetic =
            |velocity: &[f64], mass: f64| velocity.iter().map(|v| 0.5 * mass * v * v).sum();
        let momentum = |velocity: &[f64], mass: f64| velocity.iter().map(|v| mass * v).sum();
        let energy = {
            let mut energy = EnergyLedger::default();
            energy.initial = self.initial.0;
            energy.kinetic_projectile = kinetic(&self.rod_velocity, self.rod.mass);
            energy.kinetic_target = kinetic(&self.target_velocity, self.target.mass);
            energy.elastic_projectile = self.spring_work[0];
            energy.elastic_target = self.spring_work[1];
            energy.border_shear = self.friction_work;
            energy
        };
        let momentum = {
            let mut new_momentum = MomentumLedger::default();
            new_momentum.initial = self.initial.1;
            new_momentum.projectile = momentum(&self.rod_velocity, self.rod.mass);
            new_momentum.target = momentum(&self.target_velocity, self.target.mass);
            new_momentum.support = self.support_impulse;
            new_momentum.border_shear = self.friction_impulse;
            new_momentum
        };
        (energy, momentum)
    }

    fn rod_length(&self) -> f64 {
        let last = self.rod_displacement.len() - 1;
        self.scenario.projectile.length - (self.rod_displacement[last] - self.rod_displacement[0])
    }

    pub(super) fn state_at_nodes(&self) -> Sample {
        let (energy, momentum) = self.ledgers();
        let count = self.rod_velocity.len();
        let mut sample = Sample::default();
        sample.time = self.time();
        sample.step = self.step;
        sample.tip_velocity = self.rod_velocity[0];
        sample.tail_velocity = self.rod_velocity[count - 1];
        sample.interface_velocity = self.target_velocity[0];
        sample.back_velocity = 0.0;
        sample.mean_velocity = self.rod_velocity.iter().sum::<f64>() / count as f64;
        sample.tip_position = self.rod_displacement[0];
        sample.depth = self.target_displacement[0];
        sample.projectile_length = self.rod_length();
        sample.contact_force = self.contact_force;
        sample.back_force = self.back_force;
        sample.energy = energy;
        sample.momentum = momentum;
        sample
    }

    pub(super) fn state_in_springs(&self) -> Profile {
        let state = |part: usize,
                     centre: f64,
                     shortening: f64,
                     springs: &Springs,
                     area: f64,
                     diameter: f64,
                     [moved, velocity]: [f64; 2]| {
            ElementState {
                part,
                initial_position: centre,
                position: centre + moved,
                displacement: moved,
                length: springs.length - shortening,
                stress: springs.force(shortening, springs.length) / area,
                strain: shortening / springs.length,
                plastic_strain: 0.0,
                diameter,
                temperature: self.scenario.projectile.material.room_temperature.si(),
                velocity,
            }
        };
        let rod = &self.scenario.projectile;
        let column = single_plate(self.scenario).map_or(rod.diameter, |plate| plate.2);
        let column_area = PI * column * column / 4.0;
        let mut elements = Vec::new();
        for i in (1..self.rod_displacement.len()).rev() {
            let (behind, ahead) = (self.rod_displacement[i], self.rod_displacement[i - 1]);
            let centre = -(i as f64) * self.rod.length;
            let moved = 0.5 * (ahead + behind);
            let velocity = 0.5 * (self.rod_velocity[i] + self.rod_velocity[i - 1]);
            elements.push(state(
                0,
                centre,
                behind - ahead,
                &self.rod,
                rod.area(),
                rod.diameter,
                [moved, velocity],
            ));
        }
        for i in 1..self.target_displacement.len() {
            let (behind, ahead) = (self.target_displacement[i - 1], self.target_displacement[i]);
            let centre = i as f64 * self.target.length;
            let moved = 0.5 * (ahead + behind);
            let velocity = 0.5 * (self.target_velocity[i - 1] + self.target_velocity[i]);
            elements.push(state(
                1,
                centre,
                behind - ahead,
                &self.target,
                column_area,
                column,
                [moved, velocity],
            ));
        }
        Profile {
            time: self.time(),
            elements,
        }
    }

    /// Adds depths, what is left of the projectile, and warnings.
    pub(super) fn complete_result(&self, result: &mut RunResult, monitor: &RunMonitor) {
        let count = self.rod_velocity.len() as f64;
        result.depth_of_penetration = Some(self.rod_displacement[0]);
        result.largest_depth = Some(monitor.largest_depth);
        result.residual_velocity = Some(self.rod_velocity.iter().sum::<f64>() / count);
        result.projectile_final_length = Some(self.rod_length());
        result.projectile_final_mass = Some(self.scenario.projectile.mass);
        result.warnings = self.warnings(result.termination == Termination::TipStopped);
    }

    fn warnings(&self, stopped: bool) -> Vec<String> {
        let mut warnings = vec![
            "scheme `published` reproduces the paper; its depths are not converged and its strain measure fails at large \
             strain: for an answer, use scheme `conservative`"
                .to_owned(),
        ];
        let inverted = (1..self.rod_displacement.len())
            .filter(|&i| self.rod_displacement[i] - self.rod_displacement[i - 1] >= self.rod.length)
            .count()
            + (1..self.target_displacement.len())
                .filter(|&i| {
                    self.target_displacement[i - 1] - self.target_displacement[i]
                        >= self.target.length
                })
                .count();
        if inverted > 0 {
            warnings.push(format!(
                "{inverted} springs are shorter than nothing: elements can invert under small-strain kinematics"
            ));
        }
        match self.options.interface {
            Interface::Chain if stopped => {
                let face = self.target_displacement[0] * 1e3;
                warnings.push(format!(
                    "the target's face moved {face:.4} mm: this depth is the collapse of the contact spring and shrinks \
                     with the element length"
                ));
            }
            Interface::Chain => {}
            Interface::Joined | Interface::JoinedPushed => warnings.push(format!(
                "equation (15) gives the first target mass its speed from nothing: {:.2} % of the impact's momentum",
                100.0 * self.target.mass * self.scenario.impact_velocity / self.initial.1.max(f64::MIN_POSITIVE)
            )),
        }
        warnings
    }
}
