//! Energy and momentum books of the bodies.

use super::solver::Grid;
use crate::ledger::{EnergyLedger, MomentumLedger};

impl Grid {
    /// Energy book [J].
    pub(super) fn energy(&self) -> EnergyLedger {
        let books = &self.books;
        let kinetic = |target: bool| -> f64 {
            let own = self
                .sums
                .iter()
                .enumerate()
                .filter(|(index, _)| (*index > 0) == target);
            own.map(|(_, sums)| sums.kinetic).sum()
        };
        let elastic = |role: usize| {
            let [total, plastic, viscous, failure] = books.work[role];
            total - plastic - viscous - failure
        };
        EnergyLedger {
            initial: books.initial_energy,
            kinetic_projectile: kinetic(false),
            kinetic_target: kinetic(true),
            elastic_projectile: elastic(0),
            elastic_target: elastic(1),
            plastic_projectile: books.work[0][1],
            plastic_target: books.work[1][1],
            viscous: books.work[0][2] + books.work[1][2],
            contact: books.contact,
            boundary: books.boundary,
            eroded: books.lost_energy + books.work[0][3] + books.work[1][3],
            transfer: books.transfer,
            ..EnergyLedger::default()
        }
    }

    /// Momentum book [N s].
    pub(super) fn momentum(&self) -> MomentumLedger {
        MomentumLedger {
            initial: self.books.initial_momentum,
            projectile: self.sums[0].momentum,
            target: self.sums[1..].iter().map(|sums| sums.momentum).sum(),
            support: self.books.support_impulse,
            eroded: self.books.lost_momentum,
            ..MomentumLedger::default()
        }
    }
}
