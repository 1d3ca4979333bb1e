//! Exact tests of bodies in space.

use super::{contact::scenario, solid};
use crate::{
    particles::{
        bonded::Bonded,
        cubic::{Cubic, CubicBody, Grid, SIDE},
        packing::Moved,
        run::Impact,
    },
    solver::{Control, interface::Solver},
};

pub(super) const SPACING: f64 = 1e-3;

pub(super) fn moved(amplitude: f64, seed: u64) -> Option<Moved> {
    Some(Moved { amplitude, seed })
}

/// A block of cells with a spacing of 1 mm.
pub(super) fn block(ratio: f64, cells: [usize; 3], moved: Option<Moved>) -> CubicBody {
    let grid = Grid {
        layers: 2 * cells[2] + 1,
        columns: cells[0] + 1,
        rows: cells[1] + 1,
    };
    let lattice = Cubic::of(&solid(ratio), SPACING);
    let lattice = moved.map_or(lattice, |moved| lattice.tuned(moved.amplitude));
    CubicBody::of_particles(lattice, grid, 0.0, moved, |_| true, &mut Control::default()).unwrap()
}

pub(super) fn displace(body: &mut CubicBody, of: impl Fn([f64; 3]) -> [f64; 3]) {
    let particles: Vec<_> = body.particles().collect();
    for (layer, place) in particles {
        let moved = of(body.reference(layer, place));
        for (axis, moved) in moved.into_iter().enumerate() {
            body.state[layer][axis][place] = moved;
        }
    }
    body.refresh();
}

#[test]
fn a_block_has_the_volume_of_its_faces() {
    for moved in [None, moved(0.3, 2)] {
        let body = block(0.2, [8, 6, 5], moved);
        let side = body.lattice.side();
        let exact = 8.0 * 6.0 * 5.0 * side.powi(3);
        assert!((body.mass() / (2500.0 * body.volume) - 1.0).abs() < 1e-12);
        assert!((body.volume / exact - 1.0).abs() < 1e-12);
    }
}

