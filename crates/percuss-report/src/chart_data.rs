//! A chart of any kind, and what it holds as data, for a page that draws it itself.

use serde::Serialize;

use crate::{
    AreaChart, Axis, Bar, BarRows, Figure, HeatMap, Histogram, LineChart, Mark, RowChart, Series,
    Style, chart::dashes, palette,
};

/// A chart of any kind.
#[derive(Debug, Clone, PartialEq)]
pub enum Chart {
    /// Lines and markers.
    Lines(LineChart),
    /// Areas that stand on each other.
    Areas(AreaChart),
    /// A signed quantity over two axes.
    Map(HeatMap),
    /// A value a row.
    Rows(RowChart),
    /// How often values fall into intervals.
    Histogram(Histogram),
    /// Horizontal bars in named rows.
    Bars(BarRows),
}

impl From<LineChart> for Chart {
    fn from(chart: LineChart) -> Self {
        Self::Lines(chart)
    }
}

impl From<AreaChart> for Chart {
    fn from(chart: AreaChart) -> Self {
        Self::Areas(chart)
    }
}

impl From<HeatMap> for Chart {
    fn from(chart: HeatMap) -> Self {
        Self::Map(chart)
    }
}

impl From<RowChart> for Chart {
    fn from(chart: RowChart) -> Self {
        Self::Rows(chart)
    }
}

impl From<Histogram> for Chart {
    fn from(chart: Histogram) -> Self {
        Self::Histogram(chart)
    }
}

impl From<BarRows> for Chart {
    fn from(chart: BarRows) -> Self {
        Self::Bars(chart)
    }
}

