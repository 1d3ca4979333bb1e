//! Tables without lines between their rows.

use comfy_table::{
    CellAlignment, ColumnConstraint, ContentArrangement, LineStyle, Table,
    presets::UTF8_HORIZONTAL_ONLY,
};

use crate::terminal::width;

/// An empty table that wraps its cells where the terminal is too narrow.
pub fn table(header: Vec<String>) -> Table {
    let mut table = Table::new();
    table
        .load_style(UTF8_HORIZONTAL_ONLY.row_separator(LineStyle::none()))
        .set_content_arrangement(ContentArrangement::Dynamic)
        .set_width(u16::try_from(width()).unwrap_or(80))
        .set_header(header);
    table
}

/// Keeps the cells of these columns from being wrapped.
pub fn keep_whole(table: &mut Table, columns: impl IntoIterator<Item = usize>) {
    for index in columns {
        if let Some(column) = table.column_mut(index) {
            column.set_constraint(ColumnConstraint::ContentWidth);
        }
    }
}

/// A column of a table that may be too wide for the terminal.
pub struct Column {
    pub heading: String,
    pub cells: Vec<String>,
    /// Whether it holds numbers, which stand at the right.
    pub numbers: bool,
}

/// Spaces around a column and between two of them.
const PADDING: usize = 3;

impl Column {
    fn width(&self) -> usize {
        let lines = self.heading.lines();
        let lines = lines.chain(self.cells.iter().map(String::as_str));
        lines.map(|line| line.chars().count()).max().unwrap_or(0) + PADDING
    }
}

/// Tables of as many columns as fit beside the first one.
pub fn blocks(first: &Column, columns: Vec<Column>) -> String {
    let mut blocks: Vec<Vec<Column>> = Vec::new();
    let mut used = usize::MAX;
    for column in columns {
        let more = column.width();
        match blocks.last_mut() {
            Some(block) if used + more <= width() => {
                used += more;
                block.push(column);
            }
            _ => {
                used = first.width() + more;
                blocks.push(vec![column]);
            }
        }
    }
    let tables = blocks.iter().map(|block| {
        let shown = || std::iter::once(first).chain(block);
        let mut table = table(shown().map(|column| column.heading.clone()).collect());
        for i in 0..first.cells.len() {
            table.add_row(shown().map(|column| column.cells[i].clone()));
        }
        let numbers = shown().enumerate().filter(|(_, column)| column.numbers);
        let numbers: Vec<usize> = numbers.map(|(index, _)| index).collect();
        for index in numbers {
            if let Some(column) = table.column_mut(index) {
                column.set_cell_alignment(CellAlignment::Right);
            }
        }
        text(&table)
    });
    tables.collect()
}

/// The table as text, without spaces at the ends of lines, with an empty line after it.
pub fn text(table: &Table) -> String {
    let lines = table.lines().map(|line| format!("{}\n", line.trim_end()));
    lines.chain(std::iter::once("\n".to_owned())).collect()
}
