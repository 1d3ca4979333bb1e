//! One step of explicit central differences, with an energy balance that only the integration error is left in.

use std::ops::Range;

use super::{
    friction::{FrictionSums, KickedMasses},
    part::Section,
    state::{BoundaryCondition, Element, Segment, State},
};
use crate::{
    error::NumericalError,
    options::{ArtificialViscosity, ChainOptions},
};

/// Largest change of strain that one element may make in one step.
pub(super) const LARGEST_STRAIN_STEP: f64 = 0.03;
/// Section of the largest time step allowed that is taken, so that the next ones need not be shorter again.
const STEP_MARGIN: f64 = 0.98;
/// The time step grows only when it could grow by this factor, and no faster than by the second one.
const STEP_SLACK: f64 = 1.1;
const LARGEST_STEP_GROWTH: f64 = 1.05;

/// Numbers that control the steps.
#[derive(Debug, Clone, Copy)]
pub(super) struct StepControl {
    pub(super) courant: f64,
    pub(super) viscosity: ArtificialViscosity,
    pub(super) damping_ratio: f64,
    pub(super) local_damping: f64,
    pub(super) erosion_strain: f64,
    /// Whether anything may part in tension.
    pub(super) fails: bool,
    /// Longest time step [s].
    pub(super) longest_step: f64,
}

impl StepControl {
    /// Of a case, with a Courant number, an erosion strain and a longest step [s].
    pub(super) fn new(
        options: &ChainOptions,
        courant: f64,
        erosion_strain: f64,
        longest_step: f64,
    ) -> Self {
        Self {
            courant,
            viscosity: options.artificial_viscosity(),
            damping_ratio: options.damping_ratio(),
            local_damping: options.local_damping(),
            erosion_strain,
            fails: options.failure.is_some(),
            longest_step,
        }
    }

    /// Whether anything damps the motion.
    pub(super) fn is_damped(&self) -> bool {
        self.is_viscous() || self.local_damping > 0.0
    }

    pub(super) fn is_viscous(&self) -> bool {
        self.viscosity != ArtificialViscosity::default() || self.damping_ratio > 0.0
    }

    /// Stable step of a chain with local damping: where force and motion oppose each other, damping adds its part to the stiffness.
    fn damped(&self, stable_step: f64) -> f64 {
        stable_step / (1.0 + self.local_damping).sqrt()
    }

    /// Factor on the stable step of the undamped chain at the moment of impact.
    pub(super) fn first_step_factor(&self, state: &State, impact_velocity: f64) -> f64 {
        let slowness = state.parts.iter().map(|part| part.slowness);
        damped_limit(self.viscous_ratio(impact_velocity, slowness.fold(0.0, f64::max)))
    }

    /// Factor on the stable step of anything undamped, as long as nothing approaches faster than the impact [m/s], for the largest of some
    /// slownesses [s/m].
    pub(super) fn step_factor(&self, impact_velocity: f64, slowness: f64) -> f64 {
        self.damped(damped_limit(self.viscous_ratio(impact_velocity, slowness)))
    }

    /// Damping ratio of a spring whose ends approach at a speed [m/s], with the inverse of its wave speed [s/m].
    pub(super) fn viscous_ratio(&self, approach: f64, slowness: f64) -> f64 {
        let mut ratio = self.damping_ratio;
        if approach > 0.0 {
            ratio += self.viscosity.linear + self.viscosity.quadratic * approach * slowness;
        }
        ratio
    }

    /// Sets the viscous force of an element whose ends approach at a speed; returns the factor on its stable step.
    pub(super) fn damp(&self, element: &mut Element, part: &Section, approach: f64) -> f64 {
        let ratio = self.viscous_ratio(approach, part.slowness);
        element.viscous_force =
            ratio * part.density * part.wave_speed * element.area(part) * approach;
        damped_limit(ratio)
    }
}

/// Section of the undamped stable step that is left with a damping ratio, for central differences with lagged velocities.
fn damped_limit(ratio: f64) -> f64 {
    (1.0 + ratio * ratio).sqrt() - ratio
}

/// Velocity of a mass after a kick by a force for a time over the mass, against friction.
#[inline(always)]
fn kick_mass(
    [mass, ratio]: [f64; 2],
    velocity: f64,
    [force, friction]: [f64; 2],
    sums: &mut FrictionSums,
) -> f64 {
    if friction > 0.0 {
        let kicked = KickedMasses {
            mass,
            ratio,
            limit: friction * ratio,
        };
        let after = sums.kick(&kicked, velocity, velocity != 0.0, force);
        after.unwrap_or(velocity)
    } else {
        velocity + force * ratio
    }
}

