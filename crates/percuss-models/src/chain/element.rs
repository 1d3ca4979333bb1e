//! Constitutive update of an element, of one run or of eight side by side.

use serde::{Deserialize, Serialize};

use super::{part::Section, state::Element};
use crate::{
    lanes::{larger, smaller},
    material::{FlowState, Trial},
    options::Kinematics,
    power::{exponential, log_ratio},
};

percuss_core::per_lane! {
    /// Elastic state of an element.
    #[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
    pub(super) struct Spring<R = f64> {
        /// Length without stress [m].
        pub(super) unloaded_length: R,
        /// Stress now and a step before [Pa].
        pub(super) stress: R,
        pub(super) stress_before: R,
    }
}

percuss_core::per_lane! {
    /// What flow changes besides.
    #[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
    pub(super) struct Plastic<R = f64> {
        /// Axial plastic strain, compression positive, and its part in the last step.
        pub(super) axial: R,
        pub(super) step: R,
        /// Accumulated plastic strain.
        pub(super) strain: R,
        /// Largest plastic strain rate so far [1/s].
        pub(super) largest_rate: R,
        pub(super) temperature: R,
    }
}

impl Plastic {
    /// Adds an increment of plastic strain under a trial stress of either sign; `per_time` is the inverse of the time step.
    #[inline(always)]
    pub(super) fn add(&mut self, increment: f64, trial: f64, per_time: f64) {
        self.step = increment.copysign(trial);
        self.axial += self.step;
        self.strain += increment;
        self.largest_rate = larger(increment * per_time, self.largest_rate);
    }

    /// Turns the plastic work of an increment into heat; stresses are those before and after it, and `heating` is the rise in temperature
    /// per plastic work per volume.
    #[inline(always)]
    pub(super) fn heat(&mut self, heating: f64, stresses: [f64; 2], increment: f64) {
        let work = 0.5 * (stresses[0] + stresses[1]).abs() * increment;
        self.temperature += heating * work;
    }
}

impl Spring {
    /// Takes the stress of a new length, as if nothing flowed.
    #[inline(always)]
    pub(super) fn bear(&mut self, stress: f64) {
        self.stress_before = self.stress;
        self.stress = stress;
    }

    /// Force of an element that keeps its volume [N].
    #[inline(always)]
    pub(super) fn force(&self, volume: f64, length: f64) -> f64 {
        self.stress * volume * (1.0 / length)
    }

    /// Lets a trial stress flow by an increment of plastic strain; `heating` is the rise in temperature per plastic work per volume, and
    /// `per_time` the inverse of the time step.
    #[inline(always)]
    pub(super) fn flow_by(
        &mut self,
        increment: f64,
        plastic: &mut Plastic,
        [modulus, heating]: [f64; 2],
        per_time: f64,
    ) {
        plastic.add(increment, self.stress, per_time);
        self.stress -= modulus * plastic.step;
        self.unloaded_length *= exponential(-plastic.step);
        plastic.heat(heating, [self.stress_before, self.stress], increment);
    }

    /// Plastic work between the half steps around the current time, per volume.
    ///
    /// The work that belongs to a time is its stress times half the plastic strain of the steps before and after it: with
    /// that, kinetic, elastic and plastic energy of a chain of small strain add up to rounding.
    #[inline(always)]
    pub(super) fn plastic_work(&self, step_before: f64, step: f64) -> f64 {
        0.5 * self.stress_before * (step_before + step)
    }

    /// Largest stable time step of the undamped element [s]: the time a wave takes through it.
    ///
    /// The force grows faster than the stress as the area grows: the tangent is E + σ, and 1/sqrt(1 + x) > 1 − x/2.
    #[inline(always)]
    pub(super) fn stable_step(&self, length: f64, compliance: f64, slowness: f64) -> f64 {
        let stiffening = 0.5 * larger(smaller(self.stress * compliance, 1.0), 0.0);
        length * slowness * (1.0 - stiffening)
    }

    /// Elastic energy between two steps: the form that central differences conserve.
    #[inline(always)]
    pub(super) fn elastic_energy(&self, volume: f64, modulus: f64) -> f64 {
        volume * self.stress_before * self.stress / (2.0 * modulus)
    }
}

/// Speed at which the ends of an element approach or part, as a part of its length [1/s].
#[inline(always)]
pub(super) fn approach_rate(closing_speed: f64, length: f64) -> f64 {
    closing_speed.abs() * (1.0 / length)
}

impl Element {
    /// Brings the element to a new length over a time step and returns the plastic work done between the half steps
    /// around the current time, per volume.
    #[inline(always)]
    pub(super) fn deform(&mut self, part: &Section, length: f64, time_step: f64) -> f64 {
        let step_before = self.stretch(part, length);
        if !self.yield_point.holds(self.spring.stress.abs()) {
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
            Kinematics::Logarithmic => log_ratio(self.spring.unloaded_length, length),
            Kinematics::SmallStrain => {
                (self.rest_length - length) / self.rest_length - self.plastic.axial
            }
        };
        self.strain = self.plastic.axial + elastic;
        self.spring.bear(part.modulus * elastic);
        std::mem::take(&mut self.plastic.step)
    }

    /// Sets the force once what flows has flowed; returns the plastic work as [`Element::deform`] does.
    #[inline(always)]
    pub(super) fn settle(&mut self, part: &Section, step_before: f64) -> f64 {
        self.axial_force = match part.kinematics {
            Kinematics::Logarithmic => self.spring.force(self.volume, self.length),
            Kinematics::SmallStrain => self.spring.stress * self.rest_area,
        };
        self.spring.plastic_work(step_before, self.plastic.step)
    }

    /// Returns a trial stress to the yield surface.
    #[inline(always)]
    pub(super) fn flow(&mut self, part: &Section, time_step: f64) {
        let trial = self.spring.stress;
        let increment = self.yield_point.plastic_increment(
            &*part.strength,
            &FlowState {
                plastic_strain: self.plastic.strain,
                strain_rate: 0.0,
                temperature: self.plastic.temperature,
                pressure: trial / 3.0,
            },
            &Trial {
                stress: trial.abs(),
                modulus: part.modulus,
                pressure_fall: part.modulus.copysign(trial) / 3.0,
                elapsed: part.rate_effects.then_some(time_step),
            },
        );
        if increment != 0.0 {
            let constants = [part.modulus, part.heating];
            let per_time = 1.0 / time_step;
            self.spring
                .flow_by(increment, &mut self.plastic, constants, per_time);
        }
    }

    /// Whether an update to the same length would change nothing.
    #[inline(always)]
    pub(super) fn is_settled(&self) -> bool {
        (self.plastic.step == 0.0)
            & (self.viscous_force == 0.0)
            & (self.spring.stress == self.spring.stress_before)
            & (self.advance_step == 0.0)
    }

    /// Largest stable time step of the undamped element [s].
    #[inline(always)]
    pub(super) fn stable_step(&self, part: &Section) -> f64 {
        match part.kinematics {
            Kinematics::Logarithmic => {
                self.spring
                    .stable_step(self.length, part.compliance, part.slowness)
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
