//! Figure of flow curves of several materials.

use crate::{Axis, Figure, LineChart, Series};

/// A flow curve with its name.
#[derive(Debug, Clone, PartialEq)]
pub struct FlowCurve {
    /// Name in the legend.
    pub name: String,
    /// Which material it belongs to: curves of one material have one colour.
    pub material: usize,
    /// Plastic strain and stress [Pa].
    pub points: Vec<(f64, f64)>,
}

/// Draws flow curves as `flow-curves`: one colour a material, one dash a strain rate and temperature.
pub fn flow_figure(curves: &[FlowCurve], caption: &str) -> Figure {
    let mut chart = LineChart::new(
        "flow-curves",
        "Flow stress against plastic strain",
        Axis::new("Plastic strain (1)").tight(),
        Axis::new("Flow stress (MPa)"),
    )
    .caption(caption);
    let mut materials: Vec<usize> = Vec::new();
    for curve in curves {
        let first = !materials.contains(&curve.material);
        materials.push(curve.material);
        let style = match first {
            true => crate::Style::Line,
            false => crate::Style::Dashed,
        };
        let points = curve.points.iter();
        let shown = points.map(|(strain, stress)| (*strain, stress * 1e-6));
        chart = chart.series(
            Series::new(&*curve.name, shown)
                .style(style)
                .color(crate::palette::symbol_color(curve.material)),
        );
    }
    chart.draw()
}
