//! Legends: a swatch, a name and, in a second column, a value for each entry.

use kuva::plot::scatter::MarkerShape;
use kuva::render::{
    color::Color,
    render::{PathData, Primitive, Scene, TextAnchor},
};

use crate::{
    primitives::{bar, filled, text},
    text::plain,
};

/// Most characters of a name.
const NAME_CHARS: usize = 34;
/// Size of the texts [px].
const SIZE: u32 = 12;
/// Height of a row [px].
const ROW: f64 = 18.0;
/// Length of a swatch: enough for two periods of the longest dashes but one [px].
const SWATCH: f64 = 32.0;
/// Distances: from the plot to the swatches, from there to the names, between names and values, and to the edge [px].
const BEFORE: f64 = 12.0;
const GAP: f64 = 8.0;
const COLUMN_GAP: f64 = 14.0;
const AFTER: f64 = 12.0;
/// Half the size of a marker and of an area [px].
const MARKER: f64 = 4.5;
const AREA: f64 = 6.0;
/// Width of a line that stands for nothing wider [px].
const LINE: f64 = 2.0;
/// Colour of the headings of the columns.
const HEADING: &str = "#555555";

/// What an entry stands for.
#[derive(Debug, Clone)]
pub(crate) struct Entry {
    name: String,
    /// Text of the second column.
    value: String,
    color: String,
    /// Opacity of an area.
    area: Option<f64>,
    /// A line, with its dashes and gaps if it has any [px].
    line: Option<Option<String>>,
    marker: Option<MarkerShape>,
}

impl Entry {
    fn new(name: &str, color: &str) -> Self {
        Self {
            name: plain(name, NAME_CHARS),
            value: String::new(),
            color: color.to_owned(),
            area: None,
            line: None,
            marker: None,
        }
    }

    /// An area of an opacity.
    pub(crate) fn area(name: &str, color: &str, opacity: f64) -> Self {
        Self {
            area: Some(opacity),
            ..Self::new(name, color)
        }
    }

    /// A line with its dashes, a marker, or both.
    pub(crate) fn series(
        name: &str,
        color: &str,
        line: Option<Option<&str>>,
        marker: Option<MarkerShape>,
    ) -> Self {
        Self {
            line: line.map(|dashes| dashes.map(str::to_owned)),
            marker,
            ..Self::new(name, color)
        }
    }

    /// Sets the text of the second column.
    pub(crate) fn value(mut self, value: &str) -> Self {
        self.value = plain(value, NAME_CHARS);
        self
    }
}

/// The legend of a chart.
#[derive(Debug, Clone, Default)]
pub(crate) struct Legend {
    entries: Vec<Entry>,
    /// Heading of the second column; none where it is empty.
    heading: String,
}

impl Legend {
    pub(crate) fn new(entries: impl IntoIterator<Item = Entry>) -> Self {
        Self {
            entries: entries.into_iter().collect(),
            heading: String::new(),
        }
    }

