//! Stresses of particles, and fields for pictures and files.

use super::{
    body::Body,
    bonded::{At, Bonded},
    lattice::ROW,
    run::Impact,
    setup,
    shape::Rigid,
};
use crate::{
    history::ElementState,
    solver::{Particle, frames::Bond},
};

/// Points from the axis of a rigid projectile to its side.
const COLUMNS: u32 = 10;

/// Stress in the plane `[xx, zz, xz]` of a particle [Pa], tension positive: the mean over its volume by the virial of its bonds.
pub(super) fn stress(body: &Body, row: usize, place: usize) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for bond in body.bonds_of(row, place) {
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

/// All bonds of a body, whose particles are counted from a number on.
pub(super) fn bonds<const D: usize>(
    body: &impl Bonded<D>,
    first: u32,
) -> impl Iterator<Item = Bond> {
    let mut numbers = vec![0_u32; body.row_count() * body.row_places()];
    for (number, at) in body.particles().enumerate() {
        numbers[body.index(at)] = first + number as u32;
    }
    let of = move |bond: (usize, usize, usize)| {
        let damage = body.softening().map_or(0.0, |law| {
            let damage = body.damage_of(bond);
            1.0 - law.integrity(damage.worst, damage.start)
        });
        Bond {
            ends: body.ends(bond).map(|end| numbers[body.index(end)]),
            damage: damage as f32,
        }
    };
    body.bonds().map(of)
}

/// State of the particle nearest to the axis in every row that has particles.
pub(super) fn along_axis<const D: usize>(body: &impl Bonded<D>, part: usize) -> Vec<ElementState> {
    (0..body.row_count())
        .filter_map(|row| body.nearest_to_axis(row))
        .map(|at| body.on_axis(at, part))
        .collect()
}

/// State of a particle on the axis.
pub(super) fn on_axis(body: &Body, (row, place): At, part: usize) -> ElementState {
    let zz = stress(body, row, place)[1];
    let [start, now] = [body.reference(row, place)[1], body.position(row, place)[1]];
    ElementState {
        part,
        initial_position: start,
        position: now,
        displacement: now - start,
        length: ROW * body.lattice.spacing,
        stress: -zz,
        strain: -axial_strain(body, (row, place)),
        plastic_strain: 0.0,
        diameter: body.width(),
        temperature: f64::NAN,
        velocity: body.motion[row].z[place],
    }
}

/// Strain along the normal of the struck face, between the row before and the row behind, where they have particles.
pub(super) fn axial_strain<const D: usize>(body: &impl Bonded<D>, here: At) -> f64 {
    let before = here.0.checked_sub(1);
    let behind = Some(here.0 + 1).filter(|&row| row < body.row_count());
    let [(z, now), (next_z, next)] = [before, behind].map(|row| {
        let end = row.and_then(|row| body.nearest_to_axis(row));
        let (row, place) = end.unwrap_or(here);
        let at = |position: [f64; D]| position[D - 1];
        (
            at(body.reference(row, place)),
            at(body.position(row, place)),
        )
    });
    (next - now) / (next_z - z) - 1.0
}

/// A particle with its stresses.
pub(super) fn particle(body: &Body, row: usize, place: usize) -> Particle {
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

/// Points that fill a rigid body of revolution, as rings, and what they have across the plane.
pub(super) fn round<B: Bonded<D>, const D: usize>(
    run: &Impact<'_, B, D>,
) -> (Vec<Particle>, Vec<[f64; 2]>) {
    let mut points = Vec::new();
    let mut across = Vec::new();
    let pose = run.pose();
    for point in rigid_points(run) {
        let [radius, z] = point.at;
        if radius < 0.0 {
            continue;
        }
        let count = (2.0 * std::f64::consts::PI * radius / point.size)
            .round()
            .max(1.0);
        for number in 0..count as u32 {
            let angle = 2.0 * std::f64::consts::PI * f64::from(number) / count;
            let place = pose.place([radius * angle.cos(), z]);
            points.push(Particle {
                position: place,
                velocity: run.state.flight.velocity_at(place),
                volume: point.size.powi(3),
                sides: [point.size, point.size],
                ..Particle::default()
            });
            across.push([radius * angle.sin(), 0.0]);
        }
    }
    let share = run.inertia.mass / points.len().max(1) as f64;
    for point in &mut points {
        point.mass = share;
    }
    (points, across)
}

/// A point of a rigid projectile in its own frame.
struct RigidPoint {
    at: [f64; 2],
    size: f64,
}

/// Points that fill a rigid projectile, which show where it is; of a long one only what a picture of the lattice has room for.
pub(super) fn rigid<B: Bonded<D>, const D: usize>(run: &Impact<'_, B, D>) -> Vec<Particle> {
    let points = rigid_points(run);
    let share = run.inertia.mass / points.len().max(1) as f64;
    let pose = run.pose();
    let of = |RigidPoint { at, size }: RigidPoint| Particle {
        position: pose.place(at),
        velocity: run.state.flight.velocity_at(pose.place(at)),
        mass: share,
        volume: size * size,
        sides: [size, size],
        ..Particle::default()
    };
    points.into_iter().map(of).collect()
}

/// A section of a rigid projectile as even points.
fn rigid_points<B: Bonded<D>, const D: usize>(run: &Impact<'_, B, D>) -> Vec<RigidPoint> {
    let Rigid::Projectile(shape) = run.rigid else {
        return Vec::new();
    };
    let extent = setup::extent(run.scenario);
    let length = shape.length.min(extent.length.max(extent.width));
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
                points.push(RigidPoint { at, size });
            }
        }
    }
    points
}

impl Body {
    /// Mean width across the direction of impact [m].
    pub(super) fn width(&self) -> f64 {
        let layers = self.rows.len() as f64 - 1.0;
        self.area / (layers * ROW * self.lattice.spacing)
    }
}
