//! Choice of the drawn result and its label.

use percuss::{
    error::nearest,
    summary::{Role, result_number},
};

use super::super::{manifest::Manifest, parts::Parts, rows::has_numbers};
use crate::{
    ReportError,
    names::{capitalized, result_column, with_unit},
};

/// Columns of numbers that are drawn only where they are named.
const SECOND: [&str; 3] = ["run", "band_low", "band_high"];

/// Requested column, or the first result of the sweep.
pub(super) fn choose(parts: &Parts<'_>, wanted: Option<&str>) -> Result<String, ReportError> {
    let manifest = &parts.manifest;
    let all = || {
        let columns = manifest.columns.iter().enumerate();
        columns.filter(|(_, column)| column.kind != "text" && !is_input(manifest, &column.name))
    };
    let fail = |reason: String| {
        let names: Vec<&str> = all().map(|(_, column)| column.name.as_str()).collect();
        let near = wanted.map_or_else(String::new, |wanted| meant(wanted, &names));
        ReportError::Sweep {
            path: parts.first().to_owned(),
            reason,
            remedy: format!("{near}--quantity takes one of {}", names.join(", ")),
        }
    };
    if let Some(wanted) = wanted {
        let found = all().find(|(_, column)| column.name == wanted);
        let found = found.ok_or_else(|| fail(format!("the sweep has no result `{wanted}`")));
        return found.map(|(_, column)| column.name.clone());
    }
    let mut first = None;
    for file in parts.files().flatten() {
        let mut results = all().filter(|(_, column)| is_result(manifest, &column.name));
        let found = results.find(|(place, _)| has_numbers(&file, *place));
        first = found.map(|(_, column)| column.name.clone());
        if first.is_some() {
            break;
        }
    }
    first.ok_or_else(|| {
        fail("no computed run has a result; the column `error` has the reasons".to_owned())
    })
}

/// What a user may have meant by a name that is none of these, as a sentence that ends with a space: the first one that starts or ends
/// with it, or the nearest.
pub(super) fn meant(wanted: &str, names: &[&str]) -> String {
    let starts_or_ends = |name: &&&str| {
        let rest = name.strip_prefix(wanted);
        let rest = rest.or_else(|| name.strip_suffix(wanted));
        !wanted.is_empty() && rest.is_some_and(|rest| rest.starts_with('_') || rest.ends_with('.'))
    };
    let near = names.iter().find(starts_or_ends);
    let near = near.map(|name| (*name).to_owned());
    near.or_else(|| nearest(wanted, names.iter().copied()))
        .map_or_else(String::new, |name| format!("did you mean `{name}`? "))
}

fn is_input(manifest: &Manifest, column: &str) -> bool {
    manifest.parameters.iter().any(|p| p.column == column)
}

/// Whether a column is a result: neither an input nor a number of the computation.
pub(super) fn is_result(manifest: &Manifest, column: &str) -> bool {
    let second = match result_number(column) {
        Some(number) => matches!(number.role, Role::Input | Role::Numerics),
        None => SECOND.contains(&column),
    };
    !is_input(manifest, column) && !second
}

/// Name of a column with its unit in parentheses.
pub(super) fn label(column: &str) -> String {
    let (name, unit) = result_column(column);
    with_unit(&name, unit)
}

/// Name of a column as a title.
pub(super) fn title(column: &str) -> String {
    capitalized(&result_column(column).0)
}
