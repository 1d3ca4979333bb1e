//! Mass that moves with the floor of a crater while the zone around it forms.

use std::f64::consts::PI;

/// Mass of target and rod that moves with a floor [kg], or per area of the floor [kg/m2].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MovingMass {
    /// After the first contact.
    pub(super) first: f64,
    /// Of a floor below the entry.
    pub(super) full: f64,
    /// Radius b of that floor [m].
    pub(super) radius: f64,
    /// Depth at which the growth begins [m].
    pub(super) from: f64,
}

impl MovingMass {
    /// The mass at a depth P [m] and its slope per depth: it grows with the area of a hemispherical floor in contact, `1 − (1 − P/b)²`.
    pub(super) fn at(&self, depth: f64) -> (f64, f64) {
        let rest = (1.0 - (depth - self.from) / self.radius).clamp(0.0, 1.0);
        let more = self.full - self.first;
        (
            self.full - more * rest * rest,
            2.0 * more * rest / self.radius,
        )
    }

    /// Area of the floor [m2].
    pub(super) fn area(&self) -> f64 {
        PI * self.radius * self.radius
    }
}
