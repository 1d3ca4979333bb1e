//! Builds the user guide.

use std::{env, error::Error, path::PathBuf};

const USAGE: &str = "usage: cargo run --manifest-path crates/percuss-book/Cargo.toml [-- DIR]\n\n\
    Builds the user guide into DIR, or into target/book when none is given.";

fn main() -> Result<(), Box<dyn Error>> {
    let root = percuss_book::repository();
    let arguments: Vec<PathBuf> = env::args_os().skip(1).map(PathBuf::from).collect();
    let out = match arguments.as_slice() {
        [] => root.join("target/book"),
        [out] if !out.to_string_lossy().starts_with('-') => out.clone(),
        _ => {
            println!("{USAGE}");
            return Ok(());
        }
    };
    let first = percuss_book::build(&root, &out)?;
    println!("{}", first.display());
    Ok(())
}
