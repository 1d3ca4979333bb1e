//! Collapse of a beryllium shell: the motion of an incompressible perfectly plastic sphere stops at radii known in closed form.

use super::{Grid, Solid, body, solver, spherical_shell};

const INNER: f64 = 0.08;
const OUTER: f64 = 0.10;

fn beryllium() -> Solid {
    Solid {
        density: 1845.0,
        bulk_modulus: 118e9,
        shear_modulus: 151e9,
        flow_stress: 0.33e9,
    }
}

/// Initial inner speed [m/s] and inner radius at rest [m].
const PUBLISHED: [(f64, f64); 3] = [(545.14, 0.05), (619.79, 0.04), (675.04, 0.03)];

/// Flow towards the origin without change of volume: `v = v_i (R_i/R)²`.
fn collapse(speed: f64) -> impl Fn([f64; 2]) -> ([f64; 2], [f64; 4]) {
    move |[r, z]| {
        let distance = r.hypot(z);
        let flow = -speed * INNER * INNER / distance.powi(3);
        let slope = |x: f64, y: f64, same: f64| flow * (same - 3.0 * x * y / distance.powi(2));
        let gradient = [
            slope(r, r, 1.0),
            slope(r, z, 0.0),
            slope(z, r, 0.0),
            slope(z, z, 1.0),
        ];
        ([flow * r, flow * z], gradient)
    }
}

/// Kinetic energy of the flow, over 4π [J].
fn kinetic_energy(speed: f64) -> f64 {
    let reach = 1.0 / INNER - 1.0 / OUTER;
    0.5 * beryllium().density * speed * speed * INNER.powi(4) * reach
}

/// Plastic work until the inner radius has come to a value, over 4π [J]: the strain is `2 ln(R₀/R)`, the fall of R³ the same
/// everywhere.
fn plastic_work(inner: f64) -> f64 {
    const STEPS: usize = 1000;
    let fall = INNER.powi(3) - inner.powi(3);
    let width = (OUTER - INNER) / STEPS as f64;
    let middles = (0..STEPS).map(|step| INNER + (step as f64 + 0.5) * width);
    let strain = |start: f64| 2.0 * (start / (start.powi(3) - fall).cbrt()).ln();
    middles
        .map(|start| beryllium().flow_stress * strain(start) * start * start * width)
        .sum()
}

#[test]
fn the_published_speeds_are_those_of_the_balance_of_energy() {
    for (speed, inner) in PUBLISHED {
        let ratio = plastic_work(inner) / kinetic_energy(speed);
        assert!((ratio - 1.0).abs() < 4e-5, "{speed} m/s: {ratio}");
    }
}

/// Inner radius at which the shell stops [m]. Tests momentum and energy on the way.
fn stops_at(speed: f64, cells: f64) -> f64 {
    let cell = (OUTER - INNER) / cells;
    let sections = spherical_shell(INNER, OUTER, 0.5 * cell);
    let shell = body(beryllium().law(), sections, &collapse(speed));
    let mut solver = solver(vec![shell], cell);
    // Without change of volume the cubes of all radii fall by the same.
    let cubes = |solver: &Grid| -> f64 {
        let particles = solver.bodies[0].particles();
        let distance = |[r, z]: [f64; 2]| r.hypot(z);
        particles
            .map(|p| p.mass * distance(p.position).powi(3))
            .sum::<f64>()
            / solver.sums[0].mass
    };
    let start = cubes(&solver);
    let mut least = INNER;
    loop {
        assert!(solver.advance());
        let inner = (INNER.powi(3) + cubes(&solver) - start).cbrt();
        if inner > least {
            break;
        }
        least = inner;
    }
    let energy = solver.energy();
    println!(
        "shell, {cells} cells, {speed} m/s: {:.3} mm, residual {:.1e}, lost to the grid {:.1e}",
        1e3 * least,
        energy.residual(),
        energy.transfer / energy.initial
    );
    assert!(energy.residual().abs() < 5e-5);
    let scale = solver.sums[0].mass * speed;
    assert!(solver.motion().1.abs() < 1e-10 * scale);
    least
}

#[test]
fn a_collapsing_shell_stops_where_its_energy_is_used_up() {
    for (speed, exact) in PUBLISHED {
        let [coarse, fine] = [6.0, 12.0].map(|cells| stops_at(speed, cells) / exact - 1.0);
        println!("  {:+.2} %, {:+.2} %", 100.0 * coarse, 100.0 * fine);
        assert!(coarse.abs() < 1e-2 && fine.abs() < 5e-3);
    }
}
