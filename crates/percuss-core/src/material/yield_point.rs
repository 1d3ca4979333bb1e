//! Return of a trial stress to the yield surface, for every model that follows stress in time.

use serde::{Deserialize, Serialize};

use super::{FlowState, FlowStress, Hardening, PreparedStrength};

/// Excess of stress, as a part of the trial stress, from which one more Newton step may be the last.
const LARGEST_EXCESS: f64 = 1e-4;
/// What the last Newton step may leave of it, as a part of the trial stress.
const TOLERANCE: f64 = 1e-8;
/// A bracket halved as often as this is a point.
const MOST_ITERATIONS: u32 = 100;

/// A stress beyond the yield surface, if nothing flowed, and what flow does to it.
#[derive(Debug, Clone, Copy)]
pub struct Trial {
    /// Equivalent stress [Pa].
    pub stress: f64,
    /// Its fall per plastic strain [Pa].
    pub modulus: f64,
    /// Fall of the pressure per plastic strain [Pa].
    pub pressure_fall: f64,
    /// Time in which the strain came about [s]; `None` leaves the strain rate out.
    pub elapsed: Option<f64>,
}

/// Where a body last stood on its yield surface: the next return starts there.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct YieldPoint {
    flow: FlowStress,
    strain_rate: f64,
    /// Whether `flow` is the slow flow stress of the current state: then it tells whether a stress is elastic.
    is_slow: bool,
}

/// Whether a step of Newton's method may be the last one.
///
/// Powers of strain and strain rate are not more curved than slope over strain and slope over rate: `curvature` is the sum of the
/// two, `per` times.
#[inline(always)]
pub fn is_last(trial: f64, excess: f64, step: f64, curvature: f64, per: f64) -> bool {
    (excess.abs() <= LARGEST_EXCESS * trial)
        & (0.5 * step * step * curvature <= TOLERANCE * trial * per)
}

/// What the first step of Newton's method comes to.
#[derive(Debug, Clone, Copy)]
pub struct FirstReturn {
    /// Plastic strain.
    pub increment: f64,
    /// Slope of the flow stress with it [Pa].
    pub strain_slope: f64,
    /// Whether it is the last step, too.
    pub is_last: bool,
}

/// Return of an equivalent stress [Pa] beyond the yield stress to a flow stress that is a power of the plastic strain, as far as the
/// first step of Newton's method goes: what [`YieldPoint::plastic_increment`] does, for loops over many returns that have been dispatched to an instruction set. The yield stress
/// and its slope are those at the plastic strain before.
#[inline(always)]
pub fn first_return(
    law: Hardening,
    [yield_stress, slope]: [f64; 2],
    plastic_strain: f64,
    size: f64,
    modulus: f64,
) -> FirstReturn {
    let first = (size - yield_stress) / (modulus + slope);
    let reached = plastic_strain + first;
    let (stress, strain_slope) = law.at_here(reached);
    let excess = size - modulus * first - stress;
    let step = excess / (modulus + strain_slope);
    let increment = first + step;
    let is_last = is_last(size, excess, step, strain_slope * first, reached * first);
    FirstReturn {
        increment,
        strain_slope,
        is_last: is_last & (increment > 0.0),
    }
}

impl YieldPoint {
    /// A point whose slow flow stress and slope with plastic strain [Pa] are known.
    pub fn known(stress: f64, strain_slope: f64) -> Self {
        Self {
            flow: FlowStress {
                stress,
                strain_slope,
                rate_slope: 0.0,
            },
            strain_rate: 0.0,
            is_slow: true,
        }
    }

    /// The slow flow stress in a state.
    pub fn slow(strength: &dyn PreparedStrength, state: &FlowState) -> Self {
        Self {
            flow: strength.flow_stress(&FlowState {
                strain_rate: 0.0,
                ..*state
            }),
            strain_rate: 0.0,
            is_slow: true,
        }
    }

    /// Flow stress [Pa].
    pub fn stress(&self) -> f64 {
        self.flow.stress
    }

    /// Slope with the plastic strain [Pa].
    pub fn strain_slope(&self) -> f64 {
        self.flow.strain_slope
    }

