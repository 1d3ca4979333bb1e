//! The field's terms are used in documentation, code and messages: no tracked text has a retired word.

use std::{
    path::{Path, PathBuf},
    process::Command,
};

/// Files that may have retired words: this one, and the history of changes.
const EXEMPT: &[&str] = &["CHANGELOG.md", "crates/percuss-cli/tests/vocabulary.rs"];

/// Retired words, each with the term of the field.
const RETIRED: &[(&str, &str)] = &[
    ("the books", "the energy and momentum balance"),
    ("books that", "balances that"),
    ("books close", "balances close"),
    ("balanced books", "closed energy balance"),
    ("both books", "energy and momentum balance"),
    ("books and steps", "balances and time steps"),
    ("anew", "again"),
    ("a slip", "an input error"),
    ("told by", "termination criterion"),
    ("judgement", "benchmark"),
    ("percuss judge", "percuss benchmark"),
    ("eight tenths", "10th-90th percentile"),
    ("eight of ten", "10th-90th percentile"),
    ("nine in ten", "90th percentile"),
    ("median magnitude", "median absolute error"),
    ("lets go a plug", "a plug is ejected"),
    ("row a shot", "row per run"),
    ("row a model", "row per model"),
    ("row a speed", "row per velocity"),
    ("line a model", "line per model"),
    ("entry a model", "entry per model"),
    ("entry a speed", "entry per velocity"),
    ("has no say", "is independent of"),
    ("held back", "fixed"),
    ("what strikes what", "projectile and target"),
    ("that can tell", "applicable"),
    ("while you drag", "while a slider moves"),
    ("chance of perforation", "probability of perforation"),
    ("chances of perforation", "probability of perforation"),
    ("chance of going through", "probability of perforation"),
    ("gone through", "complete penetration"),
    ("run ended because", "termination"),
    ("its expected error", "estimated model error"),
    ("what moves the", "sensitivity"),
    ("part of the variance", "fraction of the variance"),
    ("over the length before", "final length / initial length"),
    ("measured, less 1", "measured - 1"),
    ("another number\"", "add parameter"),
    ("drawn at random", "seed of the random numbers"),
    ("impact speed [m/s]", "Impact velocity (m/s)"),
    ("all at their medians", "at median inputs"),
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Tracked texts, as paths from the root.
fn tracked() -> Vec<String> {
    let output = Command::new("git")
        .args(["ls-files", "*.md", "*.rs", "*.ts", "*.py", "*.html"])
        .current_dir(root())
        .output()
        .unwrap();
    assert!(output.status.success(), "git ls-files fails");
    let list = String::from_utf8(output.stdout).unwrap();
    list.lines().map(str::to_owned).collect()
}

/// Whether a word is in a line as a whole word, in capitals or not.
fn has(line: &str, word: &str) -> bool {
    let line = line.to_lowercase();
    let is_letter = |c: Option<char>| c.is_some_and(char::is_alphanumeric);
    line.match_indices(word).any(|(at, found)| {
        let starts =
            !found.starts_with(char::is_alphanumeric) || !is_letter(line[..at].chars().next_back());
        let ends = !found.ends_with(char::is_alphanumeric)
            || !is_letter(line[at + found.len()..].chars().next());
        starts && ends
    })
}

#[test]
fn whole_words_are_found() {
    assert!(has("The books balance.", "the books"));
    assert!(has("computed anew", "anew") && !has("a renewal, nanew", "anew"));
    assert!(!has("the bookshelf", "the books"));
}

#[test]
fn no_text_has_a_retired_word() {
    let covered = |file: &&String| !EXEMPT.contains(&file.as_str());
    let files = tracked();
    let mut found = Vec::new();
    let mut count = 0;
    for file in files.iter().filter(covered) {
        let Ok(text) = std::fs::read_to_string(root().join(file)) else {
            continue;
        };
        count += 1;
        for (number, line) in text.lines().enumerate() {
            let retired = RETIRED.iter().filter(|(word, _)| has(line, word));
            found.extend(
                retired.map(|(word, term)| {
                    format!("{file}:{}: `{word}`: write \"{term}\"", number + 1)
                }),
            );
        }
    }
    assert!(count > 200, "{count} files are checked");
    assert!(
        found.is_empty(),
        "{} lines:\n{}",
        found.len(),
        found.join("\n")
    );
}
