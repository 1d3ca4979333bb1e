//! Speeds of elastic waves, from the period of a standing wave in a bar with free ends.

use std::f64::consts::PI;

use super::{ALL_ROWS, Grid, Solid, body, rectangle, supported};
use crate::{
    axi::boundary::{BoundaryCondition, BoundaryConditions},
    solid::Law,
};

const LENGTH: f64 = 0.1;
const SPEED: f64 = 1.0;
const YOUNGS_MODULUS: f64 = 124e9;
const RATIO: f64 = 0.34;
/// Largest part of the energy without an account, on the coarsest mesh.
const ENERGY: f64 = 1e-2;

fn copper() -> Solid {
    Solid::elastic(8960.0, YOUNGS_MODULUS, RATIO)
}

/// Speed from the times at which the amplitude of `cos(πz/L)` passes zero, over two periods [m/s].
fn measured_speed(radius: f64, cell: f64, supports: BoundaryConditions, courant: f64) -> f64 {
    let number = PI / LENGTH;
    let motion = |[_, depth]: [f64; 2]| {
        let phase = number * depth;
        (
            [0.0, SPEED * phase.cos()],
            [0.0, 0.0, 0.0, -SPEED * number * phase.sin()],
        )
    };
    let sections = rectangle((0.0, radius), (0.0, LENGTH), 0.5 * cell);
    let bar = body(copper().law(), sections, &motion);
    let mut solver = supported(vec![bar], vec![supports], cell);
    solver.courant = courant;
    let amplitude = |solver: &Grid| -> f64 {
        let particles = solver.bodies[0].particles();
        particles
            .map(|p| p.mass * p.velocity[1] * (number * p.position[1]).cos())
            .sum()
    };
    let mut crossings = Vec::new();
    // Velocities stand half a step behind.
    let mut before = (0.0, amplitude(&solver));
    while crossings.len() < 5 {
        let half = 0.5 * solver.time_step;
        assert!(solver.advance());
        let now = (solver.time - half, amplitude(&solver));
        if now.1 * before.1 <= 0.0 {
            crossings.push(before.0 + (now.0 - before.0) * before.1 / (before.1 - now.1));
        }
        before = now;
    }
    let residual = solver.energy().residual();
    assert!(residual.abs() < ENERGY, "{residual}");
    2.0 * LENGTH / (0.5 * (crossings[4] - crossings[0]))
}

#[test]
fn waves_in_a_thin_bar_travel_at_the_bar_wave_speed() {
    let solid = copper();
    let radius = LENGTH / 40.0;
    // Rayleigh's correction for the motion across the bar.
    let inertia = (RATIO * PI * radius / LENGTH).powi(2) / 4.0;
    let exact = (YOUNGS_MODULUS / solid.density).sqrt() * (1.0 - inertia);
    let speed = measured_speed(radius, radius / 3.0, BoundaryConditions::NONE, 0.5);
    println!("bar: {:+.4} %", 100.0 * (speed / exact - 1.0));
    assert!((speed / exact - 1.0).abs() < 5e-4);
}

/// Error of the speed of waves in uniaxial strain, with a number of cells in half a wave.
fn bulk_error(cells: f64, courant: f64) -> f64 {
    let solid = copper();
    let modulus = solid.bulk_modulus + 4.0 / 3.0 * solid.shear_modulus;
    let supports = BoundaryConditions {
        edge: (0, BoundaryCondition::Smooth),
        ..BoundaryConditions::NONE
    };
    let cell = LENGTH / cells;
    measured_speed(2.0 * cell, cell, supports, courant) / (modulus / solid.density).sqrt() - 1.0
}

#[test]
fn waves_in_uniaxial_strain_travel_at_the_bulk_wave_speed_to_second_order_in_the_cell() {
    let errors = [10.0, 20.0, 40.0].map(|cells| bulk_error(cells, 0.5));
    let order = |coarse: f64, fine: f64| (coarse / fine).log2();
    let orders = [order(errors[0], errors[1]), order(errors[1], errors[2])];
    println!("uniaxial strain: {errors:?}, orders {orders:?}");
    assert!(errors[2].abs() < 1e-3);
    assert!(orders.iter().all(|order| (1.7..2.2).contains(order)));
}

#[test]
fn waves_travel_at_the_same_speed_with_any_time_step() {
    let errors = [0.8, 0.4, 0.2].map(|courant| bulk_error(20.0, courant));
    println!("time step: {errors:?}");
    let [most, least] = [f64::max, f64::min].map(|pick| errors.into_iter().reduce(pick).unwrap());
    assert!(most - least < 4e-4);
}

