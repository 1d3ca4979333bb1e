//! Figures along the axis of projectile and target.

use percuss::{
    history::{ElementState, History, Profile},
    units::significant,
};

use crate::{
    Axis, HeatMap, LineChart, Mark, Series, Style, palette,
    stress_grid::{GAP, StressGrid, reach, spacing},
};

/// Two colours per body.
const COLORS: [[&str; 2]; 4] = [
    ["#0072b2", "#7fd0ff"],
    ["#d55e00", "#ffb84d"],
    ["#009e73", "#7fe0c0"],
    ["#8a3f78", "#f0a8d8"],
];

/// Where the values along the axis stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Along {
    /// At the initial positions of elements that keep their material.
    Initial,
    /// At places in space that material passes through, which has no axial strain of its own then.
    Space,
}

impl Along {
    fn axis(self) -> Axis {
        Axis::new(match self {
            Self::Initial => "Initial position, impact face at 0 (mm)",
            Self::Space => "Position, original impact face at 0 (mm)",
        })
    }
}

pub(crate) fn strain(history: &History, along: Along, caption: &str) -> Option<LineChart> {
    let (first, last) = (history.profiles.first()?, history.profiles.last()?);
    let mut chart = LineChart::new(
        "strain-profile",
        "Strain along the axis at the end",
        along.axis(),
        Axis::new(match along {
            Along::Initial => "Strain, compression positive",
            Along::Space => "Equivalent plastic strain",
        }),
    )
    .caption(format!(
        "{caption}; at {} µs",
        significant(last.time * 1e6, 4)
    ));
    for body in bodies(first, last) {
        let [plastic, total] = body.colors;
        let name = &body.name;
        if along == Along::Space {
            let points = body.points(|e| e.plastic_strain);
            chart = chart.series(Series::new(name, points).color(plastic));
            continue;
        }
        chart = chart
            .series(
                Series::new(
                    format!("{name}, plastic"),
                    body.points(|e| e.plastic_strain),
                )
                .color(plastic),
            )
            .series(
                Series::new(format!("{name}, axial total"), body.points(|e| e.strain))
                    .style(Style::Dashed)
                    .color(total),
            );
    }
    Some(chart.mark(Mark::vertical("", 0.0)))
}

/// Temperature profile; `None` when nothing is heated.
pub(crate) fn temperature(history: &History, along: Along, caption: &str) -> Option<LineChart> {
    let (first, last) = (history.profiles.first()?, history.profiles.last()?);
    let bodies = bodies(first, last);
    let start = |part: usize| first.elements.iter().find(|e| e.part == part);
    let is_heated = |body: &Body<'_>| {
        let start = start(body.part).map(|e| e.temperature);
        body.elements.iter().any(|e| Some(e.temperature) > start)
    };
    if !bodies.iter().any(is_heated) {
        return None;
    }
    let mut chart = LineChart::new(
        "temperature-profile",
        "Temperature along the axis at the end",
        along.axis(),
        Axis::new("Temperature (K)"),
    )
    .caption(format!(
        "{caption}; at {} µs",
        significant(last.time * 1e6, 4)
    ));
    for body in &bodies {
        let points = body.points(|e| e.temperature);
        chart = chart.series(Series::new(&body.name, points).color(body.colors[0]));
    }
    Some(chart.mark(Mark::vertical("", 0.0)))
}

pub(crate) fn stress(
    history: &History,
    along: Along,
    cells: [usize; 2],
    caption: &str,
) -> Option<HeatMap> {
    let grid = StressGrid::resample(&history.profiles, cells)?;
    let note = if grid.rows.iter().flatten().any(|stress| stress.is_nan()) {
        let gap = grid.rows[0].iter().any(|stress| stress.is_nan());
        match along {
            Along::Initial if !gap => "; grey: eroded",
            _ => "; grey: no material",
        }
    } else {
        ""
    };
    let mega = |row: Vec<f64>| row.into_iter().map(|stress| stress * 1e-6).collect();
    let map = HeatMap::new(
        ["stress-xt", "Axial stress versus position and time"],
        [along.axis(), Axis::new("Time (µs)")],
        [
            (grid.positions.0 * 1e3, grid.positions.1 * 1e3),
            (grid.times.0 * 1e6, grid.times.1 * 1e6),
        ],
        "Axial stress, compression positive (MPa)",
        grid.rows.into_iter().map(mega).collect(),
    )
    .caption(format!("{caption}{note}"));
    Some(if grid.positions.1 > 0.0 {
        map.vertical_line(0.0)
    } else {
        map
    })
}

