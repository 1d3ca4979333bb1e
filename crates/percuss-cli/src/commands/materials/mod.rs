//! `percuss materials`: list of the materials.

mod compare;
mod export;
mod import;
mod list;
mod show;

use std::{
    fs,
    io::{self, Write},
    path::{Path, PathBuf},
};

use clap::{Args, Subcommand, builder::PossibleValuesParser};
use percuss::{
    case,
    material::{Filter, Library, Material, MaterialEntry, MaterialGroup},
    units::{Length, shorten},
};
use percuss_report::{ReportError, replace_file::replace_file_durably};
use serde::Serialize;

use crate::{
    failure::Failure,
    response::{Response, VirtualFiles},
};

const LONG_ABOUT: &str = "\
List the materials of the library. A case names a material by its id, its
family or an alias, such as rha, ofhc or 6061. Alternative records of one
material form a family; the name of the family selects the record marked ★.
Trust grades the numbers: A two independent sources, B one secondary source that
names its primary source, C indicative.

With WORDS, only materials with all words in id, family, group, name, aliases or
state are listed. --group, --family and --hardness narrow the list further.

`percuss materials show NAME` prints all constants of a material, `percuss
materials compare NAMES` the flow curves of several. `percuss materials export
NAMES` prints records as TOML or as cards of a deck, `percuss materials import
DECK` reads such cards.";

const AFTER_HELP: &str = "\
Examples:
  percuss materials
  percuss materials aluminium
  percuss materials armour --hardness 350..500
  percuss materials --group refractory_metal
  percuss materials show copper
  percuss materials compare rha 4340 --out curves
  percuss materials show my-alloy --case my-case/scenario.toml
  percuss materials export 4340 > my-steel.toml
  percuss materials import plate.k --units mm-kg-ms
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
    /// Only materials of a group, such as steel, aluminium or polymer
    #[arg(long, value_name = "GROUP")]
    #[arg(value_parser = PossibleValuesParser::new(MaterialGroup::ALL.map(MaterialGroup::key)), hide_possible_values = true)]
    group: Option<String>,
    /// Only the alternative records of one material
    #[arg(long, value_name = "FAMILY")]
    family: Option<String>,
    /// Only materials with a Brinell hardness in this range, such as 350..500
    #[arg(long, value_name = "FROM..TO", value_parser = hardness)]
    hardness: Option<[f64; 2]>,
    /// Words to search for in id, family, group, name, aliases and state
    #[arg(value_name = "WORDS")]
    search: Vec<String>,
    #[command(subcommand)]
    action: Option<Action>,
}

#[derive(Debug, Subcommand)]
enum Action {
    Show(show::Show),
    Compare(compare::Compare),
    Export(export::Export),
    Import(import::Import),
}

impl Materials {
    /// Width of the figure, where one is drawn.
    pub fn figure_width(&self) -> Option<Length> {
        match &self.action {
            Some(Action::Compare(compare)) => compare.figures.figure_width,
            _ => None,
        }
    }

    pub fn run(&self) -> Result<(), Failure> {
        self.check()?;
        let library = self.library(&VirtualFiles::default())?;
        match &self.action {
            None => list::list(&self.listed(&library)?, self.json),
            Some(Action::Show(show)) => show.run(&library, self.json),
            Some(Action::Compare(compare)) => compare.run(&library, self.json),
            Some(Action::Export(export)) => export.run(&library, self.json),
            Some(Action::Import(import)) => import.run(self.json),
        }
    }

    /// Output of --json.
    pub fn execute(&self, virtual_files: &VirtualFiles) -> Result<Response, Failure> {
        self.check()?;
        let library = self.library(virtual_files)?;
        match &self.action {
            None => Response::json_of(&list::records(&self.listed(&library)?), Vec::new()),
            Some(Action::Show(show)) => show.execute(&library),
            Some(Action::Compare(compare)) => compare.execute(&library),
            Some(Action::Export(export)) => export.execute(&library),
            Some(Action::Import(import)) => import.execute(),
        }
    }

