//! From particles to nodes and back, with the affine velocity field of each particle.

use super::{
    block::Block,
    field::{Field, Node, Strip},
    kernel::Stencil,
    mesh::Places,
};
use crate::lanes::{LANES, Lanes, each_of, lanes};

/// What a particle adds to the nodes around it.
#[derive(Debug, Clone, Copy, Default)]
struct Deposit {
    radial: Stencil,
    axial: Stencil,
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
    let momentum = [lanes(|l| mass[l] * v_r[l]), lanes(|l| mass[l] * v_z[l])];
    let hoop = lanes(|l| {
        if axisymmetric {
            -volume[l] * ((-stress_rr[l] - stress_zz[l]) - pressure[l]) / radius[l]
        } else {
            0.0
        }
    });
    // Distances are counted in cells, each as large as those at the particle.
    let [r_rr, r_zr, r_pull, r_shear, z_rz, z_zz, z_shear, z_pull] = each_of(|l| {
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
    });
    // All of a block by way of memory: so a node's numbers stay side by side.
    let mut deposits = [Deposit::default(); LANES];
    for (l, deposit) in deposits.iter_mut().enumerate() {
        deposit.radial = Stencil::at(radial[l]);
        deposit.axial = Stencil::at(axial[l]);
        deposit.corner.0 = [
            mass[l],
            momentum[0][l],
            momentum[1][l],
            volume[l],
            hoop[l],
            0.0,
            0.0,
            0.0,
        ];
        deposit.along_r.0 = [0.0, r_rr[l], r_zr[l], 0.0, r_pull[l], r_shear[l], 0.0, 0.0];
        deposit.along_z.0 = [0.0, z_rz[l], z_zz[l], 0.0, z_shear[l], z_pull[l], 0.0, 0.0];
        let (to_r, to_z) = (deposit.radial.offset, deposit.axial.offset);
        for k in 0..8 {
            deposit.corner[k] =
                deposit.corner[k] + to_r * deposit.along_r[k] + to_z * deposit.along_z[k];
        }
    }
    for (l, deposit) in deposits.iter().enumerate() {
        if mass[l] > 0.0 {
            deposit.add_to(strip);
        }
    }
}

impl Deposit {
    /// Adds it to the nodes.
    #[inline(always)]
    fn add_to(&self, strip: &mut Strip) {
        let first = (self.axial.first - strip.first_row) as usize * strip.columns
            + (self.radial.first + 1) as usize;
        let mut start = self.corner.0;
        for row in 0..3 {
            let at = first + row * strip.columns;
            let nodes: &mut [Node] = &mut strip.nodes[at..at + 3];
            let mut value = start;
            for (column, node) in nodes.iter_mut().enumerate() {
                let weight = self.radial.weights[column] * self.axial.weights[row];
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

/// Motion of the nodes at a place given by its indices.
#[inline(always)]
pub(super) fn gather([radial, axial]: [f64; 2], field: &Field) -> Motion {
    let radial = Stencil::at(radial);
    let axial = Stencil::at(axial);
    let first =
        (axial.first - field.first_row) as usize * field.columns + (radial.first + 1) as usize;
    let mut motion = Motion::default();
    for row in 0..3 {
        let at = first + row * field.columns;
        let nodes = &field.velocity[at..at + 3];
        let (mut sum, mut arms) = ([0.0; 4], [0.0; 4]);
        for (column, node) in nodes.iter().enumerate() {
            let weight = radial.weights[column];
            let arm = weight * (radial.offset + column as f64);
            for k in 0..4 {
                sum[k] += weight * node[k];
                arms[k] += arm * node[k];
            }
        }
        let weight = axial.weights[row];
        let arm = weight * (axial.offset + row as f64);
        for k in 0..4 {
            motion.velocity[k] += weight * sum[k];
            motion.along_r[k] += weight * arms[k];
            motion.along_z[k] += arm * sum[k];
        }
    }
    motion
}
