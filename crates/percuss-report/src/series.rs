//! Series of points of a line chart.

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Style {
    /// A line.
    #[default]
    Line,
    /// A dashed line.
    Dashed,
    /// A line with a marker at each point.
    LineAndMarkers,
    /// A marker at each point.
    Markers,
    /// A small translucent marker at each point, for many of them.
    Cloud,
}

impl Style {
    /// Whether every point has a marker.
    pub(crate) fn has_markers(self) -> bool {
        matches!(self, Self::LineAndMarkers | Self::Markers | Self::Cloud)
    }
}

/// A named set of points.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    pub(crate) name: String,
    /// Text of the second column of the legend.
    pub(crate) value: String,
    /// Name of the band in the legend; none where it is empty.
    pub(crate) band_name: String,
    /// Whether another series draws a line through its markers.
    pub(crate) joined: bool,
    pub(crate) points: Vec<(f64, f64)>,
    pub(crate) errors: Vec<(f64, f64)>,
    pub(crate) style: Style,
    pub(crate) width: f64,
    pub(crate) color: Option<String>,
    pub(crate) symbol: Option<usize>,
    pub(crate) band: Vec<(f64, f64)>,
}

impl Series {
    /// Points joined by a line. A point that is not finite leaves a gap.
    pub fn new(name: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self {
            name: name.into(),
            value: String::new(),
            band_name: String::new(),
            joined: false,
            points: points.into_iter().collect(),
            errors: Vec::new(),
            style: Style::Line,
            width: 1.5,
            color: None,
            symbol: None,
            band: Vec::new(),
        }
    }

    /// Sets how the series is drawn.
    pub fn style(mut self, style: Style) -> Self {
        self.style = style;
        self
    }

    /// Sets the width of the line in px; 1.5 otherwise.
    pub fn width(mut self, width: f64) -> Self {
        self.width = width;
        self
    }

    /// Sets the colour, such as one of [`crate::palette::SERIES`]; the next free one is taken otherwise.
    pub fn color(mut self, color: impl Into<String>) -> Self {
        self.color = Some(color.into());
        self
    }

    /// Sets colour, marker and dashes together: up to 48 symbols differ in colour and marker, and in colour and dashes.
    pub fn symbol(mut self, index: usize) -> Self {
        self.color = Some(crate::palette::symbol_color(index).to_owned());
        self.symbol = Some(index);
        self
    }

    /// Adds a translucent area: its lower and upper end at each point. An end that is not finite leaves a gap.
    pub fn band(mut self, ends: impl IntoIterator<Item = (f64, f64)>) -> Self {
        self.band = ends.into_iter().collect();
        self
    }

    /// Sets the text of the second column of the legend.
    pub(crate) fn value(mut self, value: impl Into<String>) -> Self {
        self.value = value.into();
        self
    }

    /// Names the band in the legend.
    pub(crate) fn band_name(mut self, name: impl Into<String>) -> Self {
        self.band_name = name.into();
        self
    }

    /// Shows a line in the legend: another series draws it through the markers.
    pub(crate) fn joined(mut self) -> Self {
        self.joined = true;
        self
    }

    /// Adds vertical error bars: how far each one reaches below and above its point.
    pub fn error_bars(mut self, errors: impl IntoIterator<Item = (f64, f64)>) -> Self {
        self.errors = errors.into_iter().collect();
        self
    }
}
