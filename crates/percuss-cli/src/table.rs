//! Tables for the terminal, without lines between rows.

use comfy_table::{
    CellAlignment, ColumnConstraint, ContentArrangement, LineStyle, Table as Terminal,
    presets::{NOTHING, UTF8_HORIZONTAL_ONLY},
};
use percuss_report::table::{Column, Table};

use crate::terminal::width;

/// Spaces around a column and between two of them.
const PADDING: usize = 3;

/// Table that wraps its cells where the terminal is too narrow, except in some columns.
pub fn wrapped(table: &Table, whole: impl IntoIterator<Item = usize>) -> String {
    let mut drawn = filled(table, heading);
    drawn
        .load_style(UTF8_HORIZONTAL_ONLY.row_separator(LineStyle::none()))
        .set_content_arrangement(ContentArrangement::Dynamic)
        .set_width(u16::try_from(width()).unwrap_or(80));
    for index in whole {
        if let Some(column) = drawn.column_mut(index) {
            column.set_constraint(ColumnConstraint::ContentWidth);
        }
    }
    let lines = drawn.lines().map(|line| format!("{}\n", line.trim_end()));
    lines.chain(std::iter::once("\n".to_owned())).collect()
}

/// Table split into blocks of the terminal's width; each block repeats the first column.
pub fn blocks(table: &Table) -> String {
    let Some((first, columns)) = table.columns.split_first() else {
        return String::new();
    };
    let mut blocks: Vec<Vec<Column>> = Vec::new();
    let mut used = usize::MAX;
    for column in columns {
        let more = width_of(column);
        match blocks.last_mut() {
            Some(block) if used + more <= width() => {
                used += more;
                block.push(column.clone());
            }
            _ => {
                used = width_of(first) + more;
                blocks.push(vec![first.clone(), column.clone()]);
            }
        }
    }
    let blocks = blocks.into_iter().map(|columns| Table { columns });
    blocks.map(|block| wrapped(&block, [])).collect()
}

/// Table without lines and units, with this number of spaces between columns.
pub fn plain(table: &Table, spaces: u16) -> String {
    let mut drawn = filled(table, |column| column.heading.clone());
    drawn.load_style(NOTHING);
    for column in drawn.column_iter_mut() {
        column.set_padding((0, spaces));
    }
    format!("{}\n", drawn.trim_fmt())
}

fn filled(table: &Table, heading: impl Fn(&Column) -> String) -> Terminal {
    let mut drawn = Terminal::new();
    drawn.set_header(table.columns.iter().map(heading));
    for index in 0..table.len() {
        drawn.add_row(table.row(index));
    }
    for (column, of) in drawn.column_iter_mut().zip(&table.columns) {
        if of.numbers {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    drawn
}

/// Heading with the unit in a separate line.
fn heading(column: &Column) -> String {
    match column.unit.as_str() {
        "" => column.heading.clone(),
        unit => format!("{}\n[{unit}]", column.heading),
    }
}

fn width_of(column: &Column) -> usize {
    let heading = heading(column);
    let lines = heading
        .lines()
        .chain(column.cells.iter().map(String::as_str));
    lines.map(|line| line.chars().count()).max().unwrap_or(0) + PADDING
}
