//! Running the program and looking at what it says.

use std::{ffi::OsStr, path::Path};

/// What a run of the program left.
pub struct Said {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

/// Runs the program in a folder.
pub fn percuss<I: AsRef<OsStr>>(folder: &Path, arguments: impl IntoIterator<Item = I>) -> Said {
    let output = assert_cmd::Command::cargo_bin("percuss")
        .expect("the program is built")
        .args(arguments)
        .current_dir(folder)
        .env_remove("NO_COLOR")
        .env_remove("COLUMNS")
        .timeout(std::time::Duration::from_secs(120))
        .output()
        .expect("the program starts");
    let text = |bytes| String::from_utf8(bytes).expect("output is UTF-8");
    let said = Said {
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
