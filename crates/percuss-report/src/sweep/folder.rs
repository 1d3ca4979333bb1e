//! Folder of a sweep: its state, and the computation of missing blocks.

use std::{
    fs::{self, File, TryLockError},
    io::{ErrorKind, Write},
    path::{Path, PathBuf},
    sync::atomic::{AtomicBool, Ordering},
};

use bytes::Bytes;
use parquet::file::reader::{FileReader, SerializedFileReader};
use percuss::{
    cost,
    input_file::{self, MAX_BLOCK_BYTES, MAX_OWN_BYTES},
    sweep::{Kernel, Sweep, SweepRow},
};
use rayon::prelude::*;

use super::{
    block_file, checksum,
    columns::columns,
    manifest::{self, Manifest},
};
use crate::{ReportError, column, replace_file::replace_file_durably};

/// Name of the file that the computing process holds locked; the system lets go of it however the process ends.
pub(super) const LOCK: &str = "lock";

/// A folder that this process alone writes results to.
#[derive(Debug)]
pub struct SweepFolder {
    path: PathBuf,
    manifest: Manifest,
    _lock: File,
}

/// How far a folder has come.
#[derive(Debug, Clone, PartialEq)]
pub struct Status {
    /// Manifest of the sweep.
    pub manifest: Manifest,
    /// Completed blocks.
    pub done: Vec<u64>,
    /// Blocks whose file is damaged; they are computed again.
    pub damaged: Vec<u64>,
    /// Whether a process is computing it.
    pub running: bool,
}

impl Status {
    /// Completed runs.
    pub fn runs_done(&self) -> u64 {
        self.done
            .iter()
            .map(|block| self.manifest.runs_in(*block))
            .sum()
    }
}

impl SweepFolder {
    /// Makes the folder of a sweep, or takes one that holds a part of it when `resume` says so.
    ///
    /// # Errors
    /// [`ReportError::Sweep`] when the folder holds another sweep, or this one without `resume`, or another process writes to
    /// it; [`ReportError::Write`].
    pub fn open(path: &Path, sweep: &Sweep, resume: bool) -> Result<Self, ReportError> {
        let fail = |reason: String, remedy: &str| ReportError::Sweep {
            path: path.to_owned(),
            reason,
            remedy: remedy.to_owned(),
        };
        let write = |path: &Path| {
            let path = path.to_owned();
            move |source| ReportError::Write { path, source }
        };
        fs::create_dir_all(path).map_err(write(path))?;
        let lock = lock_file(path).map_err(write(&path.join(LOCK)))?;
        match lock.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                return Err(fail(
                    "another process is computing this folder".to_owned(),
                    "wait for it, or give every process a folder of its own and merge them",
                ));
            }
            Err(TryLockError::Error(source)) => return Err(write(&path.join(LOCK))(source)),
        }
        let manifest = Manifest::new(sweep);
        match Manifest::read(path)? {
            None => {
                replace_file_durably(path, manifest::NAME, |file| {
                    file.write_all(manifest.text().as_bytes())
                })?;
            }
            Some(found) => {
                if let Some(difference) = manifest.difference(&found) {
                    let reason = format!("the folder holds another sweep: {difference}");
                    return Err(fail(reason, "use another folder, or empty this one"));
                }
                if !resume {
                    return Err(fail(
                        "the folder holds this sweep already".to_owned(),
                        "`--resume` computes what it lacks",
                    ));
                }
            }
        }
        remove_leftovers(path).map_err(write(path))?;
        Ok(Self {
            path: path.to_owned(),
            manifest,
            _lock: lock,
        })
    }

    /// What is computed.
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// The blocks that are missing of part `part` of `parts`, counted from 1, which share the blocks in turn.
    pub fn missing(&self, part: u64, parts: u64) -> Vec<u64> {
        (0..self.manifest.blocks())
            .filter(|block| block % parts == part - 1)
            .filter(|block| state(&self.path, &self.manifest, *block) != State::Done)
            .collect()
    }

    /// Computes blocks and writes a file for each, with as many threads as there are in the pool, or as the memory takes. `done` gets the
    /// rows of each block once they are on the disk. Returns whether all were computed: `stop` ends it early.
    ///
    /// # Errors
    /// [`ReportError::Write`] and [`ReportError::Table`]; files that were written stay.
    pub fn compute(
        &self,
        sweep: &Sweep,
        kernel: &dyn Kernel,
        blocks: &[u64],
        stop: &AtomicBool,
        done: &(dyn Fn(&[SweepRow]) + Sync),
    ) -> Result<bool, ReportError> {
        // One block at a time for each thread, in order, so that little is lost when the sweep is ended.
        let result = cost::within_memory(sweep.memory_of_thread(), || {
            blocks
                .par_iter()
                .with_max_len(1)
                .try_for_each(|block| self.compute_block(sweep, kernel, *block, stop, done))
        });
        match result {
            Ok(()) if !self.path.join(manifest::NAME).exists() => Err(ReportError::Write {
                path: self.path.clone(),
                source: std::io::Error::new(ErrorKind::NotFound, "the folder was removed"),
            }),
            Ok(()) => Ok(true),
            Err(None) => Ok(false),
            Err(Some(error)) => Err(error),
        }
    }

    fn compute_block(
        &self,
        sweep: &Sweep,
        kernel: &dyn Kernel,
        block: u64,
        stop: &AtomicBool,
        done: &(dyn Fn(&[SweepRow]) + Sync),
    ) -> Result<(), Option<ReportError>> {
        if stop.load(Ordering::Relaxed) {
            return Err(None);
        }
        let computed = Block::compute(sweep, kernel, block, stop)?.ok_or(None)?;
        self.write(block, &computed.content)?;
        done(&computed.rows);
        Ok(())
    }

    /// Takes the file of a block that was computed elsewhere.
    ///
    /// # Errors
    /// [`ReportError::Sweep`] when it is not the whole of this block of this sweep; [`ReportError::Write`].
    pub fn put(&self, block: u64, content: &[u8]) -> Result<(), ReportError> {
        let found = match block < self.manifest.blocks() {
            true => state_of(Bytes::copy_from_slice(content), &self.manifest, block),
            false => State::Missing,
        };
        if found != State::Done {
            return Err(ReportError::Sweep {
                path: self.path.join(block_file(block)),
                reason: "what was computed elsewhere is not this block of this sweep".to_owned(),
                remedy: "compute it with the same version of the program".to_owned(),
            });
        }
        self.write(block, content)
    }

    fn write(&self, block: u64, content: &[u8]) -> Result<(), ReportError> {
        replace_file_durably(&self.path, &block_file(block), |file| {
            file.write_all(content)
        })?;
        Ok(())
    }
}

