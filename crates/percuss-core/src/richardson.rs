//! Richardson extrapolation: observed order of convergence and extrapolated value from three meshes \[richardson1911, roache1994\].

use crate::bisection::bisected;

/// Orders that an extrapolation is trusted with: the schemes are of second order at best, and one half belongs to a front that still
/// widens.
pub const CREDIBLE_ORDERS: std::ops::RangeInclusive<f64> = 0.5..=2.2;
/// Factor of safety of an extrapolation from three meshes: that of the grid convergence index \[roache1994\].
pub const SAFETY: f64 = 1.25;
/// Differences between meshes below this part of the value are rounding, not convergence.
const NEGLIGIBLE: f64 = 1e-9;
/// Largest order that is looked for; a sequence that falls faster than this is reported with it.
const LARGEST_ORDER: f64 = 64.0;
/// Halvings of the interval of the order: the last digit of a number.
const HALVINGS: u32 = 64;

/// A result on one mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OnMesh {
    /// Cells along a given length.
    pub cells: f64,
    /// Value on this mesh.
    pub value: f64,
}

/// Behaviour of a result over three meshes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Trend {
    /// The two finest meshes agree to rounding.
    Exact,
    /// The differences have one sign and shrink as a power of the cell size.
    Monotone {
        /// Observed order of convergence.
        order: f64,
    },
    /// The differences shrink but change their sign.
    Oscillating,
    /// The differences do not shrink.
    Diverging,
}

/// The trend over a coarse, a medium and a fine mesh, and the observed order p of `f(h) = f₀ + C hᵖ`:
///
/// `(f₁ − f₂)/(f₂ − f₃) = (h₁ᵖ − h₂ᵖ)/(h₂ᵖ − h₃ᵖ)`, with any ratios of the cell sizes `h₁ > h₂ > h₃`.
pub fn trend([coarse, medium, fine]: [OnMesh; 3]) -> Trend {
    let (first, second) = (coarse.value - medium.value, medium.value - fine.value);
    let scale = fine.value.abs().max(coarse.value.abs());
    if second.abs() <= NEGLIGIBLE * scale {
        return Trend::Exact;
    }
    let (above, below) = (medium.cells / coarse.cells, fine.cells / medium.cells);
    let ratio = first / second;
    // At order 0 the error is linear in the logarithm of the cell size.
    if ratio.is_nan() || ratio.abs() <= above.ln() / below.ln() {
        return Trend::Diverging;
    }
    if ratio < 0.0 {
        return Trend::Oscillating;
    }
    let at = |order: f64| (above.powf(order) - 1.0) / (1.0 - below.powf(-order));
    Trend::Monotone {
        order: bisected(0.0, LARGEST_ORDER, HALVINGS, |order| at(order) < ratio),
    }
}

/// Value at zero cell size by the two finest meshes and an order p: `f₃ + (f₃ − f₂)/(rᵖ − 1)`, r the ratio of their cell sizes.
pub fn extrapolate(medium: OnMesh, fine: OnMesh, order: f64) -> f64 {
    let ratio = (fine.cells / medium.cells).powf(order);
    fine.value + (fine.value - medium.value) / (ratio - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn meshes(cells: [f64; 3], value: impl Fn(f64) -> f64) -> [OnMesh; 3] {
        cells.map(|cells| OnMesh {
            cells,
            value: value(1.0 / cells),
        })
    }

    #[test]
    fn an_error_that_is_a_power_of_the_cell_size_has_its_order_and_its_limit() {
        for cells in [[4.0, 8.0, 16.0], [4.0, 6.0, 8.0], [4.0, 8.0, 12.0]] {
            for order in [0.3, 1.0, 2.0, 3.5] {
                for constant in [7.7, -7.7] {
                    let meshes = meshes(cells, |h| 8.5 + constant * h.powf(order));
                    let Trend::Monotone { order: found } = trend(meshes) else {
                        panic!("{cells:?} {order}: {:?}", trend(meshes));
                    };
                    assert!((found - order).abs() < 1e-9, "{cells:?} {order} {found}");
                    let limit = extrapolate(meshes[1], meshes[2], found);
                    assert!((limit - 8.5).abs() < 1e-9, "{cells:?} {order} {limit}");
                }
            }
        }
    }

    #[test]
    fn what_does_not_approach_a_limit_from_one_side_has_no_order() {
        let trend = |values: [f64; 3]| {
            trend([0, 1, 2].map(|i| OnMesh {
                cells: [4.0, 6.0, 8.0][i],
                value: values[i],
            }))
        };
        assert_eq!(trend([1.0, 1.2, 1.1]), Trend::Oscillating);
        assert_eq!(trend([1.0, 1.1, 1.3]), Trend::Diverging);
        assert_eq!(trend([1.0, 1.1, 0.8]), Trend::Diverging);
        assert_eq!(trend([1.0, 1.2, 1.2]), Trend::Exact);
        assert_eq!(trend([1.0, 1.0, 1.1]), Trend::Diverging);
        assert_eq!(trend([1.0, f64::NAN, 1.1]), Trend::Diverging);
        // Between 6 and 8 cells the size falls by less than between 4 and 6: differences of 1 and 0.8 do not converge.
        assert_eq!(trend([3.0, 2.0, 1.2]), Trend::Diverging);
    }

    #[test]
    fn a_logarithm_of_the_cell_size_has_no_limit() {
        let at = |order: f64| trend(meshes([4.0, 6.0, 8.0], |h| (h.powf(order) - 1.0) / order));
        assert!(matches!(at(1e-3), Trend::Monotone { order } if (order - 1e-3).abs() < 1e-6));
        assert_eq!(at(-1e-3), Trend::Diverging);
    }
}