/// Stress of a particle inside under small strains along, across and in shear.
#[test]
fn stress_is_that_of_the_solid() {
    for ratio in [0.0, 0.1, 0.25, 0.35] {
        let mut body = block(ratio, [6, 6, 6], None);
        let (first, second) = solid(ratio).constants();
        let layer = body.row_count() / 2;
        let place = body.middle_place(layer);
        let scale = 1e-7;
        for strain in [
            [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            [0.3, -0.7, 1.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 1.0, -0.4, 0.6],
        ] {
            let [xx, yy, zz, yz, xz, xy] = strain.map(|part: f64| scale * part);
            displace(&mut body, |[x, y, z]| {
                [
                    xx * x + xy * y + xz * z,
                    xy * x + yy * y + yz * z,
                    xz * x + yz * y + zz * z,
                ]
            });
            let found = body.stress(layer, place);
            let trace = xx + yy + zz;
            for i in 0..6 {
                let diagonal = if i < 3 { first * trace } else { 0.0 };
                let exact = diagonal + 2.0 * second * scale * strain[i];
                let error = (found[i] - exact) / (second * scale);
                assert!(
                    error.abs() < 1e-6,
                    "{ratio} {strain:?} {i}: {found:?} {error}"
                );
            }
        }
    }
}

/// A block with random displacements and velocities of the same size.
fn shaken(ratio: f64, moved: Option<Moved>) -> CubicBody {
    let mut body = block(ratio, [9, 8, 7], moved);
    let draw = |number: u64| crate::random::unit(7, number) - 0.5;
    let particles: Vec<_> = body.particles().collect();
    for (number, (layer, place)) in particles.into_iter().enumerate() {
        for axis in 0..3 {
            let index = (6 * number + 2 * axis) as u64;
            body.state[layer][axis][place] = 1e-3 * SPACING * draw(index);
            body.motion[layer][axis][place] = 5.0 * draw(index + 1);
        }
    }
    body.refresh();
    body
}

/// Momentum, and moment of momentum about the origin, of velocities and positions at one time.
fn momenta(body: &CubicBody, step: f64) -> [[f64; 3]; 2] {
    let mut sums = [[0.0; 3]; 2];
    for (layer, place) in body.particles() {
        let (mass, v) = (body.mass_of(layer, place), body.velocity(layer, place));
        let now = body.position(layer, place);
        // Where it was at the time of the velocity.
        let p = [0, 1, 2].map(|axis| now[axis] - 0.5 * step * v[axis]);
        for axis in 0..3 {
            let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
            sums[0][axis] += mass * v[axis];
            sums[1][axis] += mass * (p[a] * v[b] - p[b] * v[a]);
        }
    }
    sums
}

#[test]
fn energy_and_momenta_are_kept() {
    for (ratio, moved) in [(0.1, None), (0.3, None), (0.2, moved(0.3, 1))] {
        let mut body = shaken(ratio, moved);
        let frequency = body.frequency(&mut Control::default()).unwrap();
        let step = 0.1 * 2.0 / frequency;
        let (start, before) = (body.sums(step, &[]), momenta(&body, step));
        let start = start.kinetic + start.elastic;
        let mut worst = 0.0_f64;
        for _ in 0..2000 {
            body.advance(step, &[]);
            let sums = body.sums(step, &[]);
            worst = worst.max(((sums.kinetic + sums.elastic) / start - 1.0).abs());
        }
        let after = momenta(&body, step);
        println!("{ratio}: energy {worst:e}");
        assert!(worst < 1e-4, "{worst:e}");
        let scale = body.mass() * 2.5;
        for axis in 0..3 {
            let linear = (after[0][axis] - before[0][axis]) / scale;
            let angular = (after[1][axis] - before[1][axis]) / (scale * 5e-3);
            assert!(
                linear.abs() < 1e-12 && angular.abs() < 1e-11,
                "{linear:e} {angular:e}"
            );
        }
    }
}

/// At a step just below the largest stable one the energy stays, just above it grows.
#[test]
fn the_frequency_is_the_largest() {
    for moved in [None, moved(0.3, 1)] {
        let mut start = shaken(0.22, moved);
        let largest = 2.0 / (start.frequency(&mut Control::default()).unwrap() / 1.05);
        let grows = |part: f64| {
            let mut body = start.clone();
            let step = part * largest;
            let first = body.sums(step, &[]).elastic;
            for _ in 0..2000 {
                body.advance(step, &[]);
            }
            let last = body.sums(step, &[]).elastic;
            !last.is_finite() || last >= 100.0 * first
        };
        assert!(!grows(0.95) && grows(1.05), "{}", grows(0.95));
    }
}

#[test]
fn threads_change_no_bit() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            let mut body = block(0.2, [24, 24, 12], moved(0.3, 1));
            displace(&mut body, |[x, _, z]| [1e-3 * z, 20.0 * x * z, 0.0]);
            for _ in 0..20 {
                body.advance(2e-8, &[]);
            }
            body.state
        })
    };
    let alone = run(1);
    for threads in [2, 3, 8] {
        assert!(run(threads) == alone, "{threads} threads");
    }
}

/// A run of a case in space.
fn impact<'a>(case: &'a crate::Scenario, courant: f64) -> Impact<'a, CubicBody, 3> {
    Impact::build(case, courant, &mut Control::default()).unwrap()
}

/// Holds the sides of a body everywhere: it is strained along the normal alone.
fn hold_sides(body: &mut CubicBody) {
    let particles = body.particles();
    body.held = particles
        .flat_map(|(layer, place)| [0, 1].map(|axis| (layer, place, axis)))
        .collect();
}

/// A rigid body on a plate between smooth walls slows as `v = v₀ exp(−ρ c A t/m)` until the wave comes back.
#[test]
fn a_wide_punch_slows_as_the_wave_lets_it() {
    let rod = "length = '4 mm', diameter = '12 mm', impact_velocity = '2 m/s'";
    let plate = "material = 'own', thickness = '24 mm', back_face = 'free'";
    let options = "space = '3d', spacing = '0.5 mm', width = '6 mm'";
    let case = scenario(rod, plate, options, 0.22);
    let mut run = impact(&case, 0.5);
    hold_sides(&mut run.body);
    let impedance = 2500.0 * run.body.wave_speed() * run.body.width().powi(2);
    let time = 1.5 * 24e-3 / run.body.wave_speed();
    while run.state.time < time {
        run.advance().unwrap();
    }
    let exact = (-impedance * run.state.time / run.inertia.mass).exp();
    let found = run.state.flight.velocity[1] / 2.0;
    assert!(
        exact < 0.9 && (found - exact).abs() < 0.01 * (1.0 - exact),
        "{found} {exact}"
    );
}

