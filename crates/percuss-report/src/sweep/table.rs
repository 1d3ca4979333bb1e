//! Rows of a sweep as one table.

use percuss::sweep::{Sweep, SweepRow};

use super::columns::columns;
use crate::{ReportError, column};

/// Rows that are in memory as CSV, with the columns that a folder has them in.
///
/// # Errors
/// [`ReportError::Table`].
pub fn rows_csv(sweep: &Sweep, rows: &[SweepRow]) -> Result<Vec<u8>, ReportError> {
    column::csv("rows.csv", &columns(sweep), rows)
}
