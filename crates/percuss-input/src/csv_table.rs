//! Tables of comma-separated values: the fields of a row by name, and errors that name their place.

mod columns;
pub mod header;
pub mod names;

use std::ops::Range;

use crate::{
    error::{InputError, Subject, nearest},
    units::{ColumnUnit, ResultUnit, shorten},
};

pub(crate) use columns::REMARKS_HELP;
pub use columns::{KnownColumn, Recognised, recognise};

/// A table and which column stands where.
#[derive(Debug)]
pub struct CsvTable<'a> {
    /// What stands for its file in messages.
    pub file: &'a str,
    /// Its text.
    pub text: &'a str,
    /// Names of its columns; those of the program where [`CsvTable::adopt`] has replaced them.
    pub header: Vec<String>,
    /// Names of its columns as written.
    written: Vec<String>,
    /// Units of its columns, and those of their names, where both differ.
    conversions: Vec<Option<(ColumnUnit, ResultUnit)>>,
    /// First byte of the line with the names of the columns.
    start: usize,
    /// What stands between its columns.
    pub separator: Separator,
    /// What a comma within a number is.
    comma: Comma,
}

/// Meaning of a comma within a number, where it does not separate columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Comma {
    /// It stands before decimals.
    Decimal,
    /// Every one stands before three digits: it may also stand between thousands.
    Undecided,
    /// Other numbers of the table have a point before decimals.
    Contradicted,
}

impl Comma {
    fn of(records: &[csv::StringRecord]) -> Self {
        let fields = || records.iter().flatten().map(str::trim);
        let is_number = |text: &str| text.parse::<f64>().is_ok();
        if fields().any(|text| text.contains('.') && is_number(text)) {
            return Self::Contradicted;
        }
        let before_decimals = |text: &str| {
            let Some((whole, decimals)) = text.split_once(',') else {
                return false;
            };
            let grouped = decimals.len() == 3
                && decimals.bytes().all(|digit| digit.is_ascii_digit())
                && !whole.trim_start_matches(['-', '+']).starts_with('0');
            is_number(&format!("{whole}.{decimals}")) && !grouped
        };
        match fields().any(before_decimals) {
            true => Self::Decimal,
            false => Self::Undecided,
        }
    }
}

/// Help where a line has one column.
pub const SEPARATORS_HELP: &str = "; columns are separated by commas, semicolons or tabs";

/// Separator of columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Separator {
    /// `,`
    Comma,
    /// `;`, as spreadsheets write it where a comma stands before decimals.
    Semicolon,
    /// A tab, as a table comes out of a spreadsheet by its clipboard.
    Tab,
}

impl Separator {
    /// That of a text whose first line names the columns: the first that separates it and the next one into as many fields. A comma can stand in
    /// a name, as in `velocity, m/s`, or before decimals.
    fn of(text: &str) -> Self {
        let mut lines = text.lines().filter(|line| !line.trim().is_empty());
        let (first, second) = (lines.next().unwrap_or_default(), lines.next());
        let fields = |line: &str, separator: Self| {
            let quoted = |c: char, inside: &mut bool| {
                *inside ^= c == '"';
                Some(c as u32 == u32::from(separator.byte()) && !*inside)
            };
            let marks = line.chars().scan(false, |inside, c| quoted(c, inside));
            marks.filter(|is_mark| *is_mark).count()
        };
        let fits = |separator: &Self| {
            let count = fields(first, *separator);
            count > 0 && second.is_none_or(|line| fields(line, *separator) == count)
        };
        let splits = |separator: &Self| fields(first, *separator) > 0;
        let found = [Self::Tab, Self::Semicolon, Self::Comma]
            .into_iter()
            .find(fits);
        let found = found.or_else(|| {
            [Self::Comma, Self::Semicolon, Self::Tab]
                .into_iter()
                .find(splits)
        });
        found.unwrap_or(Self::Comma)
    }

    const fn byte(self) -> u8 {
        match self {
            Self::Comma => b',',
            Self::Semicolon => b';',
            Self::Tab => b'\t',
        }
    }
}

/// A row of a table.
#[derive(Debug)]
pub struct CsvRow<'a> {
    /// Its table.
    pub table: &'a CsvTable<'a>,
    /// Its fields.
    pub record: csv::StringRecord,
}

