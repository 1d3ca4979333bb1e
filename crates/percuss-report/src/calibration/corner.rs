//! Corner plot of the posterior: each parameter and each pair of parameters.
//!
//! The plotting library's histograms over two axes leave seams between their cells.

use percuss::{calibrate::Sample, statistics::sorted};

use super::{
    ParameterColumn,
    panel::{HEADS, Panel},
};
use crate::{Figure, drawing::Drawing, palette};

/// Side of a panel, distance between two and space around all [px].
const PANEL: f64 = 170.0;
const GAP: f64 = 12.0;
const LEFT: f64 = 92.0;
const ABOVE: f64 = 66.0;
const BELOW: f64 = 56.0;
const RIGHT: f64 = 24.0;
/// Smallest width, for the title [px].
const NARROWEST: f64 = 520.0;
/// Intervals of a histogram, and of either axis of a map.
const BARS: usize = 40;
const CELLS: usize = 34;
/// Shown fraction of the sample.
const SHOWN: f64 = 0.998;

/// Draws histograms of the parameters and maps of pairs of them, as `corner`.
pub(super) fn figure(sample: &Sample, columns: &[ParameterColumn]) -> Figure {
    let count = columns.len() as f64;
    let side = count * PANEL + (count - 1.0) * GAP;
    let width = (LEFT + side + RIGHT).max(NARROWEST);
    let mut drawing = Drawing::new(width, ABOVE + side + BELOW);
    let values: Vec<Vec<f64>> = columns
        .iter()
        .map(|column| {
            let stored = sample.values(column.index);
            stored.into_iter().map(|v| column.value(v)).collect()
        })
        .collect();
    let ranges: Vec<(f64, f64)> = values.iter().map(|values| range(values)).collect();
    for (row, label) in columns.iter().enumerate() {
        for column in 0..=row {
            let mut panel = Panel {
                left: LEFT + column as f64 * (PANEL + GAP),
                top: ABOVE + row as f64 * (PANEL + GAP),
                width: PANEL,
                height: PANEL,
                x: ranges[column],
                y: ranges[row],
            };
            let x_label = (row + 1 == columns.len()).then_some(columns[column].label.as_str());
            if row == column {
                bars(&mut drawing, &mut panel, &values[row], label.best);
                panel.frame(&mut drawing, x_label, None);
                continue;
            }
            map(&mut drawing, &panel, &values[column], &values[row]);
            cross(&mut drawing, &panel, columns[column].best, label.best);
            let y_label = (column == 0).then_some(label.label.as_str());
            panel.frame(&mut drawing, x_label, y_label);
        }
    }
    let caption = format!("{} samples; blue: best fit", values[0].len());
    drawing.finish("corner", ("Posterior of the parameters", &caption), HEADS)
}

fn range(values: &[f64]) -> (f64, f64) {
    let sorted = sorted(values.iter().copied());
    let cut = ((1.0 - SHOWN) / 2.0 * sorted.len() as f64) as usize;
    let (low, high) = (sorted[cut], sorted[sorted.len() - 1 - cut]);
    match high > low {
        true => (low, high),
        false => (low - 0.1 * low.abs() - 1e-9, high + 0.1 * high.abs() + 1e-9),
    }
}

/// Which of `count` intervals of a range a value falls into.
fn interval(value: f64, (low, high): (f64, f64), count: usize) -> Option<usize> {
    let place = (value - low) / (high - low) * count as f64;
    (0.0..=count as f64)
        .contains(&place)
        .then(|| (place as usize).min(count - 1))
}

fn bars(drawing: &mut Drawing, panel: &mut Panel, values: &[f64], best: f64) {
    let mut counts = [0_usize; BARS];
    for value in values {
        if let Some(at) = interval(*value, panel.x, BARS) {
            counts[at] += 1;
        }
    }
    panel.y = (0.0, 1.08 * *counts.iter().max().unwrap_or(&1) as f64);
    let width = panel.width / BARS as f64;
    for (i, count) in counts.iter().enumerate() {
        let top = panel.map_y(*count as f64);
        let place = (panel.left + i as f64 * width, top);
        drawing.area(place, (width, panel.top + panel.height - top), "#c7cdd6");
    }
    if (panel.x.0..=panel.x.1).contains(&best) {
        let at = panel.map_x(best);
        drawing.line(
            (at, panel.top),
            (at, panel.top + panel.height),
            palette::SERIES[0],
            1.6,
        );
    }
}

fn map(drawing: &mut Drawing, panel: &Panel, x: &[f64], y: &[f64]) {
    let mut counts = vec![0_usize; CELLS * CELLS];
    for (x, y) in x.iter().zip(y) {
        if let (Some(i), Some(j)) = (interval(*x, panel.x, CELLS), interval(*y, panel.y, CELLS)) {
            counts[j * CELLS + i] += 1;
        }
    }
    let most = *counts.iter().max().unwrap_or(&1) as f64;
    let (width, height) = (panel.width / CELLS as f64, panel.height / CELLS as f64);
    for (at, count) in counts.iter().enumerate().filter(|(_, count)| **count > 0) {
        let (i, j) = ((at % CELLS) as f64, (at / CELLS) as f64);
        let [r, g, b] = palette::sequential(*count as f64 / most);
        let place = (
            panel.left + i * width,
            panel.top + panel.height - (j + 1.0) * height,
        );
        // A little more than the cell: no seams.
        let size = (width + 0.3, height + 0.3);
        drawing.area(place, size, &format!("#{r:02x}{g:02x}{b:02x}"));
    }
}

/// A cross at the best values.
fn cross(drawing: &mut Drawing, panel: &Panel, x: f64, y: f64) {
    let inside = (panel.x.0..=panel.x.1).contains(&x) && (panel.y.0..=panel.y.1).contains(&y);
    if !inside {
        return;
    }
    let (x, y) = (panel.map_x(x), panel.map_y(y));
    for (color, width) in [("white", 4.5), (palette::SERIES[0], 2.0)] {
        drawing.line((x - 7.0, y), (x + 7.0, y), color, width);
        drawing.line((x, y - 7.0), (x, y + 7.0), color, width);
    }
}
