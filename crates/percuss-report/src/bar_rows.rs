//! Charts of horizontal bars in named rows.
//!
//! The bars of the plotting library all start at zero and bear no texts.

use kuva::plot::LinePlot;
use kuva::render::render::TextAnchor;
use serde::Serialize;

use crate::{
    Axis, Figure, Mark,
    chart_methods::chart_methods,
    figure_width,
    frame::{Frame, Head},
    legend::{Entry, Legend},
    mark,
    primitives::{bar, border, line, text},
    single,
    text::plain,
};

/// Most characters of a name beside its row.
const NAME_CHARS: usize = 46;
/// Height of what surrounds the rows [px].
const SURROUNDINGS: f64 = 150.0;
/// What surrounds the rows of a narrow figure at its sides [px].
const NARROW_SIDES: f64 = 95.0;
/// Half the length of the caps of an interval [px].
const CAP: f64 = 3.5;
/// Size of the texts at the ends of bars, and their distance from it [px].
const TEXT_SIZE: u32 = 11;
const TEXT_GAP: f64 = 6.0;
/// Width of a character [px].
const TEXT_WIDTH: f64 = 6.6;

/// Rows of a chart: height [px], the part that the bars fill, and the distance of its middle from that of the row.
struct Rows {
    height: f64,
    filled: f64,
    shift: f64,
}

/// Names stand beside the rows.
const BESIDE: Rows = Rows {
    height: 42.0,
    filled: 0.66,
    shift: 0.0,
};
/// Names stand above the bars, where those need the width.
const ABOVE: Rows = Rows {
    height: 56.0,
    filled: 0.46,
    shift: -0.18,
};

/// A bar of a row.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Bar {
    /// Where it starts and where it ends.
    #[serde(serialize_with = "single::pair")]
    pub ends: (f64, f64),
    /// Its colour.
    pub color: String,
    /// Lane of the row that it lies in, counted from the top.
    pub lane: usize,
    /// Interval drawn over its end.
    #[serde(serialize_with = "single::range")]
    pub interval: Option<(f64, f64)>,
    /// Text beyond its end.
    pub text: String,
}

/// A chart of horizontal bars in named rows, the first row at the top.
#[derive(Debug, Clone, PartialEq)]
pub struct BarRows {
    pub(crate) head: Head,
    x: Axis,
    pub(crate) lanes: usize,
    pub(crate) rows: Vec<(String, Vec<Bar>)>,
    pub(crate) colors: Vec<(String, String)>,
    pub(crate) marks: Vec<Mark>,
}

chart_methods!(BarRows, marks);

impl BarRows {
    /// An empty chart: file stem, title, the axis of the values and the number of lanes in a row.
    pub fn new(name: impl Into<String>, title: impl Into<String>, x: Axis, lanes: usize) -> Self {
        Self {
            head: Head::new(name, title),
            x,
            lanes: lanes.max(1),
            rows: Vec::new(),
            colors: Vec::new(),
            marks: Vec::new(),
        }
    }

    /// Adds a row.
    pub fn row(mut self, name: impl Into<String>, bars: impl IntoIterator<Item = Bar>) -> Self {
        self.rows.push((name.into(), bars.into_iter().collect()));
        self
    }

    /// Says in the legend what a colour stands for.
    pub fn color(mut self, name: impl Into<String>, color: impl Into<String>) -> Self {
        self.colors.push((name.into(), color.into()));
        self
    }

    /// The axis with room for the texts, and the extent of what it shows.
    pub(crate) fn axis(&self) -> (Axis, (f64, f64)) {
        let bars = self.rows.iter().flat_map(|row| &row.1);
        let values = bars.flat_map(|bar| {
            let (low, high) = bar.interval.unwrap_or(bar.ends);
            [bar.ends.0, bar.ends.1, low, high]
        });
        let marks = self.marks.iter().map(|mark| mark.value);
        let extent = self.x.extent(values.chain(marks));
        let x = self.x.clone().range_around(extent, self.space_for_texts());
        (x, extent)
    }

