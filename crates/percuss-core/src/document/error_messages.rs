//! Messages of the TOML reader in the terms of a user.

use crate::{check::limits::MAX_ELEMENTS, error::nearest, units::shorten};

/// What is wrong, what to do, and the name of the key that the message is about, if it has one.
#[derive(Debug, Default)]
pub struct Reworded {
    pub message: String,
    pub help: String,
    pub name: Option<String>,
}

fn says(message: impl Into<String>, help: impl Into<String>) -> Reworded {
    Reworded {
        message: message.into(),
        help: help.into(),
        name: None,
    }
}

/// Rewords a message; `source` is the text that it is about.
pub fn reword_toml_error(message: &str, source: &str) -> Reworded {
    unknown(message, source)
        .or_else(|| missing(message))
        .or_else(|| wrong_type(message, source))
        .or_else(|| syntax(message, source))
        .unwrap_or_else(|| match message.split_once('\n') {
            Some((first, rest)) => says(first, rest.replace('\n', "; ")),
            None => says(message, ""),
        })
}

/// Help that depends on the key and on the names in its table as well as on the message.
pub(super) fn help_for_key(
    key: &str,
    names: &[String],
    message: &str,
    help: &str,
) -> Option<String> {
    if key == NOSE || key.starts_with("projectile.nose.") {
        // A value of a known dimension, such as an angle without its unit, has its own help.
        let is_of_choice = ["unknown variant", "wanted ", "invalid type: ", "expected "]
            .iter()
            .any(|start| message.starts_with(start));
        if !is_of_choice {
            return None;
        }
        let near = help.split_once("? ").map_or("", |(near, _)| near);
        let near = match near {
            near if near.starts_with("did you mean") => format!("{near}? "),
            _ if is_several(message) => "keep one of them: ".to_owned(),
            _ => String::new(),
        };
        return Some(format!("{near}{NOSES}"));
    }
    if key.ends_with("_elements") && message.starts_with("invalid") {
        return Some(format!(
            "write a whole number from 1 to {MAX_ELEMENTS} without quotes"
        ));
    }
    if let Some(help) = help_for_strength(key, names, message) {
        return Some(help);
    }
    let no_choice = message.ends_with(" variant")
        || message.starts_with("wanted exactly 1 element, found 0")
        || message == "wanted string or table";
    if !no_choice {
        return None;
    }
    if key.ends_with(".strength") {
        return Some(
            "write strength.LAW = { PARAMETER = VALUE }; `percuss new NAME` writes a case that shows all laws".to_owned(),
        );
    }
    (message == "wanted string or table")
        .then(|| "`percuss new NAME` writes a case that shows what is allowed".to_owned())
}

/// Key of the shape of a nose.
const NOSE: &str = "projectile.nose";
/// How the shapes of a nose are written.
const NOSES: &str = "write projectile.nose as \"flat\", \"hemisphere\", { cone = { angle = \"60 deg\" } } or { ogive = { crh = 3 } }; \
                     a cone takes angle (from side to side), half_angle or length_to_diameter, an ogive crh, radius (of its arc) or length";

/// How a strength law is written, with the constants of the commonest one.
const STRENGTH: &str = "name the law: strength.LAW = { PARAMETER = VALUE }. Johnson\u{2013}Cook with its A, B, n, C and m is \
                        strength.johnson_cook = { a = \"90 MPa\", b = \"292 MPa\", n = 0.31, c = 0.025, m = 1.09 }";
/// Keys that stand for the constants of Johnson and Cook's law, or for the law, outside its table.
const LAW_KEYS: [&str; 11] = [
    "A",
    "B",
    "C",
    "N",
    "M",
    "a",
    "b",
    "c",
    "n",
    "m",
    "johnson_cook",
];

/// Help for constants of a strength law that stand in the wrong place or are written in capitals.
fn help_for_strength(key: &str, names: &[String], message: &str) -> Option<String> {
    let (table, last) = key.rsplit_once('.').unwrap_or(("", key));
    let is_law_key = LAW_KEYS.contains(&last);
    if message.starts_with("unknown field") && is_law_key {
        if table.ends_with("johnson_cook") {
            return Some(format!(
                "did you mean `{}`? The constants A, B, n, C and m are written a, b, n, c and m here; also allowed: reference_rate, rate_form",
                last.to_lowercase()
            ));
        }
        return message.contains("`strength`").then(|| STRENGTH.to_owned());
    }
    let is_constant = |name: &String| LAW_KEYS.contains(&name.as_str());
    let several = is_several(message) && names.iter().any(is_constant);
    let no_law = message.starts_with("unknown variant") && is_law_key;
    let is_strength = last == "strength" || table.ends_with("strength");
    (is_strength && (several || no_law)).then(|| STRENGTH.to_owned())
}

