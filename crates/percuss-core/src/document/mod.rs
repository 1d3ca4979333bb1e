//! A text with the name of its file, and where in it something is wrong.

mod error_messages;
mod renamed;
mod repair;
mod text_file;
mod texts;

use std::{
    ops::Range,
    path::{Path, PathBuf},
};

use toml::de::{DeArray, DeTable, DeValue};

pub use text_file::MAX_FILE_BYTES;
pub use {error_messages::reword_toml_error, renamed::Renamed, text_file::read_text};

use self::{
    error_messages::{Reworded, help_for_key, is_several, several_given, several_missing},
    text_file::case_name,
};
use crate::{
    check::Diagnostic,
    error::{Error, InputError, Subject},
};

/// Tables of a case that are about materials.
const OF_MATERIALS: [&str; 2] = ["materials", "material_files"];

/// Reads a text as the type that is due, and gives what does not fit.
type Reader<'a> = dyn Fn(&str) -> Option<toml::de::Error> + 'a;

/// The text of a case, or of what goes with one, and where it comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Document {
    /// The file, or what stands for it in messages.
    pub file: String,
    /// Its text.
    pub text: String,
    /// Name of what it describes.
    pub name: String,
    /// What paths in it are relative to; `None` where it can name no files.
    pub folder: Option<PathBuf>,
    /// What all of it is about.
    subject: Subject,
}

impl Document {
    /// Reads a file.
    ///
    /// # Errors
    /// [`Error::Read`].
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        Ok(Self {
            name: case_name(path),
            folder: Some(path.parent().map(Path::to_path_buf).unwrap_or_default()),
            ..Self::new(&path.display().to_string(), read_text(path)?)
        })
    }

    /// A text that comes from no file; its name stands for one in messages.
    pub fn new(name: &str, text: impl Into<String>) -> Self {
        Self {
            file: name.to_owned(),
            text: text.into(),
            name: name.to_owned(),
            folder: None,
            subject: Subject::Case,
        }
    }

    /// The same with paths in it relative to a folder.
    pub fn in_folder(self, folder: impl Into<PathBuf>) -> Self {
        Self {
            folder: Some(folder.into()),
            ..self
        }
    }

    /// What it says.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// What paths in it are relative to; `None` where it can name no files.
    pub fn folder(&self) -> Option<&Path> {
        self.folder.as_deref()
    }

    /// The same, of materials.
    pub fn of_materials(self) -> Self {
        Self {
            subject: Subject::Material,
            ..self
        }
    }

    /// The value that it describes, of a type with its keys.
    ///
    /// # Errors
    /// [`Error::Input`] with the place of what does not fit.
    pub fn parse<T: serde::de::DeserializeOwned>(&self) -> Result<T, Error> {
        let again = |text: &str| toml::from_str::<T>(text).err();
        let value = toml::from_str(&self.text).map_err(|error| self.parse_error(&error, &again))?;
        self.report(texts::diagnostics(&self.text))?;
        Ok(value)
    }

    /// Fails with the first diagnostic, if there is one.
    ///
    /// # Errors
    /// [`Error::Input`] with the place of its key.
    pub fn report(&self, diagnostics: Vec<Diagnostic>) -> Result<(), Error> {
        match diagnostics.into_iter().next() {
            Some(diagnostic) => Err(self.place(diagnostic).into()),
            None => Ok(()),
        }
    }

    /// The error of a diagnostic, with the place of its key.
    pub fn place(&self, diagnostic: Diagnostic) -> InputError {
        InputError {
            subject: diagnostic.subject,
            file: self.file.clone(),
            text: self.text.clone(),
            span: self.span_of(&diagnostic.key),
            key: diagnostic.key,
            message: diagnostic.message,
            help: diagnostic.help,
        }
    }

    fn parse_error(&self, error: &toml::de::Error, again: &Reader<'_>) -> InputError {
        let mut span = error.span().unwrap_or(0..0);
        let source = self.text.get(span.clone()).unwrap_or_default();
        let Reworded {
            mut message,
            mut help,
            name,
        } = reword_toml_error(error.message(), source);
        let is_missing = error.message().starts_with("missing field");
        let key = match DeTable::parse(&self.text) {
            Ok(root) => key_at(root.get_ref(), &span, name),
            Err(_) => {
                if help.is_empty() {
                    help = "up to here the file is valid TOML".to_owned();
                }
                if span.is_empty() {
                    span = self.character_at(span.start);
                }
                self.written_key(span.start)
            }
        };
        let names = self.names_under(&key);
        if is_missing {
            let missing = repair::missing_keys(&self.text, &key, again);
            if missing.len() > 1 {
                (message, help) = several_missing(&missing);
            }
        }
        if is_several(error.message()) && names.len() > 1 {
            message = several_given(&names);
        }
        if let Some(unknown) = repair::unknown_choice(&self.text, &key, &names, again, error) {
            message = unknown.message;
            help = unknown.help;
        }
        if let Some(more) = help_for_key(&key, &names, error.message(), &help) {
            help = more;
        }
        if let Some(renamed) = Renamed::of(&key).filter(|_| message.starts_with("unknown key")) {
            let renamed = renamed.in_its_table();
            (message, help) = (renamed.message(), renamed.help());
        }
        if let Some(more) = self.help_for_another_file(error.message()) {
            help = more.to_owned();
        }
        let table = key.split('.').next().unwrap_or_default();
        InputError {
            subject: match OF_MATERIALS.contains(&table) {
                true => Subject::Material,
                false => self.subject,
            },
            file: self.file.clone(),
            text: self.text.clone(),
            span,
            key,
            message,
            help,
        }
    }

    /// Help where the whole file is of another kind than the one that is due.
    fn help_for_another_file(&self, message: &str) -> Option<&'static str> {
        let extension = Path::new(&self.file).extension();
        if extension.is_some_and(|found| found.eq_ignore_ascii_case("csv")) {
            return Some(
                "a TOML file is due here, not comma-separated values; results of tests are given with `--tests` or `--data`",
            );
        }
        let root = self.text.parse::<toml::Table>().ok()?;
        let is_case = root.contains_key("projectile") && root.contains_key("target");
        if !is_case || !message.starts_with("unknown field") {
            return None;
        }
        if self.subject == Subject::Material {
            return Some(
                "this is a case, and a file of materials is due here; `--case` takes a case",
            );
        }
        let is_of_a_sweep = message.contains("`base`") && message.contains("`design`");
        is_of_a_sweep.then_some(
            "this is a case, and a sweep file is due here: it names the case, base = \"scenario.toml\", with a model, a design and [[parameter]] tables",
        )
    }

    /// Names of the keys in a table; none where there is no table under that key.
    fn names_under(&self, key: &str) -> Vec<String> {
        let root = self.text.parse::<toml::Table>().ok();
        let mut at = root.map(toml::Value::Table);
        for part in key.split('.') {
            at = at.and_then(|value| value.get(part).cloned());
        }
        match at {
            Some(toml::Value::Table(table)) => table.keys().cloned().collect(),
            _ => Vec::new(),
        }
    }

    /// Bytes of the character at a place, so that there is something to point at.
    fn character_at(&self, start: usize) -> Range<usize> {
        let character = self.text.get(start..).and_then(|rest| rest.chars().next());
        match character {
            Some(character) if character != '\n' => start..start + character.len_utf8(),
            _ => start..start,
        }
    }

    /// The key that a line is about, read off the text: of a file with a syntax error nothing else is known.
    fn written_key(&self, place: usize) -> String {
        let plain = |key: &str| {
            let key = key.trim().trim_matches(['[', ']']).trim().to_owned();
            let allowed = |c: char| c.is_alphanumeric() || "_-.".contains(c);
            (!key.is_empty() && key.chars().all(allowed)).then_some(key)
        };
        let mut place = place.min(self.text.len());
        while !self.text.is_char_boundary(place) {
            place -= 1;
        }
        let start = self.text[..place].rfind('\n').map_or(0, |at| at + 1);
        let line = self.text[start..].lines().next().unwrap_or_default();
        if line.starts_with('[') {
            return plain(line).unwrap_or_default();
        }
        let Some(key) = line.split(['=', ':', '"']).next().and_then(plain) else {
            return String::new();
        };
        let header = self.text[..start]
            .lines()
            .rfind(|line| line.starts_with('['));
        match header.map(plain) {
            None => key,
            Some(Some(header)) => format!("{header}.{key}"),
            Some(None) => String::new(),
        }
    }

    /// Bytes of the value under a key, or of the innermost table that exists on the way to it.
    fn span_of(&self, key: &str) -> Range<usize> {
        let Ok(root) = DeTable::parse(&self.text) else {
            return 0..0;
        };
        let parts: Vec<&str> = key.split('.').filter(|part| !part.is_empty()).collect();
        let mut span = 0..0;
        let mut rest = parts.as_slice();
        let mut table = Some(root.get_ref());
        let mut array: Option<&DeArray<'_>> = None;
        while !rest.is_empty() {
            // A quoted key can hold dots, so more than one part may be one key.
            let found = (1..=rest.len()).find_map(|count| {
                let name = rest[..count].join(".");
                let value = match (table, array) {
                    (Some(table), _) => table.get(name.as_str()),
                    (None, Some(array)) => array.get(name.parse::<usize>().ok()?),
                    (None, None) => None,
                };
                Some((value?, count))
            });
            let Some((value, count)) = found else { break };
            span = value.span();
            table = value.get_ref().as_table();
            array = value.get_ref().as_array();
            rest = &rest[count..];
        }
        span
    }
}

