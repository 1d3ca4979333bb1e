//! The equations of Alekseevskii and Tate: steady flow at the tip of a rod that loses length and speed.

use crate::{
    analytic::ode::{IntegrationError, Problem},
    error::NumericalError,
};

use super::super::long_rod::{failure, flattened};

/// Part of the length at which a rod counts as used up: with strength it never is, as its length falls exponentially.
const USED_UP: f64 = 1e-9;
/// Error of a step as a part of the quantity: the depth is good to ten digits.
const TOLERANCE: f64 = 1e-12;

/// A rod and a target, each with a density and a strength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rods {
    /// Density of the projectile [kg/m3].
    pub projectile_density: f64,
    /// Density of the target [kg/m3].
    pub target_density: f64,
    /// Strength Y of the projectile [Pa].
    pub projectile_strength: f64,
    /// Resistance R of the target [Pa].
    pub target_resistance: f64,
}

/// What a rod does at a speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// It erodes and penetrates.
    Eroding,
    /// It penetrates without losing length.
    Rigid,
    /// It erodes on the face of a target that it does not penetrate.
    Flattening,
}

/// Where a rod ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Depth of penetration [m].
    pub depth: f64,
    /// Part of it that the rod made rigid [m].
    pub rigid_depth: f64,
    /// Length left [m].
    pub length: f64,
    /// Speed of the tail when the erosion or the penetration ended [m/s].
    pub hand_over_speed: f64,
    /// Time at which the tip stopped [s].
    pub time: f64,
}

impl Rods {
    /// Speed above which the rod erodes or, when the target is stronger, penetrates [m/s].
    ///
    /// `√(2(Y − R)/ρ_t)` for Y > R: below, the rod is rigid. `√(2(R − Y)/ρ_p)` for R > Y: below, it does not penetrate.
    pub fn threshold(&self) -> f64 {
        let excess = self.projectile_strength - self.target_resistance;
        if excess > 0.0 {
            (2.0 * excess / self.target_density).sqrt()
        } else {
            (-2.0 * excess / self.projectile_density).sqrt()
        }
    }

    /// What the rod does at a speed [m/s].
    pub fn phase(&self, speed: f64) -> Phase {
        if speed > self.threshold() {
            Phase::Eroding
        } else if self.projectile_strength > self.target_resistance {
            Phase::Rigid
        } else {
            Phase::Flattening
        }
    }

    /// Ratio `μ = √(ρ_t/ρ_p)`, and `√(V² + A)` with `A = 2(R − Y)(1 − μ²)/ρ_t`.
    pub(super) fn roots(&self, speed: f64) -> (f64, f64) {
        let square = self.target_density / self.projectile_density;
        let strengths = 2.0 * (self.target_resistance - self.projectile_strength);
        let inside = speed * speed + strengths * (1.0 - square) / self.target_density;
        (square.sqrt(), inside.max(0.0).sqrt())
    }

    /// Speed of penetration of an eroding rod [m/s].
    ///
    /// `U = [V − μ√(V² + A)]/(1 − μ²)`, written as `[V² − 2(R − Y)/ρ_p]/[V + μ√(V² + A)]`, which holds at equal densities
    /// too: there it is `V/2 − (R − Y)/(ρV)`.
    pub fn penetration_speed(&self, speed: f64) -> f64 {
        let (ratio, root) = self.roots(speed);
        let strengths = 2.0 * (self.target_resistance - self.projectile_strength);
        (speed * speed - strengths / self.projectile_density)
            / (speed + ratio * root).max(f64::MIN_POSITIVE)
    }

    /// Speed at which an eroding rod is used up [m/s]: `V − U`, without its cancellation.
    pub fn erosion_speed(&self, speed: f64) -> f64 {
        let (ratio, root) = self.roots(speed);
        let strengths = 2.0 * (self.target_resistance - self.projectile_strength);
        (ratio * speed * root + strengths / self.projectile_density)
            / (speed + ratio * root).max(f64::MIN_POSITIVE)
    }