    /// Draws the chart.
    pub fn draw(&self) -> Figure {
        let count = self.rows.len().max(1) as f64;
        let (x, extent) = self.axis();
        let narrow = figure_width::is_narrow();
        let rows = if narrow { &ABOVE } else { &BESIDE };
        let beside = |name: &str| match narrow {
            true => String::new(),
            false => plain(name, NAME_CHARS),
        };
        let names = self.rows.iter().rev().map(|row| beside(&row.0));
        let y = Axis::new("").range(0.5, count + 0.5).names(names);
        let legend = self
            .colors
            .iter()
            .map(|(name, color)| Entry::area(name, color, 1.0));
        let frame = Frame {
            height: SURROUNDINGS + rows.height * count.max(2.0),
            legend: Legend::new(legend.chain(mark::entries(&self.marks))),
            ..Frame::new(&self.head, [&x, &y], (extent, (0.5, count + 0.5)))
        };
        // Axes are drawn only for a plot, so there is one without content.
        frame.draw(vec![LinePlot::new().into()], |scene, place| {
            let height = rows.filled / self.lanes as f64;
            for (i, (name, bars)) in self.rows.iter().enumerate() {
                let middle = count - i as f64 + rows.shift;
                if narrow {
                    let chars = ((place.plot_width() - TEXT_GAP) / TEXT_WIDTH) as usize;
                    let (left, low) = (place.margin_left, middle + 0.5 * rows.filled);
                    scene.add(text(
                        (left + TEXT_GAP, place.map_y(low) - TEXT_GAP),
                        &plain(name, chars),
                        (TEXT_SIZE, TextAnchor::Start, None),
                    ));
                }
                for one in bars {
                    let top = middle + 0.5 * rows.filled - height * one.lane as f64;
                    let (from, to) = (place.map_x(one.ends.0), place.map_x(one.ends.1));
                    let (above, below) = (place.map_y(top), place.map_y(top - height));
                    let middle = 0.5 * (above + below);
                    scene.add(bar((from, above + 1.0), (to, below - 1.0), &one.color));
                    let mut ends = (to.min(from), to.max(from));
                    if let Some((low, high)) = one.interval {
                        let (low, high) = (place.map_x(low), place.map_x(high));
                        scene.add(line((low, middle), (high, middle), 1.2));
                        for x in [low, high] {
                            scene.add(line((x, middle - CAP), (x, middle + CAP), 1.2));
                        }
                        ends = (ends.0.min(low), ends.1.max(high));
                    }
                    let (x, anchor) = match to < from {
                        true => (ends.0 - TEXT_GAP, TextAnchor::End),
                        false => (ends.1 + TEXT_GAP, TextAnchor::Start),
                    };
                    scene.add(text(
                        (x, middle + 4.0),
                        &one.text,
                        (TEXT_SIZE, anchor, None),
                    ));
                }
            }
            for across in mark::lines(&self.marks, place) {
                scene.add(across);
            }
            let (left, top) = (place.margin_left, place.margin_top);
            scene.add(border(left, top, place.plot_width(), place.plot_height()));
        })
    }

    /// Space that texts take at the left and at the right of the bars, in parts of the space of the bars.
    fn space_for_texts(&self) -> (f64, f64) {
        // What names, legend and margins leave of the canvas, near enough [px].
        let (plot_width, most) = match figure_width::is_narrow() {
            true => (figure_width::pixels() - NARROW_SIDES, 0.4),
            false => (0.37 * figure_width::pixels(), 0.3),
        };
        let all = || self.rows.iter().flat_map(|row| &row.1);
        let longest = |left: bool| {
            let texts = all().filter(|bar| (bar.ends.1 < bar.ends.0) == left);
            texts.map(|bar| bar.text.chars().count()).max().unwrap_or(0) as f64
        };
        let part = |chars: f64| match chars {
            0.0 => 0.03,
            chars => ((chars * TEXT_WIDTH + 2.0 * TEXT_GAP) / plot_width).min(most),
        };
        let (left, right) = (part(longest(true)), part(longest(false)));
        let bars = 1.0 - left - right;
        (left / bars, right / bars)
    }
}
