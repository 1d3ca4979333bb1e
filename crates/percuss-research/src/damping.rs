//! Damping study: effect of damping on the depth of penetration in the case of the seed paper.

use std::path::{Path, PathBuf};

use percuss::{
    Error,
    model::{self, Control},
    solver::go_on_to_next_run,
    units::significant,
};
use percuss_report::{
    Axis, Figure, FigureFormat, LineChart, ReportError, Series, Style,
    column::{self, Column},
    palette,
    replace_file::replace_file,
};
use serde::Serialize;

use crate::{
    paper::OnProgress,
    paper_case::{self, variants::REFERENCE},
};

/// Ways of damping: name and options.
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

/// Impact velocities on the mesh of the paper [m/s].
const SPEEDS: [f64; 8] = [100.0, 150.0, 230.0, 300.0, 400.0, 500.0, 600.0, 700.0];
/// Elements along the projectile; the target has twice as many.
const MESHES: [u32; 5] = [20, 40, 80, 160, 320];
/// The paper's mesh.
const PAPER_MESH: u32 = 40;
/// Impact velocities of the mesh study [m/s]: that of the paper without erosion, and one with an eroding rod.
const MESH_SPEEDS: [f64; 2] = [230.0, 600.0];

/// Run of the case of the seed paper.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DampingRun {
    /// Way of damping.
    #[serde(rename = "damping")]
    pub way: &'static str,
    /// Impact velocity [m/s].
    #[serde(rename = "impact_velocity_m_s")]
    pub speed: f64,
    /// Elements along the projectile.
    #[serde(rename = "projectile_elements")]
    pub elements: u32,
    /// Depth of penetration [mm].
    #[serde(rename = "depth_of_penetration_mm")]
    pub depth_mm: f64,
    /// Energy dissipated by damping and viscosity, as a fraction of the impact energy.
    #[serde(rename = "damped_energy")]
    pub damped: f64,
    /// Energy of eroded material, as a fraction of the impact energy.
    #[serde(rename = "eroded_energy")]
    pub eroded: f64,
    /// Relative change of the depth compared with the same run without damping.
    pub change: f64,
}

/// Damping study.
#[derive(Debug, Clone, PartialEq)]
pub struct DampingStudy {
    /// All runs.
    pub runs: Vec<DampingRun>,
    /// Impact velocity [m/s] and depth [mm] of the axisymmetric reference.
    pub reference: Vec<(f64, f64)>,
}

