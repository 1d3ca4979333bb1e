//! `percuss materials export`: records as TOML, JSON, a table, or cards of a deck.

use std::{collections::HashSet, path::PathBuf};

use clap::{Args, ValueEnum};
use percuss::{
    case::materials_toml,
    lsdyna::{self, UnitSystem},
    material::{Library, Material, MaterialEntry, MaterialTable},
    material_tables,
};
use serde::Serialize;

use super::{show, write_file};
use crate::{
    failure::Failure, file_list::FileList, output, response::Response, unit_system::unit_system,
};

const LONG_ABOUT: &str = "\
Print records of the library as text: as TOML, to start a record of your own
from and for the `material_files` of a case; as JSON or as a table of
comma-separated values, for other programs; or as cards of an LS-DYNA deck,
*MAT_JOHNSON_COOK with *EOS_GRUNEISEN in a unit system. `percuss materials
import` reads all of them but TOML.

A card has fields of ten columns, which round some numbers to four digits. A
record with another strength law than Johnson-Cook has no card.";

const AFTER_HELP: &str = "\
Examples:
  percuss materials export 4340 > my-steel.toml
  percuss materials export rha 4340 --format csv --out steels.csv
  percuss materials export 4340 --format ls-dyna --units mm-kg-ms --out s.k

Exit codes: 0 ok, 2 bad input or no such material, 4 a file could not be read or
written";

/// Print records as TOML, JSON, a table, or cards of an LS-DYNA deck
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Export {
    /// Ids, families or aliases of the materials
    #[arg(required = true, value_name = "NAMES")]
    names: Vec<String>,
    /// Format of the text
    #[arg(long, value_enum, default_value_t = Format::Toml)]
    format: Format,
    /// Unit system of a deck: length, mass and time
    #[arg(long, value_name = "SYSTEM", value_parser = unit_system())]
    units: Option<UnitSystem>,
    /// Write the text to a file
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Records as in the files of the library
    Toml,
    /// An object with a record for each id
    Json,
    /// A table with a row for each material, for spreadsheets
    Csv,
    /// Cards of a deck
    LsDyna,
}

#[derive(Serialize)]
struct Record<'a> {
    text: &'a str,
}

impl Export {
    pub fn run(&self, library: &Library, json: bool) -> Result<(), Failure> {
        let text = self.text(library)?;
        let files = FileList::new(&write_file(self.out.as_ref(), &text)?);
        match (json, &self.out) {
            (true, _) => files.print_json(&Record { text: &text }, false),
            (false, Some(_)) => files.print_under(String::new()),
            (false, None) => output::print(&text),
        }
    }

    /// Output of --json.
    pub fn execute(&self, library: &Library) -> Result<Response, Failure> {
        let text = self.text(library)?;
        let files = write_file(self.out.as_ref(), &text)?;
        Response::json_of(&Record { text: &text }, files)
    }

    fn text(&self, library: &Library) -> Result<String, Failure> {
        let find = |name: &String| show::find(library, name);
        let mut entries: Vec<&MaterialEntry> =
            self.names.iter().map(find).collect::<Result<_, _>>()?;
        // A record that is named twice, by id and alias for example, is written once.
        let mut written = HashSet::new();
        entries.retain(|entry| written.insert(&entry.id));
        let records = || -> MaterialTable {
            let entries = entries.iter();
            let records = entries.map(|entry| (entry.id.clone(), Material::clone(&entry.material)));
            records.collect()
        };
        let unwritable = |reason: String| Failure::Material {
            message: format!("the records cannot be written: {reason}"),
            help: String::new(),
        };
        match (self.format, self.units) {
            (Format::Toml, None) => Ok(materials_toml(&records())),
            (Format::Json, None) => material_tables::json(&records()).map_err(unwritable),
            (Format::Csv, None) => material_tables::csv(&records()).map_err(unwritable),
            (Format::Toml | Format::Json | Format::Csv, Some(_)) => Err(Failure::Usage {
                message: "`--units` has an effect with `--format ls-dyna` only".to_owned(),
                help: "every number of other records carries its unit: remove `--units`".to_owned(),
            }),
            (Format::LsDyna, Some(units)) => deck(&entries, units),
            (Format::LsDyna, None) => Err(Failure::Usage {
                message: "`--format ls-dyna` needs `--units`: a deck has no units of its own"
                    .to_owned(),
                help: format!("unit systems: {}", UnitSystem::NAMES.join(", ")),
            }),
        }
    }
}

fn deck(entries: &[&MaterialEntry], units: UnitSystem) -> Result<String, Failure> {
    let mut text = format!(
        "*KEYWORD\n$ Units: {}, stresses in {}, temperatures in kelvin\n",
        units.name, units.pressure_unit
    );
    for (i, entry) in entries.iter().enumerate() {
        let cards =
            lsdyna::write(i + 1, &entry.material, units).map_err(|refusal| Failure::Material {
                message: format!("`{}` has no card: {}", entry.id, refusal.reason),
                help: refusal.remedy.unwrap_or_default(),
            })?;
        text += &cards;
    }
    Ok(text + "*END\n")
}
