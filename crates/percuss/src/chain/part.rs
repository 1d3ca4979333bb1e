//! Bodies of the chain: what is the same for all elements of a projectile or a layer.

use std::f64::consts::PI;

use crate::{
    case::{ChainOptions, ConstraintFactor, Kinematics},
    material::{Material, PreparedStrength},
};

/// What a part is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    Projectile,
    Target,
}

/// A projectile or a layer of the target.
#[derive(Debug)]
pub(super) struct Part {
    pub(super) role: Role,
    /// Number of elements; a rigid wall has none.
    pub(super) elements: usize,
    pub(super) modulus: f64,
    pub(super) density: f64,
    pub(super) wave_speed: f64,
    /// Inverse of the wave speed [s/m].
    pub(super) slowness: f64,
    pub(super) area: f64,
    pub(super) strength: Box<dyn PreparedStrength>,
    /// Temperature rise per plastic work per volume [K m3/J]; 0 without heating.
    pub(super) heating: f64,
    pub(super) start_temperature: f64,
    pub(super) rate_effects: bool,
    pub(super) kinematics: Kinematics,
    /// Border shear per length of element [N/m]; 0 for a projectile.
    pub(super) friction_per_length: f64,
}

impl Part {
    /// A deformable part. `factor` multiplies its flow stress.
    pub(super) fn new(
        role: Role,
        material: &Material,
        area: f64,
        elements: usize,
        factor: f64,
        options: &ChainOptions,
    ) -> Self {
        let heat_fraction = options.heat_fraction.unwrap_or(0.9);
        let heating = match material.specific_heat {
            Some(heat) if options.adiabatic_heating.unwrap_or(true) => {
                // What the constraint adds to the stress is work against the material around the column, not heat in it.
                heat_fraction / (factor * material.density.si() * heat.si())
            }
            _ => 0.0,
        };
        Self {
            role,
            elements,
            modulus: material.youngs_modulus.si(),
            density: material.density.si(),
            wave_speed: material.bar_wave_speed(),
            slowness: 1.0 / material.bar_wave_speed(),
            area,
            strength: material.strength.law().prepare(material, factor),
            heating,
            start_temperature: material.room_temperature.si(),
            rate_effects: options.rate_effects.unwrap_or(true),
            kinematics: options.kinematics.unwrap_or_default(),
            friction_per_length: 0.0,
        }
    }

    /// Diameter at an axial strain [m].
    pub(super) fn diameter_at(&self, strain: f64) -> f64 {
        let diameter = 2.0 * (self.area / PI).sqrt();
        match self.kinematics {
            Kinematics::Logarithmic => diameter * (0.5 * strain).exp(),
            Kinematics::SmallStrain => diameter,
        }
    }

    /// Length at an axial strain [m].
    pub(super) fn length_at(&self, rest_length: f64, strain: f64) -> f64 {
        match self.kinematics {
            Kinematics::Logarithmic => rest_length * (-strain).exp(),
            Kinematics::SmallStrain => rest_length * (1.0 - strain),
        }
    }
}

/// Factor on the flow stress of a target material.
///
/// A number is taken as it is. `cavity-expansion` gives the quasi-static pressure that expands a spherical cavity
/// \[bishop1945, hill1950\], over the yield stress Y at which the elastic line is left:
/// `(2/3)(1 + ln(2E/3Y))` for constant flow stress, and `(2/3)(1 + (2E/3Y)ⁿ I)`,
/// `I = ∫₀^{1−3Y/2E} (−ln x)ⁿ/(1−x) dx`, for a power law.
pub(super) fn constraint_factor(factor: ConstraintFactor, material: &Material) -> f64 {
    match factor {
        ConstraintFactor::Value(value) => value,
        ConstraintFactor::CavityExpansion => {
            let law = material.strength.law();
            let Some(yield_stress) = law.initial_yield_stress(material) else {
                return 1.0;
            };
            let ratio = 2.0 * material.youngs_modulus.si() / (3.0 * yield_stress);
            let exponent = match &material.strength {
                crate::material::Strength::PowerLaw(law) => law.exponent,
                _ => 0.0,
            };
            2.0 / 3.0 * (1.0 + ratio.powf(exponent) * cavity_integral(exponent, 1.0 - 1.0 / ratio))
        }
    }
}

/// `∫₀^end (−ln x)ⁿ/(1−x) dx`, by Simpson's rule in `x = 1 − e^(−t)`, where the integrand is smooth.
fn cavity_integral(exponent: f64, end: f64) -> f64 {
    let upper = -(1.0 - end).ln();
    let panels = 4000;
    // dx/(1−x) = dt, so the integrand is (−ln(1 − e^(−t)))ⁿ; near t = 0 it grows like (−ln t)ⁿ: substitute t = s².
    let step = upper.sqrt() / f64::from(panels);
    let integrand = |s: f64| {
        if s == 0.0 {
            return 0.0;
        }
        let t = s * s;
        2.0 * s * (-(-(-t).exp_m1()).ln()).powf(exponent)
    };
    let sum: f64 = (0..panels)
        .map(|i| {
            let s = f64::from(i) * step;
            integrand(s) + 4.0 * integrand(s + step / 2.0) + integrand(s + step)
        })
        .sum();
    sum * step / 6.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cavity_expansion_has_its_closed_form_and_its_published_value() {
        let library = crate::material::Library::built_in();
        let material = library.find("aluminium-2024-t351").unwrap();
        // Without hardening the integral is ln(2E/3Y).
        let ratio: f64 = 2.0 * 70.0 / (3.0 * 0.324);
        assert!((cavity_integral(0.0, 1.0 - 1.0 / ratio) - ratio.ln()).abs() < 1e-6);
        assert!(constraint_factor(ConstraintFactor::CavityExpansion, &material.material) > 2.7);
        // 6061-like: E = 68.9 GPa, Y = 276 MPa, n = 0.051 gives σ_s/Y = 4.594.
        let ratio: f64 = 2.0 * 68.9e9 / (3.0 * 276e6);
        let pressure =
            2.0 / 3.0 * (1.0 + ratio.powf(0.051) * cavity_integral(0.051, 1.0 - 1.0 / ratio));
        assert!((pressure - 4.594).abs() < 2e-3, "{pressure}");
    }
}
