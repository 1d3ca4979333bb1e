//! Crater and projectile at the end of a run in two dimensions: figure and tables.

use std::path::{Path, PathBuf};

use percuss::{Scenario, outcome::RunResult, shapes::Shapes};

use crate::{
    Axis, LineChart, ReportError, Series, Style,
    caption::caption,
    column::{self, Column},
    palette,
    replace_file::replace_file,
};

/// Writes `crater-profile.csv` and `projectile-shape.csv` to a folder, as far as a result has them: radius and depth of the
/// target's surface from the axis outwards, and of the projectile's outer surface from tail to tip.
///
/// # Errors
/// [`ReportError::Write`]; [`ReportError::Table`].
pub fn write_shapes(folder: &Path, result: &RunResult) -> Result<Vec<PathBuf>, ReportError> {
    let columns: Vec<Column<[f64; 2]>> = vec![
        Column::float("radius_mm", |point: &[f64; 2]| point[0] * 1e3),
        Column::float("depth_mm", |point: &[f64; 2]| point[1] * 1e3),
    ];
    let Some(shapes) = &result.shapes else {
        return Ok(Vec::new());
    };
    [
        ("crater-profile.csv", &shapes.crater),
        ("projectile-shape.csv", &shapes.projectile),
    ]
    .into_iter()
    .filter(|(_, points)| !points.is_empty())
    .map(|(name, points)| replace_file(folder, name, &column::csv(name, &columns, points)?))
    .collect()
}

/// Crater and projectile at the end, true to scale.
pub(crate) fn shape_chart(scenario: &Scenario, shapes: &Shapes) -> LineChart {
    let around = width_shown(scenario, shapes);
    let crater: Vec<_> = shapes
        .crater
        .iter()
        .copied()
        .take_while(|point| point[0] <= around)
        .collect();
    let solid = !crater.is_empty();
    let mut chart = LineChart::new(
        "final-shape",
        match (solid, shapes.projectile.is_empty()) {
            (true, false) => "Final shape of crater and projectile",
            (true, true) => "Final shape of the target",
            (false, _) => "Final shape of the projectile",
        },
        Axis::new("Distance from the axis (mm)"),
        Axis::new("Depth (mm)").downward(),
    )
    .caption(caption(scenario, Some(scenario.impact_velocity)));
    if solid {
        let name = match scenario.target_thickness() {
            Some(_) => "target, impact side",
            None => "crater",
        };
        chart = chart.series(Series::new(name, mirrored_surface(&crater)));
    }
    if !shapes.projectile.is_empty() {
        chart = chart.series(Series::new("projectile", mirrored(&shapes.projectile)));
    }
    let edge = [[-around, 0.0], [around, 0.0]].map(|[x, z]| (x * 1e3, -z * 1e3));
    chart = chart.series(
        Series::new(if solid { "original face" } else { "wall" }, edge)
            .style(Style::Dashed)
            .color(palette::MARK),
    );
    chart.true_to_scale()
}

/// Radius out to which the shapes are drawn [m]: around the projectile, or the bulge of a plate to a twentieth of its depth.
fn width_shown(scenario: &Scenario, shapes: &Shapes) -> f64 {
    let widest = shapes.projectile.iter().map(|point| point[0]);
    let part = if shapes.crater.is_empty() { 1.5 } else { 2.5 };
    let around = part * widest.fold(0.5 * scenario.projectile.diameter, f64::max);
    if !shapes.projectile.is_empty() {
        return around;
    }
    let deepest = shapes
        .crater
        .iter()
        .map(|point| point[1])
        .fold(0.0, f64::max);
    let bulge = shapes
        .crater
        .iter()
        .rev()
        .find(|point| point[1] > 0.05 * deepest);
    bulge.map_or(around, |point| around.max(point[0]))
}

/// Points of both halves in mm, from the left to the right.
fn mirrored(points: &[[f64; 2]]) -> Vec<(f64, f64)> {
    let left = points.iter().rev().map(|[r, z]| (-r * 1e3, -z * 1e3));
    left.chain(points.iter().map(|[r, z]| (r * 1e3, -z * 1e3)))
        .collect()
}

/// The same with a gap where the surface has a hole.
fn mirrored_surface(points: &[[f64; 2]]) -> Vec<(f64, f64)> {
    let mut all = mirrored(points);
    if points.first().is_some_and(|point| point[0] > 0.0) {
        all.insert(points.len(), (f64::NAN, f64::NAN));
    }
    all
}
