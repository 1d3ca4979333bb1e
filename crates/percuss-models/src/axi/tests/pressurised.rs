//! Thick spheres and cylinders under internal pressure: Lamé's elastic and Hill's elastic–plastic solutions.

use super::{
    Solid, body,
    load::{Loading, load},
    rectangle, solver, spherical_shell, supported, uniform,
};
use crate::{
    axi::boundary::{BoundaryCondition, BoundaryConditions},
    solver::Particle,
};

const INNER: f64 = 10e-3;
const OUTER: f64 = 20e-3;
const YOUNGS_MODULUS: f64 = 200e9;
const DENSITY: f64 = 7850.0;
/// So small that changes of shape do not count.
const FLOW_STRESS: f64 = 2e6;

fn steel(ratio: f64, flow_stress: f64) -> Solid {
    Solid {
        flow_stress,
        ..Solid::elastic(DENSITY, YOUNGS_MODULUS, ratio)
    }
}

fn loading(pressure: f64) -> Loading {
    let wave = (YOUNGS_MODULUS / DENSITY).sqrt();
    // About the angular frequency of breathing.
    let frequency = 1.5 * wave / (0.5 * (INNER + OUTER));
    Loading {
        pressure,
        rise: 60.0 / frequency,
        damping: frequency,
    }
}

/// Particles before and after, by their distance from the centre or axis.
struct Loaded {
    particles: Vec<([f64; 2], Particle, f64)>,
    spacing: f64,
}

impl Loaded {
    /// Displacement away from centre or axis of particles in the layer of particles at a face, over what theory says.
    fn displacement_error(&self, face: f64, exact: impl Fn(f64) -> f64) -> f64 {
        let near = self
            .particles
            .iter()
            .filter(|(distance, ..)| (distance[0] - face).abs() < self.spacing);
        let (mut sum, mut theory) = (0.0, 0.0);
        for (distance, particle, _) in near {
            sum += particle.mass * (distance[1] - distance[0]);
            theory += particle.mass * exact(distance[0]);
        }
        sum / theory - 1.0
    }

    /// Root of the mean square error of the hoop stress, over the largest that theory has: of the means over shells that are two
    /// particles thick, and of single particles.
    fn stress_errors(&self, exact: impl Fn(f64) -> f64) -> [f64; 2] {
        let shells = ((OUTER - INNER) / (2.0 * self.spacing)).round() as usize;
        let mut sums = vec![[0.0; 2]; shells];
        let (mut square, mut total, mut largest) = (0.0, 0.0, 0.0_f64);
        for (distance, particle, stress) in &self.particles {
            let theory = exact(distance[0]);
            let shell = ((distance[0] - INNER) / (2.0 * self.spacing)) as usize;
            sums[shell][0] += particle.mass;
            sums[shell][1] += particle.mass * (stress - theory);
            square += particle.mass * (stress - theory).powi(2);
            total += particle.mass;
            largest = largest.max(theory.abs());
        }
        let of_shells: f64 = sums.iter().map(|[mass, error]| error * error / mass).sum();
        [of_shells, square].map(|sum| (sum / total).sqrt() / largest)
    }
}

/// A sphere under internal pressure; the stress is that of the hoop.
fn sphere(solid: Solid, pressure: f64, cells: f64) -> Loaded {
    let cell = (OUTER - INNER) / cells;
    let spacing = 0.5 * cell;
    let sections = spherical_shell(INNER, OUTER, spacing);
    let shell = body(solid.law(), sections, &uniform([0.0; 2]));
    let mut solver = solver(vec![shell], cell);
    let part = |[r, z]: [f64; 2]| {
        let distance = r.hypot(z);
        let slope = -1.0 / (OUTER - INNER);
        (
            (OUTER - distance) / (OUTER - INNER),
            [slope * r / distance, slope * z / distance],
        )
    };
    let pairs = load(&mut solver, &loading(pressure), &part);
    let distance = |p: &Particle| p.position[0].hypot(p.position[1]);
    let particles = pairs.iter().map(|(before, after)| {
        (
            [distance(before), distance(after)],
            *after,
            after.hoop_deviator() - after.pressure,
        )
    });
    Loaded {
        particles: particles.collect(),
        spacing,
    }
}

/// A cylinder in plane strain under internal pressure; the stress is that of the hoop.
fn cylinder(solid: Solid, pressure: f64, cells: f64) -> Loaded {
    let cell = (OUTER - INNER) / cells;
    let spacing = 0.5 * cell;
    let sections = rectangle((INNER, OUTER), (0.0, 2.0 * cell), spacing);
    let tube = body(solid.law(), sections, &uniform([0.0; 2]));
    let supports = BoundaryConditions {
        back: (isize::MIN, BoundaryCondition::Smooth),
        ..BoundaryConditions::NONE
    };
    let mut solver = supported(vec![tube], vec![supports], cell);
    let part = |[r, _]: [f64; 2]| {
        let width = OUTER - INNER;
        ((OUTER - r) / width, [-1.0 / width, 0.0])
    };
    let pairs = load(&mut solver, &loading(pressure), &part);
    let particles = pairs.iter().map(|(before, after)| {
        (
            [before.position[0], after.position[0]],
            *after,
            after.hoop_deviator() - after.pressure,
        )
    });
    Loaded {
        particles: particles.collect(),
        spacing,
    }
}

