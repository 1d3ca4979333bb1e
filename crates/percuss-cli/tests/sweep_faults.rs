//! `percuss sweep` when something goes wrong around it: it is killed, the disk is full, the folder cannot be written to, files are lost
//! or damaged, or several processes want the same folder. The result is right or there is a clear error.
#![cfg(unix)]

use std::{
    fs::{self, File, Permissions},
    io::ErrorKind,
    os::unix::{
        fs::{MetadataExt, PermissionsExt},
        process::CommandExt,
    },
    path::Path,
    process::{Child, Command, Output},
    thread,
    time::Duration,
};

use parquet::{
    file::reader::{FileReader, SerializedFileReader},
    record::RowAccessor,
};
use tempfile::TempDir;

use crate::support::{
    CASE, Draw, flat, folder_with,
    sweeps::{block, count_blocks, merged, ok, spawn, sweep},
};

/// The user that a test is who must not write everywhere.
const NOBODY: u32 = 65534;

/// A sweep in blocks of two runs.
fn folder(samples: u32) -> TempDir {
    let sweep = format!(
        "base = 'scenario.toml'\nmodel = 'chain'\ndesign = 'sobol'\nsamples = {samples}\nblock_size = 2
[[parameter]]\nkey = 'projectile.impact_velocity'\nuniform = {{ from = '150 m/s', to = '400 m/s' }}
[[parameter]]\nkey = 'chain.target_resistance'\nvalues = ['column', 'diverging', 'expanding-cavity']\n"
    );
    folder_with(&[("scenario.toml", CASE), ("sweep.toml", &sweep)])
}

/// What a command that fails says, on one line.
fn fails(folder: &TempDir, arguments: &[&str], code: i32) -> String {
    let said = sweep(folder, arguments);
    assert_eq!(said.code, code, "{arguments:?}: {}", said.stderr);
    flat(&said.stderr)
}

fn compute(folder: &TempDir, out: &str) {
    ok(folder, &["sweep.toml", "--out", out, "--quiet"]);
}

fn resume(folder: &TempDir, out: &str) {
    ok(folder, &["sweep.toml", "--out", out, "--quiet", "--resume"]);
}

fn program() -> &'static Path {
    assert_cmd::cargo::cargo_bin!("percuss")
}

/// Kills a sweep at random moments, each time at least one block further on. `PERCUSS_KILLS` sets how often, 6 otherwise.
#[test]
fn a_sweep_that_is_killed_at_random_moments_loses_and_doubles_no_row() {
    let kills: u32 = std::env::var("PERCUSS_KILLS").map_or(6, |text| text.parse().unwrap());
    let folder = folder(72 * kills);
    compute(&folder, "whole");
    let whole = merged(&folder, &["whole"]);
    let out = folder.path().join("killed");
    let mut draw = Draw(7);
    let mut midway = 0;
    for _ in 0..kills {
        let before = count_blocks(&out);
        let mut child = spawn(
            &folder,
            &["sweep.toml", "--out", "killed", "--resume", "--quiet"],
        );
        while count_blocks(&out) == before && child.try_wait().unwrap().is_none() {
            thread::sleep(Duration::from_millis(1));
        }
        thread::sleep(Duration::from_micros(draw.below(60_000) as u64));
        midway += u32::from(child.try_wait().unwrap().is_none());
        // SIGKILL: nothing of the program runs any more.
        child.kill().unwrap();
        child.wait().unwrap();
    }
    println!(
        "{midway} of {kills} kills hit a sweep at work, {} blocks were left",
        count_blocks(&out)
    );
    assert!(3 * midway >= 2 * kills, "{midway} of {kills}");
    resume(&folder, "killed");
    let left = fs::read_dir(&out).unwrap();
    let mut left = left.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    assert!(left.all(|name| !name.ends_with(".tmp")));
    assert!(merged(&folder, &["killed"]) == whole, "rows differ");
    let reader = SerializedFileReader::new(File::open(folder.path().join("rows.parquet")).unwrap());
    let rows = reader.unwrap();
    let runs = rows
        .get_row_iter(None)
        .unwrap()
        .map(|row| row.unwrap().get_long(0).unwrap());
    assert!(runs.eq(0..i64::from(72 * kills)));
}

