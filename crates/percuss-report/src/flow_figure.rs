//! Figure of flow curves of several materials.

use crate::{Axis, Figure, LineChart, Series, Style, palette};

/// A flow curve with its name.
#[derive(Debug, Clone, PartialEq)]
pub struct FlowCurve {
    /// Name of its material in the legend.
    pub name: String,
    /// Its strain rate in the legend.
    pub rate_name: String,
    /// Number of its material: curves of one material have one colour. Six differ; beyond them the dashes do as well.
    pub material: usize,
    /// Number of its strain rate: curves at one rate have the same dashes, up to six materials.
    pub rate: usize,
    /// Plastic strain and stress [Pa].
    pub points: Vec<(f64, f64)>,
}

/// Draws flow curves as `flow-curves`: one colour a material, one kind of line a strain rate. 48 curves differ.
pub fn flow_figure(curves: &[FlowCurve], caption: &str) -> Figure {
    let chart = LineChart::new(
        "flow-curves",
        "Flow stress against plastic strain",
        Axis::new("Plastic strain (1)").tight(),
        Axis::new("Flow stress (MPa)"),
    )
    .caption(caption);
    let rates = curves.iter().map(|curve| curve.rate + 1).max().unwrap_or(1);
    let series = curves.iter().map(|curve| {
        let points = curve.points.iter();
        let shown = points.map(|(strain, stress)| (*strain, stress * 1e-6));
        Series::new(&*curve.name, shown)
            .style(Style::Line)
            .value(&*curve.rate_name)
            .symbol(palette::flow_symbol(curve.material, curve.rate, rates))
    });
    series.fold(chart, LineChart::series).draw()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_of_eight_materials_look_alike() {
        let curve = |material, rate| FlowCurve {
            name: format!("m{material}"),
            rate_name: format!("r{rate}"),
            material,
            rate,
            points: vec![(0.0, 1e8), (0.5, 2e8)],
        };
        let curves: Vec<FlowCurve> = (0..8)
            .flat_map(|material| [curve(material, 0), curve(material, 1)])
            .collect();
        let looks: Vec<_> = curves
            .iter()
            .map(|c| palette::flow_symbol(c.material, c.rate, 2))
            .map(|symbol| {
                (
                    palette::symbol_color(symbol),
                    palette::symbol_dashes(symbol),
                )
            })
            .collect();
        for (i, look) in looks.iter().enumerate() {
            assert!(!looks[..i].contains(look), "{i}");
        }
        // Curves of one material have one colour, and each has its material and its rate in the legend.
        assert!(looks.chunks(2).all(|two| two[0].0 == two[1].0));
        let svg = flow_figure(&curves, "").svg;
        assert_eq!(
            (svg.matches(">m7<").count(), svg.matches(">r1<").count()),
            (2, 8)
        );
    }
}