    /// Fails where an option of all these commands has no effect.
    fn check(&self) -> Result<(), Failure> {
        let given = [("--case", &self.case), ("--file", &self.file)];
        match given.into_iter().find(|(_, value)| value.is_some()) {
            Some((option, _)) if matches!(self.action, Some(Action::Import(_))) => {
                Err(Failure::Usage {
                    message: format!("`{option}` has no effect with `materials import`"),
                    help: format!("the deck alone is read: remove `{option}`"),
                })
            }
            _ => Ok(()),
        }
    }

    /// The materials to list: all of them, or those that the words and options leave.
    fn listed<'a>(&self, library: &'a Library) -> Result<Vec<&'a MaterialEntry>, Failure> {
        let words = self.search.join(" ");
        let filter = Filter {
            words: &words,
            group: self.group.as_deref().and_then(MaterialGroup::of),
            family: self.family.as_deref(),
            brinell: self.hardness,
        };
        match library.filter(&filter) {
            found if found.is_empty() => Err(self.nothing(library, &words)),
            found => Ok(found),
        }
    }

    /// Why nothing is listed.
    fn nothing(&self, library: &Library, words: &str) -> Failure {
        let narrowed = self.group.is_some() || self.family.is_some() || self.hardness.is_some();
        let asked = shorten(words);
        let message = match (words.trim().is_empty(), narrowed) {
            (true, _) => "no material fits --group, --family and --hardness".to_owned(),
            (false, true) => format!("no material that the options leave has `{asked}`"),
            (false, false) => format!(
                "no material has `{asked}` in its id, family, group, name, aliases or state"
            ),
        };
        let near = match (narrowed, &self.family) {
            (false, _) => library.suggestion(words),
            (true, Some(family)) if library.find(family).is_none() => library.suggestion(family),
            (true, _) => String::new(),
        };
        Failure::Material {
            message,
            help: format!("{near}`percuss materials` lists all"),
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

/// Writes a text to a file, if there is one; returns it.
fn write_file(out: Option<&PathBuf>, text: &str) -> Result<Vec<PathBuf>, Failure> {
    let Some(out) = out else {
        return Ok(Vec::new());
    };
    // A pipe would wait for its reader.
    if fs::metadata(out).is_ok_and(|found| !found.is_file() && !found.is_dir()) {
        return Err(Failure::Write {
            path: out.clone(),
            reason: "it is not a regular file".to_owned(),
            help: "without `--out` the text is printed".to_owned(),
        });
    }
    let name = out.file_name().unwrap_or_default().to_string_lossy();
    let folder = match out.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let written = replace_file_durably(folder, &name, |file| file.write_all(text.as_bytes()));
    written.map_err(|error| match error {
        ReportError::Write { source, .. } => unwritten(out, &source),
        other => other.into(),
    })?;
    Ok(vec![out.clone()])
}

/// Why a file was not written.
fn unwritten(out: &Path, error: &io::Error) -> Failure {
    Failure::Write {
        path: out.to_owned(),
        help: match error.kind() {
            io::ErrorKind::NotFound => "make its folder first, or give another file".to_owned(),
            io::ErrorKind::IsADirectory => "give the name of a file in it".to_owned(),
            _ => String::new(),
        },
        reason: error.to_string(),
    }
}

/// A range of Brinell hardness.
fn hardness(text: &str) -> Result<[f64; 2], String> {
    let number = |part: &str| part.trim().parse::<f64>().ok().filter(|it| *it >= 0.0);
    let ends = text.split_once("..");
    match ends.and_then(|(from, to)| Some([number(from)?, number(to)?])) {
        Some([least, most]) if least <= most => Ok([least, most]),
        Some([most, least]) => Err(format!(
            "the range is reversed: write {least}..{most}, the smaller number first"
        )),
        _ => Err("write it as FROM..TO in kgf/mm2, such as 350..500".to_owned()),
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
