//! Softening of the bonds of the lattice in space.

use super::{
    super::fracture::{self, Softening, Toughness},
    lattice::{Cubic, SIDE},
};

/// Energy of the bonds that a plane crack cuts, over their softening, the square of the strain of their start and the stiffness of nearest
/// neighbours: the mean over all directions of `½ Σ k d² |d·n|/V`.
pub(in super::super) const CUT: f64 = 0.5 * 4.598_076_211_353_316;
/// Softening and lattice factor, measured on a clamped plate with a slit, 24 cubes high (16 at 1): regular lattice, and irregular packing.
const REGULAR: fracture::Table = [(1.0, 2.26), (3.0, 1.44), (10.0, 1.39)];
const IRREGULAR: fracture::Table = [(1.0, 1.78), (3.0, 1.11), (10.0, 1.41)];

/// Factor on the energy that a crack needs.
pub(in super::super) fn lattice_factor(irregular: bool, softening: f64) -> f64 {
    fracture::interpolated(if irregular { IRREGULAR } else { REGULAR }, softening)
}

/// Softening times its lattice factor with which a lattice has both the fracture energy and the tensile strength of a solid.
pub(in super::super) fn exact_product(
    lattice: &Cubic,
    youngs_modulus: f64,
    toughness: Toughness,
) -> f64 {
    // A bond along the tension is strained by σ/E.
    let strain = toughness.strength / youngs_modulus;
    toughness.energy / (CUT * lattice.normal * strain * strain)
}

/// Softening by a ratio, each crack of which takes the fracture energy [J/m2].
pub(in super::super) fn softening(
    lattice: &Cubic,
    youngs_modulus: f64,
    energy: f64,
    end: f64,
    irregular: bool,
) -> [Softening; 2] {
    let square = energy / (CUT * lattice_factor(irregular, end) * lattice.normal * end);
    let strength = youngs_modulus * square.sqrt();
    [lattice.spacing(), SIDE * lattice.spacing()]
        .map(|length| Softening::of_strain(1.0 / (square * length), strength, end))
}
