//! Every figure of the documentation is the one that its command in `docs/figures.toml` draws.
//!
//! `REDRAW_FIGURES=all cargo test -p percuss-cli --test all figures::` draws them again; part of a path instead of `all` selects.

use std::{
    collections::{BTreeMap, BTreeSet},
    env, fs,
    io::BufReader,
    path::{Path, PathBuf},
    process::Command,
};

use rayon::prelude::*;
use serde::Deserialize;
use tempfile::TempDir;
use toml_edit::{DocumentMut, value};

const TABLE: &str = "docs/figures.toml";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    figure: Vec<Entry>,
}

/// Pictures of one run of one or more commands.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    commands: Vec<String>,
    /// Place of a picture in the repository, and the file of OUT that it is.
    #[serde(default)]
    files: BTreeMap<String, String>,
    /// Folder that takes every picture of OUT.
    folder: Option<String>,
    /// Commands whose output stands for pictures that take long to draw, and the digest of it all.
    #[serde(default)]
    results: Vec<String>,
    digest: Option<String>,
    /// Script that draws the pictures in a browser.
    script: Option<String>,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn table() -> Vec<Entry> {
    let text = fs::read_to_string(root().join(TABLE)).unwrap();
    toml::from_str::<Table>(&text).unwrap().figure
}

/// Runs a command of the table in the root of the repository and gives what it prints.
fn run(command: &str, out: &Path) -> String {
    let command = command.replace("OUT", &out.display().to_string());
    let output = Command::new(env!("CARGO_BIN_EXE_percuss"))
        .args(command.split_whitespace().skip(1))
        .current_dir(root())
        .output()
        .unwrap();
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command}\n{stderr}");
    String::from_utf8(output.stdout).unwrap()
}

fn pictures_below(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(pictures_below(&path));
        } else if path
            .extension()
            .is_some_and(|end| end == "png" || end == "svg" || end == "gif")
        {
            found.push(path);
        }
    }
    found
}

fn name(path: &Path) -> String {
    path.file_name().unwrap().to_string_lossy().into_owned()
}

/// Whether two files are equal, or PNG files of the same pixels.
fn shows_the_same(stored: &Path, drawn: &Path) -> bool {
    let read = |path: &Path| fs::read(path).ok();
    read(stored) == read(drawn) || pixels(stored).is_some_and(|of| Some(of) == pixels(drawn))
}

/// Width, kind and values of the pixels of a PNG file.
fn pixels(path: &Path) -> Option<(u32, png::ColorType, Vec<u8>)> {
    let file = BufReader::new(fs::File::open(path).ok()?);
    let mut reader = png::Decoder::new(file).read_info().ok()?;
    let mut bytes = vec![0; reader.output_buffer_size()?];
    let frame = reader.next_frame(&mut bytes).ok()?;
    Some((frame.width, frame.color_type, bytes))
}

impl Entry {
    fn is_drawn(&self) -> bool {
        self.script.is_none() && self.digest.is_none()
    }

    /// Pictures in the repository, by their places in it.
    fn places(&self) -> BTreeSet<String> {
        let mut places: BTreeSet<String> = self.files.keys().cloned().collect();
        if let Some(folder) = &self.folder {
            let pictures = pictures_below(&root().join(folder));
            places.extend(
                pictures
                    .iter()
                    .map(|path| format!("{folder}/{}", name(path))),
            );
        }
        places
    }

    fn draw(&self) -> TempDir {
        let out = TempDir::new().unwrap();
        for command in &self.commands {
            run(command, out.path());
        }
        out
    }

    /// Places of the pictures that the commands have drawn, with the files of OUT.
    fn drawn(&self, out: &Path) -> BTreeMap<String, PathBuf> {
        let mut drawn: BTreeMap<String, PathBuf> = BTreeMap::new();
        for (place, file) in &self.files {
            drawn.insert(place.clone(), out.join(file));
        }
        if let Some(folder) = &self.folder {
            let pictures = pictures_below(out).into_iter();
            // Only PNG files are kept: an SVG file of each stands beside it in OUT.
            for path in pictures.filter(|path| path.extension().is_some_and(|end| end == "png")) {
                drawn.insert(format!("{folder}/{}", name(&path)), path);
            }
        }
        drawn
    }

    /// Pictures that the commands no longer draw, or draw differently.
    fn stale(&self) -> Vec<String> {
        let out = self.draw();
        let drawn = self.drawn(out.path());
        let missing = self
            .places()
            .into_iter()
            .filter(|place| !drawn.contains_key(place));
        let mut stale: Vec<String> = missing
            .map(|place| format!("{place}: no longer drawn"))
            .collect();
        for (place, file) in drawn {
            if !shows_the_same(&root().join(&place), &file) {
                stale.push(place);
            }
        }
        stale
    }

