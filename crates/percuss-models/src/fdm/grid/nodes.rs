//! Nodes, number by number: what a step does with all of them works on eight at a time.

use super::kick::dry_friction;

percuss_core::number_lists! {
    /// A node: everything that moves at one velocity.
    pub(in crate::fdm) Node,
    /// All nodes, back to front.
    Nodes {
        /// [m].
        position,
        /// [m/s].
        velocity,
        /// [kg].
        mass,
        /// Largest dry friction [N].
        friction,
        /// Velocity at the start of the step [m/s].
        before,
        /// Force of the cells [N].
        force,
        /// Impulse that friction took in this step [N s].
        lost_impulse,
        /// Jump of velocity at the end of the last step, not yet accounted for to the end [m/s].
        jump,
    }
}

impl Nodes {
    pub(in crate::fdm) fn len(&self) -> usize {
        self.position.len()
    }

    pub(in crate::fdm) fn last(&self) -> Option<Node> {
        self.len().checked_sub(1).map(|last| self.at(last))
    }

    pub(super) fn push(&mut self, node: Node) {
        self.insert(self.len(), node);
    }
}

/// Lengths of cells after a time, and speeds at which their faces approach.
pub(super) struct Measure<'a> {
    pub(super) positions: &'a [f64],
    pub(super) velocities: &'a [f64],
    pub(super) lead: f64,
    pub(super) lengths: &'a mut [f64],
    pub(super) approaches: &'a mut [f64],
}

impl pulp::NullaryFnOnce for Measure<'_> {
    /// Whether every cell has a length.
    type Output = bool;

    #[inline(always)]
    fn call(self) -> bool {
        let count = self.lengths.len();
        let (back, front) = (&self.positions[..count], &self.positions[1..=count]);
        let (from, to) = (&self.velocities[..count], &self.velocities[1..=count]);
        let (lengths, approaches) = (&mut self.lengths[..count], &mut self.approaches[..count]);
        let mut inverted = 0;
        for i in 0..count {
            let approach = from[i] - to[i];
            let length = front[i] - back[i] - approach * self.lead;
            (lengths[i], approaches[i]) = (length, approach);
            inverted |= u64::from(length.is_nan() | (length <= 0.0));
        }
        inverted == 0
    }
}

/// Forces of cells on the nodes of a segment.
pub(super) struct Collect<'a> {
    pub(super) of_cells: &'a [f64],
    pub(super) on_nodes: &'a mut [f64],
}

impl pulp::NullaryFnOnce for Collect<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let count = self.of_cells.len();
        self.on_nodes[0] = 0.0;
        self.on_nodes[1..].copy_from_slice(self.of_cells);
        let on_nodes = &mut self.on_nodes[..count];
        for (node, cell) in on_nodes.iter_mut().zip(self.of_cells) {
            *node -= cell;
        }
    }
}

/// New velocities of nodes that nothing but friction holds.
pub(super) struct Kick<'a> {
    pub(super) nodes: &'a mut Nodes,
    pub(super) range: std::ops::Range<usize>,
    pub(super) time_step: f64,
}

impl pulp::NullaryFnOnce for Kick<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self {
            nodes,
            range,
            time_step,
        } = self;
        let count = range.len();
        let force = &nodes.force[range.clone()][..count];
        let friction = &nodes.friction[range.clone()][..count];
        let mass = &nodes.mass[range.clone()][..count];
        let velocity = &mut nodes.velocity[range.clone()][..count];
        let lost_impulse = &mut nodes.lost_impulse[range][..count];
        for i in 0..count {
            let change = force[i] * time_step / mass[i];
            let limit = friction[i] * time_step / mass[i];
            let (after, taken) = dry_friction(velocity[i], change, limit);
            velocity[i] = after;
            lost_impulse[i] = taken * mass[i];
        }
    }
}

/// New positions of all nodes.
pub(super) struct Drift<'a> {
    pub(super) nodes: &'a mut Nodes,
    pub(super) time_step: f64,
}

impl pulp::NullaryFnOnce for Drift<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let count = self.nodes.position.len();
        let position = &mut self.nodes.position[..count];
        let before = &self.nodes.before[..count];
        let velocity = &self.nodes.velocity[..count];
        for i in 0..count {
            let mean = 0.5 * (before[i] + velocity[i]);
            position[i] += mean * self.time_step;
        }
    }
}
