//! Contact of bodies where their nodes meet.

use super::{
    body::Body,
    field::{FORCE, Field, MASS, MOMENTUM, Node, VOLUME},
    mesh::Mesh,
    surface::Surface,
};

/// How bodies meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Contact {
    /// They move as one where both reach a node.
    Sticking,
    /// They press, slide and part; the coefficient is Coulomb's.
    Frictional(f64),
}

/// Part of a node's cell that bodies must reach into together to touch: less is a gap.
const TOUCHING: f64 = 0.9;

/// Least part of the cells behind an edge that its body is taken to fill: a straight edge on a column of nodes fills half.
const EDGE: f64 = 0.4;

/// Contact of all bodies: impulses that each takes from the others at its nodes in a step, before the boundary conditions. The first body may
/// have a surface that is followed. Returns the axial impulse from the first body on the others [N s].
pub(super) fn exchange_contact_impulses(
    contact: Contact,
    bodies: &mut [Body],
    surface: Option<&Surface>,
    mesh: &Mesh,
    time_step: f64,
) -> f64 {
    let coefficient = match contact {
        Contact::Sticking => return stick(bodies, time_step),
        Contact::Frictional(coefficient) => coefficient,
    };
    let mut passed = 0.0;
    for second in 1..bodies.len() {
        let (before, after) = bodies.split_at_mut(second);
        for (index, first) in before.iter_mut().enumerate() {
            let (first, second) = (&mut first.field, &mut after[0].field);
            let impulse = match surface.filter(|_| index == 0) {
                Some(surface) => surface.press(coefficient, first, second, mesh, time_step),
                None => press(coefficient, first, second, mesh, time_step),
            };
            if index == 0 {
                passed += impulse;
            }
        }
    }
    passed
}

/// A body at a node.
struct Meeting {
    body: usize,
    node: usize,
    mass: f64,
    velocity: [f64; 2],
}

/// Bodies that meet at a node get one velocity, that of their common mass. Pair by pair the third would take the second from the first again,
/// and the impulses would do work.
fn stick(bodies: &mut [Body], time_step: f64) -> f64 {
    let mut passed = 0.0;
    let mut here: Vec<Meeting> = Vec::with_capacity(bodies.len());
    for first in 0..bodies.len() {
        let field = &bodies[first].field;
        let (rows, columns) = (
            field.first_row..field.first_row + field.rows as isize,
            field.columns,
        );
        for (row, column) in rows.flat_map(|row| (1..columns).map(move |column| (row, column))) {
            let meeting = |body: usize| {
                let field = &bodies[body].field;
                let node = field.index(row, column)?;
                let mass = field.nodes[node][MASS];
                (mass > 0.0).then(|| Meeting {
                    body,
                    node,
                    mass,
                    velocity: field.pushed(node, time_step),
                })
            };
            // A node is met once, with the first of its bodies.
            if (0..first).any(|body| meeting(body).is_some()) {
                continue;
            }
            here.clear();
            here.extend((first..bodies.len()).filter_map(meeting));
            let Some((last, others)) = here.split_last() else {
                continue;
            };
            if others.is_empty() || others[0].body != first {
                continue;
            }
            let mass: f64 = here.iter().map(|one| one.mass).sum();
            let common = [0, 1].map(|k| {
                let momentum = here.iter().map(|one| one.mass * one.velocity[k]);
                momentum.sum::<f64>() / mass
            });
            // The last one takes what the others gave: momentum is kept to rounding.
            let mut given = [0.0; 2];
            for one in others {
                for k in [0, 1] {
                    let part = one.mass * (one.velocity[k] - common[k]);
                    bodies[one.body].field.impulse[one.node][k] += part;
                    given[k] += part;
                }
                if one.body == 0 {
                    passed += one.mass * (one.velocity[1] - common[1]);
                }
            }
            for k in [0, 1] {
                bodies[last.body].field.impulse[last.node][k] -= given[k];
            }
        }
    }
    passed
}