/// Unknown keys and values.
fn unknown(message: &str, source: &str) -> Option<Reworded> {
    if let Some(names) = message.strip_prefix("unexpected keys in table: ") {
        let (names, allowed) = names.split_once(", available keys: ")?;
        let name = names.split(", ").next()?;
        return Some(unknown_name(
            "key",
            name,
            &allowed.split(", ").collect::<Vec<_>>(),
        ));
    }
    let what = match message {
        _ if message.starts_with("unknown field") => "key",
        // The name of a choice with parameters is a key of a table.
        _ if message.starts_with("unknown variant") => match source.starts_with(['"', '\'']) {
            true => "value",
            false => "key",
        },
        _ => return None,
    };
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let (name, allowed) = quoted.split_first()?;
    Some(unknown_name(what, name, allowed))
}

fn unknown_name(what: &str, name: &str, allowed: &[&str]) -> Reworded {
    let help = if allowed.is_empty() {
        "no key is allowed here".to_owned()
    } else {
        let near = nearest(name, allowed.iter().copied())
            .map_or_else(String::new, |near| format!("did you mean `{near}`? "));
        format!("{near}allowed: {}", allowed.join(", "))
    };
    Reworded {
        message: format!("unknown {what} `{}`", shorten(name)),
        help,
        name: (what == "key").then(|| name.to_owned()),
    }
}

/// How required keys are written that a user may not guess.
const EXAMPLES: [(&str, &str); 10] = [
    ("density", "\"8960 kg/m3\""),
    ("design", "\"grid\" (others: latin-hypercube, sobol)"),
    ("diameter", "\"4.8 mm\""),
    ("impact_velocity", "\"230 m/s\""),
    ("material", "\"copper\""),
    ("poissons_ratio", "0.34"),
    ("position", "\"5 mm\""),
    ("source", "\"my-notebook\""),
    ("thickness", "\"25 mm\""),
    ("youngs_modulus", "\"124 GPa\""),
];

fn missing(message: &str) -> Option<Reworded> {
    if let Some(quoted) = message.strip_prefix("missing field ") {
        let name = quoted.trim_matches('`');
        let example = EXAMPLES.iter().find(|(key, _)| *key == name);
        let example = example.map_or_else(String::new, |(_, value)| {
            format!(", for example {name} = {value}")
        });
        return Some(Reworded {
            message: format!("the key {quoted} is missing"),
            help: format!("add {quoted}{example}"),
            name: Some(name.to_owned()),
        });
    }
    let count = message.strip_prefix("wanted exactly 1 element, ")?;
    Some(if count.starts_with("more") {
        says(
            "more than one is given where just one can be",
            "keep one of them",
        )
    } else {
        says("it is empty, but just one entry is due here", "")
    })
}

/// Whether a message is about several names of a choice in one table.
pub(super) fn is_several(message: &str) -> bool {
    message.starts_with("wanted exactly 1 element, more")
}

/// Message for a table with several names of a choice.
pub(super) fn several_given(names: &[String]) -> String {
    format!("{} are given where just one can be", listed(names))
}

/// Names in a sentence.
fn listed(names: &[String]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
        None => String::new(),
    }
}

/// Message and help for a table that lacks several keys.
pub(super) fn several_missing(names: &[String]) -> (String, String) {
    let listed = listed(names);
    let examples: Vec<String> = names
        .iter()
        .filter_map(|name| EXAMPLES.iter().find(|(key, _)| key == name))
        .map(|(name, value)| format!("{name} = {value}"))
        .collect();
    let examples = match examples.is_empty() {
        true => String::new(),
        false => format!(", for example {}", examples.join(", ")),
    };
    (
        format!("the keys {listed} are missing"),
        format!("add {listed}{examples}"),
    )
}

