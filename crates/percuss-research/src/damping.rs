//! What damping does to the depth in the seed paper's case, which suspected it of its mismatch at high speed.

use std::path::{Path, PathBuf};

use percuss::{
    Error,
    model::{self, Control},
    units::significant,
};
use percuss_report::{
    Axis, Figure, LineChart, ReportError, Series, Style,
    column::{self, Column},
    palette,
    replace_file::replace_file,
};
use serde::Serialize;

use crate::{
    paper::OnProgress,
    paper_case::{self, ablation::REFERENCE},
};

/// A way to damp: its name and the options that make it. Another one is one line here.
const WAYS: &[(&str, &str)] = &[
    ("none", ""),
    ("ratio 0.05", "damping_ratio = 0.05"),
    ("ratio 0.1", "damping_ratio = 0.1"),
    ("ratio 0.2", "damping_ratio = 0.2"),
    ("ratio 0.5", "damping_ratio = 0.5"),
    (
        "viscosity 0.06, 1.5",
        "artificial_viscosity = { linear = 0.06, quadratic = 1.5 }",
    ),
    ("local 0.2", "local_damping = 0.2"),
    ("local 0.8", "local_damping = 0.8"),
];

/// Impact speeds [m/s], on the paper's mesh.
const SPEEDS: [f64; 8] = [100.0, 150.0, 230.0, 300.0, 400.0, 500.0, 600.0, 700.0];
/// Elements along the projectile; the target has twice as many.
const MESHES: [u32; 5] = [20, 40, 80, 160, 320];
/// The paper's mesh.
const PAPER_MESH: u32 = 40;
/// Speeds of the study of meshes [m/s]: the paper's, at which nothing erodes, and one at which the rod erodes.
const MESH_SPEEDS: [f64; 2] = [230.0, 600.0];

/// A shot of the paper's case.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Shot {
    /// Way of damping.
    #[serde(rename = "damping")]
    pub way: &'static str,
    /// Impact speed [m/s].
    #[serde(rename = "impact_velocity_m_s")]
    pub speed: f64,
    /// Elements along the projectile.
    #[serde(rename = "projectile_elements")]
    pub elements: u32,
    /// Depth of penetration [mm].
    #[serde(rename = "depth_of_penetration_mm")]
    pub depth_mm: f64,
    /// Energy that damping and viscosity took, as a part of the impact energy.
    #[serde(rename = "damped_energy")]
    pub damped: f64,
    /// Energy that left with what eroded, as a part of the impact energy.
    #[serde(rename = "eroded_energy")]
    pub eroded: f64,
    /// Relative change of the depth against the same shot without damping.
    pub change: f64,
}

/// The study.
#[derive(Debug, Clone, PartialEq)]
pub struct DampingStudy {
    /// All shots.
    pub shots: Vec<Shot>,
    /// Depth by the axisymmetric reference [mm], where there is one, with its impact speed [m/s].
    pub reference: Vec<(f64, f64)>,
}

/// Computes the study.
///
/// # Errors
/// Those of the runs; [`Error::Cancelled`] when `progress` breaks off.
pub fn damping_study(progress: OnProgress<'_>) -> Result<DampingStudy, Error> {
    let speeds = SPEEDS.map(|speed| (speed, PAPER_MESH));
    let meshes = MESH_SPEEDS.map(|speed| MESHES.map(|elements| (speed, elements)));
    let mut places = [speeds.as_slice(), meshes.as_flattened()].concat();
    places.sort_by(|a, b| a.1.cmp(&b.1).then(a.0.total_cmp(&b.0)));
    places.dedup();
    let total = (places.len() * WAYS.len()) as f64;
    let mut shots: Vec<Shot> = Vec::new();
    for (speed, elements) in places {
        let mut undamped = f64::NAN;
        for (i, (way, options)) in WAYS.iter().enumerate() {
            if progress(shots.len() as f64 / total).is_break() {
                return Err(Error::Cancelled {
                    step: 0,
                    time_us: 0.0,
                });
            }
            let (depth_mm, damped, eroded) = run(speed, elements, options)?;
            if i == 0 {
                undamped = depth_mm;
            }
            shots.push(Shot {
                way,
                speed,
                elements,
                depth_mm,
                damped,
                eroded,
                change: depth_mm / undamped - 1.0,
            });
        }
    }
    let known = paper_case::built_in();
    let depth = |speed: &f64| Some((*speed, paper_case::depth(&known, *speed)?.depth_mm));
    Ok(DampingStudy {
        shots,
        reference: paper_case::SPEEDS.iter().filter_map(depth).collect(),
    })
}

/// Depth [mm], and the parts of the energy that were damped away and that left with what eroded.
fn run(speed: f64, elements: u32, options: &str) -> Result<(f64, f64, f64), Error> {
    let target = 2 * elements;
    let options = format!(
        "[chain]\ntarget_resistance = \"column\"\nprojectile_elements = {elements}\ntarget_elements = {target}\n{options}\n"
    );
    let scenario = paper_case::scenario(speed, &options)?;
    let result = model::run(model::model("chain")?, &scenario, &mut Control::default())?;
    let energy = &result.numerics().energy;
    let depth = result.depth_of_penetration.unwrap_or(f64::NAN);
    let part = |of: f64| of / energy.initial;
    Ok((depth * 1e3, part(energy.viscous), part(energy.eroded)))
}

