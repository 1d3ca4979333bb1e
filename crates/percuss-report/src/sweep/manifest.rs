//! Manifest of a folder: identity of its sweep.

use std::path::Path;

use percuss::{
    input_file::{self, MAX_TABLE_BYTES},
    sweep::{Axis, Sweep},
};
use serde::{Deserialize, Serialize};

use super::{checksum, columns::columns};
use crate::ReportError;

/// Name of the file.
pub(super) const NAME: &str = "manifest.json";

/// Identity of a sweep: two folders with the same manifest have the same rows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Version of this layout.
    pub format: u32,
    /// Version of the program that computes it.
    pub percuss_version: String,
    /// Title of the sweep.
    pub title: String,
    /// Name of the case that is varied.
    pub case: String,
    /// Title of the base case; empty where it has none.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub case_title: String,
    /// Name of the model.
    pub model: String,
    /// Design of experiments.
    pub design: String,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Number of runs.
    pub runs: u64,
    /// Runs per block; the last block may have fewer.
    pub block_size: u64,
    /// Hash of the sweep file without its comments (FNV-1a, 128 bits).
    pub sweep_hash: String,
    /// Hash of the base case and its material files without their comments.
    pub case_hash: String,
    /// Varied parameters, in the order of the sweep file.
    pub parameters: Vec<Varied>,
    /// The columns of every file.
    pub columns: Vec<ColumnName>,
}

/// A number or an option that is varied.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Varied {
    /// Dotted key in the case.
    pub key: String,
    /// Unit of its values; empty for plain numbers and words.
    pub unit: String,
    /// Its column.
    pub column: String,
    /// What gives its values: `values`, `linear`, `log`, or a distribution.
    pub kind: String,
    /// Number of values; null for a distribution.
    pub count: Option<u64>,
    /// The words that it can be; empty for numbers.
    pub words: Vec<String>,
}

/// A column.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ColumnName {
    /// Its name, which ends with the unit.
    pub name: String,
    /// `number`, `integer` or `text`.
    pub kind: String,
}

impl Manifest {
    /// The manifest of a sweep.
    pub fn new(sweep: &Sweep) -> Self {
        let [file, case] = sweep.content().map(hash);
        let name = |column: &crate::column::Column<_>| ColumnName {
            name: column.name().to_owned(),
            kind: column.kind().to_owned(),
        };
        Self {
            format: 3,
            percuss_version: env!("CARGO_PKG_VERSION").to_owned(),
            title: sweep.title.clone(),
            case: sweep.case().to_owned(),
            case_title: sweep.case_title().to_owned(),
            model: sweep.model.name().to_owned(),
            design: sweep.design().name().to_owned(),
            seed: sweep.seed,
            runs: sweep.runs(),
            block_size: sweep.block_size,
            sweep_hash: file,
            case_hash: case,
            parameters: sweep.axes.iter().map(varied).collect(),
            columns: columns(sweep).iter().map(name).collect(),
        }
    }

    /// Number of blocks.
    pub fn blocks(&self) -> u64 {
        self.runs.div_ceil(self.block_size)
    }

    /// Number of runs in a block.
    pub fn runs_in(&self, block: u64) -> u64 {
        self.block_size.min(self.runs - block * self.block_size)
    }

    /// Reads the manifest of a folder; `None` when it has none.
    pub(super) fn read(folder: &Path) -> Result<Option<Self>, ReportError> {
        let path = folder.join(NAME);
        let bytes = match input_file::bytes(&path, MAX_TABLE_BYTES) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => {
                let reason = error.to_string();
                return Err(ReportError::Read { path, reason });
            }
        };
        if !checksum::is_whole(&bytes) {
            return Err(ReportError::Sweep {
                path,
                reason: "it is damaged: its checksum is that of another content".to_owned(),
                remedy: "remove it: `percuss sweep SWEEP.toml --out DIR --resume` writes it again and keeps the whole blocks"
                    .to_owned(),
            });
        }
        match serde_json::from_slice::<Self>(&bytes) {
            Ok(manifest) if manifest.block_size > 0 && manifest.runs > 0 => Ok(Some(manifest)),
            Ok(_) => Err(unreadable(&path, "it counts no runs")),
            Err(error) => Err(unreadable(&path, &error.to_string())),
        }
    }

    pub(super) fn text(&self) -> String {
        /// The manifest and its checksum, in one object.
        #[derive(Serialize)]
        struct Checked<'a> {
            #[serde(flatten)]
            manifest: &'a Manifest,
            checksum: String,
        }
        let checked = Checked {
            manifest: self,
            checksum: checksum::open(),
        };
        // Numbers and texts always make JSON.
        let text = serde_json::to_string_pretty(&checked).unwrap_or_default() + "\n";
        checksum::closed(text)
    }

    /// What another manifest says otherwise, in words: the first difference.
    pub(super) fn difference(&self, other: &Self) -> Option<String> {
        let fields = |manifest: &Self| match serde_json::to_value(manifest) {
            Ok(serde_json::Value::Object(fields)) => fields,
            _ => serde_json::Map::new(),
        };
        let (ours, theirs) = (fields(self), fields(other));
        // A case without a name of its own has that of its folder, which may move; `case_hash` tells cases apart.
        let mut told_apart: Vec<_> = ours
            .iter()
            .filter(|(name, _)| !["case", "case_title"].contains(&name.as_str()))
            .collect();
        // It follows from the number of runs where the file does not give it.
        told_apart.sort_by_key(|(name, _)| *name == "block_size");
        told_apart.into_iter().find_map(|(name, value)| {
            let other = theirs.get(name)?;
            let words = match name.as_str() {
                "parameters" => "it varies other numbers".to_owned(),
                "columns" => "its columns are others".to_owned(),
                "sweep_hash" => {
                    "it was computed from a sweep file that says something else".to_owned()
                }
                "case_hash" => {
                    "it was computed from a base case that says something else".to_owned()
                }
                _ => format!("its `{name}` is {other}, not {value}"),
            };
            (value != other).then_some(words)
        })
    }
}

fn varied(axis: &Axis) -> Varied {
    Varied {
        key: axis.key.clone(),
        unit: axis.unit.clone(),
        column: axis.column(),
        kind: axis.kind.to_owned(),
        count: axis.count(),
        words: axis.words().unwrap_or_default(),
    }
}

fn unreadable(path: &Path, reason: &str) -> ReportError {
    ReportError::Sweep {
        path: path.to_owned(),
        reason: format!("it is no manifest of a sweep: {reason}"),
        remedy: "give a folder that `percuss sweep` wrote".to_owned(),
    }
}

/// FNV-1a, 128 bits: the same on every machine. It tells sweeps apart; nobody forges one.
pub(super) fn hash(text: &str) -> String {
    let hash = text.bytes().fold(
        0x6c62_272e_07bb_0142_62b8_2175_6295_c58d,
        |hash: u128, byte| {
            (hash ^ u128::from(byte)).wrapping_mul(0x0000_0000_0100_0000_0000_0000_0000_013b)
        },
    );
    format!("{hash:032x}")
}

#[cfg(test)]
mod tests {
    use super::hash;

    #[test]
    fn the_hash_is_the_published_one() {
        assert_eq!(hash(""), "6c62272e07bb014262b821756295c58d");
        assert_eq!(hash("a"), "d228cb696f1a8caf78912b704e4a8964");
    }
}
