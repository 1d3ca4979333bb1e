//! Softening of bonds: when a bond starts to fail, what it still carries and what its failure takes.

use super::lattice::{Lattice, Solid};
use crate::options::Space;

/// Least softening that is chosen by itself: abrupt bonds need far more energy than that of the fracture.
pub(super) const LEAST_SOFTENING: f64 = 3.0;
/// Largest one: beyond it forces change too little from step to step to matter.
pub(super) const LARGEST_SOFTENING: f64 = 1e4;
/// Rounds of the search for the softening, whose lattice factor depends on it.
const ROUNDS: usize = 30;
/// Softening and lattice factor of the regular lattice along its rows, measured on a clamped strip with a slit.
const REGULAR: [(f64, f64); 3] = [(1.0, 2.7), (3.0, 1.05), (10.0, 1.0)];
/// The same of the irregular packing, mean over five seeds; the first entry is an estimate.
const IRREGULAR: [(f64, f64); 3] = [(1.0, 3.6), (3.0, 1.22), (10.0, 1.05)];

/// Resistance of a solid to cracks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Toughness {
    /// Fracture energy [J/m2].
    pub(super) energy: f64,
    /// Tensile strength [Pa].
    pub(super) strength: f64,
}

/// Linear softening of bonds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Softening {
    /// Spacing over the square of the elongation at which a bond of that length starts to soften [1/m].
    per_square: f64,
    /// Stiffness of the shear spring over that of the normal one.
    ratio: f64,
    /// Elongation at which a bond has failed, in those at which it starts to soften.
    pub(super) end: f64,
}

/// Factor of a packing on the energy that a crack needs.
pub(super) fn lattice_factor(irregular: bool, softening: f64) -> f64 {
    let table = if irregular { IRREGULAR } else { REGULAR };
    let at = softening.clamp(table[0].0, table[2].0).ln();
    let piece = if softening < table[1].0 { 0 } else { 1 };
    let ((low, first), (high, second)) = (table[piece], table[piece + 1]);
    let part = (at - low.ln()) / (high.ln() - low.ln());
    first + part * (second - first)
}

/// Softening with which a lattice has both the fracture energy and the tensile strength of a solid, not less than 1; below
/// [`LEAST_SOFTENING`] the spacing is too large for both.
pub(super) fn exact_softening(
    (solid, space): (Solid, Space),
    lattice: &Lattice,
    toughness: Toughness,
    irregular: bool,
) -> f64 {
    let ratio = solid.poissons_ratio;
    let modulus = match space {
        Space::PlaneStrain => solid.youngs_modulus / (1.0 - ratio * ratio),
        Space::PlaneStress => solid.youngs_modulus,
    };
    // ½ k_n e₀² r = G_f d/(2 α), and a bond along the tension is strained by σ/E'.
    let by_factor = modulus * modulus * toughness.energy
        / (lattice.normal * lattice.spacing * toughness.strength * toughness.strength);
    let mut softening: f64 = by_factor;
    for _ in 0..ROUNDS {
        softening = 0.5 * (softening + by_factor / lattice_factor(irregular, softening));
    }
    softening
}

impl Softening {
    /// Softening by a ratio of a lattice, each crack of which takes the fracture energy [J/m2].
    pub(super) fn new(lattice: &Lattice, energy: f64, end: f64, irregular: bool) -> Self {
        let of_bond = 0.5 * energy * lattice.spacing / lattice_factor(irregular, end);
        let square = 2.0 * of_bond / (lattice.normal * end);
        Self {
            per_square: lattice.spacing / square,
            ratio: lattice.shear / lattice.normal,
            end,
        }
    }

    #[cfg(test)]
    /// Elongation of a bond of the regular lattice at which it starts to soften [m].
    pub(super) fn first_elongation(&self, spacing: f64) -> f64 {
        (spacing / self.per_square).sqrt()
    }

    /// Deformation of both springs of a bond, in elongations at which it starts to soften.
    #[inline(always)]
    pub(super) fn measure(&self, rest: f64, elongation: f64, slide: f64) -> f64 {
        let square = elongation * elongation + self.ratio * slide * slide;
        (square * self.per_square / rest).sqrt()
    }

    /// Part of its springs that a bond still has.
    #[inline(always)]
    pub(super) fn integrity(&self, worst: f64) -> f64 {
        let left = ((self.end - worst) / (worst.max(1.0) * (self.end - 1.0))).max(0.0);
        if worst > 1.0 { left } else { 1.0 }
    }

    /// Energy that the softening of a bond takes between two steps [J per m], of the deformations and largest elongations then;
    /// `normal` is the stiffness of its normal spring.
    ///
    /// It is the work of the mean of both forces less what the springs store: `½ k e₁ e₂ (D₂ − D₁)`. In steady growth this is the
    /// integral of the law, whatever the step.
    #[inline(always)]
    pub(super) fn taken(&self, rest: f64, normal: f64, from: [f64; 2], to: [f64; 2]) -> f64 {
        let gone = self.integrity(from[1]) - self.integrity(to[1]);
        0.5 * normal * rest / self.per_square * from[0] * to[0] * gone
    }
}
