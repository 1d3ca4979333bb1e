//! From particles to nodes and back, with the affine velocity field of each particle.

use super::{
    block::Block,
    field::{Field, Node, Strip},
    kernel::{Stencil, Stencils},
    mesh::Places,
};
use crate::{
    lanes::{LANES, Lanes, each_of, lanes, settled},
    solid::MaterialPoints,
};

/// What a particle adds to the nodes around it.
#[derive(Debug, Clone, Copy, Default)]
struct Deposit {
    /// What is to be weighted at the first node, and how it changes from column to column and from row to row.
    corner: Node,
    along_r: Node,
    along_z: Node,
}

/// Adds mass, momentum and forces of the particles of a block to the nodes.
///
/// The gradient of a kernel is its weight times `(4/h²)(x_node − x_particle)`, which the transfer back uses too: so the power of
/// the nodal forces is that of the stress in the particle. The pressures are the mean ones of the particles' groups.
#[inline(always)]
pub(super) fn deposit_block(
    block: &Block,
    pressure: &Lanes,
    places: &Places,
    cell: f64,
    axisymmetric: bool,
    strip: &mut Strip,
) {
    let [radial, axial] = places.index;
    let [stretch_r, stretch_z] = places.stretch;
    let Block {
        position: [radius, _],
        velocity: [v_r, v_z],
        gradient: [rr, rz, zr, zz],
        ..
    } = *block;
    let MaterialPoints {
        deviator: [stress_rr, stress_zz, stress_rz],
        mass,
        volume,
        ..
    } = block.points;
    let (radial, axial) = (
        settled(Stencils::at(&radial)),
        settled(Stencils::at(&axial)),
    );
    let hoop = settled(lanes(|l| {
        if axisymmetric {
            -volume[l] * ((-stress_rr[l] - stress_zz[l]) - pressure[l]) / radius[l]
        } else {
            0.0
        }
    }));
    // Distances are counted in cells, each as large as those at the particle.
    let [r_rr, r_zr, r_pull, r_shear, z_rz, z_zz, z_shear, z_pull] = settled(each_of(|l| {
        let pull = -4.0 / cell * volume[l];
        let (pull_r, pull_z) = (pull / stretch_r[l], pull / stretch_z[l]);
        let (spread_r, spread_z) = (mass[l] * cell * stretch_r[l], mass[l] * cell * stretch_z[l]);
        [
            spread_r * rr[l],
            spread_r * zr[l],
            pull_r * (stress_rr[l] - pressure[l]),
            pull_r * stress_rz[l],
            spread_z * rz[l],
            spread_z * zz[l],
            pull_z * stress_rz[l],
            pull_z * (stress_zz[l] - pressure[l]),
        ]
    }));
    let [c_r, c_z, c_radial, c_axial] = settled(each_of(|l| {
        let (to_r, to_z) = (radial.offset[l], axial.offset[l]);
        [
            mass[l] * v_r[l] + to_r * r_rr[l] + to_z * z_rz[l],
            mass[l] * v_z[l] + to_r * r_zr[l] + to_z * z_zz[l],
            hoop[l] + to_r * r_pull[l] + to_z * z_shear[l],
            0.0 + to_r * r_shear[l] + to_z * z_pull[l],
        ]
    }));
    // All of a block by way of memory: so a node's numbers stay side by side.
    let mut deposits = [Deposit::default(); LANES];
    for (l, deposit) in deposits.iter_mut().enumerate() {
        let (m, v) = (mass[l], volume[l]);
        deposit.corner.0 = [m, c_r[l], c_z[l], v, c_radial[l], c_axial[l], 0.0, 0.0];
        deposit.along_r.0 = [0.0, r_rr[l], r_zr[l], 0.0, r_pull[l], r_shear[l], 0.0, 0.0];
        deposit.along_z.0 = [0.0, z_rz[l], z_zz[l], 0.0, z_shear[l], z_pull[l], 0.0, 0.0];
    }
    let mut patch = Patch::default();
    for (l, deposit) in deposits.iter().enumerate() {
        if mass[l] > 0.0 {
            let (radial, axial) = (radial.of(l), axial.of(l));
            let row = (axial.first - strip.first_row) as usize;
            let first = row * strip.columns + (radial.first + 1) as usize;
            if patch.first != Some(first) {
                patch.add_to(strip);
                patch = Patch {
                    first: Some(first),
                    ..Patch::default()
                };
            }
            patch.add(deposit, &radial, &axial);
        }
    }
    patch.add_to(strip);
}

