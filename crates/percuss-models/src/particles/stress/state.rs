//! State of the particles of a row: deformation, stress and material.

use serde::{Deserialize, Serialize};

use crate::{
    Error,
    lanes::{LANES, Lanes, each_of, load},
    material::YieldPoint,
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

/// Material of eight particles, without what follows from their masses and gradients: memory is what a step waits for.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(64))]
pub(super) struct KeptPoints {
    deviator: [Lanes; 3],
    pressure: Lanes,
    viscous_pressure: Lanes,
    plastic_strain: Lanes,
    temperature: Lanes,
    energy: Lanes,
    yield_point: YieldPoint<Lanes>,
}

impl KeptPoints {
    /// What is kept of them.
    #[inline(always)]
    pub(super) fn of(points: &MaterialPoints) -> Self {
        Self {
            deviator: points.deviator,
            pressure: points.pressure,
            viscous_pressure: points.viscous_pressure,
            plastic_strain: points.plastic_strain,
            temperature: points.temperature,
            energy: points.energy,
            yield_point: points.yield_point,
        }
    }

    /// The points of masses and volumes. Nothing fails.
    #[inline(always)]
    pub(super) fn whole(&self, mass: &Lanes, volume: &Lanes) -> MaterialPoints {
        MaterialPoints {
            deviator: self.deviator,
            pressure: self.pressure,
            viscous_pressure: self.viscous_pressure,
            mass: *mass,
            volume: *volume,
            plastic_strain: self.plastic_strain,
            temperature: self.temperature,
            energy: self.energy,
            damage: Lanes::all(0.0),
            localization: Lanes::all(0.0),
            yield_point: self.yield_point,
        }
    }

    /// The material of a particle, with a mass and a volume of 1.
    fn particle(&self, lane: usize) -> Particle {
        let one = Lanes::all(1.0);
        self.whole(&one, &one).particle(lane)
    }

    fn set_particle(&mut self, lane: usize, particle: &Particle) {
        let one = Lanes::all(1.0);
        let mut points = self.whole(&one, &one);
        points.set_particle(lane, particle);
        *self = Self::of(&points);
    }
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
    pub(super) points: Vec<KeptPoints>,
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
        let mut points = KeptPoints::default();
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

    /// A row with what forces on others follow from.
    pub(super) fn for_forces(&self) -> Self {
        Self {
            gradient: self.gradient.clone(),
            stress: self.stress.clone(),
            stiffness: self.stiffness.clone(),
            ..Self::default()
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

    /// Material of a particle, without its mass and volume.
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
