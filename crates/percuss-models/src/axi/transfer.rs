//! From particles to nodes and back, with the affine velocity field of each particle.

use super::{
    block::Block,
    field::{Field, Node, Strip},
    kernel::{Stencil, Stencils},
    mesh::Places,
};
use crate::lanes::{LANES, Lanes, each_of, lanes, settled};

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
        deviator: [stress_rr, stress_zz, stress_rz],
        mass,
        volume,
        ..
    } = *block;
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
    for (l, deposit) in deposits.iter().enumerate() {
        if mass[l] > 0.0 {
            deposit.add_to([radial.of(l), axial.of(l)], strip);
        }
    }
}

impl Deposit {
    /// Adds it to the nodes.
    #[inline(always)]
    fn add_to(&self, [radial, axial]: [Stencil; 2], strip: &mut Strip) {
        let first =
            (axial.first - strip.first_row) as usize * strip.columns + (radial.first + 1) as usize;
        let mut start = self.corner.0;
        for row in 0..3 {
            let at = first + row * strip.columns;
            let nodes: &mut [Node] = &mut strip.nodes[at..at + 3];
            let mut value = start;
            for (column, node) in nodes.iter_mut().enumerate() {
                let weight = radial.weights[column] * axial.weights[row];
                for (entry, value) in node.iter_mut().zip(&value) {
                    *entry += weight * value;
                }
                for (value, step) in value.iter_mut().zip(&*self.along_r) {
                    *value += step;
                }
            }
            for (entry, step) in start.iter_mut().zip(&*self.along_z) {
                *entry += step;
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
        let (mut sum, mut arms) = ([0.0; 4], [0.0; 4]);
        for (column, node) in nodes.iter().enumerate() {
            for k in 0..4 {
                sum[k] += radial.weights[column] * node[k];
                arms[k] += radial.arms[column] * node[k];
            }
        }
        for k in 0..4 {
            motion.velocity[k] += axial.weights[row] * sum[k];
            motion.along_r[k] += axial.weights[row] * arms[k];
            motion.along_z[k] += axial.arms[row] * sum[k];
        }
    }
    motion
}
