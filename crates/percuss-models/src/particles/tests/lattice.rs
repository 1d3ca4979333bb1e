//! Elastic constants, strips and plane waves.

use super::{displace, forces, solid, strip};
use crate::particles::bonded::Bonded;
use crate::{
    options::Space,
    particles::lattice::{DIRECTIONS, ROW, poissons_ratio_refusal},
};

const CASES: [(Space, f64); 6] = [
    (Space::PlaneStrain, 0.0),
    (Space::PlaneStrain, 0.1),
    (Space::PlaneStrain, 0.25),
    (Space::PlaneStress, 0.1),
    (Space::PlaneStress, 0.22),
    (Space::PlaneStress, 1.0 / 3.0),
];

/// `C11 = λ' + 2μ`, `C12 = λ'`, `C66 = μ`, from the energy of a homogeneous strain of the three bonds of a particle, at any orientation.
#[test]
fn elastic_constants_are_those_of_the_solid() {
    for (space, ratio) in CASES {
        let (first, second) = solid(ratio).plane_constants(space);
        let lattice = solid(ratio).lattice(space, 1e-3);
        for angle in [0.0_f64, 0.1, 0.3, std::f64::consts::FRAC_PI_6] {
            let (sine, cosine) = angle.sin_cos();
            let mut constants = [0.0; 4];
            for [x, z] in DIRECTIONS {
                let [x, z] = [cosine * x - sine * z, sine * x + cosine * z];
                // Second derivative of the energy per area, `1/A = 1/(ROW d²)`.
                let (n, s) = (lattice.normal / ROW, lattice.shear / ROW);
                constants[0] += n * x.powi(4) + s * (x * z).powi(2);
                constants[1] += n * (x * z).powi(2) - s * (x * z).powi(2);
                constants[2] += n * (x * z).powi(2) + s * (0.5 * (x * x - z * z)).powi(2);
                constants[3] += n * z.powi(4) + s * (x * z).powi(2);
            }
            let stiff = first + 2.0 * second;
            for (found, exact) in constants.into_iter().zip([stiff, first, second, stiff]) {
                assert!(
                    (found - exact).abs() < 1e-12 * stiff,
                    "{space:?} {ratio} {angle}: {found} {exact}"
                );
            }
        }
    }
}

/// A strip under tension along its rows, unit by unit: no force on any particle away from its ends, and `E` across any section.
#[test]
fn a_strip_has_youngs_modulus_whatever_its_thickness() {
    for rows in [3, 4, 5, 9, 17, 33] {
        for ratio in [0.0, 0.1, 0.22, 1.0 / 3.0] {
            let mut body = strip(Space::PlaneStress, ratio, rows, 24);
            let strain = 1e-12;
            displace(&mut body, |[x, z]| [strain * x, -ratio * strain * z]);
            let spacing = body.lattice.spacing;
            let mut end = 0.0;
            let unit = strain * body.lattice.normal * spacing;
            for (row, place, force) in forces(&body) {
                let x = body.reference(row, place)[0];
                if x < -9.0 * spacing {
                    end += force[0];
                } else if x < 9.0 * spacing {
                    for part in [force[0], force[1], force[2] / spacing] {
                        assert!(
                            part.abs() < 1e-10 * unit,
                            "{rows} rows, ν {ratio}: {part} of {unit}"
                        );
                    }
                }
            }
            let thickness = (rows as f64 - 1.0) * ROW * spacing;
            let modulus = end / (thickness * strain);
            assert!(
                (modulus / 70e9 - 1.0).abs() < 1e-10,
                "{rows} rows, ν {ratio}: {modulus}"
            );
        }
    }
}

