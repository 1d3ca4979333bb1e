//! The field's terms are used in documentation, code and messages: no tracked text has a retired word.

use std::{
    path::{Path, PathBuf},
    process::Command,
};

/// The history of changes has the words of its time.
const EXEMPT: &[&str] = &["CHANGELOG.md"];

/// Retired words, each with the term of the field: `word: term` in a line.
const RETIRED: &str = include_str!("vocabulary.txt");

fn retired() -> Vec<(&'static str, &'static str)> {
    RETIRED
        .lines()
        .filter_map(|line| line.split_once(": "))
        .collect()
}

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
    assert!(has("A Closure, closed.", "closure"));
    assert!(has("two closures", "closures") && !has("two closures", "closure"));
    assert!(!has("enclosure", "closure"));
}

#[test]
fn no_text_has_a_retired_word() {
    let covered = |file: &&String| !EXEMPT.contains(&file.as_str());
    let words = retired();
    assert!(words.len() > 40, "{} words", words.len());
    let files = tracked();
    let mut found = Vec::new();
    let mut count = 0;
    for file in files.iter().filter(covered) {
        let Ok(text) = std::fs::read_to_string(root().join(file)) else {
            continue;
        };
        count += 1;
        for (number, line) in text.lines().enumerate() {
            let retired = words.iter().filter(|(word, _)| has(line, word));
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
