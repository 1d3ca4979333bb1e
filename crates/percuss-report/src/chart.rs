//! Line charts in the looks of this crate.

use kuva::plot::{
    BandPlot, LinePlot, ScatterPlot,
    legend::{LegendEntry, LegendShape},
    line::{LineStyle, ScatterPoint as LinePoint},
    scatter::{MarkerShape, ScatterPoint},
};
use kuva::render::plots::Plot;

use crate::{
    Axis, Figure, Mark, Series, Style,
    chart_methods::chart_methods,
    figure_width,
    frame::{Frame, Head, plain},
    mark, palette,
};

/// Dashes of a dashed line and gaps between them [px], short enough for two of them in the legend.
const DASHES: &str = "5 2.5";
/// Opacity of the area of a band.
const BAND_OPACITY: f64 = 0.18;
/// Most characters of a name in the legend.
const LEGEND_CHARS: usize = 34;
/// Shapes of markers, in the order in which series take them.
const MARKERS: [MarkerShape; 9] = [
    MarkerShape::Circle,
    MarkerShape::Square,
    MarkerShape::Triangle,
    MarkerShape::Diamond,
    MarkerShape::Cross,
    MarkerShape::TriangleDown,
    MarkerShape::Plus,
    MarkerShape::Star,
    MarkerShape::Pentagon,
];

/// A chart of lines and markers.
#[derive(Debug, Clone, PartialEq)]
pub struct LineChart {
    pub(crate) head: Head,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    pub(crate) series: Vec<Series>,
    pub(crate) marks: Vec<Mark>,
    pub(crate) true_to_scale: bool,
    pub(crate) square: bool,
}

chart_methods!(LineChart, marks);

impl LineChart {
    /// An empty chart: file stem, title and axes.
    pub fn new(name: impl Into<String>, title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self {
            head: Head::new(name, title),
            x,
            y,
            series: Vec::new(),
            marks: Vec::new(),
            true_to_scale: false,
            square: false,
        }
    }