    /// Depth that the rod makes rigid from a speed [m/s] with a length [m]: `(ρ_p L/ρ_t) ln(1 + ρ_t V²/2R)` [m].
    pub fn rigid_depth(&self, speed: f64, length: f64) -> f64 {
        let pressure = 0.5 * self.target_density * speed * speed;
        self.projectile_density * length / self.target_density
            * (pressure / self.target_resistance).ln_1p()
    }

    /// Time that the rigid rod takes to stop [s]: `ρ_p L √(2/(ρ_t R)) arctan(V √(ρ_t/2R))`.
    fn rigid_time(&self, speed: f64, length: f64) -> f64 {
        let scale = (2.0 * self.target_resistance / self.target_density).sqrt();
        2.0 * self.projectile_density * length / (self.target_density * scale)
            * (speed / scale).atan()
    }

    /// Integrates a rod of a length [m] from its impact at a speed [m/s] to its end.
    ///
    /// # Errors
    /// When the integration finds no end.
    pub fn penetrate(&self, speed: f64, length: f64) -> Result<Stop, NumericalError> {
        let (eroded_speed, left, depth, time) = self.erode(speed, length).map_err(failure)?;
        let mut stop = Stop {
            depth,
            rigid_depth: 0.0,
            length: left,
            hand_over_speed: eroded_speed,
            time,
        };
        if left > USED_UP * length {
            if self.projectile_strength > self.target_resistance {
                stop.rigid_depth = self.rigid_depth(eroded_speed, left);
                stop.depth += stop.rigid_depth;
                stop.time += self.rigid_time(eroded_speed, left);
            } else {
                let (density, strength) = (self.projectile_density, self.projectile_strength);
                stop.length = flattened(left, eroded_speed, density, strength);
            }
        }
        if stop.length <= USED_UP * length {
            stop.length = 0.0;
        }
        Ok(stop)
    }

