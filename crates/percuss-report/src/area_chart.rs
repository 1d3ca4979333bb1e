//! Charts of stacked areas.

use kuva::plot::StackedAreaPlot;

use crate::{
    Axis, Figure,
    chart_methods::chart_methods,
    frame::{Frame, Head},
    legend::{Entry, Legend},
    palette,
};

/// A chart of stacked areas, the first one at the bottom.
#[derive(Debug, Clone, PartialEq)]
pub struct AreaChart {
    pub(crate) head: Head,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    pub(crate) positions: Vec<f64>,
    pub(crate) areas: Vec<(String, Option<String>, Vec<f64>)>,
}

chart_methods!(AreaChart);

impl AreaChart {
    /// An empty chart: file stem, title, axes and the positions along `x` at which all areas have a value.
    pub fn new(
        name: impl Into<String>,
        title: impl Into<String>,
        x: Axis,
        y: Axis,
        positions: impl IntoIterator<Item = f64>,
    ) -> Self {
        Self {
            head: Head::new(name, title),
            x,
            y,
            positions: positions.into_iter().collect(),
            areas: Vec::new(),
        }
    }

    /// Adds an area: its name, its colour (the next one of [`palette::SERIES`] if none) and its heights.
    pub fn area(
        mut self,
        name: impl Into<String>,
        color: Option<&str>,
        heights: impl IntoIterator<Item = f64>,
    ) -> Self {
        let color = color.map(str::to_owned);
        self.areas
            .push((name.into(), color, heights.into_iter().collect()));
        self
    }

    /// Height of the whole stack at each position.
    pub fn totals(&self) -> Vec<f64> {
        let total = |i: usize| self.areas.iter().filter_map(|area| area.2.get(i)).sum();
        (0..self.positions.len()).map(total).collect()
    }

    /// Smallest and largest value on either axis.
    pub(crate) fn extents(&self) -> ((f64, f64), (f64, f64)) {
        let tops = self.totals().into_iter().chain(std::iter::once(0.0));
        (
            self.x.extent(self.positions.iter().copied()),
            self.y.extent(tops),
        )
    }

    /// Draws the chart.
    pub fn draw(&self) -> Figure {
        let mut plot = StackedAreaPlot::new()
            .with_x(self.positions.iter().copied())
            .with_fill_opacity(1.0)
            .with_strokes(false);
        let mut legend = Vec::new();
        for (index, (name, color, heights)) in self.areas.iter().enumerate() {
            let color = color.as_deref().unwrap_or(palette::series(index));
            plot = plot.with_series(heights.iter().copied()).with_color(color);
            legend.push(Entry::area(name, color, 1.0));
        }
        // The legend lists areas as they stand on each other, the uppermost first.
        legend.reverse();
        let frame = Frame {
            legend: Legend::new(legend),
            ..Frame::new(&self.head, [&self.x, &self.y], self.extents())
        };
        frame.draw(vec![plot.into()], |_, _| {})
    }
}
