//! Terminal output of a material.

use percuss::material::{Library, MaterialEntry};
use percuss_report::{CardLine, MaterialCard};

use crate::terminal::{bold, width, wrap};

const LABEL: usize = 24;

/// All constants of a material.
pub fn text(entry: &MaterialEntry, library: &Library) -> String {
    let card = MaterialCard::new(entry, library);
    let mut text = format!("{}\n", bold(&card.title));
    for section in &card.sections {
        if !section.heading.is_empty() {
            text += &format!("\n{}\n", bold(&section.heading));
        }
        for line in &section.lines {
            match line {
                CardLine::Row(label, value) => row(label, value, &mut text),
                CardLine::Line(line) => text += &format!("  {line}\n"),
                CardLine::Paragraph(words) => {
                    text += &format!("  {}\n", wrap(words, width() - 2, 2));
                }
            }
        }
    }
    text
}

fn row(label: &str, value: &str, text: &mut String) {
    let label_width = label.chars().count();
    // Combining marks have no width of their own.
    let marks = label
        .chars()
        .filter(|c| ('\u{300}'..='\u{36f}').contains(c))
        .count();
    let pad = " ".repeat(LABEL.saturating_sub(label_width - marks).max(1));
    let value = wrap(value, width().saturating_sub(LABEL + 2), 0)
        .replace('\n', &format!("\n{:1$}", "", LABEL + 2));
    *text += &format!("  {label}{pad}{value}\n");
}