/// A bar between smooth walls leaves a rigid wall after `2 L/c` with its speed; at the wall the stress is `ρ c v`.
#[test]
fn a_bar_leaves_a_wall() {
    let rod = "length = '20 mm', diameter = '5 mm', impact_velocity = '5 m/s'";
    let case = scenario(
        rod,
        "rigid_wall = true",
        "space = '3d', spacing = '0.5 mm'",
        0.22,
    );
    let mut run = impact(&case, 0.5);
    hold_sides(&mut run.body);
    let (mass, speed) = (run.body.mass(), run.body.wave_speed());
    let passage = 2.0 * 20e-3 / speed;
    let area = mass / (2500.0 * 20e-3);
    // Behind the first particles of the front.
    let mut until = |part: f64| {
        while run.state.time < part * passage {
            run.advance().unwrap();
        }
        [run.state.time, run.body.momentum()]
    };
    let ([start, before], [end, after]) = (until(0.2), until(0.8));
    let stress = (before - after) / (end - start) / area;
    // The steps of a round side are stiffer than its area where they cannot move: 2 % at eight cubes across.
    assert!(
        (stress / (2500.0 * speed * 5.0) - 1.0).abs() < 0.025,
        "{stress}"
    );
    while run.contact_force() > 0.0 {
        run.advance().unwrap();
    }
    assert!(
        (run.state.time / passage - 1.0).abs() < 0.03,
        "{}",
        run.state.time / passage
    );
    assert!((run.body.momentum() / (mass * 5.0) + 1.0).abs() < 0.03);
}

/// A ball at an angle: linear momentum in the plane, and energy.
#[test]
fn momenta_and_energy_of_an_oblique_impact() {
    let rod = "length = '6 mm', diameter = '6 mm', impact_velocity = '5 m/s', nose = 'hemisphere', obliquity = '35 deg'";
    let plate = "material = 'own', thickness = '4 mm', back_face = 'free'";
    let case = scenario(
        rod,
        plate,
        "space = '3d', spacing = '0.6 mm', width = '20 mm'",
        0.2,
    );
    let mut run = impact(&case, 0.3);
    let sum = |run: &Impact<'_, CubicBody, 3>| {
        let body = &run.body;
        let mut sum = run
            .state
            .flight
            .velocity
            .map(|part| part * run.inertia.mass);
        for (layer, place) in body.particles() {
            let (mass, v) = (body.mass_of(layer, place), body.velocity(layer, place));
            sum = [sum[0] + mass * v[0], sum[1] + mass * v[2]];
        }
        sum
    };
    let (start, energy) = (sum(&run), run.energy().total());
    for _ in 0..1500 {
        run.advance().unwrap();
    }
    let end = sum(&run);
    assert!(run.body.momentum() > 0.05 * start[1]);
    for axis in 0..2 {
        assert!(((end[axis] - start[axis]) / start[1]).abs() < 1e-12);
    }
    let change = run.energy().total() / energy - 1.0;
    assert!(change.abs() < 1e-3, "{change:e}");
}

/// How far the axis of a plate moves more than the plate as a whole [m], at times after a push that is largest there.
fn bending<B: Bonded<D>, const D: usize>(
    mut body: B,
    mut push: impl FnMut(&mut B, (usize, usize), f64),
) -> Vec<f64> {
    let half = 10.2e-3;
    let particles: Vec<_> = body.particles().collect();
    for &(row, place) in &particles {
        let across = body.reference(row, place)[0] / half;
        push(
            &mut body,
            (row, place),
            (0.5 * std::f64::consts::PI * across).cos(),
        );
    }
    let mean = body.momentum() / body.mass();
    let row = body.row_count() / 2;
    let place = body.middle_place(row);
    let (interval, steps) = (2e-6, 100);
    (0..12)
        .map(|number| {
            for _ in 0..steps {
                body.advance(interval / f64::from(steps), &[]);
            }
            let time = interval * f64::from(number + 1);
            body.displacement(row, place)[D - 1] - mean * time
        })
        .collect()
}