/// What a chart holds. Numbers have the precision of a drawing, seven digits; what is no number is null.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChartData {
    /// File stem of the figure.
    name: String,
    title: String,
    caption: String,
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
        marks: Vec<MarkData>,
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
        rows: Vec<RowData>,
        marks: Vec<MarkData>,
    },
    Histogram {
        /// Middles of the intervals, which are of one width.
        middles: Vec<f32>,
        width: f32,
        /// Part of the values in each.
        parts: Vec<f32>,
        color: &'static str,
        marks: Vec<MarkData>,
    },
    Bars {
        lanes: usize,
        rows: Vec<BarRowData>,
        /// What colours stand for.
        colors: Vec<(String, String)>,
        marks: Vec<MarkData>,
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
struct MarkData {
    name: String,
    value: f32,
    vertical: bool,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct AreaData {
    name: String,
    color: String,
    heights: Vec<f32>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct RowData {
    name: String,
    color: String,
    value: f32,
    range: Option<(f32, f32)>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct BarRowData {
    name: String,
    bars: Vec<BarData>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct BarData {
    ends: (f32, f32),
    color: String,
    lane: usize,
    interval: Option<(f32, f32)>,
    text: String,
}

impl Chart {
    /// File stem of its figure.
    pub fn name(&self) -> &str {
        match self {
            Self::Lines(chart) => &chart.name,
            Self::Areas(chart) => &chart.name,
            Self::Map(chart) => &chart.name,
            Self::Rows(chart) => &chart.name,
            Self::Histogram(chart) => &chart.name,
            Self::Bars(chart) => &chart.name,
        }
    }

    /// Draws the chart.
    pub fn draw(&self) -> Figure {
        match self {
            Self::Lines(chart) => chart.draw(),
            Self::Areas(chart) => chart.draw(),
            Self::Map(chart) => chart.draw(),
            Self::Rows(chart) => chart.draw(),
            Self::Histogram(chart) => chart.draw(),
            Self::Bars(chart) => chart.draw(),
        }
    }

    /// What the chart holds.
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
        range: range.map(pair),
        names: axis.names.clone(),
    }
}

fn pair(ends: (f64, f64)) -> (f32, f32) {
    (ends.0 as f32, ends.1 as f32)
}

fn single(values: impl IntoIterator<Item = f64>) -> Vec<f32> {
    values.into_iter().map(|value| value as f32).collect()
}

fn marks(marks: &[Mark]) -> Vec<MarkData> {
    let data = |mark: &Mark| MarkData {
        name: mark.name.clone(),
        value: mark.value as f32,
        vertical: mark.vertical,
    };
    marks.iter().map(data).collect()
}

fn lines(chart: &LineChart) -> ChartData {
    let extents = chart.extents();
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
            name: series.name.clone(),
            color: chart.color(index),
            dashes: dashes(series),
            line: !matches!(series.style, Style::Markers | Style::Cloud),
            markers: series.style.has_markers(),
            width: series.width as f32,
            x: (!shared).then(|| single(series.points.iter().map(|point| point.0))),
            y: single(series.points.iter().map(|point| point.1)),
            errors: series.errors.iter().copied().map(pair).collect(),
            band: series.band.iter().copied().map(pair).collect(),
        }
    });
    ChartData {
        name: chart.name.clone(),
        title: chart.title.clone(),
        caption: chart.caption.clone(),
        x: axis(&chart.x, extents.0),
        y: axis(&chart.y, extents.1),
        content: Content::Lines {
            series: series.collect(),
            marks: marks(&chart.marks),
            true_to_scale: chart.true_to_scale,
        },
    }
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
    let extents = chart.extents();
    ChartData {
        name: chart.name.clone(),
        title: chart.title.clone(),
        caption: chart.caption.clone(),
        x: axis(&chart.x, extents.0),
        y: axis(&chart.y, extents.1),
        content: Content::Areas {
            positions: single(chart.positions.iter().copied()),
            areas: chart.areas.iter().enumerate().map(area).collect(),
        },
    }
}

fn map(chart: &HeatMap) -> ChartData {
    let (cells, colors) = chart.codes();
    ChartData {
        name: chart.name.clone(),
        title: chart.title.clone(),
        caption: chart.caption.clone(),
        x: axis(&chart.x, chart.ranges[0]),
        y: axis(&chart.y, chart.ranges[1]),
        content: Content::Map {
            columns: chart.rows.first().map_or(0, Vec::len),
            cells,
            colors,
            no_value: palette::NO_VALUE,
            value_label: chart.value_label.clone(),
            ends: pair(chart.ends()),
            vertical_lines: single(chart.vertical_lines.iter().copied()),
        },
    }
}

fn rows(chart: &RowChart) -> ChartData {
    let rows = chart.rows.iter().map(|row| RowData {
        name: row.name.clone(),
        color: row.color.clone(),
        value: row.value as f32,
        range: row.range.map(pair),
    });
    ChartData {
        name: chart.name.clone(),
        title: chart.title.clone(),
        caption: chart.caption.clone(),
        x: axis(&chart.x, chart.extent()),
        y: axis(&Axis::new(""), (0.0, 1.0)),
        content: Content::Rows {
            rows: rows.collect(),
            marks: marks(&chart.marks),
        },
    }
}

fn histogram(chart: &Histogram) -> ChartData {
    let (low, width, parts) = chart.bins();
    let extents = chart.extents();
    let middles = (0..parts.len()).map(|i| low + width * (i as f64 + 0.5));
    ChartData {
        name: chart.name.clone(),
        title: chart.title.clone(),
        caption: chart.caption.clone(),
        x: axis(&chart.x, extents.0),
        y: axis(&Histogram::y(), extents.1),
        content: Content::Histogram {
            middles: single(middles),
            width: width as f32,
            parts: single(parts),
            color: Histogram::color(),
            marks: marks(&chart.marks),
        },
    }
}

fn bars(chart: &BarRows) -> ChartData {
    let bar = |bar: &Bar| BarData {
        ends: pair(bar.ends),
        color: bar.color.clone(),
        lane: bar.lane,
        interval: bar.interval.map(pair),
        text: bar.text.clone(),
    };
    let rows = chart.rows.iter().map(|(name, bars)| BarRowData {
        name: name.clone(),
        bars: bars.iter().map(bar).collect(),
    });
    let (x, extent) = chart.axis();
    ChartData {
        name: chart.name.clone(),
        title: chart.title.clone(),
        caption: chart.caption.clone(),
        x: axis(&x, extent),
        y: axis(&Axis::new(""), (0.0, 1.0)),
        content: Content::Bars {
            lanes: chart.lanes,
            rows: rows.collect(),
            colors: chart.colors.clone(),
            marks: marks(&chart.marks),
        },
    }
}

#[cfg(test)]
mod tests;
