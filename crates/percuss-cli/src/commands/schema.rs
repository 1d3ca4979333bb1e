//! `percuss schema`: JSON Schema of case files.

use clap::Args;
use percuss::case;

use crate::{failure::Failure, output, response::Response};

const LONG_ABOUT: &str = "\
Print the JSON Schema (draft 2020-12) of case files: every key with its
description, the allowed units and the allowed values.

Editors check and complete case files with it. Editors that use Taplo, such as
Visual Studio Code with Even Better TOML, read it from the first line of a file:
  #:schema percuss.schema.json
where the path is relative to the file.";

const AFTER_HELP: &str = "\
Examples:
  percuss schema > percuss.schema.json

Exit codes: 0 ok, 2 bad input, 4 the output could not be written";

/// Print the JSON Schema of case files
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Schema {}

impl Schema {
    pub fn run(&self) -> Result<(), Failure> {
        output::print_json(&case::schema())
    }

    /// Output of the command.
    pub fn execute(&self) -> Result<Response, Failure> {
        Response::json_of(&case::schema(), Vec::new())
    }
}
