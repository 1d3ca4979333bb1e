//! Fields of a run in two dimensions: a series of files for ParaView, pictures and an animation.

mod animation;
mod colors;
mod picture;
mod quantity;
mod raster;
mod series;
mod vtp;

use std::{
    fs,
    path::{Path, PathBuf},
    sync::Mutex,
};

use percuss::{Scenario, scenario::TargetBody};
use rayon::prelude::*;
use resvg::tiny_skia::Pixmap;

use self::{animation::Palette, colors::Colors, picture::Canvas, raster::View, vtp::Points};
use crate::{ReportError, replace_file::replace_file, run_figures::caption};

pub use quantity::FieldQuantity;
pub use series::FieldSeries;

/// Pixels of a picture and of the animation per SVG user unit.
const PICTURE_SCALE: f32 = 1.5;
const ANIMATION_SCALE: f32 = 1.0;
/// Folder of the pictures.
const FOLDER: &str = "frames";
/// Part of the values of a frame that may lie beyond the ends of the colours.
const BEYOND: f64 = 1e-3;

/// Draws every frame of a series as `frames/frame-NNNNN.png`, the last one as `field.png` too, and all of them as `animation.gif`.
/// `progress` hears the part done, 0 to 1. Returns the files, the folder of the pictures standing for them.
///
/// # Errors
/// [`ReportError::Read`] when a file of the series is missing or damaged; [`ReportError::Write`]; [`ReportError::Figure`].
pub fn draw_fields(
    folder: &Path,
    scenario: &Scenario,
    series: &FieldSeries,
    quantity: FieldQuantity,
    progress: &mut (dyn FnMut(f64) + Send),
) -> Result<Vec<PathBuf>, ReportError> {
    let files = series.files();
    let spans: Vec<Span> = files
        .par_iter()
        .map(|(_, file)| Ok(Span::of(&read(file, quantity)?)))
        .collect::<Result<_, ReportError>>()?;
    let Some(span) = spans.into_iter().reduce(Span::with) else {
        return Ok(Vec::new());
    };
    let wall = scenario.target == TargetBody::RigidWall;
    let (_, _, unit) = quantity.source();
    let values = (
        f64::from(span.values.0) / unit,
        f64::from(span.values.1) / unit,
    );
    let colors = Colors::new(quantity, values, wall);
    let title = format!(
        "{}{}",
        label(quantity),
        if wall {
            ""
        } else {
            " in projectile and target"
        }
    );
    let canvas = Canvas::new(
        &title,
        &caption(scenario, Some(scenario.impact_speed)),
        colors,
        view(scenario, &span),
    );
    let (large, small) = (canvas.base(PICTURE_SCALE)?, canvas.base(ANIMATION_SCALE)?);
    let palette = Palette::new(&colors.all());
    let pictures = folder.join(FOLDER);
    clear(&pictures);
    let progress = Mutex::new((0, progress));
    let indexed: Vec<_> = files
        .par_iter()
        .map(|(number, file)| {
            let points = read(file, quantity)?;
            let picture = canvas.picture(&points, &large, PICTURE_SCALE)?;
            replace_file(
                &pictures,
                &format!("frame-{number:05}.png"),
                &png(&picture)?,
            )?;
            let picture = canvas.picture(&points, &small, ANIMATION_SCALE)?;
            let indexed = palette.index(&picture);
            if let Ok(mut progress) = progress.lock() {
                progress.0 += 1;
                let part = f64::from(progress.0) / files.len() as f64;
                (progress.1)(part);
            }
            Ok(indexed)
        })
        .collect::<Result<_, ReportError>>()?;
    let mut written = vec![pictures];
    if let Some((_, file)) = files.last() {
        let picture = canvas.picture(&read(file, quantity)?, &large, PICTURE_SCALE)?;
        written.push(replace_file(folder, "field.png", &png(&picture)?)?);
    }
    let animation = animation::encode(&palette, &indexed)?;
    written.push(replace_file(folder, "animation.gif", &animation)?);
    Ok(written)
}

