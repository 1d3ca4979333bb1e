//! Quasi-static expansion of a spherical or cylindrical cavity: the pressure that a metal opposes to slow penetration.

use std::{cell::RefCell, collections::VecDeque};

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
    cavity_expansion_pressure_at(material, material.room_temperature.si())
}

/// The same in a body at a temperature [K].
pub fn cavity_expansion_pressure_at(material: &Material, temperature: f64) -> Option<f64> {
    remembered_pressure(material, 1.5, temperature)
}

/// Pressure that expands a long cylindrical cavity from nothing, slowly, in plane strain, in an infinite incompressible body [Pa]
/// \[bishop1945, hill1950\]; `None` for a law that never flows.
///
/// `p = ∫₀^∞ σ(ε)/(e^{√3 ε} − 1) dε`: the shell at radius r has the effective strain `ε = −ln(1 − a²/r²)/√3`, the stresses differ by
/// `2σ/√3` (von Mises), and `dσ_r/dr = −(2σ/√3)/r`. The elastic line gives `Y/√3`. With constant flow stress it is
/// `(Y/√3)(1 + ln(E/(√3 Y)))` up to terms of the order of Y/E, and for `σ = Y (Eε/Y)ⁿ` it is
/// `(Y/√3){1 + [E/(√3 Y)]ⁿ ∫₀^{1−√3Y/E} (−ln x)ⁿ/(1−x) dx}`.
pub fn cylindrical_cavity_pressure(material: &Material) -> Option<f64> {
    remembered_pressure(material, 3.0_f64.sqrt(), material.room_temperature.si())
}

/// The pressure of a spherical cavity where the flow stress is constant, `(2Y/3)[1 + ln(2E/3Y)]` [Pa]: the elastic part, too, is incompressible.
pub fn plastic_cavity_pressure(flow_stress: f64, youngs_modulus: f64) -> f64 {
    let ratio = 2.0 * youngs_modulus / (3.0 * flow_stress);
    2.0 / 3.0 * flow_stress * (1.0 + ratio.ln())
}

/// An integral: material, exponent and temperature, and value.
type Known = (Material, [f64; 2], Option<f64>);

/// Integrals that are remembered: those of the materials of published tests.
const MOST_KNOWN: usize = 64;

thread_local! {
    /// The last integrals, the latest first.
    static KNOWN: RefCell<VecDeque<Known>> = const { RefCell::new(VecDeque::new()) };
}

/// [`expansion_pressure`], remembered: runs of a sweep mostly have the same target, published tests have a few dozen, and the integral takes
/// as long as a third of a run.
fn remembered_pressure(material: &Material, exponent: f64, temperature: f64) -> Option<f64> {
    let power = [exponent, temperature];
    KNOWN.with_borrow_mut(|known| {
        let is_it = |(of, same, _): &Known| *same == power && of == material;
        let place = known.iter().position(is_it);
        let entry = place.and_then(|place| known.remove(place));
        let entry = entry.unwrap_or_else(|| {
            let pressure = expansion_pressure(material, exponent, temperature);
            (material.clone(), power, pressure)
        });
        let pressure = entry.2;
        known.push_front(entry);
        known.truncate(MOST_KNOWN);
        pressure
    })
}

/// `∫₀^∞ σ(ε)/(e^{gε} − 1) dε`: g is 3/2 for a sphere and √3 for a cylinder.
fn expansion_pressure(material: &Material, exponent: f64, temperature: f64) -> Option<f64> {
    let law = material.strength.law();
    let yield_stress = material.yield_stress_at(temperature)?;
    let prepared = law.prepare(material, 1.0);
    let yield_strain = yield_stress / material.youngs_modulus.si();
    let stress = |strain: f64| {
        let state = FlowState {
            plastic_strain: strain - yield_strain,
            strain_rate: 0.0,
            temperature,
            pressure: 0.0,
        };
        prepared.flow_stress(&state).stress
    };
    // In ln ε the integrand is smooth over the four decades from the yield strain.
    let (from, to) = (yield_strain.ln(), LARGEST_STRAIN.ln());
    let step = (to - from) / f64::from(PANELS);
    let integrand = |x: f64| {
        let strain = x.exp().max(yield_strain);
        stress(strain) * strain / (exponent * strain).exp_m1()
    };
    // The end of a panel is mostly the start of the next one to the last bit.
    let (mut end, mut at_end) = (f64::NAN, f64::NAN);
    let sum: f64 = (0..PANELS)
        .map(|i| {
            let x = from + f64::from(i) * step;
            let at_start = if x == end { at_end } else { integrand(x) };
            end = x + step;
            at_end = integrand(end);
            at_start + 4.0 * integrand(x + step / 2.0) + at_end
        })
        .sum();
    Some(yield_stress / exponent + sum * step / 6.0)
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
    fn a_pressure_is_remembered_for_its_material_and_shape_only() {
        let metals = ["500", "276"].map(|stress| {
            material(&format!(
                "perfectly_plastic = {{ flow_stress = '{stress} MPa' }}"
            ))
        });
        for metal in metals.iter().chain(&metals) {
            for _ in 0..2 {
                let sphere = cavity_expansion_pressure(metal);
                let room = metal.room_temperature.si();
                assert_eq!(sphere, expansion_pressure(metal, 1.5, room));
                let cylinder = cylindrical_cavity_pressure(metal);
                assert_eq!(cylinder, expansion_pressure(metal, 3.0_f64.sqrt(), room));
                assert!(sphere > cylinder);
            }
        }
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

    #[test]
    fn a_cylinder_in_a_perfectly_plastic_body_has_its_closed_form() {
        let metal = material("perfectly_plastic = { flow_stress = '276 MPa' }");
        let root = 3.0_f64.sqrt();
        let closed = 276e6 / root * (1.0 + (68.9e9 / (root * 276e6)).ln());
        let pressure = cylindrical_cavity_pressure(&metal).unwrap();
        // What is left out is of the order of √3 Y/2E = 0.35 % of Y/√3.
        assert!(
            (pressure / closed - 1.0).abs() < 1e-3,
            "{pressure} {closed}"
        );
    }

    #[test]
    fn a_cylinder_in_a_power_law_body_has_its_published_form() {
        let (modulus, yield_stress, exponent): (f64, f64, f64) = (68.9e9, 276e6, 0.051);
        let root = 3.0_f64.sqrt();
        // x = 1 − t², which takes the end of the interval with care.
        let last = (root * yield_stress / modulus).sqrt();
        let n = 20_000;
        let step = (1.0 - last) / f64::from(n);
        let integral: f64 = (0..n)
            .map(|i| {
                let t = last + (f64::from(i) + 0.5) * step;
                2.0 / t * (-(1.0 - t * t).ln()).powf(exponent) * step
            })
            .sum();
        let published = yield_stress / root
            * (1.0 + (modulus / (root * yield_stress)).powf(exponent) * integral);
        let coefficient = yield_stress * (modulus / yield_stress).powf(exponent) / 1e6;
        let metal = material(&format!(
            "power_law = {{ coefficient = '{coefficient} MPa', exponent = {exponent} }}"
        ));
        let pressure = cylindrical_cavity_pressure(&metal).unwrap();
        assert!(
            (pressure / published - 1.0).abs() < 2e-3,
            "{pressure} {published}"
        );
    }
}
