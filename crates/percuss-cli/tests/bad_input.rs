//! Wrong case files: every one is refused with a message that says what is wrong, where, and what to do.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use crate::support::{Said, percuss};
use tempfile::TempDir;

fn bad_cases() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad-cases")
}

fn run(folder: &Path, case: &str) -> Said {
    percuss(folder, ["run", case])
}

/// Asserts that a case is refused, and returns the message.
fn refused(folder: &Path, case: &str, code: i32) -> String {
    let said = run(folder, case);
    assert_eq!(said.code, code, "{case}: {}", said.stderr);
    assert_eq!(said.stdout, "", "{case}");
    assert!(
        said.stderr.starts_with("error: "),
        "{case}: {}",
        said.stderr
    );
    assert!(said.stderr.len() < 2000, "{case}: {}", said.stderr);
    said.stderr
}

/// Writes a file of these bytes and asserts that it is refused.
fn refused_bytes(bytes: &[u8], code: i32) -> String {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("case.toml"), bytes).unwrap();
    refused(folder.path(), "case.toml", code)
}

/// Cases that are wrong as a whole: there is no line to name.
const WITHOUT_A_LINE: &[&str] = &[
    "no-model-applies",
    "only-a-comment",
    "projectile-missing",
    "target-missing",
];

/// Cases that name a file that cannot be read.
const OF_UNREADABLE_FILES: &[&str] = &["material-file-is-a-folder", "material-file-missing"];

#[test]
fn every_bad_case_is_refused_with_its_place() {
    let mut cases: Vec<String> = fs::read_dir(bad_cases())
        .unwrap()
        .filter_map(|entry| entry.unwrap().file_name().into_string().ok())
        .filter(|name| name.ends_with(".toml"))
        .collect();
    cases.sort();
    assert!(cases.len() >= 100, "{}", cases.len());
    for case in cases {
        let name = case.trim_end_matches(".toml");
        let code = if OF_UNREADABLE_FILES.contains(&name) {
            4
        } else {
            2
        };
        let message = refused(&bad_cases(), &case, code);
        if !WITHOUT_A_LINE.contains(&name) {
            let file = if name.starts_with("material-file-with") || name.ends_with("-twice") {
                ".toml"
            } else {
                &case
            };
            let place = message.lines().find(|line| line.contains("--> "));
            let place = place.unwrap_or_else(|| panic!("{case} names no place: {message}"));
            let numbers: Vec<&str> = place.rsplit(':').take(2).collect();
            assert!(
                place.contains(file) && numbers.iter().all(|n| n.parse::<u32>().is_ok()),
                "{case}: {place}"
            );
            assert!(message.contains('^'), "{case} points at nothing: {message}");
        }
        insta::with_settings!({
            snapshot_path => "snapshots/bad-input",
            prepend_module_to_snapshot => false,
            omit_expression => true,
        }, {
            insta::assert_snapshot!(name, message);
        });
    }
}

#[test]
fn json_leaves_standard_output_empty_when_it_fails() {
    let said = percuss(&bad_cases(), ["run", "--json", "unit-missing-float.toml"]);
    assert_eq!((said.code, said.stdout.as_str()), (2, ""));
    assert!(
        said.stderr
            .starts_with("error: the unit is missing after `4.8`")
    );
    assert!(said.stderr.contains("projectile.diameter"));
}

#[test]
fn deep_nesting_is_refused() {
    let depth = 10_000;
    let brackets = format!("a = {}{}\n", "[".repeat(depth), "]".repeat(depth));
    let tables = format!("a = {}1{}\n", "{ b = ".repeat(depth), " }".repeat(depth));
    let keys = format!("a{} = 1\n", ".a".repeat(depth));
    let header = format!("[a{}]\n", ".a".repeat(depth));
    for text in [brackets, tables, keys, header] {
        let message = refused_bytes(text.as_bytes(), 2);
        assert!(message.contains("nested too deeply"), "{message}");
    }
    let many_keys: String = (0..20_000).map(|i| format!("a.b{i}.c = 1\n")).collect();
    assert!(refused_bytes(many_keys.as_bytes(), 2).contains("unknown key `a`"));
}

#[test]
fn an_empty_file_lacks_its_first_table() {
    for text in ["", "\n\n", " \t\r\n", "# only a comment"] {
        let message = refused_bytes(text.as_bytes(), 2);
        assert!(
            message.contains("the key `projectile` is missing"),
            "{message}"
        );
    }
}

#[test]
fn noise_is_refused() {
    let message = refused_bytes(b"title = \"caf\xe9\"\n", 4);
    assert!(message.contains("line 1 is not UTF-8 text"), "{message}");
    refused_bytes(&[0xff; 3000], 4);
    refused_bytes(&[0; 3000], 2);
    // A fixed sequence of pseudo-random bytes, once as they are and once as characters.
    let mut state = 12345_u64;
    let mut noise = || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 33) as u32
    };
    for _ in 0..20 {
        let bytes: Vec<u8> = (0..500).map(|_| noise() as u8).collect();
        let folder = TempDir::new().unwrap();
        fs::write(folder.path().join("noise.toml"), &bytes).unwrap();
        let said = run(folder.path(), "noise.toml");
        assert!([2, 4].contains(&said.code), "{}", said.stderr);
        let text: String = (0..500)
            .filter_map(|_| char::from_u32(noise() % 0x3000))
            .collect();
        refused_bytes(text.as_bytes(), 2);
    }
}