    /// Adds a series.
    pub fn series(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// Adds several series.
    pub(crate) fn all(mut self, series: impl IntoIterator<Item = Series>) -> Self {
        self.series.extend(series);
        self
    }

    /// Gives a unit the same length on both axes, by the height of the figure where that suffices.
    pub fn true_to_scale(mut self) -> Self {
        self.true_to_scale = true;
        self
    }

    /// Makes the plot as high as wide.
    pub(crate) fn square(mut self) -> Self {
        self.square = true;
        self
    }

    /// Draws the chart.
    pub fn draw(&self) -> Figure {
        let (x_extent, y_extent) = self.extents();
        let mut frame = Frame {
            legend: self.legend(),
            marks: mark::reference_lines(&self.marks),
            aspect: self.square.then_some(1.0),
            ..Frame::new(&self.head, [&self.x, &self.y], (x_extent, y_extent))
        };
        let (mut x, mut y) = (self.x.clone(), self.y.clone());
        if self.true_to_scale {
            frame.aspect = true_to_scale(&mut x, &mut y, frame.x_extent, frame.y_extent);
        }
        // A marker at zero would be cut in halves by an axis that starts there.
        if self.has_marker_at(|point| point.0 == 0.0) {
            x = x.clear_of_zero(x_extent);
        }
        if self.has_marker_at(|point| point.1 == 0.0) {
            y = y.clear_of_zero(y_extent);
        }
        frame.x = &x;
        frame.y = &y;
        frame.draw(self.plots(), |_, _| {})
    }

    fn has_marker_at(&self, place: impl Fn(&(f64, f64)) -> bool) -> bool {
        let marked = self.series.iter().filter(|s| s.style.has_markers());
        marked.flat_map(|series| &series.points).any(place)
    }

    /// Smallest and largest value on either axis.
    pub(crate) fn extents(&self) -> ((f64, f64), (f64, f64)) {
        let shown = || {
            self.series.iter().flat_map(|series| {
                series.points.iter().enumerate().map(|(i, &(x, y))| {
                    let (below, above) = series.errors.get(i).copied().unwrap_or_default();
                    (x, y, y - below, y + above)
                })
            })
        };
        let marked = |vertical| {
            self.marks
                .iter()
                .filter(move |mark| mark.vertical == vertical)
                .map(|mark| mark.value)
        };
        let x_values = shown().map(|point| point.0).chain(marked(true));
        let bands = self.series.iter().flat_map(|series| &series.band);
        let y_values = shown()
            .flat_map(|point| [point.1, point.2, point.3])
            .chain(bands.flat_map(|ends| [ends.0, ends.1]));
        (
            self.x.extent(x_values),
            self.y.extent(y_values.chain(marked(false))),
        )
    }

    pub(crate) fn color(&self, index: usize) -> String {
        match &self.series[index].color {
            Some(color) => color.clone(),
            None => {
                let before = self.series[..index].iter();
                palette::series(before.filter(|s| s.color.is_none()).count()).to_owned()
            }
        }
    }

    fn plots(&self) -> Vec<Plot> {
        let mut plots = self.bands();
        for (index, series) in self.series.iter().enumerate() {
            let color = self.color(index);
            for run in self.runs(series) {
                if !matches!(series.style, Style::Markers | Style::Cloud) {
                    plots.push(line(series, run.clone(), &color));
                }
                // A single point has no line to be seen by.
                let marked = series.style.has_markers();
                if marked || run.len() == 1 {
                    let shape = if marked {
                        marker(index, series)
                    } else {
                        MarkerShape::Circle
                    };
                    plots.push(markers(series, run, &color, shape));
                }
            }
        }
        plots
    }

    /// Translucent areas, for all lines to lie above them.
    fn bands(&self) -> Vec<Plot> {
        let mut plots = Vec::new();
        for (index, series) in self.series.iter().enumerate() {
            let shown: Vec<(f64, f64, f64)> = series
                .points
                .iter()
                .zip(&series.band)
                .map(|(point, ends)| (point.0, ends.0, ends.1))
                .collect();
            let whole = |at: &(f64, f64, f64)| {
                self.x.shows(at.0) && self.y.shows(at.1) && self.y.shows(at.2)
            };
            for run in shown
                .chunk_by(|a, b| whole(a) == whole(b))
                .filter(|run| whole(&run[0]))
            {
                let band = BandPlot::new(
                    run.iter().map(|at| at.0),
                    run.iter().map(|at| at.1),
                    run.iter().map(|at| at.2),
                );
                plots.push(
                    band.with_color(self.color(index))
                        .with_opacity(BAND_OPACITY)
                        .into(),
                );
            }
        }
        plots
    }

    /// Ranges of points without a gap.
    fn runs(&self, series: &Series) -> Vec<std::ops::Range<usize>> {
        let mut runs = Vec::new();
        let mut start = 0;
        for (i, &(x, y)) in series.points.iter().enumerate() {
            if !(self.x.shows(x) && self.y.shows(y)) {
                runs.push(start..i);
                start = i + 1;
            }
        }
        runs.push(start..series.points.len());
        runs.retain(|run| !run.is_empty());
        runs
    }

    fn legend(&self) -> Vec<LegendEntry> {
        let series = self.series.iter().enumerate().map(|(index, series)| {
            let shape = match series.style {
                Style::Line | Style::Dashed => LegendShape::Line,
                _ => LegendShape::Marker(marker(index, series)),
            };
            let dashes = match shape {
                LegendShape::Line => dashes(series).map(str::to_owned),
                _ => None,
            };
            (legend_name(series), self.color(index), shape, dashes)
        });
        series
            .filter(|entry| !entry.0.is_empty())
            .map(|(name, color, shape, dasharray)| LegendEntry {
                label: plain(&name, LEGEND_CHARS),
                color,
                shape,
                dasharray,
            })
            .chain(mark::entries(&self.marks))
            .collect()
    }
}

fn marker(index: usize, series: &Series) -> MarkerShape {
    MARKERS[series.symbol.unwrap_or(index) % MARKERS.len()]
}

fn symbol_dashes(series: &Series) -> Option<palette::Dashes> {
    series.symbol.and_then(palette::symbol_dashes)
}

/// Name in the legend, which shows the marker of a line with markers and therefore has to say how the line is dashed.
fn legend_name(series: &Series) -> String {
    match symbol_dashes(series) {
        Some(dashes) if series.style == Style::LineAndMarkers && !series.name.is_empty() => {
            format!("{} ({})", series.name, dashes.word)
        }
        _ => series.name.clone(),
    }
}

/// Dashes and gaps of a series [px], if it has any.
pub(crate) fn dashes(series: &Series) -> Option<&'static str> {
    match series.style {
        Style::Dashed => Some(DASHES),
        _ => symbol_dashes(series).map(|dashes| dashes.pattern),
    }
}

