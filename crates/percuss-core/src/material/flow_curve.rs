//! Flow curves: stress against plastic strain at one strain rate and temperature.

use super::{FlowState, Material, PreparedStrength};

/// Points of a curve.
const POINTS: u32 = 100;

/// Flow curve of a material at a plastic strain rate and a temperature that stay, without pressure.
#[derive(Debug)]
pub struct IsothermalFlowCurve {
    strength: Box<dyn PreparedStrength>,
    /// Plastic strain rate [1/s].
    strain_rate: f64,
    /// Temperature [K].
    temperature: f64,
}

impl Material {
    /// The flow curve at a plastic strain rate [1/s] and a temperature [K]; `None` for a law that never flows.
    pub fn flow_curve(&self, strain_rate: f64, temperature: f64) -> Option<IsothermalFlowCurve> {
        self.strength.law().initial_yield_stress(self)?;
        Some(IsothermalFlowCurve {
            strength: self.strength.law().prepare(self, 1.0),
            strain_rate,
            temperature,
        })
    }
}

impl IsothermalFlowCurve {
    /// Flow stress [Pa] at a plastic strain.
    pub fn stress(&self, plastic_strain: f64) -> f64 {
        let state = FlowState {
            plastic_strain,
            strain_rate: self.strain_rate,
            temperature: self.temperature,
            pressure: 0.0,
        };
        self.strength.flow_stress(&state).stress
    }

    /// Plastic strains up to the largest one and their flow stresses [Pa].
    pub fn points(&self, largest_strain: f64) -> Vec<(f64, f64)> {
        let point = |i: u32| {
            // Closer where the curve bends.
            let part = f64::from(i) / f64::from(POINTS);
            let plastic_strain = largest_strain * part * part;
            (plastic_strain, self.stress(plastic_strain))
        };
        (0..=POINTS).map(point).collect()
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
            let curve = copper.flow_curve(rate, temperature).unwrap().points(0.3);
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
