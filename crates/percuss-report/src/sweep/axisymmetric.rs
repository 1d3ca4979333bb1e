//! File of the axisymmetric answers of a sweep.

use std::path::{Path, PathBuf};

use percuss::{
    input_file::{self, MAX_TABLE_BYTES},
    sweep::{AxisymmetricRow, Sweep},
};

use super::manifest::hash;
use crate::{ReportError, replace_file::replace_file};

/// Error of the CSV writer.
fn table(source: csv::Error) -> ReportError {
    ReportError::Table {
        table: NAME.to_owned(),
        source: source.into(),
    }
}

/// Name of the file.
pub(super) const NAME: &str = "axisymmetric.csv";

/// Axisymmetric answers in a folder of a sweep: `axisymmetric.csv`, one row per run, replaced as each row is added.
#[derive(Debug)]
pub struct AxisymmetricFile {
    folder: PathBuf,
    heading: Vec<String>,
    /// Words of the options that are varied, in the order of the parameters.
    words: Vec<Option<Vec<String>>>,
    /// Hash of the sweep and its case, which every row has.
    sweep: String,
    /// Number of the run and its row.
    rows: Vec<(u64, Vec<String>)>,
}

impl AxisymmetricFile {
    /// Continues the file of a folder, or starts one.
    ///
    /// # Errors
    /// [`ReportError::Sweep`] where a file is there and is none of this sweep.
    pub fn open(folder: &Path, sweep: &Sweep) -> Result<Self, ReportError> {
        let mut heading = vec!["run".to_owned()];
        heading.extend(sweep.axes.iter().map(|axis| axis.column()));
        let rest = [
            "quantity",
            "model_value",
            "value",
            "uncertainty",
            "order",
            "remark",
            "sweep_hash",
        ];
        heading.extend(rest.map(str::to_owned));
        let mut file = Self {
            folder: folder.to_owned(),
            heading,
            words: sweep.axes.iter().map(|axis| axis.words()).collect(),
            sweep: hash(&sweep.content().concat()),
            rows: Vec::new(),
        };
        let path = folder.join(NAME);
        if path.exists() {
            file.read(&path).map_err(|reason| ReportError::Sweep {
                path,
                reason,
                remedy: "delete it, and its rows are computed again".to_owned(),
            })?;
        }
        Ok(file)
    }

    fn read(&mut self, path: &Path) -> Result<(), String> {
        let words = |error: csv::Error| error.to_string();
        let file = input_file::open(path, MAX_TABLE_BYTES).map_err(|error| error.to_string())?;
        let mut reader = csv::Reader::from_reader(file);
        if reader.headers().map_err(words)? != self.heading.as_slice() {
            return Err("its columns are not those of this sweep".to_owned());
        }
        for row in reader.records() {
            let row: Vec<String> = row.map_err(words)?.iter().map(str::to_owned).collect();
            if row.last() != Some(&self.sweep) {
                return Err("its rows are those of another sweep, or of another case".to_owned());
            }
            let index = row[0]
                .parse()
                .map_err(|_| "a row has no number".to_owned())?;
            self.rows.push((index, row));
        }
        Ok(())
    }

    /// Whether it has the row of a run.
    pub fn has(&self, index: u64) -> bool {
        self.rows.iter().any(|row| row.0 == index)
    }

    /// Number of the sweep's model over the axisymmetric one, of every row that has both.
    pub fn ratios(&self) -> Vec<f64> {
        let place = |name: &str| self.heading.iter().position(|column| column == name);
        let Some((model, axisymmetric)) = place("model_value").zip(place("value")) else {
            return Vec::new();
        };
        let number = |row: &[String], place: usize| row[place].parse::<f64>().ok();
        let ratios = self
            .rows
            .iter()
            .filter_map(|(_, row)| Some(number(row, model)? / number(row, axisymmetric)?));
        ratios.filter(|ratio| ratio.is_finite()).collect()
    }

    /// Adds a row and writes the file.
    ///
    /// # Errors
    /// [`ReportError::Write`]; [`ReportError::Table`].
    pub fn add(&mut self, row: &AxisymmetricRow) -> Result<PathBuf, ReportError> {
        let number = |value: Option<f64>| value.map_or_else(String::new, |value| value.to_string());
        let mut fields = vec![row.index.to_string()];
        let inputs = row.inputs.iter().zip(&self.words);
        fields.extend(inputs.map(|(value, words)| match words {
            Some(words) => words[*value as usize].clone(),
            None => value.to_string(),
        }));
        fields.push(
            row.quantity
                .map_or_else(String::new, |quantity| quantity.name().to_owned()),
        );
        let numbers = [row.model_value, row.value, row.uncertainty, row.order];
        fields.extend(numbers.map(number));
        fields.push(row.remark.clone());
        fields.push(self.sweep.clone());
        let place = self.rows.partition_point(|other| other.0 < row.index);
        self.rows.insert(place, (row.index, fields));
        let mut text = csv::Writer::from_writer(Vec::new());
        let rows = self.rows.iter().map(|row| &row.1);
        for fields in std::iter::once(&self.heading).chain(rows) {
            text.write_record(fields).map_err(table)?;
        }
        let content = text
            .into_inner()
            .map_err(|error| table(error.into_error().into()))?;
        replace_file(&self.folder, NAME, &content)
    }
}