fn line(series: &Series, run: std::ops::Range<usize>, color: &str) -> Plot {
    let mut line = LinePlot::new()
        .with_color(color)
        .with_stroke_width(series.width);
    if let Some(dashes) = dashes(series) {
        line = line.with_line_style(LineStyle::Custom(dashes.to_owned()));
    }
    line.data = run
        .map(|i| LinePoint {
            x: series.points[i].0,
            y: series.points[i].1,
            x_err: None,
            y_err: series.errors.get(i).copied(),
        })
        .collect();
    line.into()
}

fn markers(series: &Series, run: std::ops::Range<usize>, color: &str, shape: MarkerShape) -> Plot {
    let mut markers = ScatterPlot::new()
        .with_color(color)
        .with_size(match series.style {
            // Where a line lies on another, so do their points.
            Style::Dashed => 2.5,
            Style::Cloud => 3.0,
            _ => 4.0,
        })
        .with_marker(shape);
    if series.style == Style::Cloud {
        markers = markers.with_marker_opacity(0.55);
    }
    // A line draws the error bars of its points itself.
    let errors = series.style == Style::Markers;
    markers.data = run
        .map(|i| ScatterPoint {
            x: series.points[i].0,
            y: series.points[i].1,
            x_err: None,
            y_err: series.errors.get(i).copied().filter(|_| errors),
        })
        .collect();
    markers.into()
}

/// Height over width of a plot in which a unit has the same length on both axes; the ranges grow where no height suffices.
fn true_to_scale(
    x: &mut Axis,
    y: &mut Axis,
    x_extent: (f64, f64),
    y_extent: (f64, f64),
) -> Option<f64> {
    // What tick labels and legend leave of the width, near enough [px].
    let plot_width = figure_width::pixels()
        - if figure_width::is_narrow() {
            100.0
        } else {
            240.0
        };
    const PLOT_HEIGHTS: (f64, f64) = (200.0, 520.0);
    let x_range = x.fixed_range(x_extent)?;
    let y_range = y.fixed_range(y_extent)?;
    let spans = (x_range.1 - x_range.0, y_range.1 - y_range.0);
    let wanted = plot_width * spans.1 / spans.0;
    let height = wanted.clamp(PLOT_HEIGHTS.0, PLOT_HEIGHTS.1);
    let widen = |range: (f64, f64), factor: f64| {
        let (middle, half) = (0.5 * (range.0 + range.1), 0.5 * (range.1 - range.0));
        (middle - half * factor, middle + half * factor)
    };
    let (x_range, y_range) = if wanted > height {
        (widen(x_range, wanted / height), y_range)
    } else {
        (x_range, widen(y_range, height / wanted))
    };
    *x = x.clone().range(x_range.0, x_range.1);
    *y = y.clone().range(y_range.0, y_range.1);
    Some(height / plot_width)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_differ_in_colour_and_marker_and_those_of_one_colour_in_dashes() {
        let all: Vec<_> = (0..18)
            .map(|index| {
                let series = Series::new("", []).symbol(index);
                let dashes = symbol_dashes(&series).map(|dashes| dashes.pattern);
                (series.color.clone(), marker(0, &series), dashes)
            })
            .collect();
        for (i, a) in all.iter().enumerate() {
            for b in &all[..i] {
                let same_color = a.0 == b.0;
                assert!(!same_color || (a.1 as u8 != b.1 as u8 && a.2 != b.2));
            }
        }
    }
}
