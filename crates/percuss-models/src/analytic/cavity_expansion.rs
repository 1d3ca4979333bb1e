//! Dynamic expansion of a spherical cavity in a compressible elastic, perfectly plastic body: the similarity solution.

use std::{cell::RefCell, collections::VecDeque};

use super::ode::fourth_order;
use crate::{
    bisection::bisected,
    material::{Material, cavity_expansion_pressure, plastic_cavity_pressure},
};

/// Steps of the integration from the elastic-plastic interface to the cavity: the pressure is good to 1e-6 up to half of
/// [`LARGEST_INTERFACE_SPEED`], to 1e-5 at it.
const STEPS: u32 = 200;
/// Largest interface speed over the bulk sound speed; near 1 the plastic front becomes a shock, which the solution has not.
const LARGEST_INTERFACE_SPEED: f64 = 0.95;
/// Speeds of the least-squares fit, evenly spaced.
const FIT_SPEEDS: u32 = 8;
const ROOT_TOLERANCE: f64 = 1e-10;
const ROOT_STEPS: u32 = 100;

/// A body in which a spherical cavity expands from nothing at constant speed \[forrestal1988b\].
///
/// Radial momentum and mass with `ξ = r/(c t)`, `c` the speed of the elastic-plastic interface, `U = v/c`, `S = σ_r/K`,
/// `T = Y/K`, `β² = ρ₀ c²/K`, yield `σ_r − σ_θ = Y` and pressure `p = K (1 − ρ₀/ρ)`:
///
/// `U' = −2U/ξ + w S'`, `S' = −2T/ξ + β² w U'`, `w = (ξ − U)/(1 − η)`, `η = S − 2T/3`.
///
/// Outside the interface the body is linear elastic, at rest beyond the front of the longitudinal wave; continuity of radial
/// stress and particle velocity gives `U(1) = Y/(2G)` and `S(1) = (Y/G) α²/(1 + α) + 2T/3`, α the interface speed over that of the
/// wave. The cavity is where `U = ξ`. Derived in `docs/models/forrestal.md`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CavityExpansion {
    /// Density at rest [kg/m3].
    pub density: f64,
    /// Young's modulus [Pa].
    pub youngs_modulus: f64,
    /// Poisson's ratio, below 0.5.
    pub poissons_ratio: f64,
    /// Yield stress Y [Pa].
    pub yield_stress: f64,
}

/// `σ_r = strength + inertia ρ v²` at the cavity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CavityFit {
    /// Static pressure `A Y` [Pa].
    pub strength: f64,
    /// Coefficient B.
    pub inertia: f64,
    /// Largest expansion speed of the fit [m/s].
    pub largest_speed: f64,
    /// Largest difference between fit and solution over the solution.
    pub worst: f64,
}

/// What the solution gives at the cavity for one interface speed.
#[derive(Debug, Clone, Copy)]
struct AtCavity {
    /// Radius of the cavity over that of the interface: also their speeds' ratio.
    ratio: f64,
    pressure: f64,
}

/// [`CavityExpansion::extents`] of a body.
struct Extents {
    body: CavityExpansion,
    steps: u32,
    extents: Vec<(f64, f64)>,
}

/// Bodies whose extents are remembered.
const MOST_EXTENTS: usize = 16;

thread_local! {
    /// The last extents, the latest first.
    static EXTENTS: RefCell<VecDeque<Extents>> = const { RefCell::new(VecDeque::new()) };
}

impl CavityExpansion {
    /// The body of a material, perfectly plastic at [`effective_yield_stress`]; `None` for a law that never flows.
    pub fn of(material: &Material) -> Option<Self> {
        Some(Self {
            density: material.density.si(),
            youngs_modulus: material.youngs_modulus.si(),
            poissons_ratio: material.poissons_ratio,
            yield_stress: effective_yield_stress(material)?,
        })
    }

    fn shear_modulus(&self) -> f64 {
        self.youngs_modulus / (2.0 * (1.0 + self.poissons_ratio))
    }

    fn bulk_modulus(&self) -> f64 {
        self.youngs_modulus / (3.0 * (1.0 - 2.0 * self.poissons_ratio))
    }

    /// Bulk sound speed [m/s].
    pub fn bulk_sound_speed(&self) -> f64 {
        (self.bulk_modulus() / self.density).sqrt()
    }

