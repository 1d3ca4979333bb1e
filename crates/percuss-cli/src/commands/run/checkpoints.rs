//! Checkpoints of a run in its folder: written at intervals and when the user stops the run.

use std::{
    fs::{self, File},
    io::{self, Write},
    ops::ControlFlow,
    path::{Path, PathBuf},
    sync::atomic::{AtomicBool, Ordering},
    time::{Duration, Instant},
};

use percuss::{
    input_file,
    model::{CHECKPOINT_START, Checkpoints, memory::memory_limit},
};
use percuss_report::replace_file::replace_file_durably;

use crate::failure::Failure;

/// Name of the file.
const NAME: &str = "checkpoint.percuss";

/// The file of a folder.
pub fn file(folder: &Path) -> PathBuf {
    folder.join(NAME)
}

/// Bytes of a folder's checkpoint, if it has one.
pub fn load(folder: &Path) -> Result<Option<Vec<u8>>, Failure> {
    let path = file(folder);
    // A checkpoint is the memory of a run.
    match input_file::bytes_after(CHECKPOINT_START, &path, memory_limit()) {
        Ok(bytes) => Ok(Some(bytes)),
        // A folder that cannot be written is reported where it is made.
        Err(error)
            if matches!(
                error.kind(),
                io::ErrorKind::NotFound | io::ErrorKind::NotADirectory
            ) =>
        {
            Ok(None)
        }
        Err(error) => Err(input_file::unreadable(&path, error).into()),
    }
}

/// Removes the checkpoint of a completed run.
pub fn remove(folder: &Path) {
    // What is left over is not a failure of the run.
    let _ = fs::remove_file(file(folder));
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        if is_unfinished(&entry.file_name().to_string_lossy()) {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Whether a file is a checkpoint that a killed run was writing.
fn is_unfinished(name: &str) -> bool {
    name.starts_with(&format!(".{NAME}.")) && name.ends_with(".tmp")
}

/// Writer of checkpoints: at intervals and when the run stops.
pub struct CheckpointWriter<'a> {
    folder: PathBuf,
    interval: Duration,
    last: Instant,
    stop: &'a AtomicBool,
    /// Error of the last checkpoint, if it could not be written.
    pub failure: Option<Failure>,
}

impl<'a> CheckpointWriter<'a> {
    /// Creates the writer; the run leaves a checkpoint and stops when `stop` becomes true.
    pub fn new(folder: &Path, interval: Duration, stop: &'a AtomicBool) -> Self {
        Self {
            folder: folder.to_owned(),
            interval,
            last: Instant::now(),
            stop,
            failure: None,
        }
    }

    /// Whether the run is to stop.
    pub fn stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

impl Checkpoints for CheckpointWriter<'_> {
    fn is_due(&mut self) -> bool {
        self.stopped() || self.last.elapsed() >= self.interval
    }

    fn is_stopped(&self) -> bool {
        self.stopped()
    }

    fn keep(&mut self, bytes: &[u8]) -> ControlFlow<()> {
        self.last = Instant::now();
        let write = |file: &mut File| file.write_all(bytes);
        if let Err(error) = replace_file_durably(&self.folder, NAME, write) {
            self.failure = Some(error.into());
            return ControlFlow::Break(());
        }
        if self.stopped() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

/// An interval such as `60s`, `5 min` or `1h`.
pub fn interval(text: &str) -> Result<Duration, String> {
    let text = text.trim();
    let end = text
        .find(|c: char| !(c.is_ascii_digit() || c == '.'))
        .unwrap_or(text.len());
    let (number, unit) = text.split_at(end);
    let factor = match unit.trim() {
        "s" => 1.0,
        "min" => 60.0,
        "h" => 3600.0,
        _ => return Err("give a time with its unit: s, min or h, for example 60s".to_owned()),
    };
    match number.parse::<f64>() {
        Ok(number) if number > 0.0 && number * factor <= 1e7 => {
            Ok(Duration::from_secs_f64(number * factor))
        }
        _ => Err("give a positive time, for example 60s or 5min".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_carry_their_unit() {
        assert_eq!(interval("60s"), Ok(Duration::from_secs(60)));
        assert_eq!(interval(" 1.5 min "), Ok(Duration::from_secs(90)));
        assert_eq!(interval("2h"), Ok(Duration::from_secs(7200)));
        for bad in ["60", "", "s", "-1s", "0s", "1 day", "1..2s", "1e9h"] {
            assert!(interval(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_checkpoint_replaces_the_one_before() {
        let folder = tempfile::tempdir().unwrap();
        let stop = AtomicBool::new(false);
        let mut checkpoint_writer = CheckpointWriter::new(folder.path(), Duration::ZERO, &stop);
        assert!(load(folder.path()).unwrap().is_none());
        assert!(checkpoint_writer.is_due());
        assert!(checkpoint_writer.keep(b"one").is_continue());
        assert!(checkpoint_writer.keep(b"two").is_continue());
        assert_eq!(load(folder.path()).unwrap().unwrap(), b"two");
        stop.store(true, Ordering::Relaxed);
        assert!(checkpoint_writer.keep(b"three").is_break());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
        let unfinished = folder.path().join(".checkpoint.percuss.7-0.tmp");
        fs::write(&unfinished, b"killed").unwrap();
        remove(folder.path());
        assert!(!unfinished.exists());
        assert!(load(folder.path()).unwrap().is_none());
        checkpoint_writer.folder = folder.path().join("none");
        assert!(checkpoint_writer.keep(b"four").is_break() && checkpoint_writer.failure.is_some());
    }
}
