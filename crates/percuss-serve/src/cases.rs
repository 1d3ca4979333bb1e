//! Example cases of the folder `cases`, embedded in the program.

use std::sync::LazyLock;

use percuss::{
    case,
    model::{self, CostClass},
};
use serde::Serialize;

use crate::StartCase;

/// Names of the cases and texts of their files.
const CASES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/cases.rs"));

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

/// Ready cases that a quick model computes, the one that the page opens on first. The others are for the command line.
pub(crate) fn all() -> Vec<ReadyCase> {
    static QUICK: LazyLock<Vec<ReadyCase>> = LazyLock::new(|| {
        let mut cases: Vec<ReadyCase> = CASES.iter().filter_map(read).collect();
        cases.retain(has_quick_model);
        cases.sort_by(|a, b| (a.name != FIRST, &a.name).cmp(&(b.name != FIRST, &b.name)));
        cases
    });
    QUICK.clone()
}

fn has_quick_model(ready: &ReadyCase) -> bool {
    let scenario = case::load_str(&ready.name, &ready.text).ok();
    let chosen = scenario.and_then(|scenario| model::default_model(&scenario).ok());
    chosen.is_some_and(|chosen| chosen.model.cost() != CostClass::Minutes)
}

fn read((name, text): &(&str, &str)) -> Option<ReadyCase> {
    let table: toml::Table = text.parse().ok()?;
    let title = table.get("title").and_then(toml::Value::as_str);
    Some(ReadyCase {
        name: (*name).to_owned(),
        title: title.unwrap_or(name).to_owned(),
        text: (*text).to_owned(),
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
