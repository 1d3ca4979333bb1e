//! Figures of the benchmark: one error map per candidate, and depth versus impact velocity per pair of materials and length.

use percuss::{
    material::Library,
    model::label,
    model_error::{
        ErrorRecord, candidates,
        design::{LENGTHS, VELOCITIES},
    },
    statistics::{quantile, sorted},
};
use percuss_report::{Axis, Figure, HeatMap, LineChart, Series, Style, palette};

use super::tables::signed;
use crate::benchmark::PAIRS;

/// Length-to-diameter ratio of the depth figures in Markdown, one per pair of materials.
const SHOWN: f64 = 3.0;
/// Error at the end of the colour scale.
const STRONGEST: f64 = 1.0;
/// Height of an error map [px].
const MAP_HEIGHT: f64 = 330.0;

/// Candidates in a figure of depths: more lines cannot be told apart.
const CANDIDATES: usize = 6;

/// All figures.
pub(super) struct BenchmarkFigures {
    /// Error maps, one per candidate.
    pub(super) maps: Vec<Figure>,
    /// Depth versus impact velocity, for Markdown and HTML.
    pub(super) depths: Vec<Figure>,
    /// Depth versus impact velocity, for HTML only.
    pub(super) more_depths: Vec<Figure>,
}

impl BenchmarkFigures {
    /// Draws all figures with results.
    pub(super) fn of(verdicts: &[ErrorRecord]) -> Self {
        let names = of_widest_use(verdicts);
        let of_length = |wanted: &dyn Fn(f64) -> bool| {
            let mut drawn = Vec::new();
            for (projectile, target) in PAIRS {
                for &length in LENGTHS.iter().filter(|length| wanted(**length)) {
                    drawn.extend(depths(verdicts, &names, projectile, target, length));
                }
            }
            drawn
        };
        Self {
            maps: candidates()
                .iter()
                .filter_map(|candidate| map(verdicts, candidate.name))
                .collect(),
            depths: of_length(&|length| length == SHOWN),
            more_depths: of_length(&|length| length != SHOWN),
        }
    }

    pub(super) fn in_markdown(&self) -> impl Iterator<Item = &Figure> {
        self.maps.iter().chain(&self.depths)
    }
}

/// A name as part of a file's.
fn stem(name: &str) -> String {
    let words = name.split(|c: char| !c.is_alphanumeric());
    let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
    words.join("-")
}

fn map(verdicts: &[ErrorRecord], candidate: &str) -> Option<Figure> {
    let median = |length: f64, speed: f64| {
        let here = verdicts.iter().filter(|v| {
            v.candidate == candidate
                && v.length_to_diameter == length
                && v.impact_velocity_m_s == speed
        });
        let errors = sorted(here.map(ErrorRecord::error));
        match errors.is_empty() {
            true => f64::NAN,
            false => quantile(&errors, 0.5),
        }
    };
    let rows: Vec<Vec<f64>> = LENGTHS
        .iter()
        .map(|&length| {
            VELOCITIES
                .iter()
                .map(|&speed| median(length, speed))
                .collect()
        })
        .collect();
    if rows.iter().flatten().all(|value| value.is_nan()) {
        return None;
    }
    let percent = |value: f64| match value.is_nan() {
        true => "\u{2013}".to_owned(),
        false => signed(value).replace('-', "\u{2212}"),
    };
    let texts = rows
        .iter()
        .map(|row| row.iter().map(|value| percent(*value)).collect())
        .collect();
    let axis =
        |label: &str, values: &[f64]| Axis::new(label).names(values.iter().map(f64::to_string));
    let range = |values: &[f64]| (0.5, values.len() as f64 + 0.5);
    let in_percent = rows
        .into_iter()
        .map(|row| row.into_iter().map(|value| 100.0 * value).collect())
        .collect();
    let map = HeatMap::new(
        [
            &format!("error-{}", stem(candidate)),
            &format!("Median error of model {}", label(candidate)),
        ],
        [
            axis("Impact velocity (m/s)", VELOCITIES),
            axis("Length-to-diameter ratio L/D", LENGTHS),
        ],
        [range(VELOCITIES), range(LENGTHS)],
        "Median error of the depth (%)",
        in_percent,
    );
    Some(
        map.caption("against the axisymmetric reference, over all pairs of materials; red: too deep, blue: too shallow")
            .texts(texts)
            .limit(100.0 * STRONGEST)
            .height(MAP_HEIGHT)
            .draw(),
    )
}

