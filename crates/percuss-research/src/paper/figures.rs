//! Figures 7 to 11.

use percuss::{converge, history::Sample, outcome::RunResult};

use super::{
    Assessment, Item, Table, finite_differences,
    runs::{
        FINE_MESHES, MESHES, PAPER_MESH, PAPER_SPEED, Runs, SHEARS, SPEEDS, TIME_SPEEDS, WAYS, Way,
    },
};
use percuss_report::{Axis, Figure, LineChart, Mark, Series, Style};

pub(super) fn check(runs: &Runs, items: &mut Vec<Item>, tables: &mut Vec<Table>) {
    figure_7(runs, items, tables);
    figure_8(runs, items, tables);
    figure_9(runs, items, tables);
    figure_10(runs, items, tables);
    items.push(Item {
        place: "Fig. 11",
        statement:
            "agrees with Woodward's tests at low velocity and departs from them at high velocity"
                .to_owned(),
        assessment: Assessment::CannotBeKnown,
        finding:
            "the measured depths are only in the figure, and no readable source of them was found"
                .to_owned(),
    });
}

pub(super) fn number(value: f64) -> String {
    format!("{value:.4}")
}

/// Exponent of the velocity between the ends of a curve.
fn exponent(depths: &[f64]) -> f64 {
    let last = depths.len() - 1;
    (depths[last] / depths[0]).ln() / (SPEEDS[last] / SPEEDS[0]).ln()
}

fn figure_7(runs: &Runs, items: &mut Vec<Item>, tables: &mut Vec<Table>) {
    let curve = |way| SPEEDS.map(|speed| runs.depth_on(way, speed, (10, 20)));
    let growth: Vec<String> = WAYS
        .iter()
        .map(|way| {
            format!(
                "{}: proportional to velocity to the power {:.2}",
                way.name(),
                exponent(&curve(*way))
            )
        })
        .collect();
    let rising = WAYS
        .iter()
        .all(|way| curve(*way).windows(2).all(|pair| pair[1] > pair[0]));
    items.push(Item {
        place: "Fig. 7",
        statement: "depth grows nonlinearly with impact velocity (10–20 elements)".to_owned(),
        assessment: if rising {
            Assessment::Reproduced
        } else {
            Assessment::Contradicted
        },
        finding: format!(
            "from {} to {} m/s, {}",
            SPEEDS[0],
            SPEEDS[7],
            growth.join("; ")
        ),
    });
    finite_differences::check(runs, items, tables);
    let mut columns = vec!["Impact velocity (m/s)".to_owned()];
    for mesh in [(10, 20), PAPER_MESH] {
        columns.extend(
            WAYS.iter()
                .map(|way| format!("{}, {}–{} [mm]", way.name(), mesh.0, mesh.1)),
        );
    }
    let rows = SPEEDS
        .iter()
        .map(|&speed| {
            let depths = [(10, 20), PAPER_MESH]
                .into_iter()
                .flat_map(|mesh| WAYS.map(|way| number(runs.depth_on(way, speed, mesh))));
            std::iter::once(format!("{speed}")).chain(depths).collect()
        })
        .collect();
    tables.push(Table {
        title: "Depth of penetration versus impact velocity (figures 7 and 11), C = 0.577."
            .to_owned(),
        columns,
        rows,
    });
}

/// The five meshes of the paper and the finer ones.
fn all_meshes() -> Vec<(u32, u32)> {
    MESHES.into_iter().chain(FINE_MESHES).collect()
}

fn figure_8(runs: &Runs, items: &mut Vec<Item>, tables: &mut Vec<Table>) {
    let change =
        |way, speed| runs.depth_on(way, speed, (30, 60)) - runs.depth_on(way, speed, (50, 100));
    let changes: Vec<String> = WAYS
        .iter()
        .map(|way| format!("{}: {:.3} mm", way.name(), change(*way, PAPER_SPEED)))
        .collect();
    items.push(Item {
        place: "Fig. 8",
        statement: "from 30–60 to 50–100 elements the depth changes by less than 0.5 mm".to_owned(),
        assessment: if WAYS.iter().all(|way| change(*way, PAPER_SPEED).abs() < 0.5) {
            Assessment::Reproduced
        } else {
            Assessment::Contradicted
        },
        finding: format!("at 230 m/s, {}", changes.join("; ")),
    });
    let doubled = [(40, 80), (80, 160), (160, 320), (320, 640)];
    for way in WAYS {
        let values = doubled.map(|mesh| runs.depth_on(way, PAPER_SPEED, mesh));
        let Some(verdict) = converge::ConvergenceStatus::of(&values) else {
            continue;
        };
        let none = || "none".to_owned();
        let order = verdict
            .order()
            .map_or_else(none, |order| format!("{order:.2}"));
        let limit = match verdict {
            converge::ConvergenceStatus::Converging { richardson, .. } => {
                format!("{richardson:.4} mm")
            }
            _ => none(),
        };
        let words = verdict.describe();
        items.push(Item {
            place: "Fig. 8",
            statement: format!("40–80 elements are converged ({})", way.name()),
            assessment: Assessment::Contradicted,
            finding: format!(
                "{} mm on 40–80, 80–160, 160–320, 320–640 at 230 m/s: observed order {order}, extrapolated {limit}; {words}; \
                 40–80 is {:.0} % above the finest",
                values.map(|v| format!("{v:.4}")).join(" / "),
                100.0 * (values[0] / values[3] - 1.0)
            ),
        });
    }
    let mut columns = vec!["elements".to_owned()];
    columns.extend(WAYS.iter().map(|way| format!("{} [mm]", way.name())));
    columns.push("published, chain: depth / element length".to_owned());
    let rows = all_meshes()
        .into_iter()
        .map(|mesh| {
            let depths = WAYS.map(|way| number(runs.depth_on(way, PAPER_SPEED, mesh)));
            let length = 12.74 / f64::from(mesh.0);
            let ratio = runs.depth_on(Way::Chain, PAPER_SPEED, mesh) / length;
            std::iter::once(format!("{}–{}", mesh.0, mesh.1))
                .chain(depths)
                .chain([format!("{ratio:.3}")])
                .collect()
        })
        .collect();
    tables.push(Table {
        title: "Convergence at 230 m/s (figure 8), C = 0.577.".to_owned(),
        columns,
        rows,
    });
}

