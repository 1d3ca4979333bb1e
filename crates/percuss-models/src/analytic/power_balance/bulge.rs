//! Shape of the plate around a projectile: the sum of all its dishes.

/// Rings in which the shape is kept, and the radius of the last one over that of the first, less 1: beyond it no dish is looked for.
const RINGS: i32 = 120;
const EXTENT: f64 = 50.0;
/// Distance of the first two rings over the radius of the first one.
const FIRST: f64 = 0.01;

/// Plastic deflection of a plate over the radius.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Bulge {
    /// Radius and deflection of rings from the rim of the projectile outwards [m].
    pub rings: Vec<[f64; 2]>,
}

impl Bulge {
    /// A flat plate around a projectile of this radius [m].
    pub fn new(rim: f64) -> Self {
        let growth = (EXTENT / FIRST).powf(1.0 / f64::from(RINGS - 1));
        let radii = (0..RINGS).map(|ring| rim * (1.0 + FIRST * growth.powi(ring)));
        Self {
            rings: std::iter::once(rim)
                .chain(radii)
                .map(|radius| [radius, 0.0])
                .collect(),
        }
    }

    /// Adds a dish: deflection of the rim, falling to zero at the edge along a straight line [m].
    pub fn add(&mut self, edge: f64, deflection: f64) {
        let Some(&[rim, _]) = self.rings.first().filter(|_| deflection != 0.0) else {
            return;
        };
        let moved = self
            .rings
            .iter_mut()
            .take_while(|[radius, _]| *radius < edge);
        for [radius, sum] in moved {
            *sum += deflection * (edge - *radius) / (edge - rim);
        }
    }

    /// Deflection of the rim [m].
    pub fn depth(&self) -> f64 {
        self.rings.first().map_or(0.0, |ring| ring[1])
    }

    /// Radius at which half of the rim's deflection is left [m].
    pub fn half_radius(&self) -> Option<f64> {
        let half = 0.5 * self.depth();
        let pairs = self.rings.iter().zip(self.rings.get(1..)?);
        let mut pairs = pairs.filter(|(a, b)| a[1] > half && b[1] <= half);
        let ([inner, high], [outer, low]) = pairs.next()?;
        Some(inner + (outer - inner) * (high - half) / (high - low))
    }
}
