//! A metal that is sheared without losing heat: its stress along the strain, and where that is largest.

use crate::material::{FlowState, PreparedStrength};

/// Step of equivalent plastic strain along the curve.
const STRAIN_STEP: f64 = 1e-3;
/// Strain up to which the curve is followed.
const LARGEST_STRAIN: f64 = 10.0;

/// What is sheared.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sheared<'a> {
    pub(super) strength: &'a dyn PreparedStrength,
    /// Temperature rise per plastic work per volume [K m3/J].
    pub(super) heating: f64,
    /// At the start [K].
    pub(super) temperature: f64,
    pub(super) rate_effects: bool,
}

/// Flow stress along the strain at one strain rate.
#[derive(Debug)]
pub(super) struct AdiabaticCurve {
    /// At multiples of the step, from yield on; all positive.
    logarithms: Vec<f64>,
    /// Number of the largest stress, where the curve falls after it.
    maximum: Option<usize>,
}

impl Sheared<'_> {
    /// The curve at a strain rate, as far as there is any strength.
    pub(super) fn curve(&self, rate: f64) -> AdiabaticCurve {
        let at = |strain: f64, temperature: f64| self.flow(strain, rate, temperature).0;
        let mut temperature = self.temperature;
        let mut last = at(0.0, temperature);
        let (mut logarithms, mut maximum) = (vec![last.ln()], None);
        for i in 1..=(LARGEST_STRAIN / STRAIN_STEP) as usize {
            let strain = i as f64 * STRAIN_STEP;
            let heated = temperature + self.heating * last * STRAIN_STEP;
            let next = at(strain, heated);
            temperature += 0.5 * self.heating * (last + next) * STRAIN_STEP;
            if next <= 0.0 {
                break;
            }
            if next < last && maximum.is_none() {
                maximum = Some(i - 1);
            }
            last = next;
            logarithms.push(next.ln());
        }
        AdiabaticCurve {
            logarithms,
            maximum,
        }
    }

    /// Section by which the stress grows for a part by which the rate does, ∂ln σ/∂ln ε̇.
    pub(super) fn rate_sensitivity(&self, rate: f64) -> f64 {
        let (stress, slope) = self.flow(0.0, rate, self.temperature);
        match self.rate_effects {
            true => slope * rate / stress,
            false => 0.0,
        }
    }

    /// Flow stress and its slope with the rate.
    fn flow(&self, plastic_strain: f64, rate: f64, temperature: f64) -> (f64, f64) {
        let flow = self.strength.flow_stress(&FlowState {
            plastic_strain,
            strain_rate: if self.rate_effects { rate } else { 0.0 },
            temperature,
            pressure: 0.0,
        });
        (flow.stress, flow.rate_slope)
    }
}

impl AdiabaticCurve {
    /// Strain at which the stress is largest; `None` where it does not fall, or never rises.
    pub(super) fn instability(&self) -> Option<f64> {
        let strain = self.maximum? as f64 * STRAIN_STEP;
        (strain > 0.0).then_some(strain)
    }

    /// Last strain of the curve.
    pub(super) fn end(&self) -> f64 {
        (self.logarithms.len() - 1) as f64 * STRAIN_STEP
    }

    /// Logarithm of the stress at a strain, that of its last strain beyond it.
    pub(super) fn logarithm(&self, strain: f64) -> f64 {
        let place = (strain / STRAIN_STEP).max(0.0);
        let i = place as usize;
        match self.logarithms.get(i..=i + 1) {
            Some(pair) => pair[0] + (place - i as f64) * (pair[1] - pair[0]),
            None => self.logarithms[self.logarithms.len() - 1],
        }
    }
}
