//! Parallel coordinates: one axis per parameter, one line per run in the colour of its result.
//!
//! The plotting library's own have no logarithmic axes, no words instead of numbers, and a colour per group instead of per value.

use kuva::render::render_utils::generate_ticks;

use super::{PlotStyle, data::Data};
use crate::{
    Figure,
    drawing::{Drawing, Text, shorten},
    figure_width,
    frame::tick_label,
    names, palette,
};

/// Largest number of drawn lines.
const LINES: usize = 1200;
/// Height of the figure [px].
const HEIGHT: f64 = 520.0;
/// Least distance of axes [px].
const APART: f64 = 128.0;
/// Space around the axes: left, right, top, bottom [px].
const MARGINS: [f64; 4] = [78.0, 118.0, 138.0, 62.0];
/// More space at the left for words on the first axis [px].
const WORDS: f64 = 56.0;
/// Width of the bar of colours [px].
const BAR: f64 = 14.0;
/// Places of runs without a result, below the axis of results [px].
const BELOW: [f64; 2] = [20.0, 36.0];

/// Draws all parameters that are varied, and the number.
pub(super) fn draw(data: &Data<'_>) -> Figure {
    let varied = data.varied();
    let gaps = varied.len().max(1) as f64;
    let starts_with_words = varied.first().is_some_and(|i| !data.is_numeric(*i));
    let left = MARGINS[0] + if starts_with_words { WORDS } else { 0.0 };
    let width = figure_width::pixels().max(left + MARGINS[1] + APART * gaps);
    let apart = (width - left - MARGINS[1]) / gaps;
    let at = |axis: usize| left + apart * axis as f64;
    let scales: Vec<Scale> = varied
        .iter()
        .map(|i| Scale::of_parameter(data, *i))
        .collect();
    let number = Scale::new(data.rows.values.iter().copied(), false);
    let runs = data.rows.values.len();
    let drawn: Vec<usize> = (0..runs).filter(|run| is_drawn(*run, runs)).collect();
    let mut drawing = Drawing::new(width, HEIGHT);
    for wanted in [true, false] {
        for &run in &drawn {
            let value = data.rows.values[run];
            if value.is_finite() != wanted {
                continue;
            }
            let (color, end) = match (wanted, data.rows.failed[run]) {
                (true, _) => (hex(number.part(value)), number.y(value)),
                (false, true) => (palette::FAILED.to_owned(), bottom() + BELOW[0]),
                (false, false) => (palette::MARK.to_owned(), bottom() + BELOW[1]),
            };
            let places = varied.iter().zip(&scales).map(|(i, scale)| {
                let value = data.rows.inputs[*i][run];
                scale.y(value
                    + if data.is_numeric(*i) {
                        0.0
                    } else {
                        spread(run)
                    })
            });
            let places = places.chain([end]).enumerate();
            let attributes = match wanted {
                true => r#"stroke-opacity="0.6""#,
                false => r#"stroke-opacity="0.6" stroke-dasharray="4 3""#,
            };
            drawing.curve(places.map(|(axis, y)| (at(axis), y)), &color, attributes);
        }
    }
    for (axis, (i, scale)) in varied.iter().zip(&scales).enumerate() {
        let varied = &data.parameters()[*i];
        let (first, second) = halves(&names::parameter(&varied.key));
        let unit = in_parentheses(&varied.unit);
        let name = [&*first, &*second, &*unit];
        axis_of(&mut drawing, at(axis), &name, &scale.ticks(data, *i), false);
    }
    let place = at(varied.len());
    let (result, unit) = names::result_column(data.quantity);
    let unit = in_parentheses(unit);
    let (first, second) = halves(&names::capitalized(&result));
    bar(&mut drawing, place);
    let name = [&*first, &*second, &*unit];
    axis_of(&mut drawing, place, &name, &number.numbers(), true);
    let all = data.all();
    for (count, what, color, below) in [
        (all.failed, "failed", palette::FAILED, BELOW[0]),
        (all.without, "no value", palette::MARK, BELOW[1]),
    ] {
        if count > 0 {
            let text = Text {
                color,
                ..Text::new(12.0, "start")
            };
            let at = (place + 10.0, bottom() + below + 4.0);
            drawing.text(at, &format!("{what} ({count})"), text);
        }
    }
    let more = match drawn.len() < runs {
        false => String::new(),
        true => format!("{} of {runs} lines drawn", drawn.len()),
    };
    let texts = (&*data.title(), &*data.caption(&more));
    drawing.finish(data.name(PlotStyle::Parallel), texts, [30.0, 52.0])
}

/// Unit in parentheses; empty for a plain number.
fn in_parentheses(unit: &str) -> String {
    match unit {
        "" => String::new(),
        unit => format!("({unit})"),
    }
}

/// Whether a run is among the lines of a figure. Every n-th one would follow the pattern of a grid or of Sobol' points: the fractions of the
/// multiples of √2 follow none.
fn is_drawn(run: usize, runs: usize) -> bool {
    (run as f64 * std::f64::consts::SQRT_2).fract() * (runs as f64) < LINES as f64
}

/// Offset of a line around its word, so that not all lines pass through one point.
fn spread(run: usize) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_895;
    0.6 * ((run as f64 * GOLDEN).fract() - 0.5)
}

