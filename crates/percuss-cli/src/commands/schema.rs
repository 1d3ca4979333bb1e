use clap::Args;
use percuss::case;

use crate::{answer::Answer, failure::Failure, output};

const LONG_ABOUT: &str = "\
Print the JSON Schema (draft 2020-12) of case files: every key with what it
means, the units allowed and the values allowed.

Editors check and complete case files with it. Those that use Taplo, such as
Visual Studio Code with Even Better TOML, take it from the first line of a file:
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

    /// What the command prints.
    pub fn answer(&self) -> Result<Answer, Failure> {
        Answer::json_of(&case::schema(), Vec::new())
    }
}
