//! `percuss materials`: list of the materials.

mod list;
mod show;

use std::path::PathBuf;

use clap::{Args, Subcommand};
use percuss::{
    case,
    material::{Library, Material, MaterialEntry},
};
use serde::Serialize;

use crate::{
    failure::Failure,
    response::{Response, VirtualFiles},
};

const LONG_ABOUT: &str = "\
List the materials of the library. A case names a material by its id or its
family. Alternative records of one material form a family; the name of the
family selects the record marked ★. Trust grades the numbers: A two independent
sources, B one secondary source that names its primary source, C indicative.

With WORDS, only materials with all words in id, family, name or state are
listed. Common synonyms work, such as aluminum, titanium and rha.

`percuss materials show NAME` prints all constants of a material.";

const AFTER_HELP: &str = "\
Examples:
  percuss materials
  percuss materials aluminium
  percuss materials show copper
  percuss materials show my-alloy --case my-case/scenario.toml
  percuss materials --json

Exit codes: 0 ok, 2 bad input or no such material, 4 a file could not be read";

/// List the materials, or show one
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
#[command(disable_help_subcommand = true)]
pub struct Materials {
    /// Print JSON
    #[arg(long, global = true)]
    json: bool,
    /// Include the materials of a case, and of the files that it names
    #[arg(long, global = true, value_name = "CASE.toml")]
    case: Option<PathBuf>,
    /// Include the materials of a file
    #[arg(long, global = true, value_name = "FILE", conflicts_with = "case")]
    file: Option<PathBuf>,
    /// Words to search for in id, family, name and state
    #[arg(value_name = "WORDS")]
    search: Vec<String>,
    #[command(subcommand)]
    action: Option<Action>,
}

#[derive(Debug, Subcommand)]
enum Action {
    Show(show::Show),
}

impl Materials {
    pub fn run(&self) -> Result<(), Failure> {
        let library = self.library(&VirtualFiles::default())?;
        match &self.action {
            None => list::list(&self.listed(&library)?, self.json),
            Some(Action::Show(show)) => show.run(&library, self.json),
        }
    }

    /// Output of --json.
    pub fn execute(&self, virtual_files: &VirtualFiles) -> Result<Response, Failure> {
        let library = self.library(virtual_files)?;
        match &self.action {
            None => Response::json_of(&list::records(&self.listed(&library)?), Vec::new()),
            Some(Action::Show(show)) => show.execute(&library),
        }
    }

    /// The materials to list: all of them, or those that hold the words.
    fn listed<'a>(&self, library: &'a Library) -> Result<Vec<&'a MaterialEntry>, Failure> {
        let words = self.search.join(" ");
        if words.trim().is_empty() {
            return Ok(library.iter().collect());
        }
        match library.search(&words) {
            found if found.is_empty() => Err(Failure::Material {
                message: format!("no material has `{words}` in its id, family, name or state"),
                help: format!(
                    "{}`percuss materials` lists all",
                    library.suggestion(&words)
                ),
            }),
            found => Ok(found),
        }
    }

    fn library(&self, virtual_files: &VirtualFiles) -> Result<Library, Failure> {
        if let Some(case) = &self.case {
            return Ok(case::library(&virtual_files.read(case)?)?);
        }
        let mut library = Library::built_in().clone();
        if let Some(file) = &self.file {
            library.add(&case::load_materials(file)?, &file.display().to_string());
        }
        Ok(library)
    }
}

/// Material as JSON: id, origin, and the record of the file.
#[derive(Serialize)]
struct MaterialRecord<'a> {
    id: &'a str,
    origin: &'a str,
    #[serde(flatten)]
    material: &'a Material,
    bar_wave_speed_m_s: f64,
    bar_impedance_kg_m2_s: f64,
}

impl<'a> MaterialRecord<'a> {
    fn new(entry: &'a MaterialEntry) -> Self {
        Self {
            id: &entry.id,
            origin: &entry.origin,
            material: &entry.material,
            bar_wave_speed_m_s: entry.material.bar_wave_speed(),
            bar_impedance_kg_m2_s: entry.material.bar_impedance(),
        }
    }
}
