//! Panels of a figure.

use kuva::render::render_utils::generate_ticks;

use crate::{
    drawing::{Drawing, Text},
    frame::tick_label,
};

/// Size of numbers and of labels [px].
const TICK_SIZE: f64 = 10.5;
const LABEL_SIZE: f64 = 13.0;
/// Heights of title and caption [px].
pub(super) const HEADS: [f64; 2] = [24.0, 44.0];

/// A place in a figure with the ranges that it shows.
pub(super) struct Panel {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) x: (f64, f64),
    pub(super) y: (f64, f64),
}

impl Panel {
    pub(super) fn map_x(&self, x: f64) -> f64 {
        self.left + self.width * (x - self.x.0) / (self.x.1 - self.x.0)
    }

    pub(super) fn map_y(&self, y: f64) -> f64 {
        self.top + self.height * (self.y.1 - y) / (self.y.1 - self.y.0)
    }

    /// The frame, with numbers and labels at its bottom and its left where there is a label.
    pub(super) fn frame(&self, drawing: &mut Drawing, x: Option<&str>, y: Option<&str>) {
        let (right, bottom) = (self.left + self.width, self.top + self.height);
        drawing.border((self.left, self.top), (self.width, self.height));
        if let Some(label) = x {
            for value in generate_ticks(self.x.0, self.x.1, 4) {
                let at = self.map_x(value);
                if (self.left..=right).contains(&at) {
                    drawing.line((at, bottom), (at, bottom + 4.0), "black", 1.0);
                    let text = Text::new(TICK_SIZE, "middle");
                    drawing.text((at, bottom + 16.0), &tick_label(value), text);
                }
            }
            let middle = self.left + 0.5 * self.width;
            let text = Text::new(LABEL_SIZE, "middle");
            drawing.text((middle, bottom + 36.0), label, text);
        }
        if let Some(label) = y {
            for value in generate_ticks(self.y.0, self.y.1, 4) {
                let at = self.map_y(value);
                if (self.top..=bottom).contains(&at) {
                    drawing.line((self.left - 4.0, at), (self.left, at), "black", 1.0);
                    let place = (self.left - 7.0, at + 3.5);
                    drawing.text(place, &tick_label(value), Text::new(TICK_SIZE, "end"));
                }
            }
            let place = (self.left - 58.0, self.top + 0.5 * self.height);
            let text = Text {
                turned: -90.0,
                ..Text::new(LABEL_SIZE, "middle")
            };
            drawing.text(place, label, text);
        }
    }
}
