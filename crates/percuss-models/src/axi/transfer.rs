//! From particles to nodes and back, with the affine velocity field of each particle.

use super::{
    field::{Field, Node, Strip},
    kernel::Stencil,
};
use crate::solver::Particle;

/// What a particle adds to the nodes around it.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Deposit {
    radial: Stencil,
    axial: Stencil,
    /// What is to be weighted at the first node, and how it changes from column to column and from row to row.
    corner: Node,
    along_r: Node,
    along_z: Node,
}

impl Deposit {
    /// Mass, momentum and forces of a particle.
    ///
    /// The gradient of a kernel is its weight times `(4/h²)(x_node − x_particle)`, which the transfer back uses too: so the power of
    /// the nodal forces is that of the stress in the particle. The pressure is the mean one of the particle's group.
    #[inline(always)]
    pub(super) fn of(
        particle: &Particle,
        pressure: f64,
        ([radial, axial], [stretch_r, stretch_z]): ([f64; 2], [f64; 2]),
        cell: f64,
        axisymmetric: bool,
    ) -> Self {
        let radial = Stencil::at(radial);
        let axial = Stencil::at(axial);
        let mass = particle.mass;
        let [v_r, v_z] = particle.velocity;
        let stress = particle.deviator;
        // Distances below are counted in cells, each as large as those at the particle.
        let pull = -4.0 / cell * particle.volume;
        let (pull_r, pull_z) = (pull / stretch_r, pull / stretch_z);
        let hoop = if axisymmetric {
            -particle.volume * (particle.hoop_deviator() - pressure) / particle.position[0]
        } else {
            0.0
        };
        let (spread_r, spread_z) = (mass * cell * stretch_r, mass * cell * stretch_z);
        let [rr, rz, zr, zz] = particle.gradient;
        let volume = particle.volume;
        let middle = [mass, mass * v_r, mass * v_z, volume, hoop, 0.0, 0.0, 0.0];
        let along_r = [
            0.0,
            spread_r * rr,
            spread_r * zr,
            0.0,
            pull_r * (stress[0] - pressure),
            pull_r * stress[2],
            0.0,
            0.0,
        ];
        let along_z = [
            0.0,
            spread_z * rz,
            spread_z * zz,
            0.0,
            pull_z * stress[2],
            pull_z * (stress[1] - pressure),
            0.0,
            0.0,
        ];
        let mut corner = middle;
        for k in 0..8 {
            corner[k] = corner[k] + radial.offset * along_r[k] + axial.offset * along_z[k];
        }
        Self {
            corner: Node(corner),
            along_r: Node(along_r),
            along_z: Node(along_z),
            radial,
            axial,
        }
    }

    /// Adds it to the nodes.
    #[inline(always)]
    pub(super) fn add_to(&self, strip: &mut Strip) {
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
