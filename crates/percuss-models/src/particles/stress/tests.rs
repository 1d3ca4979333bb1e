//! Exact tests of particles with a stress.

use super::{body::StressBody, ring::WHOLE, step::Response};
use crate::{
    material::perfectly_plastic,
    options::{ArtificialViscosity, Space},
    particles::flight::Pose,
    particles::{
        body::{Body, Rows},
        bonded::Bonded,
        lattice::{ROW, Solid},
        packing::{Moved, Packing},
        shape::{Rigid, contact},
    },
    solid::Law,
    solver::Control,
};

const SPACING: f64 = 1e-3;
const STEEL: Solid = Solid {
    density: 7850.0,
    youngs_modulus: 200e9,
    poissons_ratio: 0.3,
};
/// Largest distance that packings of the tests move particles.
const MOVED: Packing = Packing::Irregular(Moved {
    amplitude: 0.3,
    seed: 7,
});

/// A solid that flows at a stress [Pa], without rate and heat.
fn law(solid: Solid, flow_stress: f64, linear: f64) -> Law {
    let (first, shear) = solid.constants();
    let moduli = [shear, first + 2.0 / 3.0 * shear];
    Law {
        viscosity: ArtificialViscosity {
            linear,
            quadratic: 0.0,
        },
        ..Law::plain(solid.density, moduli, perfectly_plastic(flow_stress))
    }
}

fn strip(
    law: Law,
    solid: Solid,
    (spacing, start): (f64, f64),
    (rows, particles): (usize, usize),
    packing: Packing,
) -> StressBody {
    let mut control = Control::default();
    let lattice = solid.lattice(Space::PlaneStrain, spacing);
    let shape = Rows {
        count: rows,
        particles,
    };
    let frame = Body::strip(lattice, shape, start, packing, &mut control).unwrap();
    StressBody::new(frame, law, 293.0, &mut control).unwrap()
}

fn steel_strip(flow_stress: f64, rows: usize, particles: usize, packing: Packing) -> StressBody {
    let law = law(STEEL, flow_stress, 0.3);
    strip(law, STEEL, (SPACING, 0.0), (rows, particles), packing)
}

/// Sets the displacement of every particle as a function of its position, and computes the stresses after a step of 1 s.
fn displace(body: &mut StressBody, of: impl Fn([f64; 2]) -> [f64; 2]) {
    let particles: Vec<_> = body.particles().collect();
    for (row, place) in particles {
        let [x, z] = of(body.reference(row, place));
        body.frame.state[row].x[place] = x;
        body.frame.state[row].z[place] = z;
    }
    body.strain_all(Response::Law(1.0));
}

/// Largest stable step of a body [s].
fn largest_step(body: &mut StressBody) -> f64 {
    2.0 / body.largest_frequency(&mut Control::default()).unwrap()
}

/// The gradient of a linear field is exact, the field is free of stabilisation, and its uniform stress gives no force inside.
#[test]
fn a_patch_of_moved_particles_has_exact_gradients_and_no_forces() {
    let gradient = [2e-3, -1.5e-3, 4e-3, -3e-3];
    let [xx, xz, zx, zz] = gradient;
    let mut body = steel_strip(f64::INFINITY, 16, 21, MOVED);
    displace(&mut body, |[x, z]| [xx * x + xz * z, zx * x + zz * z]);
    let scale = 200e9 * 4e-3 * SPACING;
    let mut at_rest = body.clone();
    at_rest.kick(1.0, &[]);
    let mut inside = 0;
    for (row, place) in body.particles() {
        for (found, exact) in body.rows[row].gradient_at(place).iter().zip(gradient) {
            assert!((found - exact).abs() < 1e-12 * 4e-3, "{row} {place}");
        }
        assert!(body.rows[row].misfit[place] < 1e-12 * (4e-3 * SPACING).powi(2));
        if body.triangles[row][place] == WHOLE {
            inside += 1;
            let mass = body.mass_of(row, place);
            for speed in at_rest.velocity(row, place) {
                assert!((speed * mass / scale).abs() < 1e-12, "{row} {place}");
            }
        }
    }
    assert!(inside > 200);
}