/// A value of another type than the one that is due.
fn wrong_type(message: &str, source: &str) -> Option<Reworded> {
    match message {
        "wanted string or table" => {
            return Some(says(
                format!("a word or a table is due here, not {}", shorten(source)),
                "",
            ));
        }
        _ if message.starts_with("expected table, found ") => {
            return Some(says(
                format!("a table is due here, not {}", shorten(source)),
                "",
            ));
        }
        "expected empty table" => {
            return Some(says(
                "no parameters are allowed here",
                "write the word alone, in quotes",
            ));
        }
        _ => {}
    }
    let (kind, rest) = message.split_once(": ")?;
    let (found, due) = rest.rsplit_once(", expected ")?;
    if found == "unit variant" {
        let name = shorten(source.trim_matches(['"', '\'']));
        return Some(says(
            format!("`{name}` takes parameters, and none are given"),
            format!("write it as a table: {{ {name} = {{ PARAMETER = VALUE }} }}"),
        ));
    }
    if kind == "invalid value" && matches!(due, "u32" | "u64") {
        let number = found.split('`').nth(1).unwrap_or(found);
        return Some(says(
            format!("{number} is out of range"),
            "write a whole number that is not negative",
        ));
    }
    if kind != "invalid type" {
        return None;
    }
    if found.ends_with("as i128") || found.ends_with("as u128") {
        return Some(says(
            format!("{} is out of range", shorten(source)),
            "a smaller number is due here",
        ));
    }
    let found = match found.split_once(' ') {
        Some(("string", text)) => format!("the text {}", shorten(text)),
        Some(("integer", _)) | Some(("floating", _)) => {
            format!("the number {}", found.split('`').nth(1).unwrap_or(found))
        }
        Some(("boolean", value)) => value.trim_matches('`').to_owned(),
        _ if found == "sequence" => "a list".to_owned(),
        _ if found == "map" && is_date_or_time(source.trim()) => "a date or time".to_owned(),
        _ if found == "map" => "a table".to_owned(),
        _ => found.to_owned(),
    };
    let (due, help) = match due {
        "a boolean" => ("true or false", "write true or false without quotes"),
        "f64" => (
            "a plain number",
            "write it without quotes and without a unit, such as 0.5",
        ),
        "u32" | "u64" => (
            "a whole number",
            "write it without quotes, a unit or a decimal point, such as 40",
        ),
        "a sequence" if found == "a table" => (
            "a list of tables",
            "write every entry under a header of its own in double brackets, such as [[target.layers]] or [[experiments]]",
        ),
        "a sequence" => (
            "a list",
            "write it in brackets, such as [\"first\", \"second\"]",
        ),
        "a string" | "path string" => ("a text", "write it in quotes"),
        due if due == "a map" || due.starts_with("struct ") => (
            "a table",
            "write it as { KEY = VALUE, … } in one line, or under a header in brackets",
        ),
        due => (due, ""),
    };
    Some(says(format!("{due} is due here, not {found}"), help))
}

/// Whether a value is a date or a time, which the reader of TOML takes for a table.
fn is_date_or_time(source: &str) -> bool {
    let starts_with_digits = source.bytes().take(2).filter(u8::is_ascii_digit).count() == 2;
    starts_with_digits && source.contains(['-', ':'])
}

/// Text that is not TOML.
fn syntax(message: &str, source: &str) -> Option<Reworded> {
    let source = source.trim();
    Some(match message {
        "duplicate key" => says(
            format!("`{}` is given twice", shorten(source)),
            "remove one of the two, or merge them",
        ),
        "recursion limit" | "cannot recurse further; max recursion depth met" => says(
            "keys or values are nested too deeply",
            "a case has a handful of levels",
        ),
        "integer number overflowed" => says(
            "the whole number is too large",
            "write a number with a unit in quotes, such as \"230 m/s\"",
        ),
        "key with no value, expected `=`" => {
            says("`=` is missing after the key", "write KEY = VALUE")
        }
        "string values must be quoted, expected literal string" if source.is_empty() => {
            says("the value is missing", "write KEY = VALUE")
        }
        "string values must be quoted, expected literal string" => says(
            format!("`{}` is no value", shorten(source)),
            "put texts, and numbers with a unit, into quotes: \"230 m/s\"",
        ),
        "invalid basic string, expected `\"`" => says(
            "the text in quotes does not end in its line",
            "close it with `\"`",
        ),
        "unexpected key or value, expected newline, `#`" => says(
            "the line goes on after the value",
            "write one KEY = VALUE per line; a comment starts with `#`",
        ),
        _ if message.starts_with("missing escaped value") => says(
            "`\\` starts an escape code, and this is none",
            "write `\\\\` for a backslash, or use single quotes",
        ),
        "invalid key-value pair, expected key" => says(
            "a key is due here",
            "a case is a TOML file: lines of KEY = VALUE, and headers in brackets",
        ),
        _ => return None,
    })
}
