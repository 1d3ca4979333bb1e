//! A series of fields on disk: one file per frame, and the collection that ParaView opens, at any time of a run.

use std::{
    fmt::Write,
    fs,
    path::{Path, PathBuf},
};

use percuss::{
    frames::Frame,
    input_file::{self, MAX_TABLE_BYTES},
};

use super::{FrameSelection, vtp};
use crate::{ReportError, replace_file::replace_file};

/// Name of the collection.
const COLLECTION: &str = "fields.pvd";
/// Folder of the files.
const FOLDER: &str = "fields";

/// A series of fields that grows with a run, in a folder.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldSeries {
    folder: PathBuf,
    selection: FrameSelection,
    entries: Vec<Entry>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Entry {
    number: u64,
    time: f64,
}

impl FieldSeries {
    /// An empty series of at most a number of frames, 2 or more; files of an earlier one are removed.
    ///
    /// # Errors
    /// [`ReportError::Write`].
    pub fn create(folder: &Path, most: usize) -> Result<Self, ReportError> {
        Self::resume(folder, most, f64::NEG_INFINITY)
    }

    /// The series of a run that is taken up again at a time [s]: later frames are removed.
    ///
    /// # Errors
    /// [`ReportError::Write`].
    pub fn resume(folder: &Path, most: usize, time: f64) -> Result<Self, ReportError> {
        let text = input_file::text(&folder.join(COLLECTION), MAX_TABLE_BYTES).unwrap_or_default();
        let (entries, later): (Vec<Entry>, Vec<Entry>) = text
            .lines()
            .filter_map(Entry::read)
            .partition(|entry| entry.time <= time);
        let numbers = entries.iter().map(|entry| entry.number).collect();
        let series = Self {
            folder: folder.to_owned(),
            selection: FrameSelection::resumed(most, numbers),
            entries,
        };
        for entry in later {
            series.remove(entry);
        }
        series.collect()?;
        Ok(series)
    }

    /// Adds a frame, unless the stride passes over it.
    ///
    /// # Errors
    /// [`ReportError::Write`].
    pub fn add(&mut self, frame: &Frame<'_>) -> Result<(), ReportError> {
        // A run that is repeated with a smaller Courant number starts again.
        if frame.step == 0 {
            for entry in std::mem::take(&mut self.entries) {
                self.remove(entry);
            }
            self.selection.restart();
        }
        let Some(dropped) = self.selection.add(frame.number, frame.last) else {
            return Ok(());
        };
        let entry = Entry {
            number: frame.number,
            time: frame.time,
        };
        let folder = self.folder.join(FOLDER);
        replace_file(&folder, &entry.file(), &vtp::encode(frame))?;
        self.entries.push(entry);
        let (dropped, kept): (Vec<Entry>, Vec<Entry>) = std::mem::take(&mut self.entries)
            .into_iter()
            .partition(|entry| dropped.contains(&entry.number));
        self.entries = kept;
        for entry in dropped {
            self.remove(entry);
        }
        self.collect()
    }

    /// Removes the files of the series, with the collection and the folder that they stand in.
    pub fn discard(self) {
        for entry in &self.entries {
            self.remove(*entry);
        }
        // What cannot be removed does no harm; a folder with files of others stays.
        let _ = fs::remove_file(self.collection());
        let _ = fs::remove_dir(self.folder.join(FOLDER));
    }

    /// The collection that ParaView opens.
    pub fn collection(&self) -> PathBuf {
        self.folder.join(COLLECTION)
    }

    /// Number of each frame and its file.
    pub(crate) fn files(&self) -> Vec<(u64, PathBuf)> {
        let folder = self.folder.join(FOLDER);
        let entries = self.entries.iter();
        entries
            .map(|entry| (entry.number, folder.join(entry.file())))
            .collect()
    }

    /// Frames in the series.
    pub fn frames(&self) -> usize {
        self.entries.len()
    }

    fn remove(&self, entry: Entry) {
        // A file that is not there any more is as good as removed, and one too many does no harm: the collection has it not.
        let _ = fs::remove_file(self.folder.join(FOLDER).join(entry.file()));
    }

    fn collect(&self) -> Result<(), ReportError> {
        let mut text = String::from(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n",
        );
        for entry in &self.entries {
            // Writing to a string does not fail.
            let _ = writeln!(
                text,
                r#"<DataSet timestep="{:e}" part="0" file="{FOLDER}/{}"/>"#,
                entry.time,
                entry.file()
            );
        }
        text += "</Collection>\n</VTKFile>\n";
        replace_file(&self.folder, COLLECTION, text.as_bytes()).map(|_| ())
    }
}

impl Entry {
    fn file(self) -> String {
        format!("frame-{:05}.vtp", self.number)
    }

    /// From its line in the collection.
    fn read(line: &str) -> Option<Self> {
        let (_, rest) = line.split_once("timestep=\"")?;
        let (time, rest) = rest.split_once('"')?;
        let (_, number) = rest.split_once("frame-")?;
        let (number, _) = number.split_once(".vtp")?;
        Some(Self {
            number: number.parse().ok()?,
            time: time.parse().ok()?,
        })
    }
}

#[cfg(test)]
mod tests {
    use percuss::frames::Fields;

    use super::*;

    fn add(series: &mut FieldSeries, number: u64, last: bool) {
        let frame = Frame {
            number,
            last,
            step: number,
            time: number as f64,
            depth: 0.0,
            fields: Fields::Elements(Vec::new()),
        };
        series.add(&frame).unwrap();
    }

    #[test]
    fn a_long_series_thins_out_and_a_resumed_one_is_the_same() {
        for most in [9, 128] {
            let folder = tempfile::tempdir().unwrap();
            let mut series = FieldSeries::create(folder.path(), most).unwrap();
            for number in 0..1000 {
                add(&mut series, number, false);
            }
            assert!((most / 2..=most).contains(&series.frames()), "{most}");
            assert!(series.files().iter().all(|(_, file)| file.exists()));
            let mut resumed = FieldSeries::resume(folder.path(), most, 900.5).unwrap();
            for number in 901..1000 {
                add(&mut resumed, number, false);
            }
            assert_eq!(resumed, series);
            add(&mut series, 1001, true);
            add(&mut series, 1001, true);
            assert_eq!(series.files().last().unwrap().0, 1001);
            assert!(series.frames() <= most, "{most}");
            let files = fs::read_dir(folder.path().join(FOLDER)).unwrap().count();
            assert_eq!(files, series.frames());
            let cleared = FieldSeries::create(folder.path(), most).unwrap();
            assert_eq!(cleared.frames(), 0);
            assert_eq!(fs::read_dir(folder.path().join(FOLDER)).unwrap().count(), 0);
        }
    }

    #[test]
    fn a_run_that_starts_again_starts_its_series_again() {
        let folder = tempfile::tempdir().unwrap();
        let mut series = FieldSeries::create(folder.path(), 9).unwrap();
        for number in (0..20).chain(0..3) {
            add(&mut series, number, false);
        }
        assert_eq!(series.frames(), 3);
        assert_eq!(fs::read_dir(folder.path().join(FOLDER)).unwrap().count(), 3);
    }

    #[test]
    fn a_discarded_series_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let mut series = FieldSeries::create(folder.path(), 4).unwrap();
        for number in 0..9 {
            add(&mut series, number, number == 8);
        }
        assert!(series.frames() > 1 && series.collection().exists());
        series.discard();
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
