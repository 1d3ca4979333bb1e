//! Result versus one parameter, with one curve per value of a second one.

use super::{
    PlotStyle,
    data::{Data, Group},
    label,
};
use crate::{LineChart, Series, Style, names, palette};

/// Largest number of single points.
const POINTS: usize = 4000;
/// Intervals that more points are averaged over.
const INTERVALS: usize = 60;
/// Largest number of curves.
const MOST: usize = 24;
/// How far below zero, or the least value, runs without a value stand, as a part of the range.
const FOOT: f64 = 0.05;
/// Counts runs of one kind.
type CountOf = fn(&Group) -> u32;

/// Symbols of runs without a value.
const CROSS: usize = 4;
const PLUS: usize = 6;

/// Result versus parameter `x`, with one curve per value of parameter `family`.
pub(super) fn chart(data: &Data<'_>, x: usize, family: Option<usize>) -> LineChart {
    let families = family.map_or_else(Vec::new, |family| data.values(family));
    // Values of a distribution, or very many of a list, are too many for a curve each.
    let apart = family.filter(|family| data.is_list(*family) && families.len() <= MOST);
    let places = Places::of(data, x);
    let mut more = Vec::new();
    let others = data
        .varied()
        .into_iter()
        .filter(|i| *i != x && Some(*i) != apart);
    let others: Vec<String> = others
        .map(|i| names::parameter(&data.parameters()[i].key))
        .collect();
    let averaged = match places {
        Places::List(_) => !others.is_empty(),
        Places::Single(_) => false,
        Places::Intervals(..) => true,
    };
    if averaged {
        more.push("lines: means; areas: smallest to largest value".to_owned());
    }
    if !others.is_empty() {
        more.push(format!("over all values of {}", others.join(", ")));
    }
    let mut chart = LineChart::new(
        data.name(PlotStyle::Curves),
        data.title(),
        data.axis(x),
        data.value_axis(),
    );
    if let Some(family) = apart {
        more.push(format!(
            "one curve per value of {}",
            label(&data.parameters()[family])
        ));
    }
    chart = chart.caption(data.caption(&more.join("; ")));
    let inputs = &data.rows.inputs;
    let of_family = |row: usize| {
        apart.map_or(0, |family| {
            families.partition_point(|value| *value < inputs[family][row])
        })
    };
    let groups = data.grouped(|row| (of_family(row), places.number(inputs[x][row], row)));
    let mut curves: Vec<Vec<(f64, Group)>> = vec![Vec::new(); families.len().max(1)];
    for ((of, place), group) in groups {
        curves[of].push((data.at(x, places.at(place)), group));
    }
    let style = match places {
        Places::List(_) if !data.is_numeric(x) => Style::Markers,
        Places::List(_) => Style::LineAndMarkers,
        Places::Single(_) => Style::Cloud,
        Places::Intervals(..) => Style::Line,
    };
    for (symbol, points) in curves.iter().enumerate() {
        let name = apart.map_or_else(String::new, |family| data.curve(family, families[symbol]));
        let mut series = Series::new(name, points.iter().map(|(at, g)| (*at, g.mean())));
        if averaged {
            let end = |end: f64| if end.is_finite() { end } else { f64::NAN };
            series = series.band(points.iter().map(|(_, g)| (end(g.low), end(g.high))));
        }
        chart = chart.series(series.style(style).symbol(symbol));
    }
    // Runs without a value are marked at the lower end of the chart.
    let all = data.all();
    let lowest = all.low.min(0.0);
    let foot = match all.high > lowest {
        true => lowest - FOOT * (all.high - lowest),
        false => lowest,
    };
    let marks: [(&str, usize, &str, CountOf); 2] = [
        ("failed", CROSS, palette::FAILED, |group| group.failed),
        ("without this result", PLUS, palette::MARK, |group| {
            group.without
        }),
    ];
    for (name, symbol, color, count) in marks {
        let all = curves.iter().flatten();
        let marked: Vec<_> = all.filter(|(_, group)| count(group) > 0).collect();
        let runs: u32 = marked.iter().map(|(_, group)| count(group)).sum();
        if runs > 0 {
            let series = Series::new(
                format!("{name} ({runs})"),
                marked.iter().map(|(at, _)| (*at, foot)),
            );
            chart = chart.series(series.style(Style::Markers).symbol(symbol).color(color));
        }
    }
    chart
}

/// Places of runs along the axis of a parameter.
enum Places {
    /// Each at its value, which is one of a list.
    List(Vec<f64>),
    /// Each at its own value.
    Single(Vec<f64>),
    /// In the middle of an interval: least value and width.
    Intervals(f64, f64),
}

impl Places {
    fn of(data: &Data<'_>, x: usize) -> Self {
        let values = data.values(x);
        if data.is_list(x) {
            return Self::List(values);
        }
        match (values.first(), values.last()) {
            (Some(low), Some(high)) if data.rows.values.len() > POINTS => {
                Self::Intervals(*low, (high - low) / INTERVALS as f64)
            }
            _ => Self::Single(data.rows.inputs[x].clone()),
        }
    }

    /// Number of a run's place.
    fn number(&self, value: f64, row: usize) -> usize {
        match self {
            Self::List(values) => values.partition_point(|other| *other < value),
            Self::Single(_) => row,
            Self::Intervals(low, width) => (((value - low) / width) as usize).min(INTERVALS - 1),
        }
    }

    fn at(&self, number: usize) -> f64 {
        match self {
            Self::List(values) | Self::Single(values) => values[number],
            Self::Intervals(low, width) => low + (number as f64 + 0.5) * width,
        }
    }
}
