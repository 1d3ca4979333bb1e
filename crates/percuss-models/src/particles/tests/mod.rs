//! Exact tests of the lattice and of its contact with rigid bodies.

mod balls;
mod contact;
mod cracks;
mod cubic;
mod cubic_cracks;
mod debris;
mod flight;
mod fracture;
mod lattice;
mod motion;
mod orientation;
mod packing;
mod two_notches;

use super::{
    body::{Body, Rows},
    lattice::Solid,
    packing::Packing,
};
use crate::particles::bonded::Bonded;
use crate::{options::Space, solver::Control};

/// Glass of a Poisson's ratio.
pub(super) fn solid(poissons_ratio: f64) -> Solid {
    Solid {
        density: 2500.0,
        youngs_modulus: 70e9,
        poissons_ratio,
    }
}

/// A strip with a spacing of 1 mm.
pub(super) fn strip(space: Space, ratio: f64, rows: usize, particles: usize) -> Body {
    let lattice = solid(ratio).lattice(space, 1e-3);
    Body::strip(
        lattice,
        Rows {
            count: rows,
            particles,
        },
        0.0,
        Packing::Regular,
        &mut Control::default(),
    )
    .unwrap()
}

/// Sets the displacement of every particle as a function of its position.
pub(super) fn displace(body: &mut Body, of: impl Fn([f64; 2]) -> [f64; 2]) {
    let particles: Vec<_> = body.particles().collect();
    for (row, place) in particles {
        let [x, z] = of(body.reference(row, place));
        body.state[row].x[place] = x;
        body.state[row].z[place] = z;
    }
}

/// Force on every particle: what a step of 1 s adds to its momentum, from rest.
pub(super) fn forces(body: &Body) -> Vec<(usize, usize, [f64; 3])> {
    let mut moved = body.clone();
    moved.advance(1.0, &[]);
    let of = |(row, place): (usize, usize)| {
        let (make, motion) = (&body.rows[row], &moved.motion[row]);
        let force = [
            motion.x[place] * make.mass[place],
            motion.z[place] * make.mass[place],
            motion.spin[place] / make.inverse_inertia[place],
        ];
        (row, place, force)
    };
    body.particles().map(of).collect()
}
