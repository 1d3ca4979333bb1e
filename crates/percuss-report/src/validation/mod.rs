//! The validation report: tables, figures and numbers of a [`Validation`], as HTML, Markdown, CSV and Parquet.

mod content;
mod figures;
mod numbers;
pub mod tables;

use std::path::{Path, PathBuf};

use percuss::validate::Validation;

use crate::{
    FigureFormat, ReportError,
    figure::{IN_PAGES, write_figures},
    page::{self, html},
};

/// Origin of a report: its tests and command.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Origin {
    /// Files of tests, or the name of the built-in ones.
    pub files: Vec<String>,
    /// The command that made the report.
    pub command: String,
}

/// Writes the report to a folder, which is made if it does not exist. Files of these names are replaced:
///
/// - `validation.html`: the whole report in one file, with every test and its citation;
/// - `validation.md` with one PNG per figure: the same without the single tests;
/// - the figures in other formats;
/// - `predictions.csv`, `predictions.parquet`: one row per test, material record and model, with citation;
/// - `statistics.csv`, `statistics.parquet`: one row per group.
///
/// # Errors
/// [`ReportError::Write`]; [`ReportError::Figure`]; [`ReportError::Table`].
pub fn write(
    folder: &Path,
    validation: &Validation,
    origin: &Origin,
    formats: &[FigureFormat],
) -> Result<Vec<PathBuf>, ReportError> {
    let figures = figures::draw(validation);
    let page = content::page(validation, origin, &figures);
    let figures_of_page = figures.iter().map(|figure| &figure.drawing);
    let files = numbers::files(validation)?;
    let mut written = page::write(folder, "validation", &page, figures_of_page, files)?;
    let mut others = formats.to_vec();
    others.retain(|format| format.suffix() != IN_PAGES);
    let drawings: Vec<_> = figures.into_iter().map(|figure| figure.drawing).collect();
    written.extend(write_figures(folder, &drawings, &others, &|_, _| {})?);
    Ok(written)
}

/// The report as one self-contained HTML page.
pub fn html(validation: &Validation, origin: &Origin) -> String {
    let figures = figures::draw(validation);
    html::render(&content::page(validation, origin, &figures))
}
