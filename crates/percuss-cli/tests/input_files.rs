//! Inputs that are no files: pipes that block, devices that never end, and links to them. Each is refused at once.
#![cfg(unix)]

use std::{
    os::unix::fs::symlink,
    path::Path,
    process::Command,
    thread,
    time::{Duration, Instant},
};

use tempfile::TempDir;

use crate::support::{CASE, flat, folder_with, percuss, spawn};

fn make_pipe(path: &Path) {
    let made = Command::new("mkfifo").arg(path).status().unwrap();
    assert!(made.success());
}

const SWEEP: &str = "base = 'scenario.toml'\nmodel = 'chain'\ndesign = 'grid'\nblock_size = 2
[[parameter]]\nkey = 'projectile.impact_velocity'\nvalues = ['200 m/s', '210 m/s', '220 m/s']\n";

fn folder() -> TempDir {
    let folder = folder_with(&[("scenario.toml", CASE), ("sweep.toml", SWEEP)]);
    make_pipe(&folder.path().join("pipe"));
    symlink("/dev/zero", folder.path().join("link")).unwrap();
    folder
}

/// Exit code and standard error of a command that may not take longer than half a minute: a pipe would block for ever.
fn ended(folder: &Path, arguments: &[&str]) -> (i32, String) {
    let mut child = spawn(folder, arguments);
    let start = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if start.elapsed() > Duration::from_secs(30) {
            child.kill().unwrap();
            child.wait().unwrap();
            panic!("{arguments:?} does not end");
        }
        thread::sleep(Duration::from_millis(5));
    }
    let output = child.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    (output.status.code().unwrap_or(-1), said)
}

#[test]
fn pipes_and_devices_are_refused_wherever_a_file_is_named() {
    let folder = folder();
    let fit = ["calibrate", "--fit", "chain.constraint_factor=1..4"];
    let fit_with = |words: &[&'static str]| [&fit, words].concat();
    let (cases, data) = (fit_with(&[]), fit_with(&["--data"]));
    let materials = fit_with(&["scenario.toml", "--materials"]);
    let commands: [&[&str]; 21] = [
        &["run"],
        &["compare"],
        &["converge"],
        &["uncertainty"],
        &["export", "--to", "lammps", "--out", "lammps"],
        &["limit"],
        &["limit", "--tests"],
        &["sweep", "--out", "rows"],
        &cases,
        &data,
        &materials,
        &["validate", "--data"],
        &["validate", "--data", "builtin", "--materials"],
        &["materials", "--case"],
        &["materials", "--file"],
        &["materials", "compare", "copper", "iron", "--case"],
        &["materials", "compare", "copper", "iron", "--file"],
        &["serve", "--port", "0"],
        &["benchmark", "--reference"],
        &["benchmark", "--paper-case"],
        &["serve", "--port", "0", "--token-file"],
    ];
    for command in commands {
        for file in ["pipe", "link", "/dev/zero"] {
            let (code, said) = ended(folder.path(), &[command, &[file]].concat());
            assert_eq!(code, 4, "{command:?} {file}: {said}");
            assert!(
                flat(&said).contains("it is not a regular file"),
                "{command:?} {file}: {said}"
            );
        }
    }
}

/// A pipe as output would wait for its reader.
#[test]
fn a_pipe_is_no_file_to_write_materials_to() {
    let folder = folder();
    let export = ["materials", "export", "copper", "--out", "pipe"];
    let (code, said) = ended(folder.path(), &export);
    assert_eq!(code, 4, "{said}");
    for words in ["it is not a regular file", "without `--out`"] {
        assert!(flat(&said).contains(words), "{said}");
    }
}

/// Rows are joined into a file of rows, and into nothing else.
#[test]
fn a_pipe_is_no_file_to_merge_rows_into() {
    let folder = folder();
    make_pipe(&folder.path().join("pipe.csv"));
    std::fs::write(folder.path().join("notes.txt"), "kept").unwrap();
    let sweep = "base = 'scenario.toml'\nmodel = 'chain'\ndesign = 'grid'\n[[parameter]]\nkey = 'projectile.impact_velocity'\nvalues = ['20 m/s']\n";
    std::fs::write(folder.path().join("sweep.toml"), sweep).unwrap();
    let (code, said) = ended(folder.path(), &["sweep", "sweep.toml", "--out", "rows"]);
    assert_eq!(code, 0, "{said}");
    for (file, code, words) in [
        ("pipe.csv", 4, "it is not a regular file"),
        ("notes.txt", 2, "`.parquet` or `.csv`"),
    ] {
        let (found, said) = ended(folder.path(), &["sweep", "merge", "rows", "--out", file]);
        assert_eq!(found, code, "{said}");
        assert!(flat(&said).contains(words), "{said}");
    }
    let notes = std::fs::read_to_string(folder.path().join("notes.txt")).unwrap();
    assert_eq!(notes, "kept");
}

/// A result takes the place of what has its name, whole: a pipe, a link, or an older result that a failure leaves as it is.
#[test]
fn results_take_the_place_of_pipes_and_links() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    std::fs::create_dir(at("out")).unwrap();
    std::fs::write(at("kept"), "kept").unwrap();
    for (arguments, file) in [
        (&["run", "scenario.toml", "--fast"][..], "result.json"),
        (&["run", "scenario.toml", "--fast"], "case-as-run.toml"),
        (&["compare", "scenario.toml", "--fast"], "compare.json"),
        (
            &["converge", "scenario.toml", "--levels", "3"],
            "convergence.json",
        ),
    ] {
        let path = at("out").join(file);
        for make in [make_pipe as fn(&Path), |path| {
            symlink("../kept", path).unwrap()
        }] {
            let _ = std::fs::remove_file(&path);
            make(&path);
            let (code, said) = ended(folder.path(), &[arguments, &["--out", "out"]].concat());
            assert_eq!(code, 0, "{arguments:?}: {said}");
            assert!(path.symlink_metadata().unwrap().is_file(), "{path:?}");
            assert!(std::fs::read_to_string(&path).unwrap().len() > 100);
        }
    }
    assert_eq!(std::fs::read_to_string(at("kept")).unwrap(), "kept");
}

