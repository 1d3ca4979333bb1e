//! Reproduction of the seed paper, item by item.

mod figures;
mod finite_differences;
mod runs;
mod table1;

use std::{
    fmt::{self, Write as _},
    ops::ControlFlow,
    path::{Path, PathBuf},
};

use percuss::Error;
use percuss_report::{
    Figure, FigureFormat, ReportError, figure::IN_PAGES, replace_file::replace_file,
};
use serde::Serialize;

/// Assessment of one statement of the paper.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Assessment {
    /// The computation gives the same.
    Reproduced,
    /// The result depends on the interpretation of the paper.
    ReadingDependent,
    /// The computation gives another result.
    Contradicted,
    /// The text has not enough information for a check.
    CannotBeKnown,
}

impl fmt::Display for Assessment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Reproduced => "reproduced",
            Self::ReadingDependent => "depends on the interpretation",
            Self::Contradicted => "contradicted",
            Self::CannotBeKnown => "not verifiable",
        })
    }
}

/// Statement of the paper with its assessment.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Item {
    /// Place in the paper.
    pub place: &'static str,
    /// Paraphrase of the statement.
    pub statement: String,
    /// Assessment.
    pub assessment: Assessment,
    /// Computed numbers.
    pub finding: String,
}

/// A table of computed numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Table {
    /// Title.
    pub title: String,
    /// Column headings with units.
    pub columns: Vec<String>,
    /// Rows of numbers as text.
    pub rows: Vec<Vec<String>>,
}

/// Reproduction of the paper.
#[derive(Debug, Clone, PartialEq)]
pub struct Reproduction {
    /// Statements.
    pub items: Vec<Item>,
    /// Tables of computed numbers.
    pub tables: Vec<Table>,
    /// The figures.
    pub figures: Vec<Figure>,
}

/// Callback with the progress, 0 to 1; it may stop the work.
pub type OnProgress<'a> = &'a mut dyn FnMut(f64) -> ControlFlow<()>;

/// Checks the statements of the paper's Table 1 and figures 7 to 11.
///
/// # Errors
/// Those of the runs; [`Error::Cancelled`] when `progress` stops the work.
pub fn reproduce(progress: OnProgress<'_>) -> Result<Reproduction, Error> {
    let runs = runs::Runs::compute(progress)?;
    let (mut items, mut tables) = (Vec::new(), Vec::new());
    table1::check(&runs, &mut items);
    figures::check(&runs, &mut items, &mut tables);
    Ok(Reproduction {
        items,
        tables,
        figures: figures::draw(&runs),
    })
}

impl Reproduction {
    /// Writes the page `paper.md`, its figures and its tables as CSV to a folder.
    ///
    /// # Errors
    /// [`ReportError::Write`]; [`ReportError::Figure`]; [`ReportError::Table`].
    pub fn write(&self, folder: &Path) -> Result<Vec<PathBuf>, ReportError> {
        let mut written = vec![replace_file(folder, "paper.md", self.page().as_bytes())?];
        for figure in &self.figures {
            written.extend(figure.write(folder, FigureFormat::DEFAULT)?);
        }
        for (i, table) in self.tables.iter().enumerate() {
            let name = format!("table-{}.csv", i + 1);
            written.push(replace_file(folder, &name, &table.csv(&name)?)?);
        }
        Ok(written)
    }

    /// The page as Markdown.
    pub fn page(&self) -> String {
        let mut page = String::from(INTRODUCTION);
        page.push_str(
            "\n## Item by item\n\n| place | statement | assessment | computed |\n|---|---|---|---|\n",
        );
        for item in &self.items {
            // Writing to a String cannot fail.
            let _ = writeln!(
                page,
                "| {} | {} | **{}** | {} |",
                item.place, item.statement, item.assessment, item.finding
            );
        }
        page.push_str("\n## Figures\n");
        for figure in &self.figures {
            let _ = write!(
                page,
                "\n![{0}]({1}.{IN_PAGES})\n\n*{0}*\n",
                figure.title, figure.name
            );
        }
        page.push_str("\n## Numbers\n");
        for table in &self.tables {
            let _ = write!(
                page,
                "\n{}\n\n| {} |\n|",
                table.title,
                table.columns.join(" | ")
            );
            page.push_str(&"---:|".repeat(table.columns.len()));
            page.push('\n');
            for row in &table.rows {
                let _ = writeln!(page, "| {} |", row.join(" | "));
            }
        }
        page
    }
}

impl Table {
    fn csv(&self, name: &str) -> Result<Vec<u8>, ReportError> {
        let fail = |source: Box<dyn std::error::Error + Send + Sync>| ReportError::Table {
            table: name.to_owned(),
            source,
        };
        let mut writer = csv::Writer::from_writer(Vec::new());
        for row in std::iter::once(&self.columns).chain(&self.rows) {
            writer
                .write_record(row)
                .map_err(|error| fail(error.into()))?;
        }
        writer
            .into_inner()
            .map_err(|error| fail(error.to_string().into()))
    }
}

const INTRODUCTION: &str = "\
# The seed paper, item by item

*Simulation of depth of penetration during ballistic impact on thick targets using a one-dimensional discrete element
model* (bibliography key `paper`): a copper rod impacts a thick 2024-T351 plate. Its text was available; its figures were not,
so this page checks the statements of the text about them. All numbers were computed by the run that wrote the page.

Three schemes are compared:

- **published, chain**: the paper's equations; every mass moves by its own equation, and a contact spring in which half an
  element of each body deforms joins rod and target (eq. 22); no spring is stiffer than the elastic line;
- **published, joined**: the same with equation (15) taken literally: the first masses of both bodies move together from the
  impact on and are stopped by the springs of the target, with the power law down to zero strain;
- **conservative**: large strain, plastic unloading, momentum-conserving contact, closed energy balance.

The depth of the paper is that of the first penetrator mass when it stops. The depth of the conservative scheme is that of the
crater floor when the momentum of the penetrator is zero.
";