    /// Pressure that expands the cavity slowly [Pa]: the limit of the solution at zero speed.
    pub fn static_pressure(&self) -> f64 {
        self.at_cavity(0.0).pressure
    }

    /// The same in small strain, `(2Y/3)[1 + ln(E/(3(1 − ν)Y))]` [Pa]: right up to terms of the order of Y/E.
    pub fn static_pressure_in_small_strain(&self) -> f64 {
        let ratio = self.youngs_modulus / (3.0 * (1.0 - self.poissons_ratio) * self.yield_stress);
        2.0 / 3.0 * self.yield_stress * (1.0 + ratio.ln())
    }

    /// Radial stress at a cavity that expands at a speed [m/s] [Pa]; `None` above [`Self::largest_speed`].
    pub fn pressure(&self, speed: f64) -> Option<f64> {
        self.pressure_below(self.largest_speed(), speed)
    }

    /// The same where the largest speed is known [m/s].
    fn pressure_below(&self, largest_speed: f64, speed: f64) -> Option<f64> {
        if speed <= 0.0 {
            return Some(self.static_pressure());
        }
        self.at_speed(largest_speed, speed).map(|at| at.pressure)
    }

    /// Largest expansion speed without a plastic shock that the solution is used at [m/s].
    pub fn largest_speed(&self) -> f64 {
        let at = self.at_cavity(LARGEST_INTERFACE_SPEED);
        self.speed(at, LARGEST_INTERFACE_SPEED)
    }

    /// Fits `A Y + B ρ v²` over expansion speeds from zero to `speed` [m/s], or to [`Self::largest_speed`] if that is less.
    ///
    /// `A Y` is the static limit; B is the least-squares slope over evenly spaced speeds. At zero speed it is the slope at
    /// a thousandth of the bulk sound speed.
    pub fn fit(&self, speed: f64) -> CavityFit {
        let strength = self.static_pressure();
        let slowest = 1e-3 * self.bulk_sound_speed();
        let fastest = self.largest_speed();
        let largest_speed = speed.max(slowest).min(fastest);
        let points: Vec<(f64, f64)> = (1..=FIT_SPEEDS)
            .filter_map(|i| {
                let speed = largest_speed * f64::from(i) / f64::from(FIT_SPEEDS);
                let pressure = self.pressure_below(fastest, speed)?;
                Some((self.density * speed * speed, pressure))
            })
            .collect();
        let product: f64 = points.iter().map(|(x, p)| x * (p - strength)).sum();
        let square: f64 = points.iter().map(|(x, _)| x * x).sum();
        let inertia = product / square;
        let worst = points
            .iter()
            .map(|(x, p)| ((strength + inertia * x) / p - 1.0).abs())
            .fold(0.0, f64::max);
        CavityFit {
            strength,
            inertia,
            largest_speed,
            worst,
        }
    }

    /// Expansion speeds [m/s] and radii of the interface over those of the cavity, for interface speeds from zero to the largest, evenly spaced.
    ///
    /// Remembered: runs of a study mostly have the same target.
    pub(super) fn extents(&self, steps: u32) -> Vec<(f64, f64)> {
        EXTENTS.with_borrow_mut(|known| {
            let is_it = |of: &Extents| of.body == *self && of.steps == steps;
            let place = known.iter().position(is_it);
            let entry = place.and_then(|place| known.remove(place));
            let entry = entry.unwrap_or_else(|| Extents {
                body: *self,
                steps,
                extents: self.integrate_extents(steps),
            });
            let extents = entry.extents.clone();
            known.push_front(entry);
            known.truncate(MOST_EXTENTS);
            extents
        })
    }

    fn integrate_extents(&self, steps: u32) -> Vec<(f64, f64)> {
        let of = |i: u32| {
            let interface = LARGEST_INTERFACE_SPEED * f64::from(i) / f64::from(steps);
            let ratio = self.at_cavity(interface).ratio;
            (ratio * interface * self.bulk_sound_speed(), 1.0 / ratio)
        };
        (0..=steps).map(of).collect()
    }

    /// Expansion speed [m/s] for an interface speed over the bulk sound speed.
    fn speed(&self, at: AtCavity, interface: f64) -> f64 {
        at.ratio * interface * self.bulk_sound_speed()
    }

