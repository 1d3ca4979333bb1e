//! Quasi-static expansion of a spherical cavity: the pressure that a metal opposes to slow penetration.

use super::{FlowState, Material};

/// Strain beyond which the rest of the integral is below 1e-12 of the whole.
const LARGEST_STRAIN: f64 = 20.0;
const PANELS: u32 = 2000;

/// Pressure that expands a spherical cavity from nothing, slowly, in an infinite incompressible body [Pa]
/// \[bishop1945, hill1950\]; `None` for a law that never flows.
///
/// `p = ∫₀^∞ σ(ε)/(e^{3ε/2} − 1) dε` with the uniaxial curve σ(ε): the elastic line up to the yield strain, which gives
/// `2Y/3`, and the strength law beyond it, slow and at room temperature. With constant flow stress it is
/// `(2Y/3)(1 + ln(2E/3Y))` up to terms of the order of Y/E.
pub fn cavity_expansion_pressure(material: &Material) -> Option<f64> {
    let law = material.strength.law();
    let yield_stress = law.initial_yield_stress(material)?;
    let prepared = law.prepare(material, 1.0);
    let yield_strain = yield_stress / material.youngs_modulus.si();
    let stress = |strain: f64| {
        let state = FlowState {
            plastic_strain: strain - yield_strain,
            strain_rate: 0.0,
            temperature: material.room_temperature.si(),
            pressure: 0.0,
        };
        prepared.flow_stress(&state).stress
    };
    // In ln ε the integrand is smooth over the four decades from the yield strain.
    let (from, to) = (yield_strain.ln(), LARGEST_STRAIN.ln());
    let step = (to - from) / f64::from(PANELS);
    let integrand = |x: f64| {
        let strain = x.exp().max(yield_strain);
        stress(strain) * strain / (1.5 * strain).exp_m1()
    };
    let sum: f64 = (0..PANELS)
        .map(|i| {
            let x = from + f64::from(i) * step;
            integrand(x) + 4.0 * integrand(x + step / 2.0) + integrand(x + step)
        })
        .sum();
    Some(2.0 / 3.0 * yield_stress + sum * step / 6.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn material(strength: &str) -> Material {
        toml::from_str(&format!(
            "name = 'a'\ndensity = '2700 kg/m3'\nyoungs_modulus = '68.9 GPa'\npoissons_ratio = 0.33\nstrength.{strength}"
        ))
        .unwrap()
    }

    #[test]
    fn constant_flow_stress_has_its_closed_form() {
        let metal = material("perfectly_plastic = { flow_stress = '276 MPa' }");
        let ratio: f64 = 2.0 * 68.9e9 / (3.0 * 276e6);
        let closed = 2.0 * 276e6 / 3.0 * (1.0 + ratio.ln());
        let pressure = cavity_expansion_pressure(&metal).unwrap();
        assert!(
            (pressure / closed - 1.0).abs() < 2e-3,
            "{pressure} {closed}"
        );
    }

    #[test]
    fn a_power_law_has_its_published_value() {
        // E = 68.9 GPa, Y = 276 MPa, n = 0.051: σ_s/Y = 4.594.
        let (modulus, yield_stress, exponent): (f64, f64, f64) = (68.9e9, 276e6, 0.051);
        let coefficient = yield_stress * (modulus / yield_stress).powf(exponent) / 1e6;
        let metal = material(&format!(
            "power_law = {{ coefficient = '{coefficient} MPa', exponent = {exponent} }}"
        ));
        let ratio = cavity_expansion_pressure(&metal).unwrap() / yield_stress;
        assert!((ratio - 4.594).abs() < 4e-3, "{ratio}");
    }
}
