//! Comparison with other codes: their stored results on cases of percuss, the same cases computed again, and a page about both.

mod dimension;
mod figures;
pub mod outside;
mod page;
mod quantity;
pub mod rate;

use std::path::{Path, PathBuf};

use percuss::{
    Error,
    model::{self, Control},
    outcome::RunResult,
    solver::go_on_to_next_run,
    units::significant,
};
use percuss_report::{
    FigureFormat, ReportError,
    column::{self, Column},
    replace_file::replace_file,
};
use serde::Serialize;

use crate::paper::OnProgress;

pub use dimension::{DimensionStudy, LineRun, RodRun};
pub use outside::OutsideResult;
pub use quantity::Quantity;

/// A number of another code beside that of percuss.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ComparedValue {
    /// The other code.
    #[serde(flatten)]
    pub outside: OutsideResult,
    /// Value of percuss in the same unit.
    pub percuss: f64,
    /// Relative difference of percuss from the other code [%]; of a quantity in per cent, the difference.
    pub found_percent: f64,
}

impl ComparedValue {
    /// Whether the difference is the stated one within its tolerance.
    pub fn holds(&self) -> bool {
        let outside = &self.outside;
        (self.found_percent - outside.difference_percent).abs() <= outside.tolerance_percent
    }
}

/// Comparison with other codes.
#[derive(Debug, Clone, PartialEq)]
pub struct CodeComparison {
    /// Every stored number, in the order of the file.
    pub values: Vec<ComparedValue>,
    /// Taylor rods in one and two dimensions.
    pub dimension: DimensionStudy,
}

/// A run of percuss that stored numbers are compared with.
struct Run {
    of: OutsideResult,
    result: RunResult,
}

impl Run {
    fn is_for(&self, row: &OutsideResult) -> bool {
        let own = &self.of;
        own.case == row.case
            && own.impact_velocity_m_s == row.impact_velocity_m_s
            && own.model == row.model
            && own.mesh == row.mesh
    }
}

/// Calls back and stops where the caller wants it.
struct Steps<'a, 'b> {
    done: f64,
    total: f64,
    progress: &'a mut OnProgress<'b>,
}

impl Steps<'_, '_> {
    fn next(&mut self) -> Result<(), Error> {
        let fraction = (self.done / self.total).min(1.0);
        self.done += 1.0;
        go_on_to_next_run((self.progress)(fraction))
    }
}

/// Computes every compared case and the rods of several diameters.
///
/// # Errors
/// Those of the runs; [`Error::Cancelled`] when `progress` stops the work.
pub fn compare_codes(mut progress: OnProgress<'_>) -> Result<CodeComparison, Error> {
    let rows = outside::built_in();
    let studies = dimension::SLENDERNESS.len() + 2 * dimension::ELEMENTS.len();
    let mut steps = Steps {
        done: 0.0,
        total: (rows.len() + studies) as f64,
        progress: &mut progress,
    };
    let mut runs: Vec<Run> = Vec::new();
    let mut values = Vec::new();
    for row in rows {
        steps.next()?;
        let percuss = value(&row, &mut runs)?;
        let found_percent = match row.unit.as_str() {
            "%" => percuss - row.value,
            _ => 100.0 * (percuss / row.value - 1.0),
        };
        values.push(ComparedValue {
            outside: row,
            percuss,
            found_percent,
        });
    }
    let mut rods = Vec::new();
    for slenderness in dimension::SLENDERNESS {
        steps.next()?;
        rods.push(dimension::rod(slenderness)?);
    }
    let mut lines = Vec::new();
    for model in ["chain", "fdm"] {
        for elements in dimension::ELEMENTS {
            steps.next()?;
            lines.push(dimension::line(model, elements)?);
        }
    }
    Ok(CodeComparison {
        values,
        dimension: DimensionStudy {
            length_mm: dimension::length_mm()?,
            rods,
            lines,
        },
    })
}

