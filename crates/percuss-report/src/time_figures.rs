//! Figures versus time.

use percuss::{
    fdm::Geometry,
    history::{ElementState, History, Sample},
    outcome::{PLANE_IMPACT, RunResult},
    units::significant,
};

use crate::{AreaChart, Axis, LineChart, Mark, Series, Style};

/// Colours of the terms of the energy balance, in its order: dark for the projectile, light for the target.
const ENERGY_COLORS: [&str; 15] = [
    "#0072b2", "#56b4e9", // kinetic
    "#00664b", "#66d1b0", // elastic
    "#b34700", "#f2a65a", // plastic
    "#cc79a7", // border shear
    "#8c8c8c", // viscosity and damping
    "#3b3b3b", // contact
    "#f0e442", // through back face
    "#7a4a9e", // eroded
    "#d7301f", // fracture
    "#9ecae9", "#b8e0c8", "#d98c5f", // plate around a plug: kinetic, elastic, plastic
];
/// Terms of the energy balance that never exceed this fraction of the initial energy are added up.
const MINOR_ENERGY: f64 = 0.005;
/// Width of lines that ring [px].
const RINGING: f64 = 1.0;
/// Width of a line that another one lies on [px].
const UNDER: f64 = 3.0;
/// Colour of the minor lines.
const MINOR_COLOR: &str = "#d4d4d4";

pub(crate) fn depth(history: &History, result: &RunResult, caption: &str) -> Option<LineChart> {
    let depth = result.depth_of_penetration?;
    let chart = chart("depth-time", "Depth versus time", "Depth (mm)", caption)
        .series(series("crater floor", history, |s| s.depth * 1e3))
        .series(series("projectile tip", history, |s| s.tip_position * 1e3).style(Style::Dashed))
        .mark(Mark::horizontal(
            format!("depth of penetration {} mm", significant(depth * 1e3, 3)),
            depth * 1e3,
        ));
    Some(with_time_to_rest(chart, result))
}

pub(crate) fn length(history: &History, result: &RunResult, caption: &str) -> Option<LineChart> {
    if result.depth_of_penetration.is_some()
        && result
            .numerics
            .as_ref()
            .is_none_or(|numerics| numerics.eroded_elements.0 == 0)
    {
        return None;
    }
    let unloaded = result.projectile_final_length? * 1e3;
    let chart = chart(
        "length-time",
        "Projectile length versus time",
        "Length (mm)",
        caption,
    )
    .series(series("projectile", history, |s| s.projectile_length * 1e3))
    .mark(Mark::horizontal(
        format!("final, unloaded {} mm", significant(unloaded, 3)),
        unloaded,
    ));
    Some(with_time_to_rest(chart, result))
}

pub(crate) fn velocity(history: &History, result: &RunResult, caption: &str) -> LineChart {
    let mut chart = chart(
        "velocity-time",
        "Velocity versus time",
        "Velocity (m/s)",
        caption,
    )
    .series(series("tip", history, |s| s.tip_velocity).width(UNDER))
    .series(series("tail", history, |s| s.tail_velocity));
    // Plates have no crater; the free surface shows the shock, its release and the pull-back of a spall.
    let planar = result.scheme == Geometry::Planar.name();
    if history.samples.iter().any(|s| s.interface_velocity != 0.0) {
        let name = if planar {
            "struck face"
        } else {
            "crater floor"
        };
        let floor = series(name, history, |s| s.interface_velocity);
        // It coincides with the tip while they are in contact.
        chart = chart.series(floor.style(Style::Dashed).width(RINGING));
    }
    if planar {
        let back = series("rear face", history, |s| s.back_velocity);
        chart = chart.series(back.width(RINGING));
    }
    let mean = series("projectile mean", history, |s| s.mean_velocity).color("#000000");
    with_time_to_rest(chart.series(mean), result)
}

/// `None` when the model has no force at either face, as for a given pressure.
pub(crate) fn force(history: &History, result: &RunResult, caption: &str) -> Option<LineChart> {
    let samples = || history.samples.iter();
    let struck = samples().any(|s| s.contact_force != 0.0);
    let behind = samples().any(|s| s.back_force.is_finite() && s.back_force != 0.0);
    let mut chart = chart("force-time", "Force versus time", "Force (kN)", caption);
    if struck {
        let curve = series("contact force", history, |s| s.contact_force * 1e-3);
        chart = chart.series(curve.width(RINGING));
    }
    let plane = result.details.iter().find(|d| d.name == PLANE_IMPACT);
    if let Some(plane) = plane {
        let words = format!("plane impact {} kN", significant(plane.value, 3));
        chart = chart.mark(Mark::horizontal(words, plane.value));
    }
    if behind {
        let name = match plane {
            Some(_) => "rear face (infinite plate)",
            None => "rear face",
        };
        let curve = series(name, history, |s| s.back_force * 1e-3);
        chart = chart.series(curve.width(RINGING));
    }
    (struck || behind).then_some(chart)
}

