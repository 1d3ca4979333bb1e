//! Builds the user guide.

use std::{env, error::Error, path::PathBuf};

const USAGE: &str = "usage: cargo run -p percuss-book [-- DIR]\n\n\
    Brings docs/reference/ up to date and builds the user guide into DIR, or into\ntarget/book when none is given.";

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
    percuss_book::write_references(&root)?;
    let first = percuss_book::build(&root, &out)?;
    println!("{}", first.display());
    Ok(())
}
