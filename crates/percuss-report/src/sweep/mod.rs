//! Folder of a sweep: `manifest.json`, and one Parquet file per block of runs.
//!
//! A block's file is complete or absent, and the same whoever writes it: a sweep that was ended, in whatever way, goes on with
//! the blocks that are missing.

mod axisymmetric;
mod checksum;
mod columns;
mod folder;
mod manifest;
mod merge;
mod merge_csv;
mod parts;
mod plot;
mod rows;
mod table;

pub use axisymmetric::AxisymmetricFile;
pub use folder::{Block, Status, SweepFolder, status};
pub use manifest::{ColumnName, Manifest, Varied};
pub use merge::merge;
pub use plot::{
    PlotRequest, PlotStyle, SweepChart, SweepNumber, charts, numbers, parallel_figure, plot,
};
pub use table::rows_csv;

/// Name of the file of a block.
fn block_file(block: u64) -> String {
    format!("block-{block:06}.parquet")
}

/// Whether a file of this name belongs to the folder of a sweep.
fn is_sweep_file(name: &str) -> bool {
    let is_block = name.starts_with("block-") && name.ends_with(".parquet");
    is_block || [manifest::NAME, folder::LOCK, axisymmetric::NAME].contains(&name)
}
