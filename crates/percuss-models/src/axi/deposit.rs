//! Particles to nodes.

use super::{
    advance::{of_block, set_block, share_means},
    body::{Chunk, Task},
    kernel::nearest,
    mesh::Mesh,
    transfer::deposit_block,
};
use crate::lanes::{LANES, lanes};

/// Adds the particles of a chunk to its nodes.
pub(super) fn deposit(task: &mut Task<'_>, mesh: &Mesh) {
    pulp::Arch::new().dispatch(ToNodes { task, mesh });
}

struct ToNodes<'a, 'b> {
    task: &'a mut Task<'b>,
    mesh: &'a Mesh,
}

impl pulp::NullaryFnOnce for ToNodes<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { task, mesh } = self;
        let Task {
            blocks, chunk, law, ..
        } = task;
        let Chunk {
            group_ends,
            strip,
            scratch,
        } = &mut **chunk;
        let (weights, [_, pressures, _]) = (&mut scratch.weights, &mut scratch.means);
        weights.resize(blocks.len() * LANES, 0.0);
        pressures.resize(blocks.len() * LANES, 0.0);
        let (mut least, mut most, mut widest) = (f64::INFINITY, f64::NEG_INFINITY, 0.0_f64);
        for (number, block) in blocks.iter().enumerate() {
            let sound = block.sound();
            let (pressure, viscous) = (&block.pressure, &block.viscous_pressure);
            let present = |l: usize, value: f64, other: f64| {
                if block.mass[l] > 0.0 { value } else { other }
            };
            set_block(weights, number, &lanes(|l| sound[l] * block.volume[l]));
            set_block(
                pressures,
                number,
                &lanes(|l| present(l, pressure[l] + viscous[l], 0.0)),
            );
            let [radius, depth] = &block.position;
            for l in 0..LANES {
                least = least.min(present(l, depth[l], f64::INFINITY));
                most = most.max(present(l, depth[l], f64::NEG_INFINITY));
                widest = widest.max(present(l, radius[l], 0.0));
            }
        }
        if least > most {
            strip.open(0, 0, 0);
            return;
        }
        share_means(weights, std::array::from_mut(pressures), group_ends);
        let [columns, first] = mesh.indices([widest, least]).map(|index| nearest(index).1);
        let [_, last] = mesh.indices([widest, most]).map(|index| nearest(index).1);
        strip.open(first - 1, (last - first) as usize + 3, columns as usize + 3);
        for (number, block) in blocks.iter().enumerate() {
            deposit_block(
                block,
                &of_block(pressures, number),
                &mesh.places(&block.position),
                mesh.cell,
                law.axisymmetric,
                strip,
            );
        }
    }
}
