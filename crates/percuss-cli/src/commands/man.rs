//! `percuss man`: manual pages.

use std::path::PathBuf;

use clap::{Args, Command, builder::Resettable};
use percuss_report::replace_file::replace_file;

use crate::{failure::Failure, output, run_folder::make_folder};

const AFTER_HELP: &str = "\
Examples:
  percuss man | man -l -
  percuss man --out ~/.local/share/man/man1

Exit codes: 0 ok, 2 bad input, 4 a file could not be written";

/// Print the manual page, or write all of them
///
/// Prints the manual page of the program. With --out the pages of the program
/// and of every command are written to a folder: percuss.1, percuss-run.1 and
/// so on.
#[derive(Debug, Args)]
#[command(verbatim_doc_comment, after_help = AFTER_HELP)]
pub struct Man {
    /// Write all pages to a folder, which is made if it does not exist
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl Man {
    /// Prints or writes the pages of a program.
    pub fn run(&self, mut program: Command) -> Result<(), Failure> {
        program.build();
        let Some(folder) = &self.out else {
            return output::print(&page(&program)?);
        };
        make_folder(folder)?;
        let mut written = String::from("wrote\n");
        for command in with_subcommands(&program) {
            let man = clap_mangen::Man::new(command.clone());
            let content = page(&command)?;
            let path = replace_file(folder, &man.get_filename(), content.as_bytes())?;
            written += &format!("  {}\n", path.display());
        }
        output::print(&written)
    }
}

fn page(command: &Command) -> Result<String, Failure> {
    let mut roff = Vec::new();
    let own = command.clone();
    let after = own.get_after_help().map(ToString::to_string);
    clap_mangen::Man::new(own.after_help(Resettable::Reset))
        .render(&mut roff)
        .map_err(Failure::Output)?;
    let page = String::from_utf8_lossy(&roff).into_owned();
    Ok(page + &sections(&after.unwrap_or_default()))
}

/// Sections of what stands after the options, one for each paragraph with a title. Lines below a title keep their form: they are commands.
fn sections(text: &str) -> String {
    let mut roff = String::new();
    for paragraph in text.split("\n\n").filter(|paragraph| !paragraph.is_empty()) {
        let (title, rest) = paragraph.split_once(':').unwrap_or(("Notes", paragraph));
        let (before, rest, after) = match rest.strip_prefix('\n') {
            Some(lines) => (".nf\n", lines, ".fi\n"),
            None => ("", rest.trim_start(), ""),
        };
        let lines: String = rest.lines().map(|line| escaped(line) + "\n").collect();
        roff += &format!(".SH {}\n{before}{lines}{after}", title.to_uppercase());
    }
    roff
}

/// A line as it is to be seen, with hyphens that can be copied.
fn escaped(line: &str) -> String {
    let text = line.replace('\\', "\\e").replace('-', "\\-");
    match text.starts_with(['.', '\'']) {
        true => format!("\\&{text}"),
        false => text,
    }
}

fn with_subcommands(command: &Command) -> Vec<Command> {
    let inner = command
        .get_subcommands()
        .filter(|inner| !inner.is_hide_set())
        .flat_map(with_subcommands);
    std::iter::once(command.clone()).chain(inner).collect()
}
