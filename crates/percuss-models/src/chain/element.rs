//! Constitutive update of one element.

use super::{part::Section, state::Element};
use crate::{
    material::{FlowState, Trial},
    options::Kinematics,
    power::{exponential, log_ratio},
};

impl Element {
    /// Brings the element to a new length over a time step and returns the plastic work done between the half steps
    /// around the current time, per volume.
    ///
    /// The work that belongs to a time is its stress times half the plastic strain of the steps before and after it: with
    /// that, kinetic, elastic and plastic energy of a chain of small strain add up to rounding.
    #[inline(always)]
    pub(super) fn deform(&mut self, part: &Section, length: f64, time_step: f64) -> f64 {
        let step_before = self.stretch(part, length);
        if !self.yield_point.holds(self.stress.abs()) {
            self.flow(part, time_step);
        }
        self.settle(part, step_before)
    }

    /// Brings the element to a new length as if nothing flowed; returns the plastic strain of the last step.
    #[inline(always)]
    pub(super) fn stretch(&mut self, part: &Section, length: f64) -> f64 {
        self.length = length;
        let elastic = match part.kinematics {
            // Plastic strain changes the unloaded length, so that the logarithm is one of a small strain.
            Kinematics::Logarithmic => log_ratio(self.unloaded_length, length),
            Kinematics::SmallStrain => {
                (self.rest_length - length) / self.rest_length - self.plastic_axial
            }
        };
        self.strain = self.plastic_axial + elastic;
        self.stress_before = self.stress;
        self.stress = part.modulus * elastic;
        std::mem::take(&mut self.plastic_step)
    }

    /// Sets the force once what flows has flowed; returns the plastic work as [`Element::deform`] does.
    #[inline(always)]
    pub(super) fn settle(&mut self, part: &Section, step_before: f64) -> f64 {
        self.axial_force = match part.kinematics {
            Kinematics::Logarithmic => self.stress * self.volume * (1.0 / self.length),
            Kinematics::SmallStrain => self.stress * self.rest_area,
        };
        0.5 * self.stress_before * (step_before + self.plastic_step)
    }

    /// Returns a trial stress to the yield surface.
    pub(super) fn flow(&mut self, part: &Section, time_step: f64) {
        let trial = self.stress;
        let increment = self.yield_point.plastic_increment(
            &*part.strength,
            &FlowState {
                plastic_strain: self.plastic_strain,
                strain_rate: 0.0,
                temperature: self.temperature,
                pressure: trial / 3.0,
            },
            &Trial {
                stress: trial.abs(),
                modulus: part.modulus,
                pressure_fall: part.modulus.copysign(trial) / 3.0,
                elapsed: part.rate_effects.then_some(time_step),
            },
        );
        if increment == 0.0 {
            return;
        }
        self.plastic_step = increment.copysign(trial);
        self.stress = trial - part.modulus * self.plastic_step;
        self.plastic_axial += self.plastic_step;
        self.unloaded_length *= exponential(-self.plastic_step);
        self.plastic_strain += increment;
        self.largest_rate = self.largest_rate.max(increment * (1.0 / time_step));
        let work = 0.5 * (self.stress_before + self.stress).abs() * increment;
        self.temperature += part.heating * work;
    }

    /// Whether an update to the same length would change nothing.
    #[inline(always)]
    pub(super) fn is_settled(&self) -> bool {
        self.plastic_step == 0.0
            && self.viscous_force == 0.0
            && self.stress == self.stress_before
            && self.advance_step == 0.0
    }

    /// Largest stable time step of the undamped element [s]: the time a wave takes through it.
    #[inline(always)]
    pub(super) fn stable_step(&self, part: &Section) -> f64 {
        match part.kinematics {
            // The force grows faster than the stress as the area grows: the tangent is E + σ, and 1/sqrt(1 + x) > 1 − x/2.
            Kinematics::Logarithmic => {
                let stiffening = 0.5 * (self.stress * part.compliance).clamp(0.0, 1.0);
                self.length * part.slowness * (1.0 - stiffening)
            }
            Kinematics::SmallStrain => self.rest_length * part.slowness,
        }
    }

    /// Current cross-sectional area [m2].
    pub(super) fn area(&self, part: &Section) -> f64 {
        match part.kinematics {
            Kinematics::Logarithmic => self.volume / self.length,
            Kinematics::SmallStrain => self.rest_area,
        }
    }
}