fn figure_9(runs: &Runs, items: &mut Vec<Item>, tables: &mut Vec<Table>) {
    for way in WAYS {
        let depth = |speed, shear| runs.depth_with(way, speed, shear);
        let spread = |speed| depth(speed, 0.3) / depth(speed, 1.0) - 1.0;
        let marginal = spread(PAPER_SPEED).abs() < 0.05 && spread(600.0).abs() < 0.05;
        items.push(Item {
            place: "Fig. 9",
            statement: format!("the border-shear constant C changes the depth marginally ({})", way.name()),
            assessment: if marginal { Assessment::Reproduced } else { Assessment::Contradicted },
            finding: format!(
                "C = 0.3 gives {:.1} % more than C = 1.0 at 230 m/s and {:.1} % at 600 m/s; without border shear the depth at \
                 230 m/s is {:.3} mm against {:.3} mm with C = 0.577",
                100.0 * spread(PAPER_SPEED),
                100.0 * spread(600.0),
                depth(PAPER_SPEED, 0.0),
                depth(PAPER_SPEED, 0.577)
            ),
        });
    }
    let mut columns = vec!["C".to_owned()];
    for speed in [PAPER_SPEED, 600.0] {
        columns.extend(
            WAYS.iter()
                .map(|way| format!("{}, {speed} m/s [mm]", way.name())),
        );
    }
    let rows = SHEARS
        .iter()
        .map(|&shear| {
            let depths = [PAPER_SPEED, 600.0]
                .into_iter()
                .flat_map(|speed| WAYS.map(|way| number(runs.depth_with(way, speed, shear))));
            std::iter::once(format!("{shear}")).chain(depths).collect()
        })
        .collect();
    tables.push(Table {
        title: "Depth of penetration versus border-shear constant (figure 9), 40–80 elements."
            .to_owned(),
        columns,
        rows,
    });
}

/// Depth of figure 10: in the paper, that of the first penetrator mass.
fn followed(way: Way, sample: &Sample) -> f64 {
    match way {
        Way::Conservative => sample.depth,
        Way::Chain | Way::Joined => sample.tip_position,
    }
}

/// Time at which 99 % of the depth of penetration is reached [us].
fn saturation_time(way: Way, result: &RunResult) -> f64 {
    let depth = result.depth_of_penetration.unwrap_or(f64::NAN);
    let history = result.history.as_ref();
    history
        .and_then(|history| {
            history
                .samples
                .iter()
                .find(|s| followed(way, s) >= 0.99 * depth)
        })
        .map_or(f64::NAN, |sample| sample.time * 1e6)
}

