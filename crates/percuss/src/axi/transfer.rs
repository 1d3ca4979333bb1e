//! From particles to nodes and back, with the affine velocity field of each particle.

use super::{
    field::{Field, Node, Strip},
    kernel::Stencil,
    particle::Particle,
};

/// Adds a particle's mass, momentum and forces to the nodes around it.
///
/// The gradient of a kernel is its weight times `(4/h²)(x_node − x_particle)`, which the transfer back uses too: so the power of
/// the nodal forces is that of the stress in the particle.
#[inline(always)]
pub(super) fn scatter(particle: &Particle, per_cell: f64, axisymmetric: bool, strip: &mut Strip) {
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
    let [c_rr, c_rz, c_zr, c_zz] = particle.gradient.map(|entry| mass * cell * entry);
    let (s_rr, s_zz, s_rz) = (
        pull * (stress[0] - pressure),
        pull * (stress[1] - pressure),
        pull * stress[2],
    );
    let middle: Node = [mass, mass * v_r, mass * v_z, particle.volume, hoop, 0.0];
    let along_r: Node = [0.0, c_rr, c_zr, 0.0, s_rr, s_rz];
    let along_z: Node = [0.0, c_rz, c_zz, 0.0, s_rz, s_zz];
    let corner: Node =
        std::array::from_fn(|k| middle[k] + radial.offset * along_r[k] + axial.offset * along_z[k]);
    let first =
        (axial.first - strip.first_row) as usize * strip.columns + (radial.first + 1) as usize;
    // The first node of the row, then on by one node at a time.
    let mut start = corner;
    for row in 0..3 {
        let at = first + row * strip.columns;
        let nodes: &mut [Node] = &mut strip.nodes[at..at + 3];
        let mut value = start;
        for (column, node) in nodes.iter_mut().enumerate() {
            let weight = radial.weights[column] * axial.weights[row];
            for k in 0..6 {
                node[k] += weight * value[k];
                value[k] += along_r[k];
            }
        }
        for k in 0..6 {
            start[k] += along_z[k];
        }
    }
}

/// Takes the velocity at a particle and its gradient from the nodes around it.
#[inline(always)]
pub(super) fn gather(particle: &mut Particle, per_cell: f64, field: &Field) {
    let radial = Stencil::at(particle.position[0] * per_cell);
    let axial = Stencil::at(particle.position[1] * per_cell);
    let first =
        (axial.first - field.first_row) as usize * field.columns + (radial.first + 1) as usize;
    let mut velocity = [0.0; 2];
    let mut along_r = [0.0; 2];
    let mut along_z = [0.0; 2];
    for row in 0..3 {
        let at = first + row * field.columns;
        let nodes = &field.velocity[at..at + 3];
        let mut sum = [0.0; 2];
        let mut moment = [0.0; 2];
        for (column, node) in nodes.iter().enumerate() {
            let weight = radial.weights[column];
            let arm = weight * (radial.offset + column as f64);
            for k in 0..2 {
                sum[k] += weight * node[k];
                moment[k] += arm * node[k];
            }
        }
        let weight = axial.weights[row];
        let arm = weight * (axial.offset + row as f64);
        for k in 0..2 {
            velocity[k] += weight * sum[k];
            along_r[k] += weight * moment[k];
            along_z[k] += arm * sum[k];
        }
    }
    let scale = 4.0 * per_cell;
    particle.velocity = velocity;
    particle.gradient = [
        scale * along_r[0],
        scale * along_z[0],
        scale * along_r[1],
        scale * along_z[1],
    ];
}
