//! Lanes in which elements have eroded: what is left of their bodies, and what is between the pieces.

use super::{bundle::Bundle, interfaces::Interface};
use crate::{
    chain::{column::ColumnRun, state::State},
    lanes::LANES,
};

impl Bundle {
    /// Takes the elements out of a lane that have eroded in the single run, which has just been let out; false when too little is
    /// left to go on here.
    pub(super) fn erode(&mut self, lane: usize, run: &ColumnRun<'_>) -> bool {
        let state = &run.solver.state;
        let (Some(tip), Some(_)) = (state.tip_segment(), state.face_segment()) else {
            return false;
        };
        let back = self.nodes.len() - 1;
        if state.segments[state.segments.len() - 1].last_node != back {
            return false;
        }
        self.tails[lane] = state.segments[0].first_node;
        let bit = 1 << lane;
        for e in 0..state.elements.len() {
            if state.elements.part(e, |block| &block.eroded) {
                self.marks[e].gone |= bit;
                let spring = &mut self.springs[e];
                spring.stress.0[lane] = 0.0;
                spring.stress_before.0[lane] = 0.0;
                self.forces[e].0[lane] = 0.0;
                self.plastics[e].step.0[lane] = 0.0;
            }
        }
        let mut is_left = vec![false; self.nodes.len()];
        for segment in &state.segments {
            is_left[segment.first_node..=segment.last_node].fill(true);
        }
        for (i, is_left) in is_left.into_iter().enumerate() {
            if is_left {
                self.masses[i].0[lane] = state.nodes.mass[i];
                self.frictions[i].0[lane] = state.nodes.friction[i];
            } else {
                // No force acts on it any more.
                self.nodes[i].velocity.0[lane] = 0.0;
            }
        }
        self.set_joints(lane, state, tip);
        self.find_irregular_nodes();
        self.unsettle();
        true
    }

    fn set_joints(&mut self, lane: usize, state: &State, tip: usize) {
        self.remove_joints(lane);
        let projectile = self.mesh.elements[0];
        for (place, interface) in state.interfaces.iter().enumerate() {
            let behind = state.segments[place].last_node;
            let ahead = state.segments[place + 1].first_node;
            if place == tip {
                self.contacts[lane] = [behind, ahead];
                if [behind, ahead] == [projectile, projectile + 1] {
                    continue;
                }
                self.displaced |= 1 << lane;
            }
            for node in [behind, ahead] {
                self.in_contact[node] |= 1 << lane;
            }
            if place == tip {
                continue;
            }
            self.interfaces.push(Interface {
                ahead,
                behind,
                lane,
                place,
                closed: interface.closed,
            });
        }
        self.interfaces.sort_unstable();
    }

    fn remove_joints(&mut self, lane: usize) {
        let bit = 1 << lane;
        self.displaced &= !bit;
        for in_contact in &mut self.in_contact {
            *in_contact &= !bit;
        }
        self.interfaces.retain(|interface| interface.lane != lane);
    }

    /// Makes the bodies of a lane whole again.
    pub(super) fn mend(&mut self, lane: usize) {
        self.tails[lane] = 0;
        let tip = self.mesh.elements[0];
        self.contacts[lane] = [tip, tip + 1];
        for mark in &mut self.marks {
            mark.gone &= !(1 << lane);
        }
        self.remove_joints(lane);
        self.find_irregular_nodes();
    }

    /// Finds the nodes between the ends of a body that are not like the others in every lane.
    fn find_irregular_nodes(&mut self) {
        self.irregular.clear();
        let [projectile, target] = self.mesh.elements;
        let back = projectile + 1 + target;
        for i in (0..projectile).chain(projectile + 2..back) {
            let body = &self.bodies[usize::from(i > projectile)];
            let mass = if i == 0 { body.end_mass } else { body.mass };
            let (masses, frictions) = (self.masses[i], self.frictions[i]);
            let is_odd =
                |l: usize| masses.0[l] != mass.0[l] || frictions.0[l] != body.friction.0[l];
            if self.in_contact[i] != 0 || (0..LANES).any(is_odd) {
                self.irregular.push(i);
            }
        }
    }
}