/// All parts at once, two of them killed and run again.
#[test]
fn parts_in_processes_at_once_make_the_whole() {
    // So many that none of the parts is done before it is killed, also where other programs run.
    let folder = folder(240);
    compute(&folder, "whole");
    let whole = merged(&folder, &["whole"]);
    let run = |part: u32| {
        let (out, shard) = (format!("part-{part}"), format!("{part}/4"));
        let arguments = [
            "sweep.toml",
            "--out",
            &out,
            "--shard",
            &shard,
            "--threads",
            "1",
            "--resume",
        ];
        spawn(&folder, &arguments)
    };
    let mut children: Vec<Child> = (1..=4).map(run).collect();
    let mut running = vec![1_usize, 2];
    while !running.is_empty() {
        running.retain(|part| {
            let began = count_blocks(&folder.path().join(format!("part-{part}"))) > 0;
            if began {
                children[part - 1].kill().unwrap();
            }
            !began
        });
        thread::sleep(Duration::from_millis(1));
    }
    for (part, child) in children.iter_mut().enumerate() {
        assert_eq!(child.wait().unwrap().success(), part > 1, "{part}");
    }
    let parts = ["part-1", "part-2", "part-3", "part-4"];
    let said = fails(
        &folder,
        &[&["merge"], &parts[..], &["--out", "x.parquet"]].concat(),
        2,
    );
    assert!(said.contains("of 120 blocks are missing"), "{said}");
    for part in [1, 2] {
        assert!(run(part).wait().unwrap().success());
    }
    assert!(merged(&folder, &parts) == whole);
    // A part that is gone, or was never there.
    fs::remove_dir_all(folder.path().join("part-3")).unwrap();
    let said = fails(
        &folder,
        &[&["merge"], &parts[..], &["--out", "x.parquet"]].concat(),
        4,
    );
    assert!(
        said.contains("part-3") && said.contains("no such folder"),
        "{said}"
    );
    let said = fails(
        &folder,
        &["merge", "part-1", "part-2", "part-4", "--out", "x.parquet"],
        2,
    );
    assert!(
        said.contains("30 of 120 blocks are missing or damaged"),
        "{said}"
    );
    assert!(!folder.path().join("x.parquet").exists());
}

#[test]
fn a_damaged_block_is_seen_wherever_the_damage_is() {
    let folder = folder(8);
    compute(&folder, "rows");
    let whole = merged(&folder, &["rows"]);
    let path = block(&folder, "rows", 1);
    let good = fs::read(&path).unwrap();
    let other = fs::read(block(&folder, "rows", 2)).unwrap();
    let mut draw = Draw(3);
    let mut damaged: Vec<Vec<u8>> = vec![Vec::new(), good[..good.len() - 1].to_vec(), other];
    for _ in 0..6 {
        let mut bytes = good.clone();
        let place = draw.below(bytes.len());
        bytes[place] ^= 1 << draw.below(8);
        damaged.push(bytes);
        damaged.push(good[..draw.below(good.len())].to_vec());
    }
    // A page of zeros, as a file system may leave it.
    let mut zeros = good.clone();
    let middle = zeros.len() / 2;
    zeros[middle..middle + 512].fill(0);
    damaged.push(zeros);
    for (i, bytes) in damaged.iter().enumerate() {
        fs::write(&path, bytes).unwrap();
        let said = ok(&folder, &["status", "rows"]);
        assert!(said.contains("1 damaged file"), "{i}: {said}");
        let said = fails(&folder, &["merge", "rows", "--out", "x.parquet"], 2);
        assert!(
            said.contains("the first is block-000001.parquet"),
            "{i}: {said}"
        );
        resume(&folder, "rows");
        assert!(fs::read(&path).unwrap() == good, "{i}");
    }
    assert!(merged(&folder, &["rows"]) == whole);
    // What stands where a block should and is no file is not touched.
    fs::remove_file(&path).unwrap();
    fs::create_dir(&path).unwrap();
    let said = fails(&folder, &["sweep.toml", "--out", "rows", "--resume"], 4);
    assert!(
        said.contains("cannot write") && said.contains("block-000001.parquet"),
        "{said}"
    );
}