/// A slab between smooth walls swings as a plate in plane strain.
#[test]
fn a_slab_is_a_plate_in_plane_strain() {
    use crate::{
        options::Space,
        particles::{
            body::{Body, Rows},
            lattice::ROW,
            packing::Packing,
        },
    };
    let (ratio, width, thickness) = (0.2, 20.4e-3, 6e-3);
    let rows = 28_u32;
    let lattice = solid(ratio).lattice(Space::PlaneStrain, thickness / (f64::from(rows) * ROW));
    let rows = Rows {
        count: rows as usize + 1,
        particles: (width / lattice.spacing + 1.5).round() as usize,
    };
    let plane = Body::strip(
        lattice,
        rows,
        0.0,
        Packing::Regular,
        &mut Control::default(),
    )
    .unwrap();
    let plane = bending(plane, |body, (row, place), speed| {
        body.motion[row].z[place] = speed
    });
    let cells = 10;
    let lattice = Cubic::of(&solid(ratio), thickness / cells as f64 / SIDE);
    let grid = Grid {
        layers: 2 * cells + 1,
        columns: (width / lattice.side()).round() as usize + 1,
        rows: 13,
    };
    let mut slab =
        CubicBody::of_particles(lattice, grid, 0.0, None, |_| true, &mut Control::default())
            .unwrap();
    slab.held = slab
        .particles()
        .map(|(layer, place)| (layer, place, 1))
        .collect();
    let slab = bending(slab, |body, (layer, place), speed| {
        body.motion[layer][2][place] = speed;
    });
    let [plane, slab] = [plane, slab].map(|ways| last_return(&ways));
    assert!((slab / plane - 1.0).abs() < 0.02, "{plane} {slab}");
}

/// When a bending goes through its middle for the last time, in samples.
fn last_return(ways: &[f64]) -> f64 {
    let turns = |pair: &&[f64]| pair[0] * pair[1] < 0.0;
    let pairs: Vec<&[f64]> = ways.windows(2).collect();
    let last = pairs.iter().rposition(turns).unwrap();
    // A period and a half.
    assert_eq!(pairs.iter().filter(|pair| turns(pair)).count(), 3);
    last as f64 + ways[last] / (ways[last] - ways[last + 1])
}

/// Mass, centre and moment of inertia of a ball's half and of a cylinder.
#[test]
fn bodies_of_revolution_have_their_moments() {
    use crate::{particles::shape::Shape, problem::Nose};
    let (radius, length) = (2.0, 5.0);
    let of = |nose| {
        Shape {
            nose,
            radius,
            length,
        }
        .round_moments()
    };
    let pi = std::f64::consts::PI;
    let (volume, centre, second) = of(Nose::Flat);
    let exact = pi * radius * radius * length;
    assert!((volume / exact - 1.0).abs() < 1e-9 && (centre / 2.5 - 1.0).abs() < 1e-9);
    let exact_second = exact * (radius * radius / 4.0 + length * length / 12.0);
    assert!((second / exact_second - 1.0).abs() < 1e-9);
    let round = Shape {
        nose: Nose::Hemisphere,
        radius,
        length: radius,
    };
    let (volume, centre, second) = round.round_moments();
    let exact = 2.0 / 3.0 * pi * radius.powi(3);
    assert!((volume / exact - 1.0).abs() < 1e-9);
    assert!((centre / (5.0 / 8.0 * radius) - 1.0).abs() < 1e-9);
    let exact_second = exact * radius * radius * (0.4 - 9.0 / 64.0);
    assert!((second / exact_second - 1.0).abs() < 1e-9);
}

#[test]
#[ignore = "a measurement"]
fn particle_steps_in_a_second_in_space() {
    for (cells, moved) in [
        ([20, 20, 10], None),
        ([60, 60, 20], None),
        ([60, 60, 20], moved(0.3, 1)),
    ] {
        let mut body = block(0.22, cells, moved);
        let count = body.particles().count();
        let steps = 10_000_000 / count + 5;
        let start = std::time::Instant::now();
        for _ in 0..steps {
            body.advance(1e-8, &[]);
        }
        let rate = (count * steps) as f64 / start.elapsed().as_secs_f64();
        println!("{count} particles: {:.1} M/s", rate * 1e-6);
    }
}

