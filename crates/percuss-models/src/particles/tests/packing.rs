//! Elastic constants, forces and bits of an irregular packing.

use super::{displace, forces, solid};
use crate::particles::bonded::Bonded;
use crate::{
    options::Space,
    particles::{
        body::{Body, Rows},
        lattice::ROW,
        packing::{Moved, Packing},
        periodic::Periodic,
    },
    solver::Control,
};

const SIZE: usize = 48;

fn moved(amplitude: f64, seed: u64) -> Moved {
    Moved { amplitude, seed }
}

fn body(amplitude: f64) -> Body {
    let lattice = solid(0.22).lattice(Space::PlaneStress, 1e-3);
    let rows = Rows {
        count: 70,
        particles: 80,
    };
    Body::strip(
        lattice,
        rows,
        0.0,
        Packing::Irregular(moved(amplitude, 3)),
        &mut Control::default(),
    )
    .unwrap()
}

/// Errors of C11, C22, C12 and C66 of a cell of tuned springs.
fn errors(space: Space, ratio: f64, moved: Moved) -> [f64; 4] {
    let lattice = solid(ratio).lattice(space, 1e-3);
    let (first, second) = solid(ratio).plane_constants(space);
    let stiff = first + 2.0 * second;
    let found = Periodic::new(&moved.tuned(&lattice), SIZE, moved).constants();
    let exact = [stiff, stiff, first, second];
    std::array::from_fn(|i| found[i] / exact[i] - 1.0)
}

#[test]
fn a_cell_that_is_not_moved_is_the_lattice() {
    for (space, ratio) in [(Space::PlaneStress, 0.22), (Space::PlaneStrain, 0.1)] {
        for error in errors(space, ratio, moved(0.0, 1)) {
            assert!(error.abs() < 1e-12, "{space:?} {ratio}: {error}");
        }
    }
    let (regular, moved) = (super::strip(Space::PlaneStress, 0.22, 70, 80), body(0.0));
    for (row, place) in regular.particles() {
        let (a, b) = (&regular.rows[row], &moved.rows[row]);
        assert!((b.mass[place] / a.mass[place] - 1.0).abs() < 1e-12);
        for kind in 0..3 {
            let difference = a.weights[kind][place] - b.weights[kind][place];
            assert!(
                difference.abs() < 1e-12,
                "{row} {place} {kind}: {difference}"
            );
        }
    }
    let bent = |mut body: Body| {
        displace(&mut body, |[x, z]| [1e-3 * z + 0.1 * x * z, 2e-3 * x]);
        forces(&body)
    };
    let scale = regular.lattice.normal * 1e-6;
    for (a, b) in bent(regular).iter().zip(bent(moved)) {
        for part in 0..2 {
            assert!((a.2[part] - b.2[part]).abs() < 1e-12 * scale, "{a:?} {b:?}");
        }
    }
}

/// Within 0.5 % at 0.15 spacings and 1.5 % at 0.3, as the mean over five seeds.
#[test]
fn an_irregular_packing_has_the_constants_of_the_solid() {
    for (amplitude, allowed) in [(0.15, 5e-3), (0.3, 15e-3)] {
        for (space, ratio) in [
            (Space::PlaneStress, 0.22),
            (Space::PlaneStress, 0.3),
            (Space::PlaneStrain, 0.22),
        ] {
            let mut mean = [0.0; 4];
            for seed in 1..=5 {
                let errors = errors(space, ratio, moved(amplitude, seed));
                println!("{amplitude} {space:?} {ratio} {seed}: {errors:.4?}");
                for (mean, error) in mean.iter_mut().zip(errors) {
                    *mean += error / 5.0;
                }
            }
            for error in mean {
                assert!(
                    error.abs() < allowed,
                    "{amplitude} {space:?} {ratio}: {mean:.4?}"
                );
            }
        }
    }
}

/// Speeds of long waves over those of the solid, in eight directions 11.25° apart: of the longitudinal and of the transverse one, by
/// Christoffel's equation.
fn wave_speeds(space: Space, ratio: f64, moved: Moved) -> [[f64; 2]; 8] {
    let lattice = solid(ratio).lattice(space, 1e-3);
    let (first, second) = solid(ratio).plane_constants(space);
    let cell = Periodic::new(&moved.tuned(&lattice), SIZE, moved);
    let [c11, c22, c12, c66] = cell.constants();
    let with_shear = |strain: [f64; 3], own: f64| 0.5 * (cell.stiffness(strain) - own - c66);
    let c16 = with_shear([1.0, 0.0, 1.0], c11);
    let c26 = with_shear([0.0, 1.0, 1.0], c22);
    std::array::from_fn(|i| {
        let (z, x) = (i as f64 * std::f64::consts::FRAC_PI_2 / 8.0).sin_cos();
        let along = c11 * x * x + c66 * z * z + 2.0 * c16 * x * z;
        let up = c66 * x * x + c22 * z * z + 2.0 * c26 * x * z;
        let both = c16 * x * x + c26 * z * z + (c12 + c66) * x * z;
        let (mean, part) = (0.5 * (along + up), (0.5 * (along - up)).hypot(both));
        let exact = [first + 2.0 * second, second];
        [(mean + part) / exact[0], (mean - part) / exact[1]].map(f64::sqrt)
    })
}

/// Within 1 % in eight directions, as the mean over five seeds.
#[test]
fn waves_have_one_speed_in_all_directions() {
    for (space, ratio) in [(Space::PlaneStress, 0.22), (Space::PlaneStrain, 0.22)] {
        let mut mean = [[0.0; 2]; 8];
        for seed in 1..=5 {
            let speeds = wave_speeds(space, ratio, moved(0.3, seed));
            for (mean, speed) in mean
                .as_flattened_mut()
                .iter_mut()
                .zip(speeds.as_flattened())
            {
                *mean += speed / 5.0;
            }
        }
        println!("{space:?} {ratio}: {mean:.4?}");
        for speed in mean.as_flattened() {
            assert!((speed - 1.0).abs() < 0.01, "{space:?} {ratio}: {mean:.4?}");
        }
    }
}

#[test]
fn a_moved_body_has_the_mass_and_the_area_of_the_lattice() {
    let (regular, moved) = (body(0.0), body(0.3));
    assert!((moved.mass() / regular.mass() - 1.0).abs() < 1e-12);
    assert!((moved.area / regular.area - 1.0).abs() < 1e-12);
}

/// A moved body turned and moved as a whole has no forces.
#[test]
fn a_rigid_motion_has_no_force() {
    let mut body = body(0.3);
    let (sine, cosine) = 0.4_f64.sin_cos();
    displace(&mut body, |[x, z]| {
        [cosine * x - sine * z - x + 1e-3, sine * x + cosine * z - z]
    });
    for state in &mut body.state {
        state.cosine.fill(cosine);
        state.sine.fill(sine);
    }
    let scale = body.lattice.normal * body.lattice.spacing;
    for (row, place, force) in forces(&body) {
        for part in [force[0], force[1], force[2] / body.lattice.spacing] {
            assert!(part.abs() < 1e-12 * scale, "{row} {place}: {part}");
        }
    }
    assert!((ROW * ROW - 0.75).abs() < 1e-15);
}

#[test]
fn threads_change_no_bit_of_a_moved_body() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            let mut body = body(0.3);
            displace(&mut body, |[x, z]| [1e-3 * z, 20.0 * x * z]);
            for _ in 0..50 {
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
