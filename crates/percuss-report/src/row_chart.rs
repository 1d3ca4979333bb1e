//! Charts of one value per row, with its range.

use kuva::plot::forest::{ForestPlot, ForestRow};
use serde::Serialize;

use crate::{
    Axis, Figure, Mark,
    chart_methods::chart_methods,
    frame::{Frame, Head},
    legend::Legend,
    mark, single,
    text::plain,
};

/// Most characters of a name.
const NAME_CHARS: usize = 30;
/// Height of a row, and of what surrounds the rows [px].
const ROW: f64 = 30.0;
const SURROUNDINGS: f64 = 150.0;
/// Half the size of the square at a value [px].
const MARKER: f64 = 5.0;

/// A chart of named values, the first one at the top.
#[derive(Debug, Clone, PartialEq)]
pub struct RowChart {
    pub(crate) head: Head,
    pub(crate) x: Axis,
    pub(crate) rows: Vec<Row>,
    pub(crate) marks: Vec<Mark>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Row {
    pub(crate) name: String,
    #[serde(serialize_with = "single::number")]
    pub(crate) value: f64,
    #[serde(serialize_with = "single::range")]
    pub(crate) range: Option<(f64, f64)>,
    pub(crate) color: String,
}

chart_methods!(RowChart, marks);

impl RowChart {
    /// An empty chart: file stem, title and the axis of the values.
    pub fn new(name: impl Into<String>, title: impl Into<String>, x: Axis) -> Self {
        Self {
            head: Head::new(name, title),
            x,
            rows: Vec::new(),
            marks: Vec::new(),
        }
    }

    /// Adds a row: its name, its value, the ends of its range and its colour. Values that are not finite are left out.
    pub fn row(
        mut self,
        name: impl Into<String>,
        value: f64,
        range: Option<(f64, f64)>,
        color: impl Into<String>,
    ) -> Self {
        if value.is_finite() {
            self.rows.push(Row {
                name: name.into(),
                value,
                range: range.filter(|(low, high)| low.is_finite() && high.is_finite()),
                color: color.into(),
            });
        }
        self
    }

    /// Smallest and largest value.
    pub(crate) fn extent(&self) -> (f64, f64) {
        let values = self.rows.iter().flat_map(|row| {
            let (low, high) = row.range.unwrap_or((row.value, row.value));
            [row.value, low, high]
        });
        self.x
            .extent(values.chain(self.marks.iter().map(|mark| mark.value)))
    }

    /// Draws the chart.
    pub fn draw(&self) -> Figure {
        let count = self.rows.len() as f64;
        let mut plot = ForestPlot::new();
        plot.null_value = None;
        plot.marker_size = MARKER;
        plot.whisker_width = 2.5;
        plot.cap_size = 4.0;
        plot.rows = self
            .rows
            .iter()
            .map(|row| {
                let (low, high) = row.range.unwrap_or((row.value, row.value));
                let mut shown = ForestRow::new("", row.value, low, high);
                shown.color = Some(row.color.clone());
                shown
            })
            .collect();
        let names = self.rows.iter().rev();
        let y = Axis::new("")
            .range(0.5, count.max(1.0) + 0.5)
            .names(names.map(|row| plain(&row.name, NAME_CHARS)));
        let extents = (self.extent(), (0.5, count.max(1.0) + 0.5));
        let frame = Frame {
            height: SURROUNDINGS + ROW * count.max(2.0),
            legend: Legend::new(mark::entries(&self.marks)),
            marks: mark::reference_lines(&self.marks),
            ..Frame::new(&self.head, [&self.x, &y], extents)
        };
        frame.draw(vec![plot.into()], |_, _| {})
    }
}