/// Files may have so few bytes that the new result does not fit: the former one stays.
#[test]
fn a_result_that_cannot_be_written_leaves_the_former_one() {
    let folder = folder();
    let run = ["run", "scenario.toml", "--fast", "--quiet", "--out", "out"];
    assert_eq!(ended(folder.path(), &run).0, 0);
    let result = folder.path().join("out/result.json");
    let former = std::fs::read_to_string(&result).unwrap();
    let script = "trap '' XFSZ; ulimit -f 1; exec \"$0\" \"$@\"";
    let limited = Command::new("bash")
        .args(["-c", script, env!("CARGO_BIN_EXE_percuss")])
        .args(run)
        .current_dir(folder.path())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&limited.stderr).into_owned();
    assert_eq!(limited.status.code(), Some(4), "{said}");
    assert_eq!(std::fs::read_to_string(&result).unwrap(), former);
}

/// The same of files that other files name.
#[test]
fn pipes_are_refused_in_the_files_that_name_them() {
    let folder = folder();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("sweep.toml", &SWEEP.replace("scenario.toml", "pipe"));
    write("case.toml", &format!("material_files = ['pipe']\n{CASE}"));
    for command in [
        &["sweep", "sweep.toml", "--out", "rows"][..],
        &["run", "case.toml"],
    ] {
        let (code, said) = ended(folder.path(), command);
        assert_eq!(code, 4, "{command:?}: {said}");
        assert!(
            flat(&said).contains("it is not a regular file"),
            "{command:?}: {said}"
        );
    }
}

/// Files of the program's own that would fill the memory: they have holes, and take no place on the disk.
#[test]
fn large_files_in_the_place_of_own_ones_are_not_read() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let sweep = ["sweep", "sweep.toml", "--out", "rows", "--quiet"];
    percuss(folder.path(), sweep).ok();
    std::fs::create_dir(at("out")).unwrap();
    for name in ["rows/block-000000.parquet", "out/checkpoint.percuss"] {
        let file = std::fs::File::create(at(name)).unwrap();
        file.set_len(3 << 30).unwrap();
    }
    let start = Instant::now();
    let run = ["run", "scenario.toml", "--fast", "--out", "out", "--resume"];
    let (code, said) = ended(folder.path(), &run);
    assert_eq!(code, 2, "{said}");
    assert!(flat(&said).contains("it is no checkpoint"), "{said}");
    let merge = ["sweep", "merge", "rows", "--out", "all.parquet"];
    let (code, said) = ended(folder.path(), &merge);
    assert_ne!(code, 0);
    assert!(flat(&said).contains("damaged"), "{said}");
    // Three gibibytes take longer to read.
    println!("{:?}", start.elapsed());
}

#[test]
fn files_that_are_not_there_are_errors_of_files() {
    let folder = folder();
    let curves = format!("{CASE}\n[[measured_curves]]\nfile = 'none.csv'\n");
    std::fs::write(folder.path().join("curves.toml"), curves).unwrap();
    for command in [
        &["run", "curves.toml"][..],
        &["benchmark", "--paper-case", "none.csv"],
    ] {
        let (code, said) = ended(folder.path(), command);
        assert_eq!(code, 4, "{command:?}: {said}");
        assert!(flat(&said).contains("there is no such file"), "{said}");
    }
}

#[test]
fn texts_with_control_characters_are_refused() {
    let folder = folder();
    let case = CASE.replace("Copper on", "Copper \\u001b[2J on");
    std::fs::write(folder.path().join("case.toml"), case).unwrap();
    let (code, said) = ended(folder.path(), &["run", "case.toml"]);
    assert_eq!(code, 2, "{said}");
    assert!(
        said.contains("U+001B") && !said.contains('\u{1b}'),
        "{said}"
    );
}

/// A pipe in the place of a file of the program's own ends with an error or counts as damaged.
#[test]
fn pipes_in_a_folder_of_results_are_refused() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let sweep = ["sweep", "sweep.toml", "--out", "rows", "--quiet"];
    percuss(folder.path(), sweep).ok();
    for name in ["manifest.json", "lock"] {
        std::fs::rename(at("rows").join(name), at("kept")).unwrap();
        make_pipe(&at("rows").join(name));
        let (code, said) = ended(folder.path(), &[&sweep[..], &["--resume"]].concat());
        assert_eq!(code, 4, "{name}: {said}");
        assert!(said.contains("it is not a regular file"), "{name}: {said}");
        std::fs::rename(at("kept"), at("rows").join(name)).unwrap();
    }
    let block = at("rows").join("block-000001.parquet");
    let bytes = std::fs::read(&block).unwrap();
    std::fs::remove_file(&block).unwrap();
    make_pipe(&block);
    let (code, said) = ended(folder.path(), &[&sweep[..], &["--resume"]].concat());
    assert_eq!(code, 0, "{said}");
    assert_eq!(std::fs::read(&block).unwrap(), bytes);

    std::fs::create_dir(at("out")).unwrap();
    make_pipe(&at("out").join("checkpoint.percuss"));
    let resumed = ["run", "scenario.toml", "--out", "out", "--resume", "--fast"];
    let (code, said) = ended(folder.path(), &resumed);
    assert_eq!(code, 4, "{said}");
    assert!(said.contains("it is not a regular file"), "{said}");
}
