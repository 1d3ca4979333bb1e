use comfy_table::{CellAlignment, ContentArrangement, Table, presets};
use percuss::material::{Library, MaterialEntry, Trust};

use super::MaterialRecord;
use crate::{failure::Failure, terminal};

/// Prints all materials of a library.
pub fn list(library: &Library, json: bool) -> Result<(), Failure> {
    if json {
        let records: Vec<MaterialRecord<'_>> = library.iter().map(MaterialRecord::new).collect();
        return terminal::print_json(&records);
    }
    let mut table = Table::new();
    table
        .load_style(presets::NOTHING)
        // Where output is no terminal no width is known, and every material has one line.
        .set_content_arrangement(ContentArrangement::Dynamic)
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
    terminal::print(&format!("{}\n", table.trim_fmt()))
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
        trust(material.trust).to_owned(),
        material.sources.join(", "),
    ]
}

/// A degree of trust as files have it.
pub fn trust(trust: Trust) -> &'static str {
    match trust {
        Trust::A => "A",
        Trust::B => "B",
        Trust::C => "C",
        Trust::User => "user",
    }
}