/// Sums at nine nodes: those of neighbours that reach the same ones are made before they go there.
#[derive(Clone, Copy, Default)]
struct Patch {
    /// Index of the first node; none before there is a particle.
    first: Option<usize>,
    /// By row, then column.
    sums: [[Lanes; 3]; 3],
}

impl Patch {
    #[inline(always)]
    fn add(&mut self, deposit: &Deposit, radial: &Stencil, axial: &Stencil) {
        let (along_r, along_z) = (Lanes(deposit.along_r.0), Lanes(deposit.along_z.0));
        let mut start = Lanes(deposit.corner.0);
        for row in 0..3 {
            let mut value = start;
            for column in 0..3 {
                let weight = radial.weights[column] * axial.weights[row];
                let (sum, added) = (self.sums[row][column], value);
                self.sums[row][column] = lanes(|k| weight.mul_add(added[k], sum[k]));
                value = lanes(|k| added[k] + along_r[k]);
            }
            let before = start;
            start = lanes(|k| before[k] + along_z[k]);
        }
    }

    #[inline(always)]
    fn add_to(&self, strip: &mut Strip) {
        let Some(first) = self.first else {
            return;
        };
        for row in 0..3 {
            let at = first + row * strip.columns;
            let nodes: &mut [Node] = &mut strip.nodes[at..at + 3];
            for (node, sum) in nodes.iter_mut().zip(&self.sums[row]) {
                for (entry, more) in node.iter_mut().zip(&**sum) {
                    *entry += more;
                }
            }
        }
    }
}

/// Motion of the nodes at a place: radial and axial velocity after their step, and both before it.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Motion {
    pub(super) velocity: [f64; 4],
    /// Derivatives by the index along the radius and along the axis, over four.
    pub(super) along_r: [f64; 4],
    pub(super) along_z: [f64; 4],
}

/// Motion of the nodes at a place given by its stencils.
#[inline(always)]
pub(super) fn gather([radial, axial]: [Stencil; 2], field: &Field) -> Motion {
    let first =
        (axial.first - field.first_row) as usize * field.columns + (radial.first + 1) as usize;
    let mut motion = Motion::default();
    for row in 0..3 {
        let at = first + row * field.columns;
        let nodes = &field.velocity[at..at + 3];
        let [a, b, c] = [nodes[0], nodes[1], nodes[2]];
        let along = |by: [f64; 3]| fused(by[2], c, fused(by[1], b, scaled(by[0], a)));
        let (sum, arms) = (along(radial.weights), along(radial.arms));
        motion.velocity = fused(axial.weights[row], sum, motion.velocity);
        motion.along_r = fused(axial.weights[row], arms, motion.along_r);
        motion.along_z = fused(axial.arms[row], sum, motion.along_z);
    }
    motion
}

#[inline(always)]
fn scaled(weight: f64, values: [f64; 4]) -> [f64; 4] {
    let mut scaled = values;
    for value in &mut scaled {
        *value *= weight;
    }
    scaled
}

/// Values times a weight, added to sums.
#[inline(always)]
fn fused(weight: f64, values: [f64; 4], sums: [f64; 4]) -> [f64; 4] {
    let mut fused = sums;
    for (sum, value) in fused.iter_mut().zip(values) {
        *sum = weight.mul_add(value, *sum);
    }
    fused
}
