//! Terminal output of a list of materials.

use percuss::material::MaterialEntry;
use percuss_report::table::Table;

use super::MaterialRecord;
use crate::{failure::Failure, output, table::plain, terminal};

/// Largest width of the table [characters]; wider lists get a few lines per material.
const MAX_WIDTH: usize = 100;

/// Prints materials.
pub fn list(materials: &[&MaterialEntry], json: bool) -> Result<(), Failure> {
    if json {
        return output::print_json(&records(materials));
    }
    let rows: Vec<[String; 6]> = materials.iter().map(|entry| row(entry)).collect();
    let table = Table::of(&rows)
        .words("id", |row| row[0].clone())
        .words("family", |row| row[1].clone())
        .words("law", |row| row[2].clone())
        .numbers("density [kg/m3]", "", |row| row[3].clone())
        .numbers("HB", "", |row| row[4].clone())
        .words("trust", |row| row[5].clone())
        .table();
    let text = plain(&table, 1);
    // Broken columns are hard to read.
    let widest = text.lines().map(|line| line.chars().count()).max();
    let room = terminal::full_width().map_or(MAX_WIDTH, |width| width.min(MAX_WIDTH));
    match widest > Some(room) {
        true => output::print(&narrow(materials)),
        false => output::print(&text),
    }
}

/// Materials as JSON records.
pub fn records<'a>(materials: &[&'a MaterialEntry]) -> Vec<MaterialRecord<'a>> {
    let materials = materials.iter();
    materials.map(|entry| MaterialRecord::new(entry)).collect()
}

/// The list for a narrow terminal: a few lines per material.
fn narrow(materials: &[&MaterialEntry]) -> String {
    let width = terminal::width();
    let mut text = String::new();
    for entry in materials {
        let [id, family, law, density, hardness, trust] = row(entry);
        let name = &entry.material.name;
        let hardness = match hardness.as_str() {
            "" => hardness,
            _ => format!(", {hardness} HB"),
        };
        let rest = format!("{name}; {law}, {density} kg/m3{hardness}; trust {trust}");
        text += &format!(
            "{}  {family}\n  {}\n",
            terminal::bold(id),
            terminal::wrap(&rest, width - 2, 2)
        );
    }
    text
}

fn row(entry: &MaterialEntry) -> [String; 6] {
    let material = &entry.material;
    let hardness = material.brinell_hardness;
    let star = if material.recommended { " ★" } else { "" };
    [
        entry.id.clone(),
        material.family.clone().unwrap_or_default() + star,
        material.strength.key().to_owned(),
        format!("{}", material.density.si()),
        hardness.map_or_else(String::new, |hardness| hardness.to_string()),
        material.trust.letter().to_owned(),
    ]
}
