//! Result as colour versus two parameters.

use super::{
    PlotStyle,
    data::{Data, is_even, names},
    label, quantity,
};
use crate::{Axis, HeatMap};

/// Largest number of cells along an axis of a map without lists.
const MOST_CELLS: f64 = 60.0;
/// Mean number of runs per cell of such a map.
const RUNS: f64 = 8.0;

/// Result versus parameters `x` and `y`.
pub(super) fn chart(data: &Data<'_>, x: usize, y: usize) -> HeatMap {
    let sides = [Side::of(data, x), Side::of(data, y)];
    let inputs = &data.rows.inputs;
    let cell = |row| (sides[1].cell(inputs[y][row]), sides[0].cell(inputs[x][row]));
    let mut cells = vec![vec![f64::INFINITY; sides[0].cells]; sides[1].cells];
    let (mut most, mut empty) = (0, 0);
    for ((j, i), group) in data.grouped(cell) {
        cells[j][i] = group.mean();
        most = most.max(group.count);
        empty += u32::from(group.count == 0);
    }
    let mut more = Vec::new();
    if most > 1 {
        more.push(format!("each colour is the mean of up to {most} runs"));
    }
    if empty > 0 {
        more.push("grey: no run has a value".to_owned());
    }
    if cells.iter().flatten().any(|value| value.is_infinite()) {
        more.push("white: no run".to_owned());
    }
    let shown = cells.iter().flatten().filter(|value| value.is_finite());
    let ends = shown.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(*value), high.max(*value))
    });
    let [horizontal, vertical] = sides;
    let map = HeatMap::new(
        [&data.name(PlotStyle::Map), &data.title()],
        [horizontal.axis, vertical.axis],
        [horizontal.range, vertical.range],
        quantity::label(data.quantity),
        cells,
    );
    let map = map.caption(data.caption(&more.join("; ")));
    match ends {
        (low, high) if low < 0.0 && high > 0.0 => map,
        (low, high) if low < high => map.between(low, high),
        (low, _) if low.is_finite() => {
            map.between(low - 0.5 * low.abs() - 0.5, low + 0.5 * low.abs() + 0.5)
        }
        _ => map.between(0.0, 1.0),
    }
}

/// One direction of the map: its cells and its axis.
struct Side {
    axis: Axis,
    range: (f64, f64),
    cells: usize,
    /// The values of a list; cells of equal width otherwise.
    list: Vec<f64>,
}

impl Side {
    fn of(data: &Data<'_>, parameter: usize) -> Self {
        let values = data.values(parameter);
        let axis = data.axis(parameter);
        let cells = values.len();
        if !data.is_list(parameter) {
            let runs = data.rows.values.len() as f64;
            let cells = (runs / RUNS).sqrt().clamp(2.0, MOST_CELLS) as usize;
            let range = match (values.first(), values.last()) {
                (Some(low), Some(high)) if low < high => (*low, *high),
                (Some(low), _) => (low - 0.5, low + 0.5),
                _ => (0.0, 1.0),
            };
            return Self {
                axis,
                range,
                cells,
                list: Vec::new(),
            };
        }
        let ends = values.first().copied().zip(values.last().copied());
        let even = ends.filter(|_| data.is_numeric(parameter) && cells > 1);
        let even = even.and_then(|(from, to)| {
            let half = 0.5 / (cells - 1) as f64;
            let logarithms = values.iter().map(|value| value.ln());
            if from > 0.0 && is_even(logarithms) && (axis.log || cells > 2) {
                let half = (to / from).powf(half);
                return Some((axis.clone().log(), (from / half, to * half)));
            }
            let half = (to - from) * half;
            is_even(values.iter().copied()).then(|| (axis.clone(), (from - half, to + half)))
        });
        // Uneven steps and words are placed side by side with their names.
        let (axis, range) = even.unwrap_or_else(|| {
            let words = values.iter().map(|value| data.word(parameter, *value));
            let axis = Axis::new(label(&data.parameters()[parameter]));
            (axis.names(names(words)), (0.5, cells as f64 + 0.5))
        });
        Self {
            axis,
            range,
            cells,
            list: values,
        }
    }

    fn cell(&self, value: f64) -> usize {
        let (low, high) = self.range;
        let place = match self.list.is_empty() {
            true => ((value - low) / (high - low) * self.cells as f64) as usize,
            false => self.list.partition_point(|other| *other < value),
        };
        place.min(self.cells - 1)
    }
}
