use comfy_table::{CellAlignment, Table, presets};
use percuss::material::MaterialEntry;

use super::MaterialRecord;
use crate::{failure::Failure, output, terminal};

/// Widest table, of records with short ids; others get a few lines per material.
const MAX_WIDTH: usize = 100;

/// Prints materials.
pub fn list(materials: &[&MaterialEntry], json: bool) -> Result<(), Failure> {
    if json {
        return output::print_json(&records(materials));
    }
    let mut table = Table::new();
    table
        .load_style(presets::NOTHING)
        .set_header(["id", "family", "law", "density [kg/m3]", "trust"])
        .add_rows(materials.iter().map(|entry| row(entry)));
    for column in table.column_iter_mut() {
        column.set_padding((0, 1));
    }
    if let Some(column) = table.column_mut(3) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    let text = table.trim_fmt();
    // Broken columns are hard to read.
    let widest = text.lines().map(|line| line.chars().count()).max();
    let room = table.width().map_or(MAX_WIDTH, usize::from).min(MAX_WIDTH);
    match widest > Some(room) {
        true => output::print(&narrow(materials)),
        false => output::print(&format!("{text}\n")),
    }
}

/// The materials as JSON has them.
pub fn records<'a>(materials: &[&'a MaterialEntry]) -> Vec<MaterialRecord<'a>> {
    let materials = materials.iter();
    materials.map(|entry| MaterialRecord::new(entry)).collect()
}

/// The list for a narrow terminal: a few lines per material.
fn narrow(materials: &[&MaterialEntry]) -> String {
    let width = terminal::width();
    let mut text = String::new();
    for entry in materials {
        let [id, family, law, density, trust] = row(entry);
        let name = &entry.material.name;
        let rest = format!("{name}; {law}, {density} kg/m3; trust {trust}");
        text += &format!(
            "{}  {family}\n  {}\n",
            terminal::bold(id),
            terminal::wrap(&rest, width - 2, 2)
        );
    }
    text
}

fn row(entry: &MaterialEntry) -> [String; 5] {
    let material = &entry.material;
    let star = if material.recommended { " ★" } else { "" };
    [
        entry.id.clone(),
        material.family.clone().unwrap_or_default() + star,
        material.strength.key().to_owned(),
        format!("{}", material.density.si()),
        material.trust.letter().to_owned(),
    ]
}
