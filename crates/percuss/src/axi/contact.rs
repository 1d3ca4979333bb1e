//! Contact of bodies where their nodes meet.

use super::field::{FORCE, Field, MASS, MOMENTUM, Node, VOLUME, full_volume};

/// How bodies meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Contact {
    /// They move as one where both reach a node.
    Sticking,
    /// They press, slide and part; the coefficient is Coulomb's.
    Frictional(f64),
}

/// Part of a node's cell that bodies must fill together to touch: less is a gap.
const TOUCHING: f64 = 0.9;

/// What contact did in a step.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Touch {
    /// Energy lost: the contact's impulses times the mean velocities of the whole step [J].
    pub(super) loss: f64,
    /// Fall of the nodes' kinetic energy [J].
    pub(super) fall: f64,
    /// Change of the power of the nodal forces [W].
    pub(super) power: f64,
    /// Axial impulse from the first body on the second [N s].
    pub(super) impulse: f64,
}

/// Lets two bodies meet: changes the velocities of nodes that both reach.
pub(super) fn meet(contact: Contact, first: &mut Field, second: &mut Field, cell: f64) -> Touch {
    let mut touch = Touch::default();
    let from = first.first_row.max(second.first_row);
    let to = (first.first_row + first.rows as isize).min(second.first_row + second.rows as isize);
    for row in from..to {
        for column in 1..first.columns.min(second.columns) {
            let (Some(a), Some(b)) = (first.index(row, column), second.index(row, column)) else {
                continue;
            };
            let (mass_a, mass_b) = (first.nodes[a][MASS], second.nodes[b][MASS]);
            if mass_a <= 0.0 || mass_b <= 0.0 {
                continue;
            }
            let (v_a, v_b) = (first.velocity[a], second.velocity[b]);
            let reduced = mass_a * mass_b / (mass_a + mass_b);
            let closing = [v_a[0] - v_b[0], v_a[1] - v_b[1]];
            let impulse = match contact {
                Contact::Sticking => [reduced * closing[0], reduced * closing[1]],
                Contact::Frictional(coefficient) => {
                    let filled = (first.nodes[a][VOLUME] + second.nodes[b][VOLUME])
                        / (2.0 * std::f64::consts::PI * cell.powi(3) * full_volume(column));
                    if filled < TOUCHING {
                        continue;
                    }
                    let Some(normal) = normal(first, second, row, column) else {
                        continue;
                    };
                    let approach = closing[0] * normal[0] + closing[1] * normal[1];
                    if approach <= 0.0 {
                        continue;
                    }
                    let slide = [
                        closing[0] - approach * normal[0],
                        closing[1] - approach * normal[1],
                    ];
                    let speed = slide[0].hypot(slide[1]);
                    let grip = if speed > 0.0 {
                        (coefficient * approach / speed).min(1.0)
                    } else {
                        0.0
                    };
                    [0, 1].map(|k| reduced * (approach * normal[k] + grip * slide[k]))
                }
            };
            let energy = |v: [f64; 2], mass: f64| 0.5 * mass * (v[0] * v[0] + v[1] * v[1]);
            let before = energy(v_a, mass_a) + energy(v_b, mass_b);
            let mut new_a = [0, 1].map(|k| v_a[k] - impulse[k] / mass_a);
            let mut new_b = [0, 1].map(|k| v_b[k] + impulse[k] / mass_b);
            if column == 1 {
                new_a[0] = 0.0;
                new_b[0] = 0.0;
            }
            touch.fall += before - energy(new_a, mass_a) - energy(new_b, mass_b);
            let start = |node: &Node, mass: f64| [0, 1].map(|k| node[MOMENTUM + k] / mass);
            let (old_a, old_b) = (
                start(&first.nodes[a], mass_a),
                start(&second.nodes[b], mass_b),
            );
            for k in 0..2 {
                touch.loss += 0.5
                    * (mass_a * (v_a[k] - new_a[k]) * (old_a[k] + new_a[k])
                        + mass_b * (v_b[k] - new_b[k]) * (old_b[k] + new_b[k]));
            }
            for k in 0..2 {
                touch.power += first.nodes[a][FORCE + k] * (new_a[k] - v_a[k])
                    + second.nodes[b][FORCE + k] * (new_b[k] - v_b[k]);
            }
            touch.impulse += impulse[1];
            first.set_velocity(a, column, new_a);
            second.set_velocity(b, column, new_b);
        }
    }
    touch
}

impl Field {
    /// Sets the velocity of a node and of its image in the axis.
    pub(super) fn set_velocity(&mut self, index: usize, column: usize, velocity: [f64; 2]) {
        self.velocity[index] = velocity;
        if column == 2 {
            self.velocity[index - 2] = [-velocity[0], velocity[1]];
        }
    }
}

/// Unit normal from the first body into the second: down the first's and up the second's filling.
fn normal(first: &Field, second: &Field, row: isize, column: usize) -> Option<[f64; 2]> {
    let filling = |row: isize, column: usize| {
        // Column 0 is the mirror image of column 2.
        let column = if column == 0 { 2 } else { column };
        let difference = second.node(row, column)[VOLUME] - first.node(row, column)[VOLUME];
        difference / full_volume(column)
    };
    let radial = if column == 1 {
        0.0
    } else {
        filling(row, column + 1) - filling(row, column - 1)
    };
    let axial = filling(row + 1, column) - filling(row - 1, column);
    let size = radial.hypot(axial);
    (size > 0.0).then(|| [radial / size, axial / size])
}

/// Velocity of a node before contact and supports [m/s].
pub(super) fn free_velocity(node: &[f64; 6], time_step: f64) -> [f64; 2] {
    [0, 1].map(|k| (node[MOMENTUM + k] + time_step * node[FORCE + k]) / node[MASS])
}
