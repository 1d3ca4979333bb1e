//! Openings of plates.

use super::{Body, Mesh, Particle, Solid, body, rectangle};
use crate::{axi::opening::is_open, solver::Control};

/// A plate of 30 by 12 cells, of which some particles have failed.
fn plate(failed: impl Fn([f64; 2]) -> bool) -> Body {
    disc(30.0, failed)
}

/// The same with another radius.
fn disc(radius: f64, failed: impl Fn([f64; 2]) -> bool) -> Body {
    let law = Solid::elastic(7850.0, 200e9, 0.3).law();
    let sections = rectangle((0.0, radius), (0.0, 12.0), 0.5);
    let mut body = body(law, sections, &|_| ([0.0; 2], [0.0; 4]));
    let mut particles: Vec<Particle> = body.particles().collect();
    for particle in &mut particles {
        particle.damage = f64::from(u8::from(failed(particle.position)));
    }
    body.set_particles(&particles, &mut Control::default())
        .unwrap();
    body
}

#[test]
fn a_plate_is_open_where_a_band_cuts_it_through_or_nothing_is_left_at_the_axis() {
    let mesh = Mesh::even(1.0);
    let open = |failed: fn([f64; 2]) -> bool| is_open(&plate(failed), &mesh, 9.0);
    assert!(!open(|_| false));
    // A band of three cells lies between particles that reach no common node; across a narrower one they still move together.
    assert!(open(|[r, _]| (9.0..12.0).contains(&r)));
    assert!(!open(|[r, _]| (9.0..10.0).contains(&r)));
    // A rest of its thickness holds the plug.
    assert!(!open(|[r, z]| (9.0..12.0).contains(&r) && z < 10.0));
    // A step in the band does not join its sides.
    assert!(open(|[r, z]| {
        let from = if z < 6.0 { 9.0 } else { 12.0 };
        (from..from + 3.0).contains(&r) || ((4.5..7.5).contains(&z) && (9.0..15.0).contains(&r))
    }));
    // A hole, with petals or without.
    assert!(open(|[r, _]| r < 3.0));
    assert!(!open(|[r, z]| r < 3.0 && z < 6.0));
    // A disc of less than two radii is held together by its rim.
    let open = |failed: fn([f64; 2]) -> bool| is_open(&disc(15.0, failed), &mesh, 9.0);
    assert!(!open(|_| false) && open(|[r, _]| r < 3.0));
    assert!(open(|[r, _]| (9.0..12.0).contains(&r)));
    // What is cut off beyond two radii of the projectile is no plug.
    let open = |failed: fn([f64; 2]) -> bool| is_open(&plate(failed), &mesh, 9.0);
    assert!(!open(|[r, _]| (24.0..27.0).contains(&r)));
}
