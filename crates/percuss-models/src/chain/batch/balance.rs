//! The balances of every lane: `State::energy` and `State::momentum`.

use super::bundle::Bundle;
use crate::{
    lanes::{LANES, Lanes},
    {chain::column::ColumnRun, solver::AttemptError},
};

/// Energy and momentum of projectile and target in every lane.
#[derive(Default)]
pub(super) struct Sums {
    kinetic: [Lanes; 2],
    elastic: [Lanes; 2],
    momentum: [Lanes; 2],
}

impl Bundle {
    #[inline(always)]
    pub(super) fn sums(&self) -> Sums {
        let mut sums = Sums::default();
        for (b, body) in self.bodies.iter().enumerate() {
            let elements = self.mesh.elements_of(b);
            let nodes = elements.start + b..=elements.end + b;
            let (mut kinetic, mut momentum) = (Lanes::all(0.0), Lanes::all(0.0));
            for (node, mass) in self.nodes[nodes.clone()].iter().zip(&self.masses[nodes]) {
                let (mass, velocity) = (mass.0, node.velocity.0);
                for l in 0..LANES {
                    kinetic.0[l] += 0.5 * mass[l] * velocity[l] * velocity[l];
                    momentum.0[l] += mass[l] * velocity[l];
                }
            }
            let (volume, modulus) = (body.volume.0, body.modulus.0);
            let mut elastic = Lanes::all(0.0);
            for spring in &self.springs[elements] {
                let [stress_before, stress] =
                    [1 - self.now, self.now].map(|i| spring.stress[i & 1].0);
                for l in 0..LANES {
                    elastic.0[l] += volume[l] * stress_before[l] * stress[l] / (2.0 * modulus[l]);
                }
            }
            sums.kinetic[b] = kinetic;
            sums.momentum[b] = momentum;
            sums.elastic[b] = elastic;
        }
        sums
    }

    /// Has the single run audit a lane.
    pub(super) fn audit(
        &self,
        lane: usize,
        sums: &Sums,
        run: &mut ColumnRun<'_>,
    ) -> Result<(), AttemptError> {
        self.scalars.store_lane(lane, run);
        let of = |sums: [Lanes; 2]| sums.map(|sum| sum.0[lane]);
        let energy = run
            .solver
            .state
            .energy_ledger(of(sums.kinetic), of(sums.elastic));
        let momentum = run.solver.state.momentum_ledger(of(sums.momentum));
        run.audit(energy, momentum)
    }
}
