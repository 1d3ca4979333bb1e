//! Small charts that share a figure.

use std::fmt::Write;

use kuva::render::render_utils::generate_ticks;

use crate::{Figure, frame::tick_label};

/// Size of numbers and of labels [px].
const TICK_SIZE: f64 = 10.5;
const LABEL_SIZE: f64 = 13.0;

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
        let _ = write!(
            drawing.svg,
            r#"<rect x="{:.1}" y="{:.1}" width="{:.1}" height="{:.1}" fill="none" stroke="black"/>"#,
            self.left, self.top, self.width, self.height
        );
        if let Some(label) = x {
            for value in generate_ticks(self.x.0, self.x.1, 4) {
                let at = self.map_x(value);
                if (self.left..=right).contains(&at) {
                    drawing.line((at, bottom), (at, bottom + 4.0), "black", 1.0);
                    drawing.text(
                        (at, bottom + 16.0),
                        &tick_label(value),
                        TICK_SIZE,
                        "middle",
                        0.0,
                    );
                }
            }
            let middle = self.left + 0.5 * self.width;
            drawing.text((middle, bottom + 36.0), label, LABEL_SIZE, "middle", 0.0);
        }
        if let Some(label) = y {
            for value in generate_ticks(self.y.0, self.y.1, 4) {
                let at = self.map_y(value);
                if (self.top..=bottom).contains(&at) {
                    drawing.line((self.left - 4.0, at), (self.left, at), "black", 1.0);
                    let place = (self.left - 7.0, at + 3.5);
                    drawing.text(place, &tick_label(value), TICK_SIZE, "end", 0.0);
                }
            }
            let place = (self.left - 58.0, self.top + 0.5 * self.height);
            drawing.text(place, label, LABEL_SIZE, "middle", -90.0);
        }
    }
}

/// A figure that is drawn by hand.
pub(super) struct Drawing {
    width: f64,
    height: f64,
    pub(super) svg: String,
}

impl Drawing {
    pub(super) fn new(width: f64, height: f64) -> Self {
        Self {
            width,
            height,
            svg: String::new(),
        }
    }

    pub(super) fn line(&mut self, from: (f64, f64), to: (f64, f64), color: &str, width: f64) {
        // Writing to a string does not fail.
        let _ = write!(
            self.svg,
            r#"<path d="M{:.1} {:.1}L{:.1} {:.1}" stroke="{color}" stroke-width="{width}" fill="none"/>"#,
            from.0, from.1, to.0, to.1
        );
    }

    /// A line through places.
    pub(super) fn curve(&mut self, places: impl Iterator<Item = (f64, f64)>, color: &str) {
        let mut path = String::new();
        for (i, (x, y)) in places.enumerate() {
            let command = if i == 0 { 'M' } else { 'L' };
            let _ = write!(path, "{command}{x:.1} {y:.1}");
        }
        let _ = write!(
            self.svg,
            r#"<path d="{path}" stroke="{color}" stroke-width="1" stroke-opacity="0.8" fill="none"/>"#
        );
    }

    pub(super) fn area(&mut self, place: (f64, f64), size: (f64, f64), color: &str) {
        let _ = write!(
            self.svg,
            r#"<rect x="{:.2}" y="{:.2}" width="{:.2}" height="{:.2}" fill="{color}"/>"#,
            place.0, place.1, size.0, size.1
        );
    }

    pub(super) fn text(
        &mut self,
        place: (f64, f64),
        text: &str,
        size: f64,
        anchor: &str,
        turned: f64,
    ) {
        let text = text.replace('&', "&amp;").replace('<', "&lt;");
        let _ = write!(
            self.svg,
            r#"<text x="{0:.1}" y="{1:.1}" font-size="{size}" text-anchor="{anchor}" transform="rotate({turned} {0:.1} {1:.1})">{text}</text>"#,
            place.0, place.1
        );
    }

    /// The figure, with its title at the top.
    pub(super) fn finish(mut self, name: &str, title: &str, caption: &str) -> Figure {
        let middle = 0.5 * self.width;
        self.text((middle, 24.0), title, 17.0, "middle", 0.0);
        self.text((middle, 44.0), caption, 12.0, "middle", 0.0);
        Figure {
            name: name.to_owned(),
            title: format!("{title}: {caption}"),
            svg: format!(
                r#"<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" font-family="DejaVu Sans, sans-serif"><rect width="{0}" height="{1}" fill="white"/>{2}</svg>"#,
                self.width, self.height, self.svg
            ),
        }
    }
}
