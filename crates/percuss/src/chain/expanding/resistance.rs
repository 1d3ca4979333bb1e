//! What a target opposes to a crater that is being made, from first yield to steady penetration.
//!
//! Under the projectile lies a hemisphere of its radius in which the pressure is the same everywhere; as the crater floor advances it
//! is pushed outwards and expands a spherical cavity in the target around it, as under an indenter \[johnson1970\]. A floor that has
//! advanced by δ has displaced the volume `πa²δ`, so that the cavity has grown from a to `a (1 + 3δ/2a)^{1/3}` and the strain at its
//! wall is `ε_a = ⅔ ln(1 + 3δ/2a)`. The pressure is that of an incompressible body \[bishop1945, hill1950\],
//! `p = ∫₀^{ε_a} σ(ε)/(e^{3ε/2} − 1) dε`: `⅔Y` at first yield, `⅔Y [1 + ln(Eδ/(Ya))]` for small advances in a body of constant flow
//! stress, and for large ones the pressure of steady penetration. Elastic deflection `pa/2G` is taken off, with the shear modulus E/3
//! of an incompressible body: the ground around the crater has its own.

use crate::material::{FlowState, Material};

/// Strain at the wall beyond which the pressure does not grow any more.
const LARGEST_STRAIN: f64 = 20.0;
const POINTS: usize = 400;

/// Pressure against permanent advance.
#[derive(Debug)]
pub(super) struct Resistance {
    radius: f64,
    /// Advance over the radius, rising, and pressure [Pa].
    curve: Vec<(f64, f64)>,
}

impl Resistance {
    /// Of a target under a projectile of a radius [m], at a strain rate [1/s] and with a part of the plastic work as heat; `None`
    /// for a material that never yields.
    pub(super) fn new(
        material: &Material,
        radius: f64,
        strain_rate: f64,
        heat_fraction: f64,
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
            temperature: material.room_temperature.si(),
            pressure: 0.0,
        };
        let yield_stress = strength.flow_stress(&state).stress;
        let modulus = material.youngs_modulus.si();
        let yield_strain = yield_stress / modulus;
        let twice_shear = 2.0 / 3.0 * modulus;
        let mut pressure = yield_stress / 1.5;
        let mut curve = vec![(0.0, pressure)];
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
            let permanent = total - pressure / twice_shear;
            if permanent > curve.last().map_or(0.0, |point| point.0) {
                curve.push((permanent, pressure));
            }
        }
        Some(Self { radius, curve })
    }

    /// Pressure [Pa] on the floor of a crater of a permanent depth [m].
    pub(super) fn at(&self, depth: f64) -> f64 {
        let advance = depth / self.radius;
        let next = self.curve.partition_point(|point| point.0 <= advance);
        let Some(&(to, upper)) = self.curve.get(next) else {
            return self.steady();
        };
        let (from, lower) = self.curve[next.saturating_sub(1)];
        lower + (upper - lower) * ((advance - from) / (to - from)).clamp(0.0, 1.0)
    }

    /// Pressure of steady penetration [Pa].
    pub(super) fn steady(&self) -> f64 {
        self.curve.last().map_or(0.0, |point| point.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::cavity_expansion_pressure;

    fn metal() -> Material {
        toml::from_str(
            "name = 'a'\ndensity = '2700 kg/m3'\nyoungs_modulus = '70 GPa'\npoissons_ratio = 0.33\n\
             strength.perfectly_plastic = { flow_stress = '350 MPa' }",
        )
        .unwrap()
    }

    #[test]
    fn it_begins_at_first_yield_and_ends_at_steady_penetration() {
        let resistance = Resistance::new(&metal(), 2.5e-3, 1.0, 0.0).unwrap();
        assert!((resistance.at(0.0) / (350e6 / 1.5) - 1.0).abs() < 1e-12);
        let steady = cavity_expansion_pressure(&metal()).unwrap();
        assert!((resistance.steady() / steady - 1.0).abs() < 2e-3);
    }

    #[test]
    fn a_small_advance_has_its_closed_form() {
        // With constant flow stress the integral is closed: p = (2Y/3)[1 + ln((1 - e^(-3ε_a/2))/(1 - e^(-3ε_y/2)))] with
        // e^(3ε_a/2) = 1 + 3d/2a for a total advance d; the elastic part of it is p a/2G.
        let resistance = Resistance::new(&metal(), 2.5e-3, 1.0, 0.0).unwrap();
        let total: f64 = 0.04;
        let wall = 1.0 - 1.0 / (1.0 + 1.5 * total);
        let first = -(-1.5 * 350e6 / 70e9_f64).exp_m1();
        let pressure = 2.0 / 3.0 * 350e6 * (1.0 + (wall / first).ln());
        let permanent = total - pressure / (2.0 / 3.0 * 70e9);
        let found = resistance.at(permanent * 2.5e-3);
        // The rest is the midpoint rule on strips that grow by 2 % each.
        assert!((found / pressure - 1.0).abs() < 5e-3, "{found} {pressure}");
    }
}