/// Candidates with the smallest median error among those with a depth in half of the cases that any candidate has one in.
fn of_widest_use(verdicts: &[ErrorRecord]) -> Vec<&'static str> {
    let errors_of = |name: &str| {
        let own = verdicts.iter().filter(|v| v.candidate == name);
        sorted(own.map(|v| v.error().abs()))
    };
    let all = candidates();
    let errors = all.iter().map(|c| (c.name, errors_of(c.name)));
    let errors: Vec<(&str, Vec<f64>)> = errors.collect();
    let most = errors.iter().map(|(_, e)| e.len()).max().unwrap_or(0);
    let mut wide: Vec<(&str, f64)> = errors
        .iter()
        .filter(|(_, errors)| 2 * errors.len() >= most && !errors.is_empty())
        .map(|(name, errors)| (*name, quantile(errors, 0.5)))
        .collect();
    wide.sort_by(|a, b| a.1.total_cmp(&b.1));
    wide.truncate(CANDIDATES);
    wide.into_iter().map(|(name, _)| name).collect()
}

/// The name of a material of the library; of another one, its id.
fn material(id: &str) -> String {
    let entry = Library::built_in().find(id);
    entry.map_or_else(|| id.to_owned(), |entry| entry.material.name.clone())
}

fn depths(
    verdicts: &[ErrorRecord],
    names: &[&str],
    projectile: &str,
    target: &str,
    length: f64,
) -> Option<Figure> {
    let own: Vec<&ErrorRecord> = verdicts
        .iter()
        .filter(|v| {
            v.projectile == projectile && v.target == target && v.length_to_diameter == length
        })
        .collect();
    let reference: Vec<&ErrorRecord> = VELOCITIES
        .iter()
        .filter_map(|&speed| own.iter().find(|v| v.impact_velocity_m_s == speed).copied())
        .collect();
    if reference.is_empty() {
        return None;
    }
    let chart = LineChart::new(
        format!("depth-{}-on-{}-{length}", stem(projectile), stem(target)),
        format!("Depth of penetration, L/D {length}"),
        Axis::new("Impact velocity (m/s)"),
        Axis::new("Depth of penetration (mm)").log(),
    )
    .caption(format!(
        "{} on {}; candidates of smallest median error; bars: uncertainty of the reference due to its cells",
        material(projectile),
        material(target)
    ));
    let symbols = palette::model_symbols(names.iter().copied());
    let chart = names
        .iter()
        .zip(symbols)
        .fold(chart, |chart, (name, symbol)| {
            let points = own
                .iter()
                .filter(|v| v.candidate == *name)
                .map(|v| (v.impact_velocity_m_s, v.depth_of_penetration_mm));
            let points: Vec<(f64, f64)> = points.collect();
            match points.is_empty() {
                true => chart,
                false => chart.series(
                    Series::new(label(name), points)
                        .style(Style::LineAndMarkers)
                        .symbol(symbol),
                ),
            }
        });
    let bars = reference.iter().map(|v| {
        let size = v.reference_uncertainty_mm;
        // A logarithmic axis cannot show a bar that ends at zero.
        (size.min(0.9 * v.reference_depth_mm), size)
    });
    let points = reference
        .iter()
        .map(|v| (v.impact_velocity_m_s, v.reference_depth_mm));
    let series = Series::new(format!("{}, the reference", label("axi")), points)
        .style(Style::Markers)
        .color(palette::EXPERIMENT)
        .error_bars(bars);
    Some(chart.series(series).draw())
}
