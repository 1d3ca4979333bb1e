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
    /// Whether the key belongs to one of several forms of a value: its table says which one, with and without keys.
    #[serde(default)]
    nested: bool,
}

/// What a title gets once the case is no longer the one that it was written for.
const CHANGED: &str = " (changed)";

/// The text with its changes. A text that is not TOML stays as it is, for the reader to say what is wrong with it.
pub(crate) fn apply(text: &str, edits: &[Edit]) -> Result<String, Problem> {
    if edits.is_empty() {
        return Ok(text.to_owned());
    }
    let Ok(mut document) = text.parse::<DocumentMut>() else {
        return Ok(text.to_owned());
    };
    for edit in edits {
        let value = match &edit.value {
            Some(expression) => Some(parse(expression, &edit.key)?),
            None => None,
        };
        let new = match (&value, edit.nested) {
            (Some(value), _) => New::Value(value.clone()),
            (None, true) => New::Nothing,
            (None, false) => New::NoTable,
        };
        let keys: Vec<&str> = edit.key.split('.').collect();
        let put = match keys.len() {
            ..=LEVELS => put(document.as_table_mut(), &keys, &new),
            _ => None,
        };
        put.ok_or_else(|| {
            let key: String = edit.key.chars().take(SHOWN).collect();
            Problem::bad_request(format!("the case has no place for `{key}`"))
        })?;
    }
    let edited = document.to_string();
    if edited == text {
        return Ok(edited);
    }
    mark_title(&mut document);
    Ok(document.to_string())
}

/// Says in the title that the case was changed: captions of figures have it, with the speed of the case before.
fn mark_title(document: &mut DocumentMut) {
    let title = document.get("title").and_then(Item::as_str);
    let title = title.filter(|title| !title.ends_with(CHANGED));
    if let Some(title) = title.map(|title| format!("{title}{CHANGED}")) {
        set(document.as_table_mut(), "title", &New::Value(title.into()));
    }
}

fn parse(expression: &str, key: &str) -> Result<Value, Problem> {
    expression.trim().parse().map_err(|_| {
        let expression: String = expression.chars().take(SHOWN).collect();
        Problem::at(
            key,
            format!("`{expression}` is no value of a case"),
            "give a number of moderate size, or a text in quotes",
        )
    })
}

/// What a key is to become.
enum New {
    Value(Value),
    /// No key.
    Nothing,
    /// No key, nor the table that it leaves empty.
    NoTable,
}

/// Sets or removes a value; `None` when there is no place for it.
fn put(table: &mut dyn TableLike, keys: &[&str], new: &New) -> Option<()> {
    let (first, rest) = keys.split_first()?;
    if first.is_empty() {
        return None;
    }
    if rest.is_empty() {
        return set(table, first, new);
    }
    if table.get(first).is_none() {
        if !matches!(new, New::Value(_)) {
            return Some(());
        }
        // A new table stands in its own lines, unless the one around it is written in one line.
        table.insert(first, Item::Table(Table::new()));
    }
    let inner = table.get_mut(first)?;
    descend(inner, rest, new)?;
    let is_left_empty = inner.as_table_like().is_some_and(TableLike::is_empty);
    if is_left_empty && matches!(new, New::NoTable) {
        table.remove(first);
    }
    Some(())
}

fn descend(item: &mut Item, keys: &[&str], new: &New) -> Option<()> {
    if let Some(inline) = item.as_inline_table_mut()
        && let [key] = keys
        && matches!(new, New::Value(_))
        && !inline.contains_key(key)
        && let Some((_, last)) = inline.iter_mut().last()
    {
        // The space before the brace belongs to the last value, which this one is no more.
        last.decor_mut().set_suffix("");
    }
    if let Some(table) = item.as_table_like_mut() {
        return put(table, keys, new);
    }
    let (first, rest) = keys.split_first()?;
    let index: usize = first.parse().ok()?;
    if let Some(tables) = item.as_array_of_tables_mut() {
        return put(ArrayOfTables::get_mut(tables, index)?, rest, new);
    }
    let entry: &mut InlineTable = item.as_array_mut()?.get_mut(index)?.as_inline_table_mut()?;
    put(entry, rest, new)
}

fn set(table: &mut dyn TableLike, key: &str, new: &New) -> Option<()> {
    let New::Value(value) = new else {
        table.remove(key);
        return Some(());
    };
    let mut value = value.clone();
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
                nested: false,
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
        assert_eq!(without, CASE);
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
                nested: false,
            };
            assert!(apply(CASE, &[edit]).is_err(), "{key}");
        }
        let edit = Edit {
            key: "projectile.impact_velocity".to_owned(),
            value: Some("1 = 2".to_owned()),
            nested: false,
        };
        let problem = apply(CASE, &[edit]).unwrap_err();
        assert_eq!(problem.key(), "projectile.impact_velocity");
    }

    /// An empty table of readings would be refused with another scheme; one of a failure law says which law it is.
    #[test]
    fn an_emptied_table_goes_unless_it_names_a_form_of_a_value() {
        let readings = format!("{CASE}\n[chain.published]\nsmall_strain = \"elastic\"\n");
        assert_eq!(
            edited(&readings, &[("chain.published.small_strain", None)]),
            CASE
        );
        let failure = "[chain]\nfailure = { spall = { strength = \"1 GPa\" } }\n";
        let strength = Edit {
            key: "chain.failure.spall.strength".to_owned(),
            value: None,
            nested: true,
        };
        let left = apply(failure, &[strength]).unwrap();
        let left: toml::Table = left.parse().unwrap();
        assert!(
            left["chain"]["failure"]["spall"]
                .as_table()
                .unwrap()
                .is_empty()
        );
    }

    #[test]
    fn the_title_of_a_changed_case_says_so_once() {
        let case = format!("title = \"A rod at 230 m/s\" # paper\n{CASE}");
        let first = edited(
            &case,
            &[("projectile.impact_velocity", Some("\"231 m/s\""))],
        );
        assert!(first.starts_with("title = \"A rod at 230 m/s (changed)\" # paper\n"));
        let second = edited(
            &first,
            &[("projectile.impact_velocity", Some("\"232 m/s\""))],
        );
        assert_eq!(second, first.replace("231", "232"));
        assert_eq!(
            edited(
                &case,
                &[("projectile.impact_velocity", Some("\"230 m/s\""))]
            ),
            case
        );
    }

    #[test]
    fn what_is_no_toml_is_left_to_the_reader() {
        let edits = [("projectile.impact_velocity", Some("\"1 m/s\""))];
        assert_eq!(edited("a = [", &edits), "a = [");
    }
}
