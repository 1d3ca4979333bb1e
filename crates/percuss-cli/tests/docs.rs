//! The commands in the docs are commands of the program, and their cases and sweeps are valid.

use std::{
    fs,
    path::{Path, PathBuf},
};

use clap::{Arg, Command};
use percuss::{case, sweep::Sweep};
use toml::Table;

use crate::support::blocks;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Name and text of every page that a reader of the guide can come to.
fn pages() -> Vec<(String, String)> {
    let root = root();
    let mut pages = Vec::new();
    for folder in [
        "docs",
        "cases",
        "crates/percuss-studies/data",
        "examples",
        "benches/peers",
        "validation",
    ] {
        add_pages(&root.join(folder), &mut pages);
    }
    for name in ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md"] {
        let path = root.join(name);
        pages.push((name.to_owned(), fs::read_to_string(path).unwrap()));
    }
    pages
}

fn add_pages(folder: &Path, pages: &mut Vec<(String, String)>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            add_pages(&path, pages);
        } else if path.extension().is_some_and(|extension| extension == "md") {
            let name = path.display().to_string();
            pages.push((name, fs::read_to_string(path).unwrap()));
        }
    }
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

/// A reader who types the commands of a page keeps a clean clone.
#[test]
fn what_the_commands_of_the_docs_write_is_ignored() {
    let ignored = fs::read_to_string(root().join(".gitignore")).unwrap();
    let is_ignored = |place: &str| {
        ignored.lines().any(|line| {
            let pattern = line.trim_start_matches('/');
            match pattern.strip_suffix('*') {
                Some(start) => place.starts_with(start),
                None => pattern == place || place.starts_with(&format!("{pattern}/")),
            }
        })
    };
    let mut count = 0;
    for (page, text) in pages() {
        let lines = blocks(&text, "sh").join("\n").replace("\\\n", " ");
        for line in lines.lines().filter(|line| line.starts_with("percuss ")) {
            let words = words(line);
            let mut outs = words.iter().zip(&words[1..]);
            let out = outs.find(|(word, _)| ["--out", "new"].contains(&word.as_str()));
            let Some((_, place)) = out else { continue };
            if place.starts_with(['/', '~']) || place.starts_with("OUT") {
                continue;
            }
            assert!(is_ignored(place), "{page}: `{place}` is not in .gitignore");
            count += 1;
        }
    }
    assert!(count >= 15, "{count}");
}

/// Code within the text of a page.
fn code_spans(text: &str) -> Vec<String> {
    let mut is_code = false;
    let prose: Vec<&str> = text
        .lines()
        .map(|line| {
            let is_fence = line.trim_start().starts_with("```");
            is_code ^= is_fence;
            if is_code || is_fence { "" } else { line }
        })
        .collect();
    let prose = prose.join("\n");
    prose
        .split("\n\n")
        .flat_map(|paragraph| paragraph.split('`').skip(1).step_by(2))
        .map(str::to_owned)
        .collect()
}

/// Options in a piece of code that its command of the program does not have; none where the code is no command of it.
fn unknown_options(program: &Command, code: &str) -> Vec<String> {
    let mut words = code.split_whitespace().peekable();
    words.next_if_eq(&"percuss");
    let mut command = program;
    let mut is_command = false;
    while let Some(inner) = words.peek().and_then(|word| command.find_subcommand(word)) {
        command = inner;
        is_command = true;
        words.next();
    }
    if !is_command {
        return Vec::new();
    }
    let options: Vec<&str> = command.get_arguments().filter_map(Arg::get_long).collect();
    words
        .filter_map(|word| word.strip_prefix("--"))
        .filter(|name| !name.is_empty())
        .map(|word| word.trim_end_matches(|c: char| !c.is_alphanumeric()))
        .filter(|name| !options.contains(&name.split('=').next().unwrap_or(name)))
        .map(str::to_owned)
        .collect()
}

