//! Colours that people with any common colour vision tell apart.

use kuva::plot::colormap::ColorMap;

/// Colours of lines, in the order in which series take them: those of Okabe and Ito, yellow last.
pub const SERIES: [&str; 8] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000", "#f0e442",
];

/// Colour of marks and other auxiliary lines.
pub const MARK: &str = "#555555";

/// Colour of measured values.
pub const EXPERIMENT: &str = "#000000";

/// Colours that tell apart series with symbols: all but black, which is what was measured, and yellow, which is faint.
const SYMBOLS: usize = 6;

/// Colour of symbol `index`, which has its marker and its dashes as well.
pub fn symbol_color(index: usize) -> &'static str {
    SERIES[index % SYMBOLS]
}

/// The symbol of a colour and of dashes: what differs in two ways at once has six colours and four kinds of lines.
pub(crate) fn symbol(color: usize, dashes: usize) -> usize {
    color % SYMBOLS + dashes * SYMBOLS
}

/// Dashes and gaps of a line [px], and what a legend calls it.
pub(crate) struct Dashes {
    pub(crate) pattern: &'static str,
    pub(crate) word: &'static str,
}

/// How the line of symbol `index` is interrupted, if it is: so differ the lines of one colour, which returns after each round.
pub(crate) fn symbol_dashes(index: usize) -> Option<Dashes> {
    let (pattern, word) = match (index / SYMBOLS) % 4 {
        1 => ("7 3", "dashed"),
        2 => ("1.5 2.5", "dotted"),
        3 => ("7 2.5 1.5 2.5", "dash-dotted"),
        _ => return None,
    };
    Some(Dashes { pattern, word })
}

/// Colour of failed runs.
pub(crate) const FAILED: &str = "#b3001b";

/// Colour of missing values in a heat map.
pub const NO_VALUE: &str = "#b4b4b4";

/// Colour of series `index`; after the last colour the first one returns.
pub fn series(index: usize) -> &'static str {
    SERIES[index % SERIES.len()]
}

/// Diverging colour of a value between -1 (blue) and 1 (red); 0 is nearly white.
pub fn diverging(value: f64) -> String {
    ColorMap::RedBlue.map(0.5 - 0.5 * value.clamp(-1.0, 1.0))
}

/// Sequential colours from light to dark, of the same steps in lightness.
const SEQUENTIAL: [[u8; 3]; 6] = [
    [0xff, 0xe2, 0x8a],
    [0xfd, 0xae, 0x3d],
    [0xf1, 0x68, 0x2f],
    [0xc7, 0x3a, 0x5b],
    [0x7f, 0x25, 0x79],
    [0x35, 0x12, 0x5f],
];

/// Sequential colour of a value between 0 (light yellow) and 1 (dark purple).
pub(crate) fn sequential(value: f64) -> [u8; 3] {
    let place = value.clamp(0.0, 1.0) * (SEQUENTIAL.len() - 1) as f64;
    let below = (place as usize).min(SEQUENTIAL.len() - 2);
    let part = place - below as f64;
    std::array::from_fn(|k| {
        let [low, high] = [SEQUENTIAL[below][k], SEQUENTIAL[below + 1][k]].map(f64::from);
        (low + part * (high - low)).round() as u8
    })
}

/// Colours of bodies in which nothing is to be seen: the projectile, then the layers of a target in turn.
pub(crate) fn body(index: u8) -> [u8; 3] {
    const LAYERS: [[u8; 3]; 3] = [[0xe4, 0xe0, 0xd6], [0xd4, 0xde, 0xd4], [0xde, 0xd6, 0xe2]];
    match index.checked_sub(1) {
        None => [0xa9, 0xbf, 0xd6],
        Some(layer) => LAYERS[usize::from(layer) % LAYERS.len()],
    }
}
