//! The gallery: a page of every figure of `docs/figures.toml` with the command that draws it.

use std::{collections::BTreeMap, fs, path::Path};

use serde::Deserialize;

/// Columns of the table.
const COLUMNS: usize = 3;
/// Pictures of a folder that stand for all of them.
const OF_A_FOLDER: usize = 3;

#[derive(Deserialize)]
struct Table {
    figure: Vec<Entry>,
}

#[derive(Deserialize)]
struct Entry {
    #[serde(default)]
    commands: Vec<String>,
    #[serde(default)]
    files: BTreeMap<String, String>,
    folder: Option<String>,
    script: Option<String>,
}

impl Entry {
    fn pictures(&self, root: &Path) -> Vec<String> {
        if let Some(folder) = &self.folder {
            let mut found: Vec<String> = fs::read_dir(root.join(folder))
                .unwrap()
                .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
                .filter(|name| name.ends_with(".png"))
                .map(|name| format!("{folder}/{name}"))
                .collect();
            found.sort();
            found.truncate(OF_A_FOLDER);
            return found;
        }
        self.files.keys().cloned().collect()
    }
}

pub fn page() -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let text = fs::read_to_string(root.join("docs/figures.toml")).unwrap();
    let table: Table = toml::from_str(&text).unwrap();
    let mut page = String::from(
        "# Gallery\n\nFigures of the documentation, each with the command that draws it. `OUT` is a folder. Commands write SVG beside PNG; a larger \
         picture opens on a click.\n",
    );
    let (drawn, of_page): (Vec<&Entry>, Vec<&Entry>) = table
        .figure
        .iter()
        .partition(|entry| entry.script.is_none());
    for entry in drawn {
        page += &format!("\n```sh\n{}\n```\n\n", entry.commands.join("\n"));
        page += &pictures(&entry.pictures(&root));
    }
    page += "\n## The page\n\n`percuss serve`, in a browser:\n\n";
    let places: Vec<String> = of_page.iter().flat_map(|e| e.pictures(&root)).collect();
    page + &pictures(&places)
}

/// A table of small pictures that are links to themselves.
fn pictures(places: &[String]) -> String {
    let cell = |place: &String| {
        let address = match place.strip_prefix("docs/") {
            Some(rest) => format!("../{rest}"),
            None => format!("../../{place}"),
        };
        format!(
            "<a href=\"{address}\"><img src=\"{address}\" alt=\"{}\" width=\"280\"></a>",
            words(place)
        )
    };
    let mut text = String::from("<table>\n");
    for row in places.chunks(COLUMNS) {
        let cells: String = row
            .iter()
            .map(|place| format!("<td>{}</td>", cell(place)))
            .collect();
        text += &format!("<tr>{cells}</tr>\n");
    }
    text + "</table>\n"
}

/// Case or page of a picture, and what it shows, from its path.
fn words(place: &str) -> String {
    let path = Path::new(place);
    let stem = path
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .replace('-', " ");
    let folder = path
        .parent()
        .and_then(Path::file_name)
        .unwrap_or_default()
        .to_string_lossy();
    match &*folder {
        "images" => stem,
        folder => format!("{folder}: {stem}"),
    }
}
