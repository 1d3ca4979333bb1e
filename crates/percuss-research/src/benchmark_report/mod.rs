//! Report of the benchmark: every depth model against the axisymmetric reference, as HTML, Markdown, CSV and Parquet.

mod content;
mod figures;
mod numbers;
pub mod tables;

use std::path::{Path, PathBuf};

use percuss::{Error, model_error::ErrorRecord};
use percuss_report::{ReportError, page};

use crate::{
    benchmark::{self, BenchmarkCase, CheckedReference, Reference},
    paper_case::{
        PaperCaseRow,
        variants::{self, VariantResult},
    },
};

/// Results of the benchmark.
#[derive(Debug, Clone, PartialEq)]
pub struct BenchmarkResults {
    /// The reference of every case on its meshes, checked.
    pub references: Vec<CheckedReference>,
    /// Every candidate on every case whose reference passes the check.
    pub verdicts: Vec<ErrorRecord>,
    /// The paper's case by the reference.
    pub paper_case: Vec<PaperCaseRow>,
    /// The paper's case by one-dimensional variants.
    pub variants: Vec<VariantResult>,
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
    /// Compares all candidates with the references of the cases.
    ///
    /// # Errors
    /// [`Error::Input`] when a case's materials are not in the library.
    pub fn new(
        cases: &[BenchmarkCase],
        references: &[Reference],
        paper_case: Vec<PaperCaseRow>,
    ) -> Result<Self, Error> {
        Ok(Self {
            verdicts: benchmark::compare(cases, references)?,
            variants: variants::compute(&paper_case)?,
            references: benchmark::check_references(cases, references),
            paper_case,
        })
    }
}

/// Writes the report to a folder, which is made if it does not exist. Files of these names are replaced:
///
/// - `benchmark.html`: the whole report in one file;
/// - `benchmark.md` with one PNG a figure: the same without the single cases and some of the figures;
/// - `verdicts.csv`, `verdicts.parquet`: one row per candidate and case; the first is the file that the library stores;
/// - `references.csv`, `references.parquet`: a row per case, with the depth by the reference or why it does not count;
/// - `statistics.csv`, `statistics.parquet`: one row per candidate and group;
/// - `variants.csv`, `variants.parquet`: case of the seed paper by one-dimensional variants.
///
/// # Errors
/// [`ReportError::Write`]; [`ReportError::Figure`]; [`ReportError::Table`].
pub fn write(
    folder: &Path,
    compared: &BenchmarkResults,
    origin: &Origin,
) -> Result<Vec<PathBuf>, ReportError> {
    let figures = figures::BenchmarkFigures::of(&compared.verdicts);
    let page = content::page(compared, origin, &figures);
    let files = numbers::files(compared)?;
    page::write(folder, "benchmark", &page, figures.in_markdown(), files)
}