    /// Solution for an expansion speed up to the largest one [m/s], by its interface speed: regula falsi that halves the value of the other
    /// end after each step.
    fn at_speed(&self, largest_speed: f64, speed: f64) -> Option<AtCavity> {
        let (mut low, mut high) = (0.0, LARGEST_INTERFACE_SPEED);
        let (mut below, mut above) = (-1.0, largest_speed / speed - 1.0);
        // The largest speed itself may miss by rounding.
        if above < -ROOT_TOLERANCE {
            return None;
        }
        for _ in 0..ROOT_STEPS {
            let middle = (low * above - high * below) / (above - below);
            let at = self.at_cavity(middle);
            let value = self.speed(at, middle) / speed - 1.0;
            if value.abs() < ROOT_TOLERANCE {
                return Some(at);
            }
            if value < 0.0 {
                (low, below) = (middle, value);
                above /= 2.0;
            } else {
                (high, above) = (middle, value);
                below /= 2.0;
            }
        }
        Some(self.at_cavity(f64::midpoint(low, high)))
    }

    /// Integrates from the interface to the cavity.
    ///
    /// The distance `q = ξ − U` from the particle to the ray falls from `1 − U(1)` to zero at the cavity, so that with q as
    /// variable the end is known beforehand; `q = q₁ s²` puts the steps close to the cavity, where the flow is fastest.
    fn at_cavity(&self, interface: f64) -> AtCavity {
        let (bulk, shear) = (self.bulk_modulus(), self.shear_modulus());
        let yield_ratio = self.yield_stress / bulk;
        let square = interface * interface;
        let alpha_square = square * bulk / (bulk + 4.0 / 3.0 * shear);
        let velocity = self.yield_stress / (2.0 * shear);
        let stress = self.yield_stress / shear * alpha_square / (1.0 + alpha_square.sqrt())
            + 2.0 / 3.0 * yield_ratio;
        let from = 1.0 - velocity;
        let rates = |s: f64, [xi, stress]: [f64; 2]| {
            let distance = from * s * s;
            let velocity = xi - distance;
            let w = distance / (1.0 - (stress - 2.0 / 3.0 * yield_ratio));
            let common = -2.0 / (xi * (1.0 - square * w * w));
            let velocity_slope = common * (velocity + yield_ratio * w);
            let stress_slope = common * (yield_ratio + square * w * velocity);
            let xi_rate = 2.0 * from * s / (1.0 - velocity_slope);
            [xi_rate, stress_slope * xi_rate]
        };
        let step = -1.0 / f64::from(STEPS);
        let mut state = [1.0, stress];
        for i in 0..STEPS {
            let s = 1.0 + f64::from(i) * step;
            state = fourth_order(rates, s, state, step);
        }
        AtCavity {
            ratio: state[0],
            pressure: state[1] * bulk,
        }
    }
}

