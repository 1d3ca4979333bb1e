//! Published tests of the program and of files.

use std::path::{Path, PathBuf};

use percuss::{
    experiments::{self, Experiment, TestFile},
    material::Library,
};

use crate::{diagnostic, failure::Failure};

/// Value that selects the tests of the program.
pub const BUILT_IN: &str = "builtin";

/// Says which columns of a file are read by other names or units, and which nothing reads.
pub fn note_columns<T>(path: &Path, file: &TestFile<T>) {
    if !file.read_as.is_empty() {
        let read_as = file.read_as.join("; ");
        let text = format!("note: columns of `{}`: {read_as}\n", path.display());
        diagnostic::print(&text);
    }
    let columns = &file.unread_columns;
    if !columns.is_empty() {
        let what = match columns.len() {
            1 => "the column",
            _ => "the columns",
        };
        let names: Vec<String> = columns.iter().map(|name| format!("`{name}`")).collect();
        let text = format!(
            "note: {what} {} of `{}` {} not read\n",
            names.join(", "),
            path.display(),
            if columns.len() == 1 { "is" } else { "are" }
        );
        diagnostic::print(&text);
    }
}

/// Tests of these files and kinds, with their sources; an empty list of kinds selects all.
pub fn read(
    data: &[PathBuf],
    kinds: &[String],
    library: &Library,
) -> Result<(Vec<Experiment>, Vec<String>), Failure> {
    let (mut tests, mut files): (Vec<Experiment>, Vec<String>) = (Vec::new(), Vec::new());
    for path in data {
        let (more, name) = if path.as_path() == Path::new(BUILT_IN) {
            let own = format!("tests of the program ({})", experiments::built_in().len());
            (experiments::built_in().to_vec(), own)
        } else {
            let read = experiments::read(path, library)?;
            note_columns(path, &read);
            let name = format!("{} ({})", path.display(), read.tests.len());
            (read.tests, name)
        };
        if let Some(twice) = more
            .iter()
            .find(|test| tests.iter().any(|s| s.id == test.id))
        {
            return Err(Failure::Usage {
                message: format!("two files of --data have a test with the id `{}`", twice.id),
                help: "ids are unique over all files; rename it, or give only one of the files"
                    .to_owned(),
            });
        }
        tests.extend(more);
        files.push(name);
    }
    if !kinds.is_empty() {
        tests.retain(|test| kinds.iter().any(|kind| kind == test.kind.name()));
    }
    if tests.is_empty() && !data.is_empty() {
        return Err(Failure::Usage {
            message: format!("the data have no test of kind {}", kinds.join(" or ")),
            help: "leave out --kind, or add `--data builtin`".to_owned(),
        });
    }
    Ok((tests, files))
}