impl State {
    /// Advances by one step.
    pub(super) fn advance(&mut self, control: &StepControl) -> Result<(), NumericalError> {
        let allowed = control.courant * control.damped(self.stable_step);
        let step = StepTimes::choose(self.time_step, allowed.min(control.longest_step));
        let (kick, time_step) = (step.kick, step.length);
        self.collect_forces();
        self.collect_band_forces();
        self.apply_cohesive_traction();
        self.apply_target_reaction();
        if control.local_damping > 0.0 {
            self.damp_locally(control.local_damping);
        }
        if !self.gaps.is_empty() {
            self.leave_layers();
        }
        self.kick(kick, control.is_viscous());
        if control.local_damping > 0.0 {
            self.account_for_local_damping(kick);
        }
        self.close_contacts(kick, time_step);
        let largest_strain = self.drift(control, time_step)?;
        self.drift_plate(time_step);
        self.time += time_step;
        self.time_step = time_step;
        self.step += 1;
        if largest_strain >= control.erosion_strain {
            self.erode(control.erosion_strain);
        }
        if control.fails {
            self.damage(time_step);
            self.split_failed_interfaces();
        }
        Ok(())
    }

    /// Takes the friction from nodes in gaps: what they have left does not hold them again, nor does the next layer.
    fn leave_layers(&mut self) {
        for (position, friction) in self.nodes.position.iter().zip(&mut self.nodes.friction) {
            let is_inside = |[from, to]: &[f64; 2]| from < position && position < to;
            if self.gaps.iter().any(is_inside) {
                *friction = 0.0;
            }
        }
    }

    fn collect_forces(&mut self) {
        let velocities = &self.nodes.velocity;
        self.nodes.velocity_before.copy_from_slice(velocities);
        for segment in &self.segments {
            let nodes = segment.first_node..=segment.last_node;
            let forces = self.nodes.force[nodes.clone()].iter_mut();
            let mut forces = forces.zip(&mut self.nodes.spring_force[nodes]);
            let (mut behind, mut spring_behind) = (0.0, 0.0);
            // The elements first: they end before the nodes do.
            for (e, (force, spring_force)) in segment.elements().zip(&mut forces) {
                let axial = self.elements.part(e, |block| &block.axial_force);
                let all = axial + self.elements.part(e, |block| &block.viscous_force);
                (*force, *spring_force) = (behind - all, spring_behind - axial);
                (behind, spring_behind) = (all, axial);
            }
            for (force, spring_force) in forces {
                (*force, *spring_force) = (behind, spring_behind);
            }
        }
    }

    /// New velocities from forces, friction, contact and the boundary.
    fn kick(&mut self, kick: f64, viscous: bool) {
        self.contact_force = 0.0;
        let last_segment = self.segments.len() - 1;
        // Whether the contact before a segment was closed when the kick began: it may open on the way.
        let mut joined_ahead = false;
        for s in 0..=last_segment {
            let Segment {
                first_node,
                last_node,
                ..
            } = self.segments[s];
            let from = first_node + usize::from(joined_ahead);
            let joined_behind = s < last_segment && self.interfaces[s].closed;
            let is_boundary = s == last_segment && self.end != BoundaryCondition::Free;
            let to = last_node + 1 - usize::from(joined_behind || is_boundary);
            // A wall is one node that stands: it has none that are free.
            self.kick_inner(from..to.max(from), kick);
            if is_boundary && from <= last_node {
                self.kick_boundary(last_node, kick);
            }
            if joined_behind {
                self.kick_contact(s, kick);
            }
            joined_ahead = joined_behind;
        }
        if viscous {
            self.account_for_viscous_work(kick);
        }
        self.account_for_fracture(kick);
        self.account_for_target_turned_aside(kick);
        self.kick_plate(kick);
    }

    fn account_for_viscous_work(&mut self, kick: f64) {
        let mut work = 0.0;
        for segment in &self.segments {
            for e in segment.elements() {
                let (a, b) = (e + segment.shift, e + segment.shift + 1);
                let before = self.nodes.velocity_before[a] - self.nodes.velocity_before[b];
                let after = self.nodes.velocity[a] - self.nodes.velocity[b];
                let force = self.elements.part(e, |block| &block.viscous_force);
                work += force * 0.5 * (before + after) * kick;
            }
        }
        self.accumulated.viscous_work += work;
    }

