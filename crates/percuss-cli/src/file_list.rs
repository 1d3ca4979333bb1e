//! List of the files that a command has written, at the end of its output.

use std::path::PathBuf;

use serde::Serialize;

use crate::{diagnostic, failure::Failure, output, terminal};

/// List of files, one line per file; empty where nothing was written.
pub struct FileList(String);

impl FileList {
    pub fn new(files: &[PathBuf]) -> Self {
        let line = |file: &PathBuf| format!("  {}\n", file.display());
        Self(files.iter().map(line).collect())
    }

    /// Adds a note about a missing file, if the list is not empty.
    pub fn with_note(mut self, note: &str) -> Self {
        if !self.0.is_empty() {
            self.0 += &format!("  {note}\n");
        }
        self
    }

    /// Prints JSON; the list goes to standard error unless `quiet` is true.
    pub fn print_json(&self, value: &impl Serialize, quiet: bool) -> Result<(), Failure> {
        output::print_json(value)?;
        if !self.0.is_empty() && !quiet {
            diagnostic::print(&format!("wrote\n{}", self.0));
        }
        Ok(())
    }

    /// Prints a text and the list, separated by a blank line.
    pub fn print_under(&self, mut text: String) -> Result<(), Failure> {
        if !self.0.is_empty() {
            if !text.is_empty() && !text.ends_with("\n\n") {
                text += "\n";
            }
            text += &format!("{}\n{}", terminal::bold("wrote"), self.0);
        }
        output::print(&text)
    }
}
