use comfy_table::{CellAlignment, Table, presets};
use percuss::material::{Library, MaterialEntry};

use super::MaterialRecord;
use crate::{failure::Failure, terminal};

/// Prints all materials of a library.
pub fn list(library: &Library, json: bool) -> Result<(), Failure> {
    if json {
        return terminal::print_json(&records(library));
    }
    let mut table = Table::new();
    table
        .load_style(presets::NOTHING)
        .set_header([
            "id",
            "family",
            "name",
            "state",
            "law",
            "density [kg/m3]",
            "trust",
            "sources",
        ])
        .add_rows(library.iter().map(row));
    for column in table.column_iter_mut() {
        column.set_padding((0, 1));
    }
    if let Some(column) = table.column_mut(5) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    let text = table.trim_fmt();
    // In a narrow terminal broken columns are hard to read. Elsewhere no width is known: a material has one line.
    let widest = text.lines().map(|line| line.chars().count()).max();
    match table.width() {
        Some(width) if widest > Some(width.into()) => terminal::print(&narrow(library)),
        _ => terminal::print(&format!("{text}\n")),
    }
}

/// The materials as JSON has them.
pub fn records(library: &Library) -> Vec<MaterialRecord<'_>> {
    library.iter().map(MaterialRecord::new).collect()
}

/// The table for a narrow terminal: a few lines a material.
fn narrow(library: &Library) -> String {
    let width = terminal::width();
    let mut text = String::new();
    for entry in library.iter() {
        let [id, family, name, state, law, density, trust, sources] = row(entry);
        let state = match state.as_str() {
            "" => String::new(),
            state => format!(", {state}"),
        };
        let rest =
            format!("{name}{state}; {law}, {density} kg/m3; trust {trust}; sources: {sources}");
        text += &format!(
            "{}  {family}\n  {}\n",
            terminal::bold(id),
            terminal::wrap(&rest, width - 2, 2)
        );
    }
    text
}

fn row(entry: &MaterialEntry) -> [String; 8] {
    let material = &entry.material;
    let star = if material.recommended { " ★" } else { "" };
    [
        entry.id.clone(),
        material.family.clone().unwrap_or_default() + star,
        material.name.clone(),
        material.state.clone().unwrap_or_default(),
        material.strength.key().to_owned(),
        format!("{}", material.density.si()),
        material.trust.letter().to_owned(),
        material.sources.join(", "),
    ]
}