/// Axial stress and velocity at the gauges; none where the case has no gauges.
pub(crate) fn gauges(history: &History, caption: &str) -> Vec<LineChart> {
    if history.gauges.is_empty() {
        return Vec::new();
    }
    let of = |name, title, axis, value: fn(&ElementState) -> f64| {
        history
            .gauges
            .iter()
            .fold(chart(name, title, axis, caption), |chart, gauge| {
                let points = gauge.times.iter().zip(&gauge.states);
                let points = points.map(|(time, state)| (time * 1e6, value(state)));
                chart.series(Series::new(gauge.name.clone(), points).width(RINGING))
            })
    };
    vec![
        of(
            "gauge-stress-time",
            "Axial stress at gauges versus time",
            "Axial stress, compression positive (MPa)",
            |state| state.stress * 1e-6,
        ),
        of(
            "gauge-velocity-time",
            "Velocity at gauges versus time",
            "Velocity (m/s)",
            |state| state.velocity,
        ),
    ]
}

/// Energy balance in per cent of the initial energy; `None` when nothing moves.
pub(crate) fn energy(history: &History, caption: &str) -> Option<AreaChart> {
    let samples = &history.samples;
    let initial = samples.first()?.energy.initial;
    if initial <= 0.0 {
        return None;
    }
    let percent = |sample: &Sample, line: usize| 100.0 * sample.energy.lines()[line].1 / initial;
    let largest = |line| {
        let sizes = samples.iter().map(|sample| percent(sample, line).abs());
        sizes.fold(0.0, f64::max)
    };
    let mut chart = AreaChart::new(
        "energy-time",
        "Energy distribution versus time",
        time_axis(),
        Axis::new("Energy (% of initial)").range(0.0, 100.0),
        samples.iter().map(|sample| sample.time * 1e6),
    )
    .caption(caption);
    let mut minor = Vec::new();
    for (line, color) in ENERGY_COLORS.iter().enumerate() {
        let size = largest(line);
        if size > 100.0 * MINOR_ENERGY {
            let name = samples[0].energy.lines()[line].0;
            chart = chart.area(name, Some(color), samples.iter().map(|s| percent(s, line)));
        } else if size > 0.0 {
            minor.push(line);
        }
    }
    if !minor.is_empty() {
        let sum = |sample| minor.iter().map(|line| percent(sample, *line)).sum();
        let (name, color) = match minor[..] {
            [line] => (
                samples[0].energy.lines()[line].0.to_owned(),
                ENERGY_COLORS[line],
            ),
            _ => {
                let most = significant(100.0 * MINOR_ENERGY, 3);
                (format!("other terms, each < {most} %"), MINOR_COLOR)
            }
        };
        chart = chart.area(name, Some(color), samples.iter().map(sum));
    }
    Some(chart)
}

fn time_axis() -> Axis {
    Axis::new("Time (µs)").tight()
}

fn chart(name: &str, title: &str, y_label: &str, caption: &str) -> LineChart {
    LineChart::new(name, title, time_axis(), Axis::new(y_label)).caption(caption)
}

fn series(name: &str, history: &History, value: impl Fn(&Sample) -> f64) -> Series {
    let samples = history.samples.iter();
    Series::new(
        name,
        samples.map(|sample| (sample.time * 1e6, value(sample))),
    )
}

fn with_time_to_rest(chart: LineChart, result: &RunResult) -> LineChart {
    match result.time_to_rest {
        Some(time) => chart.mark(Mark::vertical(
            format!("rest at {} µs", significant(time * 1e6, 3)),
            time * 1e6,
        )),
        None => chart,
    }
}

#[cfg(test)]
mod tests {
    use percuss::{case, model};

    use super::*;

    #[test]
    fn energies_add_up_to_all_of_the_initial_energy() {
        for target in [
            "target = { rigid_wall = true }",
            "target = { constant_pressure = \"1 GPa\" }",
            "target = { material = \"aluminium-2024-t351\", thickness = \"50 mm\" }",
        ] {
            let projectile = r#"material = "copper", length = "15 mm", diameter = "5 mm", impact_velocity = "600 m/s""#;
            let text = format!("projectile = {{ {projectile} }}\n{target}");
            let scenario = case::load_str("case", &text).unwrap();
            let chain = model::model("chain").unwrap();
            let result = model::run(chain, &scenario, &mut model::Control::recording()).unwrap();
            let history = result.history.unwrap();
            let totals = energy(&history, "").unwrap().totals();
            assert_eq!(totals.len(), history.samples.len());
            for total in totals {
                assert!((total - 100.0).abs() < 0.1, "{target}: {total} %");
            }
        }
    }

    #[test]
    fn every_line_of_the_energy_balance_has_its_own_colour() {
        let colors: std::collections::HashSet<_> = ENERGY_COLORS.iter().collect();
        assert_eq!(colors.len(), ENERGY_COLORS.len());
        assert!(!colors.contains(&MINOR_COLOR));
    }
}
