//! `percuss completions`: shell completions.

use clap::{Args, Command};
use clap_complete::{Shell, generate};

use crate::{failure::Failure, output};

const AFTER_HELP: &str = "\
Examples:
  percuss completions bash > ~/.local/share/bash-completion/completions/percuss
  percuss completions zsh > ~/.zfunc/_percuss
  percuss completions fish > ~/.config/fish/completions/percuss.fish

Exit codes: 0 ok, 2 bad input, 4 the output could not be written";

/// Print completions for a shell
///
/// Prints a script that lets a shell complete the commands and options.
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub struct Completions {
    /// Shell
    shell: Shell,
}

impl Completions {
    /// Prints the script for a program.
    pub fn run(&self, mut program: Command) -> Result<(), Failure> {
        let mut script = Vec::new();
        generate(self.shell, &mut program, "percuss", &mut script);
        output::print(&String::from_utf8_lossy(&script))
    }
}
