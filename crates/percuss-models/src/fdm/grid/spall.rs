//! Spall: a body that is pulled harder than it can hold splits at a node.

use serde::{Deserialize, Serialize};

use super::{Cells, Grid, Law, Segment};

/// A place where a body split.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(in crate::fdm) struct Spall {
    /// Body that split: 0 is the projectile.
    pub(in crate::fdm) body: usize,
    /// Initial position of the node [m].
    pub(in crate::fdm) position: f64,
    /// [s].
    pub(in crate::fdm) time: f64,
}

impl<L: Law> Grid<L> {
    /// Splits every segment at the node that is pulled hardest, if it is pulled beyond the spall strength.
    ///
    /// The pull on a node is the mean of the axial stresses of its two cells. One node a segment and step: the free faces
    /// unload the neighbours before the next step.
    pub(super) fn split_spalls(&mut self) {
        let mut s = 0;
        while s < self.segments.len() {
            let segment = self.segments[s].clone();
            let law = &self.bodies[segment.body];
            if let Some(strength) = law.spall_strength() {
                let stress = |c: usize| self.cells.look(c, |cell| law.axial_stress(cell));
                let pull = |c: usize| -0.5 * (stress(c) + stress(c - 1));
                let inner = segment.cells.start + 1..segment.cells.end;
                let hardest = inner.max_by(|a, b| pull(*a).total_cmp(&pull(*b)));
                if let Some(cell) = hardest.filter(|cell| pull(*cell) > strength) {
                    self.split(s, cell);
                    s += 1;
                }
            }
            s += 1;
        }
    }

    /// Splits segment `s` in front of cell `cell`.
    fn split(&mut self, s: usize, cell: usize) {
        let Segment { body, cells } = self.segments[s].clone();
        let node = cell + s;
        let view = |c: usize| self.cells.look(c, |cell| self.bodies[body].view(cell));
        let initial = |c: usize| view(c).initial_position;
        let position = 0.5 * (initial(cell - 1) + initial(cell));
        self.spalls.push(Spall {
            body,
            position,
            time: self.time,
        });
        // Cells of one body are of one size, so the node's mass halves.
        self.nodes.mass[node] *= 0.5;
        self.nodes.friction[node] *= 0.5;
        self.nodes.insert(node + 1, self.nodes.at(node));
        self.segments[s].cells = cells.start..cell;
        self.segments.insert(
            s + 1,
            Segment {
                body,
                cells: cell..cells.end,
            },
        );
        self.closed.insert(s, false);
    }
}
