//! Width of the figures that are drawn.

use std::{cell::Cell, ops::RangeInclusive};

use percuss::units::Length;

/// Widths of figures in print: from a narrow column to a page, which is the usual width.
pub const FIGURE_WIDTHS: RangeInclusive<Length> = Length::new(0.06)..=Length::new(PAGE);

/// Width of a page [m].
const PAGE: f64 = 0.182;
/// SVG user units of a page.
const PAGE_PIXELS: f64 = 860.0;
/// Figures narrower than this have their legends below and smaller titles [px].
const NARROW: f64 = 640.0;

thread_local! {
    static PIXELS: Cell<f64> = const { Cell::new(PAGE_PIXELS) };
}

/// Draws figures that are so wide in print; texts keep their size. The width holds for what `draw` draws on this thread.
pub fn with_figure_width<T>(width: Length, draw: impl FnOnce() -> T) -> T {
    /// Puts the former width back, also after a panic.
    struct Former(f64);
    impl Drop for Former {
        fn drop(&mut self) {
            PIXELS.set(self.0);
        }
    }
    let pixels = (PAGE_PIXELS * width.si() / PAGE).round();
    let _former = Former(PIXELS.replace(pixels));
    draw()
}

/// The width [px].
pub(crate) fn pixels() -> f64 {
    PIXELS.get()
}

/// Whether a legend beside the plot would leave it too little.
pub(crate) fn is_narrow() -> bool {
    pixels() < NARROW
}
