//! The pieces of the chain that nothing holds.

use super::{
    part::Role,
    state::{BoundaryCondition, Segment, State},
};
use crate::fragments::Fragment;

impl State {
    /// Free pieces from the projectile's tail to the back. What a bond still joins is one piece; what an end of the chain or a shear
    /// band holds is none.
    pub(super) fn fragments(&self) -> Vec<Fragment> {
        let mut pieces: Vec<Vec<Segment>> = Vec::new();
        for (s, &segment) in self.segments.iter().enumerate() {
            let joined = s > 0 && self.interfaces[s - 1].bond.holds() > 0.0;
            match pieces.last_mut().filter(|_| joined) {
                Some(piece) => piece.push(segment),
                None => pieces.push(vec![segment]),
            }
        }
        if self.end != BoundaryCondition::Free {
            pieces.pop();
        }
        let is_held = |segment: &Segment| {
            let nodes = segment.first_node..=segment.last_node;
            let hold = self.hold.as_ref();
            hold.is_some_and(|hold| hold.bands.hold_among(nodes))
        };
        let free = pieces.iter().filter(|piece| !piece.iter().any(is_held));
        free.map(|piece| self.fragment(piece)).collect()
    }

    fn fragment(&self, piece: &[Segment]) -> Fragment {
        let (mut mass, mut momentum, mut moment) = (0.0, 0.0, 0.0);
        let (mut length, mut diameter) = (0.0, 0.0_f64);
        let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
        for segment in piece {
            for i in segment.first_node..=segment.last_node {
                let node = self.nodes.at(i);
                let own = node.mass - self.tip_mass_on(i);
                mass += own;
                momentum += own * node.velocity;
                moment += own * node.position;
            }
            let part = &self.parts[segment.part];
            for element in self.elements.iter(segment.elements()) {
                length += part.length_at(element.rest_length, element.plastic.axial);
                diameter = diameter.max(part.diameter_at(element.plastic.axial));
                let half = 0.5 * element.rest_length;
                from = from.min(element.initial_position - half);
                to = to.max(element.initial_position + half);
            }
        }
        Fragment {
            origin: self.origin(piece),
            initial_from: from,
            initial_to: to,
            mass,
            velocity: momentum / mass,
            length,
            diameter,
            position: moment / mass,
        }
    }

    fn origin(&self, piece: &[Segment]) -> String {
        let (first, last) = (piece[0].part, piece[piece.len() - 1].part);
        let layers = self.parts.len() - 1;
        if self.parts[first].role == Role::Projectile {
            "projectile".to_owned()
        } else if layers == 1 {
            "target".to_owned()
        } else if first == last {
            format!("layer {first}")
        } else {
            format!("layers {first} to {last}")
        }
    }
}