    /// Says that the state has changed without flow, and the flow stress with it.
    pub fn forget(&mut self) {
        self.is_slow = false;
    }

    /// Whether an equivalent stress [Pa] is known to be elastic.
    pub fn holds(&self, stress: f64) -> bool {
        stress <= self.elastic_to()
    }

    /// Equivalent stress up to which a stress is known to be elastic [Pa]; none is where the slow flow stress is unknown.
    #[inline(always)]
    pub fn elastic_to(&self) -> f64 {
        if self.is_slow {
            self.flow.stress
        } else {
            f64::NEG_INFINITY
        }
    }

    /// Solves `q − M Δ = Y(ε_p + Δ, Δ/Δt, T)` for the plastic strain Δ, where `q` is the trial stress and `M` its fall per
    /// plastic strain; 0 where the trial stress is elastic.
    ///
    /// `start` is the state before the step, its pressure that of the trial stress. The root is bracketed by 0 and q/M and found
    /// by Newton's method, over the logarithm of Δ where a step over Δ leaves the bracket. As long as flow lasts, the slow flow stress
    /// is not needed: it is evaluated only when the body seems to have stopped flowing.
    pub fn plastic_increment(
        &mut self,
        strength: &dyn PreparedStrength,
        start: &FlowState,
        trial: &Trial,
    ) -> f64 {
        let rate_of_strain = match trial.elapsed {
            Some(time) if time > 0.0 => 1.0 / time,
            _ => 0.0,
        };
        let (mut low, mut high) = (0.0, trial.stress / trial.modulus);
        let mut increment = self.tangent_increment(trial, rate_of_strain);
        if increment <= 0.0 && !self.is_slow {
            *self = Self::slow(strength, start);
            increment = self.tangent_increment(trial, rate_of_strain);
        }
        if self.holds(trial.stress) {
            return 0.0;
        }
        increment = increment.min(high);
        let mut left = MOST_ITERATIONS;
        loop {
            left -= 1;
            let flow = strength.flow_stress(&FlowState {
                plastic_strain: start.plastic_strain + increment,
                strain_rate: increment * rate_of_strain,
                pressure: start.pressure - trial.pressure_fall * increment,
                ..*start
            });
            let rate_slope = flow.rate_slope * rate_of_strain;
            let excess = trial.stress - trial.modulus * increment - flow.stress;
            let step = excess / (trial.modulus + flow.strain_slope + rate_slope);
            let newton = increment + step;
            let strain = start.plastic_strain + increment;
            let curvature = flow.strain_slope * increment + rate_slope * strain;
            let is_last = is_last(trial.stress, excess, step, curvature, strain * increment);
            if (is_last && newton > 0.0) || left == 0 {
                let increment = newton.max(low).min(high);
                *self = Self {
                    flow: FlowStress {
                        stress: trial.stress - trial.modulus * increment,
                        ..flow
                    },
                    strain_rate: increment * rate_of_strain,
                    is_slow: strength.depends_on_strain_only(),
                };
                return increment;
            }
            if excess > 0.0 {
                low = increment;
            } else {
                high = increment;
            }
            if newton <= 0.0 && low == 0.0 && !self.is_slow {
                *self = Self::slow(strength, start);
                if self.holds(trial.stress) {
                    return 0.0;
                }
            }
            let is_inside = |next: &f64| low < *next && *next < high;
            // Over the logarithm of the increment a rate effect is nearly straight.
            let logarithmic = || Some(increment * (step / increment).exp()).filter(is_inside);
            increment = Some(newton)
                .filter(is_inside)
                .or_else(logarithmic)
                .unwrap_or(0.5 * (low + high));
        }
    }

