//! Openings of plates.

use super::{Body, Mesh, Particle, Solid, body, rectangle};
use crate::axi::opening::is_open;

/// A plate of 10 by 4 cells, of which some particles have failed.
fn plate(failed: impl Fn(&Particle) -> bool) -> Body {
    let law = Solid::elastic(7850.0, 200e9, 0.3).law();
    let sections = rectangle((0.0, 10.0), (0.0, 4.0), 0.5);
    let mut body = body(law, sections, &|_| ([0.0; 2], [0.0; 4]));
    let mut particles: Vec<Particle> = body.particles().collect();
    for particle in &mut particles {
        particle.damage = f64::from(u8::from(failed(particle)));
    }
    body.set_particles(&particles);
    body
}

#[test]
fn a_plate_is_open_where_a_band_cuts_it_through_or_nothing_is_left_at_the_axis() {
    let mesh = Mesh::even(1.0);
    let open = |failed: fn(&Particle) -> bool| is_open(&plate(failed), &mesh, 3.0);
    let in_band = |p: &Particle| (3.0..4.0).contains(&p.position[0]);
    assert!(!open(|_| false));
    assert!(open(in_band));
    // One row of cells still holds the plug.
    assert!(!open(
        |p| (3.0..4.0).contains(&p.position[0]) && p.position[1] < 3.0
    ));
    // A step in the band does not join its sides.
    assert!(open(|p| {
        let [r, z] = p.position;
        let column = if z < 2.0 { 3.0 } else { 4.0 };
        (column..column + 1.0).contains(&r) || ((1.0..3.0).contains(&z) && (3.0..5.0).contains(&r))
    }));
    // A hole with petals that stay on the plate.
    assert!(open(|p| p.position[0] < 1.0));
    assert!(!open(|p| p.position[0] < 1.0 && p.position[1] < 2.0));
    // What is cut off beyond two radii of the projectile is no plug.
    assert!(!open(|p| (8.0..9.0).contains(&p.position[0])));
}
