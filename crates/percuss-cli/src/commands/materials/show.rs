//! `percuss materials show`: the record of one material.

use clap::Args;
use percuss::material::{Library, MaterialEntry, Reference, references};
use serde::Serialize;

use super::MaterialRecord;
use crate::{failure::Failure, material_card, output, response::Response};

const AFTER_HELP: &str = "\
Examples:
  percuss materials show copper
  percuss materials show ofhc-copper-johnson-cook --json

Exit codes: 0 ok, 2 no such material, 4 a file could not be read";

/// Show all constants of a material
///
/// Prints all constants with their units, the strength law, the trust grade, the
/// sources, and the alternative records of the same family.
#[derive(Debug, Args)]
#[command(verbatim_doc_comment, after_help = AFTER_HELP)]
pub struct Show {
    /// Id, family or alias of the material
    name: String,
}

#[derive(Serialize)]
struct Card<'a> {
    #[serde(flatten)]
    record: MaterialRecord<'a>,
    equation: &'static str,
    trust_meaning: &'static str,
    rivals: Vec<&'a str>,
    references: Vec<Work<'a>>,
}

#[derive(Serialize)]
struct Work<'a> {
    key: &'a str,
    label: &'a str,
    title: &'a str,
    place: &'a str,
    note: &'a str,
}

impl Show {
    pub fn run(&self, library: &Library, json: bool) -> Result<(), Failure> {
        let entry = self.find(library)?;
        if json {
            return output::print_json(&card(entry, library));
        }
        output::print(&material_card::text(entry, library))
    }

    /// Output of --json.
    pub fn execute(&self, library: &Library) -> Result<Response, Failure> {
        Response::json_of(&card(self.find(library)?, library), Vec::new())
    }

    fn find<'a>(&self, library: &'a Library) -> Result<&'a MaterialEntry, Failure> {
        find(library, &self.name)
    }
}

/// The record of a name.
pub(super) fn find<'a>(library: &'a Library, name: &str) -> Result<&'a MaterialEntry, Failure> {
    library.find(name).ok_or_else(|| {
        let near = library.suggestion(name);
        Failure::Material {
            message: library.unknown(name),
            help: format!("{near}`percuss materials` lists all"),
        }
    })
}

fn card<'a>(entry: &'a MaterialEntry, library: &'a Library) -> Card<'a> {
    let material = &entry.material;
    Card {
        record: MaterialRecord::new(entry),
        equation: material.strength.law().equation(),
        trust_meaning: material.trust.meaning(),
        rivals: library.rivals(entry).map(|rival| &*rival.id).collect(),
        references: material
            .sources
            .iter()
            .filter_map(|key| references().get(key))
            .map(work)
            .collect(),
    }
}

fn work(reference: &Reference) -> Work<'_> {
    Work {
        key: &reference.key,
        label: &reference.label,
        title: &reference.title,
        place: &reference.place,
        note: &reference.note,
    }
}
