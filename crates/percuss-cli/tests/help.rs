//! Help, completions, manual pages, and readers that go away.

use std::{
    fs,
    process::{Command, Stdio},
};

use tempfile::TempDir;

use crate::support::{ok, percuss};

#[test]
fn completions_and_manual_pages_are_written() {
    let folder = TempDir::new().unwrap();
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        assert!(
            ok(folder.path(), &["completions", shell]).contains("percuss"),
            "{shell}"
        );
    }
    let page = ok(folder.path(), &["man"]);
    assert!(page.contains(".TH percuss 1"));
    // Commands can be copied: each has a line of its own, with hyphens.
    let examples = ".SH EXAMPLES\n.nf\n  percuss new";
    assert!(
        page.contains(examples) && page.contains("\n.SH EXIT CODES\n0 ok"),
        "{page}"
    );
    let text = ok(folder.path(), &["man", "--out", "man/man1"]);
    for page in ["percuss.1", "percuss-run.1", "percuss-materials-show.1"] {
        assert!(text.contains(page), "{text}");
        let roff = fs::read_to_string(folder.path().join("man/man1").join(page)).unwrap();
        assert!(roff.contains(".SH SYNOPSIS"), "{roff}");
    }
}

#[test]
fn help_fits_and_is_as_approved() {
    let folder = TempDir::new().unwrap();
    for command in [
        &[][..],
        &["run"],
        &["compare"],
        &["limit"],
        &["calibrate"],
        &["benchmark"],
        &["new"],
        &["models"],
        &["materials"],
        &["materials", "show"],
        &["export"],
        &["schema"],
        &["completions"],
        &["man"],
    ] {
        let text = ok(folder.path(), &[command, &["--help"]].concat());
        assert!(
            text.contains("Examples:\n") && text.contains("Exit codes: "),
            "{text}"
        );
        assert!(
            text.lines().all(|line| line.chars().count() <= 80),
            "{text}"
        );
        let name = [&["help"], command].concat().join("-");
        insta::with_settings!({
            snapshot_path => "snapshots/help",
            prepend_module_to_snapshot => false,
            omit_expression => true,
        }, {
            insta::assert_snapshot!(name, text);
        });
    }
    assert!(ok(folder.path(), &["--version"]).starts_with("percuss "));
    assert_eq!(percuss::<&str>(folder.path(), []).code, 2);
    assert_eq!(percuss(folder.path(), ["walk"]).code, 2);
}

#[test]
fn a_reader_that_goes_away_is_no_failure() {
    for arguments in [
        &["materials", "--json"][..],
        &["schema"],
        &["completions", "zsh"],
    ] {
        let mut child = Command::new(assert_cmd::cargo::cargo_bin!("percuss"))
            .args(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0));
        assert_eq!(output.stderr, b"");
    }
}

/// Help that cannot be written is a failure, as any other output.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_failure_of_the_help() {
    for arguments in [&["--help"][..], &["run", "--help"], &["--version"]] {
        let output = Command::new(assert_cmd::cargo::cargo_bin!("percuss"))
            .args(arguments)
            .stdout(
                std::fs::File::options()
                    .write(true)
                    .open("/dev/full")
                    .unwrap(),
            )
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(4), "{arguments:?}");
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(
            said.starts_with("error: cannot write the output:"),
            "{said}"
        );
    }
}
