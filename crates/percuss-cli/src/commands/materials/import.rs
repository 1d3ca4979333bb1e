//! `percuss materials import`: records from a deck, from JSON or from a table.

use std::path::PathBuf;

use clap::Args;
use percuss::{
    case::materials_toml,
    lsdyna::{self, Imported, UnitSystem},
    material::{Material, MaterialTable},
    material_tables::{self, TableFormat},
};
use serde::Serialize;

use super::write_file;
use crate::{
    diagnostic, failure::Failure, file_list::FileList, output, response::Response, terminal,
    unit_system::unit_system,
};

const LONG_ABOUT: &str = "\
Read the materials of an LS-DYNA deck: *MAT_JOHNSON_COOK (015),
*MAT_SIMPLIFIED_JOHNSON_COOK (098) and *EOS_GRUNEISEN, joined by *PART or by
equal numbers. The records are printed as TOML, for the `material_files` of a
case, or written to a file with --out. What they leave out is a warning.

Of a file that ends with .json or .csv, records as `percuss materials export`
writes them are read: in a table a row for each material and a column for each
key, such as density (kg/m3) or strength.johnson_cook.a. Empty cells leave a key
out, columns of other names are a warning.

A deck has no units: --units names its unit system, by length, mass and time.
Temperatures are in kelvin. A record is refused where no material has its
values, which is what a wrong unit system leads to.";

const AFTER_HELP: &str = "\
Examples:
  percuss materials import plate.k --units mm-kg-ms
  percuss materials import plate.k --units mm-t-s --out plate.toml
  percuss materials import steels.csv --out steels.toml

Exit codes: 0 ok, 2 bad input, 4 a file could not be read or written";

/// Read materials from an LS-DYNA deck, JSON or a table
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Import {
    /// Deck, or a file of materials that ends with .json or .csv
    #[arg(value_name = "FILE")]
    deck: PathBuf,
    /// Unit system of a deck: length, mass and time
    #[arg(long, value_name = "SYSTEM", value_parser = unit_system())]
    units: Option<UnitSystem>,
    /// Write the records to a file
    #[arg(long, value_name = "FILE.toml")]
    out: Option<PathBuf>,
}

#[derive(Serialize)]
struct Record<'a> {
    records: &'a MaterialTable,
    warnings: &'a [String],
}

impl Import {
    pub fn run(&self, json: bool) -> Result<(), Failure> {
        let found = self.read()?;
        let files = self.write(&found)?;
        for warning in &found.warnings {
            diagnostic::print(&terminal::warning(warning));
        }
        let files = FileList::new(&files);
        if json {
            return files.print_json(&record(&found), false);
        }
        match self.out {
            Some(_) => files.print_under(listed(&found)),
            None => output::print(&materials_toml(&found.records)),
        }
    }

    /// Output of --json.
    pub fn execute(&self) -> Result<Response, Failure> {
        let found = self.read()?;
        let files = self.write(&found)?;
        Response::json_of(&record(&found), files)
    }

    fn read(&self) -> Result<Imported, Failure> {
        match (TableFormat::of(&self.deck), self.units) {
            (Some(format), None) => Ok(material_tables::read_file(&self.deck, format)?),
            (Some(_), Some(_)) => Err(Failure::Usage {
                message: "`--units` has no effect on JSON and tables".to_owned(),
                help: "their numbers carry their units: remove `--units`".to_owned(),
            }),
            (None, Some(units)) => Ok(lsdyna::read_file(&self.deck, units)?),
            (None, None) => Err(Failure::Usage {
                message: "a deck needs `--units`: it has no units of its own".to_owned(),
                help: format!(
                    "unit systems: {}; a file of another format ends with .json or .csv",
                    UnitSystem::NAMES.join(", ")
                ),
            }),
        }
    }

    fn write(&self, found: &Imported) -> Result<Vec<PathBuf>, Failure> {
        write_file(self.out.as_ref(), &materials_toml(&found.records))
    }
}

fn record(found: &Imported) -> Record<'_> {
    Record {
        records: &found.records,
        warnings: &found.warnings,
    }
}

fn listed(found: &Imported) -> String {
    let line = |(id, material): (&String, &Material)| format!("{id}: {}\n", material.name);
    found.records.iter().map(line).collect()
}