/// Forces are minus the gradient of the stored energy, also where particles are moved and at the surface: elastic stress and stabilisation.
#[test]
fn forces_are_the_gradient_of_the_energy() {
    let mut body = steel_strip(f64::INFINITY, 5, 7, MOVED);
    let size = 1e-7;
    let field = |[x, z]: [f64; 2]| {
        [
            size * SPACING * (2100.0 * x + 900.0 * z).sin(),
            size * SPACING * (1700.0 * z - 800.0 * x).cos(),
        ]
    };
    displace(&mut body, field);
    let mut pushed = body.clone();
    pushed.kick(1.0, &[]);
    let energy = |body: &StressBody| {
        let sums = body.energies(1.0, &[]);
        sums.elastic + sums.stabilisation
    };
    let particles: Vec<_> = body.particles().collect();
    let mut largest = 0.0_f64;
    for &(row, place) in &particles {
        for axis in 0..2 {
            // In one step from rest the work is exact for a linear law.
            let at = |way: f64| {
                let mut body = steel_strip(f64::INFINITY, 5, 7, MOVED);
                let moved = body.reference(row, place);
                displace(&mut body, |place| {
                    let mut shift = field(place);
                    if place == moved {
                        shift[axis] += way;
                    }
                    shift
                });
                energy(&body)
            };
            let way = 1e-2 * size * SPACING;
            let slope = (at(way) - at(-way)) / (2.0 * way);
            let force = pushed.velocity(row, place)[axis] * body.mass_of(row, place);
            largest = largest.max(force.abs());
            assert!(
                (force + slope).abs() < 2e-5 * 200e9 * size * SPACING,
                "{force} {slope}"
            );
        }
    }
    assert!(largest > 1e-2 * 200e9 * size * SPACING);
}

/// Turned by 90 degrees in 30 steps, a stretched body keeps the invariants of its stress, and its stress turns with it.
#[test]
fn a_turned_body_keeps_its_stress() {
    for flow_stress in [f64::INFINITY, 300e6] {
        let mut body = steel_strip(flow_stress, 8, 9, MOVED);
        // Free across the stretch in the plane.
        let ratio = 0.3 / 0.7;
        let (along, across) = (2e-3, -2e-3 * ratio);
        let mut was = Vec::new();
        for number in 0..=30 {
            let (sine, cosine) = (f64::from(number) * std::f64::consts::FRAC_PI_2 / 30.0).sin_cos();
            displace(&mut body, |[x, z]| {
                let (stretched_x, stretched_z) = ((1.0 + across) * x, (1.0 + along) * z);
                [
                    cosine * stretched_x - sine * stretched_z - x,
                    sine * stretched_x + cosine * stretched_z - z,
                ]
            });
            if number == 0 {
                was = body
                    .particles()
                    .map(|(row, place)| body.rows[row].point(place))
                    .collect();
            }
        }
        for ((row, place), was) in body.particles().zip(&was) {
            let now = body.rows[row].point(place);
            let scale = was.equivalent_stress();
            assert!(scale > 0.9 * flow_stress.min(350e6));
            assert!((now.equivalent_stress() / scale - 1.0).abs() < 1e-10);
            assert!(((now.pressure - was.pressure) / scale).abs() < 1e-10);
            let ([xx, zz, xz], [old_xx, old_zz, old_xz]) = (now.deviator, was.deviator);
            for (now, old) in [(xx, old_zz), (zz, old_xx), (xz, -old_xz)] {
                assert!(((now - old) / scale).abs() < 1e-10, "{now} {old}");
            }
            assert!((now.plastic_strain - was.plastic_strain).abs() < 1e-12);
        }
    }
}

