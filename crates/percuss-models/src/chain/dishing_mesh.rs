//! The mesh of a plate that dishes: rings between circles, narrow at the rim of a plug.

use serde::{Deserialize, Serialize};

use std::f64::consts::PI;

use super::plate_section::{PlateSection, Ring};

/// Rings in a length of one thickness of the plate: bending waves shorter than the thickness are no plate theory's.
const RINGS_PER_THICKNESS: f64 = 6.0;
/// Rings would be so narrow at the plug, where strain gathers once the metal softens, and grow by a factor from one to the next.
const FIRST_RINGS_PER_THICKNESS: f64 = 48.0;
const GROWTH: f64 = 1.15;
/// Most rings away from the plug.
const MOST_RINGS: f64 = 4000.0;

/// A circle between two rings.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(super) struct Circle {
    /// [kg].
    pub(super) mass: f64,
    /// Rotary inertia [kg m2].
    pub(super) inertia: f64,
    pub(super) deflection: f64,
    pub(super) velocity: f64,
    pub(super) rotation: f64,
    pub(super) spin: f64,
    pub(super) force: f64,
    pub(super) moment: f64,
}

/// Rings of some widths from a radius on, and the circles between them.
pub(super) fn rings(
    section: &PlateSection,
    mut radius: f64,
    widths: &[f64],
) -> (Vec<Circle>, Vec<Ring>) {
    let mut circles = vec![Circle::default(); widths.len() + 1];
    let mut rings = Vec::with_capacity(widths.len());
    for (i, &width) in widths.iter().enumerate() {
        rings.push(Ring::new(section, radius + 0.5 * width, width));
        // A linear velocity field has the momentum that it should.
        let shares = [
            radius * width / 2.0 + width * width / 6.0,
            radius * width / 2.0 + width * width / 3.0,
        ];
        for (circle, share) in circles[i..=i + 1].iter_mut().zip(shares) {
            let mass = 2.0 * PI * section.areal_density() * share;
            circle.mass += mass;
            circle.inertia += mass * section.thickness * section.thickness / 12.0;
        }
        radius += width;
    }
    (circles, rings)
}

/// Width of what gathers strain at the rim of a plug in a plate of a thickness [m].
pub(super) fn rim_width(thickness: f64) -> f64 {
    thickness / FIRST_RINGS_PER_THICKNESS
}

/// Widths of rings that fill a span [m], narrow at its start.
pub(super) fn widths(span: f64, thickness: f64) -> Vec<f64> {
    let widest = (thickness / RINGS_PER_THICKNESS).max(span / MOST_RINGS);
    let first = rim_width(thickness);
    let mut widths: Vec<f64> = Vec::new();
    let mut filled = 0.0;
    while filled < span {
        let width = (first * GROWTH.powi(widths.len() as i32)).min(widest);
        filled += width;
        widths.push(width);
    }
    for width in &mut widths {
        *width *= span / filled;
    }
    widths
}