#[test]
fn a_damaged_manifest_is_an_error() {
    let folder = folder(4);
    compute(&folder, "rows");
    let manifest = folder.path().join("rows/manifest.json");
    let text = fs::read_to_string(&manifest).unwrap();
    for (bad, words) in [
        (text[..text.len() / 2].to_owned(), "it is damaged"),
        (text.replace("\"runs\": 4", "\"runs\": 6"), "it is damaged"),
        (String::new(), "it is damaged"),
    ] {
        fs::write(&manifest, bad).unwrap();
        let said = fails(&folder, &["sweep.toml", "--out", "rows", "--resume"], 2);
        assert!(said.contains(words), "{said}");
    }
}

/// A limit to the size of files stands for a disk that gets full: writing fails midway in the same way.
#[test]
fn a_full_disk_is_a_clear_error_and_nothing_half_written_stays() {
    let folder = folder(8);
    compute(&folder, "whole");
    let whole = merged(&folder, &["whole"]);
    let limited = |blocks: u64, arguments: &str| -> Output {
        // Blocks of 512 bytes; without a handler of its own the program would be killed by SIGXFSZ.
        let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" sweep {arguments}");
        let mut command = Command::new("sh");
        command.args(["-c", &script]).arg(program());
        command.current_dir(folder.path()).output().unwrap()
    };
    let size = fs::metadata(block(&folder, "whole", 0)).unwrap().len();
    let manifest = fs::metadata(folder.path().join("whole/manifest.json"))
        .unwrap()
        .len();
    assert!(
        manifest + 2048 < size,
        "the limit has to lie between {manifest} and {size}"
    );
    let failed = |output: &Output, file: &str| {
        let said = flat(&String::from_utf8_lossy(&output.stderr));
        assert_eq!(output.status.code(), Some(4), "{said}");
        assert!(
            said.contains("cannot write") && said.contains(file),
            "{said}"
        );
        assert!(said.contains("File too large"), "{said}");
    };
    let output = limited(manifest / 512 + 2, "sweep.toml --out rows");
    failed(&output, "block-");
    let left = fs::read_dir(folder.path().join("rows")).unwrap();
    let mut left: Vec<_> = left.map(|entry| entry.unwrap().file_name()).collect();
    left.sort();
    assert_eq!(left, ["lock", "manifest.json"]);
    let said = fails(&folder, &["sweep.toml", "--out", "rows"], 2);
    assert!(said.contains("--resume"), "{said}");
    resume(&folder, "rows");
    let output = limited(size / 512 + 4, "merge rows --out big.parquet");
    failed(&output, "big.parquet");
    assert!(!folder.path().join("big.parquet").exists());
    assert!(merged(&folder, &["rows"]) == whole);
    let output = limited(0, "sweep.toml --out empty");
    failed(&output, "manifest.json");
    // The folder has no manifest yet: it is as if the sweep had never begun.
    compute(&folder, "empty");
    assert!(merged(&folder, &["empty"]) == whole);
}

#[test]
fn a_folder_that_cannot_be_written_to_is_a_clear_error_and_can_be_read() {
    let folder = folder(4);
    compute(&folder, "rows");
    let rows = folder.path().join("rows");
    fs::remove_file(block(&folder, "rows", 1)).unwrap();
    let open = |path: &Path, mode| fs::set_permissions(path, Permissions::from_mode(mode)).unwrap();
    open(folder.path(), 0o755);
    // Root may write anywhere, so it becomes nobody, who may not be allowed to reach the program where it was built.
    let root = fs::metadata(&rows).unwrap().uid() == 0;
    let own = folder.path().join("percuss");
    fs::copy(program(), &own).unwrap();
    open(&own, 0o755);
    open(&rows, 0o555);
    let run = |arguments: &[&str]| -> Output {
        let mut command = Command::new(&own);
        command
            .arg("sweep")
            .args(arguments)
            .current_dir(folder.path());
        if root {
            command.uid(NOBODY).gid(NOBODY);
        }
        // Another test may have started a process while the copy was open for writing.
        loop {
            match command.output() {
                Err(error) if error.kind() == ErrorKind::ExecutableFileBusy => {
                    thread::sleep(Duration::from_millis(10));
                }
                output => return output.unwrap(),
            }
        }
    };
    let before = count_blocks(&rows);
    let output = run(&["sweep.toml", "--out", "rows", "--resume"]);
    let said = flat(&String::from_utf8_lossy(&output.stderr));
    assert_eq!(output.status.code(), Some(4), "{said}");
    assert!(
        said.contains("cannot write `rows") && said.contains("ermission denied"),
        "{said}"
    );
    let output = run(&["status", "rows"]);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        output.status.success() && said.contains("2 of 4 runs done"),
        "{said}"
    );
    let output = run(&["plot", "rows"]);
    let said = flat(&String::from_utf8_lossy(&output.stderr));
    assert_eq!(output.status.code(), Some(4), "{said}");
    assert!(said.contains("ermission denied"), "{said}");
    assert_eq!(count_blocks(&rows), before);
    open(&rows, 0o755);
    resume(&folder, "rows");
}

