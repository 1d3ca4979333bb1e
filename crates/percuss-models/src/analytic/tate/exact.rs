//! The implicit solution of the equations: length as a closed form in the speed of the tail, depth and time as integrals.
//!
//! `dL/dV = ρ_p L (V − U)/Y` has the integral `ln(L/L₀) = (ρ_p/Y)[F(V) − F(V₀)]` with `F' = V − U`. The textbook form
//! `F = μ/(1 − μ²) ½[V√(V² + A) + A ln(V + √(V² + A)) − μV²]` is rewritten, with `a = 2(R − Y)/ρ_t` and `S = √(V² + A)`, as
//! `F = ½ μ [V (V² + a)/(S + μV) + a ln(V + S)]`, which holds at equal densities as well. Derived here; the works that give such a
//! solution \[walters1991, segletes2003\] could not be read beyond a first page.

use super::{super::gauss::integral, equations::Rods};

/// Panels of the integral over the speed.
const PANELS: u32 = 400;

impl Rods {
    /// Part of the length that is left when the tail has slowed from one speed to another [m/s] while the rod erodes.
    fn length_left(&self, from: f64, to: f64) -> f64 {
        (self.projectile_density / self.projectile_strength
            * (self.primitive(to) - self.primitive(from) + self.logarithm(from, to)))
        .exp()
    }

    fn resistance_term(&self) -> f64 {
        2.0 * (self.target_resistance - self.projectile_strength) / self.target_density
    }

    /// The algebraic part of F.
    fn primitive(&self, speed: f64) -> f64 {
        let (ratio, root) = self.roots(speed);
        0.5 * ratio * speed * (speed * speed + self.resistance_term()) / (root + ratio * speed)
    }

    /// The logarithmic part of `F(to) − F(from)`.
    fn logarithm(&self, from: f64, to: f64) -> f64 {
        let (ratio, root) = self.roots(from);
        let (_, root_after) = self.roots(to);
        0.5 * ratio * self.resistance_term() * ((to + root_after) / (from + root)).ln()
    }

    /// Depth that the rod makes while its tail slows from one speed to another [m/s], over its length at the first of them:
    /// `(ρ_p/Y) ∫ U L/L₀ dV`.
    fn eroding_depth(&self, from: f64, to: f64) -> f64 {
        let rate = |speed: f64| self.penetration_speed(speed) * self.length_left(from, speed);
        self.projectile_density / self.projectile_strength * integral(to, from, PANELS, rate)
    }
}

/// The integration in time and the implicit solution share only the speed of penetration.
#[test]
fn the_integration_in_time_meets_the_implicit_solution() {
    let mut worst: f64 = 0.0;
    for densities in [
        (17600.0, 7850.0),
        (7850.0, 7850.0),
        (7850.0, 7849.999),
        (8960.0, 2700.0),
        (2700.0, 7850.0),
    ] {
        for (y, r) in [(1e9, 5e9), (0.5e9, 1e9), (5e9, 1.2e9), (2e9, 2e9)] {
            let rods = Rods {
                projectile_density: densities.0,
                target_density: densities.1,
                projectile_strength: y,
                target_resistance: r,
            };
            let threshold = rods.threshold();
            for speed in [1000.0, 1500.0, 2000.0, 3000.0] {
                if speed <= threshold {
                    continue;
                }
                let stop = rods.penetrate(speed, 0.2).unwrap();
                let left = 0.2 * rods.length_left(speed, threshold);
                let mut depth = 0.2 * rods.eroding_depth(speed, threshold);
                let mut length = left;
                if y > r {
                    depth += rods.rigid_depth(threshold, left);
                } else {
                    length *= (-(r - y) / y).exp();
                }
                worst = worst.max((stop.depth / depth - 1.0).abs());
                if length > 1e-6 * 0.2 {
                    worst = worst.max((stop.length / length - 1.0).abs());
                }
            }
        }
    }
    println!("largest difference: {worst:.1e}");
    assert!(worst < 1e-8, "{worst:e}");
}

#[test]
fn the_rewritten_primitive_is_the_textbook_one() {
    let rods = Rods {
        projectile_density: 17600.0,
        target_density: 7850.0,
        projectile_strength: 1.5e9,
        target_resistance: 5e9,
    };
    let ratio: f64 = (7850.0_f64 / 17600.0).sqrt();
    let difference = 1.0 - ratio * ratio;
    let a = 2.0 * 3.5e9 * difference / 7850.0;
    let textbook = |v: f64| {
        let root = (v * v + a).sqrt();
        ratio / difference * 0.5 * (v * root + a * (v + root).ln() - ratio * v * v)
    };
    let exact = (17600.0 / 1.5e9 * (textbook(1000.0) - textbook(2000.0))).exp();
    assert!((rods.length_left(2000.0, 1000.0) / exact - 1.0).abs() < 1e-12);
}
