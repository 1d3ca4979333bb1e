//! Collection of the pages of the book; links between pages are their paths in the repository.

use std::{fs, io, path::Path};

use crate::formulae::with_mathml;

/// What readers of the guide are sent to, besides `docs/`.
const BESIDE: [&str; 9] = [
    "benches/peers",
    "validation",
    "cases",
    "crates/percuss-studies/data",
    "examples",
    "README.md",
    "ARCHITECTURE.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
];

/// Copies the pages into an empty folder and puts the table of contents at its root.
pub(crate) fn gather(root: &Path, to: &Path) -> io::Result<()> {
    if to.exists() {
        fs::remove_dir_all(to)?;
    }
    for place in BESIDE.into_iter().chain(["docs"]) {
        copy(&root.join(place), &to.join(place))?;
    }
    let contents = to.join("docs/SUMMARY.md");
    let text = fs::read_to_string(&contents)?;
    fs::remove_file(&contents)?;
    fs::write(to.join("SUMMARY.md"), with_index_pages(&from_root(&text)))
}

/// The first page of a folder is its `index.md`: that is what its links lead to in a book.
fn with_index_pages(page: &str) -> String {
    page.replace("README.md)", "index.md)")
        .replace("README.md#", "index.md#")
}

/// A table of contents whose links lead from the root of the repository, not from `docs/`.
fn from_root(contents: &str) -> String {
    contents
        .replace("](", "](docs/")
        .replace("](docs/)", "]()")
        .replace("](docs/../", "](")
}

fn copy(from: &Path, to: &Path) -> io::Result<()> {
    if from.is_file() {
        if let Some(folder) = to.parent() {
            fs::create_dir_all(folder)?;
        }
        if from.extension().is_none_or(|end| end != "md") {
            return fs::copy(from, to).map(|_| ());
        }
        let page = with_mathml(&fs::read_to_string(from)?)
            .map_err(|error| io::Error::other(format!("{}, {error}", from.display())))?;
        let page = with_index_pages(&page);
        let is_first = from.file_name().is_some_and(|name| name == "README.md");
        return match is_first {
            true => fs::write(to.with_file_name("index.md"), page),
            false => fs::write(to, page),
        };
    }
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        copy(&entry.path(), &to.join(entry.file_name()))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_of_the_contents_lead_from_the_root() {
        let contents = "- [A](a.md)\n- [B](../cases/b/README.md)\n- [C]()\n";
        let expected = "- [A](docs/a.md)\n- [B](cases/b/README.md)\n- [C]()\n";
        assert_eq!(from_root(contents), expected);
    }
}
