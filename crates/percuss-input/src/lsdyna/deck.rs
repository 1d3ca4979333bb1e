//! Keywords and cards of a deck.

use std::ops::Range;

use crate::{
    error::{Error, InputError, Subject},
    units::shorten,
};

/// Columns of a field, and in the long format.
const WIDTH: usize = 10;
const LONG_WIDTH: usize = 20;

/// A deck: its text and its keywords.
#[derive(Debug)]
pub(super) struct Deck<'a> {
    file: &'a str,
    text: &'a str,
    /// Bytes of the text at which its lines begin.
    lines: Vec<usize>,
    pub(super) keywords: Vec<Keyword<'a>>,
}

/// A keyword with the lines below it, without comments.
#[derive(Debug)]
pub(super) struct Keyword<'a> {
    /// In capitals, without the asterisk.
    pub(super) name: String,
    /// Bytes of the text.
    pub(super) span: Range<usize>,
    width: usize,
    lines: Vec<Line<'a>>,
}

#[derive(Debug, Clone, Copy)]
struct Line<'a> {
    text: &'a str,
    /// Byte of the text at which it begins.
    start: usize,
}

/// A number of a card.
#[derive(Debug, Clone)]
pub(super) struct Field {
    /// `None` where nothing is written.
    pub(super) value: Option<f64>,
    pub(super) span: Range<usize>,
}

impl<'a> Deck<'a> {
    /// Splits a text into keywords.
    pub(super) fn parse(file: &'a str, text: &'a str) -> Self {
        let mut deck = Self {
            file,
            text,
            lines: Vec::new(),
            keywords: Vec::new(),
        };
        let mut usual_width = WIDTH;
        let mut start = 0;
        for whole in text.split_inclusive('\n') {
            let line = Line {
                text: whole.trim_end(),
                start,
            };
            deck.lines.push(start);
            start += whole.len();
            match line.text.as_bytes().first() {
                Some(b'$') => {}
                Some(b'*') => {
                    let keyword = Keyword::of(line, usual_width);
                    if keyword.name == "KEYWORD" && is_long(line.text) {
                        usual_width = LONG_WIDTH;
                    }
                    deck.keywords.push(keyword);
                }
                _ => {
                    if let Some(keyword) = deck.keywords.last_mut() {
                        keyword.lines.push(line);
                    }
                }
            }
        }
        deck
    }

    /// An error at a place of the text.
    pub(super) fn error(&self, span: &Range<usize>, message: String, help: String) -> Error {
        InputError {
            subject: Subject::Material,
            file: self.file.to_owned(),
            text: self.text.to_owned(),
            span: span.clone(),
            key: String::new(),
            message,
            help,
        }
        .into()
    }

    /// Number of the line of a place, counted from 1.
    pub(super) fn line(&self, span: &Range<usize>) -> usize {
        self.lines.partition_point(|start| *start <= span.start)
    }
}

/// Whether the first keyword asks for the long format in the whole deck.
fn is_long(line: &str) -> bool {
    let line = line.to_uppercase().replace(' ', "");
    line.contains("LONG=Y") || line.contains("LONG=K")
}

impl<'a> Keyword<'a> {
    fn of(line: Line<'a>, usual_width: usize) -> Self {
        let written = line.text[1..].trim();
        let first = written.split([' ', ',']).next().unwrap_or_default();
        let rest = written[first.len()..].trim();
        let (name, long) = match first.strip_suffix('+') {
            Some(name) => (name, true),
            None => (first, rest.starts_with('+')),
        };
        let short = name.ends_with(['-', '%']) || rest.starts_with(['-', '%']);
        Self {
            name: name.trim_end_matches(['-', '%']).to_uppercase(),
            span: line.start..line.start + line.text.len(),
            width: match (long, short) {
                (true, _) => LONG_WIDTH,
                (false, true) => WIDTH,
                (false, false) => usual_width,
            },
            lines: Vec::new(),
        }
    }

    /// Its name without the option `_TITLE`, and the title.
    pub(super) fn name_and_title(&self) -> (&str, Option<&'a str>) {
        match self.name.strip_suffix("_TITLE") {
            Some(name) => (name, self.lines.first().map(|line| line.text.trim())),
            None => (&self.name, None),
        }
    }

    /// Number of its cards; a title is none.
    pub(super) fn cards(&self) -> usize {
        self.lines.len() - self.title_lines()
    }

    fn title_lines(&self) -> usize {
        usize::from(self.name.ends_with("_TITLE")).min(self.lines.len())
    }

    /// The fields of a card, counted from 0, after the title.
    ///
    /// # Errors
    /// [`Error::Input`] at what is no number.
    pub(super) fn card<const N: usize>(
        &self,
        deck: &Deck<'_>,
        index: usize,
    ) -> Result<[Field; N], Error> {
        let line = self.lines.get(self.title_lines() + index);
        let nothing = Field {
            value: None,
            span: line.map_or(self.span.clone(), |line| {
                line.start..line.start + line.text.len()
            }),
        };
        let Some(line) = line else {
            return Ok(std::array::from_fn(|_| nothing.clone()));
        };
        let texts = match line.text.contains(',') {
            true => between_commas(line),
            false => in_columns(line, self.width),
        };
        let mut fields = Vec::with_capacity(N);
        for (text, start) in texts.into_iter().take(N) {
            fields.push(self.field(deck, text, start)?);
        }
        fields.resize(N, nothing.clone());
        let mut fields = fields.into_iter();
        Ok(std::array::from_fn(|_| {
            fields.next().unwrap_or_else(|| nothing.clone())
        }))
    }

