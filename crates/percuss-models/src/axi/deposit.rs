//! Particles to nodes.

use super::{
    advance::{means, note, share_means},
    body::{Chunk, Task},
    kernel::nearest,
    mesh::Mesh,
    transfer::deposit_block,
};
use crate::lanes::{LANES, Lanes, lanes, larger, settled, smaller};

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
            let ([radius, depth], mass) = (block.position, block.mass);
            let or = |values: &Lanes, other: f64| {
                let values = *values;
                settled(lanes(|l| if mass[l] > 0.0 { values[l] } else { other }))
            };
            for depth in *or(&depth, f64::INFINITY) {
                least = smaller(least, depth);
            }
            for depth in *or(&depth, f64::NEG_INFINITY) {
                most = larger(most, depth);
            }
            for radius in *or(&radius, 0.0) {
                widest = larger(widest, radius);
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
