//! `percuss sweep`: rows that do not depend on who computes them or how often that is ended.

use std::{
    fs::{self, File},
    thread,
    time::Duration,
};

use parquet::{
    file::reader::{FileReader, SerializedFileReader},
    record::RowAccessor,
};
use tempfile::TempDir;

use crate::support::{
    CASE, flat, folder_with, interrupt, json, percuss, refuses_all_of,
    sweeps::{block, count_blocks, merged, ok, spawn, sweep},
};

/// 320 runs of a few milliseconds.
const GRID: &str = "
base = 'scenario.toml'
model = 'chain'
design = 'grid'
block_size = 3
[[parameter]]
key = 'projectile.impact_velocity'
linear = { from = '150 m/s', to = '400 m/s', count = 40 }
[[parameter]]
key = 'chain.constraint_factor'
linear = { from = 1, to = 3.5, count = 8 }
";

/// Runs of which some have a negative speed.
const RANDOM: &str = "
base = 'scenario.toml'
model = 'chain'
design = 'sobol'
samples = 50
seed = 3
block_size = 4
[[parameter]]
key = 'projectile.impact_velocity'
normal = { mean = '150 m/s', standard_deviation = '120 m/s' }
[[parameter]]
key = 'chain.border_shear'
triangular = { from = 0, mode = 0.577, to = 1 }
";

fn folder() -> TempDir {
    folder_with(&[
        ("scenario.toml", CASE),
        ("grid.toml", GRID),
        ("random.toml", RANDOM),
    ])
}

#[test]
fn threads_and_shards_make_no_difference() {
    let folder = folder();
    let run = |out: &str, more: &[&str]| {
        ok(&folder, &[&["random.toml", "--out", out], more].concat());
    };
    run("one", &["--threads", "1"]);
    run("two", &["--threads", "2"]);
    for part in 1..=3 {
        run(&format!("part-{part}"), &["--shard", &format!("{part}/3")]);
    }
    let one = merged(&folder, &["one"]);
    assert!(one == merged(&folder, &["two"]));
    assert!(one == merged(&folder, &["part-3", "part-1", "part-2"]));
    let said = sweep(
        &folder,
        &["merge", "part-1", "part-2", "--out", "x.parquet"],
    );
    assert_eq!(said.code, 2);
    assert!(
        said.stderr.contains("4 of 13 blocks are missing"),
        "{}",
        said.stderr
    );
    assert!(!folder.path().join("x.parquet").exists());
}

#[test]
fn every_shot_is_a_row_and_one_that_fails_has_its_error() {
    let folder = folder();
    let said = ok(&folder, &["random.toml", "--out", "rows"]);
    assert!(
        said.contains("50 runs") && said.contains("failed"),
        "{said}"
    );
    merged(&folder, &["rows"]);
    let file = File::open(folder.path().join("rows.parquet")).unwrap();
    let reader = SerializedFileReader::new(file).unwrap();
    let schema = reader.metadata().file_metadata().schema_descr();
    let column = |name: &str| {
        let mut names = schema
            .columns()
            .iter()
            .map(|column| column.name().to_owned());
        names.position(|found| found == name).unwrap()
    };
    let (speed, outcome) = (column("projectile.impact_velocity_m_s"), column("outcome"));
    let (depth, error) = (column("depth_of_penetration_mm"), column("error"));
    let mut failed = 0;
    let rows = reader.get_row_iter(None).unwrap();
    for (i, row) in rows.enumerate() {
        let row = row.unwrap();
        assert_eq!(row.get_long(0).unwrap(), i as i64);
        let fails = row.get_double(speed).unwrap() < 0.0;
        failed += usize::from(fails);
        assert_eq!(row.get_string(outcome).unwrap() == "failed", fails);
        assert_eq!(
            row.get_string(error).unwrap().contains("out of range"),
            fails
        );
        assert_eq!(row.get_double(depth).is_ok(), !fails);
    }
    assert!((2..20).contains(&failed), "{failed}");
    assert_eq!(reader.metadata().file_metadata().num_rows(), 50);
}

