//! The folder of a run: a copy of the case, the result, histories and figures.

use std::{
    fs,
    path::{Path, PathBuf},
};

use percuss::{Scenario, compare::Comparison, outcome::RunResult, summary::CaseResults};

use crate::{failure::Failure, progress::Progress, terminal};

/// Name of the copy of the case: one that a user's own file is unlikely to have.
const CASE_COPY: &str = "case-as-run.toml";

/// Makes a folder, and those it stands in, if it does not exist.
pub fn make_folder(path: &Path) -> Result<(), Failure> {
    fs::create_dir_all(path).map_err(|error| {
        let reason = if path.exists() {
            "it exists and is no folder".to_owned()
        } else {
            error.to_string()
        };
        Failure::Write {
            path: path.to_path_buf(),
            reason,
            help: String::new(),
        }
    })
}

/// Whether a result has something to draw and write against time.
pub fn has_history(result: &RunResult) -> bool {
    let history = result.history.as_ref();
    history.is_some_and(|history| !history.samples.is_empty())
}

/// A folder that can be written.
pub struct RunFolder {
    path: PathBuf,
    written: Vec<PathBuf>,
}

impl RunFolder {
    /// Makes the folder and puts a copy of the case into it.
    pub fn create(path: &Path, case: &Path) -> Result<Self, Failure> {
        Self::create_for(path, Some(case))
    }

    /// Makes the folder and puts a copy of the case into it, if there is one.
    pub fn create_for(path: &Path, case: Option<&Path>) -> Result<Self, Failure> {
        make_folder(path)?;
        let mut folder = Self {
            path: path.to_path_buf(),
            written: Vec::new(),
        };
        let Some(case) = case else {
            return Ok(folder);
        };
        let text = fs::read(case).map_err(|error| percuss::Error::Read {
            path: case.to_path_buf(),
            reason: error.to_string(),
            source: Some(error),
        })?;
        folder.put(CASE_COPY, &text)?;
        Ok(folder)
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Notes files that were written to it.
    pub fn add(&mut self, files: impl IntoIterator<Item = PathBuf>) {
        self.written.extend(files);
    }

    /// All files that were written to it.
    pub fn written(self) -> Vec<PathBuf> {
        self.written
    }

    /// Writes everything that a run gives; returns the files. Without a history there is neither file nor figure of one.
    pub fn write(
        mut self,
        scenario: &Scenario,
        result: &RunResult,
        results: &CaseResults,
        progress: &mut Progress,
    ) -> Result<Vec<PathBuf>, Failure> {
        self.put("result.json", terminal::json(results)?.as_bytes())?;
        self.written
            .extend(percuss_report::write_fragments(&self.path, result)?);
        if !has_history(result) {
            return Ok(self.written);
        }
        progress.update(0.0, "writing histories");
        self.written
            .extend(percuss_report::write_histories(&self.path, result)?);
        self.written
            .extend(percuss_report::write_shapes(&self.path, result)?);
        let figures = percuss_report::run_figures(scenario, result)?;
        let count = figures.len() as f64;
        for (i, figure) in figures.iter().enumerate() {
            progress.update(i as f64 / count, &format!("drawing {}", figure.name));
            self.written.extend(figure.write(&self.path)?);
        }
        Ok(self.written)
    }

    /// Writes a comparison: numbers and figure; returns the files.
    pub fn write_comparison(
        mut self,
        scenario: &Scenario,
        comparison: &Comparison,
    ) -> Result<Vec<PathBuf>, Failure> {
        self.put("compare.json", terminal::json(comparison)?.as_bytes())?;
        self.written
            .extend(percuss_report::write_comparison(&self.path, comparison)?);
        if let Some(figure) = percuss_report::compare_figure(scenario, comparison) {
            self.written.extend(figure.write(&self.path)?);
        }
        Ok(self.written)
    }

    /// Writes a file.
    pub fn put(&mut self, name: &str, content: &[u8]) -> Result<(), Failure> {
        let path = self.path.join(name);
        fs::write(&path, content).map_err(Failure::write(&path))?;
        self.written.push(path);
        Ok(())
    }
}
