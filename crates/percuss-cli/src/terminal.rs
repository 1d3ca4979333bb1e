//! Text for the terminal: its width, colours and line breaks.

use std::{
    env,
    fmt::Display,
    io::{self, IsTerminal},
};

use clap::builder::styling::{AnsiColor, Style};
use comfy_table::Table;
use percuss::Scenario;

/// Largest width of running text.
const MAX_WIDTH: usize = 100;

/// Width of running text: that of the terminal, 80 outside a terminal.
pub fn width() -> usize {
    full_width().unwrap_or(80).clamp(30, MAX_WIDTH)
}

/// Width of the terminal; `None` outside a terminal.
pub fn full_width() -> Option<usize> {
    // A terminal that does not know its size says 0.
    Table::new()
        .width()
        .map(usize::from)
        .filter(|&width| width > 0)
}

/// Whether escape codes may be written to a stream.
pub fn colours(stream: &impl IsTerminal) -> bool {
    let forbidden = env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    let dumb = env::var_os("TERM").is_some_and(|term| term == "dumb");
    stream.is_terminal() && !forbidden && !dumb
}

fn paint(text: impl Display, style: Style) -> String {
    if colours(&io::stdout()) {
        format!("{style}{text}{style:#}")
    } else {
        text.to_string()
    }
}

/// Heading on standard output.
pub fn bold(text: impl Display) -> String {
    paint(text, Style::new().bold())
}

/// Mark of a warning on standard output.
pub fn yellow(text: impl Display) -> String {
    paint(text, AnsiColor::Yellow.on_default().bold())
}

/// Title of a case, or its name, as one line.
pub fn title(scenario: &Scenario) -> String {
    format!("{}\n", bold(wrap(scenario.heading(), width(), 0)))
}

/// A paragraph of running text.
pub fn paragraph(text: &str) -> String {
    format!("{}\n", wrap(text, width(), 0))
}

/// A warning as a paragraph.
pub fn warning(text: &str) -> String {
    let wrapped = wrap(&format!("warning: {text}"), width(), 9);
    format!("{}\n", wrapped.replacen("warning:", &yellow("warning:"), 1))
}

/// `1 model`, `2 models`.
pub fn counted(count: usize, what: &str) -> String {
    match count {
        1 => format!("1 {what}"),
        _ => format!("{count} {what}s"),
    }
}

/// Breaks a text into lines of at most `width` characters; lines after the first are indented by `indent`.
pub fn wrap(text: &str, width: usize, indent: usize) -> String {
    let mut lines = String::new();
    let mut column = 0;
    for word in text.split_whitespace() {
        let length = word.chars().count();
        if column > 0 && column + 1 + length > width {
            lines.push('\n');
            lines.push_str(&" ".repeat(indent));
            column = indent;
        } else if column > 0 {
            lines.push(' ');
            column += 1;
        }
        lines.push_str(word);
        column += length;
    }
    lines
}
