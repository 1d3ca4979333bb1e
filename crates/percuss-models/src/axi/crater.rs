//! Surfaces of bodies, read off the nodes: a surface is where a body fills half of a node's cell.

use super::{
    body::Body,
    field::{Field, VOLUME},
    mesh::Mesh,
    remnant::outer_radius,
};

/// Part of a cell from which it counts as inside a body.
const FILLED: f64 = 0.9;

/// Part of the cell at a node of the axis that bodies fill; the axis and the column beside it count together.
fn axis_filling(fields: &[&Field], row: isize, mesh: &Mesh) -> f64 {
    let volume: f64 = fields
        .iter()
        .map(|field| field.node(row, 1)[VOLUME] + field.node(row, 2)[VOLUME])
        .sum();
    volume / (mesh.full_volume(row, 1) + mesh.full_volume(row, 2))
}

/// Range of rows of all fields together.
fn rows(fields: &[&Field]) -> std::ops::Range<isize> {
    let first = fields.iter().map(|field| field.first_row).min();
    let end = fields.iter().map(|f| f.first_row + f.rows as isize).max();
    first.unwrap_or(0)..end.unwrap_or(0)
}

/// Where the filling of the axis passes one half on the way from `full` to `empty`, both rows beside each other.
fn crossing(full: (isize, f64), empty: (isize, f64), mesh: &Mesh) -> f64 {
    let part = (full.1 - 0.5) / (full.1 - empty.1);
    mesh.depth(full.0 as f64 + part * (empty.0 - full.0) as f64)
}

/// Depth of the crater floor on the axis [m]: the first surface that one meets from behind the target's deepest material on the
/// axis; `None` when there is no material on the axis.
pub(super) fn floor(targets: &[Body], mesh: &Mesh) -> Option<f64> {
    let fields: Vec<&Field> = targets.iter().map(|body| &body.field).collect();
    let mut below: Option<(isize, f64)> = None;
    for row in rows(&fields).rev() {
        let here = (row, axis_filling(&fields, row, mesh));
        match below {
            Some(full) if here.1 < 0.5 => return Some(crossing(full, here, mesh)),
            Some(_) => below = Some(here),
            None => below = (here.1 >= 0.5).then_some(here),
        }
    }
    // Material up to the last row: the window of nodes ends where the weights of particles do.
    below.map(|(row, _)| mesh.depth(row as f64))
}

/// Tail and tip of a body on the axis [m].
pub(super) fn ends(body: &Body, mesh: &Mesh) -> Option<(f64, f64)> {
    let fields = [&body.field];
    let full = |row: &isize| axis_filling(&fields, *row, mesh) >= 0.5;
    let tail = rows(&fields).find(full)?;
    let tip = rows(&fields).rev().find(full)?;
    let at = |row: isize| (row, axis_filling(&fields, row, mesh));
    Some((
        crossing(at(tail), at(tail - 1), mesh),
        crossing(at(tip), at(tip + 1), mesh),
    ))
}

/// Axial velocity at the node of the axis that is nearest to a depth [m/s].
pub(super) fn axis_velocity(body: &Body, depth: f64, mesh: &Mesh) -> f64 {
    let row = mesh.row(depth);
    body.field
        .index(row, 1)
        .map_or(0.0, |index| body.field.velocity[index][1])
}

/// Profile of the crater: radius and depth of the floor at every column of nodes, where material is left [m]. Depths below the struck
/// face, which has flown to `face`, are scaled so that the first one, on the axis, is a known depth of the floor.
pub(super) fn profile(targets: &[Body], mesh: &Mesh, depth: f64, face: f64) -> Vec<[f64; 2]> {
    let fields: Vec<&Field> = targets.iter().map(|body| &body.field).collect();
    let columns = fields.iter().map(|field| field.columns).max().unwrap_or(0);
    let mut profile: Vec<[f64; 2]> = floor(targets, mesh)
        .map(|depth| [0.0, depth])
        .into_iter()
        .collect();
    for column in 2..columns {
        let radius = mesh.radius(column as f64);
        // Layers that have parted have a surface each: the first one there is the struck face.
        let surface = fields.iter().find_map(|field| surface(field, column, mesh));
        profile.extend(surface.map(|depth| [radius, depth]));
    }
    if let Some(&[_, read]) = profile.first().filter(|[_, read]| *read > face) {
        for [_, below] in profile.iter_mut().filter(|[_, below]| *below > face) {
            *below = face + (*below - face) * (depth / (read - face));
        }
    }
    profile
}

