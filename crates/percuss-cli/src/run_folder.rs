//! Output folder of a run: copy of the case, result, histories and figures.

use std::{
    fs, io,
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
};

use percuss::{
    Scenario,
    case::{self, Document},
    compare::Comparison,
    outcome::RunResult,
    summary::CaseResults,
    units::UnitSystem,
};
use percuss_report::{Figure, FigureFormat};

use crate::{failure::Failure, output};

/// Name of the copy of the case, unlikely to exist in the folder of a user.
const CASE_COPY: &str = "case-as-run.toml";

/// Makes a folder and its parents, if they do not exist.
pub fn make_folder(path: &Path) -> Result<(), Failure> {
    fs::create_dir_all(path).map_err(|error| {
        let (reason, help) = if path.exists() {
            let reason = "it exists and is not a folder";
            (reason.to_owned(), "give another folder".to_owned())
        } else {
            (error.to_string(), help_for_folder(error.kind()))
        };
        Failure::Write {
            path: path.to_path_buf(),
            reason,
            help,
        }
    })
}

/// Help for a folder that cannot be made.
fn help_for_folder(kind: io::ErrorKind) -> String {
    let why = match kind {
        io::ErrorKind::NotADirectory | io::ErrorKind::AlreadyExists => {
            "a part of its path is a file: "
        }
        io::ErrorKind::PermissionDenied => "you may not write there: ",
        _ => "",
    };
    format!("{why}give a folder that can be made, or one that you may write to")
}

/// Whether a result has time histories.
pub fn has_history(result: &RunResult) -> bool {
    let history = result.history.as_ref();
    history.is_some_and(|history| !history.samples.is_empty())
}

/// Names of the files of a folder that are not among those written, `None` without any: those of an earlier run would be taken for this one's.
pub fn others(folder: &Path, written: &[PathBuf]) -> Option<String> {
    const MOST: usize = 12;
    let entries = fs::read_dir(folder).ok()?.flatten();
    let files = entries.filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_file()));
    let mut names: Vec<String> = files
        .map(|entry| entry.file_name())
        .filter(|name| !written.iter().any(|file| file.file_name() == Some(name)))
        .map(|name| name.to_string_lossy().into_owned())
        .collect();
    names.sort_unstable();
    let more = names.len().saturating_sub(MOST);
    names.truncate(MOST);
    let listed = names.join(", ");
    match more {
        0 => (!names.is_empty()).then_some(listed),
        more => Some(format!("{listed} and {more} more")),
    }
}

/// Output folder with the list of its files.
pub struct RunFolder {
    path: PathBuf,
    formats: Vec<FigureFormat>,
    written: Vec<PathBuf>,
    /// Text of the copy of the case; empty without one.
    case_copy: String,
}

impl RunFolder {
    /// Makes the folder, if one is requested, with a self-contained copy of the case, if there is one. Call it before a long run, so
    /// that a folder that cannot be written is reported at once.
    /// Figures are written in these formats.
    pub fn wanted(
        path: Option<&Path>,
        case: Option<&Document>,
        formats: &[FigureFormat],
    ) -> Result<Option<Self>, Failure> {
        let Some(path) = path else { return Ok(None) };
        let mut folder = Self::create(path, case)?;
        folder.formats = formats.to_vec();
        Ok(Some(folder))
    }

    /// Makes the folder and puts a copy of the case into it, if there is one.
    pub fn create(path: &Path, case: Option<&Document>) -> Result<Self, Failure> {
        make_folder(path)?;
        let mut folder = Self {
            path: path.to_path_buf(),
            formats: FigureFormat::DEFAULT.to_vec(),
            written: Vec::new(),
            case_copy: String::new(),
        };
        if let Some(case) = case {
            let copy = case::self_contained(case)?;
            folder.put(CASE_COPY, copy.as_bytes())?;
            folder.case_copy = copy;
        }
        Ok(folder)
    }

    /// Writes numbers of elements into a table of the copy of the case, which then gives the results of this mesh.
    pub fn put_mesh(&self, table: &str, elements: &[(&str, usize)]) -> Result<(), Failure> {
        // The copy is a case that was read.
        let Ok(mut copy) = self.case_copy.parse::<toml_edit::DocumentMut>() else {
            return Ok(());
        };
        for (key, count) in elements {
            copy[table][*key] = toml_edit::value(*count as i64);
        }
        let text = copy.to_string();
        percuss_report::replace_file::replace_file(&self.path, CASE_COPY, text.as_bytes())?;
        Ok(())
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Adds files to the list.
    pub fn add(&mut self, files: impl IntoIterator<Item = PathBuf>) {
        self.written.extend(files);
    }

    /// All files that were written to it.
    pub fn written(self) -> Vec<PathBuf> {
        self.written
    }

    /// Writes the result, histories and figures of a run; returns the files.
    pub fn write(
        mut self,
        scenario: &Scenario,
        result: &RunResult,
        results: &CaseResults,
        units: Option<UnitSystem>,
        report: &mut (dyn FnMut(f64, &str) + Send),
    ) -> Result<Vec<PathBuf>, Failure> {
        self.put("result.json", output::json(results)?.as_bytes())?;
        self.written
            .extend(percuss_report::write_fragments(&self.path, result, units)?);
        if !has_history(result) {
            return Ok(self.written);
        }
        report(0.0, "writing histories");
        self.written
            .extend(percuss_report::write_histories(&self.path, result, units)?);
        self.written
            .extend(percuss_report::write_shapes(&self.path, result)?);
        let figures = percuss_report::run_figures(scenario, result)?;
        let report = Mutex::new(report);
        let drawn = |finished: usize, name: &str| {
            let part = finished as f64 / figures.len() as f64;
            let mut report = report.lock().unwrap_or_else(PoisonError::into_inner);
            report(part, &format!("drawn {name}"));
        };
        let files = percuss_report::write_figures(&self.path, &figures, &self.formats, &drawn)?;
        self.written.extend(files);
        Ok(self.written)
    }

    /// Writes numbers and figure of a comparison; returns the files.
    pub fn write_comparison(
        mut self,
        scenario: &Scenario,
        comparison: &Comparison,
        units: Option<UnitSystem>,
    ) -> Result<Vec<PathBuf>, Failure> {
        self.put("compare.json", output::json(comparison)?.as_bytes())?;
        self.written.extend(percuss_report::write_comparison(
            &self.path, comparison, units,
        )?);
        self.add_figures(&percuss_report::compare_figures(scenario, comparison))?;
        Ok(self.written)
    }

    /// Writes figures.
    pub fn add_figures(&mut self, figures: &[Figure]) -> Result<(), Failure> {
        let files = percuss_report::write_figures(&self.path, figures, &self.formats, &|_, _| ())?;
        self.add(files);
        Ok(())
    }

    /// Writes a file, or leaves the former one of this name as it is.
    pub fn put(&mut self, name: &str, content: &[u8]) -> Result<(), Failure> {
        let path = percuss_report::replace_file::replace_file(&self.path, name, content)?;
        self.written.push(path);
        Ok(())
    }
}
