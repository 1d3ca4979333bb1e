//! The gallery of cases: a picture, the title and the first sentence of each folder in `cases/`.

use std::{fs, path::Path};

/// Columns of the table.
const COLUMNS: usize = 3;

/// What the README of a case starts with.
struct Card {
    name: String,
    title: String,
    sentence: String,
    picture: Option<String>,
}

impl Card {
    fn of(name: String, readme: &str) -> Self {
        let mut paragraphs = readme.split("\n\n").map(str::trim);
        let title = paragraphs.next().and_then(|line| line.strip_prefix("# "));
        let title = title.unwrap_or_else(|| panic!("cases/{name}/README.md has no title"));
        let text = paragraphs.next().unwrap_or_default().replace('\n', " ");
        let end = sentence_end(&text);
        let mut pictures = readme
            .split("](")
            .skip(1)
            .filter_map(|rest| rest.split(')').next());
        let picture = pictures.find(|place| place.ends_with(".png"));
        Self {
            picture: picture.map(|place| format!("../../cases/{name}/{place}")),
            sentence: plain(&text[..end]),
            title: title.to_owned(),
            name,
        }
    }

    /// A cell of a table in Markdown: the book changes its links to those of pages, but not links in HTML.
    fn cell(&self) -> String {
        let link = format!("../../cases/{}/README.md", self.name);
        let picture = self.picture.as_ref().map(|place| {
            format!(
                "[<img src=\"{place}\" alt=\"{}\" width=\"280\">]({link})<br>",
                self.title
            )
        });
        format!(
            "{}[**{}**]({link})<br>`{}`<br>{}",
            picture.unwrap_or_default(),
            self.title,
            self.name,
            self.sentence
        )
    }
}

/// Where the first sentence ends: at a full stop before a space and a capital.
fn sentence_end(text: &str) -> usize {
    let stops = text.match_indices(". ").map(|(at, _)| at + 1);
    let mut ends = stops.filter(|at| text[*at..].trim_start().starts_with(char::is_uppercase));
    ends.next().unwrap_or(text.len())
}

/// A text of Markdown without links, emphasis and citations, for a cell of a table.
fn plain(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some(start) = rest.find('[') {
        let Some(length) = rest[start..].find(']') else {
            break;
        };
        let (words, behind) = (
            &rest[start + 1..start + length],
            &rest[start + length + 1..],
        );
        plain += &rest[..start];
        match behind.strip_prefix('(').and_then(|place| place.find(')')) {
            Some(end) => {
                plain += words;
                rest = &behind[end + 2..];
            }
            // A citation.
            None => {
                plain = plain.trim_end().to_owned();
                rest = behind;
            }
        }
    }
    plain += rest;
    plain
        .replace(['`', '*'], "")
        .replace('<', "&lt;")
        .replace('|', "\\|")
}

pub fn page() -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases");
    let mut names: Vec<String> = fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .filter(|name| folder.join(name).join("scenario.toml").is_file())
        .collect();
    names.sort();
    let cards = names.into_iter().map(|name| {
        let readme = fs::read_to_string(folder.join(&name).join("README.md")).unwrap();
        Card::of(name, &readme)
    });
    let cells: Vec<String> = cards.map(|card| card.cell()).collect();
    let rows: String = cells
        .chunks(COLUMNS)
        .map(|row| format!("| {} |\n", row.join(" | ")))
        .collect();
    let head = "| ".repeat(COLUMNS) + "|\n" + &"|---".repeat(COLUMNS) + "|\n";
    format!(
        "# Cases\n\nEach folder has the case, its expected numbers, which a test compares, and a page. `percuss run cases/NAME/scenario.toml` computes one; those of `particles` need `--model particles`.\n\n\
         {head}{rows}"
    )
}
