//! Heat maps of a signed quantity over two axes.

use std::fmt::Write;

use kuva::plot::LinePlot;
use kuva::render::{
    color::Color,
    layout::ComputedLayout,
    render::{PathData, Primitive, Scene, TextAnchor},
    render_utils::generate_ticks,
};

use crate::{
    Axis, Figure,
    frame::{Frame, HEIGHT, tick_label},
    palette,
};

/// Colours on either side of zero.
const LEVELS: i32 = 32;
/// Character that stands for the lowest level.
const FIRST_CODE: u8 = b'0';
/// Space at the right for the colour bar, its numbers and its label [px].
const BAR_MARGIN: f64 = 118.0;
/// Distance of the colour bar from the plot, and its width [px].
const BAR_PLACE: (f64, f64) = (20.0, 18.0);

/// A heat map on a regular grid, with colours that diverge from zero and a colour bar.
#[derive(Debug, Clone, PartialEq)]
pub struct HeatMap {
    pub(crate) name: String,
    pub(crate) title: String,
    pub(crate) caption: String,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    pub(crate) ranges: [(f64, f64); 2],
    pub(crate) value_label: String,
    pub(crate) rows: Vec<Vec<f64>>,
    pub(crate) vertical_lines: Vec<f64>,
    texts: Vec<Vec<String>>,
    limit: Option<f64>,
    height: f64,
}

impl HeatMap {
    /// A heat map: file stem, title, axes, the ranges of `x` and `y` that the grid covers, the label of the colour bar
    /// and the rows of the grid, the one with the smallest `y` first. A value that is not a number is drawn grey.
    pub fn new(
        [name, title]: [&str; 2],
        [x, y]: [Axis; 2],
        ranges: [(f64, f64); 2],
        value_label: impl Into<String>,
        rows: Vec<Vec<f64>>,
    ) -> Self {
        Self {
            name: name.to_owned(),
            title: title.to_owned(),
            caption: String::new(),
            x: x.range(ranges[0].0, ranges[0].1),
            y: y.range(ranges[1].0, ranges[1].1),
            ranges,
            value_label: value_label.into(),
            rows,
            vertical_lines: Vec::new(),
            texts: Vec::new(),
            limit: None,
            height: HEIGHT,
        }
    }

    /// Sets the line below the title.
    pub fn caption(mut self, caption: impl Into<String>) -> Self {
        self.caption = caption.into();
        self
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
        self.limit = Some(limit);
        self
    }

    /// Sets the height of the figure [px].
    pub fn height(mut self, height: f64) -> Self {
        self.height = height;
        self
    }

    /// Draws the heat map.
    pub fn draw(&self) -> Figure {
        let frame = Frame {
            name: &self.name,
            title: &self.title,
            caption: &self.caption,
            x: &self.x,
            y: &self.y,
            x_extent: self.ranges[0],
            y_extent: self.ranges[1],
            height: self.height,
            right_margin: Some(BAR_MARGIN),
            legend: Vec::new(),
            marks: Vec::new(),
        };
        let limit = self.strongest();
        // Axes are drawn only for a plot, so there is one without content.
        frame.draw(vec![LinePlot::new().into()], |scene, place| {
            self.add_cells(scene, place, limit);
            self.add_texts(scene, place, limit);
            self.add_lines(scene, place);
            self.add_bar(scene, place, limit);
        })
    }

    /// Value with the strongest colour.
    pub(crate) fn strongest(&self) -> f64 {
        self.limit.unwrap_or_else(|| self.largest())
    }

    /// The cells as text, a character a cell, and the colours that they stand for: [`FIRST_CODE`] is the first colour, the next
    /// character the next one, and a space a cell without value.
    pub(crate) fn codes(&self) -> (String, Vec<String>) {
        let limit = self.strongest();
        let code = |value: &f64| match level(*value, limit) {
            None => ' ',
            Some(level) => char::from(FIRST_CODE + (level + LEVELS) as u8),
        };
        let colors = (-LEVELS..=LEVELS).map(level_color);
        (
            self.rows.iter().flatten().map(code).collect(),
            colors.collect(),
        )
    }

    /// All but one value in 200 lie within it, so that a spike does not bleach the rest.
    fn largest(&self) -> f64 {
        let mut sizes: Vec<f64> = self.rows.iter().flatten().map(|v| v.abs()).collect();
        sizes.retain(|size| size.is_finite());
        sizes.sort_by(f64::total_cmp);
        match sizes.get(sizes.len().saturating_sub(1 + sizes.len() / 200)) {
            Some(&size) if size > 0.0 => size,
            _ => 1.0,
        }
    }

