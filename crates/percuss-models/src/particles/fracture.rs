//! Softening of bonds: when a bond starts to fail, what it still carries and what its failure takes.

use super::lattice::{Lattice, Solid};
use crate::options::{FailureCriterion, Space};

/// Least softening that is chosen by itself: abrupt bonds need far more energy than that of the fracture.
const LEAST_SOFTENING: f64 = 3.0;
/// Largest one: beyond it forces change too little from step to step to matter.
const LARGEST_SOFTENING: f64 = 1e4;
/// Least softening with which the energy that a crack takes does not grow with the size of the body, where bonds fail by the principal stress.
pub(super) const LEAST_BY_STRESS: f64 = 10.0;
/// Rounds of the search for the softening, whose lattice factor depends on it.
const ROUNDS: usize = 30;
/// Least deformation at which a bond starts to soften, and least one at which it has failed, in its start.
const LEAST_START: f64 = 1e-3;
const LEAST_END: f64 = 1.02;
/// Factors on the energy of a crack at three softenings, which rise.
pub(super) type Table = [(f64, f64); 3];
/// Softening and lattice factor of the regular lattice along its rows, measured on a clamped strip with a slit.
const REGULAR: Table = [(1.0, 2.7), (3.0, 1.05), (10.0, 1.0)];
/// The same of the irregular packing, mean over five seeds; the first entry is an estimate.
const IRREGULAR: Table = [(1.0, 3.6), (3.0, 1.22), (10.0, 1.05)];
/// Both where the principal stress around a bond starts its softening; the first entries are estimates.
const REGULAR_BY_STRESS: Table = [(1.0, 8.0), (3.0, 2.56), (10.0, 1.37)];
const IRREGULAR_BY_STRESS: Table = [(1.0, 8.0), (3.0, 2.52), (10.0, 1.26)];

/// Packing and failure criterion of bonds, on which the energy of a crack depends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BondKind {
    pub(super) irregular: bool,
    pub(super) criterion: FailureCriterion,
}

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
    /// Stress at which bonds start to soften by the principal stress [Pa].
    pub(super) strength: f64,
    /// Whether they do so.
    pub(super) by_stress: bool,
    /// Elongation at which a bond has failed, in those at which it starts to soften.
    pub(super) end: f64,
}

/// Factor of a kind of bonds on the energy that a crack needs.
pub(super) fn lattice_factor(bonds: BondKind, softening: f64) -> f64 {
    let table = match (bonds.criterion, bonds.irregular) {
        (FailureCriterion::Elongation, false) => REGULAR,
        (FailureCriterion::Elongation, true) => IRREGULAR,
        (FailureCriterion::PrincipalStress, false) => REGULAR_BY_STRESS,
        (FailureCriterion::PrincipalStress, true) => IRREGULAR_BY_STRESS,
    };
    interpolated(table, softening)
}

/// Value of a table at a softening.
pub(super) fn interpolated(table: Table, softening: f64) -> f64 {
    let at = softening.clamp(table[0].0, table[2].0).ln();
    let piece = if softening < table[1].0 { 0 } else { 1 };
    let ((low, first), (high, second)) = (table[piece], table[piece + 1]);
    let part = (at - low.ln()) / (high.ln() - low.ln());
    first + part * (second - first)
}

/// Softening times its lattice factor with which a lattice has both the fracture energy and the tensile strength of a solid.
pub(super) fn exact_product(
    (solid, space): (Solid, Space),
    lattice: &Lattice,
    toughness: Toughness,
) -> f64 {
    let ratio = solid.poissons_ratio;
    let modulus = match space {
        Space::PlaneStrain => solid.youngs_modulus / (1.0 - ratio * ratio),
        Space::PlaneStress | Space::ThreeDimensional => solid.youngs_modulus,
    };
    // ½ k_n e₀² r = G_f d/(2 α), and a bond along the tension is strained by σ/E'.
    modulus * modulus * toughness.energy
        / (lattice.normal * lattice.spacing * toughness.strength * toughness.strength)
}

/// Softening of the bonds of a case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Softenings {
    /// The one that is used.
    pub(super) used: f64,
    /// Spacing at which the least one has both the energy and the strength of the solid, over that of the case: less than 1 where the particles
    /// are too far apart for both.
    pub(super) fitting: f64,
}

impl Softenings {
    /// The given softening, or the one whose product with its lattice factor is that of the solid.
    pub(super) fn of(product: f64, factor: impl Fn(f64) -> f64, given: Option<f64>) -> Self {
        let mut softening = product;
        for _ in 0..ROUNDS {
            softening = 0.5 * (softening + product / factor(softening));
        }
        Self {
            used: given.unwrap_or(softening.clamp(LEAST_SOFTENING, LARGEST_SOFTENING)),
            // The product is as one over the spacing.
            fitting: product / (LEAST_SOFTENING * factor(LEAST_SOFTENING)),
        }
    }
}

impl Softening {
    /// Softening by a ratio of a lattice, each crack of which takes the fracture energy [J/m2].
    pub(super) fn new(lattice: &Lattice, energy: f64, end: f64, bonds: BondKind) -> Self {
        let of_bond = 0.5 * energy * lattice.spacing / lattice_factor(bonds, end);
        let square = 2.0 * of_bond / (lattice.normal * end);
        Self {
            per_square: lattice.spacing / square,
            ratio: lattice.shear / lattice.normal,
            strength: lattice.plane_modulus() * square.sqrt() / lattice.spacing,
            by_stress: bonds.criterion == FailureCriterion::PrincipalStress,
            end,
        }
    }

    /// Softening of bonds without a shear spring, by their elongation: one over the length of a bond and the square of the strain of its start [1/m], and the
    /// strength that it stands for [Pa].
    pub(super) fn of_strain(per_square: f64, strength: f64, end: f64) -> Self {
        Self {
            per_square,
            ratio: 0.0,
            strength,
            by_stress: false,
            end,
        }
    }

    /// The same law, of which it is known how bonds start to soften.
    #[inline(always)]
    pub(super) fn with_criterion(&self, by_stress: bool) -> Self {
        Self { by_stress, ..*self }
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

    /// Part of its springs that a bond still has, of its largest deformation and that at which it started to soften.
    #[inline(always)]
    pub(super) fn integrity(&self, worst: f64, start: f64) -> f64 {
        let end = self.end_of(start);
        let left = (start * (end - worst) / (worst.max(start) * (end - start))).max(0.0);
        if start > 0.0 { left.min(1.0) } else { 1.0 }
    }

    /// Deformation at which a bond has failed that started to soften at one: its energy is that of all bonds.
    #[inline(always)]
    pub(super) fn end_of(&self, start: f64) -> f64 {
        if !self.by_stress {
            return self.end;
        }
        let start = start.max(LEAST_START);
        (self.end / start).max(LEAST_END * start)
    }

    /// Energy that the softening of a bond takes between two steps [J per m], of the deformations and what was left of it then;
    /// `normal` is the stiffness of its normal spring.
    ///
    /// It is the work of the mean of both forces less what the springs store: `½ k e₁ e₂ (D₂ − D₁)`. In steady growth this is the
    /// integral of the law, whatever the step.
    #[inline(always)]
    pub(super) fn taken(&self, rest: f64, normal: f64, from: [f64; 2], to: [f64; 2]) -> f64 {
        0.5 * normal * rest / self.per_square * from[0] * to[0] * (from[1] - to[1])
    }
}
