//! Histories: what happens along the axis, as in one dimension.

use super::{
    body::Body,
    crater::{axis_velocity, ends},
    field::VOLUME,
    mesh::Mesh,
    solver::Grid,
};
use crate::history::{ElementState, Profile, Sample};

/// State at this time, with the depth of the crater floor below a face that has flown by `flight` [m].
pub(super) fn sample(solver: &Grid, depth: f64, flight: f64) -> Sample {
    let mesh = &solver.mesh;
    let rod = &solver.bodies[0];
    let sums = &solver.sums[0];
    let target = solver.bodies.get(1);
    // What is gone has no place and no speed.
    let (tail, tip) = ends(rod, mesh).unwrap_or((f64::NAN, f64::NAN));
    let mean_velocity = sums.momentum / sums.mass;
    let nodes = |body, place: f64| match place.is_nan() {
        true => f64::NAN,
        false => axis_velocity(body, place, mesh),
    };
    let floor = target.map_or(f64::NAN, |body| axis_velocity(body, depth + flight, mesh));
    // Nodes that hold the first step's contact already are not how bodies meet.
    let is_impact = solver.step == 0;
    let before = |value: f64, at_impact: f64| if is_impact { at_impact } else { value };
    let mut sample = Sample::default();
    sample.time = solver.time;
    sample.step = solver.step;
    sample.tip_velocity = before(nodes(rod, tip), mean_velocity);
    sample.tail_velocity = before(nodes(rod, tail), mean_velocity);
    sample.interface_velocity = before(floor, if target.is_some() { 0.0 } else { f64::NAN });
    sample.back_velocity = back_velocity(solver);
    sample.mean_velocity = mean_velocity;
    sample.tip_position = tip;
    sample.depth = depth;
    sample.projectile_length = if tip.is_nan() { 0.0 } else { tip - tail };
    sample.contact_force = before(solver.deferred.contact_force, 0.0);
    sample.back_force = before(solver.deferred.support_impulse / solver.time_step, 0.0);
    sample.energy = solver.energy();
    sample.momentum = solver.momentum();
    sample
}

/// Speed on the axis at the back of the last layer, if there is one [m/s].
fn back_velocity(solver: &Grid) -> f64 {
    let layer = solver.bodies[1..].last();
    let back = layer.and_then(|layer| Some((layer, ends(layer, &solver.mesh)?.1)));
    back.map_or(f64::NAN, |(layer, back)| {
        axis_velocity(layer, back, &solver.mesh)
    })
}

/// Means over the particles within a cell of the axis, a row of cells at a time; the diameter is that of a circle with the area of
/// the body's cross-section.
pub(super) fn profile(solver: &Grid) -> Profile {
    let elements = solver.bodies.iter().enumerate();
    Profile {
        time: solver.time,
        elements: elements
            .flat_map(|(part, body)| along_axis(part, body, &solver.mesh))
            .collect(),
    }
}

fn along_axis(part: usize, body: &Body, mesh: &Mesh) -> Vec<ElementState> {
    let Some((tail, tip)) = ends(body, mesh) else {
        return Vec::new();
    };
    let [first, last] = [tail, tip].map(|depth| mesh.indices([0.0, depth])[1]);
    let (first, last) = (first.floor() as isize, last.ceil() as isize);
    let rows = (last - first).max(0) as usize;
    let mut sums = vec![[0.0_f64; 7]; rows];
    for particle in body
        .particles()
        .filter(|p| p.mass > 0.0 && p.position[0] < mesh.cell)
    {
        let row = mesh.indices(particle.position)[1].floor() as isize - first;
        let Some(sum) = usize::try_from(row).ok().and_then(|row| sums.get_mut(row)) else {
            continue;
        };
        let mass = particle.mass;
        let stress = particle.pressure + particle.viscous_pressure - particle.deviator[1];
        let strain = -(particle.volume * body.law.density / mass).ln();
        let values = [
            1.0,
            particle.position[1],
            stress,
            particle.plastic_strain,
            strain,
            particle.temperature,
            particle.velocity[1],
        ];
        for (entry, value) in sum.iter_mut().zip(values) {
            *entry += mass * value;
        }
    }
    let section = |row: isize| -> f64 {
        let columns = 1..body.field.columns;
        columns
            .map(|column| body.field.node(row, column)[VOLUME])
            .sum::<f64>()
            / (mesh.cell * mesh.row_stretch(row))
    };
    let means = sums.iter().enumerate().filter(|(_, sum)| sum[0] > 0.0);
    means
        .map(|(row, sum)| {
            let at = first + row as isize;
            let area = 0.5 * (section(at) + section(at + 1));
            let [
                _,
                position,
                stress,
                plastic_strain,
                strain,
                temperature,
                velocity,
            ] = sum.map(|value| value / sum[0]);
            ElementState {
                part,
                initial_position: position,
                position,
                displacement: f64::NAN,
                length: mesh.cell * mesh.row_stretch(at),
                stress,
                strain,
                plastic_strain,
                diameter: 2.0 * (area / std::f64::consts::PI).sqrt(),
                temperature,
                velocity,
            }
        })
        .collect()
}

/// State at a gauge that is at a position now [m] and was at another one before the impact [m]: between the two rows of cells around it.
pub(super) fn at_gauge(
    rows: &[ElementState],
    body: usize,
    position: f64,
    initial: f64,
) -> ElementState {
    let own = || rows.iter().filter(|row| row.part == body);
    let behind = own().rfind(|row| row.position <= position);
    let ahead = own().find(|row| row.position > position);
    let state = match (behind, ahead) {
        (Some(a), Some(b)) => a.between(b, (position - a.position) / (b.position - a.position)),
        (Some(end), None) | (None, Some(end)) if (end.position - position).abs() < end.length => {
            *end
        }
        _ => ElementState::gone(body, initial),
    };
    ElementState {
        initial_position: initial,
        position,
        displacement: position - initial,
        ..state
    }
}

/// State of the material that is at a place now [m]: of the first body there. Where it was before the impact is not known.
pub(super) fn at_place(rows: &[ElementState], body: usize, place: f64) -> ElementState {
    let bodies = rows.chunk_by(|a, b| a.part == b.part);
    let mut states = bodies.map(|own| at_gauge(own, own[0].part, place, f64::NAN));
    states
        .find(|state| !state.velocity.is_nan())
        .unwrap_or(ElementState {
            position: place,
            ..ElementState::gone(body, f64::NAN)
        })
}
