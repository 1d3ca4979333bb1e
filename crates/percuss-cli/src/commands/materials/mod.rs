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
    answer::{Answer, AtHand},
    failure::Failure,
};

const LONG_ABOUT: &str = "\
List the materials that a case can name, by their id or by their family. Rival
records of one material form a family; the one marked ★ answers to the family's
name. Trust says how well the numbers are established: A read in two independent
places, B one secondary source that names its primary source, C indicative.

With WORDS those are listed whose id, family, name or state hold every word.
Common synonyms are known, such as aluminum, titanium and rha.

`percuss materials show NAME` prints everything that is known of one.";

const AFTER_HELP: &str = "\
Examples:
  percuss materials
  percuss materials aluminium
  percuss materials show copper
  percuss materials show my-alloy --case my-shot/scenario.toml
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
    /// Words that the materials listed have in their id, family, name or state
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
        let library = self.library(&AtHand::default())?;
        match &self.action {
            None => list::list(&self.listed(&library)?, self.json),
            Some(Action::Show(show)) => show.run(&library, self.json),
        }
    }

    /// What the command prints with --json.
    pub fn answer(&self, at_hand: &AtHand) -> Result<Answer, Failure> {
        let library = self.library(at_hand)?;
        match &self.action {
            None => Answer::json_of(&list::records(&self.listed(&library)?), Vec::new()),
            Some(Action::Show(show)) => show.answer(&library),
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

    fn library(&self, at_hand: &AtHand) -> Result<Library, Failure> {
        if let Some(case) = &self.case {
            return Ok(case::library(&at_hand.read(case)?)?);
        }
        let mut library = Library::built_in().clone();
        if let Some(file) = &self.file {
            library.add(&case::load_materials(file)?, &file.display().to_string());
        }
        Ok(library)
    }
}

/// A material as JSON: its id, where it stands, and the record as a file has it.
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