    /// Increment at which the tangent of the yield surface in this point meets the trial stress.
    ///
    /// From a slow point the slope with rate is left out: it is far too steep there.
    fn tangent_increment(&self, trial: &Trial, rate_of_strain: f64) -> f64 {
        let rate_slope = if self.is_slow {
            0.0
        } else {
            self.flow.rate_slope
        };
        (trial.stress - self.flow.stress + rate_slope * self.strain_rate)
            / (trial.modulus + self.flow.strain_slope + rate_slope * rate_of_strain)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Material;

    const MODULUS: f64 = 200e9;
    const TIME: f64 = 1e-8;

    fn prepared(strength: &str) -> Box<dyn PreparedStrength> {
        let metal: Material = toml::from_str(&format!(
            "name = 'a'\ndensity = '8000 kg/m3'\nyoungs_modulus = '200 GPa'\npoissons_ratio = 0.3\n\
             melting_temperature = '1800 K'\nstrength.{strength}"
        ))
        .unwrap();
        metal.strength.law().prepare(&metal, 1.0)
    }

    fn laws() -> impl Iterator<Item = Box<dyn PreparedStrength>> {
        [
            "perfectly_plastic = { flow_stress = '400 MPa' }",
            "power_law = { coefficient = '800 MPa', exponent = 0.1 }",
            "johnson_cook = { a = '300 MPa', b = '500 MPa', n = 0.3, c = 0.02, m = 1.0, reference_rate = '1 1/s' }",
            "johnson_cook = { a = '490 MPa', b = '383 MPa', n = 0.45, c = 0.0114, m = 0.94, reference_rate = '5e-4 1/s', rate_form = 'power' }",
        ]
        .into_iter()
        .map(prepared)
    }

    fn trial(stress: f64) -> Trial {
        Trial {
            stress,
            modulus: MODULUS,
            pressure_fall: 0.0,
            elapsed: Some(TIME),
        }
    }

    fn state() -> FlowState {
        FlowState {
            plastic_strain: 0.02,
            strain_rate: 0.0,
            temperature: 400.0,
            pressure: 0.0,
        }
    }

    fn flow_stress(law: &dyn PreparedStrength, start: &FlowState, increment: f64) -> f64 {
        let state = FlowState {
            plastic_strain: start.plastic_strain + increment,
            strain_rate: increment / TIME,
            ..*start
        };
        law.flow_stress(&state).stress
    }

    #[test]
    fn the_stress_ends_on_the_yield_surface() {
        for law in laws() {
            for stress in [0.9e9, 2e9, 20e9] {
                let mut point = YieldPoint::slow(&*law, &state());
                let increment = point.plastic_increment(&*law, &state(), &trial(stress));
                let flow = flow_stress(&*law, &state(), increment);
                assert!(
                    (point.stress() / flow - 1.0).abs() < 2.0 * TOLERANCE * stress / flow,
                    "{law:?} {stress}"
                );
                assert!((stress - MODULUS * increment - point.stress()).abs() < 1e-3);
            }
        }
    }

    #[test]
    fn where_a_return_starts_does_not_matter() {
        for law in laws() {
            for before in [0.9e9, 1.2e9, 20e9] {
                let mut point = YieldPoint::slow(&*law, &state());
                let mut now = state();
                now.plastic_strain += point.plastic_increment(&*law, &now, &trial(before));
                now.temperature += 50.0;
                for stress in [0.3e9, 0.65e9, 0.7e9, 0.9e9, 3e9] {
                    let from_flow = point.clone().plastic_increment(&*law, &now, &trial(stress));
                    let from_rest = YieldPoint::slow(&*law, &now).plastic_increment(
                        &*law,
                        &now,
                        &trial(stress),
                    );
                    assert!(
                        (from_flow - from_rest).abs() <= 2.0 * TOLERANCE * stress / MODULUS,
                        "{law:?} {before} {stress}: {from_flow} {from_rest}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_body_that_stops_flowing_is_elastic_below_its_slow_flow_stress() {
        for law in laws() {
            let mut point = YieldPoint::slow(&*law, &state());
            let mut now = state();
            now.plastic_strain += point.plastic_increment(&*law, &now, &trial(1e9));
            let slow = law.flow_stress(&now).stress;
            assert_eq!(
                point.plastic_increment(&*law, &now, &trial(0.999 * slow)),
                0.0
            );
            assert!(point.holds(0.999 * slow) && !point.holds(1.001 * slow));
        }
    }
}