/// Number of percuss for a stored one, by a run that is made once; NaN where the run has none.
fn value(row: &OutsideResult, runs: &mut Vec<Run>) -> Result<f64, Error> {
    let mut scenario = outside::scenario(&row.case, row.impact_velocity_m_s)?;
    outside::set_mesh(&mut scenario, &row.model, row.mesh);
    if row.quantity == Quantity::StressExcess {
        return Ok(rate::stress_excess(&scenario)?.unwrap_or(f64::NAN));
    }
    let of = |result: &RunResult| row.quantity.of(result).unwrap_or(f64::NAN);
    let has_history = |run: &Run| !row.quantity.needs_history() || run.result.history.is_some();
    if let Some(run) = runs.iter().find(|run| run.is_for(row) && has_history(run)) {
        return Ok(of(&run.result));
    }
    let mut control = match row.quantity.needs_history() {
        true => Control::recording(),
        false => Control::default(),
    };
    let result = model::run(model::model(&row.model)?, &scenario, &mut control)?;
    let found = of(&result);
    runs.push(Run {
        of: row.clone(),
        result,
    });
    Ok(found)
}

impl CodeComparison {
    /// Writes the page `codes.md`, its figures and its tables as CSV to a folder, which is made if it does not exist.
    ///
    /// # Errors
    /// [`ReportError::Write`]; [`ReportError::Figure`]; [`ReportError::Table`].
    pub fn write(&self, folder: &Path) -> Result<Vec<PathBuf>, ReportError> {
        let mut written = vec![replace_file(folder, "codes.md", self.page().as_bytes())?];
        let name = "comparison.csv";
        let table = column::csv(name, &columns(), &self.values)?;
        written.push(replace_file(folder, name, &table)?);
        for figure in figures::draw(self) {
            written.extend(figure.write(folder, FigureFormat::DEFAULT)?);
        }
        Ok(written)
    }

    /// The page as Markdown.
    pub fn page(&self) -> String {
        page::text(self)
    }

    /// One line per compared number.
    pub fn findings(&self) -> Vec<String> {
        let line = |value: &ComparedValue| {
            let row = &value.outside;
            format!(
                "{}, {} m/s, {}: {} {} by {} ({}), {} by {} ({}): difference {}{}",
                row.case,
                row.impact_velocity_m_s,
                row.quantity.label(),
                significant(row.value, 4),
                row.unit,
                row.code,
                row.resolution,
                significant(value.percuss, 4),
                row.model,
                row.mesh,
                percent(value.found_percent),
                if value.holds() {
                    ""
                } else {
                    ", outside the stated tolerance"
                }
            )
        };
        self.values.iter().map(line).collect()
    }
}

/// A difference [%] with its sign; zero has none of its own.
fn percent(value: f64) -> String {
    let rounded = (10.0 * value).round() / 10.0 + 0.0;
    format!("{rounded:+.1} %").replace('-', "\u{2212}")
}

fn columns() -> Vec<Column<ComparedValue>> {
    vec![
        Column::text("case", |v: &ComparedValue| v.outside.case.clone()),
        Column::float("impact_velocity_m_s", |v: &ComparedValue| {
            v.outside.impact_velocity_m_s
        }),
        Column::text("code", |v: &ComparedValue| v.outside.code.clone()),
        Column::text("commit", |v: &ComparedValue| v.outside.commit.clone()),
        Column::text("resolution", |v: &ComparedValue| {
            v.outside.resolution.clone()
        }),
        Column::text("quantity", |v: &ComparedValue| {
            v.outside.quantity.label().to_owned()
        }),
        Column::float("value", |v: &ComparedValue| v.outside.value),
        Column::text("unit", |v: &ComparedValue| v.outside.unit.clone()),
        Column::text("model", |v: &ComparedValue| v.outside.model.clone()),
        Column::integer("mesh", |v: &ComparedValue| i64::from(v.outside.mesh)),
        Column::float("percuss", |v: &ComparedValue| v.percuss),
        Column::float("difference_percent", |v: &ComparedValue| v.found_percent),
        Column::float("tolerance_percent", |v: &ComparedValue| {
            v.outside.tolerance_percent
        }),
        Column::text("note", |v: &ComparedValue| v.outside.note.clone()),
    ]
}
