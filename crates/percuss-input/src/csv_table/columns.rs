//! Recognition of the columns of a measured table by their names.

use super::{CsvTable, SEPARATORS_HELP};
use crate::{
    error::{InputError, misspelt},
    units::{ColumnName, ColumnUnit, ResultUnit, column_symbols, is_unit, plain_name, shorten},
};

/// Help where no column is recognised: an instrument may have written other lines first.
pub(crate) const REMARKS_HELP: &str = "; lines before the names of the columns start with `#`";

/// A column that a table can have.
#[derive(Debug, Clone, Copy)]
pub struct KnownColumn<'a> {
    /// Its name in the program, with the end of its unit.
    pub name: &'a str,
    /// Its name without a unit.
    pub quantity: &'a str,
    /// Other names of the quantity.
    pub aliases: &'a [&'a str],
    /// Unit of its name; none of a column of words or of plain numbers.
    pub unit: Option<ResultUnit>,
}

impl<'a> KnownColumn<'a> {
    /// A column of words or of plain numbers.
    pub const fn of_words(name: &'a str) -> Self {
        Self {
            name,
            quantity: name,
            aliases: &[],
            unit: None,
        }
    }

    /// A column whose name ends with its unit, where it has one of results.
    pub fn of(name: &'a str, aliases: &'a [&'a str]) -> Self {
        let (quantity, unit) = ResultUnit::split(name);
        Self {
            name,
            quantity,
            aliases,
            unit: (unit != ResultUnit::NONE).then_some(unit),
        }
    }
}

/// What the names of a table are.
#[derive(Debug, Clone, Default)]
pub struct Recognised {
    /// Of each column, the index of the known one that it is, and its unit.
    pub columns: Vec<Option<(usize, Option<ColumnUnit>)>>,
    /// Names of the columns that nothing reads.
    pub unread: Vec<String>,
    /// Columns with other names or units than those of the program, each as `` `V0 (ft/s)` as `impact_velocity_m_s`, converted ``.
    pub read_as: Vec<String>,
}

/// What a name is of a known column.
enum Fit {
    Column(Option<ColumnUnit>),
    Refused {
        message: String,
        help: String,
        by_alias: bool,
    },
}

/// Recognises the columns of a table and makes sure that required ones are there, by their names in the program.
pub fn recognise(
    table: &CsvTable<'_>,
    known: &[KnownColumn<'_>],
    required: &[&str],
) -> Result<Recognised, Box<InputError>> {
    let mut found = Recognised {
        columns: vec![None; table.header.len()],
        ..Recognised::default()
    };
    let mut refused = Vec::new();
    for (i, name) in table.header.iter().enumerate() {
        match fit(name, known) {
            Some((column, Fit::Column(unit))) => {
                let is_it = |other: &Option<(usize, _)>| other.is_some_and(|(at, _)| at == column);
                if let Some(first) = found.columns.iter().position(is_it) {
                    let of = known[column];
                    return Err(two_columns(table, [first, i], of));
                }
                found.columns[i] = Some((column, unit));
            }
            Some((
                column,
                Fit::Refused {
                    message,
                    help,
                    by_alias,
                },
            )) => refused.push((i, column, message, help, by_alias)),
            None => {}
        }
    }
    let separator = match table.header.len() {
        1 => SEPARATORS_HELP,
        _ => "",
    };
    let has = |columns: &[Option<(usize, Option<ColumnUnit>)>], at: usize| {
        let mut columns = columns.iter().flatten();
        columns.any(|(column, _)| *column == at)
    };
    for (i, column, message, help, by_alias) in refused {
        if !(by_alias && has(&found.columns, column)) {
            let help = format!("{help}{separator}");
            return Err(table.error(table.name_span(i), &table.header[i], message, help));
        }
    }
    let missing: Vec<&str> = required
        .iter()
        .copied()
        .filter(|name| {
            let at = known.iter().position(|column| column.name == *name);
            !at.is_some_and(|at| has(&found.columns, at))
        })
        .collect();
    let absent = known.iter().filter(|column| {
        let at = known.iter().position(|other| other.name == column.name);
        !at.is_some_and(|at| has(&found.columns, at))
    });
    let absent: Vec<&KnownColumn<'_>> = absent.collect();
    for (i, name) in table.header.iter().enumerate() {
        if let Some((column, unit)) = found.columns[i] {
            let column = known[column];
            let is_converted = unit.zip(column.unit).is_some_and(|(unit, to)| !unit.is(to));
            let is_renamed = plain_name(name) != plain_name(column.name)
                && !matches!(
                    ColumnName::of(
                        name,
                        column.quantity,
                        column.unit.unwrap_or(ResultUnit::NONE)
                    ),
                    ColumnName::InUnit(_)
                );
            if is_converted || is_renamed {
                let converted = if is_converted { ", converted" } else { "" };
                let as_what = format!("`{}` as `{}`{converted}", shorten(name), column.name);
                found.read_as.push(as_what);
            }
            continue;
        }
        if let Some(meant) = meant(name, &absent) {
            let message = format!("no column is named `{}`", shorten(name));
            let rest = missing.iter().copied().filter(|column| *column != meant);
            let rest = match in_ticks(rest) {
                rest if rest.is_empty() => rest,
                rest => format!("; the first line also lacks {rest}"),
            };
            let help =
                format!("did you mean `{meant}`? rename a column of another kind{separator}{rest}");
            return Err(table.error(table.name_span(i), name, message, help));
        }
        found.unread.push(shorten(name));
    }
    if missing.is_empty() {
        return Ok(found);
    }
    let hints = hints(&found.unread, known);
    let remarks = match found.columns.iter().flatten().next() {
        None => REMARKS_HELP,
        Some(_) => "",
    };
    let message = format!("the first line lacks {}", in_ticks(missing.iter().copied()));
    let others = known.iter().filter(|column| {
        missing.contains(&column.name) && !column.aliases.is_empty() && column.unit.is_none()
    });
    let others: String = others
        .map(|column| {
            let aliases = in_ticks(column.aliases.iter().copied());
            format!("; `{}` can also be named {aliases}", column.name)
        })
        .collect();
    let help = format!(
        "{hints}the first line names the columns; required are {}{others}{separator}{remarks}",
        in_ticks(required.iter().copied())
    );
    Err(table.error(0..0, "", message, help))
}

/// The known column that a name is, or is meant to be.
fn fit(name: &str, known: &[KnownColumn<'_>]) -> Option<(usize, Fit)> {
    let mut refused = None;
    for by_alias in [false, true] {
        for (i, column) in known.iter().enumerate() {
            let own = [column.name, column.quantity];
            let Some(unit) = column.unit else {
                let words = plain_name(without_choices(name));
                let names = if by_alias { column.aliases } else { &own };
                if !words.is_empty() && names.iter().any(|other| plain_name(other) == words) {
                    return Some((i, Fit::Column(None)));
                }
                continue;
            };
            let all: Vec<&str> = [column.quantity]
                .into_iter()
                .chain(column.aliases.iter().copied().filter(|_| by_alias))
                .collect();
            let (message, help) = match ColumnName::of_any(name, &all, unit) {
                ColumnName::Other => continue,
                ColumnName::InUnit(unit) => return Some((i, Fit::Column(Some(unit)))),
                // A short name in a unit of another kind is of another quantity.
                ColumnName::UnknownUnit(unit) if by_alias && is_unit(&unit) => continue,
                ColumnName::UnknownUnit(symbol) => (
                    format!("`{}` is no unit of `{}`", shorten(&symbol), column.quantity),
                    format!("units: {}", column_symbols(unit)),
                ),
                ColumnName::WithoutUnit => (
                    format!("the unit of `{}` is missing", shorten(name)),
                    format!(
                        "write `{} ({})`; units: {}",
                        shorten(name),
                        unit.symbol,
                        column_symbols(unit)
                    ),
                ),
            };
            let fit = Fit::Refused {
                message,
                help,
                by_alias,
            };
            refused.get_or_insert((i, fit));
        }
    }
    refused
}

/// A name without the words in brackets behind it that its values can be, as in `Perforation? (Y/N)`.
fn without_choices(name: &str) -> &str {
    let Some((words, rest)) = name.trim().split_once(['(', '[']) else {
        return name;
    };
    match rest.strip_suffix([')', ']']) {
        Some(choices) if choices.contains('/') && !is_unit(choices) => words,
        _ => name,
    }
}

fn two_columns(
    table: &CsvTable<'_>,
    [first, second]: [usize; 2],
    column: KnownColumn<'_>,
) -> Box<InputError> {
    let (a, b) = (&table.header[first], &table.header[second]);
    let message = match a == b {
        true => format!("two columns are named `{}`", shorten(a)),
        false => format!(
            "two columns are of `{}`: `{}` and `{}`",
            column.quantity,
            shorten(a),
            shorten(b)
        ),
    };
    let help = "remove one, or rename the one of another kind";
    table.error(table.name_span(second), b, message, help)
}

/// The known column whose name another one is with a letter or two wrong.
fn meant<'a>(name: &str, known: &[&KnownColumn<'a>]) -> Option<&'a str> {
    let words = name.split(['(', '[']).next().unwrap_or(name);
    let words = plain_name(words);
    let names: Vec<(String, &str)> = known
        .iter()
        .flat_map(|column| [column.name, column.quantity].map(|name| (name, column.name)))
        .map(|(words, name)| (plain_name(words), name))
        .collect();
    let near = misspelt(&words, names.iter().map(|(words, _)| words.as_str()))?;
    let mut names = names.iter();
    names.find_map(|(words, name)| (words == near).then_some(*name))
}

/// What the names that nothing reads may stand for, each a sentence: a name that is part of several is not guessed.
fn hints(unread: &[String], known: &[KnownColumn<'_>]) -> String {
    let hint = |name: &String| {
        let words = plain_name(name.split(['(', '[']).next().unwrap_or(name));
        let is_part = |column: &&KnownColumn<'_>| {
            words.len() > 2 && plain_name(column.quantity).contains(&words)
        };
        let names = in_ticks(known.iter().filter(is_part).map(|column| column.name));
        (!names.is_empty()).then(|| format!("`{name}` can be one of {names}; "))
    };
    unread.iter().filter_map(hint).collect()
}

fn in_ticks<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<String> = names.map(|name| format!("`{name}`")).collect();
    names.join(", ")
}
