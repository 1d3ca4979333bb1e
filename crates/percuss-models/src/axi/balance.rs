//! Energy and momentum balances of the bodies.

use super::solver::Grid;
use crate::ledger::{EnergyLedger, MomentumLedger};

impl Grid {
    /// Energy balance [J].
    pub(super) fn energy(&self) -> EnergyLedger {
        let accumulated = &self.accumulated;
        let kinetic = |target: bool| -> f64 {
            let own = self
                .sums
                .iter()
                .enumerate()
                .filter(|(index, _)| (*index > 0) == target);
            own.map(|(_, sums)| sums.kinetic).sum()
        };
        let elastic = |role: usize| {
            let [total, plastic, viscous, failure] = accumulated.work[role];
            total - plastic - viscous - failure
        };
        let mut energy = EnergyLedger::default();
        energy.initial = accumulated.initial_energy;
        energy.kinetic_projectile = kinetic(false);
        energy.kinetic_target = kinetic(true);
        energy.elastic_projectile = elastic(0);
        energy.elastic_target = elastic(1);
        energy.plastic_projectile = accumulated.work[0][1];
        energy.plastic_target = accumulated.work[1][1];
        energy.viscous = accumulated.work[0][2] + accumulated.work[1][2];
        energy.contact = accumulated.contact;
        energy.boundary = accumulated.boundary;
        energy.eroded = accumulated.lost_energy + accumulated.work[0][3] + accumulated.work[1][3];
        energy.transfer = accumulated.transfer;
        energy
    }

    /// Momentum balance [N s].
    pub(super) fn momentum(&self) -> MomentumLedger {
        let mut momentum = MomentumLedger::default();
        momentum.initial = self.accumulated.initial_momentum;
        momentum.projectile = self.sums[0].momentum;
        momentum.target = self.sums[1..].iter().map(|sums| sums.momentum).sum();
        momentum.support = self.accumulated.support_impulse;
        momentum.eroded = self.accumulated.lost_momentum;
        momentum
    }
}
