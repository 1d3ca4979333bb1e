//! Lists the files that become part of the program: those of the page and the ready cases.

use std::{
    env, fs, io,
    path::{Path, PathBuf},
};

/// Files of the page, as `npm run build` writes them.
const PAGE: &str = "web/dist";
/// The project's cases, one folder each.
const CASES: &str = "../../cases";

fn main() -> io::Result<()> {
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    for folder in ["build.rs", PAGE, CASES] {
        println!("cargo::rerun-if-changed={folder}");
    }
    let page = names(&root.join(PAGE))?
        .into_iter()
        .map(|name| (root.join(PAGE).join(&name), name));
    fs::write(out.join("page.rs"), list("include_bytes", page))?;
    let cases = names(&root.join(CASES))?
        .into_iter()
        .map(|name| (root.join(CASES).join(&name).join("scenario.toml"), name));
    let cases = cases.filter(|(path, _)| path.is_file());
    fs::write(out.join("cases.rs"), list("include_str", cases))
}

/// Names of what is in a folder, in order.
fn names(folder: &Path) -> io::Result<Vec<String>> {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder)? {
        names.push(entry?.file_name().to_string_lossy().into_owned());
    }
    names.sort();
    Ok(names)
}

/// A slice of names and contents, as an expression.
fn list(include: &str, files: impl Iterator<Item = (PathBuf, String)>) -> String {
    let lines = files.map(|(path, name)| format!("({name:?}, {include}!({path:?})),"));
    format!("&[{}]", lines.collect::<String>())
}
