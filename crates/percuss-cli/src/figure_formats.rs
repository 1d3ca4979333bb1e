//! Option `--figures`: formats of the figures in a folder.

use clap::Args;
use percuss_report::FigureFormat;

/// Files that are written of each figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Formats(Vec<FigureFormat>);

/// Option of commands that write figures to the folder `--out`.
#[derive(Debug, Clone, Args)]
pub struct FigureArgs {
    /// Formats of the figures in DIR, separated by commas, of svg, png and pdf; none leaves them out [default: svg,png]
    #[arg(long, value_name = "FORMATS", requires = "out", value_parser = formats)]
    figures: Option<Formats>,
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

/// Reads the value of the option.
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
    use super::{Formats, formats};
    use percuss_report::FigureFormat;

    #[test]
    fn formats_are_a_list_without_repetitions() {
        assert_eq!(formats("none"), Ok(Formats(Vec::new())));
        assert_eq!(formats("svg"), Ok(Formats(vec![FigureFormat::Svg])));
        for wrong in ["", "svg,", "tiff", "svg,svg", "SVG", "none,svg"] {
            assert!(formats(wrong).is_err(), "{wrong}");
        }
    }

    #[cfg(feature = "png")]
    #[test]
    fn their_order_is_that_of_the_files() {
        let read = formats("pdf, svg").unwrap();
        assert_eq!(read, Formats(vec![FigureFormat::Pdf, FigureFormat::Svg]));
    }
}
