//! Contact of two bodies: elastic bars, friction, and sticking.

use std::f64::consts::PI;

use super::{Solid, Solver, body, rectangle, solver, uniform};
use crate::axi::{body::Body, contact::Contact, law::Law};

const YOUNGS_MODULUS: f64 = 200e9;
const DENSITY: f64 = 7850.0;
const SPEED: f64 = 10.0;

fn steel() -> Law {
    Solid::elastic(DENSITY, YOUNGS_MODULUS, 0.3).law()
}

/// Momentum of a body [kg m/s].
fn momentum(body: &Body) -> [f64; 2] {
    let of = |k: usize| body.particles.iter().map(|p| p.mass * p.velocity[k]).sum();
    [of(0), of(1)]
}

/// Mean velocity of a body [m/s].
fn mean(body: &Body) -> [f64; 2] {
    let mass: f64 = body.particles.iter().map(|p| p.mass).sum();
    momentum(body).map(|momentum| momentum / mass)
}

const LENGTH: f64 = 0.05;
const RADIUS: f64 = 2.5e-3;

/// Two equal bars, the first moving, the second at rest before it.
fn bars(contact: Contact, cells: f64) -> Solver {
    let cell = RADIUS / cells;
    let bar = |depth: (f64, f64), speed: f64| {
        let sections = rectangle((0.0, RADIUS), depth, 0.5 * cell);
        body(steel(), sections, &uniform([0.0, speed]))
    };
    let bodies = vec![bar((-LENGTH, 0.0), SPEED), bar((0.0, LENGTH), 0.0)];
    let mut solver = solver(bodies, cell);
    solver.contact = contact;
    solver
}

/// Time of a wave's way there and back [s].
fn trip() -> f64 {
    2.0 * LENGTH / (YOUNGS_MODULUS / DENSITY).sqrt()
}

#[test]
fn equal_bars_exchange_their_velocities_and_part_after_the_round_trip_of_a_wave() {
    let mut solver = bars(Contact::Frictional(0.0), 4.0);
    let plateau = 0.5 * (YOUNGS_MODULUS * DENSITY).sqrt() * SPEED * PI * RADIUS * RADIUS;
    let (mut opened, mut pushed) = (0.0, 0.0);
    while solver.time < 1.5 * trip() {
        assert!(solver.advance());
        let force = solver.pending.contact_force;
        if force > 0.5 * plateau {
            opened = solver.time;
        }
        if solver.time > 1.3 * trip() {
            pushed += force.abs();
        }
    }
    let [first, second] = [0, 1].map(|index: usize| mean(&solver.bodies[index])[1] / SPEED);
    let (energy, residual) = (solver.energy(), solver.momentum().residual());
    println!(
        "bars: part after {:.3} trips, restitution {:.3}, lost in contact {:.1e}, residual {:.1e}",
        opened / trip(),
        second - first,
        energy.contact / energy.initial,
        energy.residual()
    );
    assert!((opened / trip() - 1.0).abs() < 2e-2);
    assert!(pushed < 1e-9 * plateau);
    // What is missing rings in the bars.
    assert!((0.95..1.0).contains(&(second - first)));
    assert!(energy.residual().abs() < 2e-3 && residual.abs() < 1e-12);
}

#[test]
fn sticking_bars_are_one_bar() {
    let mut solver = bars(Contact::Sticking, 4.0);
    // Free waves bring each half's velocity to the other's after one trip and back after two.
    for (trips, share) in [(1.0, 0.0), (2.0, 1.0)] {
        while solver.time < trips * trip() {
            assert!(solver.advance());
        }
        let velocity = mean(&solver.bodies[0])[1] / SPEED;
        println!("sticking bars after {trips} trips: {velocity:.3}");
        assert!((velocity - share).abs() < 5e-2);
    }
    assert!(solver.energy().residual().abs() < 2e-3);
    assert!(solver.momentum().residual().abs() < 1e-12);
}

/// Two blocks in plane strain during the first round trip of a wave; the first comes in obliquely.
fn slide(contact: Contact) -> Solver {
    const SIDE: f64 = 8e-3;
    let cell = SIDE / 8.0;
    let law = || Law {
        axisymmetric: false,
        ..steel()
    };
    let block = |radius: (f64, f64), depth: (f64, f64), velocity: [f64; 2]| {
        let sections = rectangle(radius, depth, 0.5 * cell);
        body(law(), sections, &uniform(velocity))
    };
    let first = block((4.0 * SIDE, 8.0 * SIDE), (-SIDE, 0.0), [SPEED, SPEED]);
    let second = block((3.0 * SIDE, 9.0 * SIDE), (0.0, SIDE), [0.0; 2]);
    let mut solver = solver(vec![first, second], cell);
    solver.contact = contact;
    // The nodes have moved once without contact of the new kind: nothing has touched yet.
    solver.start();
    let before = momentum(&solver.bodies[0]);
    while solver.time < 1.5 * SIDE / 5000.0 {
        assert!(solver.advance());
    }
    let after = [0, 1].map(|index: usize| momentum(&solver.bodies[index]));
    for k in 0..2 {
        assert!((after[0][k] + after[1][k] - before[k]).abs() < 1e-11 * before[k]);
    }
    assert!(solver.energy().residual().abs() < 5e-3);
    solver
}

/// Momentum along the contact over that across it, passed on by the first block.
fn ratio(solver: &Solver) -> f64 {
    let [along, across] = mean(&solver.bodies[0]);
    (SPEED - along) / (SPEED - across)
}

#[test]
fn friction_is_its_coefficient_times_the_pressure_until_bodies_stick() {
    // The corners of the moving block have normals that are not quite those of its face.
    let smooth = ratio(&slide(Contact::Frictional(0.0)));
    assert!(smooth.abs() < 3e-2, "{smooth}");
    for coefficient in [0.1, 0.2, 0.4] {
        let ratio = ratio(&slide(Contact::Frictional(coefficient)));
        println!("coefficient {coefficient}: {:.4}", ratio - smooth);
        assert!((ratio - smooth - coefficient).abs() < 1e-2);
    }
    let rough = ratio(&slide(Contact::Frictional(100.0)));
    let stuck = ratio(&slide(Contact::Sticking));
    println!("smooth {smooth:.4}, rough {rough:.4}, stuck {stuck:.4}");
    assert!((rough - stuck).abs() < 2e-2);
}
