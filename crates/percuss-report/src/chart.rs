//! Line charts in the looks of this crate.

use kuva::plot::{
    BandPlot, LinePlot, ScatterPlot,
    line::{LineStyle, ScatterPoint as LinePoint},
    scatter::{MarkerShape, ScatterPoint},
};
use kuva::render::plots::Plot;

use crate::{
    Axis, Figure, Mark, Series, Style,
    chart_methods::chart_methods,
    figure_width,
    frame::{Frame, Head},
    legend::{Entry, Legend},
    mark, palette,
};

/// Dashes of a dashed line and gaps between them [px], short enough for two of them in the legend.
const DASHES: &str = "5 2.5";
/// Opacity of the area of a band.
const BAND_OPACITY: f64 = 0.18;
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
    /// What the second column of the legend has, and its unit.
    pub(crate) values: Option<(&'static str, &'static str)>,
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
            values: None,
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

    /// Heads the second column of the legend.
    pub(crate) fn values(mut self, what: &'static str, unit: &'static str) -> Self {
        self.values = Some((what, unit));
        self
    }

    /// A name with the text of the second column of the legend.
    pub(crate) fn full_name(&self, name: &str, value: &str) -> String {
        match self.values {
            _ if value.is_empty() => name.to_owned(),
            Some((what, unit)) => format!("{name}, {what} {value} {unit}"),
            None => format!("{name}, {value}"),
        }
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
            None => palette::series(self.number(index)).to_owned(),
        }
    }

    /// Number of a series among those that take the next free colour.
    fn number(&self, index: usize) -> usize {
        let before = self.series[..index].iter();
        before.filter(|series| series.color.is_none()).count()
    }

    /// Dashes and gaps of a series [px], if it has any.
    pub(crate) fn dashes(&self, index: usize) -> Option<&'static str> {
        let series = &self.series[index];
        match (series.style, series.symbol, &series.color) {
            (Style::Dashed, ..) => Some(DASHES),
            (_, Some(symbol), _) => palette::symbol_dashes(symbol),
            (_, None, None) => palette::series_dashes(self.number(index)),
            (_, None, Some(_)) => None,
        }
    }

    fn plots(&self) -> Vec<Plot> {
        let mut plots = self.bands();
        for (index, series) in self.series.iter().enumerate() {
            let color = self.color(index);
            for run in self.runs(series) {
                if !matches!(series.style, Style::Markers | Style::Cloud) {
                    plots.push(line(series, run.clone(), &color, self.dashes(index)));
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

    fn legend(&self) -> Legend {
        let named = self.series.iter().enumerate();
        let named = named.filter(|(_, series)| !series.name.is_empty());
        let entries = named.flat_map(|(index, series)| {
            let color = self.color(index);
            let lined = !matches!(series.style, Style::Markers | Style::Cloud) || series.joined;
            let line = lined.then(|| self.dashes(index));
            let marker = series.style.has_markers().then(|| marker(index, series));
            let own = Entry::series(&series.name, &color, line, marker).value(&series.value);
            let band = !series.band_name.is_empty();
            let band = band.then(|| Entry::area(&series.band_name, &color, BAND_OPACITY));
            std::iter::once(own).chain(band)
        });
        let legend = Legend::new(entries.chain(mark::entries(&self.marks)));
        match self.values {
            Some((what, unit)) => legend.heading(&format!("{what} ({unit})")),
            None => legend,
        }
    }
}

/// Marker of a series: after the last colour and marker together, the markers are shifted.
fn marker(index: usize, series: &Series) -> MarkerShape {
    let index = series.symbol.unwrap_or(index);
    MARKERS[(index + index / palette::MARKED) % MARKERS.len()]
}

fn line(series: &Series, run: std::ops::Range<usize>, color: &str, dashes: Option<&str>) -> Plot {
    let mut line = LinePlot::new()
        .with_color(color)
        .with_stroke_width(series.width);
    if let Some(dashes) = dashes {
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
    fn series_differ_in_colour_and_marker_and_in_colour_and_dashes() {
        let symbols: Vec<Series> = (0..48).map(|i| Series::new("", []).symbol(i)).collect();
        let plain: Vec<Series> = (0..48).map(|_| Series::new("", [])).collect();
        for (series, with_markers) in [(symbols, true), (plain, false)] {
            let chart = LineChart::new("", "", Axis::new(""), Axis::new("")).all(series);
            let look = |i: usize| {
                let marker = with_markers.then(|| marker(i, &chart.series[i]) as u8);
                (chart.color(i), chart.dashes(i), marker)
            };
            for i in 0..chart.series.len() {
                for j in 0..i {
                    let (a, b) = (look(i), look(j));
                    let same_marker = with_markers && a.2 == b.2;
                    assert!(a.0 != b.0 || (a.1 != b.1 && !same_marker), "{i} {j}");
                }
            }
        }
    }

    #[test]
    fn the_legend_shows_dashes_with_their_markers_and_names_bands() {
        let points = || [(0.0, 1.0), (1.0, 2.0)];
        let band = Series::new("one", points()).band([(0.5, 1.5), (1.5, 2.5)]);
        let chart = LineChart::new("c", "C", Axis::new("x"), Axis::new("y"))
            .values("limit", "m/s")
            .series(band.band_name("range of one").value("12"))
            .series(
                Series::new("two", points())
                    .style(Style::LineAndMarkers)
                    .symbol(6)
                    .value("13"),
            );
        let svg = chart.draw().svg;
        for text in ["one", "range of one", "12", "two", "13", "limit (m/s)"] {
            assert!(svg.contains(&format!(">{text}</text>")), "{text}: {svg}");
        }
        // In the plot and in the legend.
        assert_eq!(svg.matches(r#"stroke-dasharray="7 3""#).count(), 2);
        assert_eq!(chart.full_name("two", "13"), "two, limit 13 m/s");
    }
}
