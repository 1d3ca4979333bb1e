//! Pictures of a field: the bodies mirrored in the axis, with scales, colour bar and time.

use kuva::plot::LinePlot;
use percuss::units::significant;
use resvg::tiny_skia::{Pixmap, PremultipliedColorU8};

use super::{
    colors::{Colors, LEVELS},
    raster::{self, View},
    vtp_points::Points,
};
use crate::{
    Axis, Figure, ReportError,
    color_bar::{self, ColorBar},
    figure_width,
    frame::{Frame, Head},
    pixels::draw_over,
};

/// Space at the right for the colour bar, its numbers and its label [px].
const BAR_MARGIN: f64 = 124.0;
/// Space above the colour bar for the time [px].
const TIME: f64 = 46.0;
/// Height of the part that shows the bodies [px].
const HEIGHTS: (f64, f64) = (320.0, 760.0);

/// What all pictures of a series have in common.
pub(crate) struct Canvas {
    figure: Figure,
    colors: Colors,
    view: View,
    /// Left, top, width and height of the part that shows the bodies [px].
    place: [f64; 4],
    /// Line below the depth: what the depth is of.
    pub(super) note: String,
}

impl Canvas {
    /// A canvas for a view, which is widened to the shape of the picture.
    pub(crate) fn new(title: &str, caption: &str, colors: Colors, view: View) -> Self {
        // What texts and tick labels leave is known only once they are set.
        let first = draw(title, caption, colors, view, 600.0);
        let [_, _, width, height] = first.place;
        let span = view.depth.1 - view.depth.0;
        let wanted = width * span / (2.0 * view.radius);
        let tall = wanted.clamp(HEIGHTS.0, HEIGHTS.1);
        let factor = wanted / tall;
        let view = if factor > 1.0 {
            View {
                radius: view.radius * factor,
                ..view
            }
        } else {
            let more = 0.5 * span * (1.0 / factor - 1.0);
            View {
                depth: (view.depth.0 - more, view.depth.1 + more),
                ..view
            }
        };
        draw(title, caption, colors, view, 600.0 - height + tall)
    }

    /// The picture of a frame, at a number of pixels per SVG user unit; `base` is the canvas at that scale.
    pub(crate) fn picture(
        &self,
        points: &Points,
        base: &Pixmap,
        scale: f32,
    ) -> Result<Pixmap, ReportError> {
        let mut pixels = base.clone();
        // The border of the plot stays to be seen.
        let [left, top, width, height] = self.place.map(|x| x * f64::from(scale));
        let (left, top) = (left.round() as usize + 1, top.round() as usize + 1);
        let size = (width.round() as usize - 2, height.round() as usize - 2);
        let drawing = raster::draw(points, self.view, size, &self.colors);
        let across = pixels.width() as usize;
        let all = pixels.pixels_mut();
        for (row, colors) in drawing.pixels.chunks_exact(drawing.width).enumerate() {
            let start = (top + row) * across + left;
            for (pixel, [r, g, b]) in all[start..start + drawing.width].iter_mut().zip(colors) {
                if let Some(color) = PremultipliedColorU8::from_rgba(*r, *g, *b, u8::MAX) {
                    *pixel = color;
                }
            }
        }
        draw_over(&mut pixels, &self.stamp(points), scale)?;
        Ok(pixels)
    }

    /// The canvas without bodies.
    pub(crate) fn base(&self, scale: f32) -> Result<Pixmap, ReportError> {
        self.figure.pixels(scale)
    }

    /// Time and depth above the colour bar.
    fn stamp(&self, points: &Points) -> String {
        let [left, top, width, height] = self.place;
        let x = left + width + color_bar::PLACE.0;
        let total = top + height + 200.0;
        let time = format!("{:.1} µs", points.time * 1e6);
        let mut lines = format!(
            r#"<text x="{x}" y="{}" font-size="16" font-weight="bold">{time}</text>"#,
            top + 14.0
        );
        if !self.colors.wall {
            let depth = format!(
                "{} mm deep",
                significant((points.depth * 1e5).round() / 1e2, 4)
            );
            // A second line leaves the space above the numbers of the bar.
            let (size, places) = match self.note.as_str() {
                "" => (12, vec![(depth.as_str(), 31.0)]),
                note => (10, vec![(depth.as_str(), 25.0), (note, 35.0)]),
            };
            for (line, below) in places {
                let y = top + below;
                lines += &format!(r#"<text x="{x}" y="{y}" font-size="{size}">{line}</text>"#);
            }
        }
        let wide = figure_width::pixels();
        format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="{wide}" height="{total}" font-family="DejaVu Sans">{lines}</svg>"#
        )
    }
}

fn draw(title: &str, caption: &str, colors: Colors, view: View, height: f64) -> Canvas {
    let (x, y) = (
        (-view.radius * 1e3, view.radius * 1e3),
        (-view.depth.1 * 1e3, -view.depth.0 * 1e3),
    );
    let mut head = Head::new("field", title);
    head.caption = caption.to_owned();
    let axes = [
        &Axis::new("Distance from the axis (mm)").range(x.0, x.1),
        &Axis::new("Depth (mm)").range(y.0, y.1).downward(),
    ];
    let frame = Frame {
        height,
        right_margin: Some(BAR_MARGIN),
        ..Frame::new(&head, axes, (x, y))
    };
    let mut place = [0.0; 4];
    // Axes are drawn only for a plot, so there is one without content.
    let figure = frame.draw(vec![LinePlot::new().into()], |scene, layout| {
        place = [
            layout.margin_left,
            layout.margin_top,
            layout.plot_width(),
            layout.plot_height(),
        ];
        let hex = |[r, g, b]: [u8; 3]| format!("#{r:02x}{g:02x}{b:02x}");
        let bar = ColorBar {
            colors: (0..LEVELS).map(|level| hex(colors.band(level))).collect(),
            ends: colors.range,
            label: colors.quantity.label(),
            below_top: TIME,
        };
        bar.draw(scene, layout);
    });
    Canvas {
        note: String::new(),
        figure,
        colors,
        view,
        place,
    }
}
