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
        EnergyLedger {
            initial: accumulated.initial_energy,
            kinetic_projectile: kinetic(false),
            kinetic_target: kinetic(true),
            elastic_projectile: elastic(0),
            elastic_target: elastic(1),
            plastic_projectile: accumulated.work[0][1],
            plastic_target: accumulated.work[1][1],
            viscous: accumulated.work[0][2] + accumulated.work[1][2],
            contact: accumulated.contact,
            boundary: accumulated.boundary,
            eroded: accumulated.lost_energy + accumulated.work[0][3] + accumulated.work[1][3],
            transfer: accumulated.transfer,
            ..EnergyLedger::default()
        }
    }

    /// Momentum balance [N s].
    pub(super) fn momentum(&self) -> MomentumLedger {
        MomentumLedger {
            initial: self.accumulated.initial_momentum,
            projectile: self.sums[0].momentum,
            target: self.sums[1..].iter().map(|sums| sums.momentum).sum(),
            support: self.accumulated.support_impulse,
            eroded: self.accumulated.lost_momentum,
            ..MomentumLedger::default()
        }
    }
}
