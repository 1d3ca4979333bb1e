//! State of the particles of a row: deformation, stress and material.

use serde::{Deserialize, Serialize};

use super::ring::load;
use crate::{
    Error,
    lanes::{LANES, Lanes, each_of},
    solid::MaterialPoints,
    solver::{Particle, archive::Archive},
};

/// Energies that the particles of a row have taken so far [J per m].
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Taken {
    /// Work of the stress, the artificial viscosity included.
    pub(super) work: f64,
    pub(super) plastic: f64,
    pub(super) viscous: f64,
    /// What the stabilisation lost where plastic flow made it softer.
    pub(super) softened: f64,
}

/// A row of particles.
#[derive(Debug, Clone, Default)]
pub(super) struct StressRow {
    /// Displacement gradients `[∂x/∂X, ∂x/∂Z, ∂z/∂X, ∂z/∂Z]`.
    pub(super) gradient: [Vec<f64>; 4],
    /// First Piola–Kirchhoff stresses in the same order, with what the stabilisation adds [Pa].
    pub(super) stress: [Vec<f64>; 4],
    /// Stiffness of the stabilisation [N/m per m].
    pub(super) stiffness: Vec<f64>,
    /// Sum of the squares of the distances of the neighbours from where the gradient puts them [m2].
    pub(super) misfit: Vec<f64>,
    /// Material, from place 1 on.
    pub(super) points: Vec<MaterialPoints>,
    pub(super) taken: Taken,
}

/// What a checkpoint keeps of a row.
#[derive(Serialize, Deserialize)]
struct Kept {
    gradient: [Vec<f64>; 4],
    stress: [Vec<f64>; 4],
    stiffness: Vec<f64>,
    misfit: Vec<f64>,
    points: Vec<Particle>,
    taken: Taken,
}

impl StressRow {
    /// A row of so many places, at rest and free of stress.
    pub(super) fn at_rest(places: usize, stiffness: f64, point: &Particle) -> Self {
        let zeros = || [0, 1, 2, 3].map(|_| vec![0.0; places]);
        let mut points = MaterialPoints::default();
        for lane in 0..LANES {
            points.set_particle(lane, point);
        }
        Self {
            gradient: zeros(),
            stress: zeros(),
            stiffness: vec![stiffness; places],
            misfit: vec![0.0; places],
            points: vec![points; (places - 2) / LANES],
            taken: Taken::default(),
        }
    }

    /// Displacement gradients of eight particles from a place on.
    #[inline(always)]
    pub(super) fn gradients(&self, place: usize) -> [Lanes; 4] {
        let parts = [0, 1, 2, 3].map(|part| load(&self.gradient[part], place));
        each_of(|l| [parts[0][l], parts[1][l], parts[2][l], parts[3][l]])
    }

    /// Displacement gradient of a particle.
    pub(super) fn gradient_at(&self, place: usize) -> [f64; 4] {
        self.gradient.each_ref().map(|part| part[place])
    }

    /// Material of a particle.
    pub(super) fn point(&self, place: usize) -> Particle {
        let index = place - 1;
        self.points[index / LANES].particle(index % LANES)
    }

    /// Writes it to a checkpoint, or reads it from there.
    pub(super) fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        let particles = self
            .points
            .iter()
            .flat_map(|points| (0..LANES).map(|lane| points.particle(lane)));
        let mut kept = Kept {
            gradient: std::mem::take(&mut self.gradient),
            stress: std::mem::take(&mut self.stress),
            stiffness: std::mem::take(&mut self.stiffness),
            misfit: std::mem::take(&mut self.misfit),
            points: particles.collect(),
            taken: self.taken,
        };
        archive.item(&mut kept)?;
        for (index, particle) in kept.points.iter().enumerate() {
            if let Some(points) = self.points.get_mut(index / LANES) {
                points.set_particle(index % LANES, particle);
            }
        }
        self.gradient = kept.gradient;
        self.stress = kept.stress;
        self.stiffness = kept.stiffness;
        self.misfit = kept.misfit;
        self.taken = kept.taken;
        Ok(())
    }
}

/// Determinant of a deformation gradient, and its smaller principal stretch; negative where it turns a triangle over.
#[inline(always)]
pub(super) fn volume_and_stretch([xx, xz, zx, zz]: [f64; 4]) -> (f64, f64) {
    let (xx, zz) = (1.0 + xx, 1.0 + zz);
    let volume = xx * zz - xz * zx;
    // Of a plane tensor the sum and the difference of both principal stretches are roots of sums of squares.
    let sum = ((xx + zz).powi(2) + (xz - zx).powi(2)).sqrt();
    let difference = ((xx - zz).powi(2) + (xz + zx).powi(2)).sqrt();
    (volume, 0.5 * (sum - difference))
}