impl DampingStudy {
    /// Writes figures and the table `damping.csv` to a folder, which is made if it does not exist.
    ///
    /// # Errors
    /// [`ReportError::Write`]; [`ReportError::Figure`]; [`ReportError::Table`].
    pub fn write(&self, folder: &Path) -> Result<Vec<PathBuf>, ReportError> {
        let name = "damping.csv";
        let table = column::csv(name, &columns(), &self.shots)?;
        let mut written = vec![replace_file(folder, name, &table)?];
        let meshes = MESH_SPEEDS.map(|speed| self.meshes(speed));
        for figure in std::iter::once(self.speeds()).chain(meshes) {
            written.extend(figure.write(folder)?);
        }
        Ok(written)
    }

    /// What it comes to, one line each.
    pub fn findings(&self) -> Vec<String> {
        let percent = |part: f64| format!("{:+.1} %", 100.0 * part);
        let at = |way: &str, speed: f64, elements: u32| {
            let mut shots = self.shots.iter();
            shots.find(|s| s.way == way && s.speed == speed && s.elements == elements)
        };
        let mut lines = Vec::new();
        for (way, _) in &WAYS[1..] {
            let changes = MESH_SPEEDS.map(|speed| {
                let change = |elements: u32| {
                    let shot = at(way, speed, elements);
                    let change = shot.map_or_else(String::new, |s| percent(s.change));
                    format!("{change} with {elements} elements")
                };
                let finest = MESHES[MESHES.len() - 1];
                format!(
                    "at {speed} m/s {} and {}",
                    change(PAPER_MESH),
                    change(finest)
                )
            });
            lines.push(format!("{way}: the depth changes {}", changes.join(", ")));
        }
        for (speed, depth) in &self.reference {
            if let Some(shot) = at(WAYS[0].0, *speed, PAPER_MESH) {
                lines.push(format!(
                    "{REFERENCE} at {speed} m/s: {} mm, where the undamped column gives {} mm: off by {}",
                    significant(*depth, 3),
                    significant(shot.depth_mm, 3),
                    percent(shot.depth_mm / depth - 1.0)
                ));
            }
        }
        lines
    }

    fn of(&self, way: &str, keep: impl Fn(&Shot) -> bool) -> Vec<&Shot> {
        let shots = self.shots.iter();
        shots.filter(|shot| shot.way == way && keep(shot)).collect()
    }

    fn speeds(&self) -> Figure {
        let mut chart = LineChart::new(
            "damping-speed",
            "Depth against speed with damping: the seed paper's case",
            Axis::new("impact speed [m/s]"),
            Axis::new("depth of penetration [mm]").log(),
        )
        .caption(format!(
            "chain, column, {PAPER_MESH} and {} elements; {REFERENCE}: the axisymmetric reference",
            2 * PAPER_MESH
        ));
        for (index, (way, _)) in WAYS.iter().enumerate() {
            let shots = self.of(way, |shot| shot.elements == PAPER_MESH);
            let points = shots.iter().map(|shot| (shot.speed, shot.depth_mm));
            chart = chart.series(
                Series::new(*way, points)
                    .style(Style::LineAndMarkers)
                    .symbol(index),
            );
        }
        let reference = Series::new(REFERENCE, self.reference.iter().copied());
        chart
            .series(reference.style(Style::Markers).color(palette::EXPERIMENT))
            .draw()
    }

    fn meshes(&self, speed: f64) -> Figure {
        let mut chart = LineChart::new(
            format!("damping-mesh-{speed}"),
            format!("What damping changes, against the mesh: {speed} m/s"),
            Axis::new("elements along the projectile").log(),
            Axis::new("change of the depth [%]"),
        )
        .caption("the seed paper's case; chain, column; against the same mesh without damping");
        for (index, (way, _)) in WAYS.iter().enumerate().skip(1) {
            let mut shots = self.of(way, |shot| shot.speed == speed);
            shots.sort_by_key(|shot| shot.elements);
            let points = shots
                .iter()
                .map(|shot| (f64::from(shot.elements), 100.0 * shot.change));
            chart = chart.series(
                Series::new(*way, points)
                    .style(Style::LineAndMarkers)
                    .symbol(index),
            );
        }
        chart.draw()
    }
}

fn columns() -> Vec<Column<Shot>> {
    vec![
        Column::text("damping", |s: &Shot| s.way.to_owned()),
        Column::float("impact_velocity_m_s", |s: &Shot| s.speed),
        Column::integer("projectile_elements", |s: &Shot| i64::from(s.elements)),
        Column::float("depth_of_penetration_mm", |s: &Shot| s.depth_mm),
        Column::float("change", |s: &Shot| s.change),
        Column::float("damped_energy", |s: &Shot| s.damped),
        Column::float("eroded_energy", |s: &Shot| s.eroded),
    ]
}