/// Error of the time that a wave of four lengths of a slab takes to fall to rest, its front end held; with cells in the slab.
fn held_error(cells: f64, supports: BoundaryConditions) -> f64 {
    let solid = copper();
    let modulus = solid.bulk_modulus + 4.0 / 3.0 * solid.shear_modulus;
    let number = 0.5 * PI / LENGTH;
    // Towards the held face at depth 0, which a wall takes for pressing on it.
    let motion = |[_, depth]: [f64; 2]| {
        let phase = number * depth;
        (
            [0.0, -SPEED * phase.sin()],
            [0.0, 0.0, 0.0, -SPEED * number * phase.cos()],
        )
    };
    let cell = LENGTH / cells;
    let sections = rectangle((0.0, 2.0 * cell), (-LENGTH, 0.0), 0.5 * cell);
    let slab = body(copper().law(), sections, &motion);
    let mut solver = supported(vec![slab], vec![supports], cell);
    let amplitude = |solver: &Grid| -> f64 {
        let particles = solver.bodies[0].particles();
        particles
            .map(|p| -p.mass * p.velocity[1] * (number * p.position[1]).sin())
            .sum()
    };
    let time = time_to_rest(&mut solver, amplitude);
    assert!(solver.momentum().residual().abs() < 1e-12);
    time / LENGTH * (modulus / solid.density).sqrt() - 1.0
}

/// Time at which the amplitude of a wave first falls to nothing [s].
fn time_to_rest(solver: &mut Grid, amplitude: impl Fn(&Grid) -> f64) -> f64 {
    let mut before = (0.0, amplitude(solver));
    loop {
        let half = 0.5 * solver.time_step;
        assert!(solver.advance());
        let now = (solver.time - half, amplitude(solver));
        if now.1 <= 0.0 {
            return before.0 + (now.0 - before.0) * before.1 / (before.1 - now.1);
        }
        before = now;
    }
}

#[test]
fn a_wall_and_a_fixed_back_face_hold_to_second_order_in_the_cell() {
    let smooth = BoundaryConditions {
        edge: (0, BoundaryCondition::Smooth),
        ..BoundaryConditions::NONE
    };
    let wall = BoundaryConditions {
        wall: true,
        ..smooth.clone()
    };
    let fixed = BoundaryConditions {
        back: (0, BoundaryCondition::Smooth),
        ..smooth
    };
    for supports in [wall, fixed] {
        let [coarse, fine] = [10.0, 20.0].map(|cells| held_error(cells, supports.clone()));
        println!("held: {:+.3} %, {:+.3} %", 100.0 * coarse, 100.0 * fine);
        assert!(fine.abs() < 1e-3);
        assert!((coarse / fine).log2() > 1.7);
    }
}

/// Error of the time that a wave of four lengths of a block takes to fall to rest, its outer edge held; with cells in the block.
///
/// Plane strain, and no motion along the axis: what happens is uniaxial strain along the radius.
fn edge_error(cells: f64) -> f64 {
    let solid = copper();
    let modulus = solid.bulk_modulus + 4.0 / 3.0 * solid.shear_modulus;
    let number = 0.5 * PI / LENGTH;
    let edge = 2.0 * LENGTH;
    let motion = |[radius, _]: [f64; 2]| {
        let phase = number * (edge - radius);
        (
            [SPEED * phase.sin(), 0.0],
            [-SPEED * number * phase.cos(), 0.0, 0.0, 0.0],
        )
    };
    let cell = LENGTH / cells;
    let law = Law {
        axisymmetric: false,
        ..solid.law()
    };
    let sections = rectangle((LENGTH, edge), (0.0, 2.0 * cell), 0.5 * cell);
    let supports = BoundaryConditions {
        back: (ALL_ROWS, BoundaryCondition::Smooth),
        edge: (
            (edge / cell).round() as usize + 1,
            BoundaryCondition::Smooth,
        ),
        ..BoundaryConditions::NONE
    };
    let mut solver = supported(vec![body(law, sections, &motion)], vec![supports], cell);
    let amplitude = |solver: &Grid| -> f64 {
        let particles = solver.bodies[0].particles();
        particles
            .map(|p| p.mass * p.velocity[0] * (number * (edge - p.position[0])).sin())
            .sum()
    };
    let time = time_to_rest(&mut solver, amplitude);
    assert!(solver.energy().residual().abs() < ENERGY);
    time / LENGTH * (modulus / solid.density).sqrt() - 1.0
}

#[test]
fn a_fixed_edge_holds_to_second_order_in_the_cell() {
    let [coarse, fine] = [10.0, 20.0].map(edge_error);
    println!(
        "fixed edge: {:+.3} %, {:+.3} %",
        100.0 * coarse,
        100.0 * fine
    );
    assert!(fine.abs() < 1e-3);
    assert!((coarse / fine).log2() > 1.7);
}
