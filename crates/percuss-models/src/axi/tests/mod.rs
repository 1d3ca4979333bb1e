//! Exact checks of the model, one small file per problem. Bodies are filled by hand, so that shapes and initial motions are free.

mod contact;
mod failure;
mod load;
mod opening;
mod outgoing;
mod plane_bar;
mod pressure_dependent;
mod pressurised;
mod rigid_motion;
mod shell_collapse;
mod surface;
mod unresolved;
mod wave_speed;

use std::f64::consts::PI;

use super::{
    block::Block,
    body::{Body, Limits},
    boundary::BoundaryConditions,
    contact::Contact,
    mesh::Mesh,
    solver::{Accumulators, DeferredWork, Grid},
};
use crate::{
    lanes::Lanes,
    material::{FlowState, FlowStress, PreparedStrength},
    solid::{Law, Rates},
    solver::{Control, Particle},
};

/// Elastic, then flow at a constant stress; infinite for a material that never flows.
#[derive(Debug)]
struct PerfectlyPlastic(f64);

impl PreparedStrength for PerfectlyPlastic {
    fn flow_stress(&self, _: &FlowState) -> FlowStress {
        FlowStress {
            stress: self.0,
            ..FlowStress::default()
        }
    }

    fn depends_on_strain_only(&self) -> bool {
        true
    }
}

/// Constants of a test's material.
#[derive(Debug, Clone, Copy)]
struct Solid {
    density: f64,
    bulk_modulus: f64,
    shear_modulus: f64,
    flow_stress: f64,
}

impl Solid {
    /// Elastic, from Young's modulus [Pa] and Poisson's ratio.
    fn elastic(density: f64, youngs_modulus: f64, ratio: f64) -> Self {
        Self {
            density,
            bulk_modulus: youngs_modulus / (3.0 * (1.0 - 2.0 * ratio)),
            shear_modulus: youngs_modulus / (2.0 * (1.0 + ratio)),
            flow_stress: f64::INFINITY,
        }
    }

    /// The law, without artificial viscosity.
    fn law(self) -> Law {
        let moduli = [self.shear_modulus, self.bulk_modulus];
        let strength = Box::new(PerfectlyPlastic(self.flow_stress));
        Law {
            band_width: 0.25e-3,
            axisymmetric: true,
            ..Law::plain(self.density, moduli, strength)
        }
    }
}

/// A velocity and its gradient `[∂v_r/∂r, ∂v_r/∂z, ∂v_z/∂r, ∂v_z/∂z]` at a place.
type Motion<'a> = &'a dyn Fn([f64; 2]) -> ([f64; 2], [f64; 4]);

/// The same velocity everywhere [m/s].
fn uniform(velocity: [f64; 2]) -> impl Fn([f64; 2]) -> ([f64; 2], [f64; 4]) {
    move |_| (velocity, [0.0; 4])
}

/// A body whose particles stand at given places, each with its section's area [m2].
fn body(law: Law, sections: impl IntoIterator<Item = ([f64; 2], f64)>, motion: Motion<'_>) -> Body {
    let particle = |(position, area): ([f64; 2], f64)| {
        let girth = if law.axisymmetric {
            2.0 * PI * position[0]
        } else {
            1.0
        };
        let (velocity, gradient) = motion(position);
        let mut particle = Particle {
            position,
            velocity,
            gradient,
            mass: law.density * girth * area,
            volume: girth * area,
            ..Particle::default()
        };
        particle.yield_point = law.slow_yield_point(&particle);
        particle
    };
    let particles: Vec<Particle> = sections.into_iter().map(particle).collect();
    Body::set_up(law, particles, &mut Control::default()).unwrap()
}

/// Changes all particles of a body.
fn change(body: &mut Body, mut change: impl FnMut(&mut Particle)) {
    let mut particles: Vec<Particle> = body.particles().collect();
    particles.iter_mut().for_each(&mut change);
    body.set_particles(&particles, &mut Control::default())
        .unwrap();
}

