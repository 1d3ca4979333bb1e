//! Report of the benchmark: every depth model against the axisymmetric reference, as HTML, Markdown, CSV and Parquet.

mod content;
mod figures;
mod numbers;
pub mod tables;

use std::path::{Path, PathBuf};

use percuss::{Error, model_error::Verdict};
use percuss_report::{ReportError, page};

use crate::{
    benchmark::{self, CheckedReference, Reference, Shot},
    paper_case::{
        Study,
        ablation::{self, Line},
    },
};

/// Results of the benchmark.
#[derive(Debug, Clone, PartialEq)]
pub struct BenchmarkResults {
    /// The reference of every shot on its meshes, checked.
    pub references: Vec<CheckedReference>,
    /// Every contender on every shot whose reference passes the check.
    pub verdicts: Vec<Verdict>,
    /// The paper's case by the reference.
    pub study: Vec<Study>,
    /// The paper's case by one-dimensional variants.
    pub ablation: Vec<Line>,
}

/// Origin of a report.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Origin {
    /// Where the reference comes from.
    pub reference: String,
    /// The command that made the report.
    pub command: String,
}

impl BenchmarkResults {
    /// Compares all contenders with the references of the shots.
    ///
    /// # Errors
    /// [`Error::Input`] when a shot's materials are not in the library.
    pub fn new(shots: &[Shot], references: &[Reference], study: Vec<Study>) -> Result<Self, Error> {
        Ok(Self {
            verdicts: benchmark::compare(shots, references)?,
            ablation: ablation::ablation(&study)?,
            references: benchmark::check_references(shots, references),
            study,
        })
    }
}

/// Writes the report to a folder, which is made if it does not exist. Files of these names are replaced:
///
/// - `benchmark.html`: the whole report in one file;
/// - `benchmark.md` with one PNG a figure: the same without the single shots and some of the figures;
/// - `verdicts.csv`, `verdicts.parquet`: one row per contender and shot; the first is the file that the library stores;
/// - `references.csv`, `references.parquet`: a row per shot, with the depth by the reference or why it does not count;
/// - `statistics.csv`, `statistics.parquet`: one row per contender and group;
/// - `ablation.csv`, `ablation.parquet`: the paper's case by one-dimensional variants.
///
/// # Errors
/// [`ReportError::Write`]; [`ReportError::Figure`]; [`ReportError::Table`].
pub fn write(
    folder: &Path,
    compared: &BenchmarkResults,
    origin: &Origin,
) -> Result<Vec<PathBuf>, ReportError> {
    let figures = figures::Drawn::of(&compared.verdicts);
    let page = content::page(compared, origin, &figures);
    let files = numbers::files(compared)?;
    page::write(folder, "benchmark", &page, figures.in_markdown(), files)
}
