//! Colour bars.

use kuva::render::{
    layout::ComputedLayout,
    render::{Scene, TextAnchor},
    render_utils::generate_ticks,
};

use crate::{
    frame::tick_label,
    primitives::{border, filled, line, text},
};

/// Distance of the bar from the plot, and its width [px].
pub(crate) const PLACE: (f64, f64) = (20.0, 18.0);

/// A bar of colours beside a plot.
pub(crate) struct ColorBar<'a> {
    /// Colours from the lowest value up.
    pub(crate) colors: Vec<String>,
    /// Values at the lower and the upper end.
    pub(crate) ends: (f64, f64),
    pub(crate) label: &'a str,
    /// Distance of its upper end from that of the plot [px].
    pub(crate) below_top: f64,
}

impl ColorBar<'_> {
    pub(crate) fn draw(&self, scene: &mut Scene, place: &ComputedLayout) {
        let left = place.margin_left + place.plot_width() + PLACE.0;
        let top = place.margin_top + self.below_top;
        let height = place.plot_height() - self.below_top;
        let step = height / self.colors.len() as f64;
        for (i, color) in self.colors.iter().rev().enumerate() {
            // A little more than the colour's part: no seams.
            let (y, next) = (top + step * i as f64, (step + 0.5).min(height));
            let next = next.min(top + height - y);
            let path = format!("M{left:.2} {y:.2}h{0}v{next:.2}h-{0}z", PLACE.1);
            scene.add(filled(path, color));
        }
        scene.add(border(left, top, PLACE.1, height));
        let right = left + PLACE.1;
        let (low, high) = self.ends;
        for value in generate_ticks(low, high, 7) {
            let part = (value - low) / (high - low);
            if !(-1e-9..=1.0 + 1e-9).contains(&part) {
                continue;
            }
            let y = top + height * (1.0 - part);
            scene.add(line((right, y), (right + 4.0, y), 1.0));
            let style = (12, TextAnchor::Start, None);
            scene.add(text((right + 7.0, y + 4.0), &tick_label(value), style));
        }
        let style = (14, TextAnchor::Middle, Some(-90.0));
        let middle = (place.width - 12.0, top + 0.5 * height);
        scene.add(text(middle, self.label, style));
    }
}
