//! Error messages: error, place in the file and remedy.

use std::{
    io::{self, IsTerminal, Write},
    ops::Range,
};

use annotate_snippets::{
    AnnotationKind, Element, Group, Level, Origin, Renderer, Snippet, renderer::DecorStyle,
};
use clap::builder::styling::AnsiColor;
use percuss::{InputError, quote::shorten_words};

use crate::terminal;

/// Most characters of a key that are shown.
const MAX_KEY: usize = 80;

/// Writes a message to standard error. A failure to do so cannot be reported.
pub fn print(text: &str) {
    let _ = io::stderr().lock().write_all(text.as_bytes());
}

/// Layout of messages.
#[derive(Debug, Clone, Copy)]
pub struct Look {
    /// Columns of a line.
    width: usize,
    /// Whether escape codes may be written.
    coloured: bool,
}

impl Look {
    /// Layout outside a terminal.
    pub const PLAIN: Self = Self {
        width: 100,
        coloured: false,
    };

    /// Layout for standard error.
    pub fn of_stderr() -> Self {
        let stderr = io::stderr();
        Self {
            width: match stderr.is_terminal() {
                true => terminal::width(),
                false => Self::PLAIN.width,
            },
            coloured: terminal::colours(&stderr),
        }
    }
}

/// A message without a place.
pub fn message(look: Look, what: &str, help: &str) -> String {
    render(look, what, &[], help)
}

/// The message of an error in a case or material file.
pub fn input_error(look: Look, error: &InputError) -> String {
    let file = printable(&error.file);
    if error.span.is_empty() && error.span.start == 0 {
        let mut elements = vec![Element::from(Origin::path(file))];
        if !error.key.is_empty() {
            let key = format!("key: {}", name(&error.key));
            elements.push(Level::NOTE.no_name().message(key).into());
        }
        return render(look, &error.message, &elements, &error.help);
    }
    let place = Excerpt::new(&error.text, error.span.clone());
    let mut annotation = AnnotationKind::Primary.span(place.span.clone());
    if !error.key.is_empty() {
        annotation = annotation.label(name(&error.key));
    }
    let snippet = Snippet::source(place.text)
        .path(file)
        .line_start(place.line)
        .annotation(annotation);
    render(look, &error.message, &[snippet.into()], &error.help)
}

fn render(look: Look, what: &str, elements: &[Element<'_>], help: &str) -> String {
    let Look { width, coloured } = look;
    let title = terminal::wrap(&printable(what), width.saturating_sub(7), 0);
    let group =
        Group::with_title(Level::ERROR.primary_title(title)).elements(elements.iter().cloned());
    let renderer = if coloured {
        Renderer::styled()
    } else {
        Renderer::plain()
    };
    let renderer = renderer
        .decor_style(DecorStyle::Ascii)
        .term_width(width.max(60));
    let mut text = renderer.render(&[group]);
    text.push('\n');
    if !help.is_empty() {
        let help = terminal::wrap(&format!("help: {}", printable(help)), width, 6);
        let style = AnsiColor::Cyan.on_default().bold();
        text += &match coloured {
            true => help.replacen("help:", &format!("{style}help:{style:#}"), 1),
            false => help,
        };
        text.push('\n');
    }
    text
}

/// A key, cut where it is longer than any that a case has.
fn name(key: &str) -> String {
    let key = printable(key);
    if key.chars().count() <= MAX_KEY {
        return key;
    }
    key.chars().take(MAX_KEY - 1).chain(['…']).collect()
}

/// Text of a file cannot move the cursor or ring the bell.
fn printable(text: &str) -> String {
    shorten_words(text)
        .chars()
        .map(|c| if c.is_control() { '\u{fffd}' } else { c })
        .collect()
}

/// The first line that a span touches.
struct Excerpt<'a> {
    text: &'a str,
    /// Bytes of `text` to point at.
    span: Range<usize>,
    /// Counted from 1.
    line: usize,
}

impl<'a> Excerpt<'a> {
    fn new(text: &'a str, span: Range<usize>) -> Self {
        let start = text.floor_char_boundary(span.start.min(text.len()));
        let end = text.ceil_char_boundary(span.end.clamp(start, text.len()));
        let line_start = text[..start].rfind('\n').map_or(0, |at| at + 1);
        let line_end = text[start..].find('\n').map_or(text.len(), |at| start + at);
        let marked = text[start..end.clamp(start, line_end)].trim_end().len();
        Self {
            text: text[line_start..line_end].trim_end_matches('\r'),
            span: start - line_start..start - line_start + marked,
            line: 1 + text[..line_start].matches('\n').count(),
        }
    }
}