#[test]
fn every_option_in_the_text_of_a_page_is_one_of_its_command() {
    let mut program = percuss_cli::command();
    program.build();
    assert_eq!(unknown_options(&program, "limit --data"), ["data"]);
    assert_eq!(
        unknown_options(&program, "sweep plot rows --x a --y=b"),
        [""; 0]
    );
    let mut count = 0;
    for (page, text) in pages() {
        for code in code_spans(&text) {
            let unknown = unknown_options(&program, &code);
            assert!(unknown.is_empty(), "{page}: `{code}` has no {unknown:?}");
            count += usize::from(code.contains(" --"));
        }
    }
    assert!(count >= 40, "{count}");
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
    // A page names this one by its file.
    let speed = root().join("docs/images/inputs/speed.toml");
    Sweep::load(&speed).unwrap_or_else(|error| panic!("{error}"));
    sweeps += 1;
    assert!(cases >= 2 && sweeps >= 2, "{cases} cases, {sweeps} sweeps");
}

/// Numbers of a row of a table of a page.
fn cells(row: &str) -> Vec<f64> {
    row.split('|')
        .filter_map(|cell| cell.trim().parse().ok())
        .collect()
}

#[test]
fn the_reference_depth_of_the_papers_case_is_one_number() {
    let (section, link) = ("### The paper's case", "axi.md#the-papers-case");
    let axi = fs::read_to_string(root().join("docs/models/axi.md")).unwrap();
    let (table, text) = axi.split_once(section).unwrap();
    let stated = text.split("**").nth(1).unwrap();
    let (depth, uncertainty) = stated.trim_end_matches(" mm").split_once(" ± ").unwrap();
    let number = |text: &str| text.parse::<f64>().unwrap();
    // What it is the mean of: the depths at 230 m/s on 12 to 24 cells.
    let fine: Vec<f64> = table
        .lines()
        .map(cells)
        .filter(|cells| cells.len() > 4 && cells[0] >= 12.0)
        .map(|cells| cells[1])
        .collect();
    assert_eq!(fine.len(), 5, "{fine:?}");
    let mean = fine.iter().sum::<f64>() / fine.len() as f64;
    assert!((mean - number(depth)).abs() < 6e-4, "{mean} and {stated}");
    // Depths of the table are rounded to 0.001 mm.
    let spread = fine.iter().map(|depth| (depth - mean).abs());
    assert!(spread.fold(0.0, f64::max) <= number(uncertainty) + 5e-4);

    // The report that the program writes has it from its own data.
    let report = fs::read_to_string(root().join("docs/reference/benchmark/benchmark.md")).unwrap();
    assert!(report.contains(&format!("{stated} at 230 m/s")), "{stated}");
    let fast = text.split("**").nth(3).unwrap();
    assert!(report.contains(&format!("{fast} at 600 m/s")), "{fast}");

    let mut links = 0;
    for (page, text) in pages() {
        links += text.matches(&format!("{link})")).count();
        let names_it = text.contains(link);
        assert!(
            !names_it || text.contains(&format!("[{depth}")),
            "{page} lacks {depth}"
        );
        for other in ["0.234 mm", "0.23 ± 0.02", "2.16 ± 0.04"] {
            assert!(
                page.ends_with("models/axi.md") || !text.contains(other),
                "{page} has {other}"
            );
        }
    }
    assert!(links >= 4, "{links}");

    for case in [
        "paper-table1",
        "paper-table1-uncertainty",
        "paper-table1-constants",
    ] {
        let file = root().join("cases").join(case).join("expected.toml");
        let file: Table = fs::read_to_string(file).unwrap().parse().unwrap();
        let entries = file["expected"].as_array().unwrap();
        let entry = entries
            .iter()
            .find(|entry| entry["quantity"].as_str() == Some("depth_of_penetration_mm"));
        let independent = &entry.unwrap()["independent"];
        assert_eq!(
            independent["value"].as_float(),
            Some(number(depth)),
            "{case}"
        );
        let fraction = independent["uncertainty"].as_float().unwrap();
        assert!((fraction * number(depth) - number(uncertainty)).abs() < 1e-3);
    }
}

/// An error on the shipped tests is not shown without that on tests of other sources.
#[test]
fn errors_on_held_out_tests_stand_beside_those_on_shipped_ones() {
    for page in ["README.md", "docs/validation.md"] {
        let text = fs::read_to_string(root().join(page)).unwrap();
        for error in ["4.2 %", "7.3 %", "33 %"] {
            assert!(text.contains(error), "{page} lacks {error}");
        }
    }
}
