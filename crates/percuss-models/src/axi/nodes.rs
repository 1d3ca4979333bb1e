//! Rows of nodes: sums over the chunks of a body, and motion.

use super::{
    body::Chunk,
    boundary::{BoundaryConditions, Load},
    contact::pushed,
    field::{FORCE, Field, MASS, MOMENTUM, Node},
    mesh::Mesh,
};
use crate::lanes::{LANES, Lanes, lanes, settled};

/// Sums over a row of nodes.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct RowSums {
    /// Kinetic energy as it came from the particles, after a closed wall, and after forces and supports [J].
    pub(super) kinetic: [f64; 3],
    /// Power of the nodal forces on the velocities that came from the particles and on those after the step, together [W].
    pub(super) power: f64,
    /// Energy lost in contact with other bodies: its impulses times the mean velocities of the whole step [J].
    pub(super) contact: f64,
    /// Work on the supports: their impulses times the mean velocities of the whole step [J].
    pub(super) boundary: f64,
    /// Momentum given to wall and supports [N s].
    pub(super) impulse: f64,
    /// Part of it that the wall took.
    pub(super) wall: f64,
}

/// Adds up a row of nodes over the strips of all chunks, in their order, and folds the image in the axis onto its original.
pub(super) fn add_up(chunks: &[Chunk], row: isize, nodes: &mut [Node]) {
    nodes.fill(Node::default());
    for source in chunks.iter().filter_map(|chunk| chunk.strip.row(row)) {
        for (node, added) in nodes.iter_mut().zip(source) {
            for (entry, value) in node.iter_mut().zip(added.0) {
                *entry += value;
            }
        }
    }
    if nodes.len() > 2 {
        let image = nodes[0];
        for (k, value) in image.into_iter().enumerate() {
            let sign = if k == MOMENTUM || k == FORCE {
                -1.0
            } else {
                1.0
            };
            nodes[2][k] += sign * value;
        }
        nodes[0] = Node::default();
        for k in [MOMENTUM, FORCE] {
            nodes[1][k] = 0.0;
        }
    }
}

/// Moves a row of nodes by a step: their velocities after forces and supports, and what that adds to the accumulated.
pub(super) fn move_row(
    field: &Field,
    supports: &BoundaryConditions,
    row: isize,
    velocity: &mut [[f64; 4]],
    mesh: &Mesh,
    time_step: f64,
) -> RowSums {
    let mut sums = RowSums::default();
    velocity.fill([0.0; 4]);
    let free = supports.free_columns(row, velocity.len());
    pulp::Arch::new().dispatch(MoveFree {
        field,
        row,
        free: 1..free,
        velocity,
        time_step,
        sums: &mut sums,
    });
    for (column, velocity) in velocity.iter_mut().enumerate().skip(free.max(1)) {
        let place = (row, column);
        move_node(
            (field, supports),
            place,
            velocity,
            mesh,
            time_step,
            &mut sums,
        );
    }
    if velocity.len() > 2 {
        let [r, z, r_before, z_before] = velocity[2];
        velocity[0] = [-r, z, -r_before, z_before];
    }
    if !supports.wall {
        // What a smooth rear face takes is the support's, not a contact's.
        sums.boundary += sums.kinetic[0] - sums.kinetic[1];
        sums.kinetic[1] = sums.kinetic[0];
        sums.wall = 0.0;
    }
    sums
}

/// Moves one node.
fn move_node(
    (field, supports): (&Field, &BoundaryConditions),
    (row, column): (isize, usize),
    velocity: &mut [f64; 4],
    mesh: &Mesh,
    time_step: f64,
    sums: &mut RowSums,
) {
    let energy = |mass: f64, v: [f64; 2]| 0.5 * mass * (v[0] * v[0] + v[1] * v[1]);
    let raw = field.node(row, column);
    if raw[MASS] > 0.0 {
        let came = [raw[MOMENTUM] / raw[MASS], raw[MOMENTUM + 1] / raw[MASS]];
        sums.kinetic[0] += energy(raw[MASS], came);
        [velocity[2], velocity[3]] = came;
    }
    let pushed_raw = raw[MOMENTUM + 1] + time_step * raw[FORCE + 1] - field.taken(row, column)[1];
    let Some(Load { node, taken }) = supports.folded(field, row, column, time_step) else {
        // Behind a plane without motion across it stands the mirror image of what is in front of it.
        let (place, signs) = supports.original(row, column);
        let original = supports.folded(field, place.0, place.1, time_step);
        if let Some(load) = original.filter(|load| load.node[MASS] > 0.0) {
            let pushed = pushed(&load.node, load.taken, time_step);
            let [radial, axial] = supports.held(&load.node, pushed, place, mesh, time_step);
            [velocity[0], velocity[1]] = [signs[0] * radial, signs[1] * axial];
        }
        let impulse = pushed_raw - raw[MASS] * velocity[1];
        sums.impulse += impulse;
        sums.wall += impulse;
        return;
    };
    let mass = node[MASS];
    if mass <= 0.0 {
        return;
    }
    let before = [node[MOMENTUM] / mass, node[MOMENTUM + 1] / mass];
    let pushed = pushed(&node, taken, time_step);
    let held = supports.held(&node, pushed, (row, column), mesh, time_step);
    sums.kinetic[1] += energy(mass, before);
    sums.kinetic[2] += energy(mass, held);
    for k in 0..2 {
        let twice_mean = before[k] + held[k];
        sums.power += node[FORCE + k] * twice_mean;
        sums.contact += 0.5 * taken[k] * twice_mean;
        sums.boundary += 0.5 * mass * (pushed[k] - held[k]) * twice_mean;
    }
    sums.impulse += pushed_raw - raw[MASS] * held[1];
    sums.wall += pushed_raw - raw[MASS] * pushed[1];
    [velocity[0], velocity[1]] = held;
}