    /// Sets the heading of the second column.
    pub(crate) fn heading(mut self, heading: &str) -> Self {
        self.heading = heading.to_owned();
        self
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Space that it takes beside a plot, its distance from it included [px].
    pub(crate) fn width(&self) -> f64 {
        BEFORE + self.entry_width() + AFTER
    }

    /// Height beside a plot [px].
    pub(crate) fn height(&self) -> f64 {
        ROW * (self.entries.len() + self.heading_rows()) as f64
    }

    /// Height below a plot of a width [px].
    pub(crate) fn height_below(&self, width: f64) -> f64 {
        let rows = self.entries.len().div_ceil(self.columns(width));
        ROW * (rows + self.heading_rows()) as f64 + 0.5 * ROW
    }

    fn heading_rows(&self) -> usize {
        usize::from(!self.heading.is_empty())
    }

    fn entry_width(&self) -> f64 {
        let (names, values) = self.text_widths();
        let second = if values > 0.0 {
            COLUMN_GAP + values
        } else {
            0.0
        };
        SWATCH + GAP + names + second
    }

    /// Widths of the two columns of texts.
    fn text_widths(&self) -> (f64, f64) {
        let widest = |of: fn(&Entry) -> &str| {
            let texts = self.entries.iter().map(of);
            texts.map(text_width).fold(0.0, f64::max)
        };
        let (names, values) = (widest(|entry| &entry.name), widest(|entry| &entry.value));
        (names, values.max(text_width(&self.heading)))
    }

    /// Entries side by side below a plot.
    fn columns(&self, width: f64) -> usize {
        // Headings stand above one column only.
        match self.heading.is_empty() {
            true => (((width + COLUMN_GAP) / (self.entry_width() + COLUMN_GAP)) as usize).max(1),
            false => 1,
        }
    }

    /// Draws it beside a plot whose upper right corner is here.
    pub(crate) fn draw_beside(&self, scene: &mut Scene, right: f64, top: f64) {
        self.draw(scene, (right + BEFORE, top), 1, 0.0);
    }

    /// Draws it below a plot, from a left end on.
    pub(crate) fn draw_below(&self, scene: &mut Scene, left: f64, top: f64, width: f64) {
        let columns = self.columns(width);
        self.draw(scene, (left, top), columns, width / columns as f64);
    }

    fn draw(&self, scene: &mut Scene, (left, top): (f64, f64), columns: usize, apart: f64) {
        let (names, values) = self.text_widths();
        let end = SWATCH + GAP + names + COLUMN_GAP + values;
        let mut heading = text(
            (left + end, top + 0.5 * ROW + 4.0),
            &self.heading,
            (SIZE, TextAnchor::End, None),
        );
        if let Primitive::Text { color, .. } = &mut heading {
            *color = Some(Color::from(HEADING));
        }
        if !self.heading.is_empty() {
            scene.add(heading);
        }
        for (i, entry) in self.entries.iter().enumerate() {
            let row = (i / columns + self.heading_rows()) as f64;
            let x = left + apart * (i % columns) as f64;
            let y = top + ROW * (row + 0.5);
            entry.draw_swatch(scene, x, y);
            scene.add(text(
                (x + SWATCH + GAP, y + 4.0),
                &entry.name,
                (SIZE, TextAnchor::Start, None),
            ));
            if !entry.value.is_empty() {
                let at_end = (SIZE, TextAnchor::End, None);
                scene.add(text((x + end, y + 4.0), &entry.value, at_end));
            }
        }
    }
}

impl Entry {
    fn draw_swatch(&self, scene: &mut Scene, x: f64, y: f64) {
        if let Some(opacity) = self.area {
            let mut area = bar((x, y - AREA), (x + SWATCH, y + AREA), &self.color);
            if let Primitive::Rect {
                opacity: of_area, ..
            } = &mut area
            {
                *of_area = (opacity < 1.0).then_some(opacity);
            }
            scene.add(area);
        }
        if let Some(dashes) = &self.line {
            scene.add(Primitive::Line {
                x1: x,
                y1: y,
                x2: x + SWATCH,
                y2: y,
                stroke: Color::from(self.color.as_str()),
                stroke_width: LINE,
                stroke_dasharray: dashes.clone(),
            });
        }
        if let Some(shape) = self.marker {
            draw_marker(scene, shape, (x + 0.5 * SWATCH, y), &self.color);
        }
    }
}

/// A marker in the shape that the plotting library gives it.
fn draw_marker(scene: &mut Scene, shape: MarkerShape, (x, y): (f64, f64), color: &str) {
    // Corners at equal angles from the uppermost one on, at these distances in turn.
    let around = |count: usize, radii: &[f64]| -> Vec<(f64, f64)> {
        let corner = |k: usize| {
            let angle = std::f64::consts::TAU * (k as f64 / count as f64 - 0.25);
            let radius = MARKER * radii[k % radii.len()];
            (radius * angle.cos(), radius * angle.sin())
        };
        (0..count).map(corner).collect()
    };
    let (s, cross) = (MARKER, 0.9 * MARKER);
    let strokes = match shape {
        MarkerShape::Cross => [
            [-cross, -cross, cross, cross],
            [-cross, cross, cross, -cross],
        ],
        MarkerShape::Plus => [[-cross, 0.0, cross, 0.0], [0.0, -cross, 0.0, cross]],
        _ => {
            let corners = match shape {
                MarkerShape::Square => vec![(-s, -s), (s, -s), (s, s), (-s, s)],
                MarkerShape::Triangle => vec![(0.0, -1.02 * s), (s, 0.68 * s), (-s, 0.68 * s)],
                MarkerShape::TriangleDown => {
                    vec![(0.0, 1.02 * s), (s, -0.68 * s), (-s, -0.68 * s)]
                }
                MarkerShape::Diamond => around(4, &[1.3]),
                MarkerShape::Star => around(10, &[1.25, 0.5]),
                MarkerShape::Pentagon => around(5, &[1.2]),
                MarkerShape::Hexagon => around(6, &[1.15]),
                _ => around(24, &[1.0]),
            };
            let corners = corners.iter().enumerate().map(|(k, (dx, dy))| {
                let command = if k == 0 { 'M' } else { 'L' };
                format!("{command}{:.2} {:.2}", x + dx, y + dy)
            });
            scene.add(filled(corners.collect::<String>() + "z", color));
            return;
        }
    };
    let path = strokes.map(|[x1, y1, x2, y2]| {
        format!("M{:.2} {:.2}L{:.2} {:.2}", x + x1, y + y1, x + x2, y + y2)
    });
    scene.add(Primitive::Path(Box::new(PathData {
        d: path.concat(),
        fill: None,
        stroke: Color::from(color),
        stroke_width: 1.5,
        opacity: None,
        stroke_dasharray: None,
    })));
}

/// Width of a text, from the widths of the letters of DejaVu Sans by groups [px].
fn text_width(content: &str) -> f64 {
    let part = |letter: char| match letter {
        'i' | 'j' | 'l' | '\'' | '|' => 0.30,
        ' ' | '.' | ',' | ':' | ';' | '!' | 'I' | 'f' | 't' | 'r' | '-' | '(' | ')' | '/' => 0.40,
        'm' | 'M' | 'W' | 'w' | '%' | '…' => 0.97,
        '+' | '±' | '=' | '<' | '>' | '−' | '×' | '→' => 0.84,
        'A'..='Z' | '★' => 0.74,
        _ => 0.64,
    };
    f64::from(SIZE) * content.chars().map(part).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn legend(count: usize) -> Legend {
        Legend::new((0..count).map(|i| {
            let name = format!("model {i}");
            Entry::series(&name, "#000000", Some(None), None).value("12 m/s")
        }))
    }

    #[test]
    fn values_stand_in_a_column_of_their_own() {
        let (few, many) = (legend(2), legend(8).heading("limit"));
        assert_eq!(few.height(), 2.0 * ROW);
        assert_eq!(many.height(), 9.0 * ROW);
        let plain = Legend::new([Entry::area("model 0", "#000000", 1.0)]);
        assert!(few.width() > plain.width() + text_width("12 m/s"));
        // Below a plot, entries without a heading stand side by side.
        let wide = 3.2 * few.width();
        assert_eq!((few.columns(wide), many.columns(wide)), (3, 1));
    }
}
