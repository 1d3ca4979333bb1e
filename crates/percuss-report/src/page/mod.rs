//! A page that can be written as HTML and as Markdown.

pub(crate) mod html;
pub(crate) mod markdown;

use crate::Figure;

/// A part of a page. Texts are plain: the writers escape them.
pub(crate) enum Block<'a> {
    Title(String),
    Heading(String),
    Subheading(String),
    Text(String),
    List(Vec<String>),
    /// Addresses and what is said of them.
    Links(Vec<(String, String)>),
    Table(Table),
    Figure(&'a Figure),
    /// Parts that are shown when asked for.
    Folded(String, Vec<Block<'a>>),
    /// Parts that are too long for Markdown.
    WebOnly(Vec<Block<'a>>),
}

/// A table.
#[derive(Default)]
pub(crate) struct Table {
    /// Headings; one that begins with `#` stands over numbers, which are set flush right.
    pub(crate) head: Vec<String>,
    pub(crate) rows: Vec<Vec<String>>,
}

impl Table {
    pub(crate) fn new(head: &[&str]) -> Self {
        Self {
            head: head.iter().map(|&name| name.to_owned()).collect(),
            rows: Vec::new(),
        }
    }

    /// Headings with whether numbers stand below.
    pub(crate) fn columns(&self) -> impl Iterator<Item = (&str, bool)> {
        self.head.iter().map(|name| {
            name.strip_prefix('#')
                .map_or((name.as_str(), false), |name| (name, true))
        })
    }
}