#[test]
fn of_two_processes_on_one_folder_one_computes_and_the_other_is_refused() {
    let folder = folder(48);
    compute(&folder, "whole");
    let whole = merged(&folder, &["whole"]);
    // Both begin at once, again and again; which of them is first is not known.
    let mut refused = 0;
    for _ in 0..3 {
        let _ = fs::remove_dir_all(folder.path().join("rows"));
        let start = || {
            spawn(
                &folder,
                &["sweep.toml", "--out", "rows", "--resume", "--threads", "1"],
            )
        };
        let mut both = [start(), start()];
        let codes = both.each_mut().map(|child| child.wait().unwrap().code());
        assert!(codes.contains(&Some(0)), "{codes:?}");
        assert!(
            codes.iter().all(|code| matches!(code, Some(0 | 2))),
            "{codes:?}"
        );
        refused += u32::from(codes.contains(&Some(2)));
        assert!(merged(&folder, &["rows"]) == whole);
    }
    assert!(refused > 0);
}

/// A changed bit of a manifest is found, and the remedy works: without its manifest a folder is completed, and its blocks are kept.
#[test]
fn a_changed_bit_of_a_manifest_is_found() {
    let folder = folder(4);
    compute(&folder, "rows");
    let whole = merged(&folder, &["rows"]);
    let path = folder.path().join("rows/manifest.json");
    let bytes = fs::read(&path).unwrap();
    let mut draw = Draw(3);
    for _ in 0..40 {
        let mut changed = bytes.clone();
        let bit = draw.below(8 * bytes.len());
        changed[bit / 8] ^= 1 << (bit % 8);
        fs::write(&path, changed).unwrap();
        let said = sweep(&folder, &["merge", "rows", "--out", "rows.parquet"]);
        assert!([2, 4].contains(&said.code), "bit {bit}: {}", said.stderr);
    }
    fs::remove_file(&path).unwrap();
    resume(&folder, "rows");
    assert_eq!(fs::read(&path).unwrap(), bytes);
    assert!(merged(&folder, &["rows"]) == whole);
}

/// A merge may not write over a file that it reads.
#[test]
fn a_merge_does_not_overwrite_its_inputs() {
    let folder = folder(4);
    compute(&folder, "rows");
    let path = block(&folder, "rows", 0);
    let bytes = fs::read(&path).unwrap();
    std::os::unix::fs::symlink("rows", folder.path().join("same")).unwrap();
    for out in [
        "rows/block-000000.parquet",
        "same/block-000001.parquet",
        "rows/manifest.json",
        "rows/lock",
    ] {
        let words = fails(&folder, &["merge", "rows", "--out", out], 2);
        assert!(
            words.contains("this is a file of a folder that is merged"),
            "{words}"
        );
    }
    assert_eq!(fs::read(&path).unwrap(), bytes);
    ok(&folder, &["merge", "rows", "--out", "rows/all.parquet"]);
}

/// A folder that is removed while it is computed is an error.
#[test]
fn a_folder_that_is_removed_in_between_is_an_error() {
    let folder = folder(400);
    let out = folder.path().join("rows");
    let mut child = spawn(&folder, &["sweep.toml", "--out", "rows", "--quiet"]);
    while count_blocks(&out) == 0 {
        thread::sleep(Duration::from_millis(1));
    }
    // A file that is written meanwhile keeps the folder from being empty.
    while let Err(error) = fs::remove_dir_all(&out) {
        assert_eq!(error.kind(), std::io::ErrorKind::DirectoryNotEmpty);
    }
    assert_eq!(child.wait().unwrap().code(), Some(4));
}
