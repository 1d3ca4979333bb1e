//! Energy and momentum balances of a grid.

use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

use super::{Cells, Grid, Law, Motion, Stored};
use crate::ledger::{EnergyLedger, MomentumLedger};

/// Work and impulse that have gone where the state itself does not show them.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(in crate::fdm) struct Accumulators {
    pub(in crate::fdm) initial_energy: f64,
    pub(in crate::fdm) initial_momentum: f64,
    pub(in crate::fdm) friction_work: f64,
    pub(in crate::fdm) friction_impulse: f64,
    pub(in crate::fdm) contact_loss: f64,
    /// Work done on what holds the ends; negative when it drives the grid.
    pub(in crate::fdm) boundary_work: f64,
    pub(in crate::fdm) support_impulse: f64,
}

impl<L: Law> Grid<L> {
    /// Whether a body is the projectile (0) or belongs to the target (1).
    fn role(body: usize) -> usize {
        usize::from(body > 0)
    }

    /// Energy of the cells of the projectile and of the target [J].
    ///
    /// The cells' own time is the middle of a step, so each is looked at as the next step would load it.
    pub(in crate::fdm) fn stored(&self) -> [Stored; 2] {
        let mut sums = [Stored::default(); 2];
        for (s, segment) in self.segments.iter().enumerate() {
            let law = &self.bodies[segment.body];
            let sum = &mut sums[Self::role(segment.body)];
            for c in segment.cells.clone() {
                let (a, b) = (self.nodes.at(c + s), self.nodes.at(c + s + 1));
                let approach = a.velocity - b.velocity;
                let mut cell = self.cells.look(c, |cell| *cell);
                law.load(
                    &mut cell,
                    Motion {
                        length: b.position - a.position - 0.5 * approach * self.time_step,
                        approach,
                        since_load: self.time_step,
                        time_step: self.time_step,
                    },
                );
                let stored = law.stored(&cell);
                sum.elastic += stored.elastic;
                sum.plastic += stored.plastic;
                sum.viscous += stored.viscous;
            }
        }
        sums
    }

    /// Masses and velocities of nodes.
    fn masses(&self, nodes: RangeInclusive<usize>) -> impl Iterator<Item = (f64, f64)> + '_ {
        let masses = self.nodes.mass[nodes.clone()].iter().copied();
        masses.zip(self.nodes.velocity[nodes].iter().copied())
    }

    /// Energy balance.
    pub(in crate::fdm) fn energy(&self) -> EnergyLedger {
        let mut kinetic = [0.0; 2];
        for (s, segment) in self.segments.iter().enumerate() {
            let (first, last) = self.span(s);
            for (mass, velocity) in self.masses(first..=last) {
                kinetic[Self::role(segment.body)] += 0.5 * mass * velocity.powi(2);
            }
        }
        let [projectile, target] = self.stored();
        let mut energy = EnergyLedger::default();
        energy.initial = self.accumulated.initial_energy;
        energy.kinetic_projectile = kinetic[0];
        energy.kinetic_target = kinetic[1];
        energy.elastic_projectile = projectile.elastic;
        energy.elastic_target = target.elastic;
        energy.plastic_projectile = projectile.plastic;
        energy.plastic_target = target.plastic;
        energy.border_shear = self.accumulated.friction_work;
        energy.viscous = projectile.viscous + target.viscous;
        energy.contact = self.accumulated.contact_loss;
        energy.boundary = self.accumulated.boundary_work;
        energy
    }

    /// Mass and momentum of the bodies of one role: 0 is the projectile, 1 the target.
    pub(in crate::fdm) fn motion(&self, role: usize) -> (f64, f64) {
        let mut sums = (0.0, 0.0);
        for (s, segment) in self.segments.iter().enumerate() {
            if Self::role(segment.body) == role {
                let (first, last) = self.span(s);
                for (mass, velocity) in self.masses(first..=last) {
                    sums.0 += mass;
                    sums.1 += mass * velocity;
                }
            }
        }
        sums
    }

    /// Momentum balance.
    pub(in crate::fdm) fn momentum(&self) -> MomentumLedger {
        let mut momentum = MomentumLedger::default();
        momentum.initial = self.accumulated.initial_momentum;
        momentum.projectile = self.motion(0).1;
        momentum.target = self.motion(1).1;
        momentum.support = self.accumulated.support_impulse;
        momentum.border_shear = self.accumulated.friction_impulse;
        momentum
    }
}
