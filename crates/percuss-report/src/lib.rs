//! Figures, tables and files of results of `percuss`.
//!
//! [`run_figures()`] draws a result that holds a time history, each figure as SVG, PNG or PDF; [`write_histories`] writes the
//! history itself as CSV and Parquet. PNG and PDF are the feature `png`, Parquet is `parquet`, both on by default. [`LineChart`], [`AreaChart`] and [`HeatMap`] give other figures the same looks.
//! Text in a PNG is set in DejaVu Sans, which is built in: a machine without fonts draws the same picture.
//!
//! ```
//! use percuss::{case, model};
//!
//! let text = r#"
//!     projectile = { material = "copper", length = "23.47 mm", diameter = "7.62 mm", impact_velocity = "183 m/s" }
//!     target = { rigid_wall = true }
//! "#;
//! let scenario = case::load_str("taylor", text)?;
//! let result = model::run(model::model("chain")?, &scenario, &mut model::Control::recording())?;
//!
//! let folder = std::env::temp_dir().join("percuss-report-example");
//! for figure in percuss_report::run_figures(&scenario, &result)? {
//!     let files = figure.write(&folder, percuss_report::FigureFormat::DEFAULT)?;
//!     println!("{}: {}", files[0].display(), figure.title);
//! }
//! percuss_report::write_histories(&folder, &result, None)?;
//! # std::fs::remove_dir_all(folder)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

// What Parquet files and pictures read has no other reader.
#![cfg_attr(not(all(feature = "parquet", feature = "png")), allow(dead_code))]

mod area_chart;
mod axial_figures;
mod axis;
pub mod axisymmetric_rows;
mod bar_rows;
pub mod calibration;
mod caption;
mod chart;
mod chart_data;
mod chart_methods;
#[cfg(feature = "png")]
mod clipped;
mod color_bar;
pub mod column;
mod compare_figure;
mod compare_files;
mod convergence_figure;
mod curve_figures;
mod drawing;
mod error;
mod field;
pub mod figure;
mod figure_width;
mod flow_figure;
mod fragment_files;
mod frame;
mod heat_map;
mod histogram;
mod history_files;
mod legend;
mod limit_figure;
mod limit_files;
mod limit_words;
mod mark;
mod material_card;
mod measured;
mod names;
pub mod page;
pub mod palette;
#[cfg(feature = "png")]
mod pdf;
#[cfg(feature = "png")]
mod pixels;
#[cfg(feature = "png")]
mod png_file;
mod primitives;
pub mod replace_file;
pub mod result_rows;
mod row_chart;
mod run_figures;
mod series;
mod shape_figure;
mod single;
mod stress_grid;
#[cfg(feature = "parquet")]
pub mod sweep;
pub mod table;
mod text;
mod time_figures;
mod uncertainty;
mod v50_figure;
pub mod validation;

pub use area_chart::AreaChart;
pub use axis::Axis;
pub use bar_rows::{Bar, BarRows};
pub use chart::LineChart;
pub use chart_data::{Chart, ChartData};
pub use compare_figure::{compare_chart, compare_figures};
pub use compare_files::{comparison_files, write_comparison};
pub use convergence_figure::{convergence_chart, convergence_figure};
pub use error::ReportError;
#[cfg(feature = "png")]
pub use field::{FieldColors, FieldSpan, FieldView, animate, usual_range};
pub use field::{FieldQuantity, FieldSeries, FinalField, FrameSelection, write_dumps};
pub use figure::{Figure, FigureFormat, write_figures};
pub use figure_width::{FIGURE_WIDTHS, with_figure_width};
pub use flow_figure::{FlowCurve, flow_figure};
pub use fragment_files::write_fragments;
pub use heat_map::HeatMap;
pub use histogram::Histogram;
pub use history_files::{history_files, write_histories};
pub use limit_figure::{limit_chart, limit_figure};
pub use limit_files::{limit_files, write_limits};
pub use limit_words::{axisymmetric_limit, limit_headline};
pub use mark::Mark;
pub use material_card::{CardLine, CardSection, MaterialCard};
pub use names::{material_label, parameter_label};
pub use page::html::escape as escape_html;
pub use row_chart::RowChart;
pub use run_figures::{run_charts, run_figures};
pub use series::{Series, Style};
pub use shape_figure::write_shapes;
pub use uncertainty::{
    uncertainty_charts, uncertainty_figures, uncertainty_files, write_uncertainty,
};
pub use v50_figure::v50_figure;