/// Height of the foot of the axes.
const fn bottom() -> f64 {
    HEIGHT - MARGINS[3]
}

/// Scale of an axis.
struct Scale {
    low: f64,
    high: f64,
    log: bool,
}

impl Scale {
    fn new(values: impl Iterator<Item = f64>, log: bool) -> Self {
        let finite = values.filter(|value| value.is_finite());
        let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
            (low.min(v), high.max(v))
        });
        match low < high {
            true => Self { low, high, log },
            // One value stands in the middle.
            false if low.is_finite() => Self {
                low: low - 1.0,
                high: low + 1.0,
                log: false,
            },
            false => Self {
                low: 0.0,
                high: 1.0,
                log: false,
            },
        }
    }

    fn of_parameter(data: &Data<'_>, parameter: usize) -> Self {
        let varied = &data.parameters()[parameter];
        match varied.words.len() {
            0 => Self::new(data.values(parameter).into_iter(), varied.kind == "log"),
            // Room for the lines of a word beside each other.
            words => Self::new([-0.5, words as f64 - 0.5].into_iter(), false),
        }
    }

    fn part(&self, value: f64) -> f64 {
        match self.log {
            true => (value / self.low).ln() / (self.high / self.low).ln(),
            false => (value - self.low) / (self.high - self.low),
        }
    }

    fn y(&self, value: f64) -> f64 {
        bottom() - self.part(value) * (bottom() - MARGINS[2])
    }

    fn numbers(&self) -> Vec<(f64, String)> {
        let values = match self.log {
            true => {
                let middle = (self.low * self.high).sqrt();
                vec![self.low, middle, self.high]
            }
            false => generate_ticks(self.low, self.high, 5),
        };
        let tick = |value: f64| {
            let digits: f64 = format!("{value:.3e}").parse().unwrap_or(value);
            (self.y(value), tick_label(digits))
        };
        values.into_iter().map(tick).collect()
    }

    fn ticks(&self, data: &Data<'_>, parameter: usize) -> Vec<(f64, String)> {
        let words = &data.parameters()[parameter].words;
        match words.is_empty() {
            true => self.numbers(),
            false => {
                let tick = |(i, word): (usize, &String)| (self.y(i as f64), word.clone());
                words.iter().enumerate().map(tick).collect()
            }
        }
    }
}

/// An axis with its name above it and its ticks at the left of it, or at the right of the bar of colours.
fn axis_of(drawing: &mut Drawing, x: f64, name: &[&str], ticks: &[(f64, String)], right: bool) {
    drawing.line((x, MARGINS[2]), (x, bottom()), "black", 1.2);
    let lines: Vec<&&str> = name.iter().filter(|line| !line.is_empty()).collect();
    for (i, line) in lines.iter().enumerate() {
        let y = MARGINS[2] - 14.0 - 15.0 * (lines.len() - 1 - i) as f64;
        drawing.text((x, y), &shorten(line, 19), Text::new(12.0, "middle"));
    }
    for (y, text) in ticks {
        let (tick, place, anchor) = match right {
            true => (x + BAR, x + BAR + 8.0, "start"),
            false => (x - 5.0, x - 8.0, "end"),
        };
        drawing.line((tick, *y), (tick + 5.0, *y), "black", 1.0);
        let style = Text {
            halo: true,
            ..Text::new(11.0, anchor)
        };
        drawing.text((place, y + 4.0), &shorten(text, 20), style);
    }
}

/// The colours of the numbers along their axis.
fn bar(drawing: &mut Drawing, x: f64) {
    const STEPS: u32 = 40;
    let height = (bottom() - MARGINS[2]) / f64::from(STEPS);
    for i in 0..STEPS {
        let color = hex((f64::from(i) + 0.5) / f64::from(STEPS));
        let y = bottom() - height * f64::from(i + 1);
        drawing.area((x, y), (BAR, height + 0.3), &color);
    }
}

/// A name on two lines.
fn halves(name: &str) -> (String, String) {
    let middle = name.len() / 2;
    let spaces = name.match_indices(' ').map(|(place, _)| place);
    match spaces.min_by_key(|place| place.abs_diff(middle)) {
        Some(place) => (name[..place].to_owned(), name[place + 1..].to_owned()),
        None => (String::new(), name.to_owned()),
    }
}

fn hex(part: f64) -> String {
    let [r, g, b] = palette::sequential(part);
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every 18th of Sobol' points lies in one half of the first parameter, and every tenth point of a grid of ten in one column.
    #[test]
    fn the_lines_of_a_large_design_are_spread_over_every_parameter() {
        let runs = 20_480;
        let drawn: Vec<usize> = (0..runs).filter(|run| is_drawn(*run, runs)).collect();
        assert!(drawn.len().abs_diff(LINES) < 30, "{}", drawn.len());
        for period in [2, 4, 8, 10, 16, 18, 25, 64] {
            for place in 0..period {
                let count = drawn.iter().filter(|run| *run % period == place).count();
                let even = drawn.len() as f64 / period as f64;
                let part = count as f64 / even;
                assert!((0.5..1.5).contains(&part), "{period} {place}: {part}");
            }
        }
        assert_eq!(
            (0..LINES).filter(|run| is_drawn(*run, LINES)).count(),
            LINES
        );
    }
}
