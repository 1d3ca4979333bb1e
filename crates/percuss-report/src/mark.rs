//! Lines across a plot that mark a value.

use kuva::render::{
    annotations::ReferenceLine, color::Color, layout::ComputedLayout, render::Primitive,
};

use serde::Serialize;

use crate::{legend::Entry, palette, single};

/// Dashes of the marks of a chart one after the other [px], short enough for the legend; the last one is a full line.
const DASHES: [Option<&str>; 4] = [Some("2 2"), Some("5 2.5"), Some("7 2 2 2"), None];
const WIDTH: f64 = 1.2;

/// A line across the plot at one value.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Mark {
    pub(crate) name: String,
    /// Its value in the second column of the legend.
    #[serde(skip)]
    pub(crate) shown: String,
    #[serde(serialize_with = "single::number")]
    pub(crate) value: f64,
    pub(crate) vertical: bool,
}

impl Mark {
    /// A horizontal line at `y`; an empty name keeps it out of the legend.
    pub fn horizontal(name: impl Into<String>, y: f64) -> Self {
        Self {
            name: name.into(),
            shown: String::new(),
            value: y,
            vertical: false,
        }
    }

    /// Sets its text in the second column of the legend.
    pub(crate) fn shown(mut self, value: impl Into<String>) -> Self {
        self.shown = value.into();
        self
    }

    /// A vertical line at `x`; an empty name keeps it out of the legend.
    pub fn vertical(name: impl Into<String>, x: f64) -> Self {
        Self {
            vertical: true,
            ..Self::horizontal(name, x)
        }
    }
}

/// Marks with their dashes: those with a name differ, one without has those of the mark before it.
fn dashed(marks: &[Mark]) -> impl Iterator<Item = (&Mark, Option<&'static str>)> {
    marks.iter().enumerate().map(move |(i, mark)| {
        let named = marks[..=i].iter().filter(|mark| !mark.name.is_empty());
        (mark, DASHES[named.count().saturating_sub(1) % DASHES.len()])
    })
}

/// Legend entries of marks.
pub(crate) fn entries(marks: &[Mark]) -> impl Iterator<Item = Entry> {
    dashed(marks)
        .filter(|(mark, _)| !mark.name.is_empty())
        .map(|(mark, dashes)| {
            Entry::series(&mark.name, palette::MARK, Some(dashes), None).value(&mark.shown)
        })
}

/// Marks of a plot that the plotting library draws.
pub(crate) fn reference_lines(marks: &[Mark]) -> Vec<ReferenceLine> {
    let line = |(mark, dashes): (&Mark, Option<&str>)| {
        let line = match mark.vertical {
            true => ReferenceLine::vertical(mark.value),
            false => ReferenceLine::horizontal(mark.value),
        };
        // A dash without a gap is a full line.
        line.with_color(palette::MARK)
            .with_stroke_width(WIDTH)
            .with_dasharray(dashes.unwrap_or("1 0"))
    };
    dashed(marks).map(line).collect()
}

/// Vertical marks from top to bottom of a plot that this crate draws.
pub(crate) fn lines(marks: &[Mark], place: &ComputedLayout) -> Vec<Primitive> {
    let line = |(mark, dashes): (&Mark, Option<&str>)| {
        let (x, top) = (place.map_x(mark.value), place.margin_top);
        Primitive::Line {
            x1: x,
            y1: top,
            x2: x,
            y2: top + place.plot_height(),
            stroke: Color::from(palette::MARK),
            stroke_width: WIDTH,
            stroke_dasharray: dashes.map(str::to_owned),
        }
    };
    dashed(marks).map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_with_names_differ_and_one_without_belongs_to_the_one_before() {
        let marks = ["", "a", "b", "", "c", "d"].map(|name| Mark::vertical(name, 0.0));
        let dashes: Vec<_> = dashed(&marks).map(|(_, dashes)| dashes).collect();
        let [dotted, dashed, dash_dotted, full] = DASHES;
        assert_eq!(dashes, [dotted, dotted, dashed, dashed, dash_dotted, full]);
        assert_eq!(entries(&marks).count(), 4);
    }
}
