//! Histograms.
//!
//! The bars of the plotting library's own touch each other.

use kuva::plot::LinePlot;
use percuss::statistics::sorted;

use crate::{
    Axis, Figure, Mark,
    chart_methods::chart_methods,
    frame::{Frame, Head},
    legend::Legend,
    mark, palette,
    primitives::{bar, border},
};

/// Fewest and most bins.
const BINS: (f64, f64) = (12.0, 60.0);
/// Gap between bars [px].
const GAP: f64 = 1.0;

/// How often values fall into intervals of equal width, with marks across.
#[derive(Debug, Clone, PartialEq)]
pub struct Histogram {
    pub(crate) head: Head,
    pub(crate) x: Axis,
    values: Vec<f64>,
    pub(crate) marks: Vec<Mark>,
}

chart_methods!(Histogram, marks);

impl Histogram {
    /// A histogram: file stem, title, the axis of the values, and the values. Those that are not finite are left out.
    pub fn new(
        name: impl Into<String>,
        title: impl Into<String>,
        x: Axis,
        values: impl IntoIterator<Item = f64>,
    ) -> Self {
        let values = values.into_iter().filter(|value| value.is_finite());
        Self {
            head: Head::new(name, title),
            x,
            values: sorted(values),
            marks: Vec::new(),
        }
    }

    /// Lower end of the first bin, width of a bin, and the part of the values in each [%].
    pub(crate) fn bins(&self) -> (f64, f64, Vec<f64>) {
        let (Some(&low), Some(&high)) = (self.values.first(), self.values.last()) else {
            return (0.0, 1.0, Vec::new());
        };
        let count = self.values.len() as f64;
        let at = |part: f64| self.values[(part * (count - 1.0)) as usize];
        // The rule of Freedman and Diaconis.
        let wanted = (high - low) / (2.0 * (at(0.75) - at(0.25)) / count.cbrt());
        let bins = match wanted.is_finite() {
            true => wanted.ceil().clamp(BINS.0, BINS.1),
            false => BINS.0,
        };
        // All values may be one.
        let span = if high > low {
            high - low
        } else {
            low.abs().max(1.0) * 1e-3
        };
        let width = span / bins;
        let mut parts = vec![0.0; bins as usize];
        for value in &self.values {
            let bin = ((value - low) / width) as usize;
            parts[bin.min(bins as usize - 1)] += 100.0 / count;
        }
        (low, width, parts)
    }

    pub(crate) fn color() -> &'static str {
        palette::symbol_color(4)
    }

    /// Axis of the fractions.
    pub(crate) fn y() -> Axis {
        Axis::new("Fraction of the runs (%)")
    }

    /// Smallest and largest value on either axis.
    pub(crate) fn extents(&self) -> ((f64, f64), (f64, f64)) {
        let (low, width, parts) = self.bins();
        let high = low + width * parts.len() as f64;
        let marks = self.marks.iter().map(|mark| mark.value);
        (
            self.x.extent([low, high].into_iter().chain(marks)),
            Self::y().extent(parts.iter().copied().chain([0.0])),
        )
    }

    /// Draws the histogram.
    pub fn draw(&self) -> Figure {
        let (low, width, parts) = self.bins();
        let y = Self::y();
        let frame = Frame {
            legend: Legend::new(mark::entries(&self.marks)),
            ..Frame::new(&self.head, [&self.x, &y], self.extents())
        };
        // Axes are drawn only for a plot, so there is one without content.
        frame.draw(vec![LinePlot::new().into()], |scene, place| {
            for (i, part) in parts.iter().enumerate().filter(|(_, part)| **part > 0.0) {
                let (left, right) = (low + width * i as f64, low + width * (i + 1) as f64);
                scene.add(bar(
                    (place.map_x(left), place.map_y(0.0)),
                    (place.map_x(right) - GAP, place.map_y(*part)),
                    Self::color(),
                ));
            }
            for line in mark::lines(&self.marks, place) {
                scene.add(line);
            }
            let (left, top) = (place.margin_left, place.margin_top);
            scene.add(border(left, top, place.plot_width(), place.plot_height()));
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_is_in_one_bin() {
        let of = |values: Vec<f64>| Histogram::new("h", "h", Axis::new("x"), values).bins();
        let (low, width, parts) = of((0..1000).map(f64::from).chain([f64::NAN]).collect());
        assert_eq!(low, 0.0);
        assert!((low + width * parts.len() as f64 - 999.0).abs() < 1e-9);
        assert!((parts.iter().sum::<f64>() - 100.0).abs() < 1e-9);
        // Even values fill even bins, but for one value more or less.
        assert!(
            parts
                .iter()
                .all(|part| (part * parts.len() as f64 / 100.0 - 1.0).abs() < 0.02)
        );
        let (_, _, one) = of(vec![3.0; 10]);
        assert_eq!(one.iter().filter(|part| **part > 0.0).count(), 1);
        assert!(of(Vec::new()).2.is_empty());
    }
}
