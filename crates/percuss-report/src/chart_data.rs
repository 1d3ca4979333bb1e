//! Charts of any kind and their data for the page.

use serde::Serialize;

use crate::{
    AreaChart, Axis, Bar, BarRows, Figure, HeatMap, Histogram, LineChart, Mark, RowChart, Series,
    Style, frame::Head, palette, row_chart::Row, single::ends,
};

/// Smallest and largest value on either axis.
type Extents = ((f64, f64), (f64, f64));

/// A chart of any kind.
#[derive(Debug, Clone, PartialEq)]
pub enum Chart {
    /// Lines and markers.
    Lines(LineChart),
    /// Stacked areas.
    Areas(AreaChart),
    /// Colour map of two axes.
    Map(HeatMap),
    /// One value per row.
    Rows(RowChart),
    /// How often values fall into intervals.
    Histogram(Histogram),
    /// Horizontal bars in named rows.
    Bars(BarRows),
}

/// Makes each kind of chart a [`Chart`].
macro_rules! kinds {
    ($($kind:ident: $chart:ty),*) => {$(
        impl From<$chart> for Chart {
            fn from(chart: $chart) -> Self {
                Self::$kind(chart)
            }
        }
    )*

    impl Chart {
        /// File stem of its figure.
        pub fn name(&self) -> &str {
            match self {
                $(Self::$kind(chart) => &chart.head.name,)*
            }
        }

        /// Draws the chart.
        pub fn draw(&self) -> Figure {
            match self {
                $(Self::$kind(chart) => chart.draw(),)*
            }
        }
    }};
}

kinds!(Lines: LineChart, Areas: AreaChart, Map: HeatMap, Rows: RowChart, Histogram: Histogram, Bars: BarRows);

