//! Heat maps of a quantity versus two axes.
//!
//! The plotting library's own take their colours from the extremes of the data, leave no cell empty and draw a rectangle per cell.

use std::fmt::Write;

use kuva::plot::LinePlot;
use kuva::render::{
    color::Color,
    layout::ComputedLayout,
    render::{Primitive, Scene, TextAnchor},
};

use percuss::statistics::sorted;

use crate::{
    Axis, Figure,
    chart_methods::chart_methods,
    color_bar::ColorBar,
    frame::{Frame, Head},
    palette,
    primitives::{border, filled, line, text},
};

/// Steps of colour.
const LEVELS: usize = 64;
/// Character that stands for the first colour.
const FIRST_CODE: u8 = b'0';
/// Space at the right for the colour bar, its numbers and its label [px].
const BAR_MARGIN: f64 = 118.0;

/// The values that the colours of a map stand for.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Scale {
    low: f64,
    high: f64,
    /// Whether colours diverge from the middle, which is zero; they run from light to dark otherwise.
    diverging: bool,
}

impl Scale {
    /// Place of a value between the ends: 0 to 1.
    fn part(&self, value: f64) -> f64 {
        ((value - self.low) / (self.high - self.low)).clamp(0.0, 1.0)
    }

    fn color(&self, part: f64) -> String {
        if self.diverging {
            return palette::diverging(2.0 * part - 1.0);
        }
        let [r, g, b] = palette::sequential(part);
        format!("#{r:02x}{g:02x}{b:02x}")
    }

    /// All colours, that of the lowest value first.
    fn colors(&self) -> Vec<String> {
        let levels = 0..=LEVELS;
        levels
            .map(|level| self.color(level as f64 / LEVELS as f64))
            .collect()
    }

    /// Whether text on the colour of a value has to be white.
    fn is_dark(&self, value: f64) -> bool {
        match self.diverging {
            true => (2.0 * self.part(value) - 1.0).abs() > 0.7,
            false => self.part(value) > 0.55,
        }
    }
}

/// A heat map on a regular grid, with a colour bar. Colours diverge from zero unless they are told to run between two values.
#[derive(Debug, Clone, PartialEq)]
pub struct HeatMap {
    pub(crate) head: Head,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    ranges: [(f64, f64); 2],
    pub(crate) value_label: String,
    pub(crate) rows: Vec<Vec<f64>>,
    pub(crate) vertical_lines: Vec<f64>,
    texts: Vec<Vec<String>>,
    scale: Option<Scale>,
    height: Option<f64>,
}

chart_methods!(HeatMap);

impl HeatMap {
    /// A heat map: file stem, title, axes, the ranges of `x` and `y` that the grid covers, the label of the colour bar
    /// and the rows of the grid, the one with the smallest `y` first. A value that is not a number is drawn grey, an infinite one
    /// left white.
    pub fn new(
        [name, title]: [&str; 2],
        [x, y]: [Axis; 2],
        ranges: [(f64, f64); 2],
        value_label: impl Into<String>,
        rows: Vec<Vec<f64>>,
    ) -> Self {
        Self {
            head: Head::new(name, title),
            x: x.range(ranges[0].0, ranges[0].1),
            y: y.range(ranges[1].0, ranges[1].1),
            ranges,
            value_label: value_label.into(),
            rows,
            vertical_lines: Vec::new(),
            texts: Vec::new(),
            scale: None,
            height: None,
        }
    }

    /// Adds a thin vertical line.
    pub fn vertical_line(mut self, x: f64) -> Self {
        self.vertical_lines.push(x);
        self
    }

    /// Writes a text into each cell, in rows as the values are.
    pub fn texts(mut self, texts: Vec<Vec<String>>) -> Self {
        self.texts = texts;
        self
    }

    /// Sets the value with the strongest colour, for maps to be compared; chosen from the values otherwise.
    pub fn limit(mut self, limit: f64) -> Self {
        self.scale = Some(Scale {
            low: -limit,
            high: limit,
            diverging: true,
        });
        self
    }

    /// Makes the colours run from light at one value to dark at another.
    pub fn between(mut self, low: f64, high: f64) -> Self {
        self.scale = Some(Scale {
            low,
            high,
            diverging: false,
        });
        self
    }

    /// Sets the height of the figure [px].
    pub fn height(mut self, height: f64) -> Self {
        self.height = Some(height);
        self
    }

    /// Draws the heat map.
    pub fn draw(&self) -> Figure {
        let usual = Frame::new(&self.head, [&self.x, &self.y], self.extents());
        let frame = Frame {
            height: self.height.unwrap_or(usual.height),
            right_margin: Some(BAR_MARGIN),
            ..usual
        };
        let scale = self.scale();
        // Axes are drawn only for a plot, so there is one without content.
        frame.draw(vec![LinePlot::new().into()], |scene, place| {
            self.add_cells(scene, place, scale);
            self.add_texts(scene, place, scale);
            self.add_lines(scene, place);
            let bar = ColorBar {
                colors: scale.colors(),
                ends: (scale.low, scale.high),
                label: &self.value_label,
                below_top: 0.0,
            };
            bar.draw(scene, place);
        })
    }

