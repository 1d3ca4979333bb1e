//! Edits of a form in the text of a case; comments and order are kept.

use serde::Deserialize;
use toml_edit::{ArrayOfTables, DocumentMut, InlineTable, Item, Table, TableLike, Value};

use crate::problem::Problem;

/// Most parts of a key: a case has a handful of levels.
const LEVELS: usize = 16;
/// Most characters of a key or value that a message shows.
const SHOWN: usize = 60;

/// A key and its new value.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Edit {
    /// Dotted key; a number counts entries of a list from 0.
    key: String,
    /// The value as TOML writes it; none removes the key.
    value: Option<String>,
}

/// The text with its changes. A text that is not TOML stays as it is, for the reader to say what is wrong with it.
pub(crate) fn apply(text: &str, edits: &[Edit]) -> Result<String, Problem> {
    if edits.is_empty() {
        return Ok(text.to_owned());
    }
    let Ok(mut document) = text.parse::<DocumentMut>() else {
        return Ok(text.to_owned());
    };
    for edit in edits {
        let value = edit.value.as_deref().map(parse).transpose()?;
        let keys: Vec<&str> = edit.key.split('.').collect();
        let put = match keys.len() {
            ..=LEVELS => put(document.as_table_mut(), &keys, value),
            _ => None,
        };
        put.ok_or_else(|| {
            let key: String = edit.key.chars().take(SHOWN).collect();
            Problem::bad_request(format!("the case has no place for `{key}`"))
        })?;
    }
    Ok(document.to_string())
}

fn parse(expression: &str) -> Result<Value, Problem> {
    expression.trim().parse().map_err(|_| {
        let expression: String = expression.chars().take(SHOWN).collect();
        Problem::bad_request(format!("`{expression}` is no TOML value"))
    })
}

/// Sets or removes a value; `None` when there is no place for it.
fn put(table: &mut dyn TableLike, keys: &[&str], value: Option<Value>) -> Option<()> {
    let (first, rest) = keys.split_first()?;
    if first.is_empty() {
        return None;
    }
    if rest.is_empty() {
        return set(table, first, value);
    }
    if table.get(first).is_none() {
        if value.is_none() {
            return Some(());
        }
        // A new table stands in its own lines, unless the one around it is written in one line.
        table.insert(first, Item::Table(Table::new()));
    }
    descend(table.get_mut(first)?, rest, value)
}

fn descend(item: &mut Item, keys: &[&str], value: Option<Value>) -> Option<()> {
    if let Some(inline) = item.as_inline_table_mut()
        && let [key] = keys
        && value.is_some()
        && !inline.contains_key(key)
        && let Some((_, last)) = inline.iter_mut().last()
    {
        // The space before the brace belongs to the last value, which this one is no more.
        last.decor_mut().set_suffix("");
    }
    if let Some(table) = item.as_table_like_mut() {
        return put(table, keys, value);
    }
    let (first, rest) = keys.split_first()?;
    let index: usize = first.parse().ok()?;
    if let Some(tables) = item.as_array_of_tables_mut() {
        return put(ArrayOfTables::get_mut(tables, index)?, rest, value);
    }
    let entry: &mut InlineTable = item.as_array_mut()?.get_mut(index)?.as_inline_table_mut()?;
    put(entry, rest, value)
}

fn set(table: &mut dyn TableLike, key: &str, value: Option<Value>) -> Option<()> {
    let Some(mut value) = value else {
        table.remove(key);
        return Some(());
    };
    match table.get_mut(key) {
        Some(item) => {
            if let Some(old) = item.as_value() {
                *value.decor_mut() = old.decor().clone();
            }
            *item = Item::Value(value);
        }
        None => {
            table.insert(key, Item::Value(value));
        }
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const CASE: &str = "# A case.\n[projectile]\nimpact_velocity = \"230 m/s\" # measured\n\n[target]\nlayers = [\n  { thickness = \"1 mm\" },\n]\n";

    fn edited(text: &str, edits: &[(&str, Option<&str>)]) -> String {
        let edits: Vec<Edit> = edits
            .iter()
            .map(|(key, value)| Edit {
                key: (*key).to_owned(),
                value: value.map(str::to_owned),
            })
            .collect();
        apply(text, &edits).unwrap()
    }

    #[test]
    fn a_value_changes_and_the_rest_stays() {
        let text = edited(CASE, &[("projectile.impact_velocity", Some("\"231 m/s\""))]);
        assert_eq!(text, CASE.replace("230", "231"));
        let text = edited(CASE, &[("target.layers.0.thickness", Some("\"2 mm\""))]);
        assert_eq!(text, CASE.replace("1 mm", "2 mm"));
    }

    #[test]
    fn keys_come_and_go() {
        let with = edited(CASE, &[("chain.target_elements", Some("160"))]);
        assert_eq!(with, format!("{CASE}\n[chain]\ntarget_elements = 160\n"));
        let without = edited(&with, &[("chain.target_elements", None)]);
        assert_eq!(without, format!("{CASE}\n[chain]\n"));
        let inline = "target = { material = \"copper\" }\n";
        assert_eq!(
            edited(inline, &[("target.thickness", Some("\"3 mm\""))]),
            "target = { material = \"copper\", thickness = \"3 mm\" }\n"
        );
        assert_eq!(edited(CASE, &[("fdm.courant", None)]), CASE);
    }

    #[test]
    fn what_has_no_place_is_refused() {
        for key in [
            "projectile.impact_velocity.x",
            "target.layers.7.thickness",
            "",
            "a..b",
        ] {
            let edit = Edit {
                key: key.to_owned(),
                value: Some("1".to_owned()),
            };
            assert!(apply(CASE, &[edit]).is_err(), "{key}");
        }
        let edit = Edit {
            key: "projectile.impact_velocity".to_owned(),
            value: Some("1 = 2".to_owned()),
        };
        assert!(apply(CASE, &[edit]).is_err());
    }

    #[test]
    fn what_is_no_toml_is_left_to_the_reader() {
        let edits = [("projectile.impact_velocity", Some("\"1 m/s\""))];
        assert_eq!(edited("a = [", &edits), "a = [");
    }
}
