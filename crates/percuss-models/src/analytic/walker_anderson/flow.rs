//! Flow of the target around the tip: how far the plastic zone reaches, and what it resists.

/// Iterations of Newton's method with bisection: quadratic convergence needs a handful.
const ITERATIONS: u32 = 100;

/// A target that flows around a crater.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Flow {
    /// Density [kg/m3].
    pub(super) density: f64,
    /// Shear modulus [Pa].
    pub(super) shear_modulus: f64,
    /// Flow stress [Pa].
    pub(super) strength: f64,
    /// Bulk sound speed c₀ [m/s].
    pub(super) sound_speed: f64,
    /// Slope k of shock speed against particle speed.
    pub(super) slope: f64,
}

/// Extent of the plastic zone in crater radii and its slope with the speed of penetration [s/m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Extent {
    pub(super) alpha: f64,
    pub(super) slope: f64,
}

impl Flow {
    /// Extent of the plastic zone at a speed of penetration [m/s]: the root α of
    /// `(1 + ρu²/Y) √(K − ρα²u²) = (1 + ρα²u²/2G) √(K − ρu²)`, `K = ρ(c₀ + ku)²`.
    ///
    /// There is one root between 1 and the smaller of `√(2G/Y)` and `√(K/ρ)/u`, as the difference of the logarithms falls in α.
    pub(super) fn extent(&self, speed: f64) -> Extent {
        let dynamic = self.density * speed * speed;
        let (shear, yield_stress) = (2.0 * self.shear_modulus, self.strength);
        let wave = self.sound_speed + self.slope * speed;
        let bulk = self.density * wave * wave;
        // z is α². Divided by ρu², so that the limit of a slow tip is regular.
        let scaled = |numerator: f64| {
            if dynamic > 0.0 {
                (dynamic * numerator).ln_1p() / dynamic
            } else {
                numerator
            }
        };
        let balance = |z: f64| {
            scaled(1.0 / yield_stress) + 0.5 * scaled(-z / bulk)
                - scaled(z / shear)
                - 0.5 * scaled(-1.0 / bulk)
        };
        let balance_slope = |z: f64| -0.5 / (bulk - z * dynamic) - 1.0 / (shear + z * dynamic);
        let mut low = 1.0;
        let mut high = shear / yield_stress;
        if dynamic > 0.0 {
            high = high.min(bulk / dynamic);
        }
        let mut z = high * (1.0 - 1e-12);
        for _ in 0..ITERATIONS {
            let value = balance(z);
            if value > 0.0 {
                low = z;
            } else {
                high = z;
            }
            let newton = z - value / balance_slope(z);
            let next = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
            let change = (next - z).abs();
            z = next;
            if change <= 1e-15 * z {
                break;
            }
        }
        let with_dynamic = 1.0 / (yield_stress + dynamic)
            - 0.5 * z / (bulk - z * dynamic)
            - z / (shear + z * dynamic)
            + 0.5 / (bulk - dynamic);
        // `½/(K − zρu²) − ½/(K − ρu²)` over ρu².
        let with_bulk = 0.5 * (z - 1.0) / ((bulk - z * dynamic) * (bulk - dynamic));
        let bulk_slope = 2.0 * self.density * self.slope * wave;
        let slope = if dynamic > 0.0 {
            let with_speed = with_dynamic * 2.0 / speed + with_bulk * bulk_slope;
            -with_speed / balance_slope(z)
        } else {
            -with_bulk * bulk_slope / balance_slope(z)
        };
        let alpha = z.sqrt();
        Extent {
            alpha,
            slope: 0.5 * slope / alpha,
        }
    }

    /// Resistance `(7/3) Y ln α` [Pa].
    pub(super) fn resistance(&self, alpha: f64) -> f64 {
        7.0 / 3.0 * self.strength * alpha.ln()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEEL: Flow = Flow {
        density: 7850.0,
        shear_modulus: 77e9,
        strength: 1e9,
        sound_speed: 4570.0,
        slope: 1.49,
    };

    #[test]
    fn the_root_solves_the_equation_as_printed() {
        for speed in [1.0, 100.0, 500.0, 1000.0, 2000.0, 4000.0] {
            let alpha = STEEL.extent(speed).alpha;
            let dynamic = 7850.0 * speed * speed;
            let bulk = 7850.0 * (4570.0_f64 + 1.49 * speed).powi(2);
            let left = (1.0 + dynamic / 1e9) * (bulk - alpha * alpha * dynamic).sqrt();
            let right = (1.0 + alpha * alpha * dynamic / (2.0 * 77e9)) * (bulk - dynamic).sqrt();
            assert!(alpha > 1.0 && (left / right - 1.0).abs() < 1e-12, "{speed}");
        }
    }

    #[test]
    fn the_slope_is_the_derivative() {
        for speed in [10.0, 300.0, 1500.0, 3000.0] {
            let step = 1e-4 * speed;
            let difference = (STEEL.extent(speed + step).alpha - STEEL.extent(speed - step).alpha)
                / (2.0 * step);
            let slope = STEEL.extent(speed).slope;
            assert!(
                (slope / difference - 1.0).abs() < 1e-5,
                "{speed} {slope} {difference}"
            );
        }
    }

    /// With `K → ∞` the root is `√(2G/Y)` at any speed; so it is, nearly, of a slow tip.
    #[test]
    fn an_incompressible_target_has_the_cylindrical_extent() {
        let stiff = Flow {
            sound_speed: 1e8,
            ..STEEL
        };
        let exact = (2.0_f64 * 77e9 / 1e9).sqrt();
        for speed in [0.0, 10.0, 1000.0, 3000.0] {
            let extent = stiff.extent(speed);
            assert!((extent.alpha / exact - 1.0).abs() < 1e-6);
            assert!(extent.slope.abs() < 1e-6);
        }
        let slow = STEEL.extent(0.0).alpha;
        assert!((STEEL.extent(1e-3).alpha / slow - 1.0).abs() < 1e-6);
    }

    #[test]
    fn a_faster_tip_has_a_smaller_plastic_zone() {
        let mut before = f64::INFINITY;
        for speed in 0..40 {
            let alpha = STEEL.extent(100.0 * f64::from(speed)).alpha;
            assert!(alpha < before && alpha > 1.0);
            before = alpha;
        }
    }
}
