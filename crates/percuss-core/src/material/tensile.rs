//! Tensile strength that a strength law implies.

use super::{FlowState, Material};
use crate::minimum::least;

/// Smallest and largest plastic strain at which necking is looked for.
const STRAINS: (f64, f64) = (1e-6, 10.0);
const STEPS: u32 = 400;

/// Ultimate tensile strength, force over original area [Pa]; `None` for a law that never flows.
///
/// The record's own number where it has one; otherwise the largest `σ(ε) e^{−ε}` of the strength law, slow and at room
/// temperature: a bar necks where `dσ/dε = σ` \[considere1885\]. A record whose number lies below its yield stress gives the latter.
pub fn tensile_strength(material: &Material) -> Option<f64> {
    let law = material.strength.law();
    let yield_stress = law.initial_yield_stress(material)?;
    if let Some(given) = material.ultimate_strength {
        return Some(given.si().max(yield_stress));
    }
    let prepared = law.prepare(material, 1.0);
    let nominal = |strain: f64| {
        let state = FlowState {
            plastic_strain: strain,
            strain_rate: 0.0,
            temperature: material.room_temperature.si(),
            pressure: 0.0,
        };
        prepared.flow_stress(&state).stress * (-strain).exp()
    };
    let ratio = (STRAINS.1 / STRAINS.0).powf(1.0 / f64::from(STEPS));
    let at = |i: u32| STRAINS.0 * ratio.powf(f64::from(i));
    let best = (0..=STEPS).max_by(|&a, &b| nominal(at(a)).total_cmp(&nominal(at(b))))?;
    let necking = least(at(best) / ratio, at(best) * ratio, 60, |x| -nominal(x));
    Some(nominal(necking).max(yield_stress))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn material(text: &str) -> Material {
        toml::from_str(&format!(
            "name = 'a'\ndensity = '2700 kg/m3'\nyoungs_modulus = '70 GPa'\npoissons_ratio = 0.33\n{text}"
        ))
        .unwrap()
    }

    #[test]
    fn a_power_law_necks_at_the_strain_of_its_exponent() {
        // With total strain: the largest σ₀ εⁿ e^{−ε} is σ₀ (n/e)ⁿ, and the plastic strain lags by the yield strain.
        let (coefficient, exponent): (f64, f64) = (400e6, 0.2);
        let metal = material("strength.power_law = { coefficient = '400 MPa', exponent = 0.2 }");
        let yield_stress = metal.strength.law().initial_yield_stress(&metal).unwrap();
        let lag = (yield_stress / 70e9).exp();
        let exact = coefficient * (exponent / std::f64::consts::E).powf(exponent) * lag;
        let strength = tensile_strength(&metal).unwrap();
        assert!((strength / exact - 1.0).abs() < 1e-9, "{strength} {exact}");
    }

    #[test]
    fn without_hardening_it_is_the_yield_stress_and_a_given_number_comes_first() {
        let plastic = material("strength.perfectly_plastic = { flow_stress = '300 MPa' }");
        assert_eq!(tensile_strength(&plastic), Some(300e6));
        let given = material(
            "ultimate_strength = '345 MPa'\nstrength.perfectly_plastic = { flow_stress = '300 MPa' }",
        );
        assert!((tensile_strength(&given).unwrap() / 345e6 - 1.0).abs() < 1e-12);
    }
}