/// Moves the nodes of a row that no support reaches: what [`move_node`] does with them.
struct MoveFree<'a> {
    field: &'a Field,
    row: isize,
    free: std::ops::Range<usize>,
    velocity: &'a mut [[f64; 4]],
    time_step: f64,
    sums: &'a mut RowSums,
}

impl pulp::NullaryFnOnce for MoveFree<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Some(start) = self.field.index(self.row, 0) else {
            return;
        };
        let mut column = self.free.start;
        while column < self.free.end {
            let end = self.free.end.min(column + LANES);
            let own = start + column..start + end;
            let nodes = &self.field.nodes[own.clone()];
            let impulses = &self.field.impulse[own];
            let velocity = &mut self.velocity[column..end];
            if end - column == LANES {
                move_free(nodes, impulses, velocity, self.time_step, self.sums);
            } else {
                // Filled up with empty nodes.
                let (mut padded, mut idle) = ([Node::default(); LANES], [[0.0; 2]; LANES]);
                padded[..nodes.len()].copy_from_slice(nodes);
                idle[..nodes.len()].copy_from_slice(impulses);
                move_free(&padded, &idle, velocity, self.time_step, self.sums);
            }
            column = end;
        }
    }
}

/// Moves up to eight nodes beside each other, given with empty ones for the rest of eight.
#[inline(always)]
fn move_free(
    nodes: &[Node],
    impulses: &[[f64; 2]],
    velocity: &mut [[f64; 4]],
    time_step: f64,
    sums: &mut RowSums,
) {
    let (nodes, impulses) = (&nodes[..LANES], &impulses[..LANES]);
    let mass = settled(lanes(|l| nodes[l][MASS]));
    let r = Along::of(&mass, nodes, impulses, 0, time_step);
    let z = Along::of(&mass, nodes, impulses, 1, time_step);
    // Nodes without mass have a part in nothing.
    let energy = |r: Lanes, z: Lanes| {
        settled(lanes(|l| {
            let energy = 0.5 * mass[l] * (r[l] * r[l] + z[l] * z[l]);
            if mass[l] > 0.0 { energy } else { 0.0 }
        }))
    };
    let (before, held) = (energy(r.came, z.came), energy(r.after, z.after));
    for (l, velocity) in velocity.iter_mut().enumerate() {
        *velocity = [r.after[l], z.after[l], r.came[l], z.came[l]];
        sums.kinetic[0] += before[l];
        sums.kinetic[1] += before[l];
        sums.kinetic[2] += held[l];
        sums.power += r.power[l];
        sums.power += z.power[l];
        sums.contact += r.contact[l];
        sums.contact += z.contact[l];
        sums.impulse += z.impulse[l];
        sums.wall += z.impulse[l];
    }
}

/// Motion of nodes along one direction.
struct Along {
    /// Velocity as it came from the particles, and after forces and contact [m/s].
    came: Lanes,
    after: Lanes,
    power: Lanes,
    contact: Lanes,
    impulse: Lanes,
}

impl Along {
    #[inline(always)]
    fn of(mass: &Lanes, nodes: &[Node], impulses: &[[f64; 2]], k: usize, time_step: f64) -> Self {
        let mass = *mass;
        let momentum = settled(lanes(|l| nodes[l][MOMENTUM + k]));
        let force = settled(lanes(|l| nodes[l][FORCE + k]));
        let taken = settled(lanes(|l| impulses[l][k]));
        let present = |values: Lanes| lanes(|l| if mass[l] > 0.0 { values[l] } else { 0.0 });
        let came = present(lanes(|l| momentum[l] / mass[l]));
        let kicked = lanes(|l| momentum[l] + time_step * force[l]);
        let mut after = lanes(|l| kicked[l] / mass[l]);
        if taken != Lanes::all(0.0) {
            after = lanes(|l| after[l] - taken[l] / mass[l]);
        }
        let after = present(after);
        settled(Self {
            power: present(lanes(|l| force[l] * (came[l] + after[l]))),
            contact: present(lanes(|l| 0.5 * taken[l] * (came[l] + after[l]))),
            impulse: present(lanes(|l| kicked[l] - taken[l] - mass[l] * after[l])),
            came,
            after,
        })
    }
}
