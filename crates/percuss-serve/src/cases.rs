//! Ready cases: those of the project's folder `cases`, as part of the program.

use rust_embed::RustEmbed;
use serde::Serialize;

use crate::StartCase;

#[derive(RustEmbed)]
#[folder = "../../cases"]
#[include = "*/scenario.toml"]
struct Cases;

/// The case that the page opens on, unless another one is given.
const FIRST: &str = "paper-table1";

/// A ready case.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(crate) struct ReadyCase {
    name: String,
    title: String,
    text: String,
}

#[cfg(test)]
impl ReadyCase {
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    pub(crate) fn text(&self) -> &str {
        &self.text
    }
}

/// All ready cases, the one that the page opens on first.
pub(crate) fn all() -> Vec<ReadyCase> {
    let mut cases: Vec<ReadyCase> = Cases::iter().filter_map(|path| read(&path)).collect();
    cases.sort_by(|a, b| (a.name != FIRST, &a.name).cmp(&(b.name != FIRST, &b.name)));
    cases
}

fn read(path: &str) -> Option<ReadyCase> {
    let name = path.strip_suffix("/scenario.toml")?;
    let text = String::from_utf8(Cases::get(path)?.data.into_owned()).ok()?;
    let table: toml::Table = text.parse().ok()?;
    let title = table.get("title").and_then(toml::Value::as_str);
    Some(ReadyCase {
        name: name.to_owned(),
        title: title.unwrap_or(name).to_owned(),
        text,
    })
}

/// The case that the page opens on.
pub(crate) fn first() -> StartCase {
    let first = all().into_iter().next();
    let (name, text) = first.map_or_else(Default::default, |case| (case.name, case.text));
    StartCase { name, text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_case_is_the_papers_and_all_are_valid() {
        assert_eq!(first().name, FIRST);
        let all = all();
        assert!(all.len() >= 9);
        for case in all {
            percuss::case::load_str(&case.name, &case.text).unwrap();
        }
    }
}
