//! Constants of the body-centred cubic lattice.

use super::super::lattice::{Solid, eigenvalues};

/// Kinds of bonds that start at a particle: three to second neighbours, four to nearest ones of the next layer.
pub(in super::super) const KINDS: usize = 7;
/// Their vectors, in sides of the cube.
pub(super) const VECTORS: [[f64; 3]; KINDS] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [-0.5, -0.5, 0.5],
    [0.5, -0.5, 0.5],
    [-0.5, 0.5, 0.5],
    [0.5, 0.5, 0.5],
];
/// Side of the cube over the distance of nearest neighbours.
pub(in super::super) const SIDE: f64 = 1.154_700_538_379_251_5;
/// Stiffness of the springs to second neighbours over that to nearest ones: then the springs are isotropic.
const SECOND: f64 = 2.0 / 3.0;
/// Sum of the squares of the lengths of half the bonds of a particle, each with its stiffness over that of the nearest ones, over its volume, in
/// one over the side.
const DENSITY: f64 = 10.0;
/// Wave numbers along each axis at which the largest frequency is looked for.
const SCAN: u32 = 12;

/// Amplitude of the irregular packings whose constants were measured, by how much C44 and (C11 − C12)/2 of their springs are less, and how much the bulk modulus
/// over the shear modulus is less: a constant, and factors on the stiffness of the volume over the shear modulus and on its square.
const MEASURED: f64 = 0.3;
const SOFTER: [f64; 2] = [0.1058, 0.057];
const SOFTER_BULK: [f64; 3] = [0.2307, 0.2331, 0.0484];
/// Rounds of the search for the stiffness of the volume.
const ROUNDS: usize = 40;

/// Springs and particles of the lattice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in super::super) struct Cubic {
    /// Side of the cube [m].
    pub(super) side: f64,
    /// Stiffness of the springs to nearest neighbours [N/m].
    pub(super) normal: f64,
    /// Stiffness of the springs to second neighbours over that.
    second: f64,
    /// Stiffness of the change of volume beyond that of the springs, `λ − μ` [Pa].
    pub(super) bulk: f64,
    pub(super) density: f64,
    /// Mass of a particle inside [kg].
    pub(super) mass: f64,
    /// Speed of a longitudinal wave [m/s].
    pub(in super::super) wave_speed: f64,
}

impl Cubic {
    /// The lattice of a solid: `μ = k S/15` of the springs, whose `λ` is as large, and the rest of `λ` by the volume.
    pub(in super::super) fn of(solid: &Solid, spacing: f64) -> Self {
        let side = SIDE * spacing;
        let (first, second) = solid.constants();
        let density = solid.density;
        Self {
            side,
            normal: 15.0 * second * side / DENSITY,
            second: SECOND,
            bulk: first - second,
            density,
            mass: density * side.powi(3) / 2.0,
            wave_speed: ((first + 2.0 * second) / density).sqrt(),
        }
    }

    /// Stiffness of the springs to nearest neighbours [N/m].
    #[cfg(test)]
    pub(in super::super) fn normal(&self) -> f64 {
        self.normal
    }

    /// Side of the cube [m].
    pub(in super::super) fn side(&self) -> f64 {
        self.side
    }

    /// Area of a crack that a bond stands for, of its stiffness times the squares of its lengths [m2]: half the sum over the bonds that a plane cuts, as the
    /// mean over all directions.
    pub(super) fn area_of(&self, energy: f64) -> f64 {
        energy / (2.0 * super::toughness::CUT * self.normal)
    }

    /// The lattice with stiffnesses for which an irregular packing of an amplitude has the elastic constants of the solid in the mean. Moved particles make a
    /// lattice softer, as the square of the amplitude.
    pub(in super::super) fn tuned(&self, amplitude: f64) -> Self {
        let part = (amplitude / MEASURED).powi(2);
        let [nearest, second] = SOFTER.map(|softer| 1.0 / (1.0 - part * softer));
        // Springs alone have λ = μ: a bulk modulus of 5/3 μ, of which the nearest neighbours make 1.
        let shear = self.normal * DENSITY / (15.0 * self.side);
        let springs = (nearest + SECOND * second) / (1.0 + SECOND);
        let bulk = (5.0 / 3.0 + self.bulk / shear) / springs;
        let [constant, linear, square] = SOFTER_BULK.map(|softer| part * softer);
        let mut volume = 0.0_f64;
        for _ in 0..ROUNDS {
            let missing = bulk - 5.0 / 3.0 + constant + square * volume * volume;
            volume = missing / (1.0 - linear);
        }
        Self {
            normal: nearest * self.normal,
            second: self.second * second / nearest,
            bulk: volume * springs * shear,
            ..*self
        }
    }

    /// Distance of nearest neighbours [m].
    pub(super) fn spacing(&self) -> f64 {
        self.side / SIDE
    }

    /// Stiffness of a kind of springs [N/m].
    #[inline(always)]
    pub(super) fn stiffness(&self, kind: usize) -> f64 {
        let share = if kind < 3 { self.second } else { 1.0 };
        self.normal * share
    }

    /// Vector of a kind of bonds at rest [m].
    #[inline(always)]
    pub(super) fn vector(&self, kind: usize) -> [f64; 3] {
        VECTORS[kind].map(|part| part * self.side)
    }

    /// Largest angular frequency of all plane waves, of the springs alone [rad/s]. What the volume adds is small.
    pub(in super::super) fn largest_frequency(&self) -> f64 {
        let wave = 4.0 * std::f64::consts::PI / f64::from(SCAN);
        let mut largest: f64 = 0.0;
        for number in 0..SCAN.pow(3) {
            let phases = [1, SCAN, SCAN * SCAN].map(|by| f64::from(number / by % SCAN) * wave);
            let mut matrix = [[0.0; 3]; 3];
            for (kind, vector) in VECTORS.iter().enumerate() {
                let phase: f64 = vector.iter().zip(phases).map(|(a, b)| a * b).sum();
                let square: f64 = vector.iter().map(|part| part * part).sum();
                let stiff = 2.0 * (1.0 - phase.cos()) * self.stiffness(kind) / (self.mass * square);
                for (row, a) in matrix.iter_mut().zip(vector) {
                    for (entry, b) in row.iter_mut().zip(vector) {
                        *entry += stiff * a * b;
                    }
                }
            }
            largest = largest.max(eigenvalues(&matrix)[2]);
        }
        largest.sqrt()
    }
}

/// Part of a kind of bonds in the change of volume.
#[inline(always)]
pub(super) fn relative(kind: usize) -> f64 {
    if kind < 3 { SECOND } else { 1.0 }
}

/// Tetrahedra that share a bond of a kind inside.
pub(super) fn sharing(kind: usize) -> f64 {
    if kind < 3 { 4.0 } else { 6.0 }
}
