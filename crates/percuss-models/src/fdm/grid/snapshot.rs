//! Snapshot of a grid for histories and results.

use super::{BoundaryCondition, Cells, Grid, Law, View};
use crate::history::{ElementState, Profile, Sample};

impl<L: Law> Grid<L> {
    /// The last segment of the projectile.
    pub(in crate::fdm) fn tip_segment(&self) -> usize {
        let last = self.segments.iter().rposition(|segment| segment.body == 0);
        last.unwrap_or(0)
    }

    /// Whether the projectile touches the target, a wall, or what presses on its face.
    pub(in crate::fdm) fn touches(&self) -> bool {
        self.tip_pressure > 0.0 || self.closed.get(self.tip_segment()) == Some(&true)
    }

    /// Node of the crater floor; `None` where there is no target.
    pub(in crate::fdm) fn floor(&self) -> Option<usize> {
        let tip = self.tip_segment();
        self.segments.get(tip + 1).map(|_| self.span(tip + 1).0)
    }

    /// Depth of the crater floor below the original face [m]; of the projectile's tip where there is no target to crater.
    ///
    /// A non-reflecting end has no static stiffness: the column that it holds drifts as a whole, and that drift is no crater.
    pub(in crate::fdm) fn depth(&self) -> f64 {
        match (self.floor(), self.ends[1]) {
            (Some(floor), BoundaryCondition::Dashpot(_)) => {
                let last = self.nodes.last().unwrap_or_default();
                self.nodes.position[floor] - (last.position - self.back_position)
            }
            (Some(floor), _) => self.nodes.position[floor],
            (None, _) => self.nodes.position[self.span(self.tip_segment()).1],
        }
    }

    pub(in crate::fdm) fn sample(&self) -> Sample {
        let tip_segment = self.tip_segment();
        let tip = self.nodes.at(self.span(tip_segment).1);
        let tail = self.nodes.at(0);
        let length: f64 = (0..=tip_segment)
            .map(|s| {
                let (first, last) = self.span(s);
                self.nodes.position[last] - self.nodes.position[first]
            })
            .sum();
        let (mass, momentum) = self.motion(0);
        let mut sample = Sample::default();
        sample.time = self.time;
        sample.step = self.step;
        sample.tip_velocity = tip.velocity;
        sample.tail_velocity = tail.velocity;
        sample.interface_velocity = self
            .floor()
            .map_or(f64::NAN, |floor| self.nodes.velocity[floor]);
        sample.back_velocity = self
            .floor()
            .map_or(f64::NAN, |_| self.nodes.last().unwrap_or_default().velocity);
        sample.mean_velocity = momentum / mass;
        sample.tip_position = tip.position;
        sample.depth = self.depth();
        sample.projectile_length = length;
        sample.contact_force = self.contact_force;
        sample.back_force = self.back_force;
        sample.energy = self.energy();
        sample.momentum = self.momentum();
        sample
    }

    /// Elements along the axis, thinned out to about `most`.
    pub(in crate::fdm) fn profile(&self, most: usize) -> Profile {
        let stride = self.cells.count().div_ceil(most).max(1);
        let mut elements = Vec::with_capacity(self.cells.count() / stride + 1);
        for (s, segment) in self.segments.iter().enumerate() {
            for c in segment.cells.clone().step_by(stride) {
                let view = (self.cells).look(c, |cell| self.bodies[segment.body].view(cell));
                let (back, front) = (self.nodes.position[c + s], self.nodes.position[c + s + 1]);
                elements.push(ElementState {
                    part: segment.body,
                    initial_position: view.initial_position,
                    position: 0.5 * (back + front),
                    displacement: 0.5 * (back + front) - view.initial_position,
                    length: front - back,
                    stress: view.stress,
                    strain: view.strain,
                    plastic_strain: view.plastic_strain,
                    diameter: view.diameter,
                    temperature: view.temperature,
                    velocity: 0.5 * (self.nodes.velocity[c + s] + self.nodes.velocity[c + s + 1]),
                });
            }
        }
        Profile {
            time: self.time,
            elements,
        }
    }

    /// Views of the cells of one body.
    pub(in crate::fdm) fn views(&self, body: usize) -> impl Iterator<Item = View> + '_ {
        let own = self.segments.iter().filter(move |s| s.body == body);
        own.flat_map(move |segment| {
            let law = &self.bodies[body];
            let cells = segment.cells.clone();
            cells.map(move |c| self.cells.look(c, |cell| law.view(cell)))
        })
    }
}