fn label(quantity: FieldQuantity) -> String {
    let label = quantity.label();
    let words = label.split(" [").next().unwrap_or(label);
    let mut letters = words.chars();
    match letters.next() {
        Some(first) => first.to_uppercase().chain(letters).collect(),
        None => String::new(),
    }
}

/// Removes pictures of an earlier run.
fn clear(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        if name.starts_with("frame-") && name.ends_with(".png") {
            // One too many does no harm.
            let _ = fs::remove_file(entry.path());
        }
    }
}

fn read(file: &Path, quantity: FieldQuantity) -> Result<Points, ReportError> {
    let failure = |reason: String| ReportError::Read {
        path: file.to_owned(),
        reason,
    };
    let bytes = fs::read(file).map_err(|error| failure(error.to_string()))?;
    let (array, components, _) = quantity.source();
    vtp::decode(&bytes, array, components)
        .ok_or_else(|| failure("it is damaged or of another program".to_owned()))
}

fn png(picture: &Pixmap) -> Result<Vec<u8>, ReportError> {
    let failure = |error: png::EncodingError| ReportError::Figure {
        name: "frame".to_owned(),
        reason: error.to_string(),
    };
    let colors: Vec<u8> = picture
        .pixels()
        .iter()
        .flat_map(|pixel| [pixel.red(), pixel.green(), pixel.blue()])
        .collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, picture.width(), picture.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_compression(png::Compression::Balanced);
    let mut writer = encoder.write_header().map_err(failure)?;
    writer.write_image_data(&colors).map_err(failure)?;
    writer.finish().map_err(failure)?;
    Ok(bytes)
}

/// What frames reach.
#[derive(Debug, Clone, Copy)]
struct Span {
    values: (f32, f32),
    /// Largest radius and range of depths of the projectile [m].
    rod: (f32, (f32, f32)),
    /// Largest depth of material of the target near the axis, and of the crater floor [m].
    target: f32,
    depth: f64,
}

impl Span {
    fn of(points: &Points) -> Self {
        let mut values = points.values.clone();
        values.sort_unstable_by(f32::total_cmp);
        let beyond = (BEYOND * values.len() as f64) as usize;
        let at = |index: usize| values.get(index).copied().unwrap_or(0.0);
        let most = at(values.len().saturating_sub(1 + beyond));
        let mut span = Self {
            values: (at(beyond), most),
            rod: (0.0, (0.0, 0.0)),
            target: 0.0,
            depth: points.depth,
        };
        for (&[radius, depth], &body) in points.places.iter().zip(&points.bodies) {
            if body == 0 {
                let (widest, (back, front)) = span.rod;
                span.rod = (widest.max(radius), (back.min(depth), front.max(depth)));
            } else {
                span.target = span.target.max(depth);
            }
        }
        span
    }

    fn with(self, other: Self) -> Self {
        let range = |a: (f32, f32), b: (f32, f32)| (a.0.min(b.0), a.1.max(b.1));
        Self {
            values: range(self.values, other.values),
            rod: (self.rod.0.max(other.rod.0), range(self.rod.1, other.rod.1)),
            target: self.target.max(other.target),
            depth: self.depth.max(other.depth),
        }
    }
}

/// What pictures show: the projectile at all times, and of the target what the shot changes.
fn view(scenario: &Scenario, span: &Span) -> View {
    let radius = 0.5 * scenario.projectile.diameter;
    let (widest, (back, front)) = span.rod;
    let (back, front) = (f64::from(back) - radius, f64::from(front));
    if scenario.target == TargetBody::RigidWall {
        return View {
            radius: f64::from(widest).max(2.0 * radius) + radius,
            depth: (back, 0.8 * radius),
        };
    }
    let shown = (span.depth + 5.0 * radius).max(6.0 * radius);
    // Where a plate ends there is something to be seen of what is behind it.
    let end = match scenario.target_thickness() {
        Some(_) => f64::from(span.target) + radius,
        None => f64::from(span.target),
    };
    View {
        radius: (f64::from(widest) + radius).max(6.0 * radius),
        depth: (back, end.min(shown).max(front + radius)),
    }
}