#[test]
fn a_long_line_does_not_flood_the_terminal() {
    let before = "x".repeat(450_000);
    let case = format!(
        "title = \"{before}\"\nprojectile = {{ material = \"copper\", diameter = 4.8, impact_velocity = \"{before} m/s\" }}\n"
    );
    let message = refused_bytes(case.as_bytes(), 2);
    assert!(message.contains(":2:48"), "{message}");
    assert!(
        message.contains("the unit is missing after `4.8`"),
        "{message}"
    );
    assert!(
        message.lines().all(|line| line.chars().count() < 200),
        "{message}"
    );
    for text in [
        "9".repeat(900_000),
        format!("{} = 1", "k".repeat(900_000)),
        format!("a = [{}]", "1,".repeat(400_000)),
        format!("projectile = \"{}\"", "y".repeat(900_000)),
    ] {
        let message = refused_bytes(text.as_bytes(), 2);
        assert!(
            message.lines().all(|line| line.chars().count() < 300),
            "{message}"
        );
    }
}

#[test]
fn a_file_that_is_too_large_is_not_read() {
    let message = refused_bytes(&vec![b'#'; (1 << 20) + 1], 4);
    assert!(message.contains("larger than 1 MiB"), "{message}");
}

#[test]
fn what_is_no_file_is_said_plainly() {
    let folder = TempDir::new().unwrap();
    let path = folder.path();
    let missing = refused(path, "nowhere/case.toml", 4);
    assert!(missing.contains("cannot read `nowhere/case.toml`: there is no such file"));
    assert!(missing.contains("percuss new NAME"));

    fs::create_dir(path.join("empty")).unwrap();
    assert_eq!(
        refused(path, "empty", 4),
        "error: cannot read `empty`: it is a directory\n"
    );
    fs::create_dir(path.join("shot")).unwrap();
    fs::write(path.join("shot/scenario.toml"), "").unwrap();
    let message = refused(path, "shot", 4);
    assert!(
        message.contains("did you mean `shot/scenario.toml`?"),
        "{message}"
    );
    fs::write(path.join("file"), "").unwrap();
    refused(path, "file/case.toml", 4);
    refused(path, &"long".repeat(100), 4);
}

#[cfg(unix)]
#[test]
fn links_and_devices_do_not_hang() {
    let folder = TempDir::new().unwrap();
    let path = folder.path();
    std::os::unix::fs::symlink("gone.toml", path.join("dangling.toml")).unwrap();
    let message = refused(path, "dangling.toml", 4);
    assert!(
        message.contains("symbolic link to a file that does not exist"),
        "{message}"
    );
    std::os::unix::fs::symlink("loop.toml", path.join("loop.toml")).unwrap();
    refused(path, "loop.toml", 4);
    assert!(refused(path, "/dev/null", 4).contains("not a regular file"));
    assert!(refused(path, "/dev/zero", 4).contains("not a regular file"));
    let made = Command::new("mkfifo").arg(path.join("fifo.toml")).status();
    if made.is_ok_and(|status| status.success()) {
        assert!(refused(path, "fifo.toml", 4).contains("not a regular file"));
    }
}

/// Words of the command line and texts of a case are quoted in part: neither messages nor results repeat a megabyte.
#[test]
fn texts_are_not_repeated() {
    let folder = crate::support::shot(crate::support::CASE);
    let long = "x".repeat(100_000);
    for words in [
        vec!["run", "shot.toml", "--model", &long],
        vec!["run", "shot.toml", &long],
        vec![&long],
        vec!["run", "shot.toml", "--reference", &long],
        vec!["compare", "shot.toml", "--velocity", &long],
        vec!["run", "shot.toml", "--out", "out", "--checkpoint", &long],
        vec!["run", &long],
        vec!["materials", &long],
        vec!["models", &long],
        vec![
            "calibrate",
            "--fit",
            &long,
            "--data",
            "builtin",
            "--model",
            "chain",
        ],
    ] {
        let said = percuss(folder.path(), &words);
        assert!([2, 4].contains(&said.code), "{}", said.code);
        assert!(
            said.stderr.len() + said.stdout.len() < 4000,
            "{:.40} {}: {:.600}",
            words.join(" "),
            said.stderr.len(),
            said.stderr
        );
    }
    let million = "y".repeat(500_000);
    for (key, case) in [
        (
            "title",
            crate::support::CASE.replace("Copper on aluminium", &million),
        ),
        (
            "sources",
            format!("sources = ['{million}']\n{}", crate::support::CASE),
        ),
        (
            "materials.own.name",
            format!(
                "{}\n[materials.own]\nname = '{million}'\n",
                crate::support::CASE
            ),
        ),
    ] {
        fs::write(folder.path().join("long.toml"), case).unwrap();
        let message = refused(folder.path(), "long.toml", 2);
        assert!(
            key == "materials.own.name" || message.contains("allowed: up to 1000"),
            "{key}: {message}"
        );
    }
}