/// Depth of the rear face of a body at a radius [m]; `None` where it fills no cell.
pub(super) fn rear(body: &Body, radius: f64, mesh: &Mesh) -> Option<f64> {
    let column = mesh.column(radius).max(2);
    let at = |row: isize| {
        let volume = body.field.node(row, column)[VOLUME];
        (row, volume / mesh.full_volume(row, column))
    };
    let last = rows(&[&body.field]).rev().find(|row| at(*row).1 >= 0.5)?;
    Some(crossing(at(last), at(last + 1), mesh))
}

/// Depth of the first surface that one meets at a column from behind a body's deepest material there [m]; `None` where it fills no cell: on a rim,
/// or through a hole.
fn surface(field: &Field, column: usize, mesh: &Mesh) -> Option<f64> {
    let filling = |row: isize| field.node(row, column)[VOLUME] / mesh.full_volume(row, column);
    let rows = || rows(&[field]);
    if rows().map(filling).fold(0.0, f64::max) < FILLED {
        return None;
    }
    let mut below: Option<(isize, f64)> = None;
    for row in rows().rev() {
        let here = (row, filling(row));
        match below {
            Some(full) if here.1 < 0.5 => return Some(crossing(full, here, mesh)),
            Some(_) => below = Some(here),
            None => below = (here.1 >= 0.5).then_some(here),
        }
    }
    None
}

/// Outer surface of a body from its tail to its tip: radius and depth [m]. Its end faces are where the columns of nodes begin and
/// end, its side is where the rows between do.
pub(super) fn outline(body: &Body, mesh: &Mesh) -> Vec<[f64; 2]> {
    let Some((tail, tip)) = ends(body, mesh) else {
        return Vec::new();
    };
    let field = &body.field;
    let filling =
        |row: isize, column: usize| field.node(row, column)[VOLUME] / mesh.full_volume(row, column);
    let at = |row: isize, column: usize| (row, filling(row, column));
    // End face of a column: its first full row from one side, and the one before.
    let face = |column: usize, from_tail: bool| {
        let full = |row: &isize| filling(*row, column) >= 0.5;
        let (row, before) = if from_tail {
            let row = rows(&[field]).find(full)?;
            (row, row - 1)
        } else {
            let row = rows(&[field]).rev().find(full)?;
            (row, row + 1)
        };
        let depth = crossing(at(row, column), at(before, column), mesh);
        Some([mesh.radius(column as f64), depth])
    };
    let side = |row: isize| {
        let mut columns = (2..field.columns).rev();
        let column = columns.find(|column| filling(row, *column) >= 0.5)?;
        let (inner, outer) = (filling(row, column), filling(row, column + 1));
        let part = (inner - 0.5) / (inner - outer);
        Some([mesh.radius(column as f64 + part), mesh.depth(row as f64)])
    };
    let sides: Vec<[f64; 2]> = rows(&[field]).filter_map(side).collect();
    let end = |from_tail, beside: Option<&[f64; 2]>| -> Vec<[f64; 2]> {
        let most = beside.map_or(0.0, |point| point[0]);
        let faces = (2..field.columns).map_while(|column| face(column, from_tail));
        faces.take_while(|point| point[0] < most).collect()
    };
    let mut outline = vec![[0.0, tail]];
    outline.extend(end(true, sides.first()));
    outline.extend(&sides);
    outline.extend(end(false, sides.last()).iter().rev());
    outline.push([0.0, tip]);
    outline
}

/// Largest radius of a body [m]: that of its outermost particle and half of what the particle is wide.
pub(super) fn largest_radius(body: &Body) -> f64 {
    let present = body.particles().filter(|particle| particle.mass > 0.0);
    let radii = present.map(|particle| outer_radius(&particle));
    radii.fold(0.0, f64::max)
}
