//! Particles to nodes.

use super::{
    advance::{means, note, share_means},
    body::{Chunk, Task},
    kernel::nearest,
    mesh::Mesh,
    transfer::deposit_block,
};
use crate::lanes::LANES;

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
        let shares = &mut scratch.pressures;
        shares.resize(blocks.len() * LANES, [0.0; 2]);
        let (mut least, mut most, mut widest) = (f64::INFINITY, f64::NEG_INFINITY, 0.0_f64);
        for (number, block) in blocks.iter().enumerate() {
            note(shares, number, block, [&block.whole_pressure()]);
            let present = |l: usize, value: f64, other: f64| {
                if block.mass[l] > 0.0 { value } else { other }
            };
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
        share_means(shares, group_ends);
        let [columns, first] = mesh.indices([widest, least]).map(|index| nearest(index).1);
        let [_, last] = mesh.indices([widest, most]).map(|index| nearest(index).1);
        strip.open(first - 1, (last - first) as usize + 3, columns as usize + 3);
        for (number, block) in blocks.iter().enumerate() {
            let [pressure] = means(shares, number, block, [block.whole_pressure()]);
            deposit_block(
                block,
                &pressure,
                &mesh.places(&block.position),
                mesh.cell,
                law.axisymmetric,
                strip,
            );
        }
    }
}