    fn field(&self, deck: &Deck<'_>, text: &str, start: usize) -> Result<Field, Error> {
        let indent = text.len() - text.trim_start().len();
        let text = text.trim();
        let span = start + indent..start + indent + text.len();
        if text.is_empty() {
            return Ok(Field { value: None, span });
        }
        let help = match text.starts_with('&') {
            true => "parameters of a deck are not resolved: write the number".to_owned(),
            false => format!(
                "a field of this card is {} columns wide, or ends with a comma",
                self.width
            ),
        };
        match number(text) {
            Some(value) => Ok(Field {
                value: Some(value),
                span,
            }),
            None => {
                let message = format!("`{}` is no number", shorten(text));
                Err(deck.error(&span, message, help))
            }
        }
    }
}

fn between_commas<'a>(line: &Line<'a>) -> Vec<(&'a str, usize)> {
    let mut start = line.start;
    let parts = line.text.split(',').map(|part| {
        let place = start;
        start += part.len() + 1;
        (part, place)
    });
    parts.collect()
}

fn in_columns<'a>(line: &Line<'a>, width: usize) -> Vec<(&'a str, usize)> {
    let mut ends: Vec<usize> = line.text.char_indices().map(|(at, _)| at).collect();
    ends.push(line.text.len());
    let columns = ends.len() - 1;
    let parts = (0..columns.div_ceil(width)).map(|i| {
        let from = ends[i * width];
        let to = ends[((i + 1) * width).min(columns)];
        (&line.text[from..to], line.start + from)
    });
    parts.collect()
}

/// A number as programs in Fortran read it: the exponent may be marked by `d`, or by its sign alone.
fn number(text: &str) -> Option<f64> {
    let plain = text.to_lowercase().replace('d', "e");
    let is_one = |text: &str| {
        text.bytes()
            .all(|b| b.is_ascii_digit() || b"+-.e".contains(&b))
    };
    if !is_one(&plain) {
        return None;
    }
    let value = plain.parse().ok().or_else(|| {
        let sign = plain.rfind(['+', '-']).filter(|&at| at > 0)?;
        let (mantissa, exponent) = plain.split_at(sign);
        format!("{mantissa}e{exponent}").parse().ok()
    });
    value.filter(|value: &f64| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_in_fortran() {
        for (text, value) in [
            ("1", 1.0),
            ("-2.5", -2.5),
            (".31", 0.31),
            ("7.83e-9", 7.83e-9),
            ("1.0d-3", 1e-3),
            ("3.50000-4", 3.5e-4),
            ("1.+28", 1e28),
            ("2E+3", 2e3),
        ] {
            assert_eq!(number(text), Some(value), "{text}");
        }
        for text in ["x", "1 2", "&rho", "nan", "inf", "1e999", "--1", ""] {
            assert_eq!(number(text), None, "{text}");
        }
    }

    #[test]
    fn cards_have_columns_or_commas_and_a_long_format() {
        let deck = "*KEYWORD\n$ comment\n*MAT_ELASTIC_TITLE\n a title, with a comma\n         7     7.8-9    2.1+5\n*SET\n8,, 3.5 ,4\n*LONG +\n                  11                 2.5\n*TAIL-\n\n";
        let deck = Deck::parse("d.k", deck);
        let names: Vec<&str> = deck.keywords.iter().map(|k| k.name.as_str()).collect();
        assert_eq!(
            names,
            ["KEYWORD", "MAT_ELASTIC_TITLE", "SET", "LONG", "TAIL"]
        );
        let values = |i: usize| {
            let card: [Field; 5] = deck.keywords[i].card(&deck, 0).unwrap();
            card.map(|field| field.value)
        };
        assert_eq!(
            deck.keywords[1].name_and_title(),
            ("MAT_ELASTIC", Some("a title, with a comma"))
        );
        assert_eq!(
            values(1),
            [Some(7.0), Some(7.8e-9), Some(2.1e5), None, None]
        );
        assert_eq!(values(2), [Some(8.0), None, Some(3.5), Some(4.0), None]);
        assert_eq!(values(3), [Some(11.0), Some(2.5), None, None, None]);
        assert_eq!(values(4), [None; 5]);
        assert_eq!(deck.line(&deck.keywords[2].span), 6);
    }

    #[test]
    fn what_is_no_number_is_named_with_its_place() {
        let text = "*MAT_ELASTIC\n         7      &rho\n";
        let deck = Deck::parse("d.k", text);
        let Err(Error::Input(error)) = deck.keywords[0].card::<8>(&deck, 0) else {
            panic!("read");
        };
        assert_eq!(&text[error.span.clone()], "&rho");
        assert_eq!(error.line(), 2);
        assert!(error.help.contains("write the number"), "{}", error.help);
    }
}