/// Waves of a piston in uniaxial strain, as jumps of the very law: stress and speed of the elastic one, stress and speed of the plastic one.
fn exact_waves(yield_stress: f64, piston: f64) -> [f64; 4] {
    let law = law(STEEL, yield_stress, 0.0);
    let (bulk, shear, density) = (law.bulk_modulus, law.shear_modulus, law.density);
    // The logarithmic strain at which the deviator, 4/3 μ ε, comes to 2/3 of the yield stress.
    let limit = 1.0 - (-yield_stress / (2.0 * shear)).exp();
    let stress = |strain: f64| bulk * (1.0 / (1.0 - strain) - 1.0) + 2.0 / 3.0 * yield_stress;
    let elastic = stress(limit);
    let first_velocity = (elastic * limit / density).sqrt();
    let velocity = |strain: f64| ((stress(strain) - elastic) * (strain - limit) / density).sqrt();
    let (mut low, mut high) = (limit, 0.5);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        match first_velocity + velocity(middle) < piston {
            true => low = middle,
            false => high = middle,
        }
    }
    let speed = |jump: f64, strain: f64| (jump / strain / density).sqrt();
    [
        elastic,
        speed(elastic, limit),
        stress(low),
        speed(stress(low) - elastic, low - limit),
    ]
}

/// Moves all particles.
fn drift(body: &mut StressBody, step: f64) {
    let mut states = std::mem::take(&mut body.frame.state);
    let mut depths = std::mem::take(&mut body.depths);
    for (row, (state, depths)) in states.iter_mut().zip(&mut depths).enumerate() {
        body.drift_row(row, step, state, &body.frame.motion[row], depths);
    }
    (body.frame.state, body.depths) = (states, depths);
}

/// Depth before the impact at which the stress on the axis of a bar falls below a level [m].
fn front(body: &StressBody, level: f64) -> f64 {
    let at = |row: usize| body.on_axis((row, body.middle_place(row)), 0);
    let last = (0..body.row_count())
        .rev()
        .find(|&row| at(row).stress > level)
        .unwrap();
    let (a, b) = (at(last), at(last + 1));
    let part = (a.stress - level) / (a.stress - b.stress);
    a.initial_position + part * (b.initial_position - a.initial_position)
}

/// Plate impact: a rigid piston of 100 m/s on steel of 800 MPa in uniaxial strain, on 600 rows, regular and moved by 0.3 d.
#[test]
fn plate_impact_has_the_exact_waves() {
    let (rows, piston, yield_stress) = (600, 100.0, 800e6);
    let [elastic, elastic_speed, behind, plastic_speed] = exact_waves(yield_stress, piston);
    // Those of small strains are near.
    assert!((elastic / 1.400e9 - 1.0).abs() < 0.003 && (behind / 3.916e9 - 1.0).abs() < 0.01);
    for packing in [Packing::Regular, MOVED] {
        let mut body = steel_strip(yield_stress, rows, 7, packing);
        let step = 0.5 * largest_step(&mut body);
        let length = rows as f64 * ROW * SPACING;
        let advance_to = |end: f64, body: &mut StressBody, time: &mut f64| {
            while *time < end {
                body.kick(step, &[]);
                for motion in &mut body.frame.motion {
                    motion.x.fill(0.0);
                }
                let first = &mut body.frame.motion[0];
                for (speed, mass) in first.z.iter_mut().zip(&body.frame.rows[0].mass) {
                    *speed = if *mass > 0.0 { piston } else { 0.0 };
                }
                drift(body, step);
                body.strain_all(Response::Law(step));
                *time += step;
            }
        };
        let mut time = 0.0;
        let middle = 0.5 * (elastic + behind);
        advance_to(0.4 * length / elastic_speed, &mut body, &mut time);
        let early = (time, front(&body, 0.5 * elastic), front(&body, middle));
        advance_to(0.9 * length / elastic_speed, &mut body, &mut time);
        let late = (time, front(&body, 0.5 * elastic), front(&body, middle));
        let speed = |a: f64, b: f64| (b - a) / (late.0 - early.0);
        let mean = |from: f64, to: f64| {
            let inside = |place: f64| place > from && place < to;
            let all: Vec<f64> = (0..rows)
                .map(|row| body.on_axis((row, body.middle_place(row)), 0))
                .filter(|state| inside(state.initial_position))
                .map(|state| state.stress)
                .collect();
            all.iter().sum::<f64>() / all.len() as f64
        };
        let gap = late.1 - late.2;
        let errors = [
            speed(early.1, late.1) / elastic_speed - 1.0,
            speed(early.2, late.2) / plastic_speed - 1.0,
            mean(late.2 + 0.3 * gap, late.2 + 0.7 * gap) / elastic - 1.0,
            mean(0.2 * late.2, 0.8 * late.2) / behind - 1.0,
        ];
        println!("{packing:?}: {errors:.5?}");
        for (error, tolerance) in errors.iter().zip([0.01, 0.01, 0.01, 0.002]) {
            assert!(error.abs() < tolerance, "{packing:?}: {errors:.5?}");
        }
    }
}

