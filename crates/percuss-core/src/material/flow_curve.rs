//! Flow curves: stress against plastic strain at one strain rate and temperature.

use super::{FlowState, Material};

/// Points of a curve.
const POINTS: u32 = 100;

impl Material {
    /// Plastic strain and flow stress [Pa] up to a plastic strain, at a plastic strain rate [1/s] and a temperature [K] that stay, without
    /// pressure; `None` for a law that never flows.
    pub fn flow_curve(
        &self,
        largest_strain: f64,
        strain_rate: f64,
        temperature: f64,
    ) -> Option<Vec<(f64, f64)>> {
        self.strength.law().initial_yield_stress(self)?;
        let prepared = self.strength.law().prepare(self, 1.0);
        let point = |i: u32| {
            // Closer where the curve bends.
            let part = f64::from(i) / f64::from(POINTS);
            let plastic_strain = largest_strain * part * part;
            let state = FlowState {
                plastic_strain,
                strain_rate,
                temperature,
                pressure: 0.0,
            };
            (plastic_strain, prepared.flow_stress(&state).stress)
        };
        Some((0..=POINTS).map(point).collect())
    }
}

#[cfg(test)]
mod tests {
    use crate::material::Library;

    /// Copper of Johnson and Cook by hand: 90 + 292 · 0.3^0.31 MPa, 1 + 0.025 ln 1000, and half way to the melting point 1 − 0.5^1.09.
    #[test]
    fn a_curve_is_the_law() {
        let copper = &Library::built_in().find("ofhc-copper").unwrap().material;
        let half = f64::midpoint(294.0, 1356.0);
        let end = |rate, temperature| {
            let curve = copper.flow_curve(0.3, rate, temperature).unwrap();
            assert_eq!((curve.len(), curve[0].0), (101, 0.0));
            curve[100]
        };
        let slow = 90e6 + 292e6 * 0.3_f64.powf(0.31);
        let fast = 1.0 + 0.025 * 1000_f64.ln();
        let hot = 1.0 - 0.5_f64.powf(1.09);
        for (rate, temperature, expected) in [
            (1.0, 294.0, slow),
            (1000.0, 294.0, slow * fast),
            (1000.0, half, slow * fast * hot),
        ] {
            let (strain, stress) = end(rate, temperature);
            assert!((strain - 0.3).abs() < 1e-12);
            assert!((stress / expected - 1.0).abs() < 1e-9, "{stress}");
        }
    }
}
