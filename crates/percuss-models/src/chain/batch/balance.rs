//! The balances of every lane.

use super::bundle::Bundle;
use crate::{
    chain::{column::ColumnRun, state::BodySums},
    lanes::{Lanes, PerLane},
    solver::AttemptError,
};

impl Bundle {
    /// Energy and momentum of projectile and target.
    #[inline(always)]
    pub(super) fn sums(&self) -> [BodySums<Lanes>; 2] {
        let mut sums = [BodySums::default(); 2];
        for (b, body) in self.bodies.iter().enumerate() {
            let elements = self.mesh.elements_of(b);
            let nodes = elements.start + b..=elements.end + b;
            let mut of_body = BodySums::<Lanes>::default();
            for (node, mass) in self.nodes[nodes.clone()].iter().zip(&self.masses[nodes]) {
                of_body.add_node(mass, &node.velocity);
            }
            for spring in &self.springs[elements] {
                of_body.add_spring(spring, &body.volume, &body.flow.modulus);
            }
            sums[b] = of_body;
        }
        sums
    }

    /// Has the single run audit a lane.
    pub(super) fn audit(
        &self,
        lane: usize,
        sums: &[BodySums<Lanes>; 2],
        run: &mut ColumnRun<'_>,
    ) -> Result<(), AttemptError> {
        self.scalars.lane(lane).store(run);
        let (sums, state) = (sums.lane(lane), &run.solver.state);
        let (energy, momentum) = (state.energy_of(&sums), state.momentum_of(&sums));
        run.audit(energy, momentum)
    }
}