/// A bar of copper in plane strain on a wall, in copper of 300 MPa.
const COPPER: Solid = Solid {
    density: 8960.0,
    youngs_modulus: 124e9,
    poissons_ratio: 0.34,
};
const LENGTH: f64 = 25e-3;
const WIDTH: f64 = 8e-3;
const IMPACT: f64 = 150.0;

/// Length of the bar when it has come to rest and the largest parts of its impact energy: balance error, stabilisation.
fn bar(rows: usize, packing: Packing) -> (f64, f64, f64) {
    let spacing = LENGTH / ((rows - 1) as f64 * ROW);
    let particles = (WIDTH / spacing + 1.5).round() as usize;
    let law = law(COPPER, 300e6, 0.3);
    let mut body = strip(law, COPPER, (spacing, -LENGTH), (rows, particles), packing);
    body.frame.launch(IMPACT);
    let frequency = body.largest_frequency(&mut Control::default()).unwrap();
    let of_contact = 2.0 * body.contact_stiffness() / body.inner_mass();
    let first_step = 0.5 * 2.0 / (frequency * frequency + of_contact).sqrt();
    let start = 0.5 * body.mass() * IMPACT * IMPACT;
    let (mut step, mut time, mut changes) = (first_step, 0.0, 0.0);
    let (mut worst, mut stabilisation) = (0.0_f64, 0.0_f64);
    let mut met = contact(&body, Rigid::Wall, Pose::straight(0.0), None);
    let mut number = 0;
    while time < 80e-6 {
        body.advance(step, &met.loads);
        time += step;
        number += 1;
        met = contact(&body, Rigid::Wall, Pose::straight(0.0), None);
        let total = |step: f64| {
            let sums = body.sums(step, &met.loads);
            let stored = sums.elastic + sums.plastic + sums.viscous + sums.stabilisation;
            (sums.kinetic + stored + met.energy, sums)
        };
        if number % 10 == 0 {
            let stable = first_step * body.stable_part();
            if step > stable {
                changes += total(step).0 - total(0.9 * stable).0;
                step = 0.9 * stable;
            }
            let (sum, sums) = total(step);
            worst = worst.max(((sum + changes) / start - 1.0).abs());
            stabilisation = stabilisation.max(sums.stabilisation / start);
        }
    }
    let depths = (0..rows).map(|row| body.depths[row]);
    let (front, back) = depths.fold(
        (f64::NEG_INFINITY, f64::INFINITY),
        |(front, back), range| (front.max(range[1]), back.min(range[0])),
    );
    (front - back, worst, stabilisation)
}

/// Length of the same bar by the material point method in plane strain [m]: that of `axi/tests/plane_bar.rs` with 32 cells over half the width.
const BY_MATERIAL_POINTS: f64 = 18.934e-3;

/// A bar on a wall in plane strain comes to rest at the length that the material point method gives, with a closed energy balance and little
/// stabilisation.
#[test]
fn a_bar_on_a_wall_is_as_long_as_by_material_points() {
    for packing in [Packing::Regular, MOVED] {
        let (length, balance, stabilisation) = bar(41, packing);
        println!("{packing:?}: {length:e} {balance:e} {stabilisation:e}");
        assert!((length / BY_MATERIAL_POINTS - 1.0).abs() < 0.03, "{length}");
        assert!(balance < 1e-3, "{balance:e}");
        assert!(
            stabilisation < 0.02 && stabilisation > 0.0,
            "{stabilisation:e}"
        );
    }
}