#[test]
fn rows_are_merged_into_csv_by_the_name_of_the_file() {
    let folder = folder();
    ok(&folder, &["random.toml", "--out", "rows"]);
    ok(&folder, &["merge", "rows", "--out", "rows.csv"]);
    let text = fs::read_to_string(folder.path().join("rows.csv")).unwrap();
    let mut rows = csv::Reader::from_reader(text.as_bytes());
    let names = rows.headers().unwrap().clone();
    let place = |name: &str| names.iter().position(|found| found == name).unwrap();
    let (speed, depth) = (
        place("projectile.impact_velocity_m_s"),
        place("depth_of_penetration_mm"),
    );
    let mut count = 0;
    for row in rows.records() {
        let row = row.unwrap();
        assert_eq!(row[0], count.to_string());
        let fails = row[speed].parse::<f64>().unwrap() < 0.0;
        assert_eq!(row[depth].parse::<f64>().is_ok(), !fails, "{row:?}");
        count += 1;
    }
    assert_eq!(count, 50);
    ok(
        &folder,
        &["merge", "rows", "--out", "si.csv", "--units", "SI"],
    );
    let text = fs::read_to_string(folder.path().join("si.csv")).unwrap();
    assert!(
        text.lines()
            .next()
            .unwrap()
            .contains("depth_of_penetration_m,")
    );
}

#[test]
fn lost_and_damaged_blocks_are_computed_again() {
    let folder = folder();
    ok(&folder, &["random.toml", "--out", "rows"]);
    let whole = merged(&folder, &["rows"]);
    fs::remove_file(block(&folder, "rows", 2)).unwrap();
    let cut = File::options()
        .write(true)
        .open(block(&folder, "rows", 7))
        .unwrap();
    cut.set_len(500).unwrap();
    fs::write(
        folder.path().join("rows/.block-000002.parquet.1-0.tmp"),
        "half",
    )
    .unwrap();
    let said = ok(&folder, &["status", "rows"]);
    assert!(
        said.contains("42 of 50 runs done, 11 of 13 blocks"),
        "{said}"
    );
    assert!(said.contains("1 damaged file"), "{said}");
    let status = json(&ok(&folder, &["status", "rows", "--json"]));
    assert_eq!(status["runs_done"], 42);
    assert_eq!(status["blocks_damaged"], serde_json::json!([7]));
    assert_eq!(status["manifest"]["runs"], 50);
    let said = sweep(&folder, &["merge", "rows", "--out", "x.parquet"]);
    assert!(
        said.stderr.contains("the first is block-000002.parquet"),
        "{}",
        said.stderr
    );
    ok(&folder, &["random.toml", "--out", "rows", "--resume"]);
    assert!(merged(&folder, &["rows"]) == whole);
}

/// A case without a title has the name of its folder, which may move.
#[test]
fn a_sweep_goes_on_in_a_folder_that_was_moved() {
    let case = CASE.replace("title = \"Copper on aluminium\"", "");
    let mut folder = folder_with(&[("scenario.toml", &case), ("random.toml", RANDOM)]);
    ok(&folder, &["random.toml", "--out", "rows"]);
    let whole = merged(&folder, &["rows"]);
    let moved = folder_with(&[]);
    fs::remove_dir(moved.path()).unwrap();
    fs::rename(folder.path(), moved.path()).unwrap();
    folder.disable_cleanup(true);
    fs::remove_file(block(&moved, "rows", 2)).unwrap();
    ok(&moved, &["random.toml", "--out", "rows", "--resume"]);
    assert!(merged(&moved, &["rows"]) == whole);
}

#[test]
fn a_folder_of_another_sweep_is_refused() {
    let folder = folder();
    ok(&folder, &["random.toml", "--out", "rows"]);
    let refused = |words: &str| {
        let said = sweep(&folder, &["random.toml", "--out", "rows", "--resume"]);
        assert_eq!(said.code, 2, "{}", said.stderr);
        let said = flat(&said.stderr);
        assert!(said.contains(words), "{said}");
    };
    let again = sweep(&folder, &["random.toml", "--out", "rows"]);
    assert!(
        again.code == 2 && again.stderr.contains("--resume"),
        "{}",
        again.stderr
    );
    let file = folder.path().join("random.toml");
    fs::write(&file, format!("# a comment changes nothing\n{RANDOM}")).unwrap();
    ok(&folder, &["random.toml", "--out", "rows", "--resume"]);
    fs::write(&file, RANDOM.replace("seed = 3", "seed = 4")).unwrap();
    refused("holds another sweep: its `seed` is 3, not 4");
    fs::write(&file, RANDOM).unwrap();
    let case = CASE.replace("25 mm", "26 mm");
    fs::write(folder.path().join("scenario.toml"), case).unwrap();
    refused("computed from a base case that says something else");
    for (path, words) in [(".", "no manifest.json"), ("random.toml", "this is a file")] {
        let said = sweep(&folder, &["status", path]);
        assert!(
            said.code == 2 && said.stderr.contains(words),
            "{}",
            said.stderr
        );
    }
}

