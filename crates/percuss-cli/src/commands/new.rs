//! `percuss new`: a starter case.

use std::{
    fs::{self, OpenOptions},
    io::{self, Write},
    path::{Path, PathBuf},
};

use clap::{Args, ValueEnum};

use crate::{failure::Failure, output, response::Response, run_folder::make_folder};

/// Case that the command writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Template {
    /// Every option of a case file, at its default or with an example
    Starter,
    /// A glass plate that cracks, for the model `particles`
    BrittlePlate,
}

impl Template {
    /// Text of the case.
    const fn text(self) -> &'static str {
        match self {
            Self::Starter => include_str!("new/starter.toml"),
            Self::BrittlePlate => include_str!("new/brittle-plate.toml"),
        }
    }

    /// Options of `percuss run` that the case needs.
    const fn options(self) -> &'static str {
        match self {
            Self::Starter => "",
            Self::BrittlePlate => " --model particles",
        }
    }
}

const AFTER_HELP: &str = "\
Examples:
  percuss new my-case
  percuss new cases/my-case
  percuss new my-case --force
  percuss new my-plate --template brittle-plate

Exit codes: 0 ok, 2 bad input, 4 the file could not be written";

/// Write a starter case
///
/// Writes NAME/scenario.toml: a valid case, with every option of a case file
/// explained and commented out, at its default or with an example. The template
/// `brittle-plate` is a short case of a glass plate that cracks, for the model
/// `particles`. An existing file is not overwritten without --force.
#[derive(Debug, Args)]
#[command(verbatim_doc_comment, after_help = AFTER_HELP)]
pub struct New {
    /// Folder of the case, made if it does not exist; its name is that of the case
    name: PathBuf,
    /// Case to write
    #[arg(long, value_enum, value_name = "NAME", default_value_t = Template::Starter)]
    template: Template,
    /// Overwrite an existing case
    #[arg(long)]
    force: bool,
}

impl New {
    pub fn run(&self) -> Result<(), Failure> {
        let mut shown = self.put()?.display().to_string();
        if shown.starts_with('-') {
            // Otherwise `percuss run` reads it as an option.
            shown.insert_str(0, "./");
        }
        output::print(&format!(
            "wrote {shown}\nnext: percuss run {}{}\n",
            quoted(&shown),
            self.template.options()
        ))
    }

    /// Case file that the command writes.
    pub fn execute(&self) -> Result<Response, Failure> {
        let path = self.put()?;
        Response::json_of(&path, vec![path.clone()])
    }

    /// Writes the case; returns its file.
    fn put(&self) -> Result<PathBuf, Failure> {
        if self.name.as_os_str().is_empty() {
            return Err(Failure::Usage {
                message: "the name of the case is empty".to_owned(),
                help: "for example: percuss new my-case".to_owned(),
            });
        }
        make_folder(&self.name)?;
        let path = self.name.join("scenario.toml");
        self.write(&path).map_err(|error| Failure::Write {
            path: path.clone(),
            reason: match error.kind() {
                io::ErrorKind::AlreadyExists => "it exists already".to_owned(),
                _ => error.to_string(),
            },
            help: match error.kind() {
                io::ErrorKind::AlreadyExists => "take another name, or overwrite it with --force",
                _ => "",
            }
            .to_owned(),
        })?;
        Ok(path)
    }

    fn write(&self, path: &Path) -> io::Result<()> {
        let mut options = OpenOptions::new();
        options.write(true);
        if self.force {
            options.create(true).truncate(true);
        } else {
            options.create_new(true);
        }
        let text = self.template.text();
        let written = options.open(path)?.write_all(text.as_bytes());
        if written.is_err() && !self.force {
            // Half a case would stand in the way of the next attempt.
            let _ = fs::remove_file(path);
        }
        written
    }
}

/// A path as a shell takes it.
fn quoted(path: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "/._-+,:@%=~".contains(c);
    if path.chars().all(plain) && !path.starts_with('~') {
        path.to_owned()
    } else {
        format!("'{}'", path.replace('\'', r"'\''"))
    }
}
