//! The zone of shear around a plug: how wide it is when the metal at its rim can bear no more.
//!
//! In the plate around a plug of radius a equilibrium asks for `τ r = τ_a a`. The metal hardens, so the strain falls off with the
//! radius, and the zone ends where the stress is the yield stress. The displacement of the rim is `u = ∫ γ dr`. As the metal heats,
//! its stress has a maximum; there, with the strain γ_i at the rim, a band of the width `u/γ_i` has the same displacement.

use crate::material::{FlowState, PreparedStrength};

/// Step of equivalent plastic strain along the adiabatic curve, and the strain up to which its maximum is looked for.
const STRAIN_STEP: f64 = 2e-4;
const LARGEST_STRAIN: f64 = 10.0;
/// Repetitions that settle the strain rate, which depends on the width itself, and the change that ends them.
const MOST_ROUNDS: u32 = 20;
const SETTLED: f64 = 1e-6;

/// The zone at the largest stress that its rim can bear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ShearZone {
    /// Width of the band with the same displacement and the strain of the rim [m].
    pub(super) width: f64,
    /// Equivalent plastic strain of the rim.
    pub(super) strain: f64,
}

/// A metal that is sheared without losing heat.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sheared<'a> {
    pub(super) strength: &'a dyn PreparedStrength,
    /// Temperature rise per plastic work per volume [K m3/J].
    pub(super) heating: f64,
    /// At the start [K].
    pub(super) temperature: f64,
    pub(super) rate_effects: bool,
}

impl Sheared<'_> {
    /// The zone around a plug of a radius that starts with a speed; `None` where the stress has no maximum, or no hardening
    /// before it.
    pub(super) fn zone(&self, radius: f64, speed: f64) -> Option<ShearZone> {
        let mut zone = self.zone_at_rate(radius, 0.0)?;
        if !self.rate_effects {
            return Some(zone);
        }
        for _ in 0..MOST_ROUNDS {
            let next = self.zone_at_rate(radius, speed / (3.0_f64.sqrt() * zone.width))?;
            let settled = (next.width / zone.width - 1.0).abs() < SETTLED;
            zone = next;
            if settled {
                break;
            }
        }
        Some(zone)
    }

    /// Strain at which the shear stress of a band of a given width is largest.
    pub(super) fn instability(&self, width: f64, speed: f64) -> Option<f64> {
        let rate = match self.rate_effects {
            true => speed / (3.0_f64.sqrt() * width),
            false => 0.0,
        };
        self.curve_to_maximum(rate).map(|(strain, _)| strain)
    }

    fn zone_at_rate(&self, radius: f64, rate: f64) -> Option<ShearZone> {
        let (strain, stresses) = self.curve_to_maximum(rate)?;
        let largest = *stresses.last()?;
        let mut displacement = 0.0;
        for (i, pair) in stresses.windows(2).enumerate() {
            // A ring between two stresses lies between the radii a σ_a/σ.
            let ring = radius * largest * (1.0 / pair[0] - 1.0 / pair[1]);
            displacement += 3.0_f64.sqrt() * (i as f64 + 0.5) * STRAIN_STEP * ring;
        }
        let width = displacement / (3.0_f64.sqrt() * strain);
        (width > 0.0).then_some(ShearZone { width, strain })
    }

    /// Stresses along the adiabatic curve, from yield to the maximum, and the strain there.
    fn curve_to_maximum(&self, rate: f64) -> Option<(f64, Vec<f64>)> {
        let at = |strain: f64, temperature: f64| {
            let state = FlowState {
                plastic_strain: strain,
                strain_rate: rate,
                temperature,
                pressure: 0.0,
            };
            self.strength.flow_stress(&state).stress
        };
        let mut temperature = self.temperature;
        let mut stresses = vec![at(0.0, temperature)];
        let mut strain = 0.0;
        while strain < LARGEST_STRAIN {
            let last = stresses[stresses.len() - 1];
            let heated = temperature + self.heating * last * STRAIN_STEP;
            let next = at(strain + STRAIN_STEP, heated);
            if next <= last {
                return (strain > 0.0).then_some((strain, stresses));
            }
            temperature += 0.5 * self.heating * (last + next) * STRAIN_STEP;
            strain += STRAIN_STEP;
            stresses.push(next);
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::FlowStress;

    /// `σ = (Y + H ε)(1 − b (T − T₀))` with heating: along the adiabatic curve, `ε = 1/κ` scaled, the maximum is known.
    #[derive(Debug)]
    struct Linear {
        hardening: f64,
        softening: f64,
    }

    const YIELD: f64 = 400e6;

    impl PreparedStrength for Linear {
        fn flow_stress(&self, state: &FlowState) -> FlowStress {
            let thermal = 1.0 - self.softening * state.temperature;
            FlowStress {
                stress: (YIELD + self.hardening * state.plastic_strain) * thermal,
                strain_slope: self.hardening * thermal,
                rate_slope: 0.0,
            }
        }
    }

    fn sheared(law: &Linear) -> Sheared<'_> {
        Sheared {
            strength: law,
            heating: 0.25e-6,
            temperature: 0.0,
            rate_effects: true,
        }
    }

    #[test]
    fn the_maximum_is_where_hardening_and_softening_balance() {
        let law = Linear {
            hardening: 500e6,
            softening: 8e-4,
        };
        let zone = sheared(&law).zone(0.01, 100.0).unwrap();
        // dσ/dε = 0 where H = s (Y + H ε)², s = b × heating, as dT/dε = heating σ.
        let s: f64 = law.softening * 0.25e-6;
        let strain = ((law.hardening / s).sqrt() - YIELD) / law.hardening;
        assert!(
            (zone.strain - strain).abs() < 3.0 * STRAIN_STEP,
            "{zone:?} {strain}"
        );
    }

    #[test]
    fn without_heat_nothing_is_largest_and_without_hardening_nothing_spreads() {
        let hardening = Linear {
            hardening: 500e6,
            softening: 0.0,
        };
        assert_eq!(sheared(&hardening).zone(0.01, 100.0), None);
        let plastic = Linear {
            hardening: 0.0,
            softening: 8e-4,
        };
        assert_eq!(sheared(&plastic).zone(0.01, 100.0), None);
    }

    /// The displacement of the rim against a fine quadrature over the radius.
    #[test]
    fn the_width_is_the_displacement_over_the_strain() {
        let law = Linear {
            hardening: 500e6,
            softening: 8e-4,
        };
        let (radius, metal) = (0.01, sheared(&law));
        let zone = metal.zone(radius, 100.0).unwrap();
        let (_, stresses) = metal.curve_to_maximum(0.0).unwrap();
        let largest = stresses[stresses.len() - 1];
        let outer = radius * largest / YIELD;
        let count = 20_000;
        let step = (outer - radius) / f64::from(count);
        let mut displacement = 0.0;
        for i in 0..count {
            let stress = largest * radius / (radius + (f64::from(i) + 0.5) * step);
            let k = stresses.partition_point(|&s| s < stress);
            let part = (stress - stresses[k - 1]) / (stresses[k] - stresses[k - 1]);
            displacement += 3.0_f64.sqrt() * (k as f64 - 1.0 + part) * STRAIN_STEP * step;
        }
        let width = displacement / (3.0_f64.sqrt() * zone.strain);
        assert!((zone.width / width - 1.0).abs() < 1e-3, "{zone:?} {width}");
        // And it scales with the plug.
        let double = metal.zone(2.0 * radius, 100.0).unwrap();
        assert!((double.width / zone.width - 2.0).abs() < 1e-9);
    }
}
