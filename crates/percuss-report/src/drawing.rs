//! Figures drawn without the plotting library.

use std::fmt::Write;

use crate::{Figure, figure_width, page::html::escape, text::plain};

/// A figure in the making.
pub(crate) struct Drawing {
    width: f64,
    height: f64,
    svg: String,
}

/// How a text is set.
#[derive(Clone, Copy)]
pub(crate) struct Text<'a> {
    /// Size [px].
    pub(crate) size: f64,
    pub(crate) anchor: &'a str,
    /// Angle [deg].
    pub(crate) turned: f64,
    pub(crate) color: &'a str,
    /// Whether it has a white border, to be read on lines.
    pub(crate) halo: bool,
}

impl<'a> Text<'a> {
    /// A black text of a size that starts, ends or has its middle (`start`, `end`, `middle`) at its place.
    pub(crate) fn new(size: f64, anchor: &'a str) -> Self {
        Self {
            size,
            anchor,
            turned: 0.0,
            color: "black",
            halo: false,
        }
    }
}

impl Drawing {
    pub(crate) fn new(width: f64, height: f64) -> Self {
        Self {
            width,
            height,
            svg: String::new(),
        }
    }

    pub(crate) fn line(&mut self, from: (f64, f64), to: (f64, f64), color: &str, width: f64) {
        self.curve(
            [from, to].into_iter(),
            color,
            &format!(r#"stroke-width="{width}""#),
        );
    }

    /// A line through places, with further attributes.
    pub(crate) fn curve(
        &mut self,
        places: impl Iterator<Item = (f64, f64)>,
        color: &str,
        attributes: &str,
    ) {
        let mut path = String::new();
        for (i, (x, y)) in places.enumerate() {
            let command = if i == 0 { 'M' } else { 'L' };
            // Writing to a string does not fail.
            let _ = write!(path, "{command}{x:.1} {y:.1}");
        }
        let _ = write!(
            self.svg,
            r#"<path d="{path}" stroke="{color}" {attributes} fill="none"/>"#
        );
    }

    /// A filled rectangle.
    pub(crate) fn area(&mut self, place: (f64, f64), size: (f64, f64), color: &str) {
        self.rectangle(place, size, &format!(r#"fill="{color}""#));
    }

    /// The outline of a rectangle.
    pub(crate) fn border(&mut self, place: (f64, f64), size: (f64, f64)) {
        self.rectangle(place, size, r#"fill="none" stroke="black""#);
    }

    fn rectangle(&mut self, place: (f64, f64), size: (f64, f64), attributes: &str) {
        let _ = write!(
            self.svg,
            r#"<rect x="{:.2}" y="{:.2}" width="{:.2}" height="{:.2}" {attributes}/>"#,
            place.0, place.1, size.0, size.1
        );
    }

    pub(crate) fn text(&mut self, place: (f64, f64), content: &str, text: Text<'_>) {
        let Text {
            size,
            anchor,
            turned,
            color,
            halo,
        } = text;
        let halo = match halo {
            true => r#" paint-order="stroke" stroke="white" stroke-width="3""#,
            false => "",
        };
        let _ = write!(
            self.svg,
            r#"<text x="{0:.1}" y="{1:.1}" font-size="{size}" text-anchor="{anchor}" fill="{color}"{halo} transform="rotate({turned} {0:.1} {1:.1})">{2}</text>"#,
            place.0,
            place.1,
            escape(content)
        );
    }

    /// The figure, with title and caption at their heights [px].
    pub(crate) fn finish(
        mut self,
        name: impl Into<String>,
        (title, caption): (&str, &str),
        heights: [f64; 2],
    ) -> Figure {
        let chars = |size: f64| (self.width / (0.6 * size)) as usize;
        let title_line = (shorten(title, chars(17.0)), 17.0, heights[0]);
        let captions = lines(caption, chars(12.0)).into_iter().enumerate();
        let captions = captions.map(|(i, line)| (line, 12.0, heights[1] + 14.0 * i as f64));
        let texts: Vec<(String, f64, f64)> = std::iter::once(title_line).chain(captions).collect();
        for (content, size, y) in texts {
            self.text((0.5 * self.width, y), &content, Text::new(size, "middle"));
        }
        // Panels side by side keep their places; on a narrower page they shrink.
        let scale = (figure_width::pixels() / self.width).min(1.0);
        let scale = if figure_width::is_narrow() {
            scale
        } else {
            1.0
        };
        Figure {
            name: name.into(),
            title: format!("{title}: {caption}"),
            svg: format!(
                r#"<svg xmlns="http://www.w3.org/2000/svg" width="{3}" height="{4}" viewBox="0 0 {0} {1}" font-family="DejaVu Sans, Arial, sans-serif"><rect width="{0}" height="{1}" fill="white"/>{2}</svg>"#,
                self.width,
                self.height,
                self.svg,
                scale * self.width,
                scale * self.height
            ),
        }
    }
}

/// A text on two lines at most, of at most so many characters each.
fn lines(text: &str, most: usize) -> Vec<String> {
    let text = shorten(text, usize::MAX);
    if text.chars().count() <= most {
        return vec![text];
    }
    let end = text.char_indices().nth(most).map_or(text.len(), |(i, _)| i);
    match text[..end].rfind(' ') {
        Some(space) => vec![text[..space].to_owned(), shorten(&text[space..], most)],
        None => vec![shorten(&text, most)],
    }
}

/// A text on one line of at most so many characters.
pub(crate) fn shorten(text: &str, most: usize) -> String {
    plain(text, most).replace("\\$", "$")
}
