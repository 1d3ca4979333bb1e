//! User guide as a book: pages of `docs/` and of the cases.
//!
//! `cargo run --manifest-path crates/percuss-book/Cargo.toml` builds it into `target/book`.

mod formulae;
mod gather;

use std::{
    error::Error,
    fs,
    path::{Path, PathBuf},
};

use mdbook_driver::{MDBook, config::Config};

/// The root of the repository that this crate stands in.
pub fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Builds the book of a repository into `out/html`; its pages are gathered in `out/pages` before. Gives the path of the first page.
///
/// # Errors
/// Those of the file system, and of a book that cannot be built.
pub fn build(root: &Path, out: &Path) -> Result<PathBuf, Box<dyn Error>> {
    let pages = out.join("pages");
    gather::gather(root, &pages)?;
    let mut config: Config = fs::read_to_string(root.join("docs/book.toml"))?.parse()?;
    config.book.src = PathBuf::from(".");
    config.build.build_dir = std::path::absolute(out)?.join("html");
    config.build.create_missing = false;
    MDBook::load_with_config(&pages, config)?.build()?;
    Ok(out.join("html/index.html"))
}
