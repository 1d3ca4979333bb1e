//! Energy, momentum and bits of motions.

use super::strip;
use crate::particles::bonded::Bonded;
use crate::{
    options::Space,
    particles::{
        body::{Body, Rows},
        bonded::Load,
        energy::BodySums,
        lattice::ROW,
        packing::Packing,
    },
    solver::Control,
};

use super::solid;

/// A disc of a radius in spacings.
fn disc(radius: f64) -> Body {
    let lattice = solid(0.22).lattice(Space::PlaneStress, 1e-3);
    let rows = 2 * (radius / ROW).ceil() as usize + 1;
    let particles = 2 * radius.ceil() as usize + 3;
    let middle = (0.5 * (rows as f64 - 1.0), 0.5 * (particles as f64 - 1.0));
    Body::of_particles(
        lattice,
        Rows {
            count: rows,
            particles,
        },
        0.0,
        Packing::Regular,
        |row, column| {
            let x = column as f64 + 0.5 * (row % 2) as f64 - middle.1;
            let z = (row as f64 - middle.0) * ROW;
            x * x + z * z <= radius * radius
        },
        &mut Control::default(),
    )
    .unwrap()
}

/// Largest stable step.
fn largest_step(body: &Body) -> f64 {
    2.0 / body.lattice.largest_frequency()
}

fn energy(sums: BodySums) -> f64 {
    sums.kinetic + sums.elastic
}

/// Centre of mass before the impact [m].
fn centre(body: &Body) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for (row, place) in body.particles() {
        let (mass, at) = (body.rows[row].mass[place], body.reference(row, place));
        sum = [sum[0] + mass * at[0], sum[1] + mass * at[1]];
    }
    sum.map(|part| part / body.mass())
}

/// Stretches a body to its equilibrium under the centrifugal load about a centre, by damped motion.
fn stretch(body: &mut Body, middle: [f64; 2], spin: f64, step: f64) {
    let particles: Vec<_> = body.particles().collect();
    for _ in 0..20_000 {
        let load = |&(row, place): &(usize, usize)| {
            let (mass, [x, z]) = (body.rows[row].mass[place], body.position(row, place));
            let (motion, drag) = (&body.motion[row], 0.05 / step);
            let of = |out: f64, velocity: f64| mass * (spin * spin * out - drag * velocity);
            Load {
                row,
                place,
                force: [
                    of(x - middle[0], motion.x[place]),
                    of(z - middle[1], motion.z[place]),
                ],
                moment: 0.0,
            }
        };
        let loads: Vec<Load<2>> = particles.iter().map(load).collect();
        for motion in &mut body.motion {
            motion.spin.iter_mut().for_each(|spin| *spin *= 0.95);
        }
        body.advance(step, &loads);
    }
}

/// A disc in its centrifugal equilibrium, which spins freely: ten turns.
#[test]
fn a_free_disc_keeps_its_energy_over_ten_turns() {
    let mut body = disc(4.0);
    let step = 0.25 * largest_step(&body);
    let turn = 20_000.0;
    let spin = 2.0 * std::f64::consts::PI / (turn * step);
    let middle = centre(&body);
    stretch(&mut body, middle, spin, step);
    // Velocities of half a step ago.
    let (sine, cosine) = (-0.5 * spin * step).sin_cos();
    let particles: Vec<_> = body.particles().collect();
    for &(row, place) in &particles {
        let [x, z] = body.position(row, place);
        let [x, z] = [x - middle[0], z - middle[1]];
        let [x, z] = [cosine * x - sine * z, sine * x + cosine * z];
        let motion = &mut body.motion[row];
        motion.x[place] = -spin * z;
        motion.z[place] = spin * x;
        motion.spin[place] = spin;
    }
    let start = body.sums(step, &[]);
    // The stretch is there.
    assert!(start.elastic > 1e-7 * start.kinetic);
    let mut worst = 0.0_f64;
    for number in 0..(10.0 * turn) as u32 {
        body.advance(step, &[]);
        if number % 100 == 0 {
            let change = energy(body.sums(step, &[])) / energy(start) - 1.0;
            worst = worst.max(change.abs());
        }
    }
    let (row, place) = particles[0];
    let [cosine, sine] = [body.state[row].cosine[place], body.state[row].sine[place]];
    assert!(
        (cosine - 1.0).abs() < 1e-3 && sine.abs() < 0.03,
        "ten whole turns"
    );
    println!(
        "elastic {:e}, worst {worst:e}",
        start.elastic / start.kinetic
    );
    assert!(worst < 1e-10, "{worst:e}");
}

