//! The shipped records.

mod laws;
mod records;
mod unit_errors;

use super::*;
use crate::check::{Check, Diagnostic};

fn built_in() -> impl Iterator<Item = &'static MaterialEntry> {
    Library::built_in().iter()
}

fn diagnostics(material: &Material) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    material.check(&mut Check::new(&mut diagnostics));
    diagnostics
}
