//! Penetration resistance of a target, from first yield to steady penetration.
//!
//! Under the projectile lies a hemisphere of its radius in which the pressure is the same everywhere; as the crater floor advances it
//! is pushed outwards and expands a spherical cavity in the target around it, as under an indenter \[johnson1970\]. A floor that has
//! advanced by δ has displaced the volume `πa²δ`, so that the cavity has grown from a to `a (1 + 3δ/2a)^{1/3}` and the strain at its
//! wall is `ε_a = ⅔ ln(1 + 3δ/2a)`. The pressure is that of an incompressible body \[bishop1945, hill1950\],
//! `p = ∫₀^{ε_a} σ(ε)/(e^{3ε/2} − 1) dε`: `⅔Y` at first yield, `⅔Y [1 + ln(Eδ/(Ya))]` for small advances in a body of constant flow
//! stress, and for large ones the pressure of steady penetration. Elastic deflection `pa/2G` is taken off, with the shear modulus E/3
//! of an incompressible body: the ground around the crater has its own.
//!
//! The hemisphere is no fluid: the metal between a flat face and the cavity bears more along the line of flight than across it, which
//! adds half its flow stress to the mean pressure under an indenter \[studman1977\].
//!
//! A free rear face at a distance h from the crater floor ends the integral. In a sphere of the outer radius c it runs from the strain
//! at c, where the material has moved by the same volume: `p = P(x) − P(x a³/c³)`, with P for the endless body at the advance `x = δ/a`
//! (for a constant flow stress `2Y ln(c/a)`, as for a thick shell \[hill1950\]). In the direction θ from the line of flight the
//! face is at `c = h/cos θ`; the pressure is the mean over all directions ahead, each taken by itself.

use std::sync::atomic::{AtomicUsize, Ordering};

use crate::material::{FlowState, Material};

/// Strain at the wall beyond which the pressure does not grow any more.
const LARGEST_STRAIN: f64 = 20.0;
const POINTS: usize = 400;

/// Pressure against permanent advance.
#[derive(Debug)]
pub(super) struct Resistance {
    radius: f64,
    /// Permanent advance over the radius, rising, and the pressure and the flow stress at the wall of the cavity [Pa].
    curve: Curve<2>,
    /// What a free rear face takes away, where there is one.
    relief: Option<Relief>,
    /// Elastic advance over the radius, per pressure [1/Pa].
    compliance: f64,
}

/// Relief of the pressure by a free rear face.
#[derive(Debug)]
struct Relief {
    thickness: f64,
    /// Whole advance over the radius, rising, and the mean `∫₀¹ P(x μ³) dμ` over all directions ahead [Pa].
    means: Curve<1>,
}

/// What the target sets against the floor of a crater.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Pressures {
    /// Of the cavity [Pa].
    pub(super) cavity: f64,
    /// More under a flat face that is harder than the target [Pa].
    pub(super) flat_face: f64,
}

/// Part of the flow stress by which the mean pressure under an indenter exceeds that of the cavity \[studman1977\].
pub(super) const FLAT_FACE: f64 = 0.5;

impl Resistance {
    /// Of a target at a temperature [K] under a projectile of a radius [m], at a strain rate [1/s], with a part of the plastic work as heat, and with a free rear
    /// face at a depth [m], if it has one; `None` for a material that never yields.
    pub(super) fn new(
        material: &Material,
        temperature: f64,
        radius: f64,
        strain_rate: f64,
        heat_fraction: f64,
        free_rear_face: Option<f64>,
    ) -> Option<Self> {
        let law = material.strength.law();
        law.initial_yield_stress(material)?;
        let strength = law.prepare(material, 1.0);
        let heating = material.specific_heat.map_or(0.0, |heat| {
            heat_fraction / (material.density.si() * heat.si())
        });
        let mut state = FlowState {
            plastic_strain: 0.0,
            strain_rate,
            temperature,
            pressure: 0.0,
        };
        let yield_stress = strength.flow_stress(&state).stress;
        let modulus = material.youngs_modulus.si();
        let yield_strain = yield_stress / modulus;
        let twice_shear = 2.0 / 3.0 * modulus;
        let mut pressure = yield_stress / 1.5;
        let mut curve = vec![(0.0, [pressure, yield_stress])];
        let mut whole = vec![((1.5 * yield_strain).exp_m1() / 1.5, [pressure])];
        let growth = (LARGEST_STRAIN / yield_strain).powf(1.0 / POINTS as f64);
        let mut strain = yield_strain;
        for _ in 0..POINTS {
            let middle = strain * growth.sqrt();
            let width = strain * (growth - 1.0);
            state.plastic_strain = middle - yield_strain;
            let stress = strength.flow_stress(&state).stress;
            pressure += stress / (1.5 * middle).exp_m1() * width;
            state.temperature += heating * stress * width;
            strain *= growth;
            let total = (1.5 * strain).exp_m1() / 1.5;
            whole.push((total, [pressure]));
            let permanent = total - pressure / twice_shear;
            if permanent > curve.last().map_or(0.0, |point| point.0) {
                curve.push((permanent, [pressure, stress]));
            }
        }
        Some(Self {
            radius,
            curve: Curve::new(curve),
            relief: free_rear_face.map(|thickness| Relief {
                thickness,
                means: Curve::new(means_over_directions(&whole)),
            }),
            compliance: 1.0 / twice_shear,
        })
    }

