//! The shipped records.

mod laws;
mod records;
mod slips;

use super::*;
use crate::check::{Check, Finding};

fn built_in() -> impl Iterator<Item = &'static MaterialEntry> {
    Library::built_in().iter()
}

fn findings(material: &Material) -> Vec<Finding> {
    let mut findings = Vec::new();
    material.check(&mut Check::new(&mut findings));
    findings
}
