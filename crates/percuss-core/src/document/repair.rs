//! What else is wrong in a table, found by reading it again with the first fault mended.

use toml::{Table, Value, de::DeTable};

use super::{
    Reader,
    error_messages::{Reworded, is_several, reword_toml_error},
    key_at,
};
use crate::units::one_of_each;

/// Largest number of missing keys that a message names.
const MOST: usize = 12;
/// Longest text that is read again and again [bytes].
const LONGEST: usize = 1 << 16;

/// All required keys that a table lacks, the first under this dotted key.
pub(super) fn missing_keys(text: &str, key: &str, again: &Reader<'_>) -> Vec<String> {
    let (path, first) = key.rsplit_once('.').unwrap_or(("", key));
    let mut names = vec![first.to_owned()];
    let Some(root) = short(text) else {
        return names;
    };
    // A key that is not there any more once it has a value shows the next one.
    let values = || {
        let quantities = one_of_each().map(Value::String);
        std::iter::once(Value::Float(1.0)).chain(quantities)
    };
    let mut filled = root;
    while names.len() < MOST {
        let next = values().find_map(|value| {
            let mut with = filled.clone();
            let last = names.last()?.clone();
            table_at(&mut with, path)?.insert(last.clone(), value);
            let text = toml::to_string(&with).ok()?;
            let Some(error) = again(&text) else {
                return Some((with, None));
            };
            let said = reword_toml_error(error.message(), "");
            let root = DeTable::parse(&text).ok()?;
            let place = key_at(root.get_ref(), &error.span()?, said.name.clone());
            let (its_path, its_name) = place.rsplit_once('.').unwrap_or(("", &place));
            let is_next = error.message().starts_with("missing field") && its_path == path;
            // Another fault in another place says nothing of this table.
            (is_next && its_name != last).then(|| (with, Some(its_name.to_owned())))
        });
        match next {
            Some((with, Some(name))) if !names.contains(&name) => {
                filled = with;
                names.push(name);
            }
            _ => break,
        }
    }
    names
}

/// What a table with several keys has in place of the one name that is due, where that is no name of a choice.
pub(super) fn unknown_choice(
    text: &str,
    key: &str,
    names: &[String],
    again: &Reader<'_>,
    error: &toml::de::Error,
) -> Option<Reworded> {
    if !is_several(error.message()) {
        return None;
    }
    let root = short(text)?;
    names.iter().find_map(|name| {
        let mut alone = root.clone();
        table_at(&mut alone, key)?.retain(|other, _| other == name);
        let error = again(&toml::to_string(&alone).ok()?)?;
        let is_unknown = error
            .message()
            .starts_with(&format!("unknown variant `{name}`"));
        is_unknown.then(|| reword_toml_error(error.message(), name))
    })
}

/// The tables of a text, unless it is long.
fn short(text: &str) -> Option<Table> {
    (text.len() <= LONGEST).then(|| text.parse().ok())?
}

fn table_at<'a>(root: &'a mut Table, path: &str) -> Option<&'a mut Table> {
    let parts = path.split('.').filter(|part| !part.is_empty());
    let mut at = root;
    for part in parts {
        at = at.get_mut(part)?.as_table_mut()?;
    }
    Some(at)
}
