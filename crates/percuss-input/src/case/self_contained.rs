//! Text of a case with everything that it takes from other files.

use std::path::{Path, PathBuf};

use toml_edit::{DocumentMut, Item, Table, TableLike, value};

use super::{Case, Document, material_file::TABLE};
use crate::{check::Diagnostic, document::read_text, error::Error};

/// Key of the files that a case takes materials from.
const FILES: &str = "material_files";

/// Key of the tables of its measured curves.
const CURVES: &str = "measured_curves";

/// The text of the case with the records of its material files and its measured curves in it: it needs no other file. A case that names
/// none keeps its text.
///
/// # Errors
/// [`Error::Read`] and [`Error::Input`] for a case or a file that cannot be read.
pub fn self_contained(document: &Document) -> Result<String, Error> {
    let mut case = edited(document)?;
    let comment = comment_above(&case);
    let has_curves = take_curves(&mut case, document)?;
    let Some(named) = case.remove(FILES) else {
        return Ok(match has_curves {
            true => case.to_string(),
            false => document.text.clone(),
        });
    };
    let files: Vec<PathBuf> = named
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(|file| file.as_str().map(PathBuf::from))
        .collect();
    let own = case
        .entry(TABLE)
        .or_insert_with(|| Item::Table(implicit_table()));
    // Records go under headers of their own, whatever form the case's own table has.
    let mut own_table = std::mem::take(own)
        .into_table()
        .unwrap_or_else(|_| implicit_table());
    for file in &files {
        let folder = document.folder.as_deref().unwrap_or(Path::new(""));
        let materials = Document::read(folder.join(file))?.of_materials();
        // As a case is read, a record of a file stands for one of the same name in a file before it.
        for (id, record) in records(edited(&materials)?) {
            own_table.insert(&id, record);
        }
    }
    *own = Item::Table(own_table);
    Ok(comment + &case.to_string())
}

/// Puts the texts of files of measured curves into the case; whether it names any.
fn take_curves(case: &mut DocumentMut, document: &Document) -> Result<bool, Error> {
    let tables = document.parse::<Case>()?.measured_curves;
    let folder = document.folder.as_deref().unwrap_or(Path::new(""));
    let mut items: Vec<&mut dyn TableLike> = match case.get_mut(CURVES) {
        Some(Item::ArrayOfTables(written)) => written.iter_mut().map(|table| table as _).collect(),
        Some(Item::Value(written)) => {
            let written = written.as_array_mut().into_iter();
            let written = written.flat_map(|items| items.iter_mut());
            let written = written.filter_map(|item| item.as_inline_table_mut());
            written.map(|table| table as _).collect()
        }
        _ => Vec::new(),
    };
    let mut any = false;
    for (i, (table, item)) in tables.iter().zip(&mut items).enumerate() {
        if let Some(file) = &table.file {
            any = true;
            item.remove("file");
            item.insert("name", value(table.name(i)));
            item.insert("csv", value(read_text(&folder.join(file))?));
        }
    }
    Ok(any)
}

/// The comment above the key of the files, which often is that of the whole case.
fn comment_above(case: &DocumentMut) -> String {
    let key = case.key(FILES);
    let prefix = key.and_then(|key| key.leaf_decor().prefix()?.as_str());
    let prefix = prefix.filter(|prefix| prefix.contains('#'));
    prefix.unwrap_or_default().trim_start().to_owned()
}

/// The records of a material file, in the form that a case has them.
fn records(file: DocumentMut) -> Vec<(String, Item)> {
    let mut found = Vec::new();
    for (id, item) in file.into_table() {
        match item {
            Item::Table(table) if id == TABLE => found.extend(table.into_iter().map(as_table)),
            item if id == TABLE => {
                found.extend(item.into_table().into_iter().flatten().map(as_table))
            }
            item => found.push(as_table((id.to_string(), item))),
        }
    }
    found
}

fn as_table<K: AsRef<str>>((id, item): (K, Item)) -> (String, Item) {
    let mut item = match item.into_table() {
        Ok(table) => Item::Table(table),
        Err(other) => other,
    };
    forget_positions(&mut item);
    (id.as_ref().to_owned(), item)
}

