//! Figure of flow curves of several materials.

use crate::{Axis, Figure, LineChart, Series, Style, palette};

/// A flow curve with its name.
#[derive(Debug, Clone, PartialEq)]
pub struct FlowCurve {
    /// Name in the legend.
    pub name: String,
    /// Number of its material: curves of one material have one colour. Six differ.
    pub material: usize,
    /// Number of its strain rate: curves at one rate have the same dashes. Four differ.
    pub rate: usize,
    /// Plastic strain and stress [Pa].
    pub points: Vec<(f64, f64)>,
}

/// Draws flow curves as `flow-curves`: one colour a material, one kind of line a strain rate.
pub fn flow_figure(curves: &[FlowCurve], caption: &str) -> Figure {
    let chart = LineChart::new(
        "flow-curves",
        "Flow stress against plastic strain",
        Axis::new("Plastic strain (1)").tight(),
        Axis::new("Flow stress (MPa)"),
    )
    .caption(caption);
    let series = curves.iter().map(|curve| {
        let points = curve.points.iter();
        let shown = points.map(|(strain, stress)| (*strain, stress * 1e-6));
        Series::new(&*curve.name, shown)
            .style(Style::Line)
            .symbol(palette::symbol(curve.material, curve.rate))
    });
    series.fold(chart, LineChart::series).draw()
}