/// Constant flow stress with the quasi-static cavity-expansion pressure of a material that hardens [Pa]; `None` for a law that
/// never flows.
///
/// It solves `(2Y/3)[1 + ln(2E/3Y)] = σ_s`, both sides incompressible. The perfectly plastic solution stands for the hardening
/// material by it.
pub fn effective_yield_stress(material: &Material) -> Option<f64> {
    let pressure = cavity_expansion_pressure(material)?;
    let modulus = material.youngs_modulus.si();
    // Monotonic up to 2E/3, far beyond any yield stress.
    let is_below = |yield_stress: f64| plastic_cavity_pressure(yield_stress, modulus) < pressure;
    Some(bisected(0.0, 2.0 / 3.0 * modulus, 100, is_below))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn aluminium() -> CavityExpansion {
        CavityExpansion {
            density: 2710.0,
            youngs_modulus: 68.9e9,
            poissons_ratio: 1.0 / 3.0,
            yield_stress: 276e6,
        }
    }

    #[test]
    fn the_incompressible_limit_is_the_exact_solution() {
        // p = (2Y/3)(1 + ln(2E/3Y)) + ρv² (3/2 + e⁴/2), e³ = 3Y/(2E): the elastic part is linear and leaves out the
        // convective ½ρv² e⁴ at the interface, which the factor 3/2 of the rigid-plastic flow contains.
        let body = CavityExpansion {
            // At 1e-9 the finite speed of the longitudinal wave would still show, in the sixth digit.
            poissons_ratio: 0.5 - 1e-13,
            ..aluminium()
        };
        let e = (1.5 * body.yield_stress / body.youngs_modulus).cbrt();
        let at_rest = 2.0 / 3.0 * body.yield_stress * (1.0 - 3.0 * e.ln());
        for speed in [0.0, 100.0, 500.0, 1500.0] {
            let exact = at_rest + body.density * speed * speed * (1.5 + e.powi(4) / 2.0);
            let pressure = body.pressure(speed).unwrap();
            let error = pressure / exact - 1.0;
            println!("incompressible, {speed} m/s: {pressure:.6e} Pa, error {error:.2e}");
            assert!(error.abs() < 2e-6, "{speed} {pressure} {exact}");
        }
    }

    #[test]
    fn the_static_limit_is_the_closed_form_as_the_yield_strain_vanishes() {
        let error = |yield_stress: f64| {
            let body = CavityExpansion {
                yield_stress,
                ..aluminium()
            };
            body.static_pressure() / body.static_pressure_in_small_strain() - 1.0
        };
        let (one, ten) = (error(27.6e6), error(276e6));
        println!("static: error {one:.3e} at Y/E = 4e-4, {ten:.3e} at 4e-3");
        assert!(one.abs() < 4e-4 && ten.abs() < 4e-3);
        // First order in Y/E, except for the logarithm in the denominator.
        assert!((6.0..12.0).contains(&(ten / one)), "{}", ten / one);
    }

    #[test]
    fn more_steps_would_not_change_the_pressure() {
        // Against an integration in ln r with ten times the steps, ended by interpolation where U = ξ.
        let body = aluminium();
        let (bulk, shear) = (body.bulk_modulus(), body.shear_modulus());
        let interface = 0.6_f64;
        let t = body.yield_stress / bulk;
        let alpha = interface / (1.0 + 4.0 * shear / (3.0 * bulk)).sqrt();
        let b2 = interface * interface;
        let (mut x, mut u) = (0.0_f64, body.yield_stress / (2.0 * shear));
        let mut s = body.yield_stress / shear * alpha * alpha / (1.0 + alpha) + 2.0 * t / 3.0;
        let h = -1e-5;
        let slopes = |x: f64, u: f64, s: f64| {
            let xi = x.exp();
            let w = (xi - u) / (1.0 - s + 2.0 * t / 3.0);
            let du = (-2.0 * u - 2.0 * t * w) / (1.0 - b2 * w * w);
            (du, -2.0 * t + b2 * w * du)
        };
        while u < x.exp() {
            let (du, ds) = slopes(x, u, s);
            let (du, ds) = slopes(x + h / 2.0, u + h / 2.0 * du, s + h / 2.0 * ds);
            (x, u, s) = (x + h, u + h * du, s + h * ds);
        }
        let found = body.at_cavity(interface);
        assert!(
            (found.ratio / x.exp() - 1.0).abs() < 2e-5,
            "{found:?} {}",
            x.exp()
        );
        assert!(
            (found.pressure / (s * bulk) - 1.0).abs() < 2e-5,
            "{found:?} {}",
            s * bulk
        );
    }

    #[test]
    fn the_fit_of_6061_t6_is_of_the_known_size() {
        let body = aluminium();
        for speed in [300.0, 600.0, 1000.0, 1500.0] {
            let fit = body.fit(speed);
            println!(
                "6061-T6 up to {speed} m/s: A = {:.3}, {fit:?}",
                fit.strength / 276e6
            );
            assert!((fit.strength / 276e6 - 3.894).abs() < 1e-3);
            assert!(fit.inertia > 1.0 && fit.inertia < 1.5 && fit.worst < 0.04);
        }
        assert!(body.pressure(1.01 * body.largest_speed()).is_none());
        assert!(body.fit(1e4).largest_speed < 0.37 * body.bulk_sound_speed());
    }

    #[test]
    fn pressures_scale() {
        let body = aluminium();
        let scaled = CavityExpansion {
            youngs_modulus: 2.0 * body.youngs_modulus,
            yield_stress: 2.0 * body.yield_stress,
            density: body.density / 2.0,
            ..body
        };
        let ratio = scaled.pressure(800.0).unwrap() / body.pressure(400.0).unwrap();
        assert!((ratio - 2.0).abs() < 1e-9, "{ratio}");
    }
}
