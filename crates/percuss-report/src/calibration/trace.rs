//! Traces of the walkers.

use percuss::calibrate::Sample;

use super::{
    ParameterColumn,
    panel::{HEADS, Panel},
};
use crate::{Figure, drawing::Drawing, figure_width, palette};

/// Height of a panel and of what stands above and below all [px].
const PANEL: f64 = 170.0;
const ABOVE: f64 = 62.0;
const BELOW: f64 = 52.0;
const GAP: f64 = 14.0;
/// Colour of the steps that are not kept.
const BURN_IN: &str = "#ececec";
/// Most points of a line.
const POINTS: usize = 800;

/// Draws the first walker of each ensemble over the steps, as `trace`.
pub(super) fn figure(sample: &Sample, columns: &[ParameterColumn]) -> Figure {
    let wide = figure_width::pixels();
    let count = columns.len() as f64;
    let height = ABOVE + count * PANEL + (count - 1.0) * GAP + BELOW;
    let mut drawing = Drawing::new(wide, height);
    let sampling = sample.sampling;
    let steps = sampling.burn_in + sampling.steps;
    for (row, column) in columns.iter().enumerate() {
        let series: Vec<Vec<Vec<f64>>> = (0..sampling.ensembles)
            .map(|ensemble| sample.steps(ensemble, column.index))
            .collect();
        let every = (steps / POINTS).max(1);
        // The burn-in does not widen the range.
        let shown = series
            .iter()
            .flatten()
            .skip(sampling.burn_in.min(steps / 4));
        let (low, high) = shown.flat_map(|step| step.iter().take(1)).fold(
            (f64::INFINITY, f64::NEG_INFINITY),
            |(low, high), stored| {
                let value = column.value(*stored);
                (low.min(value), high.max(value))
            },
        );
        let margin = 0.05 * (high - low).max(f64::MIN_POSITIVE);
        let panel = Panel {
            left: 92.0,
            top: ABOVE + row as f64 * (PANEL + GAP),
            width: wide - 92.0 - 24.0,
            height: PANEL,
            x: (0.0, steps as f64),
            y: (low - margin, high + margin),
        };
        let kept = panel.map_x(sampling.burn_in as f64);
        drawing.area((panel.left, panel.top), (kept - panel.left, PANEL), BURN_IN);
        for (ensemble, series) in series.iter().enumerate() {
            let color = palette::series(ensemble);
            let places = series.iter().enumerate().step_by(every).map(|(i, step)| {
                let y = column.value(step[0]).clamp(panel.y.0, panel.y.1);
                (panel.map_x(i as f64), panel.map_y(y))
            });
            drawing.curve(places, color, r#"stroke-width="1" stroke-opacity="0.8""#);
        }
        let last = row + 1 == columns.len();
        panel.frame(&mut drawing, last.then_some("Step"), Some(&column.label));
    }
    let caption = format!(
        "one of {} walkers per ensemble, {} ensembles; grey: burn-in",
        sampling.walkers, sampling.ensembles
    );
    drawing.finish("trace", ("Traces of the sample", &caption), HEADS)
}