    /// Kicks nodes that touch nothing.
    fn kick_inner(&mut self, nodes: Range<usize>, kick: f64) {
        if self.tip_friction > 0.0 {
            for i in nodes {
                self.kick_free(i, kick);
            }
            return;
        }
        let mut sums = self.accumulated.kicks.friction;
        let (mut last_mass, mut ratio) = (f64::NAN, f64::NAN);
        let masses = self.nodes.mass[nodes.clone()].iter();
        let forces = self.nodes.force[nodes.clone()].iter();
        let frictions = self.nodes.friction[nodes.clone()].iter();
        let nodes = self.nodes.velocity[nodes].iter_mut();
        for ((velocity, (&mass, &force)), &friction) in nodes.zip(masses.zip(forces)).zip(frictions)
        {
            // Neighbours mostly have one mass, and a division takes long.
            if mass != last_mass {
                last_mass = mass;
                ratio = kick / mass;
            }
            *velocity = kick_mass([mass, ratio], *velocity, [force, friction], &mut sums);
        }
        self.accumulated.kicks.friction = sums;
    }

    pub(super) fn kick_free(&mut self, i: usize, kick: f64) {
        let node = self.nodes.at(i);
        let mut of_node = FrictionSums::default();
        let masses = [node.mass, kick / node.mass];
        let forces = [node.force, node.friction];
        self.nodes.velocity[i] = kick_mass(masses, node.velocity, forces, &mut of_node);
        let sums = &mut self.accumulated.kicks.friction;
        sums.impulse += of_node.impulse;
        sums.work += of_node.work;
        if self.tip_friction > 0.0 && node.friction > 0.0 {
            // A constant-pressure target has no other friction.
            self.contact_force = of_node.impulse / kick;
        }
    }

    pub(super) fn kick_boundary(&mut self, i: usize, kick: f64) {
        let node = self.nodes.at(i);
        let velocity = &mut self.nodes.velocity[i];
        let sums = &mut self.accumulated;
        match self.end {
            BoundaryCondition::Free => self.kick_free(i, kick),
            BoundaryCondition::Fixed => {
                *velocity = 0.0;
                self.back_force = node.force;
                sums.support_impulse += node.force * kick;
            }
            BoundaryCondition::Open {
                impedance,
                stiffness,
            } => {
                let spring = stiffness * (node.position - self.back_position);
                let end = OpenEnd { impedance, spring };
                let [after, mean, force] = end.kick(node.mass, node.velocity, node.force, kick);
                *velocity = after;
                self.back_force = force;
                sums.support_impulse += force * kick;
                sums.boundary_work += force * mean * kick;
            }
        }
    }

    pub(super) fn is_boundary(&self, i: usize) -> bool {
        self.end != BoundaryCondition::Free
            && self.segments.last().is_some_and(|last| last.last_node == i)
    }

    pub(super) fn is_fixed(&self, i: usize) -> bool {
        self.end == BoundaryCondition::Fixed && self.is_boundary(i)
    }
}

percuss_core::per_lane! {
    /// Times of a step [s].
    #[derive(Debug, Clone, Copy, Default)]
    pub(super) struct StepTimes<R = f64> {
        /// Length of the step before, of this one, and of the kick between them.
        pub(super) before: R,
        pub(super) length: R,
        pub(super) kick: R,
        /// Inverse of its length [1/s].
        pub(super) rate: R,
    }
}

impl StepTimes {
    /// Those of a step after one of length `before`, when `allowed` is the largest one allowed.
    ///
    /// Every change of the time step costs a little energy, so small changes are not made.
    #[inline(always)]
    pub(super) fn choose(before: f64, allowed: f64) -> Self {
        let length = if before == 0.0 || allowed < before {
            STEP_MARGIN * allowed
        } else if allowed > STEP_SLACK * before {
            LARGEST_STEP_GROWTH * before
        } else {
            before
        };
        Self {
            before,
            length,
            // Velocities live half a step behind positions: the kick spans the two half steps around the current time.
            kick: 0.5 * (before + length),
            rate: 1.0 / length,
        }
    }
}

/// Largest time step in which no element makes too large a change of strain, for the largest rate at which ends approach or part, as a
/// part of the length [1/s].
#[inline(always)]
pub(super) fn strain_limited_step(fastest: f64) -> f64 {
    LARGEST_STRAIN_STEP / fastest
}

/// A boundary that takes up waves, with the force of a spring beside it.
#[derive(Clone, Copy)]
pub(super) struct OpenEnd {
    pub(super) impedance: f64,
    pub(super) spring: f64,
}

impl OpenEnd {
    /// Kicks the last node of a chain by the force of its element: its velocity, and the mean one and the force on the boundary in the kick.
    #[inline(always)]
    pub(super) fn kick(self, mass: f64, before: f64, force: f64, kick: f64) -> [f64; 3] {
        let (inertia, half) = (mass / kick, 0.5 * self.impedance);
        let after = ((inertia - half) * before + force - self.spring) / (inertia + half);
        let mean = 0.5 * (before + after);
        [after, mean, self.impedance * mean + self.spring]
    }
}
