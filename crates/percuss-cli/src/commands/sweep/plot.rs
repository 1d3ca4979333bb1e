//! `percuss sweep plot`: figures of a sweep.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use percuss::units::Length;
use percuss_report::sweep::{PlotRequest, PlotStyle, plot};
use serde::Serialize;

use crate::{
    failure::Failure,
    figure_formats::{self, Formats},
    output,
    response::Response,
};

const LONG_ABOUT: &str = "\
Draw a result of a sweep, as SVG and PNG: curves versus one parameter, or two
where one takes few values; a map of two; parallel coordinates of more. Several
folders are parts of one sweep; the figure gives the number of missing runs.

With --x, or --x and --y, one or two of many parameters are drawn, with means
over the others. The figure shows or counts runs that failed or have no such
result.";

const AFTER_HELP: &str = "\
Examples:
  percuss sweep plot rows
  percuss sweep plot rows --quantity peak_force_kn --out figures
  percuss sweep plot rows --x projectile.impact_velocity --y chain.border_shear
  percuss sweep plot rows --style map --x projectile.impact_velocity";

/// Draw a result of a sweep
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Plot {
    /// Folders of results
    #[arg(value_name = "DIR", required = true)]
    folders: Vec<PathBuf>,
    /// Folder for the figure [default: the first folder of results]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Formats of the figure, separated by commas, of svg, png and pdf [default: svg,png]
    #[arg(long, value_name = "FORMATS", value_parser = figure_formats::formats)]
    figures: Option<Formats>,
    /// Width of the figure in print, 60 mm to 182 mm: "88 mm" fits a column of a journal [default: 182 mm]
    #[arg(long, value_name = "WIDTH", value_parser = figure_formats::figure_width)]
    pub figure_width: Option<Length>,
    /// Column of the result to draw [default: the first column with values]
    #[arg(long, value_name = "COLUMN")]
    quantity: Option<String>,
    /// Kind of figure [default: chosen from the number of parameters]
    #[arg(long, value_enum)]
    style: Option<Style>,
    /// Parameter of the horizontal axis
    #[arg(long, value_name = "KEY")]
    x: Option<String>,
    /// Parameter of the vertical axis of a map, or with one curve per value
    #[arg(long, value_name = "KEY")]
    y: Option<String>,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Style {
    /// One curve, or one per value of a second parameter
    Curves,
    /// Colour map of two parameters
    Map,
    /// Parallel coordinates: one axis per parameter, one line per run
    Parallel,
}

/// Title of a figure.
#[derive(Serialize)]
struct Drawn {
    title: String,
}

impl Plot {
    pub fn run(&self) -> Result<(), Failure> {
        let (title, files) = self.draw()?;
        let files = files.iter().map(|file| file.display().to_string());
        let files = files.collect::<Vec<_>>().join(" and ");
        let wrote = match files.is_empty() {
            true => String::new(),
            false => format!("wrote {files}\n"),
        };
        output::print(&format!("{title}\n{wrote}"))
    }

    /// Title and files of the figure.
    pub fn execute(&self) -> Result<Response, Failure> {
        let (title, files) = self.draw()?;
        Response::json_of(&Drawn { title }, files)
    }

    fn draw(&self) -> Result<(String, Vec<PathBuf>), Failure> {
        let request = PlotRequest {
            quantity: self.quantity.clone(),
            style: self.style.map(|style| match style {
                Style::Curves => PlotStyle::Curves,
                Style::Map => PlotStyle::Map,
                Style::Parallel => PlotStyle::Parallel,
            }),
            x: self.x.clone(),
            y: self.y.clone(),
        };
        let figure = plot(&self.folders, &request)?;
        let files = figure.write(
            self.out.as_ref().unwrap_or(&self.folders[0]),
            figure_formats::wanted(self.figures.as_ref()),
        )?;
        Ok((figure.title, files))
    }
}
