//! Canvas, captions, axes, grid and legend of all charts.

use std::sync::Arc;

use kuva::{
    backend::svg::SvgBackend,
    render::{
        annotations::ReferenceLine,
        layout::{ComputedLayout, Layout, TickFormat},
        plots::Plot,
        render::{Scene, render_multiple},
        theme::Theme,
    },
};

use serde::Serialize;

use crate::{Axis, Figure, figure_width, legend::Legend, text::plain};

/// Height of figures whose content does not ask for another one [px].
pub(crate) fn height() -> f64 {
    match figure_width::is_narrow() {
        true => (0.72 * figure_width::pixels()).max(280.0),
        false => 500.0,
    }
}
/// Right margin of a figure without legend [px].
const RIGHT_MARGIN: f64 = 24.0;
/// Sizes of title, caption and axis labels [px].
const TITLE_SIZE: u32 = 17;
const NARROW_TITLE_SIZE: u32 = 13;
const CAPTION_SIZE: u32 = 12;
const LABEL_SIZE: u32 = 14;
/// Most lines of a title and of a caption.
const TITLE_LINES: usize = 2;
const CAPTION_LINES: usize = 3;
/// Mean width of a character, in sizes of the font, rather too much than too little.
const CHAR_WIDTH: f64 = 0.6;

/// File stem and texts of a chart.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Head {
    pub(crate) name: String,
    title: String,
    pub(crate) caption: String,
}

impl Head {
    pub(crate) fn new(name: impl Into<String>, title: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            title: title.into(),
            caption: String::new(),
        }
    }
}

/// A chart without its content.
pub(crate) struct Frame<'a> {
    pub(crate) head: &'a Head,
    pub(crate) x: &'a Axis,
    pub(crate) y: &'a Axis,
    /// Smallest and largest value on either axis.
    pub(crate) x_extent: (f64, f64),
    pub(crate) y_extent: (f64, f64),
    pub(crate) height: f64,
    /// Height of the plot over its width, had by the height of the figure.
    pub(crate) aspect: Option<f64>,
    /// Space at the right that the content draws in itself, in place of a legend [px].
    pub(crate) right_margin: Option<f64>,
    pub(crate) legend: Legend,
    pub(crate) marks: Vec<ReferenceLine>,
}

