//! The files that a command has written, named at the end of what it prints.

use std::path::PathBuf;

use serde::Serialize;

use crate::{diagnostic, failure::Failure, output, terminal};

/// A list of files, a line each; empty where nothing was written.
pub struct Written(String);

impl Written {
    pub fn new(files: &[PathBuf]) -> Self {
        let line = |file: &PathBuf| format!("  {}\n", file.display());
        Self(files.iter().map(line).collect())
    }

    /// Adds why something is not among the files, if there are any.
    pub fn with_note(mut self, note: &str) -> Self {
        if !self.0.is_empty() {
            self.0 += &format!("  {note}\n");
        }
        self
    }

    /// Prints JSON; the files go to standard error, unless it shall be quiet.
    pub fn print_json(&self, value: &impl Serialize, quiet: bool) -> Result<(), Failure> {
        output::print_json(value)?;
        if !self.0.is_empty() && !quiet {
            diagnostic::print(&format!("wrote\n{}", self.0));
        }
        Ok(())
    }

    /// Prints a text and the files under it, after a blank line.
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
