//! Erosion: elements that leave the chain, with everything that leaves with them.

use super::{
    interface::Interface,
    part::Role,
    state::{BoundaryCondition, Segment, State},
};

/// Times the erosion strain that an element bears in a projectile that spreads on a floor that stands: as good as for ever, and soon
/// enough for a time step that its length sets.
const SPREADING_ENDURANCE: f64 = 2.0;

impl State {
    /// Takes out the elements whose strain has passed the limit, accounting for what leaves with them.
    pub(super) fn erode(&mut self, limit: f64) {
        let mut s = 0;
        while s < self.segments.len() {
            let segment = self.segments[s];
            let limit = limit * self.endurance(self.parts[segment.part].role);
            let strain = |e: usize| self.elements.part(e, |block| &block.strain);
            match segment.elements().find(|&e| strain(e).abs() >= limit) {
                // The segment at `s` is another one afterwards: look again.
                Some(e) => self.remove_element(s, e),
                None => s += 1,
            }
        }
    }

    /// Factor on the strain at which elements of a body erode: at the mouth of a cone that can be penetrated the target is pushed
    /// aside and the cone ahead stays whole, and a projectile that cannot penetrate it spreads before it is turned back.
    fn endurance(&self, role: Role) -> f64 {
        match (&self.penetration, role) {
            (None, _) => 1.0,
            (Some(_), Role::Target) => f64::INFINITY,
            (Some(penetration), Role::Projectile) if self.can_penetrate(penetration) => 1.0,
            (Some(_), Role::Projectile) => SPREADING_ENDURANCE,
        }
    }

    fn remove_element(&mut self, s: usize, e: usize) {
        let segment = self.segments[s];
        let part = &self.parts[segment.part];
        let element = self.elements.get(e);
        let masses = element.end_masses;
        let half_friction = 0.5 * part.friction_per_length * element.rest_length;
        self.accumulated.eroded_energy += self.elastic_energy(e, part);
        let left = e + segment.shift;
        // the erosion criterion of Tate has a column: both halves are alike.
        let leaving = self.leave_tip(s, left, masses[0]);
        for (i, mass) in [left, left + 1].into_iter().zip(masses) {
            let velocity = match leaving {
                Some((tip, velocity)) if tip == i => velocity,
                _ => self.nodes.velocity[i],
            };
            self.accumulated.eroded_energy += 0.5 * mass * velocity * velocity;
            self.accumulated.eroded_momentum += mass * velocity;
            self.nodes.mass[i] -= mass;
            self.nodes.friction[i] = (self.nodes.friction[i] - half_friction).max(0.0);
            if let Some(hold) = &mut self.hold {
                hold.bands.erode(i, 0.5 * element.rest_length);
            }
        }
        self.elements.change(e, |element| element.eroded = true);
        self.move_tip(s, left);
        let before = Segment {
            last_node: left,
            ..segment
        };
        let after = Segment {
            first_node: left + 1,
            ..segment
        };
        // A node without an element has no mass left and goes too.
        let is_last = s + 1 == self.segments.len();
        let kept: Vec<Segment> = [before, after]
            .into_iter()
            .filter(|piece| !piece.elements().is_empty())
            .collect();
        match kept.len() {
            2 => self.interfaces.insert(s, Interface::OPEN),
            1 => {
                // The contact on the side of the lost node is open now.
                let lost_front = before.elements().is_empty();
                let contact = if lost_front {
                    s.checked_sub(1)
                } else {
                    Some(s)
                };
                if let Some(contact) = contact.filter(|&c| c < self.interfaces.len()) {
                    self.interfaces[contact] = Interface::OPEN;
                }
                if !lost_front && is_last {
                    self.end = BoundaryCondition::Free;
                }
            }
            _ => {
                // The whole segment is gone: its two contacts become one, open.
                if is_last {
                    self.interfaces.pop();
                    self.end = BoundaryCondition::Free;
                } else {
                    self.interfaces.remove(s);
                    if s > 0 {
                        self.interfaces[s - 1] = Interface::OPEN;
                    }
                }
            }
        }
        self.segments.splice(s..=s, kept);
        self.release_face();
        if self.tip_friction > 0.0
            && let Some(tip) = self.segments.last()
        {
            self.nodes.friction[tip.last_node] = self.tip_friction;
        }
    }
}