    /// On the floor of a crater of a permanent depth [m].
    pub(super) fn at(&self, depth: f64) -> Pressures {
        let advance = depth / self.radius;
        let [pressure, stress] = self.curve.at(advance);
        let flat_face = FLAT_FACE * stress;
        let Some(relief) = &self.relief else {
            return Pressures {
                cavity: pressure,
                flat_face,
            };
        };
        let whole = advance + self.compliance * pressure;
        let distance = ((relief.thickness - depth) / self.radius).max(0.0);
        // Nearer than the radius of the cavity, it is open in all directions within h/a of the line of flight.
        let cube = distance.max(1.0).powi(3);
        let [taken] = relief.means.at(whole / cube);
        Pressures {
            cavity: distance.min(1.0) * (pressure - taken),
            flat_face: distance.min(1.0) * flat_face,
        }
    }

    /// Pressure of steady penetration [Pa].
    pub(super) fn steady(&self) -> f64 {
        self.curve.points.last().map_or(0.0, |point| point.1[0])
    }
}

/// `∫₀¹ P(x μ³) dμ = ⅓ x^{-1/3} ∫₀ˣ P(s) s^{-2/3} ds` at the points of P(x), which is straight from the origin to the first of them.
fn means_over_directions(pressures: &[(f64, [f64; 1])]) -> Vec<(f64, [f64; 1])> {
    let mut means = Vec::with_capacity(pressures.len() + 1);
    let mut before = (0.0, 0.0);
    let mut sum = 0.0;
    means.push((0.0, [0.0]));
    for &(x, [pressure]) in pressures {
        // Exact for a straight piece: P = b + k s.
        let slope = (pressure - before.1) / (x - before.0);
        let base = pressure - slope * x;
        let [from, to] = [before.0, x].map(f64::cbrt);
        sum += base * (to - from) + 0.25 * slope * (to.powi(4) - from.powi(4));
        before = (x, pressure);
        means.push((x, [sum / to]));
    }
    means
}

/// Points of a curve of several values at rising places.
#[derive(Debug)]
struct Curve<const N: usize> {
    points: Vec<(f64, [f64; N])>,
    /// The first point beyond the place that was asked for last: the next one is mostly near.
    next: AtomicUsize,
}

impl<const N: usize> Curve<N> {
    fn new(points: Vec<(f64, [f64; N])>) -> Self {
        Self {
            points,
            next: AtomicUsize::new(0),
        }
    }

    /// Number of the first point beyond a place.
    fn next_to(&self, place: f64) -> usize {
        let last = self.next.load(Ordering::Relaxed);
        let is_beyond = |i: usize| self.points.get(i).is_none_or(|point| point.0 > place);
        let is_near = is_beyond(last) && (last == 0 || !is_beyond(last - 1));
        if is_near {
            return last;
        }
        let next = self.points.partition_point(|point| point.0 <= place);
        self.next.store(next, Ordering::Relaxed);
        next
    }