fn figure_10(runs: &Runs, items: &mut Vec<Item>, tables: &mut Vec<Table>) {
    let curve = |way: Way, value: fn(Way, &RunResult) -> f64| -> Vec<f64> {
        let own = runs.histories.iter().filter(|(other, ..)| *other == way);
        own.map(|(way, _, result)| value(*way, result)).collect()
    };
    let depth = |_: Way, result: &RunResult| result.depth_of_penetration.unwrap_or(f64::NAN) * 1e3;
    let grows = |values: &[f64]| values.windows(2).all(|pair| pair[1] > pair[0]);
    let list = |values: &[f64]| {
        values
            .iter()
            .map(|v| format!("{v:.2}"))
            .collect::<Vec<_>>()
            .join(" / ")
    };
    for way in WAYS {
        let (depths, times) = (curve(way, depth), curve(way, saturation_time));
        let assessment = match (grows(&depths), grows(&times)) {
            (true, true) => Assessment::Reproduced,
            _ => Assessment::Contradicted,
        };
        items.push(Item {
            place: "Fig. 10",
            statement: format!(
                "tip depth rises and saturates; saturation depth and time both grow with velocity ({})",
                way.name()
            ),
            assessment,
            finding: format!(
                "at {} m/s: depths {} mm, 99 % of them after {} us",
                TIME_SPEEDS.map(|speed| speed.to_string()).join(" / "),
                list(&depths),
                list(&times)
            ),
        });
    }
    let mut columns = vec!["Impact velocity (m/s)".to_owned()];
    for way in WAYS {
        columns.push(format!("{}: depth [mm]", way.name()));
        columns.push(format!("{}: time to 99 % [us]", way.name()));
    }
    let rows = TIME_SPEEDS
        .iter()
        .enumerate()
        .map(|(i, speed)| {
            let cells = WAYS.into_iter().flat_map(|way| {
                [
                    number(curve(way, depth)[i]),
                    format!("{:.2}", curve(way, saturation_time)[i]),
                ]
            });
            std::iter::once(format!("{speed}")).chain(cells).collect()
        })
        .collect();
    tables.push(Table {
        title: "Saturation of the depth (figure 10), 40–80 elements, C = 0.577.".to_owned(),
        columns,
        rows,
    });
}

pub(super) fn draw(runs: &Runs) -> Vec<Figure> {
    let speed_axis = || Axis::new("Impact velocity (m/s)");
    let depth_axis = || Axis::new("Depth of penetration (mm)");
    let versus_velocity = |name: &str, title: &str, mesh: (u32, u32)| {
        WAYS.into_iter()
            .fold(
                LineChart::new(name, title, speed_axis(), depth_axis().log()),
                |chart, way| {
                    let points = SPEEDS.map(|speed| (speed, runs.depth_on(way, speed, mesh)));
                    chart.series(Series::new(way.name(), points).style(Style::LineAndMarkers))
                },
            )
            .series(
                Series::new(
                    "finite differences",
                    SPEEDS.map(|speed| (speed, runs.differences_on(speed, mesh))),
                )
                .style(Style::LineAndMarkers),
            )
            .caption(format!(
                "copper rod on 2024-T351, {}–{} elements, C = 0.577",
                mesh.0, mesh.1
            ))
            .draw()
    };
    let convergence = WAYS
        .into_iter()
        .fold(
            LineChart::new(
                "figure-8",
                "Depth of penetration versus element length at 230 m/s",
                Axis::new("Element length of the rod (mm)").log(),
                depth_axis().log(),
            ),
            |chart, way| {
                let points = all_meshes()
                    .into_iter()
                    .map(|mesh| (12.74 / f64::from(mesh.0), runs.depth_on(way, PAPER_SPEED, mesh)));
                chart.series(Series::new(way.name(), points).style(Style::LineAndMarkers))
            },
        )
        .caption("a converged curve is horizontal at its left end; the finest mesh of the paper has 50–100 elements")
        .mark(Mark::vertical("finest mesh of the paper", 12.74 / 50.0))
        .draw();
    let shear = WAYS
        .into_iter()
        .fold(
            LineChart::new(
                "figure-9",
                "Depth of penetration versus border-shear constant at 230 m/s",
                Axis::new("Border-shear constant C"),
                depth_axis().log(),
            ),
            |chart, way| {
                let points = SHEARS.map(|shear| (shear, runs.depth_with(way, PAPER_SPEED, shear)));
                chart.series(Series::new(way.name(), points).style(Style::LineAndMarkers))
            },
        )
        .caption("40–80 elements")
        .mark(Mark::vertical("C of the paper", 0.577))
        .draw();
    let in_time = |way: Way, name: &str| {
        let own = runs.histories.iter().filter(|(other, ..)| *other == way);
        own.fold(
            LineChart::new(
                name,
                format!("Tip depth versus time: {}", way.name()),
                Axis::new("Time (µs)"),
                Axis::new("Depth (mm)"),
            ),
            |chart, (way, speed, result)| {
                let samples = result.history.iter().flat_map(|history| &history.samples);
                let points = samples.map(|s| (s.time * 1e6, followed(*way, s) * 1e3));
                chart.series(Series::new(format!("{speed} m/s"), points))
            },
        )
        .caption("40–80 elements, C = 0.577")
        .draw()
    };
    vec![
        versus_velocity(
            "figure-7",
            "Depth of penetration versus impact velocity, coarse mesh of the paper",
            (10, 20),
        ),
        convergence,
        shear,
        in_time(Way::Chain, "figure-10-published-chain"),
        in_time(Way::Joined, "figure-10-published-joined"),
        in_time(Way::Conservative, "figure-10-conservative"),
        versus_velocity(
            "figure-11",
            "Depth of penetration versus impact velocity, mesh of the paper",
            PAPER_MESH,
        ),
    ]
}