/// Lets the tables of another text stand behind the one that they go into.
fn forget_positions(item: &mut Item) {
    if let Item::Table(table) = item {
        table.set_position(None);
        table
            .iter_mut()
            .for_each(|(_, item)| forget_positions(item));
    }
}

fn implicit_table() -> Table {
    let mut table = Table::new();
    table.set_implicit(true);
    table
}

fn edited(document: &Document) -> Result<DocumentMut, Error> {
    document
        .text
        .parse()
        .map_err(|error: toml_edit::TomlError| {
            document
                .place(Diagnostic::whole(error.message(), ""))
                .into()
        })
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::super::scenario;
    use super::*;

    const CASE: &str = "# Two materials\nmaterial_files = ['lib/a.toml', 'lib/b.toml']\n\
                        projectile = { material = 'rod', length = '20 mm', diameter = '5 mm', impact_velocity = '300 m/s' }\n\
                        target = { material = 'plate', thickness = '5 mm', back_face = 'free' }\n\
                        [[experiments]]\nballistic_limit = '300 m/s'\nsource = 'made up'\n";

    fn record(density: &str) -> String {
        format!(
            "name = 'made up' # kept\ndensity = '{density} kg/m3'\nyoungs_modulus = '71.30000000000001 GPa'\npoissons_ratio = 0.33\n\
             strength = {{ johnson_cook = {{ a = '300 MPa', b = '400 MPa', n = 0.1, c = 0.01, m = 1.0 }} }}\n\
             melting_temperature = '900 K'\nspecific_heat = '900 J/(kg K)'\n"
        )
    }

    /// The folder of a case with its files.
    fn folder(own: &str) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
        fs::create_dir(folder.path().join("lib")).unwrap();
        write("case.toml", &format!("{CASE}{own}"));
        let first = format!("[rod]\n{}\n[foil]\n{}", record("7850"), record("1000"));
        write("lib/a.toml", &first);
        write(
            "lib/b.toml",
            &format!("[materials.plate]\n{}", record("2700")),
        );
        folder
    }

    #[test]
    fn a_case_with_its_materials_in_it_is_the_same_case() {
        let inline = format!(
            "[materials]\nother = {{ {} }}\n",
            record("2000")
                .replace(" # kept", "")
                .trim()
                .replace('\n', ", ")
        );
        let header = format!("[materials.other]\n{}", record("2000"));
        for own in ["", &header, &inline] {
            let folder = folder(own);
            let document = Document::read(folder.path().join("case.toml")).unwrap();
            let text = self_contained(&document).unwrap();
            assert!(!text.contains("material_files"), "{text}");
            assert!(text.starts_with("# Two materials\n"), "{text}");
            let alone = Document::new("case", text.clone());
            let (alone, whole) = (scenario(&alone), scenario(&document));
            let alone = alone.unwrap_or_else(|error| panic!("{error}\n{text}"));
            assert_eq!(alone, whole.unwrap(), "{text}");
            assert_eq!(alone.projectile.material.density.si(), 7850.0);
            // What was written is written again, digits and comments included.
            assert!(
                text.contains("71.30000000000001 GPa") && text.contains("# kept"),
                "{text}"
            );
        }
    }

    /// A sweep would take the record of the case, and a run that of the file.
    #[test]
    fn a_record_of_the_case_and_of_a_file_is_refused() {
        let folder = folder(&format!("[materials.rod]\n{}", record("2000")));
        let error = Document::read(folder.path().join("case.toml"))
            .and_then(|document| scenario(&document))
            .unwrap_err()
            .to_string();
        assert!(
            error.contains("case.toml:8: `materials.rod`")
                && error.contains("by the file `lib/a.toml`"),
            "{error}"
        );
    }

    #[test]
    fn a_case_without_files_keeps_its_text() {
        let text = "# as it is\nprojectile = { material = 'copper' , length = '20 mm', diameter = '5 mm', impact_velocity = '300 m/s' }\n\
                    target = { rigid_wall = true }\n";
        assert_eq!(self_contained(&Document::new("case", text)).unwrap(), text);
    }
}
