//! Limits of the texts and keys of a file: what is echoed in messages, tables and figures stays short, and is text.

use toml::de::{DeTable, DeValue};

use crate::{check::Diagnostic, units::shorten};

/// Most characters of a text, such as a title or a note.
const MOST_CHARACTERS: usize = 1000;
/// Most characters of a key.
const MOST_OF_KEY: usize = 100;

/// One diagnostic for the first text or key that is too long or holds a control character, if there is one.
pub(super) fn diagnostics(text: &str) -> Vec<Diagnostic> {
    let Ok(root) = DeTable::parse(text) else {
        return Vec::new();
    };
    let found = in_table("", root.get_ref());
    found.into_iter().collect()
}

fn in_table(path: &str, table: &DeTable<'_>) -> Option<Diagnostic> {
    table.iter().find_map(|(key, value)| {
        let key = key.get_ref();
        if key.chars().count() > MOST_OF_KEY {
            return Some(Diagnostic::at(
                path,
                format!(
                    "the key `{}` has {} characters",
                    shorten(key),
                    key.chars().count()
                ),
                format!("allowed: up to {MOST_OF_KEY}"),
            ));
        }
        if let Some(found) = control(path, "the key", key) {
            return Some(found);
        }
        let path = match path {
            "" => key.to_string(),
            _ => format!("{path}.{key}"),
        };
        in_value(&path, value.get_ref())
    })
}

fn in_value(path: &str, value: &DeValue<'_>) -> Option<Diagnostic> {
    match value {
        // The text of a table: what reads it has limits of its own.
        DeValue::String(_) if is_table_of_curves(path) => None,
        DeValue::String(text) => {
            let count = text.chars().count();
            if count > MOST_CHARACTERS {
                return Some(Diagnostic::at(
                    path,
                    format!("the text has {count} characters"),
                    format!("allowed: up to {MOST_CHARACTERS}; give a shorter one"),
                ));
            }
            control(path, "the text", text)
        }
        DeValue::Array(values) => values
            .iter()
            .enumerate()
            .find_map(|(i, value)| in_value(&format!("{path}.{i}"), value.get_ref())),
        DeValue::Table(table) => in_table(path, table),
        _ => None,
    }
}

/// A terminal obeys control characters, and figures and pages cannot hold them.
fn control(path: &str, what: &str, text: &str) -> Option<Diagnostic> {
    let is_none_of_texts =
        |c: &char| (c.is_control() && !"\n\r\t".contains(*c)) || "\u{fffe}\u{ffff}".contains(*c);
    let found = text.chars().find(is_none_of_texts)?;
    Some(Diagnostic::at(
        path,
        format!(
            "{what} holds the control character U+{:04X}",
            u32::from(found)
        ),
        "remove it; a line break and a tab are allowed",
    ))
}

/// Whether a key is `measured_curves.N.csv`.
fn is_table_of_curves(path: &str) -> bool {
    let inside = path.strip_prefix("measured_curves.");
    inside.is_some_and(|rest| rest.ends_with(".csv"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_and_keys_have_limits() {
        let found = |text: &str| {
            diagnostics(text)
                .pop()
                .map(|found| (found.key, found.message))
        };
        let text = |count: usize| {
            format!(
                "a = [1, {{ b = '{}' }}]\nc = '{}'",
                "x".repeat(count),
                "y".repeat(1000)
            )
        };
        assert_eq!(found(&text(1000)), None);
        let (key, message) = found(&text(1001)).unwrap();
        assert_eq!(
            (&*key, &*message),
            ("a.1.b", "the text has 1001 characters")
        );
        let (key, message) = found(&format!("t.{} = 1", "k".repeat(101))).unwrap();
        assert_eq!(key, "t");
        assert!(
            message.contains("101 characters") && message.len() < 200,
            "{message}"
        );
        assert_eq!(found(&format!("t.{} = 1", "k".repeat(100))), None);
        for (text, key, code) in [
            (r#"a = "x\u001b[2J""#, "a", "U+001B"),
            (r#"a = { b = ["\u009b"] }"#, "a.b.0", "U+009B"),
            (r#""\u0000" = 1"#, "", "U+0000"),
        ] {
            let (place, message) = found(text).unwrap();
            assert!(
                place == key && message.ends_with(code),
                "{place}: {message}"
            );
        }
        assert_eq!(found(r#"a = "one\n\ttwo µ""#), None);
        let table = |key: &str| format!("[[measured_curves]]\n{key} = '{}'", "1,2".repeat(1000));
        assert_eq!(found(&table("csv")), None);
        assert!(found(&table("file")).is_some());
    }
}
