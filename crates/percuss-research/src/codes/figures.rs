//! Figures of the comparison.

use percuss::model::label;
use percuss_report::{Axis, Figure, LineChart, Mark, RowChart, Series, Style, palette};

use super::{
    CodeComparison, ComparedValue, DimensionStudy, LineRun, Quantity, dimension::ELEMENTS,
};

/// Largest difference that the first figure shows [%]: rows beyond it would hide all others, and are in the tables.
const LARGEST: f64 = 40.0;

pub(super) fn draw(comparison: &CodeComparison) -> Vec<Figure> {
    vec![
        differences(&comparison.values),
        dimension(&comparison.dimension),
    ]
}

/// Colours of the codes, in the order in which they first occur.
fn color(codes: &[&str], code: &str) -> &'static str {
    let place = codes.iter().position(|known| *known == code);
    palette::series(place.unwrap_or(0))
}

/// The last mesh of every code, case and quantity, within what the figure shows.
fn finest(values: &[ComparedValue]) -> Vec<&ComparedValue> {
    let key = |value: &ComparedValue| {
        let row = &value.outside;
        let words = [&row.case, &row.code].map(String::clone);
        (words, row.impact_velocity_m_s.to_bits(), row.quantity)
    };
    let is_last = |index: usize| {
        let own = key(&values[index]);
        values[index + 1..].iter().all(|later| key(later) != own)
    };
    let all = values.iter().enumerate();
    all.filter(|(index, value)| {
        is_last(*index)
            && value.outside.quantity != Quantity::StressExcess
            && value.found_percent.abs() <= LARGEST
    })
    .map(|(_, value)| value)
    .collect()
}

fn differences(values: &[ComparedValue]) -> Figure {
    let mut codes: Vec<&str> = Vec::new();
    for value in values {
        if !codes.contains(&value.outside.code.as_str()) {
            codes.push(&value.outside.code);
        }
    }
    let mut chart = RowChart::new(
        "differences",
        "percuss and other codes",
        Axis::new("Difference of percuss (%)"),
    )
    .caption("finest mesh of each code, in the order of the tables; ranges: stated tolerances");
    for value in finest(values) {
        let row = &value.outside;
        let (low, high) = (
            row.difference_percent - row.tolerance_percent,
            row.difference_percent + row.tolerance_percent,
        );
        let name = format!("{}, {}", row.code, row.quantity.short_label());
        let color = color(&codes, &row.code);
        chart = chart.row(name, value.found_percent, Some((low, high)), color);
    }
    chart.draw()
}

fn dimension(study: &DimensionStudy) -> Figure {
    let rods = study.rods.iter();
    let points = rods.map(|rod| (1.0 / rod.length_to_diameter, rod.final_length_mm));
    let mut chart = LineChart::new(
        "dimension",
        "Copper rod on a rigid wall: two dimensions and one",
        Axis::new("Diameter over length of the rod"),
        Axis::new("Final length (mm)"),
    )
    .caption("23.47 mm long, 183 m/s, power law; axi on 4 cells per radius")
    .series(
        Series::new(label("axi"), points)
            .style(Style::LineAndMarkers)
            .symbol(palette::model_symbols(["axi"])[0]),
    );
    let meshes = [ELEMENTS[0], ELEMENTS[ELEMENTS.len() - 1]];
    let shown = |line: &&LineRun| line.model == "chain" && meshes.contains(&line.elements);
    for line in study.lines.iter().filter(shown) {
        let name = format!("chain, {} elements", line.elements);
        chart = chart.mark(Mark::horizontal(name, line.final_length_mm));
    }
    chart.draw()
}
