//! Particles to nodes.

use super::{
    advance::{means, note, share_means},
    body::{Chunk, Task},
    kernel::nearest,
    mesh::Mesh,
    transfer::deposit_block,
};
use crate::lanes::{Lanes, lanes, larger, smaller};

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
        shares.resize(blocks.len(), [Lanes::all(0.0); 2]);
        let (mut least, mut most) = (Lanes::all(f64::INFINITY), Lanes::all(f64::NEG_INFINITY));
        let mut widest = Lanes::all(0.0);
        for (number, block) in blocks.iter().enumerate() {
            note(&mut shares[number], block, [&block.whole_pressure()]);
            let ([radius, depth], mass) = (block.position, block.mass);
            let (lower, upper, wide) = (least, most, widest);
            let present = |new: f64, l: usize, old: f64| if mass[l] > 0.0 { new } else { old };
            least = lanes(|l| present(smaller(lower[l], depth[l]), l, lower[l]));
            most = lanes(|l| present(larger(upper[l], depth[l]), l, upper[l]));
            widest = lanes(|l| present(larger(wide[l], radius[l]), l, wide[l]));
        }
        let least = least.iter().copied().fold(f64::INFINITY, smaller);
        let most = most.iter().copied().fold(f64::NEG_INFINITY, larger);
        let widest = widest.iter().copied().fold(0.0, larger);
        if least > most {
            strip.open(0, 0, 0);
            return;
        }
        share_means(shares, group_ends);
        let [columns, first] = mesh.indices([widest, least]).map(|index| nearest(index).1);
        let [_, last] = mesh.indices([widest, most]).map(|index| nearest(index).1);
        strip.open(first - 1, (last - first) as usize + 3, columns as usize + 3);
        for (number, block) in blocks.iter().enumerate() {
            let [pressure] = means(&shares[number], block, [block.whole_pressure()]);
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