    /// Tail speed, length, depth and time at the end of the erosion.
    fn erode(&self, speed: f64, length: f64) -> Result<(f64, f64, f64, f64), IntegrationError> {
        let threshold = self.threshold();
        if speed <= threshold {
            return Ok((speed, length, 0.0, 0.0));
        }
        let rates = |&[tail, left, _]: &[f64; 3]| {
            // A trial step may go beyond the end, where the equations are others.
            let tail = tail.max(threshold);
            [
                -self.projectile_strength / (self.projectile_density * left),
                -self.erosion_speed(tail),
                self.penetration_speed(tail),
            ]
        };
        // Both measures are scaled to fall from about one.
        let event =
            |&[tail, left, _]: &[f64; 3]| ((tail - threshold) / speed).min(left / length - USED_UP);
        let end = Problem {
            rates: &rates,
            event: &event,
            relative: TOLERANCE,
            absolute: [TOLERANCE * speed, 0.0, TOLERANCE * length],
            first_step: 1e-3 * length / speed,
        }
        .solve([speed, length, 0.0], |_, _| ())?;
        let [tail, left, depth] = end.state;
        Ok((tail, left, depth, end.time))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rods(densities: (f64, f64), strengths: (f64, f64)) -> Rods {
        Rods {
            projectile_density: densities.0,
            target_density: densities.1,
            projectile_strength: strengths.0,
            target_resistance: strengths.1,
        }
    }

    #[test]
    fn the_pressures_on_both_sides_of_the_tip_are_equal() {
        for densities in [(17600.0, 7850.0), (7850.0, 7850.0), (2700.0, 7850.0)] {
            for strengths in [(1e9, 5e9), (3e9, 1e9), (1e9, 1e9)] {
                let rods = rods(densities, strengths);
                for speed in
                    [1.05, 1.5, 3.0, 10.0].map(|factor| factor * rods.threshold().max(300.0))
                {
                    let (u, w) = (rods.penetration_speed(speed), rods.erosion_speed(speed));
                    let behind = 0.5 * densities.0 * w * w + strengths.0;
                    let ahead = 0.5 * densities.1 * u * u + strengths.1;
                    assert!((behind / ahead - 1.0).abs() < 1e-12, "{rods:?} {speed}");
                    assert!((u + w - speed).abs() < 1e-12 * speed);
                }
            }
        }
    }

    #[test]
    fn equal_densities_have_their_own_formula() {
        let (density, y, r): (f64, f64, f64) = (7850.0, 1e9, 5e9);
        let equal = rods((density, density), (y, r));
        let exact = 0.5 * 2000.0 - (r - y) / (density * 2000.0);
        assert!((equal.penetration_speed(2000.0) / exact - 1.0).abs() < 1e-14);
        // The general formula divides by 1 − μ² and loses its digits near it; this one does not.
        let nearly = rods((density * (1.0 + 1e-10), density), (y, r));
        assert!((nearly.penetration_speed(2000.0) / exact - 1.0).abs() < 1e-9);
    }

    /// The rigid threshold has the target's density in it: it is where U = V. With the rod's, as a public code has it, U is not V.
    #[test]
    fn a_rod_turns_rigid_where_it_no_longer_erodes() {
        let rods = rods((17600.0, 7850.0), (5e9, 1e9));
        let threshold = rods.threshold();
        assert!((threshold - (2.0_f64 * 4e9 / 7850.0).sqrt()).abs() < 1e-9);
        assert!((rods.penetration_speed(threshold) / threshold - 1.0).abs() < 1e-7);
        let with_the_rods_density = (2.0_f64 * 4e9 / 17600.0).sqrt();
        assert!(
            (rods.penetration_speed(with_the_rods_density) / with_the_rods_density - 1.0).abs()
                > 0.1
        );
        assert_eq!(rods.phase(0.99 * threshold), Phase::Rigid);
        assert_eq!(rods.phase(1.01 * threshold), Phase::Eroding);
    }

    #[test]
    fn a_weak_rod_does_not_penetrate_below_its_threshold() {
        let rods = rods((7850.0, 2700.0), (1e9, 3e9));
        let threshold = rods.threshold();
        assert!((threshold - (2.0_f64 * 2e9 / 7850.0).sqrt()).abs() < 1e-9);
        assert!(rods.penetration_speed(threshold).abs() < 1e-9);
        assert_eq!(rods.phase(0.99 * threshold), Phase::Flattening);
        let stop = rods.penetrate(0.99 * threshold, 0.1).unwrap();
        assert_eq!(stop.depth, 0.0);
        let left = 0.1 * (-0.99_f64.powi(2) * 2.0).exp();
        assert!((stop.length / left - 1.0).abs() < 1e-12);
    }

    #[test]
    fn at_high_speed_the_depth_tends_to_the_hydrodynamic_limit() {
        for densities in [(17600.0, 7850.0), (7850.0, 7850.0), (2700.0, 7850.0)] {
            let rods = rods(densities, (1e6, 5e6));
            let limit = (densities.0 / densities.1).sqrt();
            let depth = rods.penetrate(10_000.0, 1.0).unwrap().depth;
            assert!((depth / limit - 1.0).abs() < 2e-4, "{depth} {limit}");
        }
    }

    /// A rigid rod under a constant pressure stops after `ρ L V²/2R`; here the inertia of the target goes to zero.
    #[test]
    fn a_rigid_rod_has_its_depth_and_time() {
        let light = rods((7850.0, 1e-3), (5e9, 1e9));
        let stop = light.penetrate(500.0, 0.1).unwrap();
        assert!((stop.depth / (7850.0 * 0.1 * 500.0 * 500.0 / 2e9) - 1.0).abs() < 1e-6);
        assert!((stop.time / (7850.0 * 0.1 * 500.0 / 1e9) - 1.0).abs() < 1e-6);
        assert_eq!((stop.length, stop.rigid_depth), (0.1, stop.depth));
    }
}