    /// Values at a place, constant beyond the ends.
    fn at(&self, place: f64) -> [f64; N] {
        let next = self.next_to(place);
        let Some(&(to, upper)) = self.points.get(next) else {
            return self.points.last().map_or([0.0; N], |point| point.1);
        };
        let (from, lower) = self.points[next.saturating_sub(1)];
        if to == from {
            return lower;
        }
        let part = ((place - from) / (to - from)).clamp(0.0, 1.0);
        std::array::from_fn(|k| lower[k] + (upper[k] - lower[k]) * part)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::cavity_expansion_pressure;

    /// Temperature of the metal [K], which its law does not depend on.
    const ROOM: f64 = 293.0;

    fn metal() -> Material {
        toml::from_str(
            "name = 'a'\ndensity = '2700 kg/m3'\nyoungs_modulus = '70 GPa'\npoissons_ratio = 0.33\n\
             strength.perfectly_plastic = { flow_stress = '350 MPa' }",
        )
        .unwrap()
    }

    #[test]
    fn it_begins_at_first_yield_and_ends_at_steady_penetration() {
        let resistance = Resistance::new(&metal(), ROOM, 2.5e-3, 1.0, 0.0, None).unwrap();
        assert!((resistance.at(0.0).cavity / (350e6 / 1.5) - 1.0).abs() < 1e-12);
        assert_eq!(resistance.at(0.0).flat_face, 0.5 * 350e6);
        let steady = cavity_expansion_pressure(&metal()).unwrap();
        assert!((resistance.steady() / steady - 1.0).abs() < 2e-3);
    }

    #[test]
    fn a_small_advance_has_its_closed_form() {
        // With constant flow stress the integral is closed: p = (2Y/3)[1 + ln((1 - e^(-3ε_a/2))/(1 - e^(-3ε_y/2)))] with
        // e^(3ε_a/2) = 1 + 3d/2a for a total advance d; the elastic part of it is p a/2G.
        let resistance = Resistance::new(&metal(), ROOM, 2.5e-3, 1.0, 0.0, None).unwrap();
        let total: f64 = 0.04;
        let wall = 1.0 - 1.0 / (1.0 + 1.5 * total);
        let first = -(-1.5 * 350e6 / 70e9_f64).exp_m1();
        let pressure = 2.0 / 3.0 * 350e6 * (1.0 + (wall / first).ln());
        let permanent = total - pressure / (2.0 / 3.0 * 70e9);
        let found = resistance.at(permanent * 2.5e-3).cavity;
        // The rest is the midpoint rule on strips that grow by 2 % each.
        assert!((found / pressure - 1.0).abs() < 5e-3, "{found} {pressure}");
    }

    #[test]
    fn a_free_rear_face_takes_the_strength_of_a_thick_shell_away() {
        // In one direction: the closed form of a thick shell that flows all through, 2Y ln(c/a).
        let resistance = Resistance::new(&metal(), ROOM, 2.5e-3, 1.0, 0.0, Some(1.0)).unwrap();
        let yield_stress = 350e6;
        let strain = |x: f64| (1.5 * x).ln_1p() / 1.5;
        let endless = |x: f64| {
            let first = -(-1.5_f64 * yield_stress / 70e9).exp_m1();
            2.0 / 3.0 * yield_stress * (1.0 + (-(-1.5 * strain(x)).exp_m1() / first).ln())
        };
        let shell: f64 = 2.0;
        let x = 0.06;
        let exact = 2.0 * yield_stress * shell.ln();
        let found = endless(x) - endless(x / shell.powi(3));
        assert!((found / exact - 1.0).abs() < 0.04, "{found} {exact}");
        // The mean over all directions, against a sum.
        let relief = resistance.relief.as_ref().unwrap();
        let elastic = |x: f64| x / (yield_stress / 70e9) * yield_stress / 1.5;
        let count = 20_000;
        let sum: f64 = (0..count)
            .map(|i| x * ((f64::from(i) + 0.5) / f64::from(count)).powi(3))
            .map(|x| {
                if x < yield_stress / 70e9 {
                    elastic(x)
                } else {
                    endless(x)
                }
            })
            .sum();
        let [mean] = relief.means.at(x);
        let expected = sum / f64::from(count);
        assert!((mean / expected - 1.0).abs() < 5e-3, "{mean} {expected}");
    }

    #[test]
    fn a_rear_face_far_away_takes_nothing_away_and_a_near_one_everything() {
        let sum = |pressures: Pressures| pressures.cavity + pressures.flat_face;
        let endless = Resistance::new(&metal(), ROOM, 2.5e-3, 1.0, 0.0, None).unwrap();
        let mut before = 0.0;
        for thickness in [3e-3, 5e-3, 10e-3, 50e-3, 500e-3] {
            let plate = Resistance::new(&metal(), ROOM, 2.5e-3, 1.0, 0.0, Some(thickness)).unwrap();
            let pressure = plate.at(1e-3).cavity;
            assert!(pressure > before, "{thickness}");
            before = pressure;
            let nearly_through = sum(plate.at(thickness - 1e-5));
            assert!(nearly_through < 0.01 * endless.steady(), "{thickness}");
            assert_eq!(sum(plate.at(thickness)), 0.0);
            // It has no jump, not even where the cavity opens.
            for i in 1..100 {
                let depth = 1e-2 * thickness * f64::from(i);
                let jump = sum(plate.at(depth + 1e-8)) - sum(plate.at(depth - 1e-8));
                assert!(jump.abs() < 1e-3 * endless.steady(), "{thickness} {depth}");
            }
        }
        assert!((before / endless.at(1e-3).cavity - 1.0).abs() < 1e-4);
    }
}
