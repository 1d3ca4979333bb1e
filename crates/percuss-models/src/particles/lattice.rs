//! Constants of the hexagonal lattice: spring stiffnesses, inertia of a particle, frequencies of plane waves.

use crate::{Refusal, options::Space, units::significant};

/// Ratio of the distance between two rows to that between two particles.
pub(super) const ROW: f64 = 0.866_025_403_784_438_6;
/// Directions of the three bonds of a particle to its neighbours: along its row, and to the right and left of the next row.
pub(super) const DIRECTIONS: [[f64; 2]; 3] = [[1.0, 0.0], [0.5, ROW], [-0.5, ROW]];
/// Factor on `k_s d⁴/c_P²` of the least moment of inertia: then rotation never limits the time step.
const LEAST_INERTIA: f64 = 0.56;
/// Wave numbers along each side of a cell of the reciprocal lattice at which the largest frequency is looked for.
const SCAN: u32 = 24;

/// Springs and particles of a hexagonal lattice, per metre of width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Lattice {
    /// Distance of neighbours [m].
    pub(super) spacing: f64,
    /// Stiffness of the normal spring of a bond [N/m per m].
    pub(super) normal: f64,
    /// Stiffness of its shear spring [N/m per m].
    pub(super) shear: f64,
    /// Mass of a particle inside [kg per m].
    pub(super) mass: f64,
    /// Moment of inertia of a particle inside [kg m2 per m].
    pub(super) inertia: f64,
    /// Speed of a longitudinal wave in the plane [m/s].
    pub(super) wave_speed: f64,
    /// Share of the in-plane stresses in the out-of-plane stress: Poisson's ratio in plane strain, 0 in plane stress.
    pub(super) out_of_plane: f64,
}

/// An isotropic elastic solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Solid {
    /// Density [kg/m3].
    pub(super) density: f64,
    /// Young's modulus [Pa].
    pub(super) youngs_modulus: f64,
    /// Poisson's ratio.
    pub(super) poissons_ratio: f64,
}

impl Solid {
    /// Lamé's constants `λ` and `μ` [Pa].
    pub(super) fn constants(&self) -> (f64, f64) {
        self.plane_constants(Space::PlaneStrain)
    }

    /// Lamé's constants `λ'` and `μ` of a plane [Pa].
    pub(super) fn plane_constants(&self, space: Space) -> (f64, f64) {
        let (modulus, ratio) = (self.youngs_modulus, self.poissons_ratio);
        let shear = modulus / (2.0 * (1.0 + ratio));
        let first = match space {
            Space::PlaneStrain | Space::ThreeDimensional => {
                modulus * ratio / ((1.0 + ratio) * (1.0 - 2.0 * ratio))
            }
            Space::PlaneStress => modulus * ratio / (1.0 - ratio * ratio),
        };
        (first, shear)
    }

    /// The lattice that has these constants: `k_n = 2(λ' + μ)/√3` and `k_s = 2(μ − λ')/√3`.
    pub(super) fn lattice(&self, space: Space, spacing: f64) -> Lattice {
        let (first, second) = self.plane_constants(space);
        let to_spring = 1.0 / ROW;
        let shear = to_spring * (second - first).max(0.0);
        let mass = self.density * ROW * spacing * spacing;
        let wave_speed = ((first + 2.0 * second) / self.density).sqrt();
        let least = LEAST_INERTIA * shear * spacing.powi(4) / (wave_speed * wave_speed);
        Lattice {
            spacing,
            normal: to_spring * (first + second),
            shear,
            mass,
            inertia: (mass * spacing * spacing / 8.0).max(least),
            wave_speed,
            out_of_plane: match space {
                Space::PlaneStress => 0.0,
                Space::PlaneStrain | Space::ThreeDimensional => self.poissons_ratio,
            },
        }
    }
}

/// Largest Poisson's ratio that the springs of a plane reach: beyond it the shear spring would be negative and the lattice unstable. In space the stiffness of
/// the volume has any; its bound is what is tested.
pub(super) fn largest_poissons_ratio(space: Space) -> f64 {
    match space {
        Space::PlaneStrain => 0.25,
        Space::PlaneStress => 1.0 / 3.0,
        Space::ThreeDimensional => LARGEST_IN_SPACE,
    }
}

/// Largest Poisson's ratio in space.
const LARGEST_IN_SPACE: f64 = 0.4;