/// Speeds of plane waves against `√((λ' + 2μ)/ρ)` and `√(μ/ρ)`, the worst of three directions.
#[test]
fn waves_are_slow_by_the_dispersion_of_the_lattice() {
    for (space, per_wave, low) in [
        (Space::PlaneStress, 5.0, [Some(0.055), Some(0.052)]),
        (Space::PlaneStress, 10.0, [Some(0.014), Some(0.013)]),
        (Space::PlaneStress, 20.0, [Some(0.0035), Some(0.0033)]),
        (Space::PlaneStress, 40.0, [Some(0.0009), Some(0.0008)]),
        (Space::PlaneStrain, 5.0, [None, Some(0.067)]),
        (Space::PlaneStrain, 10.0, [None, Some(0.016)]),
    ] {
        let solid = solid(0.22);
        let (lattice, (_, shear)) = (solid.lattice(space, 1e-3), solid.plane_constants(space));
        let exact = [lattice.wave_speed, (shear / solid.density).sqrt()];
        let mut worst = [0.0_f64; 2];
        for degrees in [0.0_f64, 15.0, 30.0] {
            let number = 2.0 * std::f64::consts::PI / (per_wave * 1e-3);
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let phases = DIRECTIONS.map(|[x, z]| number * 1e-3 * (cosine * x + sine * z));
            let mut speeds = lattice
                .frequencies(phases)
                .map(|frequency| frequency / number);
            // The branch of rotation is the one farthest from both.
            speeds.sort_by(f64::total_cmp);
            let nearest = |speed: f64| {
                let by = |a: &&f64, b: &&f64| (*a - speed).abs().total_cmp(&(*b - speed).abs());
                speeds.iter().min_by(by).copied().unwrap()
            };
            for (worst, exact) in worst.iter_mut().zip(exact) {
                *worst = worst.max(1.0 - nearest(exact) / exact);
            }
        }
        for (found, low) in worst.into_iter().zip(low) {
            if let Some(low) = low {
                assert!(
                    (found - low).abs() < 1e-3,
                    "{space:?}, {per_wave}: {found} {low}"
                );
            }
        }
    }
}

/// The forces of the bonds of a small plane wave are those of the dispersion relation: particle by particle, with rotation.
#[test]
fn forces_of_a_plane_wave_are_those_of_the_frequencies() {
    let mut body = strip(Space::PlaneStrain, 0.1, 21, 24);
    let number = [900.0, 500.0];
    let (amplitude, turn) = ([2e-12, -1e-12], 3e-10);
    let phase = |[x, z]: [f64; 2]| number[0] * x + number[1] * z;
    displace(&mut body, |at| amplitude.map(|a| a * phase(at).cos()));
    let particles: Vec<_> = body.particles().collect();
    for (row, place) in particles {
        // A quarter of a period apart.
        body.state[row].sine[place] = -turn * phase(body.reference(row, place)).sin();
    }
    let lattice = body.lattice;
    let d = lattice.spacing;
    let mut force = [0.0; 2];
    let mut moment = 0.0;
    for [n_x, n_z] in DIRECTIONS {
        let theta = d * (number[0] * n_x + number[1] * n_z);
        let (n, s) = ([n_x, n_z], [-n_z, n_x]);
        let dot = |v: [f64; 2]| v[0] * amplitude[0] + v[1] * amplitude[1];
        for k in 0..2 {
            force[k] -= 2.0
                * (1.0 - theta.cos())
                * (lattice.normal * n[k] * dot(n) + lattice.shear * s[k] * dot(s));
            force[k] += lattice.shear * d * theta.sin() * s[k] * turn;
        }
        moment += lattice.shear * d * theta.sin() * dot(s)
            - 0.5 * lattice.shear * d * d * (1.0 + theta.cos()) * turn;
    }
    let mut looked_at = 0;
    for (row, place, found) in forces(&body) {
        if (1..20).contains(&row) && (3..22).contains(&place) {
            let at = phase(body.reference(row, place));
            let exact = [force[0] * at.cos(), force[1] * at.cos(), -moment * at.sin()];
            let scale = [
                force[0].abs() + force[1].abs(),
                force[0].abs() + force[1].abs(),
                moment.abs(),
            ];
            for ((found, exact), scale) in found.into_iter().zip(exact).zip(scale) {
                assert!(
                    (found - exact).abs() < 1e-7 * scale,
                    "{row} {place}: {found} {exact}"
                );
            }
            looked_at += 1;
        }
    }
    assert!(looked_at > 300);
}

#[test]
fn poissons_ratios_above_the_limit_are_refused_with_a_way_out() {
    assert_eq!(
        poissons_ratio_refusal(Space::PlaneStrain, 0.25, "glass"),
        None
    );
    assert_eq!(
        poissons_ratio_refusal(Space::PlaneStress, 1.0 / 3.0, "glass"),
        None
    );
    let words = |space, ratio| {
        poissons_ratio_refusal(space, ratio, "steel")
            .unwrap()
            .to_string()
    };
    assert_eq!(
        words(Space::PlaneStrain, 0.26),
        "springs reach a Poisson's ratio of 0.25 in plane strain, and the material `steel` has 0.26: its shear spring would be \
         negative, and the lattice unstable; for a thin plate seen from its face give `particles.space = \"plane-stress\"`; \
         otherwise use the model `axi`"
    );
    assert!(words(Space::PlaneStress, 0.34).ends_with("; use the model `axi`"));
}