    /// One path for each colour, made of runs of cells of that colour, on a grid of whole numbers: small and seamless.
    fn add_cells(&self, scene: &mut Scene, place: &ComputedLayout, limit: f64) {
        let columns = self.rows.first().map_or(0, Vec::len);
        if columns == 0 {
            return;
        }
        let level = |value: f64| level(value, limit);
        let index = |level: Option<i32>| level.map_or(0, |level| (level + LEVELS + 1) as usize);
        let mut paths = vec![String::new(); 2 * LEVELS as usize + 2];
        for (j, row) in self.rows.iter().enumerate() {
            let mut start = 0;
            for run in row.chunk_by(|a, b| level(*a) == level(*b)) {
                // Writing to a string does not fail.
                let _ = write!(
                    paths[index(level(run[0]))],
                    "M{start} {j}h{0}v1h-{0}z",
                    run.len()
                );
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
                    0 => palette::NO_VALUE.to_owned(),
                    _ => level_color(i as i32 - LEVELS - 1),
                };
                scene.add(filled(path, &color));
            }
        }
        scene.add(Primitive::GroupEnd);
    }

    /// Texts in the middle of their cells, white where the colour is dark.
    fn add_texts(&self, scene: &mut Scene, place: &ComputedLayout, limit: f64) {
        let bottom = place.height - place.margin_bottom;
        let height = place.plot_height() / self.rows.len().max(1) as f64;
        for (j, (texts, values)) in self.texts.iter().zip(&self.rows).enumerate() {
            let width = place.plot_width() / values.len().max(1) as f64;
            for (i, (content, value)) in texts.iter().zip(values).enumerate() {
                let x = place.margin_left + (i as f64 + 0.5) * width;
                let y = bottom - (j as f64 + 0.5) * height;
                let dark = (value / limit).abs() > 0.7;
                let color = dark.then(|| Color::from("white"));
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

    fn add_bar(&self, scene: &mut Scene, place: &ComputedLayout, limit: f64) {
        let left = place.margin_left + place.plot_width() + BAR_PLACE.0;
        let (top, height) = (place.margin_top, place.plot_height());
        let steps = 2 * LEVELS + 1;
        let step = height / f64::from(steps);
        for i in 0..steps {
            let color = palette::diverging(f64::from(LEVELS - i) / f64::from(LEVELS));
            let (y, next) = (top + step * f64::from(i), (step + 0.5).min(height));
            let next = next.min(top + height - y);
            scene.add(filled(
                format!(
                    "M{left:.2} {y:.2}h{}v{next:.2}h-{}z",
                    BAR_PLACE.1, BAR_PLACE.1
                ),
                &color,
            ));
        }
        scene.add(border(left, top, BAR_PLACE.1, height));
        let right = left + BAR_PLACE.1;
        for value in generate_ticks(-limit, limit, 7) {
            let y = top + 0.5 * height * (1.0 - value / limit);
            scene.add(line((right, y), (right + 4.0, y), 1.0));
            scene.add(text(
                (right + 7.0, y + 4.0),
                &tick_label(value),
                (12, TextAnchor::Start, None),
            ));
        }
        scene.add(text(
            (place.width - 12.0, top + 0.5 * height),
            &self.value_label,
            (14, TextAnchor::Middle, Some(-90.0)),
        ));
    }
}

/// Level of a value between minus and plus the limit.
fn level(value: f64, limit: f64) -> Option<i32> {
    let scaled = (value / limit).clamp(-1.0, 1.0) * f64::from(LEVELS);
    value.is_finite().then(|| scaled.round() as i32)
}

fn level_color(level: i32) -> String {
    palette::diverging(f64::from(level) / f64::from(LEVELS))
}

fn filled(path: String, color: &str) -> Primitive {
    Primitive::Path(Box::new(PathData {
        d: path,
        fill: Some(Color::from(color)),
        stroke: Color::None,
        stroke_width: 0.0,
        opacity: None,
        stroke_dasharray: None,
    }))
}

fn border(x: f64, y: f64, width: f64, height: f64) -> Primitive {
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

fn line(from: (f64, f64), to: (f64, f64), width: f64) -> Primitive {
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

fn text(
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