    /// The ranges of either axis.
    pub(crate) fn extents(&self) -> ((f64, f64), (f64, f64)) {
        (self.ranges[0], self.ranges[1])
    }

    fn scale(&self) -> Scale {
        self.scale.unwrap_or_else(|| {
            let limit = self.largest();
            Scale {
                low: -limit,
                high: limit,
                diverging: true,
            }
        })
    }

    /// The values that the first and the last colour stand for.
    pub(crate) fn ends(&self) -> (f64, f64) {
        let scale = self.scale();
        (scale.low, scale.high)
    }

    /// The cells as text, a character a cell, and the colours that they stand for: [`FIRST_CODE`] is the first colour, the next
    /// character the next one, and a space a cell without value.
    pub(crate) fn codes(&self) -> (String, Vec<String>) {
        let scale = self.scale();
        let code = |value: &f64| match value.is_finite() {
            true => char::from(FIRST_CODE + (scale.part(*value) * LEVELS as f64).round() as u8),
            false => ' ',
        };
        (
            self.rows.iter().flatten().map(code).collect(),
            scale.colors(),
        )
    }

    /// Value with the strongest colour: all but one value in 200 lie within it, so that a spike does not bleach the rest.
    fn largest(&self) -> f64 {
        let sizes = self.rows.iter().flatten().map(|v| v.abs());
        let sizes = sorted(sizes.filter(|size| size.is_finite()));
        match sizes.get(sizes.len().saturating_sub(1 + sizes.len() / 200)) {
            Some(&size) if size > 0.0 => size,
            _ => 1.0,
        }
    }

    /// One path for each colour, made of runs of cells of that colour, on a grid of whole numbers: small and seamless.
    fn add_cells(&self, scene: &mut Scene, place: &ComputedLayout, scale: Scale) {
        let columns = self.rows.first().map_or(0, Vec::len);
        if columns == 0 {
            return;
        }
        // Colours, then what has no value; an infinite value stands for a cell that nothing was computed in.
        let level = |value: f64| match value {
            _ if value.is_finite() => Some((scale.part(value) * LEVELS as f64).round() as usize),
            _ if value.is_nan() => Some(LEVELS + 1),
            _ => None,
        };
        let mut paths = vec![String::new(); LEVELS + 2];
        for (j, row) in self.rows.iter().enumerate() {
            let mut start = 0;
            for run in row.chunk_by(|a, b| level(*a) == level(*b)) {
                if let Some(level) = level(run[0]) {
                    // Writing to a string does not fail.
                    let _ = write!(paths[level], "M{start} {j}h{0}v1h-{0}z", run.len());
                }
                start += run.len();
            }
        }
        let bottom = place.height - place.margin_bottom;
        scene.add(Primitive::GroupStart {
            transform: Some(format!(
                "translate({},{bottom}) scale({},{})",
                place.margin_left,
                place.plot_width() / columns as f64,
                -place.plot_height() / self.rows.len() as f64,
            )),
            title: None,
            extra_attrs: Some(r#"shape-rendering="crispEdges""#.to_owned()),
        });
        for (i, path) in paths.into_iter().enumerate() {
            if !path.is_empty() {
                let color = match i {
                    ..=LEVELS => scale.color(i as f64 / LEVELS as f64),
                    _ => palette::NO_VALUE.to_owned(),
                };
                scene.add(filled(path, &color));
            }
        }
        scene.add(Primitive::GroupEnd);
    }

    /// Texts in the middle of their cells, white where the colour is dark.
    fn add_texts(&self, scene: &mut Scene, place: &ComputedLayout, scale: Scale) {
        let bottom = place.height - place.margin_bottom;
        let height = place.plot_height() / self.rows.len().max(1) as f64;
        for (j, (texts, values)) in self.texts.iter().zip(&self.rows).enumerate() {
            let width = place.plot_width() / values.len().max(1) as f64;
            for (i, (content, value)) in texts.iter().zip(values).enumerate() {
                let x = place.margin_left + (i as f64 + 0.5) * width;
                let y = bottom - (j as f64 + 0.5) * height;
                let color = scale.is_dark(*value).then(|| Color::from("white"));
                let mut label = text((x, y + 5.0), content, (14, TextAnchor::Middle, None));
                if let Primitive::Text {
                    color: of_label, ..
                } = &mut label
                {
                    *of_label = color;
                }
                scene.add(label);
            }
        }
    }

    /// Vertical lines, and the border that the cells have covered.
    fn add_lines(&self, scene: &mut Scene, place: &ComputedLayout) {
        let (left, top) = (place.margin_left, place.margin_top);
        let (right, bottom) = (left + place.plot_width(), top + place.plot_height());
        for &x in &self.vertical_lines {
            let x = place.map_x(x);
            scene.add(line((x, top), (x, bottom), 1.2));
        }
        scene.add(border(left, top, right - left, bottom - top));
    }
}
