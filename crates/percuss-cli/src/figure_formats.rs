//! Options `--figures` and `--figure-width`: formats and width of the figures in a folder.

use clap::Args;
use percuss::units::{Length, QuantityError, significant};
use percuss_report::{FIGURE_WIDTHS, FigureFormat};

/// Files that are written of each figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Formats(Vec<FigureFormat>);

/// Options of commands that write figures to the folder `--out`.
#[derive(Debug, Clone, Args)]
pub struct FigureArgs {
    /// Formats of the figures in DIR, separated by commas, of svg, png and pdf; none leaves them out [default: svg,png]
    #[arg(long, value_name = "FORMATS", requires = "out", value_parser = formats)]
    figures: Option<Formats>,
    /// Width of the figures in print, 60 mm to 182 mm: "88 mm" fits a column of a journal [default: 182 mm]
    #[arg(long, value_name = "WIDTH", requires = "out", value_parser = figure_width)]
    pub figure_width: Option<Length>,
}

impl FigureArgs {
    /// The formats that are wanted.
    pub fn formats(&self) -> &[FigureFormat] {
        wanted(self.figures.as_ref())
    }
}

/// The formats of an option, or those where it is not given.
pub fn wanted(formats: Option<&Formats>) -> &[FigureFormat] {
    formats.map_or(FigureFormat::DEFAULT, |Formats(formats)| formats)
}

/// Reads a width of figures.
pub fn figure_width(text: &str) -> Result<Length, String> {
    let width: Length = text
        .parse()
        .map_err(|error: QuantityError| error.to_string())?;
    let (from, to) = (FIGURE_WIDTHS.start().si(), FIGURE_WIDTHS.end().si());
    if !(from..=to).contains(&width.si()) {
        let millimetres = |metres: f64| significant(metres * 1e3, 6);
        return Err(format!(
            "{} mm is out of range: allowed are {} mm to {} mm",
            millimetres(width.si()),
            millimetres(from),
            millimetres(to)
        ));
    }
    Ok(width)
}

/// Reads the value of the option `--figures`.
pub fn formats(text: &str) -> Result<Formats, String> {
    if text == "none" {
        return Ok(Formats(Vec::new()));
    }
    let mut formats = Vec::new();
    for word in text.split(',').map(str::trim) {
        let mut all = FigureFormat::ALL.iter();
        let Some(format) = all.find(|format| format.suffix() == word) else {
            let known: Vec<&str> = FigureFormat::ALL.iter().map(|f| f.suffix()).collect();
            return Err(format!(
                "write formats of this program, separated by commas ({}), or none",
                known.join(", ")
            ));
        };
        if formats.contains(format) {
            return Err(format!("{word} is written once for each figure"));
        }
        formats.push(*format);
    }
    Ok(Formats(formats))
}

#[cfg(test)]
mod tests {
    use super::{Formats, figure_width, formats};
    use percuss_report::FigureFormat;

    #[test]
    fn formats_are_a_list_without_repetitions() {
        assert_eq!(formats("none"), Ok(Formats(Vec::new())));
        assert_eq!(formats("svg"), Ok(Formats(vec![FigureFormat::Svg])));
        for wrong in ["", "svg,", "tiff", "svg,svg", "SVG", "none,svg"] {
            assert!(formats(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn widths_are_those_of_columns_and_pages() {
        assert!((figure_width("8.8 cm").unwrap().si() - 0.088).abs() < 1e-12);
        assert!(figure_width("88").unwrap_err().contains("unit"));
        let wide = figure_width("2 m").unwrap_err();
        assert_eq!(wide, "2000 mm is out of range: allowed are 60 mm to 182 mm");
    }

    #[cfg(feature = "png")]
    #[test]
    fn their_order_is_that_of_the_files() {
        let read = formats("pdf, svg").unwrap();
        assert_eq!(read, Formats(vec![FigureFormat::Pdf, FigureFormat::Svg]));
    }
}
