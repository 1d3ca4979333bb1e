//! Contact of a projectile with a nose: at points of its surface, which is followed.
//!
//! Normals of a nose from the filling of nodes never settle: they stay steps of a cell, and a smooth nose that slides without friction
//! would lose as much energy in contact on any grid. The surface knows its normals.

use super::{
    field::{Field, MASS, VOLUME},
    kernel::{Stencil, nearest},
    mesh::Mesh,
};

/// Distance of points at the start, and the one from which a point is put between two, in cells.
const SPACING: f64 = 0.5;
const SPLIT: f64 = 1.0;
/// Part of the space about a point that the other body fills where it touches: half of it, but for the roughness of particles.
const TOUCHING: f64 = 0.45;
/// Least part of the space behind a face that a body is taken to fill: a sheet thinner than a cell fills less.
const SHEET: f64 = 0.4;
/// Rounds over all points in a step: an impulse at one changes the velocities at its neighbours.
const ROUNDS: usize = 8;

/// Part of the time step of runs at nodes. With all of it the energy balance of 3 of 36 rods with noses (300 to 900 m/s, 4 cells) did not
/// close, with this of none.
pub(super) const STEP: f64 = 0.7;

/// Surface of the projectile, from the tip to the middle of its tail.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub(super) struct Surface {
    /// Radius and depth of its points [m].
    pub(super) points: Vec<[f64; 2]>,
}

/// A node that takes part in a place: its weight there, and the sign of its radial part, which is that of its image beyond the axis, and 0
/// on it.
#[derive(Debug, Clone, Copy)]
struct Part {
    node: usize,
    weight: f64,
    side: f64,
}

/// A place in the velocity field of a body: the mean of its nodes by weight and density. An impulse there goes to them in the same shares, so it
/// does as much work on the nodes as on the place.
#[derive(Debug, Clone)]
struct Place {
    parts: Vec<Part>,
    /// Change of the place's velocity by an impulse [1/kg].
    give: f64,
}

impl Place {
    /// The place; none where the body has no node with mass beside it.
    fn at(field: &Field, mesh: &Mesh, position: [f64; 2]) -> Option<Self> {
        let mut parts: Vec<Part> = around(field, mesh, position, linear).collect();
        let mass = |part: &Part| field.nodes[part.node][MASS];
        let density = |part: &Part| mass(part) / full_volume(field, mesh, part.node);
        let sum: f64 = parts.iter().map(|part| part.weight * density(part)).sum();
        if sum <= 0.0 {
            return None;
        }
        for part in &mut parts {
            part.weight *= density(part) / sum;
        }
        let give = parts.iter().map(|p| p.weight * p.weight / mass(p)).sum();
        Some(Self { parts, give })
    }

    /// Component of its velocity along a direction [m/s].
    fn speed(&self, field: &Field, along: [f64; 2], time_step: f64) -> f64 {
        let of = |part: &Part| {
            let [radial, axial] = field.pushed(part.node, time_step);
            part.weight * (part.side * radial * along[0] + axial * along[1])
        };
        self.parts.iter().map(of).sum()
    }

    /// Takes an impulse [N s] from the nodes.
    fn take(&self, field: &mut Field, impulse: [f64; 2]) {
        for part in &self.parts {
            field.impulse[part.node][0] += part.weight * part.side * impulse[0];
            field.impulse[part.node][1] += part.weight * impulse[1];
        }
    }
}

/// Weights of two nodes in proportion to the distance of the other.
fn linear(place: f64) -> (isize, [f64; 3]) {
    let first = place.floor();
    let part = place - first;
    (first as isize, [1.0 - part, part, 0.0])
}

/// Weights of three nodes, as particles have them.
fn quadratic(place: f64) -> (isize, [f64; 3]) {
    let stencil = Stencil::at(place);
    (stencil.first, stencil.weights)
}

/// Nodes with mass about a position.
fn around(
    field: &Field,
    mesh: &Mesh,
    [radius, depth]: [f64; 2],
    weights: impl Fn(f64) -> (isize, [f64; 3]),
) -> impl Iterator<Item = Part> {
    let (column, radial) = weights(mesh.radial.index(radius));
    let (row, axial) = weights(mesh.axial.index(depth));
    let pairs = (0..3).flat_map(|i| (0..3).map(move |j| (i, j)));
    pairs.filter_map(move |(i, j)| {
        // Columns are counted with the mirrored one, beyond the axis.
        let (column, side) = match column + 1 + j as isize {
            0 => (2, -1.0),
            1 => (1, 0.0),
            column => (usize::try_from(column).ok()?, 1.0),
        };
        let node = field.index(row + i as isize, column)?;
        let weight = radial[j] * axial[i];
        (weight > 0.0 && field.nodes[node][MASS] > 0.0).then_some(Part { node, weight, side })
    })
}

/// Volume of a node's cell [m3].
fn full_volume(field: &Field, mesh: &Mesh, node: usize) -> f64 {
    let row = field.first_row + (node / field.columns) as isize;
    mesh.full_volume(row, node % field.columns)
}

/// Part of the space about a position that a body fills.
fn filling(field: &Field, mesh: &Mesh, position: [f64; 2]) -> f64 {
    let part = |part: Part| {
        part.weight * field.nodes[part.node][VOLUME] / full_volume(field, mesh, part.node)
    };
    around(field, mesh, position, linear).map(part).sum()
}

/// A point of the surface that touches another body.
struct Touch {
    own: Place,
    other: Place,
    /// Out of the projectile, and along its surface.
    normal: [f64; 2],
    tangent: [f64; 2],
    /// Impulses so far in this step along both [N s].
    pressed: f64,
    rubbed: f64,
}