/// Data of a chart. Numbers have seven digits; NaN is null.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChartData {
    #[serde(flatten)]
    head: Head,
    x: AxisData,
    y: AxisData,
    #[serde(flatten)]
    content: Content,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct AxisData {
    label: String,
    log: bool,
    /// Whether a value stands at its negative.
    downward: bool,
    range: Option<(f32, f32)>,
    /// What stands at 1, 2, 3, … in place of numbers.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    names: Vec<String>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum Content {
    Lines {
        series: Vec<SeriesData>,
        marks: Vec<Mark>,
        true_to_scale: bool,
    },
    Areas {
        positions: Vec<f32>,
        areas: Vec<AreaData>,
    },
    Map {
        columns: usize,
        /// A character a cell, row by row, see [`HeatMap::codes`].
        cells: String,
        /// Colours from the lowest code to the highest.
        colors: Vec<String>,
        no_value: &'static str,
        value_label: String,
        /// Values that the first and the last colour stand for.
        ends: (f32, f32),
        vertical_lines: Vec<f32>,
    },
    Rows {
        rows: Vec<Row>,
        marks: Vec<Mark>,
    },
    Histogram {
        /// Middles of the intervals, which are of one width.
        middles: Vec<f32>,
        width: f32,
        /// Part of the values in each.
        parts: Vec<f32>,
        color: &'static str,
        marks: Vec<Mark>,
    },
    Bars {
        lanes: usize,
        rows: Vec<BarRowData>,
        /// What colours stand for.
        colors: Vec<(String, String)>,
        marks: Vec<Mark>,
    },
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct SeriesData {
    name: String,
    color: String,
    /// Lengths of dashes and gaps [px].
    dashes: Option<&'static str>,
    line: bool,
    markers: bool,
    width: f32,
    /// Left out where they are those of the first series.
    #[serde(skip_serializing_if = "Option::is_none")]
    x: Option<Vec<f32>>,
    y: Vec<f32>,
    /// How far error bars reach below and above each point.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    errors: Vec<(f32, f32)>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    band: Vec<(f32, f32)>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct AreaData {
    name: String,
    color: String,
    heights: Vec<f32>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct BarRowData {
    name: String,
    bars: Vec<Bar>,
}

impl Chart {
    /// Data of the chart.
    pub fn data(&self) -> ChartData {
        match self {
            Self::Lines(chart) => lines(chart),
            Self::Areas(chart) => areas(chart),
            Self::Map(chart) => map(chart),
            Self::Rows(chart) => rows(chart),
            Self::Histogram(chart) => histogram(chart),
            Self::Bars(chart) => bars(chart),
        }
    }
}

fn axis(axis: &Axis, extent: (f64, f64)) -> AxisData {
    let range = axis.fixed_range(extent);
    AxisData {
        label: axis.label.clone(),
        log: axis.log,
        downward: axis.downward,
        range: range.map(ends),
        names: axis.names.clone(),
    }
}

fn single(values: impl IntoIterator<Item = f64>) -> Vec<f32> {
    values.into_iter().map(|value| value as f32).collect()
}

fn data(head: &Head, [x, y]: [&Axis; 2], extents: Extents, content: Content) -> ChartData {
    ChartData {
        head: head.clone(),
        x: axis(x, extents.0),
        y: axis(y, extents.1),
        content,
    }
}

fn lines(chart: &LineChart) -> ChartData {
    let first = chart.series.first();
    let same = |series: &Series| {
        first.is_some_and(|first| {
            let (a, b) = (first.points.iter(), series.points.iter());
            a.len() == b.len() && a.zip(b).all(|(a, b)| a.0 == b.0)
        })
    };
    let series = chart.series.iter().enumerate().map(|(index, series)| {
        let shared = index > 0 && same(series);
        SeriesData {
            name: chart.full_name(&series.name, &series.value),
            color: chart.color(index),
            dashes: chart.dashes(index),
            line: !matches!(series.style, Style::Markers | Style::Cloud),
            markers: series.style.has_markers(),
            width: series.width as f32,
            x: (!shared).then(|| single(series.points.iter().map(|point| point.0))),
            y: single(series.points.iter().map(|point| point.1)),
            errors: series.errors.iter().copied().map(ends).collect(),
            band: series.band.iter().copied().map(ends).collect(),
        }
    });
    let marks = chart.marks.iter().map(|mark| Mark {
        name: chart.full_name(&mark.name, &mark.shown),
        ..mark.clone()
    });
    let content = Content::Lines {
        series: series.collect(),
        marks: marks.collect(),
        true_to_scale: chart.true_to_scale,
    };
    data(&chart.head, [&chart.x, &chart.y], chart.extents(), content)
}

fn areas(chart: &AreaChart) -> ChartData {
    let area = |(index, (name, color, heights)): (usize, &(String, Option<String>, Vec<f64>))| {
        let color = color.as_deref().unwrap_or(palette::series(index));
        AreaData {
            name: name.clone(),
            color: color.to_owned(),
            heights: single(heights.iter().copied()),
        }
    };
    let content = Content::Areas {
        positions: single(chart.positions.iter().copied()),
        areas: chart.areas.iter().enumerate().map(area).collect(),
    };
    data(&chart.head, [&chart.x, &chart.y], chart.extents(), content)
}

fn map(chart: &HeatMap) -> ChartData {
    let (cells, colors) = chart.codes();
    let content = Content::Map {
        columns: chart.rows.first().map_or(0, Vec::len),
        cells,
        colors,
        no_value: palette::NO_VALUE,
        value_label: chart.value_label.clone(),
        ends: ends(chart.ends()),
        vertical_lines: single(chart.vertical_lines.iter().copied()),
    };
    data(&chart.head, [&chart.x, &chart.y], chart.extents(), content)
}

fn rows(chart: &RowChart) -> ChartData {
    let content = Content::Rows {
        rows: chart.rows.clone(),
        marks: chart.marks.clone(),
    };
    named_rows(&chart.head, &chart.x, chart.extent(), content)
}

fn histogram(chart: &Histogram) -> ChartData {
    let (low, width, parts) = chart.bins();
    let middles = (0..parts.len()).map(|i| low + width * (i as f64 + 0.5));
    let content = Content::Histogram {
        middles: single(middles),
        width: width as f32,
        parts: single(parts),
        color: Histogram::color(),
        marks: chart.marks.clone(),
    };
    let axes = [&chart.x, &Histogram::y()];
    data(&chart.head, axes, chart.extents(), content)
}

fn bars(chart: &BarRows) -> ChartData {
    let rows = chart.rows.iter().cloned();
    let content = Content::Bars {
        lanes: chart.lanes,
        rows: rows.map(|(name, bars)| BarRowData { name, bars }).collect(),
        colors: chart.colors.clone(),
        marks: chart.marks.clone(),
    };
    let (x, extent) = chart.axis();
    named_rows(&chart.head, &x, extent, content)
}

/// Data of a chart whose rows have names in place of an axis.
fn named_rows(head: &Head, x: &Axis, extent: (f64, f64), content: Content) -> ChartData {
    data(head, [x, &Axis::new("")], (extent, (0.0, 1.0)), content)
}

#[cfg(test)]
mod tests;
