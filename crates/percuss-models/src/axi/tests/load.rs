//! Slow loading of a body by a pressure on one of its faces.

use super::{Body, Grid, change};
use crate::{
    axi::{
        field::{FORCE, MOMENTUM},
        kernel::Stencil,
    },
    solver::Particle,
};

/// A part between 1 on the loaded face and 0 on all others, and its gradient [1/m].
pub(super) type Part<'a> = &'a dyn Fn([f64; 2]) -> (f64, [f64; 2]);

/// Adds a pressure on a face to the nodes, as Gauss's theorem has it: its power is that of `p φ` as a tension and of `−p ∇φ` as a
/// force per volume. No node without mass gets a force.
fn press(body: &mut Body, cell: f64, pressure: f64, part: Part<'_>) {
    let particles: Vec<Particle> = body.particles().collect();
    let field = &mut body.field;
    for particle in &particles {
        let [radius, depth] = particle.position;
        let (share, slope) = part(particle.position);
        let (radial, axial) = (Stencil::at(radius / cell), Stencil::at(depth / cell));
        for (row, column) in (0..9).map(|node| (node / 3, node % 3)) {
            let weight = radial.weights[column] * axial.weights[row];
            let arm = [radial.offset + column as f64, axial.offset + row as f64];
            let hoop = if body.law.axisymmetric {
                [weight / radius, 0.0]
            } else {
                [0.0; 2]
            };
            let force = [0, 1].map(|k| {
                let gradient = weight * 4.0 / cell * arm[k] + hoop[k];
                -particle.volume * pressure * (share * gradient + slope[k] * weight)
            });
            let place = (radial.first + 1) as usize + column;
            let (place, sign) = match place {
                0 => (2, -1.0),
                1 => (1, 0.0),
                _ => (place, 1.0),
            };
            if let Some(index) = field.index(axial.first + row as isize, place) {
                field.nodes[index][FORCE] += sign * force[0];
                field.nodes[index][FORCE + 1] += force[1];
            }
        }
    }
}

/// How a pressure is brought up.
pub(super) struct Loading {
    /// Final pressure [Pa].
    pub(super) pressure: f64,
    /// Time in which it rises, and half of which it stays [s].
    pub(super) rise: f64,
    /// Damping of all motion [1/s].
    pub(super) damping: f64,
}

/// Loads the only body of a solver and lets it come to rest; gives each particle before and after.
pub(super) fn load(
    solver: &mut Grid,
    loading: &Loading,
    part: Part<'_>,
) -> Vec<(Particle, Particle)> {
    let before: Vec<Particle> = solver.bodies[0].particles().collect();
    while solver.time < 1.5 * loading.rise {
        assert!(solver.take_over());
        let ramp = (solver.time / loading.rise).min(1.0);
        // A smooth rise starts no waves.
        let pressure = loading.pressure * ramp * ramp * (3.0 - 2.0 * ramp);
        let cell = solver.mesh.cell;
        press(&mut solver.bodies[0], cell, pressure, part);
        let kept = 1.0 - loading.damping * solver.time_step;
        for node in &mut solver.bodies[0].field.nodes {
            node[MOMENTUM] *= kept;
            node[MOMENTUM + 1] *= kept;
        }
        change(&mut solver.bodies[0], |particle| {
            particle.velocity = particle.velocity.map(|speed| kept * speed);
            particle.gradient = particle.gradient.map(|rate| kept * rate);
        });
        solver.move_nodes();
    }
    let after: Vec<Particle> = solver.bodies[0].particles().collect();
    let same = |(b, a): (&Particle, &Particle)| b.mass.to_bits() == a.mass.to_bits();
    assert!(before.iter().zip(&after).all(same), "the order has changed");
    before.into_iter().zip(after).collect()
}