/// A block that was computed, wherever that was.
#[derive(Debug)]
pub struct Block {
    /// What its file holds: [`SweepFolder::put`] takes it.
    pub content: Vec<u8>,
    /// Its rows.
    pub rows: Vec<SweepRow>,
}

impl Block {
    /// Computes a block of a sweep; `None` when `stop` ended it.
    ///
    /// # Errors
    /// [`ReportError::Table`].
    pub fn compute(
        sweep: &Sweep,
        kernel: &dyn Kernel,
        block: u64,
        stop: &AtomicBool,
    ) -> Result<Option<Self>, ReportError> {
        let runs = sweep.block(block).map(|run| sweep.run(run)).collect();
        let Ok(rows) = kernel.rows(runs, stop) else {
            return Ok(None);
        };
        let name = block_file(block);
        let notes = checksum::notes(&Manifest::new(sweep), block);
        let mut content = column::parquet_with(&name, &columns(sweep), &rows, &notes)?;
        checksum::close(&mut content);
        Ok(Some(Self { content, rows }))
    }
}

/// How far a folder has come.
///
/// # Errors
/// [`ReportError::Sweep`] when it is no folder of a sweep; [`ReportError::Read`].
pub fn status(path: &Path) -> Result<Status, ReportError> {
    let manifest = manifest_of(path)?;
    let mut status = Status {
        done: Vec::new(),
        damaged: Vec::new(),
        // A folder that cannot be written to cannot be computed either.
        running: input_file::open(&path.join(LOCK), MAX_OWN_BYTES)
            .is_ok_and(|lock| matches!(lock.try_lock_shared(), Err(TryLockError::WouldBlock))),
        manifest,
    };
    for block in 0..status.manifest.blocks() {
        match state(path, &status.manifest, block) {
            State::Done => status.done.push(block),
            State::Damaged => status.damaged.push(block),
            State::Missing => {}
        }
    }
    Ok(status)
}

/// The manifest of a folder that should have one.
pub(super) fn manifest_of(path: &Path) -> Result<Manifest, ReportError> {
    let fails = |reason: &str| ReportError::Sweep {
        path: path.to_owned(),
        reason: reason.to_owned(),
        remedy: "give a folder that `percuss sweep` wrote".to_owned(),
    };
    if path.is_file() {
        return Err(fails("this is a file, and a folder of a sweep is due here"));
    }
    if !path.exists() {
        return Err(ReportError::Read {
            path: path.to_owned(),
            reason: "there is no such folder: give one that `percuss sweep` wrote".to_owned(),
        });
    }
    let none = || fails("this is no folder of a sweep: it has no manifest.json");
    Manifest::read(path)?.ok_or_else(none)
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    Missing,
    Damaged,
    Done,
}

/// What there is of a block. Its checksum tells whether a byte was lost or changed, its name whether it is this block.
pub(super) fn state(folder: &Path, manifest: &Manifest, block: u64) -> State {
    let content = match input_file::bytes(&folder.join(block_file(block)), MAX_BLOCK_BYTES) {
        Ok(content) => content,
        Err(error) if error.kind() == ErrorKind::NotFound => return State::Missing,
        Err(_) => return State::Damaged,
    };
    state_of(content.into(), manifest, block)
}

fn state_of(content: Bytes, manifest: &Manifest, block: u64) -> State {
    if !checksum::is_whole(&content) {
        return State::Damaged;
    }
    let Ok(reader) = SerializedFileReader::new(content) else {
        return State::Damaged;
    };
    let metadata = reader.metadata().file_metadata();
    let fields = metadata.schema_descr().columns();
    let names = fields.iter().map(|field| field.name());
    let notes = metadata.key_value_metadata();
    let name = notes.and_then(|notes| notes.iter().find(|note| note.key == checksum::BLOCK));
    let of_block =
        name.is_some_and(|name| name.value == Some(checksum::block_name(manifest, block)));
    let whole = of_block
        && metadata.num_rows() as u64 == manifest.runs_in(block)
        && reader.num_row_groups() == 1
        && names.eq(manifest.columns.iter().map(|column| column.name.as_str()));
    if whole { State::Done } else { State::Damaged }
}

fn lock_file(folder: &Path) -> std::io::Result<File> {
    // A pipe in its place would block.
    match input_file::open(&folder.join(LOCK), MAX_OWN_BYTES) {
        Err(error) if error.kind() != ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    File::options()
        .create(true)
        .truncate(false)
        .write(true)
        .open(folder.join(LOCK))
}

/// Removes files that a process which was killed had not yet renamed.
fn remove_leftovers(folder: &Path) -> std::io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let ours = name.starts_with(".block-") || name.starts_with(".manifest.json");
        if ours && name.ends_with(".tmp") {
            fs::remove_file(entry.path())?;
        }
    }
    Ok(())
}
