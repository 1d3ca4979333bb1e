//! The balances of every lane.

use super::bundle::Bundle;
use crate::{
    chain::{column::ColumnRun, state::BodySums},
    lanes::{LANES, Lanes, PerLane},
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
                let before = of_body;
                for l in 0..LANES {
                    let mut one = before.lane(l);
                    one.add_node(mass.0[l], node.velocity.0[l]);
                    of_body.set_lane(l, one);
                }
            }
            for spring in &self.springs[elements] {
                for l in 0..LANES {
                    let (volume, modulus) = (body.volume.0[l], body.law.modulus.0[l]);
                    of_body.elastic.0[l] += spring.lane(l).elastic_energy(volume, modulus);
                }
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
