//! Constitutive update of one element.

use super::{part::Part, state::Element};
use crate::{case::Kinematics, material::FlowState};

/// Imbalance of stress, as a part of the trial stress, from which one more Newton step is exact: convergence is quadratic,
/// so what is left after it is of the order of its square.
const NEWTON_TOLERANCE: f64 = 1e-6;

/// Flow stress without rate effect and its slope with plastic strain [Pa].
pub(super) fn static_flow_stress(
    part: &Part,
    plastic_strain: f64,
    temperature: f64,
    pressure: f64,
) -> (f64, f64) {
    let flow = part.strength.flow_stress(&FlowState {
        plastic_strain,
        strain_rate: 0.0,
        temperature,
        pressure,
    });
    (flow.stress, flow.strain_slope)
}

impl Element {
    /// Brings the element to a new length over a time step and returns the plastic work done between the half steps
    /// around the current time, per volume.
    ///
    /// The work that belongs to a time is its stress times half the plastic strain of the steps before and after it: with
    /// that, kinetic, elastic and plastic energy of a chain of small strain add up to rounding.
    pub(super) fn deform(&mut self, part: &Part, length: f64, time_step: f64) -> f64 {
        self.length = length;
        self.strain = match part.kinematics {
            Kinematics::Logarithmic => (self.rest_length / length).ln(),
            Kinematics::SmallStrain => (self.rest_length - length) / self.rest_length,
        };
        let trial = part.modulus * (self.strain - self.plastic_axial);
        self.stress_before = self.stress;
        self.stress = trial;
        let step_before = self.plastic_step;
        self.plastic_step = 0.0;
        if trial.abs() > self.flow_stress {
            self.flow(part, trial, time_step, step_before);
        }
        self.axial_force = match part.kinematics {
            Kinematics::Logarithmic => self.stress * self.rest_area * self.rest_length / length,
            Kinematics::SmallStrain => self.stress * self.rest_area,
        };
        0.5 * self.stress_before * (step_before + self.plastic_step)
    }

    /// Returns a trial stress to the yield surface.
    fn flow(&mut self, part: &Part, trial: f64, time_step: f64, step_before: f64) {
        let (increment, flow) = self.plastic_increment(part, trial, time_step, step_before);
        self.plastic_step = increment.copysign(trial);
        self.stress = trial - part.modulus * self.plastic_step;
        self.plastic_axial += self.plastic_step;
        self.plastic_strain += increment;
        self.largest_rate = self.largest_rate.max(increment / time_step);
        let work = 0.5 * (self.stress_before + self.stress).abs() * increment;
        self.temperature += part.heating * work;
        (self.flow_stress, self.flow_slope) = if part.strength.depends_on_strain_only() {
            flow
        } else {
            static_flow_stress(
                part,
                self.plastic_strain,
                self.temperature,
                self.stress / 3.0,
            )
        };
    }

    /// Solves `|σ_trial| − E Δ = Y(ε_p + Δ, Δ/Δt, T)` for Δ by Newton's method, held inside a bracket.
    ///
    /// Returns Δ with the flow stress and its slope there.
    fn plastic_increment(
        &self,
        part: &Part,
        trial: f64,
        time_step: f64,
        step_before: f64,
    ) -> (f64, (f64, f64)) {
        let (sign, trial) = (trial.signum(), trial.abs());
        let (mut low, mut high) = (0.0, trial / part.modulus);
        // The flow stress at the start of the step is known: the first Newton step costs no evaluation of the law.
        let mut increment =
            ((trial - self.flow_stress) / (part.modulus + self.flow_slope)).clamp(low, high);
        // With rate effects that step overshoots, and the last increment is nearer: a flow lasts for many steps.
        if !part.strength.depends_on_strain_only() && step_before * sign > 0.0 {
            increment = step_before.abs().clamp(low, high);
        }
        let mut found = (self.flow_stress, self.flow_slope);
        for _ in 0..100 {
            let rate = if part.rate_effects {
                increment / time_step
            } else {
                0.0
            };
            let flow = part.strength.flow_stress(&FlowState {
                plastic_strain: self.plastic_strain + increment,
                strain_rate: rate,
                temperature: self.temperature,
                pressure: sign * (trial - part.modulus * increment) / 3.0,
            });
            let rate_slope = if part.rate_effects {
                flow.rate_slope / time_step
            } else {
                0.0
            };
            let excess = trial - part.modulus * increment - flow.stress;
            let step = excess / (part.modulus + flow.strain_slope + rate_slope);
            let newton = increment + step;
            found = (flow.stress + flow.strain_slope * step, flow.strain_slope);
            if excess.abs() <= NEWTON_TOLERANCE * trial && newton >= 0.0 {
                return (newton, found);
            }
            if excess > 0.0 {
                low = increment;
            } else {
                high = increment;
            }
            let next = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
            if next == increment || high - low <= 1e-15 * high {
                return (next, found);
            }
            increment = next;
        }
        (increment, found)
    }

    /// Whether an update to the same length would change nothing.
    pub(super) fn is_settled(&self) -> bool {
        self.plastic_step == 0.0
            && self.viscous_force == 0.0
            && self.stress == self.stress_before
            && self.advance_step == 0.0
    }

    /// Largest stable time step of the undamped element [s]: the time a wave takes through it.
    pub(super) fn stable_step(&self, part: &Part) -> f64 {
        match part.kinematics {
            // The force grows faster than the stress as the area grows: the tangent is E + σ, and 1/sqrt(1 + x) > 1 − x/2.
            Kinematics::Logarithmic => {
                let stiffening = 0.5 * (self.stress / part.modulus).clamp(0.0, 1.0);
                self.length * part.slowness * (1.0 - stiffening)
            }
            Kinematics::SmallStrain => self.rest_length * part.slowness,
        }
    }

    /// Current cross-sectional area [m2].
    pub(super) fn area(&self, part: &Part) -> f64 {
        match part.kinematics {
            Kinematics::Logarithmic => self.rest_area * self.rest_length / self.length,
            Kinematics::SmallStrain => self.rest_area,
        }
    }
}