impl<'a> CsvTable<'a> {
    /// The table and its rows that hold anything; `file` stands for it in messages.
    pub fn read(
        file: &'a str,
        text: &'a str,
    ) -> Result<(Self, Vec<csv::StringRecord>), Box<InputError>> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let start = start_of_names(text);
        let mut table = CsvTable {
            file,
            text,
            header: Vec::new(),
            written: Vec::new(),
            conversions: Vec::new(),
            start,
            separator: Separator::of(&text[start..]),
            comma: Comma::Decimal,
        };
        let mut reader = csv::ReaderBuilder::new()
            .delimiter(table.separator.byte())
            .flexible(true)
            .from_reader(&text.as_bytes()[start..]);
        let parsed = reader.headers().cloned().and_then(|header| {
            let records: Result<Vec<csv::StringRecord>, csv::Error> = reader.records().collect();
            Ok((header, records?))
        });
        let (header, mut records) = parsed.map_err(|error| {
            let message = format!("it is no table of comma-separated values: {error}");
            table.error(0..0, "", message, "")
        })?;
        records.retain(|record| record.iter().any(|field| !field.trim().is_empty()));
        table.comma = Comma::of(&records);
        table.header = header.iter().map(|name| name.trim().to_owned()).collect();
        table.written = table.header.clone();
        table.conversions = vec![None; table.header.len()];
        Ok((table, records))
    }

    /// Gives columns the names of the program; their numbers are converted to the units of these names.
    pub fn adopt(&mut self, recognised: &Recognised, known: &[KnownColumn<'_>]) {
        for (i, found) in recognised.columns.iter().enumerate() {
            let Some((column, unit)) = found else {
                continue;
            };
            let column = &known[*column];
            column.name.clone_into(&mut self.header[i]);
            self.conversions[i] = match (*unit, column.unit) {
                (Some(from), Some(to)) if !from.is(to) => Some((from, to)),
                _ => None,
            };
        }
    }

    /// Whether the table has a column of this name.
    pub fn has(&self, column: &str) -> bool {
        self.header.iter().any(|name| name == column)
    }

    /// A number of a column in the unit of its name.
    fn converted(&self, number: f64, column: &str) -> f64 {
        let at = self.header.iter().position(|name| name == column);
        let conversion = at.and_then(|at| self.conversions[at]);
        conversion.map_or(number, |(from, to)| to.of_si(from.to_si(number)))
    }

    /// The name of a column as written.
    fn as_written<'b>(&'b self, column: &'b str) -> &'b str {
        let at = self.header.iter().position(|name| name == column);
        at.map_or(column, |at| &self.written[at])
    }

    /// Bytes of a name in the line that names the columns.
    pub fn name_span(&self, index: usize) -> Range<usize> {
        self.field_span(self.start, index)
    }

    /// Bytes of field `index` of the record that begins at `start`, its quotes included; at least one byte where there is one.
    pub fn field_span(&self, start: usize, index: usize) -> Range<usize> {
        let (text, separator) = (self.text, self.separator.byte());
        // The reader counts line breaks that it skips to the record that follows.
        let skipped = text[start..].find(|c| c != '\n' && c != '\r').unwrap_or(0);
        let (mut begin, mut field, mut quoted) = (start + skipped, 0, false);
        for (at, byte) in text.bytes().enumerate().skip(begin) {
            match byte {
                b'"' => quoted = !quoted,
                b'\n' | b'\r' if !quoted => return begin..at.max(begin + 1),
                byte if byte == separator && !quoted => {
                    if field == index {
                        return begin..at.max(begin + 1);
                    }
                    field += 1;
                    begin = at + 1;
                }
                _ => {}
            }
        }
        begin..text.len().max(begin)
    }

    /// An error at bytes of the text.
    pub fn error(
        &self,
        span: Range<usize>,
        column: &str,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Box<InputError> {
        Box::new(InputError {
            subject: Subject::Case,
            file: self.file.to_owned(),
            text: self.text.to_owned(),
            span,
            key: column.to_owned(),
            message: message.into(),
            help: help.into(),
        })
    }
}

impl CsvRow<'_> {
    /// Text of a field; empty where the file lacks the column.
    pub fn text(&self, column: &str) -> &str {
        let at = self.table.header.iter().position(|name| name == column);
        at.and_then(|at| self.record.get(at)).map_or("", str::trim)
    }

    /// Text of a field, unless it is empty.
    pub fn optional(&self, column: &str) -> Option<String> {
        Some(self.text(column).to_owned()).filter(|text| !text.is_empty())
    }

    /// Text of a field that must not be empty.
    pub fn required(&self, column: &str) -> Result<String, Box<InputError>> {
        self.optional(column).ok_or_else(|| {
            let column_as_written = self.table.as_written(column);
            let message = format!("`{}` is empty", shorten(column_as_written));
            self.error(column, message, "write its value")
        })
    }

    /// A number, unless the field is empty.
    pub fn number(&self, column: &str) -> Result<Option<f64>, Box<InputError>> {
        let written = self.written_number(column)?;
        Ok(written.map(|number| self.table.converted(number, column)))
    }

    /// A difference in the unit of another column, such as its uncertainty, unless the field is empty.
    pub fn difference(&self, column: &str, of: &str) -> Result<Option<f64>, Box<InputError>> {
        let written = self.written_number(column)?;
        let zero = self.table.converted(0.0, of);
        Ok(written.map(|number| self.table.converted(number, of) - zero))
    }

    /// A number in the unit that it is written in.
    fn written_number(&self, column: &str) -> Result<Option<f64>, Box<InputError>> {
        let text = self.text(column);
        if text.is_empty() {
            return Ok(None);
        }
        let parsed = match self.table.separator {
            Separator::Comma => text.parse::<f64>(),
            Separator::Semicolon | Separator::Tab => text.replacen(',', ".", 1).parse(),
        };
        let ambiguous = match self.table.comma {
            _ if parsed.is_err() || !text.contains(',') => None,
            Comma::Decimal => None,
            Comma::Undecided => Some("its comma may stand before decimals or between thousands"),
            Comma::Contradicted => Some("the table has a point before other decimals"),
        };
        match (parsed, ambiguous) {
            (Ok(number), None) if number.is_finite() => Ok(Some(number)),
            (Ok(_), Some(why)) => Err(self.error(
                column,
                format!("`{}` is ambiguous: {why}", shorten(text)),
                "write all decimals with a point, and thousands without a comma",
            )),
            _ => Err(self.error(
                column,
                format!("`{}` is no number", shorten(text)),
                "write a plain number such as 12.7; its unit is in the name of the column",
            )),
        }
    }

    /// A number that must be there.
    pub fn required_number(&self, column: &str) -> Result<f64, Box<InputError>> {
        self.required(column)?;
        match self.number(column)? {
            Some(number) => Ok(number),
            None => Err(self.error(column, "a number is due here", "write its value")),
        }
    }

    /// One of several words; `None` when the field is empty.
    pub fn word<T: Copy>(
        &self,
        column: &str,
        words: &[(&'static str, T)],
    ) -> Result<Option<T>, Box<InputError>> {
        let text = self.text(column);
        if text.is_empty() {
            return Ok(None);
        }
        if let Some((_, value)) = words.iter().find(|(word, _)| *word == text) {
            return Ok(Some(*value));
        }
        let names: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        let near = nearest(text, names.iter().copied())
            .map_or_else(String::new, |near| format!("did you mean `{near}`? "));
        Err(self.error(
            column,
            format!("unknown value `{}`", shorten(text)),
            format!("{near}allowed: {}", names.join(", ")),
        ))
    }

    /// An error at a field; at the start of the row where the file lacks the column.
    pub fn error(
        &self,
        column: &str,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Box<InputError> {
        let written = self.table.as_written(column);
        self.table.error(self.span(column), written, message, help)
    }

    /// Bytes of a field in the text of the file.
    fn span(&self, column: &str) -> Range<usize> {
        let start = self
            .record
            .position()
            .map_or(0, |position| position.byte() as usize);
        let start = (self.table.start + start).min(self.table.text.len());
        let at = self.table.header.iter().position(|name| name == column);
        self.table.field_span(start, at.unwrap_or(0))
    }
}

/// First byte of the line that names the columns. Leading lines that start with `#` are remarks; the last of them names the columns where numbers
/// follow it.
fn start_of_names(text: &str) -> usize {
    let (mut start, mut last_remark) = (0, None);
    for line in text.split_inclusive('\n') {
        let words = line.trim_start();
        if let Some(remark) = words.strip_prefix('#') {
            let names = remark.trim_start();
            last_remark = (!names.is_empty()).then(|| start + line.len() - names.len());
        } else if !words.is_empty() {
            let first = words.split([',', ';', '\t']).next().unwrap_or_default();
            let is_number = first.trim().replace(',', ".").parse::<f64>().is_ok();
            return last_remark.filter(|_| is_number).unwrap_or(start);
        }
        start += line.len();
    }
    0
}