impl<'a> Frame<'a> {
    /// A frame of the usual size without legend and marks.
    pub(crate) fn new(
        head: &'a Head,
        [x, y]: [&'a Axis; 2],
        (x_extent, y_extent): ((f64, f64), (f64, f64)),
    ) -> Self {
        Self {
            head,
            x,
            y,
            x_extent,
            y_extent,
            height: height(),
            aspect: None,
            right_margin: None,
            legend: Legend::default(),
            marks: Vec::new(),
        }
    }

    /// Draws axes and content; `finish` may add to the drawing, for which it gets the place of the axes.
    pub(crate) fn draw(
        mut self,
        plots: Vec<Plot>,
        finish: impl FnOnce(&mut Scene, &ComputedLayout),
    ) -> Figure {
        let place = ComputedLayout::from_layout(&self.layout());
        self.height += match self.aspect {
            Some(aspect) => aspect * place.plot_width() - place.plot_height(),
            // Wrapped titles take nothing from the plot.
            None if figure_width::is_narrow() => place.margin_top,
            None => 0.0,
        };
        if !figure_width::is_narrow() {
            let plot_height = ComputedLayout::from_layout(&self.layout()).plot_height();
            self.height += (self.legend.height() - plot_height).max(0.0);
        }
        let layout = self.layout();
        let place = ComputedLayout::from_layout(&layout);
        let mut scene = render_multiple(plots, layout);
        finish(&mut scene, &place);
        self.draw_legend(&mut scene, &place);
        Figure {
            name: self.head.name.clone(),
            title: match self.head.caption.as_str() {
                "" => self.head.title.clone(),
                caption => format!("{}: {caption}", self.head.title),
            },
            svg: SvgBackend::new().render_scene(&scene),
        }
    }

    /// Beside the plot, or below a narrow one, whose drawing grows by it.
    fn draw_legend(&self, scene: &mut Scene, place: &ComputedLayout) {
        if self.legend.is_empty() {
            return;
        }
        let (left, width) = (place.margin_left, place.plot_width());
        if figure_width::is_narrow() {
            let top = scene.height;
            self.legend.draw_below(scene, left, top, width);
            scene.height += self.legend.height_below(width);
        } else {
            let right = left + width;
            self.legend.draw_beside(scene, right, place.margin_top);
        }
    }

    fn layout(&self) -> Layout {
        let mut theme = Theme::light();
        theme.grid_color = "#e4e4e4".to_owned();
        let mut layout = Layout::new(self.x_extent, self.y_extent)
            .with_theme(theme)
            .with_width(figure_width::pixels())
            .with_height(self.height)
            .with_title_size(title_size())
            .with_label_size(LABEL_SIZE)
            .with_tick_size(12)
            .with_body_size(12)
            .with_grid_line_width(0.8)
            .with_box_axes()
            .with_ticks(ticks())
            .with_tick_format(TickFormat::Custom(Arc::new(tick_label)))
            .with_x_label(plain(&self.x.label, usize::MAX))
            .with_y_label(plain(&self.y.label, usize::MAX));
        layout.data_x_range = Some(self.x_extent);
        layout.data_y_range = Some(self.y_extent);
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
        if self.y.downward {
            let negated = |value: f64| tick_label(-value);
            layout = layout.with_y_tick_format(TickFormat::Custom(Arc::new(negated)));
        }
        if !self.x.names.is_empty() {
            layout = layout.with_x_categories(self.x.names.clone());
        }
        if !self.y.names.is_empty() {
            layout = layout.with_y_categories(self.y.names.clone());
        }
        for mark in &self.marks {
            layout = layout.with_reference_line(mark.clone());
        }
        let left = ComputedLayout::from_layout(&layout).margin_left;
        let beside = !self.legend.is_empty() && !figure_width::is_narrow();
        let right = match beside {
            true => self.legend.width(),
            false => self.right_margin.unwrap_or(RIGHT_MARGIN),
        };
        self.fit_texts(layout.with_force_margins(left, right))
    }

    /// Adds title and caption and wraps all texts to the space they have: they stand centred on the plot.
    fn fit_texts(&self, layout: Layout) -> Layout {
        let place = ComputedLayout::from_layout(&layout);
        let middle = place.margin_left + 0.5 * place.plot_width();
        let width = 2.0 * middle.min(figure_width::pixels() - middle);
        let chars = |space: f64, size: u32| (space / (CHAR_WIDTH * f64::from(size))) as usize;
        let (title, caption) = (chars(width, title_size()), chars(width, CAPTION_SIZE));
        let layout = layout
            .with_title(plain(&self.head.title, TITLE_LINES * title))
            .with_title_wrap(title)
            .with_x_label_wrap(chars(width, LABEL_SIZE))
            .with_y_label_wrap(chars(0.8 * self.height, LABEL_SIZE));
        if self.head.caption.is_empty() {
            return layout;
        }
        layout
            .with_subtitle(plain(
                &self.head.caption,
                (CAPTION_LINES * caption).saturating_sub(10),
            ))
            .with_subtitle_size(CAPTION_SIZE)
            .with_subtitle_wrap(caption)
    }
}

/// About how many ticks have place.
fn ticks() -> usize {
    match figure_width::pixels() {
        ..340.0 => 3,
        _ if figure_width::is_narrow() => 5,
        _ => 7,
    }
}

fn title_size() -> u32 {
    match figure_width::is_narrow() {
        true => NARROW_TITLE_SIZE,
        false => TITLE_SIZE,
    }
}

/// The number at a tick: up to six significant digits, with an exponent where it would be long otherwise.
pub(crate) fn tick_label(value: f64) -> String {
    let trimmed = |text: &str| match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text.to_owned(),
    };
    let size = value.abs();
    let label = if size == 0.0 {
        "0".to_owned()
    } else if (1e-3..1e6).contains(&size) {
        let decimals = (5.0 - size.log10().floor()) as usize;
        trimmed(&format!("{value:.decimals$}"))
    } else {
        let text = format!("{value:.5e}");
        match text.split_once('e') {
            Some((mantissa, exponent)) => format!("{}e{exponent}", trimmed(mantissa)),
            None => text,
        }
    };
    label.replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_short_and_exact() {
        for (value, label) in [
            (0.0, "0"),
            (-0.0, "0"),
            (-2.5, "\u{2212}2.5"),
            (0.001, "0.001"),
            (0.30000000000000004, "0.3"),
            (100_000.0, "100000"),
            (2.5e6, "2.5e6"),
            (-1e-7, "\u{2212}1e\u{2212}7"),
            (1e300, "1e300"),
        ] {
            assert_eq!(tick_label(value), label);
        }
    }

    #[test]
    fn texts_are_shortened_and_hold_no_formulas() {
        assert_eq!(plain("a  price\nin $", 20), "a price in \\$");
        assert_eq!(plain("one two three", 8), "one two…");
    }
}
