//! Pictures of fields.

use std::{
    path::{Path, PathBuf},
    sync::Mutex,
};

use percuss::{Scenario, scenario::TargetBody};
use rayon::prelude::*;

use super::{
    FieldQuantity, FieldSeries,
    animation::{self, Palette},
    colors::Colors,
    picture::Canvas,
    span::{FieldSpan, usual_range},
    vtp_points::{self, Points},
};
use crate::{
    ReportError, caption::caption, figure::SpareMemory, png_file, replace_file::replace_file,
};

/// Pixels of the picture at the end and of those of an animation per SVG user unit.
const PICTURE_SCALE: f32 = 1.5;
const ANIMATION_SCALE: f32 = 1.0;
/// Folder of the pictures of an animation.
const FOLDER: &str = "frames";

/// Writes a picture of one quantity of the field that a file holds, of these bytes, beside it.
///
/// # Errors
/// [`ReportError::Write`]; [`ReportError::Figure`].
pub(super) fn write(
    path: &Path,
    file: &[u8],
    note: &str,
    scenario: &Scenario,
    quantity: FieldQuantity,
) -> Result<PathBuf, ReportError> {
    let points = points(file, path, quantity)?;
    let (mut canvas, _) = canvas(scenario, quantity, &span(&points));
    canvas.note = note.to_owned();
    let base = canvas.base(PICTURE_SCALE)?;
    let picture = canvas.picture(&points, &base, PICTURE_SCALE)?;
    let folder = path.parent().unwrap_or(path);
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let name = format!("{name}.png");
    replace_file(
        folder,
        &name,
        &png_file::encode(&name, picture, &SpareMemory::default())?,
    )
}

/// Draws every frame of a series as `frames/frame-NNNNN.png`, and all of them as `animation.gif`. `progress` hears the part done, 0 to
/// 1. Returns the folder of the pictures and the animation; nothing for a series without frames.
///
/// # Errors
/// [`ReportError::Read`] when a file of the series is missing or damaged; [`ReportError::Write`]; [`ReportError::Figure`].
pub fn animate(
    folder: &Path,
    scenario: &Scenario,
    series: &FieldSeries,
    quantity: FieldQuantity,
    progress: &mut (dyn FnMut(f64) + Send),
) -> Result<Vec<PathBuf>, ReportError> {
    let files = series.files();
    let spans: Vec<FieldSpan> = files
        .par_iter()
        .map(|(_, file)| Ok(span(&read(file, quantity)?)))
        .collect::<Result<_, ReportError>>()?;
    let Some(span) = spans.into_iter().reduce(FieldSpan::with) else {
        return Ok(Vec::new());
    };
    let (canvas, palette) = canvas(scenario, quantity, &span);
    let base = canvas.base(ANIMATION_SCALE)?;
    let pictures = folder.join(FOLDER);
    super::clear(&pictures, ".png");
    let progress = Mutex::new((0, progress));
    let indexed: Vec<_> = files
        .par_iter()
        .map(|(number, file)| {
            let picture = canvas.picture(&read(file, quantity)?, &base, ANIMATION_SCALE)?;
            let name = format!("frame-{number:05}.png");
            let indexed = palette.index(&picture);
            let png = png_file::encode(&name, picture, &SpareMemory::default())?;
            replace_file(&pictures, &name, &png)?;
            if let Ok(mut progress) = progress.lock() {
                progress.0 += 1;
                let part = f64::from(progress.0) / files.len() as f64;
                (progress.1)(part);
            }
            Ok(indexed)
        })
        .collect::<Result<_, ReportError>>()?;
    let animation = animation::encode(&palette, &indexed)?;
    let animation = replace_file(folder, "animation.gif", &animation)?;
    Ok(vec![pictures, animation])
}

/// What all pictures of frames that reach a span have in common, and the colours in them.
fn canvas(scenario: &Scenario, quantity: FieldQuantity, span: &FieldSpan) -> (Canvas, Palette) {
    let wall = scenario.target == TargetBody::RigidWall;
    let (_, _, unit) = quantity.source();
    let (least, most) = span.values();
    let values = (f64::from(least) / unit, f64::from(most) / unit);
    let colors = Colors::new(quantity, values, wall);
    let palette = Palette::new(&colors.all());
    let bodies = if wall {
        ""
    } else {
        " in projectile and target"
    };
    let canvas = Canvas::new(
        &format!("{}{bodies}", label(quantity)),
        &caption(scenario, Some(scenario.impact_velocity)),
        colors,
        span.view(scenario),
    );
    (canvas, palette)
}

/// What the points of a frame reach.
fn span(points: &Points) -> FieldSpan {
    let places = points
        .places
        .iter()
        .copied()
        .zip(points.bodies.iter().copied());
    FieldSpan::new(usual_range(points.values.clone()), places, points.depth)
}

fn label(quantity: FieldQuantity) -> String {
    let label = quantity.label();
    let words = label.split(" (").next().unwrap_or(label);
    let mut letters = words.chars();
    match letters.next() {
        Some(first) => first.to_uppercase().chain(letters).collect(),
        None => String::new(),
    }
}

fn read(file: &Path, quantity: FieldQuantity) -> Result<Points, ReportError> {
    points(&super::read(file)?, file, quantity)
}

/// The points in the bytes of a file.
fn points(bytes: &[u8], file: &Path, quantity: FieldQuantity) -> Result<Points, ReportError> {
    let (array, components, _) = quantity.source();
    vtp_points::decode(bytes, array, components).ok_or_else(|| super::damaged(file))
}
