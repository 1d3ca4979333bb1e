//! A target that widens away from the struck face: a truncated cone instead of a column.
//!
//! The cone stands for the half-space under a rigid disc [wolf1994]: its mouth is the disc, and its length follows from
//! the disc's static stiffness. Everything of it that a mesh needs is exact: the compliance between two sections, the mass, and
//! what an endless cone does behind the last node.

use std::f64::consts::FRAC_PI_2;

use crate::bisection::bisect;

/// A cone `A(z) = A₀ (1 + z/z₀)²` that starts at the struck face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cone {
    /// Area of its mouth [m2].
    area: f64,
    /// Distance z₀ from its apex to its mouth [m].
    apex: f64,
}

impl Cone {
    /// The cone under a disc of an area [m2] on a half-space of a Poisson's ratio: `z₀ = (π/2)(1 − ν²) a`.
    pub(super) fn under_disc(area: f64, poissons_ratio: f64) -> Self {
        let radius = (area / std::f64::consts::PI).sqrt();
        Self {
            area,
            apex: FRAC_PI_2 * (1.0 - poissons_ratio * poissons_ratio) * radius,
        }
    }

    /// Radius over that of the mouth.
    pub(super) fn stretch(self, z: f64) -> f64 {
        1.0 + z / self.apex
    }

    /// Distance of a depth from the apex [m].
    pub(super) fn distance_to_apex(self, z: f64) -> f64 {
        self.apex + z
    }

    /// Area at a depth [m2].
    pub(super) fn area_at(self, z: f64) -> f64 {
        self.area * self.stretch(z).powi(2)
    }

    /// Area of the prism between two depths [m2] that has the static stiffness of the frustum between them: the geometric
    /// mean of the areas of its ends, as `∫dz/A = (b − a)/√(A(a) A(b))`.
    pub(super) fn area_between(self, a: f64, b: f64) -> f64 {
        self.area * self.stretch(a) * self.stretch(b)
    }

    /// Volumes [m3] of the frustum between two depths that belong to its two ends, each point of it shared between them by its
    /// distance: volume and centre of volume are those of the frustum.
    pub(super) fn volumes_between(self, a: f64, b: f64) -> [f64; 2] {
        let (s, t) = (self.stretch(a), self.stretch(b));
        let twelfth = self.area * (b - a) / 12.0;
        [
            twelfth * (3.0 * s * s + 2.0 * s * t + t * t),
            twelfth * (s * s + 2.0 * s * t + 3.0 * t * t),
        ]
    }

    /// Static stiffness over Young's modulus of the endless cone beyond a depth [m].
    pub(super) fn stiffness_beyond(self, z: f64) -> f64 {
        self.area_at(z) / (self.apex + z)
    }
}

/// Sizes of elements that grow in proportion to the depth: `h(z) = first + growth z`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grading {
    first: f64,
    growth: f64,
}

impl Grading {
    /// Elements that fill a thickness, the first one as large as asked, or all alike where they can be as small as that.
    pub(super) fn new(first: f64, thickness: f64, elements: usize) -> Self {
        let count = elements as f64;
        if thickness <= first * count {
            return Self {
                first: thickness / count,
                growth: 0.0,
            };
        }
        // The number of elements that a growth needs falls with it.
        let has_more = |growth: f64| elements_to(first, growth, thickness) > count;
        let mut largest = 1.0;
        while has_more(largest) {
            largest *= 2.0;
        }
        let (_, growth) = bisect(0.0, largest, 100, has_more);
        Self { first, growth }
    }

    /// Elements between the face and a depth.
    pub(super) fn elements_to(self, z: f64) -> f64 {
        elements_to(self.first, self.growth, z)
    }

    /// Depths of the nodes of a layer between two depths.
    pub(super) fn nodes(self, from: f64, to: f64, elements: usize) -> Vec<f64> {
        let (a, b) = (self.elements_to(from), self.elements_to(to));
        (0..=elements)
            .map(|i| match i {
                0 => from,
                i if i == elements => to,
                i => self.depth_of(a + (b - a) * i as f64 / elements as f64),
            })
            .collect()
    }

    /// Depth with a number of elements before it.
    fn depth_of(self, elements: f64) -> f64 {
        if self.growth == 0.0 {
            self.first * elements
        } else {
            self.first * (elements * self.growth).exp_m1() / self.growth
        }
    }
}

/// `∫₀ᶻ dz/h(z)`.
fn elements_to(first: f64, growth: f64, z: f64) -> f64 {
    if growth == 0.0 {
        z / first
    } else {
        (growth * z / first).ln_1p() / growth
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CONE: Cone = Cone {
        area: 2e-5,
        apex: 3e-3,
    };

    #[test]
    fn it_is_as_stiff_as_a_half_space_under_a_disc() {
        let (radius, poissons_ratio): (f64, f64) = (2.4e-3, 0.33);
        let cone = Cone::under_disc(std::f64::consts::PI * radius * radius, poissons_ratio);
        let disc = 2.0 * radius / (1.0 - poissons_ratio * poissons_ratio);
        assert!((cone.stiffness_beyond(0.0) / disc - 1.0).abs() < 1e-14);
    }

    #[test]
    fn the_compliances_of_its_pieces_add_up() {
        let nodes = Grading::new(1e-4, 30e-3, 40).nodes(0.0, 30e-3, 40);
        let pieces: f64 = nodes
            .windows(2)
            .map(|pair| (pair[1] - pair[0]) / CONE.area_between(pair[0], pair[1]))
            .sum();
        let whole = pieces + 1.0 / CONE.stiffness_beyond(30e-3);
        assert!((whole * CONE.stiffness_beyond(0.0) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_volumes_of_its_pieces_add_up() {
        let nodes = Grading::new(1e-4, 30e-3, 40).nodes(0.0, 30e-3, 40);
        let volume: f64 = nodes
            .windows(2)
            .flat_map(|pair| CONE.volumes_between(pair[0], pair[1]))
            .sum();
        let exact = CONE.area * CONE.apex / 3.0 * (CONE.stretch(30e-3).powi(3) - 1.0);
        assert!((volume / exact - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_grading_starts_and_ends_where_it_should() {
        let grading = Grading::new(1e-4, 30e-3, 40);
        assert!((grading.elements_to(30e-3) - 40.0).abs() < 1e-9);
        let nodes = grading.nodes(0.0, 30e-3, 40);
        assert!((nodes[1] / 1e-4 - 1.0).abs() < 0.1, "{nodes:?}");
        assert!(nodes.windows(3).all(|n| n[2] - n[1] > n[1] - n[0]));
        let uniform = Grading::new(1e-3, 30e-3, 40).nodes(0.0, 30e-3, 40);
        assert!((uniform[7] - 7.0 * 0.75e-3).abs() < 1e-12);
    }
}
