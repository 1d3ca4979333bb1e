//! The reference pages of `docs/reference/` are written from the schema, the help and the lists of the program.
//!
//! `REWRITE_REFERENCES=1 cargo test -p percuss-cli --test all reference::` writes them again.

mod case_file;
mod cases;
mod commands;
mod gallery;
mod results;

use std::{env, fs, path::Path};

#[test]
fn reference_pages_are_those_of_the_program() {
    for (place, text) in [
        ("docs/reference/case-file.md", case_file::page()),
        ("docs/reference/commands.md", commands::page()),
        ("docs/reference/results.md", results::page()),
        ("docs/reference/gallery.md", gallery::page()),
        ("docs/reference/cases.md", cases::page()),
    ] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../..")
            .join(place);
        if env::var_os("REWRITE_REFERENCES").is_some() {
            fs::write(&path, &text).unwrap();
        }
        let kept = fs::read_to_string(&path).unwrap_or_default();
        assert!(
            kept == text,
            "{place} is out of date; write it with `REWRITE_REFERENCES=1 cargo test -p percuss-cli --test all reference::`"
        );
    }
}
