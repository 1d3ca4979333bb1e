//! Reflection of waves at non-reflecting faces.

use std::f64::consts::PI;

use super::{Body, Grid, Particle, Solid, body, change, rectangle, supported_at};
use crate::axi::boundary::{BoundaryCondition, BoundaryConditions};

const SPEED: f64 = 1.0;

fn steel() -> Solid {
    Solid::elastic(7850.0, 200e9, 0.3)
}

/// Modulus of uniaxial strain [Pa], and speeds of longitudinal and of shear waves [m/s].
fn waves() -> (f64, [f64; 2]) {
    let solid = steel();
    let modulus = solid.bulk_modulus + 4.0 / 3.0 * solid.shear_modulus;
    let speed = |modulus: f64| (modulus / solid.density).sqrt();
    (modulus, [speed(modulus), speed(solid.shear_modulus)])
}

fn open_face() -> BoundaryCondition {
    BoundaryCondition::NonReflecting {
        impedance: waves().1.map(|speed| steel().density * speed),
        stiffness: 0.0,
    }
}

/// A smooth hump between two places, and its slope.
fn hump(place: f64, (from, to): (f64, f64)) -> (f64, f64) {
    if !(from..to).contains(&place) {
        return (0.0, 0.0);
    }
    let number = 2.0 * PI / (to - from);
    let phase = number * (place - from);
    (
        0.5 * SPEED * (1.0 - phase.cos()),
        0.5 * SPEED * number * phase.sin(),
    )
}

/// Gives a body whose velocities are those of a wave along a direction, 0 the radius and 1 the depth, the stresses of one that goes
/// that way: `σ = −ρ c v`.
fn make_outgoing(body: &mut Body, direction: usize) {
    let (modulus, [speed, _]) = waves();
    let bulk_modulus = body.law.bulk_modulus;
    change(body, |particle| {
        let strain = -particle.velocity[direction] / speed;
        let stress = modulus * strain;
        particle.pressure = -bulk_modulus * strain;
        let across = -0.5 * (stress + particle.pressure);
        particle.deviator = [across, across, 0.0];
        particle.deviator[direction] = stress + particle.pressure;
        particle.mass *= 1.0 - strain;
    });
}

/// Root of the mean square of the velocities of particles that are inside.
fn strength(solver: &Grid, inside: impl Fn(&Particle) -> bool) -> f64 {
    let particles = solver.bodies[0].particles().filter(|p| inside(p));
    let (sum, mass) = particles.fold((0.0, 0.0), |(sum, mass), p| {
        let [radial, axial] = p.velocity;
        (
            sum + p.mass * (radial * radial + axial * axial),
            mass + p.mass,
        )
    });
    (sum / mass).sqrt()
}

/// Part of a wave's amplitude that is left when all of it should have gone.
fn left(mut solver: Grid, inside: impl Fn(&Particle) -> bool) -> f64 {
    let before = strength(&solver, &inside);
    while solver.time < DURATION * LENGTH / waves().1[0] {
        assert!(solver.advance());
    }
    assert!(solver.energy().residual().abs() < 1e-2);
    strength(&solver, &inside) / before
}

/// Length that holds the wave at the start [m], and the time that is waited, in the time that a wave needs for it.
const LENGTH: f64 = 0.1;
const DURATION: f64 = 1.2;
/// Courant number, part that may come back times cells, and cells that the wave has at the start: at the default number dashpots lag more.
const MESHES: [(f64, f64, f64); 6] = [
    (0.5, 2.0, 10.0),
    (0.5, 2.0, 20.0),
    (0.5, 2.0, 40.0),
    (0.7, 2.4, 10.0),
    (0.7, 2.4, 20.0),
    (0.7, 2.4, 40.0),
];

#[test]
fn a_wave_leaves_through_a_back_face() {
    for (courant, most, cells) in MESHES {
        let cell = LENGTH / cells;
        let motion = |[_, depth]: [f64; 2]| {
            let (speed, slope) = hump(depth, (0.1 * LENGTH, 0.9 * LENGTH));
            ([0.0, speed], [0.0, 0.0, 0.0, slope])
        };
        // So wide that nothing comes back from the side meanwhile.
        let radius = 1.4 * LENGTH;
        let sections = rectangle((0.0, radius), (0.0, LENGTH), 0.5 * cell);
        let mut slab = body(steel().law(), sections, &motion);
        make_outgoing(&mut slab, 1);
        let supports = BoundaryConditions {
            back: (cells as isize, open_face()),
            ..BoundaryConditions::NONE
        };
        let solver = supported_at(courant, vec![slab], vec![supports], cell);
        let left = left(solver, |p| p.position[0] < 0.1 * LENGTH);
        println!(
            "rear face, Courant {courant}, {cells} cells: {:.2} % comes back",
            100.0 * left
        );
        assert!(left < most / cells);
    }
}

#[test]
fn a_wave_leaves_through_an_edge() {
    const RADIUS: f64 = 0.3;
    for (courant, most, cells) in MESHES {
        let cell = LENGTH / cells;
        let from = RADIUS - LENGTH;
        let motion = |[radius, _]: [f64; 2]| {
            let (speed, slope) = hump(radius, (from + 0.1 * LENGTH, from + 0.9 * LENGTH));
            ([speed, 0.0], [slope, 0.0, 0.0, 0.0])
        };
        let half = 1.4 * LENGTH;
        let sections = rectangle((from, RADIUS), (-half, half), 0.5 * cell);
        let mut block = body(steel().law(), sections, &motion);
        make_outgoing(&mut block, 0);
        let supports = BoundaryConditions {
            edge: ((RADIUS / cell).round() as usize + 1, open_face()),
            ..BoundaryConditions::NONE
        };
        let solver = supported_at(courant, vec![block], vec![supports], cell);
        let left = left(solver, |p| p.position[1].abs() < 0.1 * LENGTH);
        println!(
            "edge, Courant {courant}, {cells} cells: {:.2} % comes back",
            100.0 * left
        );
        assert!(left < most / cells);
    }
}
