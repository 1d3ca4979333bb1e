//! The commands in the docs are commands of the program, and their cases and sweeps are valid.

use std::{
    fs,
    path::{Path, PathBuf},
};

use percuss::{case, sweep::Sweep};
use toml::Table;

use crate::support::blocks;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Name and text of every page of `docs/` that a person has written.
fn pages() -> Vec<(String, String)> {
    let docs = root().join("docs");
    let mut pages = Vec::new();
    for folder in [docs.clone(), docs.join("models")] {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|extension| extension == "md") {
                let name = path.display().to_string();
                pages.push((name, fs::read_to_string(path).unwrap()));
            }
        }
    }
    pages
}

/// Words of a command line, quotes taken off.
fn words(line: &str) -> Vec<String> {
    let parts = line.split('"').enumerate();
    let mut words = Vec::new();
    for (index, part) in parts {
        if index % 2 == 1 {
            words.push(part.to_owned());
        } else {
            words.extend(part.split_whitespace().map(str::to_owned));
        }
    }
    words
}

#[test]
fn every_percuss_command_of_the_docs_is_one() {
    let mut count = 0;
    for (page, text) in pages() {
        let lines = blocks(&text, "sh").join("\n").replace("\\\n", " ");
        for line in lines.lines().filter(|line| line.starts_with("percuss ")) {
            let parsed = percuss_cli::command().try_get_matches_from(words(line));
            assert!(
                parsed.is_ok(),
                "{page}: {line}\n{}",
                parsed
                    .err()
                    .map(|error| error.to_string())
                    .unwrap_or_default()
            );
            count += 1;
        }
    }
    assert!(count >= 20, "{count}");
}

#[test]
fn every_case_and_sweep_of_the_docs_is_valid() {
    let (mut cases, mut sweeps) = (0, 0);
    for (page, text) in pages() {
        for block in blocks(&text, "toml") {
            let table: Table = block
                .parse()
                .unwrap_or_else(|error| panic!("{page}: {error}\n{block}"));
            if table.contains_key("projectile") {
                case::load_str(&page, &block).unwrap_or_else(|error| panic!("{error}"));
                cases += 1;
            } else if table.contains_key("base") {
                let folder = tempfile::tempdir().unwrap();
                let base = folder.path().join(table["base"].as_str().unwrap());
                fs::create_dir_all(base.parent().unwrap()).unwrap();
                fs::copy(root().join("cases/paper-table1/scenario.toml"), base).unwrap();
                let path = folder.path().join("sweep.toml");
                fs::write(&path, &block).unwrap();
                Sweep::load(&path).unwrap_or_else(|error| panic!("{page}: {error}"));
                sweeps += 1;
            }
        }
    }
    assert!(cases >= 2 && sweeps >= 2, "{cases} cases, {sweeps} sweeps");
}
