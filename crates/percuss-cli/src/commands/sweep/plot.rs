//! `percuss sweep plot`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use percuss_report::sweep::{PlotRequest, PlotStyle, plot};
use serde::Serialize;

use crate::{answer::Answer, failure::Failure, output};

const LONG_ABOUT: &str = "\
Draw a result of a sweep, as SVG and PNG: curves of one parameter, or of two
where one takes few values; a map of two; parallel coordinates of more. Several
folders are parts of one sweep; what is not computed yet is counted.

With --x, or --x and --y, one or two of many parameters are drawn, and means are
taken over the others. Shots that failed, or have no such result, are shown or
counted in the figure.";

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
    /// Folder for the figure; the first of the folders of results when not given
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Column of the result to draw; the first that the sweep has when not given
    #[arg(long, value_name = "COLUMN")]
    quantity: Option<String>,
    /// Kind of figure; chosen from what is varied when not given
    #[arg(long, value_enum)]
    style: Option<Style>,
    /// Parameter that runs from left to right
    #[arg(long, value_name = "KEY")]
    x: Option<String>,
    /// Parameter that runs upwards in a map, or of whose values each gets a curve
    #[arg(long, value_name = "KEY")]
    y: Option<String>,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Style {
    /// A curve, or one for each value of a second parameter
    Curves,
    /// Colours over two parameters
    Map,
    /// All parameters side by side, a line a shot
    Parallel,
}

/// What the figure shows.
#[derive(Serialize)]
struct Drawn {
    title: String,
}

impl Plot {
    pub fn run(&self) -> Result<(), Failure> {
        let (title, files) = self.draw()?;
        let files = files.iter().map(|file| file.display().to_string());
        let files = files.collect::<Vec<_>>().join(" and ");
        output::print(&format!("{title}\nwrote {files}\n"))
    }

    /// Its title, and the files.
    pub fn answer(&self) -> Result<Answer, Failure> {
        let (title, files) = self.draw()?;
        Answer::json_of(&Drawn { title }, files)
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
        let files = figure.write(self.out.as_ref().unwrap_or(&self.folders[0]))?;
        Ok((figure.title, files))
    }
}
