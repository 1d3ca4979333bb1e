//! Drawing primitives that the plotting library lacks.

use kuva::render::{
    color::Color,
    render::{PathData, Primitive, TextAnchor},
};

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

/// A text at a place, turned by an angle where one is given [deg].
pub(crate) fn text(
    place: (f64, f64),
    content: &str,
    (size, anchor, rotate): (u32, TextAnchor, Option<f64>),
) -> Primitive {
    Primitive::Text {
        x: place.0,
        y: place.1,
        content: content.to_owned(),
        size,
        anchor,
        rotate,
        bold: false,
        color: None,
    }
}
