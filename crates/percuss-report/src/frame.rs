//! What all charts share: canvas, captions, axes, grid and the legend beside the plot, where it covers nothing.

use kuva::{
    backend::svg::SvgBackend,
    plot::legend::{LegendEntry, LegendPosition},
    render::{
        annotations::ReferenceLine,
        layout::{ComputedLayout, Layout},
        plots::Plot,
        render::{Scene, render_multiple},
        theme::Theme,
    },
};

use crate::{Axis, Figure};

/// Width of all figures [px].
pub(crate) const WIDTH: f64 = 860.0;
/// Height of figures whose content does not ask for another one [px].
pub(crate) const HEIGHT: f64 = 500.0;
/// Right margin of a figure without legend [px].
const RIGHT_MARGIN: f64 = 24.0;
/// Most characters of a caption that fit on the canvas.
const CAPTION_CHARS: usize = 110;
/// Most characters of a title that fit on the canvas.
const TITLE_CHARS: usize = 75;

/// A chart without its content.
pub(crate) struct Frame<'a> {
    pub(crate) name: &'a str,
    pub(crate) title: &'a str,
    pub(crate) caption: &'a str,
    pub(crate) x: &'a Axis,
    pub(crate) y: &'a Axis,
    /// Smallest and largest value on either axis.
    pub(crate) x_extent: (f64, f64),
    pub(crate) y_extent: (f64, f64),
    pub(crate) height: f64,
    /// Space at the right that the content draws in itself, in place of a legend [px].
    pub(crate) right_margin: Option<f64>,
    pub(crate) legend: Vec<LegendEntry>,
    pub(crate) marks: Vec<ReferenceLine>,
}

impl Frame<'_> {
    /// Draws axes and content; `finish` may add to the drawing, for which it gets the place of the axes.
    pub(crate) fn draw(
        self,
        plots: Vec<Plot>,
        finish: impl FnOnce(&mut Scene, &ComputedLayout),
    ) -> Figure {
        let layout = self.layout();
        let place = ComputedLayout::from_layout(&layout);
        let mut scene = render_multiple(plots, layout);
        finish(&mut scene, &place);
        Figure {
            name: self.name.to_owned(),
            title: match self.caption {
                "" => self.title.to_owned(),
                caption => format!("{}: {caption}", self.title),
            },
            svg: SvgBackend::new().render_scene(&scene),
        }
    }

    fn layout(&self) -> Layout {
        let mut theme = Theme::light();
        theme.grid_color = "#e4e4e4".to_owned();
        let mut layout = Layout::new(self.x_extent, self.y_extent)
            .with_theme(theme)
            .with_width(WIDTH)
            .with_height(self.height)
            .with_title(plain(self.title, TITLE_CHARS))
            .with_title_size(17)
            .with_label_size(14)
            .with_tick_size(12)
            .with_body_size(12)
            .with_grid_line_width(0.8)
            .with_box_axes()
            .with_ticks(7)
            .with_x_label(plain(&self.x.label, TITLE_CHARS))
            .with_y_label(plain(&self.y.label, TITLE_CHARS));
        layout.data_x_range = Some(self.x_extent);
        layout.data_y_range = Some(self.y_extent);
        if !self.caption.is_empty() {
            layout = layout
                .with_subtitle(plain(self.caption, CAPTION_CHARS))
                .with_subtitle_size(12);
        }
        if self.x.log {
            layout = layout.with_log_x();
        }
        if self.y.log {
            layout = layout.with_log_y();
        }
        if let Some((low, high)) = self.x.fixed_range(self.x_extent) {
            layout = layout.with_x_axis_min(low).with_x_axis_max(high);
        }
        if let Some((low, high)) = self.y.fixed_range(self.y_extent) {
            layout = layout.with_y_axis_min(low).with_y_axis_max(high);
        }
        for mark in &self.marks {
            layout = layout.with_reference_line(mark.clone());
        }
        if self.legend.is_empty() {
            let left = ComputedLayout::from_layout(&layout).margin_left;
            return layout.with_force_margins(left, self.right_margin.unwrap_or(RIGHT_MARGIN));
        }
        layout
            .with_legend_entries(self.legend.clone())
            .with_legend_position(LegendPosition::OutsideRightTop)
            .with_legend_box(false)
    }
}

/// Text as it stands, on one line and not longer than `most` characters: a dollar sign would begin a formula.
pub(crate) fn plain(text: &str, most: usize) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let line = if line.chars().count() > most {
        let kept: String = line.chars().take(most - 1).collect();
        format!("{}…", kept.trim_end())
    } else {
        line
    };
    line.replace('$', "\\$")
}