#[test]
#[cfg(unix)]
fn a_second_process_is_refused_and_ctrl_c_ends_the_first_cleanly() {
    let folder = folder();
    let slow = GRID
        .replace("model = 'chain'", "model = 'fdm'")
        .replace("count = 8", "count = 800");
    fs::write(folder.path().join("slow.toml"), slow).unwrap();
    let child = spawn(&folder, &["slow.toml", "--out", "rows"]);
    while count_blocks(&folder.path().join("rows")) == 0 {
        thread::sleep(Duration::from_millis(5));
    }
    let said = sweep(&folder, &["slow.toml", "--out", "rows", "--resume"]);
    assert_eq!(said.code, 2);
    assert!(
        said.stderr.contains("another process is computing"),
        "{}",
        said.stderr
    );
    let said = ok(&folder, &["status", "rows"]);
    assert!(
        said.contains("a process is computing this sweep now"),
        "{said}"
    );
    let said = interrupt(child);
    assert!(
        said.contains("the sweep was stopped with") && said.contains("--resume"),
        "{said}"
    );
    assert!(!ok(&folder, &["status", "rows"]).contains("now"));
}

#[test]
fn wrong_sweep_files_are_refused_with_their_place() {
    let out = TempDir::new().unwrap();
    let out = out.path().join("rows");
    refuses_all_of("bad-sweeps", 20, |bad, name| {
        let said = percuss(bad, ["sweep", name, "--out", out.to_str().unwrap()]);
        assert!(!out.exists(), "{name}");
        said
    });
}

/// The answers of a few runs are a file of their own, which `--resume` completes.
#[test]
fn axisymmetric_answers_are_added_to_a_few_runs() {
    const FEW: &str = "
base = 'scenario.toml'
model = 'chain'
design = 'grid'
[[parameter]]
key = 'projectile.impact_velocity'
linear = { from = '150 m/s', to = '400 m/s', count = 10 }
";
    let folder = folder_with(&[("scenario.toml", CASE), ("few.toml", FEW)]);
    let rows = || -> Vec<Vec<String>> {
        let text = fs::read_to_string(folder.path().join("rows/axisymmetric.csv")).unwrap();
        let cells = |line: &str| line.split(',').map(str::to_owned).collect();
        text.lines().map(cells).collect()
    };
    let asked = |count: &'static str| ["few.toml", "--out", "rows", "--axisymmetric", count];
    let resumed = |count| [&asked(count)[..], &["--resume"]].concat();
    let said = sweep(&folder, &[&asked("1")[..], &["--shard", "1/2"]].concat());
    assert_eq!(said.code, 2);
    assert!(
        said.stderr
            .contains("`--axisymmetric` needs the whole sweep"),
        "{}",
        said.stderr
    );
    let said = sweep(&folder, &asked("1"));
    assert_eq!(said.code, 0);
    let note = "note: 1 axisymmetric answer, about ";
    assert!(said.stderr.starts_with(note), "{}", said.stderr);
    let text = flat(&said.stdout);
    assert!(text.contains("axisymmetric answers of 1 run"), "{text}");
    let first = rows();
    assert_eq!(first.len(), 2);
    ok(&folder, &[&resumed("2")[..], &["--quiet"]].concat());
    let both = rows();
    assert_eq!(both.len(), 3);
    assert!(both.contains(&first[1]), "{both:?}");
    let column = |name: &str| both[0].iter().position(|column| column == name).unwrap();
    for row in &both[1..] {
        let number = |name: &str| row[column(name)].parse::<f64>().unwrap();
        assert!(
            number("value") > 0.0 && number("uncertainty") > 0.0 && number("model_value") > 0.0
        );
        assert_eq!(row[column("quantity")], "depth_of_penetration_mm");
    }
    // Another plate: the manifest is removed as its error says, and the answers are those of the plate before.
    let other = CASE.replacen("25 mm", "20 mm", 1);
    assert_ne!(other, CASE);
    fs::write(folder.path().join("scenario.toml"), other).unwrap();
    fs::remove_file(folder.path().join("rows/manifest.json")).unwrap();
    let said = sweep(&folder, &resumed("2"));
    assert_eq!(said.code, 2);
    let words = "its rows are those of another sweep, or of another case";
    assert!(said.stderr.contains(words), "{}", said.stderr);
    fs::write(folder.path().join("rows/axisymmetric.csv"), "a,b\n1,2\n").unwrap();
    let said = sweep(&folder, &resumed("2"));
    assert_eq!(said.code, 2);
    assert!(
        said.stderr
            .contains("its columns are not those of this sweep"),
        "{}",
        said.stderr
    );
}
