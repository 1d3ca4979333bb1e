//! Figures of a sweep whose rows are in memory.

use percuss::sweep::{Sweep, SweepRow};

use super::{
    super::{columns::columns, manifest::Manifest, rows::Rows},
    Choice, Data, PlotStyle, curves, map, parallel, quantity,
};
use crate::{Chart, Figure, column::Column};

/// Chart of a result of a sweep.
#[derive(Debug, Clone)]
pub struct SweepChart {
    /// Column of the number.
    pub quantity: String,
    /// Style.
    pub style: PlotStyle,
    /// Chart.
    pub chart: Chart,
}

/// Charts of every number that comes of a sweep, as [`plot`](super::plot) draws it over the parameter that is named first: in the
/// style that suits what is varied, then, of two parameters or more, in the other one. Parallel coordinates are no chart: [`parallel`](parallel_figure) draws them.
pub fn charts(sweep: &Sweep, rows: &[SweepRow]) -> Vec<SweepChart> {
    let manifest = Manifest::new(sweep);
    let of_number = |number: &SweepNumber| {
        let quantity = &number.quantity;
        let data = Data::new(&manifest, quantity, Rows::of(sweep, rows, quantity));
        let varied = data.varied();
        // What is named first runs from left to right.
        let x = varied.iter().copied().find(|i| data.is_numeric(*i));
        let second = varied.iter().copied().find(|i| Some(*i) != x);
        let second = second.filter(|_| varied.len() == 2);
        let suited = Choice::of(&data, None, x, None).style;
        let styles = match (suited, varied.len()) {
            (PlotStyle::Map, _) => &[PlotStyle::Map, PlotStyle::Curves][..],
            (_, 2..) => &[PlotStyle::Curves, PlotStyle::Map],
            _ => &[PlotStyle::Curves],
        };
        let drawn = |style: &PlotStyle| {
            let choice = Choice::of(&data, Some(*style), x, second);
            let chart: Chart = match (style, choice.y) {
                (PlotStyle::Map, Some(y)) => map::chart(&data, choice.x, y).into(),
                _ => curves::chart(&data, choice.x, choice.y).into(),
            };
            SweepChart {
                quantity: quantity.clone(),
                style: *style,
                chart,
            }
        };
        styles.iter().map(drawn).collect::<Vec<_>>()
    };
    numbers(sweep, rows).iter().flat_map(of_number).collect()
}

/// Parallel coordinates of the first number that comes of a sweep of more than two parameters.
pub fn parallel_figure(sweep: &Sweep, rows: &[SweepRow]) -> Option<Figure> {
    let manifest = Manifest::new(sweep);
    let quantity = &numbers(sweep, rows).into_iter().next()?.quantity;
    let data = Data::new(&manifest, quantity, Rows::of(sweep, rows, quantity));
    (data.varied().len() > 2).then(|| parallel::draw(&data))
}

/// Result of the runs of a sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepNumber {
    /// Column.
    pub quantity: String,
    /// Name with the unit in parentheses.
    pub label: String,
    /// Value per row.
    pub values: Vec<Option<f64>>,
}

/// Results of the runs: neither inputs nor columns without values.
pub fn numbers(sweep: &Sweep, rows: &[SweepRow]) -> Vec<SweepNumber> {
    let manifest = Manifest::new(sweep);
    let number = |column: &Column<SweepRow>| SweepNumber {
        quantity: column.name().to_owned(),
        label: quantity::label(column.name()),
        values: rows.iter().map(|row| column.number(row)).collect(),
    };
    columns(sweep)
        .iter()
        .filter(|column| column.kind() != "text" && quantity::is_result(&manifest, column.name()))
        .map(number)
        .filter(|number| number.values.iter().any(Option::is_some))
        .collect()
}