/// Dotted key of the innermost value that holds a place, ending with a name where the message has one.
fn key_at(root: &DeTable<'_>, span: &Range<usize>, name: Option<String>) -> String {
    let mut path = Vec::new();
    // An empty span at the start is the file as a whole.
    if *span != (0..0) {
        descend(root, span, &mut path);
    }
    if let Some(name) = name
        && path.last() != Some(&name)
    {
        path.push(name);
    }
    path.join(".")
}

fn descend(table: &DeTable<'_>, span: &Range<usize>, path: &mut Vec<String>) {
    for (key, value) in table {
        let on_key = key.span().start <= span.start && span.end <= key.span().end;
        if on_key {
            path.push(key.get_ref().to_string());
            return;
        }
        // A table written under a header holds keys beyond the header's own span, so every table is searched.
        let length = path.len();
        path.push(key.get_ref().to_string());
        if descend_value(value.get_ref(), span, path) {
            return;
        }
        if value.span().start <= span.start
            && span.end <= value.span().end
            && !value.span().is_empty()
        {
            return;
        }
        path.truncate(length);
    }
}

fn descend_value(value: &DeValue<'_>, span: &Range<usize>, path: &mut Vec<String>) -> bool {
    let length = path.len();
    match value {
        DeValue::Table(table) => descend(table, span, path),
        DeValue::Array(array) => {
            for (i, item) in array.iter().enumerate() {
                path.push(i.to_string());
                if descend_value(item.get_ref(), span, path)
                    || (item.span().start <= span.start && span.end <= item.span().end)
                {
                    return true;
                }
                path.truncate(length);
            }
        }
        _ => {}
    }
    path.len() > length
}
