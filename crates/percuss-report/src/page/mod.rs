//! A page that can be written as HTML and as Markdown.

pub mod html;
pub mod markdown;

use std::path::{Path, PathBuf};

use crate::{Figure, ReportError, column::File, replace_file::replace_file};

/// Writes a page as `STEM.html` and `STEM.md`, the pictures of the latter and further files to a folder, which is made if it does not exist.
///
/// # Errors
/// [`ReportError::Write`]; [`ReportError::Figure`].
pub fn write<'a>(
    folder: &Path,
    stem: &str,
    page: &[Block<'_>],
    figures: impl Iterator<Item = &'a Figure>,
    files: Vec<File>,
) -> Result<Vec<PathBuf>, ReportError> {
    let (html, markdown) = (html::render(page), markdown::render(page));
    let mut written = vec![
        replace_file(folder, &format!("{stem}.html"), html.as_bytes())?,
        replace_file(folder, &format!("{stem}.md"), markdown.as_bytes())?,
    ];
    for figure in figures {
        written.push(figure.write_for_page(folder)?);
    }
    for (name, content) in files {
        written.push(replace_file(folder, name, &content)?);
    }
    Ok(written)
}

/// A part of a page. Texts are plain: the writers escape them.
pub enum Block<'a> {
    /// Heading of the page.
    Title(String),
    /// Heading of a section.
    Heading(String),
    /// Heading of a part of a section.
    Subheading(String),
    /// A paragraph.
    Text(String),
    /// A list.
    List(Vec<String>),
    /// Addresses and what is said of them.
    Links(Vec<(String, String)>),
    /// A table.
    Table(Table),
    /// A figure.
    Figure(&'a Figure),
    /// Parts that are shown when asked for.
    Folded(String, Vec<Block<'a>>),
    /// Parts that are too long for Markdown.
    WebOnly(Vec<Block<'a>>),
}

/// A table.
#[derive(Default)]
pub struct Table {
    /// Headings; one that begins with `#` stands over numbers, which are set flush right.
    pub head: Vec<String>,
    /// Rows of as many texts as there are headings.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// A table without rows.
    pub fn new(head: &[&str]) -> Self {
        Self {
            head: head.iter().map(|&name| name.to_owned()).collect(),
            rows: Vec::new(),
        }
    }

    /// Headings with whether numbers stand below.
    pub fn columns(&self) -> impl Iterator<Item = (&str, bool)> {
        self.head.iter().map(|name| {
            name.strip_prefix('#')
                .map_or((name.as_str(), false), |name| (name, true))
        })
    }
}