impl Surface {
    /// The surface of a body of revolution before its tip reaches depth 0, from its radius at a distance behind the tip.
    pub(super) fn new(radius_at: impl Fn(f64) -> f64, length: f64, cell: f64) -> Self {
        let spacing = SPACING * cell;
        // Finely first, then no closer than they need to be.
        let count = (16.0 * length / spacing).ceil();
        let mut points = vec![[0.0, 0.0]];
        for k in 1..=count as usize {
            let behind = length * k as f64 / count;
            let point = [radius_at(behind), -behind];
            if points
                .last()
                .is_some_and(|last| distance(*last, point) >= spacing)
            {
                points.push(point);
            }
        }
        let tail = radius_at(length);
        if points
            .last()
            .is_some_and(|last| distance(*last, [tail, -length]) < 0.5 * spacing)
        {
            points.pop();
        }
        let across = (tail / spacing).ceil();
        points.extend((0..=across as usize).map(|k| [tail * (1.0 - k as f64 / across), -length]));
        Self { points }
    }

    /// Contact with a body: impulses that the nodes take from each other in a step. Returns the axial impulse from the first on the
    /// second [N s].
    pub(super) fn press(
        &self,
        coefficient: f64,
        first: &mut Field,
        second: &mut Field,
        mesh: &Mesh,
        time_step: f64,
    ) -> f64 {
        let mut touches: Vec<Touch> = (self.points.windows(2))
            .filter_map(|ends| touch(first, second, mesh, [ends[0], ends[1]]))
            .collect();
        for _ in 0..ROUNDS {
            for touch in &mut touches {
                touch.push(coefficient, first, second, time_step);
            }
        }
        let axial = |t: &Touch| t.pressed * t.normal[1] + t.rubbed * t.tangent[1];
        touches.iter().map(axial).sum()
    }

    /// Moves the points by a step, as the nodes move.
    pub(super) fn follow(&mut self, field: &Field, mesh: &Mesh, time_step: f64) {
        let mut velocity = [0.0; 2];
        for point in &mut self.points {
            let (mut sum, mut mean) = (0.0, [0.0; 2]);
            for part in around(field, mesh, *point, quadratic) {
                let [radial, axial, ..] = field.velocity[part.node];
                sum += part.weight;
                mean[0] += part.weight * part.side * radial;
                mean[1] += part.weight * axial;
            }
            // A tip without particles goes with what is next to it.
            if sum > 0.0 {
                velocity = mean.map(|part| part / sum);
            }
            point[0] = (point[0] + time_step * velocity[0]).max(0.0);
            point[1] += time_step * velocity[1];
        }
        let far = |ends: &[[f64; 2]]| distance(ends[0], ends[1]) > SPLIT * mesh.cell;
        if self.points.windows(2).any(far) {
            let mut finer = Vec::with_capacity(2 * self.points.len());
            for ends in self.points.windows(2) {
                finer.push(ends[0]);
                if far(ends) {
                    finer.push([0, 1].map(|k| 0.5 * (ends[0][k] + ends[1][k])));
                }
            }
            finer.extend(self.points.last());
            self.points = finer;
        }
    }
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// The middle of a piece of the surface, where another body reaches it.
fn touch(first: &Field, second: &Field, mesh: &Mesh, ends: [[f64; 2]; 2]) -> Option<Touch> {
    let [a, b] = ends;
    let length = distance(a, b);
    let position = [0, 1].map(|k| 0.5 * (a[k] + b[k]));
    let (row, _) = nearest(mesh.axial.index(position[1]));
    let reached = second.first_row as f64..(second.first_row + second.rows as isize) as f64;
    if length <= 0.0 || !reached.contains(&row) {
        return None;
    }
    let tangent = [0, 1].map(|k| (b[k] - a[k]) / length);
    let normal = [-tangent[1], tangent[0]];
    let here = filling(second, mesh, position);
    let cell = mesh.cell;
    let inside = [
        (position[0] + cell * normal[0]).abs(),
        position[1] + cell * normal[1],
    ];
    let behind = filling(second, mesh, inside).max(here).clamp(SHEET, 1.0);
    if here < TOUCHING * behind {
        return None;
    }
    Some(Touch {
        own: Place::at(first, mesh, position)?,
        other: Place::at(second, mesh, position)?,
        normal,
        tangent,
        pressed: 0.0,
        rubbed: 0.0,
    })
}

impl Touch {
    /// Takes away what is left of the approach, and of the slide as far as friction goes.
    fn push(&mut self, coefficient: f64, first: &mut Field, second: &mut Field, time_step: f64) {
        let give = self.own.give + self.other.give;
        let approach = self.closing(first, second, self.normal, time_step);
        let pressed = (self.pressed + approach / give).max(0.0);
        self.pass(first, second, self.normal, pressed - self.pressed);
        self.pressed = pressed;
        if coefficient > 0.0 {
            let slide = self.closing(first, second, self.tangent, time_step);
            let most = coefficient * pressed;
            let rubbed = (self.rubbed + slide / give).clamp(-most, most);
            self.pass(first, second, self.tangent, rubbed - self.rubbed);
            self.rubbed = rubbed;
        }
    }

    fn closing(&self, first: &Field, second: &Field, along: [f64; 2], time_step: f64) -> f64 {
        self.own.speed(first, along, time_step) - self.other.speed(second, along, time_step)
    }

    fn pass(&self, first: &mut Field, second: &mut Field, along: [f64; 2], impulse: f64) {
        if impulse != 0.0 {
            self.own.take(first, along.map(|part| impulse * part));
            self.other.take(second, along.map(|part| -impulse * part));
        }
    }
}
