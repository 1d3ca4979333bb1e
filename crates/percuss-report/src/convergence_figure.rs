//! Chart of a convergence study, and its figure.

use percuss::converge::{ConvergenceStatus, MeshStudy};

use crate::{
    Axis, Chart, Figure, LineChart, Mark, Series, Style,
    names::{result_column, with_unit},
};

/// Draws one quantity of a study versus the number of elements along the projectile.
pub fn convergence_figure(case: &str, study: &MeshStudy, quantity: usize) -> Option<Figure> {
    convergence_chart(case, study, quantity).map(|chart| chart.draw())
}

/// The chart that [`convergence_figure`] draws.
pub fn convergence_chart(case: &str, study: &MeshStudy, quantity: usize) -> Option<Chart> {
    let quantity = study.quantities.get(quantity)?;
    let (name, _) = result_column(quantity.name);
    let points = study
        .meshes
        .iter()
        .map(|mesh| mesh.projectile_elements as f64)
        .zip(quantity.values.iter().copied());
    let mut chart = LineChart::new(
        format!("convergence-{}", quantity.name.replace('_', "-")),
        format!("Convergence of the {name}: {case}"),
        Axis::new("Elements along the projectile").log(),
        Axis::new(with_unit(&name, quantity.unit)),
    )
    .series(Series::new("computed", points).style(Style::LineAndMarkers));
    if let ConvergenceStatus::Converging {
        richardson, order, ..
    } = quantity.status
    {
        chart = chart.mark(Mark::horizontal(
            format!("extrapolated at order {order:.2}"),
            richardson,
        ));
    }
    Some(chart.caption(quantity.status.describe()).into())
}
