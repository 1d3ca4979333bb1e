//! Pieces of drawings that charts put beside what the plotting library draws.

use kuva::plot::legend::{LegendEntry, LegendShape};
use kuva::render::{
    color::Color,
    layout::ComputedLayout,
    render::{PathData, Primitive},
};

use crate::{frame::plain, palette};

/// Dashes of a mark [px].
const MARK_DASHES: &str = "2 2";
/// Most characters of a name in the legend.
const NAME_CHARS: usize = 34;

/// An area in one colour.
pub(crate) fn filled(path: String, color: &str) -> Primitive {
    Primitive::Path(Box::new(PathData {
        d: path,
        fill: Some(Color::from(color)),
        stroke: Color::None,
        stroke_width: 0.0,
        opacity: None,
        stroke_dasharray: None,
    }))
}

/// The outline of a rectangle: left, top, width and height.
pub(crate) fn border(x: f64, y: f64, width: f64, height: f64) -> Primitive {
    Primitive::Rect {
        x,
        y,
        width,
        height,
        fill: Color::None,
        stroke: Some(Color::from("black")),
        stroke_width: Some(1.0),
        opacity: None,
    }
}

/// A line in black.
pub(crate) fn line(from: (f64, f64), to: (f64, f64), width: f64) -> Primitive {
    Primitive::Line {
        x1: from.0,
        y1: from.1,
        x2: to.0,
        y2: to.1,
        stroke: Color::from("black"),
        stroke_width: width,
        stroke_dasharray: None,
    }
}

/// A filled rectangle between two corners.
pub(crate) fn bar(from: (f64, f64), to: (f64, f64), color: &str) -> Primitive {
    Primitive::Rect {
        x: from.0.min(to.0),
        y: from.1.min(to.1),
        width: (to.0 - from.0).abs(),
        height: (to.1 - from.1).abs(),
        fill: Color::from(color),
        stroke: None,
        stroke_width: None,
        opacity: None,
    }
}

/// A vertical dashed line that marks a value, from top to bottom.
pub(crate) fn mark(place: &ComputedLayout, value: f64) -> Primitive {
    let (x, top) = (place.map_x(value), place.margin_top);
    Primitive::Line {
        x1: x,
        y1: top,
        x2: x,
        y2: top + place.plot_height(),
        stroke: Color::from(palette::MARK),
        stroke_width: 1.2,
        stroke_dasharray: Some(MARK_DASHES.to_owned()),
    }
}

/// What the legend says of a mark.
pub(crate) fn mark_entry(name: &str) -> LegendEntry {
    LegendEntry {
        label: plain(name, NAME_CHARS),
        color: palette::MARK.to_owned(),
        shape: LegendShape::Line,
        dasharray: Some(MARK_DASHES.to_owned()),
    }
}

/// What the legend says of an area.
pub(crate) fn area_entry(name: &str, color: &str) -> LegendEntry {
    LegendEntry {
        label: plain(name, NAME_CHARS),
        color: color.to_owned(),
        shape: LegendShape::Rect,
        dasharray: None,
    }
}