pub(crate) fn shape(history: &History, caption: &str) -> Option<LineChart> {
    let (first, last) = (history.profiles.first()?, history.profiles.last()?);
    let spacing = spacing(first, 0);
    let (before, after) = (outline(first, spacing)?, outline(last, spacing)?);
    let chart = LineChart::new(
        "rod-shape",
        "Outline of the projectile at the start and at the end",
        Axis::new("Distance from the front end (mm)"),
        Axis::new("Radius (mm)"),
    )
    .caption(format!(
        "{caption}; end at {} µs",
        significant(last.time * 1e6, 4)
    ))
    .series(Series::new("end", after))
    .series(
        Series::new("start", before)
            .style(Style::Dashed)
            .color(palette::MARK),
    );
    Some(chart.true_to_scale())
}

/// Body along the axis.
struct Body<'a> {
    part: usize,
    name: String,
    colors: [&'static str; 2],
    elements: Vec<&'a ElementState>,
    /// Distance of neighbouring elements before impact [m].
    spacing: f64,
}

impl Body<'_> {
    /// A value over the initial position in mm; where something has eroded, a point without value.
    fn points(&self, value: fn(&ElementState) -> f64) -> Vec<(f64, f64)> {
        let mut points: Vec<(f64, f64)> = Vec::new();
        let mut before: Option<&ElementState> = None;
        for &element in &self.elements {
            let neighbours = |a: &ElementState| {
                element.initial_position - a.initial_position <= GAP * reach(a, self.spacing)
            };
            // Something has eroded between them.
            if before.is_some_and(|before| !neighbours(before)) {
                points.push((f64::NAN, f64::NAN));
            }
            points.push((element.initial_position * 1e3, value(element)));
            before = Some(element);
        }
        points
    }
}

/// All parts that a profile has, as a later one has them.
fn bodies<'a>(first: &Profile, last: &'a Profile) -> Vec<Body<'a>> {
    let parts = parts(first);
    let of = |&part: &usize| Body {
        part,
        name: match part {
            0 => "projectile".to_owned(),
            _ if parts.len() <= 2 => "target".to_owned(),
            _ => format!("layer {part}"),
        },
        colors: COLORS[part % COLORS.len()],
        elements: last.elements.iter().filter(|e| e.part == part).collect(),
        spacing: spacing(first, part),
    };
    parts.iter().map(of).collect()
}

fn parts(profile: &Profile) -> Vec<usize> {
    let mut parts: Vec<usize> = profile.elements.iter().map(|e| e.part).collect();
    parts.dedup();
    parts
}

/// Closed outline of each piece of the projectile in mm, the front end of the foremost at 0, the tail at negative
/// positions. `spacing` is the distance of neighbouring elements before impact.
fn outline(profile: &Profile, spacing: f64) -> Option<Vec<(f64, f64)>> {
    let rod: Vec<&ElementState> = profile.elements.iter().filter(|e| e.part == 0).collect();
    let tip = rod.last()?;
    let front = tip.position + 0.5 * tip.length;
    let pieces = rod.chunk_by(|a, b| b.initial_position - a.initial_position <= GAP * spacing);
    let mut points = Vec::new();
    for piece in pieces {
        let (tail, tip) = (piece.first()?, piece.last()?);
        let mut upper = vec![(tail.position - 0.5 * tail.length, tail.diameter)];
        upper.extend(piece.iter().map(|e| (e.position, e.diameter)));
        upper.push((tip.position + 0.5 * tip.length, tip.diameter));
        let upper = upper
            .iter()
            .map(|(x, diameter)| ((x - front) * 1e3, 0.5e3 * diameter));
        let start = points.len();
        points.extend(upper.clone());
        points.extend(upper.rev().map(|(x, radius)| (x, -radius)));
        points.extend([points[start], (f64::NAN, f64::NAN)]);
    }
    Some(points)
}