/// Convergence of the bar, for the documentation. Run it by `--ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
fn lengths_of_a_bar_converge() {
    for rows in [21, 41, 81, 161] {
        for packing in [Packing::Regular, MOVED] {
            let (length, balance, stabilisation) = bar(rows, packing);
            println!(
                "{rows} {packing:?}: {:.4} mm {balance:.1e} {stabilisation:.1e}",
                length * 1e3
            );
        }
    }
}

/// A bar that strikes a wall, on a number of threads: bits of its places and stresses, and its momentum with the impulse on the wall.
fn bits(threads: usize) -> (Vec<u64>, f64) {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap();
    pool.install(|| {
        let law = law(COPPER, 300e6, 0.3);
        let mut body = strip(law, COPPER, (0.2e-3, 0.0), (61, 50), MOVED);
        body.frame.hold_rear(f64::INFINITY);
        for (row, motion) in body.frame.motion.iter_mut().enumerate().take(60) {
            for (speed, mass) in motion.z.iter_mut().zip(&body.frame.rows[row].mass) {
                *speed = if *mass > 0.0 { 200.0 } else { 0.0 };
            }
        }
        let step = 0.4 * largest_step(&mut body);
        let (start, mut support) = (body.momentum(), 0.0);
        for _ in 0..150 {
            support += body.advance(step, &[]);
        }
        let numbers = body.particles().flat_map(|(row, place)| {
            let ([x, z], point) = (body.position(row, place), body.rows[row].point(place));
            [
                x,
                z,
                point.deviator[0],
                point.pressure,
                point.plastic_strain,
            ]
        });
        let momentum = (body.momentum() + support) / start - 1.0;
        assert!(body.flow().plastic_strain > 0.01);
        (numbers.map(f64::to_bits).collect(), momentum)
    })
}

#[test]
fn any_number_of_threads_gives_the_same_bits_and_momentum_is_kept() {
    let (alone, momentum) = bits(1);
    assert!(momentum.abs() < 1e-12, "{momentum:e}");
    for threads in [2, 3, 8] {
        assert!(bits(threads).0 == alone, "{threads} threads");
    }
}

/// Speed in flow and without, in time of the processor. Run it by `--ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
fn particle_steps_in_a_second() {
    let used = || {
        let stat = std::fs::read_to_string("/proc/self/stat").unwrap();
        let fields: Vec<&str> = stat
            .rsplit(')')
            .next()
            .unwrap()
            .split_whitespace()
            .collect();
        (fields[11].parse::<f64>().unwrap() + fields[12].parse::<f64>().unwrap()) * 1e-2
    };
    for (rows, particles) in [(120, 110), (500, 450)] {
        for packing in [Packing::Regular, MOVED] {
            for flow_stress in [f64::INFINITY, 300e6] {
                let mut body = steel_strip(flow_stress, rows, particles, packing);
                let step = 0.3 * largest_step(&mut body);
                // A velocity field that stretches the whole body.
                for row in 0..rows {
                    for place in 1..=particles {
                        let [x, z] = body.reference(row, place);
                        body.frame.motion[row].x[place] = -2e3 * x;
                        body.frame.motion[row].z[place] = 2e3 * z;
                    }
                }
                let steps = (4_000_000 / (rows * particles)).max(10);
                let best = (0..3)
                    .map(|_| {
                        let start = used();
                        for _ in 0..steps {
                            body.advance(step, &[]);
                        }
                        used() - start
                    })
                    .fold(f64::INFINITY, f64::min);
                let count = (body.particles().count() * steps) as f64;
                println!(
                    "{rows} x {particles} {packing:?} {flow_stress:e}: {:.1} M particle-steps/s, plastic strain {:.3}",
                    count / best * 1e-6,
                    body.flow().plastic_strain
                );
            }
        }
    }
}
