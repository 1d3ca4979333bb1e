//! Erosion criterion `tate`: a tip that flows steadily as Alekseevskii and Tate have it.
//!
//! An element flows at constant area, so that its force is its flow stress times the rod's area, until its length is used up.
//! Then half its mass leaves with the velocity behind it and half with the tip's: of the momentum flux `ρ w² A₀` that arrives at
//! the speed `w` relative to the tip, one half goes with what leaves, which is Bernoulli's `½ ρ w²`, and the other half pushes on
//! the tip. The same holds of the target, whose elements are held in place ahead of the tip by what is around the column.
//! Arriving mass by mass, the momentum would make the tip's velocity jump, and `⟨w²⟩ > ⟨w⟩²` pushes the lighter side: a mass of
//! target that moves with the tip, as the flow around any nose has it, keeps it steady, and what leaves the tip takes the mean of
//! its velocities before and after the arrival.

use serde::{Deserialize, Serialize};

use super::{part::Role, state::State};

/// Strain, as a part of the length, at which an element counts as used up.
pub(super) const USED_UP_STRAIN: f64 = 0.97;
/// Section of an element's length by which its ends may approach in a step: less than what is left of it when it is used up.
const LARGEST_ADVANCE: f64 = 0.02;
/// Thickness of the target that moves with the tip, in diameters of the rod.
const TIP_THICKNESS: f64 = 0.5;
/// Friction that holds a node against any force [N].
const HELD: f64 = 1e30;

/// Mass of target that moves with the tip.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct Tip {
    /// Mass [kg].
    mass: f64,
    /// Node that carries it.
    node: usize,
}

/// Longest time step [s] in which no element can be crushed to nothing.
pub(super) fn longest_step(state: &State, speed: f64) -> f64 {
    let lengths =
        (0..state.elements.len()).map(|e| state.elements.part(e, |block| &block.rest_length));
    LARGEST_ADVANCE * lengths.fold(f64::INFINITY, f64::min) / speed
}

impl State {
    /// Puts a mass at the struck face and holds the target behind it.
    pub(super) fn add_tip(&mut self, diameter: f64) {
        let Some(segment) = self.face_segment().map(|face| self.segments[face]) else {
            return;
        };
        let part = &self.parts[segment.part];
        let mass = part.density * self.parts[0].area * TIP_THICKNESS * diameter;
        self.nodes.friction[segment.first_node + 1..].fill(HELD);
        self.nodes.mass[segment.first_node] += mass;
        self.tip = Some(Tip {
            mass,
            node: segment.first_node,
        });
    }

    /// Section of a node's mass that moves with the tip and belongs to no element [kg].
    pub(super) fn tip_mass_on(&self, node: usize) -> f64 {
        self.tip
            .filter(|tip| tip.node == node)
            .map_or(0.0, |tip| tip.mass)
    }

    /// Node at the tip of the element that follows node `left`, and the velocity [m/s] with which its mass [kg] leaves there, once
    /// what that changes has been given to the rest of the tip.
    ///
    /// As much mass is about to arrive with the velocity of the element's other end. What leaves between the two takes the mean
    /// of the tip's velocities before and after: with the one before, `w` would be the largest of its cycle, and `½ ρ w²` too
    /// large by a part of first order in the element's length.
    pub(super) fn leave_tip(&mut self, s: usize, left: usize, mass: f64) -> Option<(usize, f64)> {
        let tip = self.tip?;
        let segment = self.segments[s];
        if segment.elements().len() < 2 {
            // Nothing is left to arrive.
            return None;
        }
        let (node, other, partner) = if left + 1 == segment.last_node
            && self
                .interfaces
                .get(s)
                .is_some_and(|interface| interface.closed)
        {
            (left + 1, left, self.segments[s + 1].first_node)
        } else if left == segment.first_node && s > 0 && self.interfaces[s - 1].closed {
            (left, left + 1, self.segments[s - 1].last_node)
        } else {
            return None;
        };
        if tip.node != node && tip.node != partner {
            return None;
        }
        let pair = [node, partner].map(|i| (self.nodes.mass[i], self.nodes.velocity[i]));
        let tip_mass = pair[0].0 + pair[1].0;
        let before = (pair[0].0 * pair[0].1 + pair[1].0 * pair[1].1) / tip_mass;
        // Of `M (u' − u) = m (v − (u + u')/2)`.
        let share = mass / tip_mass;
        let jump = share * (self.nodes.velocity[other] - before) / (1.0 + 0.5 * share);
        let leaving = before + 0.5 * jump;
        let rest = tip_mass - mass;
        let after = (tip_mass * before - mass * leaving) / rest;
        self.nodes.velocity[node] = after;
        self.nodes.velocity[partner] = after;
        let kinetic = |mass: f64, velocity: f64| 0.5 * mass * velocity * velocity;
        self.accumulated.kicks.contact_loss +=
            pair.iter().map(|&(m, v)| kinetic(m, v)).sum::<f64>()
                - kinetic(rest, after)
                - kinetic(mass, leaving);
        Some((node, leaving))
    }

    /// Hands the tip's mass over the contact when the node that carries it goes with the eroded element between `left` and the
    /// node ahead of it.
    pub(super) fn move_tip(&mut self, s: usize, left: usize) {
        let Some(tip) = self.tip else { return };
        let segment = self.segments[s];
        let across = if tip.node == left && left == segment.first_node {
            s.checked_sub(1)
                .map(|behind| self.segments[behind].last_node)
        } else if tip.node == left + 1 && left + 1 == segment.last_node {
            self.segments.get(s + 1).map(|ahead| ahead.first_node)
        } else {
            return;
        };
        let momentum = tip.mass * self.nodes.velocity[tip.node];
        let energy = 0.5 * momentum * self.nodes.velocity[tip.node];
        self.nodes.mass[tip.node] -= tip.mass;
        let Some(across) = across else {
            self.accumulated.eroded_momentum += momentum;
            self.accumulated.eroded_energy += energy;
            self.tip = None;
            return;
        };
        // In contact both have one velocity; otherwise this is a plastic impact.
        let mut node = self.nodes.at(across);
        let before = 0.5 * node.mass * node.velocity * node.velocity + energy;
        node.velocity = (node.mass * node.velocity + momentum) / (node.mass + tip.mass);
        node.mass += tip.mass;
        self.nodes.velocity[across] = node.velocity;
        self.nodes.mass[across] = node.mass;
        self.accumulated.kicks.contact_loss +=
            before - 0.5 * node.mass * node.velocity * node.velocity;
        self.tip = Some(Tip {
            node: across,
            ..tip
        });
    }

    /// Lets the face of the target move.
    pub(super) fn release_face(&mut self) {
        if self.tip.is_some()
            && let Some(face) = self.face_segment()
        {
            let first = self.segments[face].first_node;
            debug_assert_eq!(self.parts[self.segments[face].part].role, Role::Target);
            self.nodes.friction[first] = 0.0;
        }
    }
}
