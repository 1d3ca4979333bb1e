//! Chart of a convergence study, and its figure.

use percuss::converge::{ConvergenceStatus, MeshStudy};

use crate::{
    Axis, Chart, Figure, LineChart, Mark, Series, Style,
    names::{result_column, with_unit},
};

/// Draws one quantity of a study versus the number of elements along the projectile, or of cells per its radius.
pub fn convergence_figure(case: &str, study: &MeshStudy, quantity: usize) -> Option<Figure> {
    convergence_chart(case, study, quantity).map(|chart| chart.draw())
}

/// The chart that [`convergence_figure`] draws.
pub fn convergence_chart(case: &str, study: &MeshStudy, quantity: usize) -> Option<Chart> {
    let quantity = study.quantities.get(quantity)?;
    let words = study.describe(quantity);
    let (name, _) = result_column(quantity.name);
    let cells = study.meshes.iter().map(|mesh| mesh.cells_per_radius);
    let (along, meshes): (_, Vec<f64>) = match cells.collect::<Option<Vec<u32>>>() {
        Some(cells) => (
            "Cells per radius of the projectile",
            cells.into_iter().map(f64::from).collect(),
        ),
        None => {
            let meshes = study.meshes.iter();
            let elements = meshes.map(|mesh| mesh.projectile_elements as f64);
            ("Elements along the projectile", elements.collect())
        }
    };
    let points = meshes.into_iter().zip(quantity.values.iter().copied());
    let mut chart = LineChart::new(
        format!("convergence-{}", quantity.name.replace('_', "-")),
        format!("Convergence of the {name}"),
        Axis::new(along).log(),
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
    Some(chart.caption(format!("{case}; {words}")).into())
}
