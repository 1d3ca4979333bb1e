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
    /// the nodal forces is that of the stress in the particle.
    #[inline(always)]
    pub(super) fn of(particle: &Particle, per_cell: f64, axisymmetric: bool) -> Self {
        let [radius, depth] = particle.position;
        let radial = Stencil::at(radius * per_cell);
        let axial = Stencil::at(depth * per_cell);
        let mass = particle.mass;
        let [v_r, v_z] = particle.velocity;
        let cell = 1.0 / per_cell;
        let pressure = particle.pressure + particle.viscous_pressure;
        let stress = particle.deviator;
        // Distances below are counted in cells.
        let pull = -4.0 * per_cell * particle.volume;
        let hoop = if axisymmetric {
            -particle.volume * (particle.hoop_deviator() - pressure) / radius
        } else {
            0.0
        };
        let spread = mass * cell;
        let [rr, rz, zr, zz] = particle.gradient;
        let (c_rr, c_rz, c_zr, c_zz) = (spread * rr, spread * rz, spread * zr, spread * zz);
        let (s_rr, s_zz, s_rz) = (
            pull * (stress[0] - pressure),
            pull * (stress[1] - pressure),
            pull * stress[2],
        );
        let volume = particle.volume;
        let middle = [mass, mass * v_r, mass * v_z, volume, hoop, 0.0, 0.0, 0.0];
        let along_r = [0.0, c_rr, c_zr, 0.0, s_rr, s_rz, 0.0, 0.0];
        let along_z = [0.0, c_rz, c_zz, 0.0, s_rz, s_zz, 0.0, 0.0];
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

/// The velocity at a place, and its derivatives along the radius and along the axis, from the nodes around it.
#[inline(always)]
pub(super) fn gather(position: [f64; 2], per_cell: f64, field: &Field) -> [f64; 6] {
    let radial = Stencil::at(position[0] * per_cell);
    let axial = Stencil::at(position[1] * per_cell);
    let first =
        (axial.first - field.first_row) as usize * field.columns + (radial.first + 1) as usize;
    // Radial and axial velocity: summed up, and each with its arm along the radius.
    let mut total = [0.0; 4];
    let mut along_z = [0.0; 2];
    for row in 0..3 {
        let at = first + row * field.columns;
        let nodes = &field.velocity[at..at + 3];
        let mut sum = [0.0; 4];
        for (column, [v_r, v_z]) in nodes.iter().enumerate() {
            let weight = radial.weights[column];
            let arm = weight * (radial.offset + column as f64);
            let weights = [weight, weight, arm, arm];
            let values = [v_r, v_z, v_r, v_z];
            for k in 0..4 {
                sum[k] += weights[k] * values[k];
            }
        }
        let weight = axial.weights[row];
        let arm = weight * (axial.offset + row as f64);
        for k in 0..4 {
            total[k] += weight * sum[k];
        }
        for k in 0..2 {
            along_z[k] += arm * sum[k];
        }
    }
    [
        total[0], total[1], total[2], total[3], along_z[0], along_z[1],
    ]
}