/// Why springs cannot stand for a material of a Poisson's ratio, if they cannot.
pub(super) fn poissons_ratio_refusal(space: Space, ratio: f64, id: &str) -> Option<Refusal> {
    let largest = largest_poissons_ratio(space);
    let in_space = space == Space::ThreeDimensional;
    (ratio > largest).then(|| {
        if in_space {
            let reason = format!(
                "in three dimensions it is made for a Poisson's ratio up to {}, and the material `{id}` has {}",
                significant(largest, 3),
                significant(ratio, 3)
            );
            return Refusal::new(reason).with_remedy("use the model `axi`");
        }
        let reason = format!(
            "springs reach a Poisson's ratio of {} in {}, and the material `{id}` has {}: its shear spring would be negative, \
             and the lattice unstable",
            significant(largest, 3),
            space.describe(),
            significant(ratio, 3)
        );
        let in_stress = ratio <= largest_poissons_ratio(Space::PlaneStress);
        Refusal::new(reason).with_remedy(match in_stress {
            true => "for a thin plate seen from its face give `particles.space = \"plane-stress\"`; otherwise use the model `axi`",
            false => "use the model `axi`",
        })
    })
}

impl Lattice {
    /// Stress over strain of a body that is free to contract in its plane [Pa].
    pub(super) fn plane_modulus(&self) -> f64 {
        let density = self.mass / (ROW * self.spacing * self.spacing);
        let ratio = self.shear / self.normal;
        // λ' + 2μ = ρ c², and k_s/k_n = (μ − λ')/(μ + λ').
        let second = density * self.wave_speed * self.wave_speed * (1.0 + ratio) / (3.0 + ratio);
        let first = second * (1.0 - ratio) / (1.0 + ratio);
        4.0 * second * (first + second) / (first + 2.0 * second)
    }

    /// Largest angular frequency of all plane waves [rad/s].
    pub(super) fn largest_frequency(&self) -> f64 {
        let step = 2.0 * std::f64::consts::PI / f64::from(SCAN);
        let mut largest: f64 = 0.0;
        for a in 0..SCAN {
            for b in 0..SCAN {
                // Phases along the first two directions; the third direction is the second less the first.
                let (first, second) = (f64::from(a) * step, f64::from(b) * step);
                largest = largest.max(self.frequencies([first, second, second - first])[2]);
            }
        }
        largest
    }

    /// Angular frequencies of the plane waves with these phases between neighbours, in rising order [rad/s].
    pub(super) fn frequencies(&self, phases: [f64; 3]) -> [f64; 3] {
        let matrix = self.dynamical_matrix(phases);
        eigenvalues(&matrix).map(|square| square.max(0.0).sqrt())
    }

    /// Stiffness of a plane wave, divided by the masses: of both displacements, and of the rotation a quarter of a period apart [1/s2].
    fn dynamical_matrix(&self, phases: [f64; 3]) -> [[f64; 3]; 3] {
        let mut matrix = [[0.0; 3]; 3];
        let (arm, cross) = (self.spacing, 1.0 / (self.mass * self.inertia).sqrt());
        for ([x, z], phase) in DIRECTIONS.into_iter().zip(phases) {
            let (sine, cosine) = phase.sin_cos();
            let side = [-z, x];
            let along = [x, z];
            for row in 0..2 {
                for column in 0..2 {
                    let springs = self.normal * along[row] * along[column]
                        + self.shear * side[row] * side[column];
                    matrix[row][column] += 2.0 * (1.0 - cosine) * springs / self.mass;
                }
                let coupling = -self.shear * arm * sine * side[row] * cross;
                matrix[row][2] += coupling;
                matrix[2][row] += coupling;
            }
            matrix[2][2] += 0.5 * self.shear * arm * arm * (1.0 + cosine) / self.inertia;
        }
        matrix
    }
}

/// Eigenvalues of a symmetric matrix in rising order, by their trigonometric formula.
pub(super) fn eigenvalues(matrix: &[[f64; 3]; 3]) -> [f64; 3] {
    let mean = (matrix[0][0] + matrix[1][1] + matrix[2][2]) / 3.0;
    let mut shifted = *matrix;
    for (index, row) in shifted.iter_mut().enumerate() {
        row[index] -= mean;
    }
    let square: f64 = shifted.iter().flatten().map(|entry| entry * entry).sum();
    let scale = (square / 6.0).sqrt();
    if scale <= f64::EPSILON * mean.abs() {
        return [mean; 3];
    }
    let [a, b, c] = shifted;
    let determinant = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0]);
    let angle = (0.5 * determinant / scale.powi(3)).clamp(-1.0, 1.0).acos() / 3.0;
    let third = 2.0 * std::f64::consts::PI / 3.0;
    let of = |angle: f64| mean + 2.0 * scale * angle.cos();
    [of(angle + third), of(angle - third), of(angle)]
}
