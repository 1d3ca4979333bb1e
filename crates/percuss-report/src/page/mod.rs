//! A page that can be written as HTML and as Markdown.

pub mod html;
pub mod markdown;

use std::path::{Path, PathBuf};

use rayon::prelude::*;

use crate::{
    Figure, ReportError,
    column::File,
    replace_file::{replace_file, replace_files},
    table::Table,
};

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
    let figures: Vec<_> = figures.collect();
    let pictures: Vec<_> = figures
        .par_iter()
        .map(|figure| figure.write_for_page(folder))
        .collect();
    for picture in pictures {
        written.push(picture?);
    }
    written.extend(replace_files(folder, files)?);
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
    /// A table.
    Table(Table),
    /// A figure.
    Figure(&'a Figure),
    /// Parts that are shown when asked for.
    Folded(String, Vec<Block<'a>>),
    /// Parts that are too long for Markdown.
    WebOnly(Vec<Block<'a>>),
}

/// A cell of a page, with minus signs in columns of numbers.
fn typeset(cell: &str, numbers: bool) -> String {
    let mut typeset = String::with_capacity(cell.len());
    let mut last = ' ';
    let mut chars = cell.chars().peekable();
    while let Some(c) = chars.next() {
        let is_sign = c == '-' && !last.is_alphanumeric();
        let before_number = chars.peek().is_some_and(char::is_ascii_digit);
        typeset.push(if numbers && is_sign && before_number {
            '\u{2212}'
        } else {
            c
        });
        last = c;
    }
    typeset
}

#[cfg(test)]
mod tests {
    use super::typeset;

    #[test]
    fn negative_numbers_have_minus_signs() {
        assert_eq!(typeset("12.5 (-3.1)", true), "12.5 (\u{2212}3.1)");
        assert_eq!(
            typeset("-1 to 2024-T351, - and -x", true),
            "\u{2212}1 to 2024-T351, - and -x"
        );
        assert_eq!(typeset("-1", false), "-1");
    }
}