/// Brings one particle, whose velocity gradient is new, to the end of a step of 1 s in cells of 1 m; gives work, plastic work and what
/// failed [J].
fn deform(law: &Law, particle: &mut Particle, hoop_rate: f64) -> [f64; 3] {
    let mut block = Block::default();
    block.set_particle(0, particle);
    let rates = Rates::of(&block.gradient, Lanes::all(hoop_rate), 1.0);
    let work = law.deform(&mut block, &rates, 1.0, &Lanes::all(1.0));
    *particle = block.particle(0);
    [work.total, work.plastic, work.failure].map(|lane| lane[0])
}

/// Sections of a rectangle in the plane of radius and depth, in a regular array with about a given spacing.
fn rectangle(
    radius: (f64, f64),
    depth: (f64, f64),
    spacing: f64,
) -> impl Iterator<Item = ([f64; 2], f64)> {
    let count = |(from, to): (f64, f64)| ((to - from) / spacing).round().max(1.0);
    let (columns, rows) = (count(radius), count(depth));
    let (width, height) = ((radius.1 - radius.0) / columns, (depth.1 - depth.0) / rows);
    (0..rows as usize).flat_map(move |row| {
        (0..columns as usize).map(move |column| {
            let place = [
                radius.0 + (column as f64 + 0.5) * width,
                depth.0 + (row as f64 + 0.5) * height,
            ];
            (place, width * height)
        })
    })
}

/// Sections of a spherical shell about the origin: layers of equal thickness, each cut into nearly square pieces.
///
/// The area of a piece is such that the ring has the exact volume.
fn spherical_shell(inner: f64, outer: f64, spacing: f64) -> Vec<([f64; 2], f64)> {
    let layers = ((outer - inner) / spacing).round() as usize;
    let thickness = (outer - inner) / layers as f64;
    let mut sections = Vec::new();
    for layer in 0..layers {
        let from = inner + layer as f64 * thickness;
        let to = from + thickness;
        let middle = 0.5 * (from + to);
        let pieces = (PI * middle / spacing).round() as usize;
        let angle = PI / pieces as f64;
        for piece in 0..pieces {
            let polar = (piece as f64 + 0.5) * angle;
            let band = 2.0 * polar.sin() * (0.5 * angle).sin();
            let volume = 2.0 * PI * (to.powi(3) - from.powi(3)) / 3.0 * band;
            let place = [middle * polar.sin(), middle * polar.cos()];
            sections.push((place, volume / (2.0 * PI * place[0])));
        }
    }
    sections
}

/// A smooth rear face in front of everything: nothing moves along the axis.
const ALL_ROWS: isize = isize::MIN;

/// Bodies without supports, ready to move.
fn solver(bodies: Vec<Body>, cell: f64) -> Grid {
    let supports = vec![BoundaryConditions::NONE; bodies.len()];
    supported(bodies, supports, cell)
}

/// Bodies with supports, ready to move.
fn supported(bodies: Vec<Body>, supports: Vec<BoundaryConditions>, cell: f64) -> Grid {
    supported_at(0.5, bodies, supports, cell)
}

/// The same at a Courant number.
fn supported_at(
    courant: f64,
    bodies: Vec<Body>,
    supports: Vec<BoundaryConditions>,
    cell: f64,
) -> Grid {
    let mut solver = Grid {
        bodies,
        supports,
        contact: Contact::Frictional(0.0),
        surface: None,
        mesh: Mesh::even(cell),
        courant,
        limits: Limits {
            radius: f64::INFINITY,
            back: f64::NEG_INFINITY,
            front: f64::INFINITY,
        },
        step: 0,
        time: 0.0,
        time_step: 0.0,
        travel: 0.0,
        sums: Vec::new(),
        accumulated: Accumulators::default(),
        deferred: DeferredWork::default(),
    };
    solver.start(&mut Control::default()).unwrap();
    solver
}