/// A bar pulled at its ends, in equilibrium: Young's modulus over that of the solid.
fn modulus(ratio: f64, width: usize, moved: Option<Moved>) -> f64 {
    let length = 4 * width;
    let mut body = block(ratio, [width, width, length], moved);
    let strain = 1e-6;
    displace(&mut body, |[x, y, z]| {
        [-ratio * strain * x, -ratio * strain * y, strain * z]
    });
    let last = body.row_count() - 1;
    body.held = (body.particles())
        .filter(|(layer, _)| *layer == 0 || *layer == last)
        .map(|(layer, place)| (layer, place, 2))
        .collect();
    let step = 0.8 * 2.0 / body.frequency(&mut Control::default()).unwrap();
    let keep = 1.0 - 2.0 / length as f64;
    for _ in 0..60 * length {
        body.advance(step, &[]);
        for speed in body.motion.iter_mut().flatten().flatten() {
            *speed *= keep;
        }
    }
    // Mean stress over the middle half.
    let (mut sum, mut volume) = (0.0, 0.0);
    for (layer, place) in body.particles() {
        if (last / 4..=3 * last / 4).contains(&layer) {
            let own = body.mass_of(layer, place) / 2500.0;
            sum += own * body.stress(layer, place)[2];
            volume += own;
        }
    }
    sum / volume / strain / 70e9
}

#[test]
fn a_bar_has_the_modulus_of_the_solid() {
    for ratio in [0.1, 0.22, 0.35] {
        for width in [3, 6, 12] {
            let found = modulus(ratio, width, None);
            // A face stands for springs across it that are not there.
            let allowed = if width < 6 { 0.02 } else { 0.01 };
            assert!((found - 1.0).abs() < allowed, "{ratio} {width}: {found}");
        }
    }
    for seed in 1..=3 {
        let found = modulus(0.22, 6, moved(0.3, seed));
        assert!((found - 1.0).abs() < 0.025, "irregular {seed}: {found}");
    }
}

/// C11, C12 and C44 of the inside of irregular packings, as the mean over three seeds.
#[test]
fn an_irregular_packing_has_the_constants() {
    for ratio in [0.1, 0.22, 0.35] {
        let (first, second) = solid(ratio).constants();
        for amplitude in [0.15, 0.3] {
            let mut mean = [0.0; 3];
            // Others than those that the tuning was measured on.
            for seed in 4..=6 {
                let found = constants(ratio, moved(amplitude, seed));
                for (mean, found) in mean.iter_mut().zip(found) {
                    *mean += found / 3.0;
                }
            }
            let exact = [first + 2.0 * second, first, second];
            let errors = [0, 1, 2].map(|i| mean[i] / exact[i] - 1.0);
            for (error, allowed) in errors.into_iter().zip([0.01, 0.025, 0.01]) {
                assert!(error.abs() < allowed, "{ratio} {amplitude}: {errors:.4?}");
            }
        }
    }
}

/// Mean C11, C12 and C44 of the inside of a block whose surface is held at a homogeneous strain.
fn constants(ratio: f64, moved: Option<Moved>) -> [f64; 3] {
    let cells = 10;
    let mut body = block(ratio, [cells; 3], moved);
    let step = 0.8 * 2.0 / body.frequency(&mut Control::default()).unwrap();
    let half = 0.5 * cells as f64 * body.lattice.side();
    let on_face = |p: [f64; 3]| {
        let p = [p[0], p[1], p[2] - half];
        p.iter()
            .any(|part| part.abs() > half - 0.6 * body.lattice.side())
    };
    let held: Vec<_> = (body.particles())
        .filter(|&(layer, place)| on_face(body.reference(layer, place)))
        .flat_map(|(layer, place)| [0, 1, 2].map(|axis| (layer, place, axis)))
        .collect();
    body.held = held;
    let is_inside = |p: [f64; 3]| {
        let p = [p[0], p[1], p[2] - half];
        p.iter().all(|part| part.abs() < 0.6 * half)
    };
    let strain = 1e-6;
    let mut stress = |strains: [f64; 2]| {
        for vector in body.motion.iter_mut().flatten() {
            vector.fill(0.0);
        }
        displace(&mut body, |[_, y, z]| {
            [0.0, 0.0, strains[0] * z + strains[1] * y]
        });
        for _ in 0..400 {
            body.advance(step, &[]);
            for speed in body.motion.iter_mut().flatten().flatten() {
                *speed *= 0.8;
            }
        }
        let (mut sum, mut volume) = ([0.0; 6], 0.0);
        for (layer, place) in body.particles() {
            if is_inside(body.reference(layer, place)) {
                let own = body.mass_of(layer, place) / 2500.0;
                let found = body.stress(layer, place);
                for (sum, found) in sum.iter_mut().zip(found) {
                    *sum += own * found;
                }
                volume += own;
            }
        }
        sum.map(|part| part / volume / strain)
    };
    let (along, shear) = (stress([strain, 0.0]), stress([0.0, strain]));
    [along[2], 0.5 * (along[0] + along[1]), shear[3]]
}
