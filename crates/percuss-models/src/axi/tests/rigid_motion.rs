//! Motion without deformation: free flight, and rotation in plane strain.

use std::f64::consts::PI;

use super::{Grid, Solid, body, change, deform, rectangle, solver, spherical_shell, uniform};
use crate::{axi::Particle, solid::Law};

fn steel() -> Solid {
    Solid::elastic(7850.0, 200e9, 0.3)
}

#[test]
fn a_flying_sphere_keeps_its_velocity_shape_and_energy() {
    let cell = 1e-3;
    let flight = uniform([0.0, 300.0]);
    let sphere = body(
        steel().law(),
        spherical_shell(0.0, 4.0 * cell, 0.5 * cell),
        &flight,
    );
    let mut solver = solver(vec![sphere], cell);
    // Particles change their order: the temperature, on which nothing depends, tells them apart.
    let mut number = 0.0;
    change(&mut solver.bodies[0], |particle| {
        particle.temperature = number;
        number += 1.0;
    });
    let start: Vec<Particle> = solver.bodies[0].particles().collect();
    while solver.time * 300.0 < 5.5 * cell {
        assert!(solver.advance());
    }
    assert!(solver.energy().residual().abs() < 1e-12);
    assert!(solver.momentum().residual().abs() < 1e-12);
    let way = solver.time * 300.0;
    for particle in solver.bodies[0].particles() {
        let before = start[particle.temperature as usize];
        assert!((particle.velocity[1] - 300.0).abs() < 1e-9);
        assert!((particle.position[0] - before.position[0]).abs() < 1e-12);
        assert!((particle.position[1] - before.position[1] - way).abs() < 1e-12);
        assert!(particle.equivalent_stress() < 1.0);
    }
}

/// Linear momentum [N s/m], and angular momentum about the origin, that of the velocity gradients included [N s].
fn momenta(solver: &Grid) -> [f64; 3] {
    let moment = 0.25 * solver.mesh.cell * solver.mesh.cell;
    let of_particle = |p: &Particle| {
        let ([r, z], [v_r, v_z]) = (p.position, p.velocity);
        let spin = r * v_z - z * v_r + moment * (p.gradient[2] - p.gradient[1]);
        [v_r, v_z, spin].map(|entry| p.mass * entry)
    };
    let mut sums = [0.0; 3];
    for particle in solver.bodies[0].particles() {
        for (sum, entry) in sums.iter_mut().zip(of_particle(&particle)) {
            *sum += entry;
        }
    }
    sums
}

/// Polar moment of inertia about the centre of mass [kg m].
fn inertia(solver: &Grid) -> f64 {
    let particles: Vec<Particle> = solver.bodies[0].particles().collect();
    let mass: f64 = particles.iter().map(|p| p.mass).sum();
    let mean = [0, 1].map(|k| {
        particles
            .iter()
            .map(|p| p.mass * p.position[k])
            .sum::<f64>()
            / mass
    });
    let square = |p: &Particle| -> f64 { (0..2).map(|k| (p.position[k] - mean[k]).powi(2)).sum() };
    particles.iter().map(|p| p.mass * square(p)).sum()
}

#[test]
fn a_spinning_block_keeps_its_momenta_and_its_shape() {
    const SIDE: f64 = 8e-3;
    const SPEED: f64 = 100.0;
    let middle = [20e-3, 0.0];
    let rate = SPEED / (0.5 * SIDE);
    let spin = |[r, z]: [f64; 2]| {
        let arm = [r - middle[0], z - middle[1]];
        ([-rate * arm[1], rate * arm[0]], [0.0, -rate, rate, 0.0])
    };
    let law = Law {
        axisymmetric: false,
        ..steel().law()
    };
    let cell = SIDE / 8.0;
    let half = 0.5 * SIDE;
    let sections = rectangle(
        (middle[0] - half, middle[0] + half),
        (-half, half),
        0.5 * cell,
    );
    let mut solver = solver(vec![body(law, sections, &spin)], cell);
    let (before, inertia_before) = (momenta(&solver), inertia(&solver));
    while solver.time * rate < 2.0 * PI {
        assert!(solver.advance());
    }
    let after = momenta(&solver);
    let growth = inertia(&solver) / inertia_before - 1.0;
    let kinetic = solver.sums[0].kinetic / solver.accumulated.initial_energy - 1.0;
    let residual = solver.energy().residual();
    let turning = after[2] / before[2] - 1.0;
    println!(
        "one turn, {} steps: inertia {growth:+.1e}, kinetic {kinetic:+.1e}, angular momentum {turning:+.1e}, residual {residual:.1e}",
        solver.step
    );
    let scale = solver.sums[0].mass * SPEED;
    for k in 0..2 {
        assert!((after[k] - before[k]).abs() < 1e-11 * scale);
    }
    // What the nodes do not resolve of the motion does not turn with the particles.
    assert!(turning.abs() < 5e-4);
    // Centrifugal forces stretch the block by about ρv²/E, a few parts in ten thousand.
    assert!((0.0..5e-4).contains(&growth));
    assert!(kinetic.abs() < 1e-3);
    assert!(residual.abs() < 1e-6);
}

#[test]
fn a_stress_turns_with_its_material() {
    const STEPS: u32 = 7;
    let law = steel().law();
    let (sine, cosine) = (2.0 * PI / f64::from(STEPS)).sin_cos();
    let mut particle = Particle {
        deviator: [3e8, -1e8, 2e8],
        mass: law.density,
        volume: 1.0,
        gradient: [cosine - 1.0, -sine, sine, cosine - 1.0],
        ..Particle::default()
    };
    particle.yield_point = law.slow_yield_point(&particle);
    let before = particle;
    for step in 1..=STEPS {
        deform(&law, &mut particle, 0.0);
        let (sine, cosine) = (2.0 * PI * f64::from(step) / f64::from(STEPS)).sin_cos();
        let [rr, zz, rz] = before.deviator;
        let turned = cosine * cosine * rr + sine * sine * zz - 2.0 * sine * cosine * rz;
        assert!((particle.deviator[0] - turned).abs() < 1e-6);
    }
    for (after, before) in particle.deviator.iter().zip(before.deviator) {
        assert!((after - before).abs() < 1e-6);
    }
    assert!((particle.volume - 1.0).abs() < 1e-14);
}