    /// Digest of the commands, of the files that they name and of what stands for the pictures.
    fn digest_now(&self) -> String {
        let mut text = self.commands.join("\n");
        for word in self
            .commands
            .iter()
            .flat_map(|line| line.split_whitespace())
        {
            let file = root().join(word);
            if file.is_file() {
                text += &fs::read_to_string(file).unwrap();
            }
        }
        for command in &self.results {
            text += &run(command, Path::new("none"));
        }
        // FNV-1a: the same on every machine and in every version.
        let hash = text.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
        format!("{hash:016x}")
    }
}

/// One value of one pixel makes another picture; how a picture is packed does not.
#[test]
fn pictures_differ_by_one_pixel() {
    let folder = TempDir::new().unwrap();
    let picture = |name: &str, value: u8, filter: png::Filter| {
        let path = folder.path().join(name);
        let mut encoder = png::Encoder::new(fs::File::create(&path).unwrap(), 3, 2);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_filter(filter);
        let mut bytes = [200; 18];
        bytes[10] = value;
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(&bytes).unwrap();
        path
    };
    let one = picture("one.png", 7, png::Filter::NoFilter);
    let packed = picture("packed.png", 7, png::Filter::Up);
    let other = picture("other.png", 8, png::Filter::NoFilter);
    assert_ne!(fs::read(&one).unwrap(), fs::read(&packed).unwrap());
    assert!(shows_the_same(&one, &packed) && !shows_the_same(&one, &other));
    assert!(!shows_the_same(&one, &folder.path().join("missing.png")));
}

#[test]
fn every_picture_is_in_the_table_once() {
    let root = root();
    let mut listed = BTreeSet::new();
    for entry in table() {
        for place in entry.places() {
            assert!(
                listed.insert(place.clone()),
                "{place} stands twice in {TABLE}"
            );
        }
    }
    let found: BTreeSet<String> = ["docs", "cases"]
        .iter()
        .flat_map(|folder| pictures_below(&root.join(folder)))
        .map(|path| path.strip_prefix(&root).unwrap().display().to_string())
        .collect();
    assert_eq!(found, listed, "{TABLE} and the pictures differ");
}

#[test]
fn every_command_of_the_table_is_one() {
    for entry in table() {
        for command in entry.commands.iter().chain(&entry.results) {
            let parsed = percuss_cli::command().try_get_matches_from(command.split_whitespace());
            assert!(parsed.is_ok(), "{command}: {}", parsed.unwrap_err());
        }
        assert_eq!(entry.digest.is_some(), !entry.results.is_empty());
        assert!(entry.script.is_some() || !entry.commands.is_empty());
    }
}

#[test]
fn pictures_of_the_page_are_those_of_its_script() {
    for entry in table() {
        let Some(script) = &entry.script else {
            continue;
        };
        let text = fs::read_to_string(root().join(script)).unwrap();
        for (place, name) in &entry.files {
            let is_drawn = text.contains(&format!("\"{name}\""))
                || text.contains(&format!("\"serve-{name}\""));
            assert!(is_drawn, "{script} draws no `{name}`, which {place} is");
        }
    }
}

/// Draws the pictures whose path contains a text again.
fn redraw(selected: &str) {
    let path = root().join(TABLE);
    let mut document: DocumentMut = fs::read_to_string(&path).unwrap().parse().unwrap();
    let tables = document["figure"].as_array_of_tables_mut().unwrap();
    for (entry, row) in table().iter().zip(tables.iter_mut()) {
        let places = entry.places();
        let is_selected = selected == "all" || places.iter().any(|place| place.contains(selected));
        if !is_selected || entry.script.is_some() {
            continue;
        }
        let out = entry.draw();
        for (place, file) in entry.drawn(out.path()) {
            fs::copy(&file, root().join(&place)).unwrap_or_else(|error| panic!("{place}: {error}"));
            println!("{place}");
        }
        if entry.digest.is_some() {
            row["digest"] = value(entry.digest_now());
        }
    }
    fs::write(path, document.to_string()).unwrap();
}

#[test]
fn pictures_are_what_their_commands_draw() {
    if let Some(selected) = env::var_os("REDRAW_FIGURES") {
        redraw(&selected.to_string_lossy());
        return;
    }
    let table = table();
    // One after the other they take longer than all other tests of this program together.
    let stale: Vec<String> = table
        .par_iter()
        .filter(|entry| entry.is_drawn())
        .flat_map_iter(Entry::stale)
        .collect();
    assert!(
        stale.is_empty(),
        "out of date:\n{}\n{HINT}",
        stale.join("\n")
    );
}

const HINT: &str = "look at what has changed, then draw with REDRAW_FIGURES=PART_OF_A_PATH";

#[test]
fn results_behind_slow_pictures_are_unchanged() {
    if env::var_os("REDRAW_FIGURES").is_some() {
        return;
    }
    let mut stale = Vec::new();
    for entry in table() {
        if let Some(digest) = &entry.digest
            && *digest != entry.digest_now()
        {
            stale.extend(entry.places());
        }
    }
    assert!(
        stale.is_empty(),
        "may be out of date:\n{}\n{HINT}",
        stale.join("\n")
    );
}