/// A strip with random displacements and velocities of the same size on any number of threads.
fn shaken(threads: usize) -> Vec<u64> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap();
    pool.install(|| {
        let mut body = strip(Space::PlaneStrain, 0.2, 61, 120);
        body.hold_rear(f64::INFINITY);
        let mut seed = 1_u64;
        let mut random = move || {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let particles: Vec<_> = body.particles().collect();
        for &(row, place) in &particles {
            body.motion[row].x[place] = 100.0 * random();
            body.motion[row].z[place] = 100.0 * random();
        }
        let step = 0.4 * largest_step(&body);
        for _ in 0..200 {
            body.advance(step, &[]);
        }
        let of = |&(row, place): &(usize, usize)| {
            let (state, motion) = (&body.state[row], &body.motion[row]);
            [
                state.x[place],
                state.z[place],
                state.sine[place],
                motion.spin[place],
            ]
            .map(f64::to_bits)
        };
        particles.iter().flat_map(of).collect()
    })
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let one = shaken(1);
    assert!(one.iter().any(|bits| f64::from_bits(*bits) != 0.0));
    for threads in [2, 3, 8] {
        assert!(one == shaken(threads), "{threads} threads");
    }
}

/// A free strip that rings: linear and angular momentum, which central and shear springs with moments conserve.
#[test]
fn a_free_strip_keeps_linear_and_angular_momentum() {
    let mut body = strip(Space::PlaneStrain, 0.1, 15, 20);
    let particles: Vec<_> = body.particles().collect();
    for &(row, place) in &particles {
        let [x, z] = body.reference(row, place);
        body.motion[row].x[place] = 40.0 * (300.0 * z).sin();
        body.motion[row].z[place] = 60.0 * (200.0 * x).sin() + 10.0;
    }
    // Positions half a step on stand with the velocities.
    let momenta = |body: &Body, step: f64| {
        let mut sums = [0.0; 3];
        for &(row, place) in &particles {
            let mass = body.rows[row].mass[place];
            let (motion, [x, z]) = (&body.motion[row], body.position(row, place));
            let (vx, vz) = (motion.x[place], motion.z[place]);
            let [x, z] = [x - 0.5 * step * vx, z - 0.5 * step * vz];
            sums[0] += mass * vx;
            sums[1] += mass * vz;
            sums[2] += mass * (x * vz - z * vx)
                + motion.spin[place] / body.rows[row].inverse_inertia[place];
        }
        sums
    };
    let step = 0.5 * largest_step(&body);
    // Velocities that were given at the time of the displacements.
    let start = momenta(&body, 0.0);
    let scale = body.mass() * 60.0;
    for _ in 0..2000 {
        body.advance(step, &[]);
    }
    let end = momenta(&body, step);
    let lever = 20e-3;
    for ((start, end), scale) in start
        .into_iter()
        .zip(end)
        .zip([scale, scale, scale * lever])
    {
        assert!(
            (end - start).abs() < 1e-11 * scale,
            "{start} {end} of {scale}"
        );
    }
}

/// Elastic energy and kinetic energy of the same strip: exact in the linear limit, and bounded beyond.
#[test]
fn a_ringing_strip_keeps_its_energy() {
    for (speed, tolerance) in [(1e-4, 1e-10), (10.0, 1e-4)] {
        let mut body = strip(Space::PlaneStress, 0.3, 9, 30);
        let particles: Vec<_> = body.particles().collect();
        for &(row, place) in &particles {
            let [x, _] = body.reference(row, place);
            body.motion[row].z[place] = speed * (250.0 * x).sin();
        }
        let step = 0.7 * largest_step(&body);
        let start = energy(body.sums(step, &[]));
        let (mut worst, mut elastic) = (0.0_f64, 0.0_f64);
        for _ in 0..4000 {
            body.advance(step, &[]);
            let sums = body.sums(step, &[]);
            worst = worst.max((energy(sums) / start - 1.0).abs());
            elastic = elastic.max(sums.elastic / start);
        }
        println!("{speed}: {worst:e}");
        assert!(elastic > 0.3);
        assert!(worst < tolerance, "{speed} m/s: {worst:e}");
    }
}

/// Speed of the kernel, with all three kinds of springs. Run it by `--ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
fn particle_steps_in_a_second() {
    for (rows, particles) in [(60, 64), (400, 400), (1000, 1000)] {
        let mut body = strip(Space::PlaneStrain, 0.2, rows, particles);
        body.launch(1.0);
        let step = 0.5 * largest_step(&body);
        let steps = (40_000_000 / (rows * particles)).max(10);
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(1)
            .build()
            .unwrap();
        let best = (0..5)
            .map(|_| {
                let start = std::time::Instant::now();
                pool.install(|| {
                    for _ in 0..steps {
                        body.advance(step, &[]);
                    }
                });
                start.elapsed().as_secs_f64()
            })
            .fold(f64::INFINITY, f64::min);
        let count = body.particles().count() * steps;
        println!(
            "{rows} x {particles}: {:.1} M particle-steps/s",
            count as f64 / best * 1e-6
        );
    }
}