/// Tests displacements of both faces and the hoop stress.
fn check(
    name: &str,
    loaded: &Loaded,
    displacement: impl Fn(f64) -> f64,
    stress: impl Fn(f64) -> f64,
) {
    let inner = loaded.displacement_error(INNER, &displacement);
    let outer = loaded.displacement_error(OUTER, &displacement);
    let [of_shells, of_particles] = loaded.stress_errors(&stress);
    println!(
        "{name}: displacement {:+.2} % inside, {:+.2} % outside; hoop stress {:.2} % in shells, {:.2} % in particles",
        100.0 * inner,
        100.0 * outer,
        100.0 * of_shells,
        100.0 * of_particles
    );
    assert!(inner.abs() < 1e-2 && outer.abs() < 1e-2 && of_shells < 1e-2);
}

/// Lamé's displacement and hoop stress of a sphere of an inner radius [m] under internal pressure [Pa].
fn lame_sphere(inner: f64, pressure: f64, ratio: f64) -> [impl Fn(f64) -> f64; 2] {
    let scale = pressure * inner.powi(3) / (OUTER.powi(3) - inner.powi(3));
    let value = move |of_stress: bool| {
        move |radius: f64| {
            let half = 0.5 * (OUTER / radius).powi(3);
            if of_stress {
                scale * (1.0 + half)
            } else {
                scale / YOUNGS_MODULUS * radius * (1.0 - 2.0 * ratio + (1.0 + ratio) * half)
            }
        }
    };
    [value(false), value(true)]
}

/// Lamé's displacement and hoop stress of a cylinder of an inner radius [m] in plane strain under internal pressure [Pa].
fn lame_cylinder(inner: f64, pressure: f64, ratio: f64) -> [impl Fn(f64) -> f64; 2] {
    let scale = pressure * inner.powi(2) / (OUTER.powi(2) - inner.powi(2));
    let value = move |of_stress: bool| {
        move |radius: f64| {
            let square = (OUTER / radius).powi(2);
            if of_stress {
                scale * (1.0 + square)
            } else {
                scale * (1.0 + ratio) / YOUNGS_MODULUS * radius * (1.0 - 2.0 * ratio + square)
            }
        }
    };
    [value(false), value(true)]
}

/// Cells through the wall.
const CELLS: f64 = 12.0;
/// In a plastic sphere the mean pressures of cells that its faces cut count: displacements err by 2 % on the coarser mesh.
const FINE: f64 = 24.0;

#[test]
fn an_elastic_sphere_is_lames() {
    let pressure = 1e6;
    let [displacement, stress] = lame_sphere(INNER, pressure, 0.3);
    let loaded = sphere(steel(0.3, f64::INFINITY), pressure, CELLS);
    check("elastic sphere", &loaded, &displacement, &stress);
}

#[test]
fn an_elastic_cylinder_is_lames() {
    let pressure = 1e6;
    let [displacement, stress] = lame_cylinder(INNER, pressure, 0.3);
    let loaded = cylinder(steel(0.3, f64::INFINITY), pressure, CELLS);
    check("elastic cylinder", &loaded, &displacement, &stress);
}

#[test]
fn a_sphere_that_is_plastic_inside_is_hills() {
    let (ratio, front) = (0.3, 1.4 * INNER);
    let ratio_cubed = (front / OUTER).powi(3);
    let outside = 2.0 / 3.0 * FLOW_STRESS * (1.0 - ratio_cubed);
    let pressure = outside + 2.0 * FLOW_STRESS * (front / INNER).ln();
    let [elastic_displacement, elastic_stress] = lame_sphere(front, outside, ratio);
    let displacement = |radius: f64| {
        if radius >= front {
            return elastic_displacement(radius);
        }
        let bulk = 2.0 / 3.0 * (1.0 - 2.0 * ratio);
        let squeeze = bulk * (1.0 - ratio_cubed + 3.0 * (front / radius).ln());
        FLOW_STRESS / YOUNGS_MODULUS
            * ((1.0 - ratio) * front.powi(3) / radius.powi(2) - squeeze * radius)
    };
    let stress = |radius: f64| {
        if radius >= front {
            return elastic_stress(radius);
        }
        FLOW_STRESS - outside - 2.0 * FLOW_STRESS * (front / radius).ln()
    };
    let loaded = sphere(steel(ratio, FLOW_STRESS), pressure, FINE);
    check("plastic sphere", &loaded, displacement, stress);
}

#[test]
fn a_cylinder_that_is_plastic_inside_is_hills() {
    // The axial stress is the mean of the others, and the solution closed, only without change of volume; a deviation by
    // 2(1/2 − ν) of the shear stress changes the equivalent stress by less than a thousandth.
    let (ratio, front) = (0.45, 1.4 * INNER);
    let shear = FLOW_STRESS / 3.0_f64.sqrt();
    let outside = shear * (1.0 - (front / OUTER).powi(2));
    let pressure = outside + 2.0 * shear * (front / INNER).ln();
    let [elastic_displacement, elastic_stress] = lame_cylinder(front, outside, ratio);
    let radial = |radius: f64| -outside - 2.0 * shear * (front / radius).ln();
    let displacement = |radius: f64| {
        if radius >= front {
            return elastic_displacement(radius);
        }
        // Growth of the area between here and the front: (1 − 2ν)/E times the trace of the stress.
        const STEPS: usize = 100;
        let width = (front - radius) / STEPS as f64;
        let middles = (0..STEPS).map(|step| radius + (step as f64 + 0.5) * width);
        let trace = |at: f64| 3.0 * (radial(at) + shear);
        let growth: f64 = middles
            .map(|at| (1.0 - 2.0 * ratio) / YOUNGS_MODULUS * trace(at) * at * width)
            .sum();
        (elastic_displacement(front) * front - growth) / radius
    };
    let stress = |radius: f64| {
        if radius >= front {
            elastic_stress(radius)
        } else {
            radial(radius) + 2.0 * shear
        }
    };
    let loaded = cylinder(steel(ratio, FLOW_STRESS), pressure, CELLS);
    check("plastic cylinder", &loaded, displacement, stress);
}
