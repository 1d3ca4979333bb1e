//! Stresses of particles, and fields for pictures and files.

use super::{body::Body, lattice::ROW, run::PlaneImpact, shape::Shape};
use crate::{
    history::ElementState,
    solver::{Particle, frames::Bond},
};

/// Points from the axis of a rigid projectile to its side.
const COLUMNS: u32 = 10;

/// Stress in the plane `[xx, zz, xz]` of a particle [Pa], tension positive: the mean over its volume by the virial of its bonds.
pub(super) fn stress(body: &Body, row: usize, place: usize) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for bond in body.bonds_of(row, place).into_iter().flatten() {
        add_bond(body, bond, &mut sum);
    }
    let inside = body.lattice.spacing * body.lattice.spacing * ROW;
    let volume = inside * body.rows[row].mass[place] / body.lattice.mass;
    sum.map(|part| part / volume)
}

/// Half of a bond's force times its vector.
fn add_bond(body: &Body, (row, place, kind): (usize, usize, usize), sum: &mut [f64; 3]) {
    if body.rows[row].weights[kind][place] == 0.0 {
        return;
    }
    let [x, z] = body.bond_of(row, place, kind).force;
    let (other_row, other) = body.other_end(row, place, kind);
    let (from, to) = (body.position(row, place), body.position(other_row, other));
    let [across, along] = [to[0] - from[0], to[1] - from[1]];
    sum[0] += 0.5 * x * across;
    sum[1] += 0.5 * z * along;
    sum[2] += 0.25 * (x * along + z * across);
}

/// Largest principal stress of the plane [Pa].
pub(super) fn largest_tension([xx, zz, xz]: [f64; 3]) -> f64 {
    let half = 0.5 * (xx - zz);
    0.5 * (xx + zz) + (half * half + xz * xz).sqrt()
}

/// All particles of a body.
pub(super) fn whole(body: &Body) -> Vec<Particle> {
    body.particles()
        .map(|(row, place)| particle(body, row, place))
        .collect()
}

/// All bonds of a body, whose particles are counted from a number on.
pub(super) fn bonds(body: &Body, first: usize) -> Vec<Bond> {
    let mut numbers = vec![0; body.rows.len() * body.stride];
    for (number, (row, place)) in body.particles().enumerate() {
        numbers[row * body.stride + place] = (first + number) as u32;
    }
    let of = |bond: (usize, usize, usize)| {
        let damage = body.softening.map_or(0.0, |law| {
            let damage = body.damage_of(bond);
            1.0 - law.integrity(damage.worst, damage.start)
        });
        let ends = body.ends(bond);
        Bond {
            ends: ends.map(|(row, place)| numbers[row * body.stride + place]),
            damage: damage as f32,
        }
    };
    body.bonds().map(of).collect()
}

fn particle(body: &Body, row: usize, place: usize) -> Particle {
    let [xx, zz, xz] = stress(body, row, place);
    let across = body.lattice.out_of_plane * (xx + zz);
    let pressure = -(xx + zz + across) / 3.0;
    let spacing = body.lattice.spacing;
    let mass = body.rows[row].mass[place];
    let motion = &body.motion[row];
    Particle {
        position: body.position(row, place),
        velocity: [motion.x[place], motion.z[place]],
        deviator: [xx + pressure, zz + pressure, xz],
        pressure,
        mass,
        volume: mass / body.lattice.mass * ROW * spacing * spacing,
        sides: [spacing, ROW * spacing],
        damage: body.damage(row, place),
        ..Particle::default()
    }
}

/// Points that fill a rigid projectile as far as a distance behind its tip [m], which show where it is.
pub(super) fn rigid(run: &PlaneImpact<'_>, shape: &Shape, room: f64) -> Vec<Particle> {
    let length = shape.length.min(room);
    let size = shape.radius / f64::from(COLUMNS);
    let mut points = Vec::new();
    let rows = (length / size).ceil() as u32;
    for row in 0..rows {
        for column in 0..2 * COLUMNS {
            let at = [
                (f64::from(column) + 0.5) * size - shape.radius,
                -(f64::from(row) + 0.5) * size,
            ];
            if -at[1] < length && shape.penetration(at).is_some() {
                points.push(at);
            }
        }
    }
    let share = run.inertia.mass / points.len().max(1) as f64;
    let pose = run.pose();
    let of = |point: [f64; 2]| Particle {
        position: pose.place(point),
        velocity: run.state.flight.velocity_at(pose.place(point)),
        mass: share,
        volume: size * size,
        sides: [size, size],
        ..Particle::default()
    };
    points.into_iter().map(of).collect()
}

/// State of the particle nearest to the axis in every row.
pub(super) fn along_axis(body: &Body, part: usize) -> Vec<ElementState> {
    let rows = 0..body.rows.len();
    rows.map(|row| {
        let place = axis_place(body, row);
        let [_, z] = body.reference(row, place);
        let height = ROW * body.lattice.spacing;
        let [_, now] = body.position(row, place);
        let zz = stress(body, row, place)[1];
        ElementState {
            part,
            initial_position: z,
            position: now,
            length: height,
            stress: -zz,
            strain: -strain(body, row, place),
            plastic_strain: 0.0,
            diameter: body.width(),
            temperature: f64::NAN,
            velocity: body.motion[row].z[place],
        }
    })
    .collect()
}

/// Strain along the normal of the struck face, between the row before and the row behind.
fn strain(body: &Body, row: usize, place: usize) -> f64 {
    let first = row.saturating_sub(1);
    let last = (row + 1).min(body.rows.len() - 1);
    let of = |row: usize| {
        let place = if row == first || row == last {
            axis_place(body, row)
        } else {
            place
        };
        (body.reference(row, place)[1], body.state[row].z[place])
    };
    let ((z, u), (next_z, next_u)) = (of(first), of(last));
    (next_u - u) / (next_z - z)
}

/// Place of the particle of a row that is nearest to the axis.
pub(super) fn axis_place(body: &Body, row: usize) -> usize {
    let column = -body.origin[0] / body.lattice.spacing - 0.5 * (row % 2) as f64;
    1 + column.round().max(0.0) as usize
}

impl Body {
    /// Mean width across the direction of impact [m].
    pub(super) fn width(&self) -> f64 {
        let layers = self.rows.len() as f64 - 1.0;
        self.area / (layers * ROW * self.lattice.spacing)
    }
}