/// Computes the study.
///
/// # Errors
/// Those of the runs; [`Error::Cancelled`] when `progress` stops the work.
pub fn damping_study(progress: OnProgress<'_>) -> Result<DampingStudy, Error> {
    let speeds = SPEEDS.map(|speed| (speed, PAPER_MESH));
    let meshes = MESH_SPEEDS.map(|speed| MESHES.map(|elements| (speed, elements)));
    let mut places = [speeds.as_slice(), meshes.as_flattened()].concat();
    places.sort_by(|a, b| a.1.cmp(&b.1).then(a.0.total_cmp(&b.0)));
    places.dedup();
    let total = (places.len() * WAYS.len()) as f64;
    let mut runs: Vec<DampingRun> = Vec::new();
    for (speed, elements) in places {
        let mut undamped = f64::NAN;
        for (i, (way, options)) in WAYS.iter().enumerate() {
            go_on_to_next_run(progress(runs.len() as f64 / total))?;
            let (depth_mm, damped, eroded) = run(speed, elements, options)?;
            if i == 0 {
                undamped = depth_mm;
            }
            runs.push(DampingRun {
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
        runs,
        reference: paper_case::SPEEDS.iter().filter_map(depth).collect(),
    })
}

/// Depth [mm], and the fractions of damped and eroded energy.
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
        let table = column::csv(name, &columns(), &self.runs)?;
        let mut written = vec![replace_file(folder, name, &table)?];
        let meshes = MESH_SPEEDS.map(|speed| self.meshes(speed));
        for figure in std::iter::once(self.speeds()).chain(meshes) {
            written.extend(figure.write(folder, FigureFormat::DEFAULT)?);
        }
        Ok(written)
    }

    /// Findings, one per line.
    pub fn findings(&self) -> Vec<String> {
        let percent = |part: f64| format!("{:+.1} %", 100.0 * part);
        let at = |way: &str, speed: f64, elements: u32| {
            let mut runs = self.runs.iter();
            runs.find(|s| s.way == way && s.speed == speed && s.elements == elements)
        };
        let mut lines = Vec::new();
        for (way, _) in &WAYS[1..] {
            let changes = MESH_SPEEDS.map(|speed| {
                let change = |elements: u32| {
                    let row = at(way, speed, elements);
                    let change = row.map_or_else(String::new, |s| percent(s.change));
                    format!("{change} with {elements} elements")
                };
                let finest = MESHES[MESHES.len() - 1];
                format!(
                    "at {speed} m/s {} and {}",
                    change(PAPER_MESH),
                    change(finest)
                )
            });
            lines.push(format!("{way}: change of the depth {}", changes.join(", ")));
        }
        for (speed, depth) in &self.reference {
            if let Some(row) = at(WAYS[0].0, *speed, PAPER_MESH) {
                lines.push(format!(
                    "{REFERENCE} at {speed} m/s: {} mm, compared with {} mm by the undamped column: relative error {}",
                    significant(*depth, 3),
                    significant(row.depth_mm, 3),
                    percent(row.depth_mm / depth - 1.0)
                ));
            }
        }
        lines
    }

    fn of(&self, way: &str, keep: impl Fn(&DampingRun) -> bool) -> Vec<&DampingRun> {
        let runs = self.runs.iter();
        runs.filter(|row| row.way == way && keep(row)).collect()
    }

    fn speeds(&self) -> Figure {
        let mut chart = LineChart::new(
            "damping-speed",
            "Depth of penetration versus impact velocity with damping",
            Axis::new("Impact velocity (m/s)"),
            Axis::new("Depth of penetration (mm)").log(),
        )
        .caption(format!(
            "case of the seed paper; chain, column, {PAPER_MESH} and {} elements; {REFERENCE}: the axisymmetric reference",
            2 * PAPER_MESH
        ));
        for (index, (way, _)) in WAYS.iter().enumerate() {
            let runs = self.of(way, |row| row.elements == PAPER_MESH);
            let points = runs.iter().map(|row| (row.speed, row.depth_mm));
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
            format!("Change of the depth of penetration by damping versus mesh, {speed} m/s"),
            Axis::new("Elements along the projectile").log(),
            Axis::new("Change of the depth (%)"),
        )
        .caption(
            "case of the seed paper; chain, column; relative to the same mesh without damping",
        );
        for (index, (way, _)) in WAYS.iter().enumerate().skip(1) {
            let mut runs = self.of(way, |row| row.speed == speed);
            runs.sort_by_key(|row| row.elements);
            let points = runs
                .iter()
                .map(|row| (f64::from(row.elements), 100.0 * row.change));
            chart = chart.series(
                Series::new(*way, points)
                    .style(Style::LineAndMarkers)
                    .symbol(index),
            );
        }
        chart.draw()
    }
}

fn columns() -> Vec<Column<DampingRun>> {
    vec![
        Column::text("damping", |s: &DampingRun| s.way.to_owned()),
        Column::float("impact_velocity_m_s", |s: &DampingRun| s.speed),
        Column::integer("projectile_elements", |s: &DampingRun| {
            i64::from(s.elements)
        }),
        Column::float("depth_of_penetration_mm", |s: &DampingRun| s.depth_mm),
        Column::float("change", |s: &DampingRun| s.change),
        Column::float("damped_energy", |s: &DampingRun| s.damped),
        Column::float("eroded_energy", |s: &DampingRun| s.eroded),
    ]
}