/// Contact of two bodies: impulses of each node of the first on that of the second in a step. Returns the axial impulse from the first on
/// the second [N s].
fn press(
    coefficient: f64,
    first: &mut Field,
    second: &mut Field,
    mesh: &Mesh,
    time_step: f64,
) -> f64 {
    let mut passed = 0.0;
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
            // A third body may have met one of the two already.
            let (v_a, v_b) = (first.pushed(a, time_step), second.pushed(b, time_step));
            let reduced = mass_a * mass_b / (mass_a + mass_b);
            let closing = [v_a[0] - v_b[0], v_a[1] - v_b[1]];
            let Some(normal) = normal(first, second, row, column, mesh) else {
                continue;
            };
            let backward = normal.map(|part| -part);
            let reached = reach(first, row, column, backward, mesh)
                + reach(second, row, column, normal, mesh);
            if reached < TOUCHING {
                continue;
            }
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
            let impulse = [0, 1].map(|k| reduced * (approach * normal[k] + grip * slide[k]));
            for (k, part) in impulse.into_iter().enumerate() {
                first.impulse[a][k] += part;
                second.impulse[b][k] -= part;
            }
            passed += impulse[1];
        }
    }
    passed
}

/// Part of a node's cell that a body fills; column 0 is the mirror image of column 2.
fn filling(field: &Field, row: isize, column: usize, mesh: &Mesh) -> f64 {
    let column = if column == 0 { 2 } else { column };
    field.node(row, column)[VOLUME] / mesh.full_volume(row, column)
}

/// How far a body reaches into a node's cell from its own side, which lies `inward`, as a part of the cell. At its edge a body fills less of the
/// cells behind, too: there it reaches as far as its face does.
fn reach(field: &Field, row: isize, column: usize, inward: [f64; 2], mesh: &Mesh) -> f64 {
    let [across, along] = inward.map(|part| part.round() as isize);
    let here = filling(field, row, column, mesh);
    let behind = filling(
        field,
        row + along,
        column.saturating_add_signed(across),
        mesh,
    );
    here / behind.max(here).clamp(EDGE, 1.0)
}

/// Unit normal from the first body into the second: down the first's and up the second's filling. The steeper one counts more: where an edge
/// meets a face, the normal is that of the face.
fn normal(
    first: &Field,
    second: &Field,
    row: isize,
    column: usize,
    mesh: &Mesh,
) -> Option<[f64; 2]> {
    let gradient = |field: &Field| {
        let filling = |row, column| filling(field, row, column, mesh);
        let radial = if column == 1 {
            0.0
        } else {
            (filling(row, column + 1) - filling(row, column - 1)) / mesh.column_stretch(column)
        };
        let axial = (filling(row + 1, column) - filling(row - 1, column)) / mesh.row_stretch(row);
        [radial, axial]
    };
    let weighted = |field: &Field| {
        let gradient = gradient(field);
        // With a second power the edge of a ring that slides along another one digs in: the heat is 6 % more than its friction can give.
        let weight = (gradient[0] * gradient[0] + gradient[1] * gradient[1]).powi(2);
        gradient.map(|part| weight * part)
    };
    let (a, b) = (weighted(first), weighted(second));
    let [radial, axial] = [b[0] - a[0], b[1] - a[1]];
    let size = radial.hypot(axial);
    (size > 0.0).then(|| [radial / size, axial / size])
}

impl Field {
    /// Velocity of a node after its forces and the contacts that are known [m/s].
    pub(super) fn pushed(&self, index: usize, time_step: f64) -> [f64; 2] {
        pushed(&self.nodes[index], self.impulse[index], time_step)
    }
}

/// Velocity of a node after its forces and what contact takes from it [m/s].
pub(super) fn pushed(node: &Node, taken: [f64; 2], time_step: f64) -> [f64; 2] {
    [0, 1].map(|k| {
        let free = (node[MOMENTUM + k] + time_step * node[FORCE + k]) / node[MASS];
        free - taken[k] / node[MASS]
    })
}
