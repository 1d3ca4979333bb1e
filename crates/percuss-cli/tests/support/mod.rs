//! Running the program and looking at what it says.

mod inputs;
pub mod module_graph;
pub mod module_source;
pub mod rust_tokens;
pub mod sweeps;

use std::{
    ffi::OsStr,
    fs,
    path::Path,
    process::{Child, Command, Stdio},
    time::Duration,
};

use serde_json::Value;
use tempfile::TempDir;

pub use inputs::{CASE, Draw, status};

/// Folder of these tests.
pub const TESTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests");

/// A folder that holds files of these names and texts.
pub fn folder_with(files: &[(&str, &str)]) -> TempDir {
    let folder = TempDir::new().unwrap();
    for (name, text) in files {
        fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

/// A folder with a case `shot.toml`.
pub fn shot(case: &str) -> TempDir {
    folder_with(&[("shot.toml", case)])
}

/// What a run of the program left.
pub struct Said {
    asked: String,
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

impl Said {
    /// What a command says that must succeed without a word on standard error.
    #[track_caller]
    pub fn ok(self) -> String {
        let Self {
            asked,
            code,
            stdout,
            stderr,
        } = self;
        assert_eq!((code, stderr.as_str()), (0, ""), "{asked}");
        stdout
    }
}

/// Checks a report `STEM.html` and `STEM.md` in a folder with tables of these names in Parquet; returns both texts.
#[track_caller]
pub fn whole_report(folder: &Path, stem: &str, parts: &[&str], tables: &[&str]) -> [String; 2] {
    let texts = ["html", "md"].map(|ending| {
        let path = folder.join(format!("{stem}.{ending}"));
        fs::read_to_string(path).unwrap()
    });
    let [html, markdown] = &texts;
    for part in ["<!doctype html>"].iter().chain(parts) {
        assert!(html.contains(part), "{part}");
    }
    assert!(
        !html.contains("<script") && !html.contains("src="),
        "not self-contained"
    );
    let pictures = markdown.lines().filter(|line| line.starts_with("!["));
    for line in pictures {
        let name = line.split(['(', ')']).rev().nth(1).unwrap();
        assert!(folder.join(name).is_file(), "{name}");
    }
    for name in tables {
        let bytes = fs::read(folder.join(name)).unwrap();
        let whole = bytes.starts_with(b"PAR1") && bytes.ends_with(b"PAR1");
        assert!(whole, "{name}");
    }
    texts
}

/// Runs the program in a folder.
pub fn percuss<I: AsRef<OsStr>>(folder: &Path, arguments: impl IntoIterator<Item = I>) -> Said {
    let mut command = assert_cmd::Command::cargo_bin("percuss").expect("the program is built");
    command
        .args(arguments)
        .current_dir(folder)
        .env_remove("NO_COLOR")
        .env_remove("COLUMNS")
        .timeout(Duration::from_secs(120));
    let output = command.output().expect("the program starts");
    let text = |bytes| String::from_utf8(bytes).expect("output is UTF-8");
    let said = Said {
        asked: format!("{command:?}"),
        code: output.status.code().expect("the program ends by itself"),
        stdout: text(output.stdout),
        stderr: text(output.stderr),
    };
    for text in [&said.stdout, &said.stderr] {
        assert!(
            !text.contains('\u{1b}'),
            "escape codes without a terminal: {text}"
        );
        assert!(!text.contains("panicked"), "{text}");
    }
    said
}

/// What a command says that must succeed without a word on standard error.
#[track_caller]
pub fn ok(folder: &Path, arguments: &[&str]) -> String {
    percuss(folder, arguments).ok()
}

/// A text without its line breaks.
pub fn flat(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[track_caller]
pub fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

/// Starts the program in a folder and goes on.
pub fn spawn(folder: &Path, arguments: &[&str]) -> Child {
    Command::new(assert_cmd::cargo::cargo_bin!("percuss"))
        .args(arguments)
        .current_dir(folder)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// Memory of a process [bytes]: now, and the most so far.
#[cfg(target_os = "linux")]
pub fn memory_of(process: u32) -> [u64; 2] {
    let status = fs::read_to_string(format!("/proc/{process}/status")).unwrap();
    ["VmRSS:", "VmHWM:"].map(|name| {
        let line = status.lines().find_map(|line| line.strip_prefix(name));
        let kib = line.and_then(|line| line.split_whitespace().next());
        // A process that has ended has none.
        kib.map_or(0, |kib| kib.parse::<u64>().unwrap() * 1024)
    })
}

/// Presses Ctrl-C and returns what the program says then.
#[cfg(unix)]
pub fn interrupt(child: Child) -> String {
    let id = child.id().to_string();
    let sent = Command::new("kill").args(["-INT", &id]).status().unwrap();
    assert!(sent.success());
    let output = child.wait_with_output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(130), "{said}");
    said
}

/// The wrong file whose fault is in another one, which cannot be read.
const OF_UNREADABLE_FILE: &str = "base-missing.toml";

/// Every file of a folder of wrong ones is refused with its place, in the approved words.
pub fn refuses_all_of(folder: &str, at_least: usize, command: impl Fn(&Path, &str) -> Said) {
    let bad = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests")
        .join(folder);
    let names = names_in(&bad);
    assert!(names.len() >= at_least, "{}", names.len());
    for name in names {
        let said = command(&bad, &name);
        let code = if name == OF_UNREADABLE_FILE { 4 } else { 2 };
        assert_eq!(said.code, code, "{name}: {}", said.stderr);
        assert!(
            said.stderr.contains(&format!("--> {name}")),
            "{name}: {}",
            said.stderr
        );
        insta::with_settings!({
            snapshot_path => format!("../snapshots/{folder}"),
            prepend_module_to_snapshot => false,
            omit_expression => true,
        }, {
            insta::assert_snapshot!(name.trim_end_matches(".toml"), said.stderr);
        });
    }
}

/// Names of what a folder holds, in order.
pub fn names_in(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// All blocks of a language in a page.
pub fn blocks(page: &str, language: &str) -> Vec<String> {
    let fence = format!("```{language}\n");
    let parts = page.split(&fence).skip(1);
    parts
        .map(|part| part.split("```").next().unwrap_or_default().to_owned())
        .collect()
}
