//! All charts of one run, and their figures.

use percuss::{
    Scenario,
    model::label,
    outcome::{BandQuantity, RunResult},
    summary::ResultRecord,
};

use crate::{
    Chart, Figure, ReportError,
    axial_figures::{self, Along},
    caption::caption,
    curve_figures::curve_charts,
    error::history_of,
    measured,
    shape_figure::shape_chart,
    time_figures,
};

/// Cells of the x–t diagram of a figure along the axis and along time.
const CELLS: [usize; 2] = [300, 220];

/// Draws all figures that a result has data for.
///
/// Against time: `depth-time` (a target that can be penetrated), `length-time` (a rigid wall, or a projectile that
/// erodes), `velocity-time`, `force-time`, `energy-time`, `gauge-stress-time` and `gauge-velocity-time` (a case with gauges), and
/// `measured-curve-1` and so on (a case with measured curves). Along the axis: `strain-profile`, `temperature-profile` (where anything became hotter), `stress-xt` and
/// `rod-shape`, or `final-shape` of a two-dimensional model. A run without motion has only `strain-profile` and `rod-shape`.
///
/// # Errors
/// [`ReportError::NoHistory`] when the run kept no history.
pub fn run_figures(scenario: &Scenario, result: &RunResult) -> Result<Vec<Figure>, ReportError> {
    let charts = run_charts(scenario, result, Some(CELLS))?;
    Ok(charts.iter().map(Chart::draw).collect())
}

/// The charts that [`run_figures`] draws; `cells` are those of the x–t diagram along the axis and along time, which is left out
/// without them.
///
/// # Errors
/// [`ReportError::NoHistory`] when the run kept no history.
pub fn run_charts(
    scenario: &Scenario,
    result: &RunResult,
    cells: Option<[usize; 2]>,
) -> Result<Vec<Chart>, ReportError> {
    let history = history_of(result)?;
    let case = caption(scenario, Some(scenario.impact_velocity));
    let caption = format!("{case}; model {}", label(result.model));
    let (first, last) = (
        &history.samples[0],
        &history.samples[history.samples.len() - 1],
    );
    let mut charts: Vec<Chart> = Vec::new();
    if first.time < last.time {
        let measured = |quantity| measured::lines(scenario, quantity, history);
        let depth = time_figures::depth(history, result, &caption);
        let depth = depth.map(|chart| chart.all(measured(BandQuantity::DepthOfPenetration)));
        let length = time_figures::length(history, result, &caption);
        let length = length.map(|chart| chart.all(measured(BandQuantity::ProjectileFinalLength)));
        let velocity = time_figures::velocity(history, result, &caption);
        charts.extend(depth.map(Chart::from));
        charts.extend(length.map(Chart::from));
        let velocity = velocity.all(measured(BandQuantity::ResidualVelocity));
        charts.push(velocity.into());
        charts.extend(time_figures::force(history, result, &caption).map(Chart::from));
        charts.extend(time_figures::energy(history, &caption).map(Chart::from));
        let gauges = time_figures::gauges(history, &caption);
        charts.extend(gauges.into_iter().map(Chart::from));
        if !scenario.measured_curves.is_empty() {
            let record = ResultRecord::new(scenario, result);
            let curves = curve_charts(scenario, &[&record]);
            charts.extend(curves.into_iter().map(Chart::from));
        }
    }
    let along = match result.shapes {
        Some(_) => Along::Space,
        None => Along::Initial,
    };
    charts.extend(axial_figures::strain(history, along, &caption).map(Chart::from));
    charts.extend(axial_figures::temperature(history, along, &caption).map(Chart::from));
    let stress = cells.and_then(|cells| axial_figures::stress(history, along, cells, &caption));
    charts.extend(stress.map(Chart::from));
    match &result.shapes {
        Some(shapes) => charts.push(shape_chart(scenario, shapes).into()),
        None => charts.extend(axial_figures::shape(history, &caption).map(Chart::from)),
    }
    Ok(charts)
}
