//! Colours that people with any common colour vision tell apart.

use kuva::plot::colormap::ColorMap;
use percuss::model;

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

/// After so many symbols both colours and the nine markers return.
pub(crate) const MARKED: usize = 18;

/// Colour of symbol `index`, which has its marker and its dashes as well.
pub fn symbol_color(index: usize) -> &'static str {
    SERIES[index % SYMBOLS]
}

/// The symbol of a material at one of so many strain rates: it gives the colour, the rate the dashes; the seventh material has the colour
/// of the first one and other dashes.
pub(crate) fn flow_symbol(material: usize, rate: usize, rates: usize) -> usize {
    let round = material / SYMBOLS * rates + rate;
    material % SYMBOLS + round * SYMBOLS
}

/// Dashes and gaps of the kinds of lines [px]: full, dashed, dotted, dash-dotted and so on.
const DASHES: [Option<&str>; 8] = [
    None,
    Some("7 3"),
    Some("1.5 2.5"),
    Some("7 2.5 1.5 2.5"),
    Some("13 3"),
    Some("7 2 1.5 2 1.5 2"),
    Some("3 6"),
    Some("13 2.5 3 2.5"),
];

/// Dashes and gaps of the lines of a round of colours [px], if any: so differ the lines of one colour, which returns after each round.
pub(crate) fn dashes(round: usize) -> Option<&'static str> {
    DASHES[round % DASHES.len()]
}

/// Dashes and gaps of the line of symbol `index` [px], if any.
pub(crate) fn symbol_dashes(index: usize) -> Option<&'static str> {
    dashes(index / SYMBOLS)
}

/// Models that are often in one figure, in the order of their symbols: they differ in colour. Others follow in the order of all models.
const TOGETHER: [&str; 23] = [
    "chain",
    "fdm",
    "axi",
    "energy_balance",
    "momentum_balance",
    "crater_energy",
    "plate_cavity",
    "tate",
    "power_balance",
    "plugging",
    "awerbuch_bodner",
    "recht_ipson",
    "hydrodynamic",
    "walker_anderson",
    "lambert_jonas",
    "forrestal",
    "poncelet",
    "lanz_odermatt",
    "cavity_expansion",
    "forrestal_concrete",
    "particles",
    "wilkins_guinan",
    "taylor",
];

/// All models in the order of their symbols.
fn models() -> impl Iterator<Item = &'static str> {
    let all = model::MODELS.iter().map(|model| model.name());
    let others = all.filter(|name| !TOGETHER.contains(name));
    TOGETHER.into_iter().chain(others)
}

/// Symbols of the models of a figure: a model has the same one in every figure. Variants of a model after the first one, as `chain: column`,
/// and models that are not in the list of models have those after them, in their order.
pub fn model_symbols<'a>(names: impl IntoIterator<Item = &'a str>) -> Vec<usize> {
    let after = models().count();
    let mut taken: Vec<usize> = Vec::new();
    for name in names {
        let model = name.split(':').next().unwrap_or(name);
        let own = models().position(|known| known == model);
        let others = taken.iter().filter(|symbol| **symbol >= after);
        let free = after + others.count();
        taken.push(own.filter(|own| !taken.contains(own)).unwrap_or(free));
    }
    taken
}

/// Colour of failed runs.
pub(crate) const FAILED: &str = "#b3001b";

/// Colour of missing values in a heat map.
pub const NO_VALUE: &str = "#b4b4b4";

/// Dashes and gaps of series `index` [px], if any: after the last colour the lines differ by them.
pub(crate) fn series_dashes(index: usize) -> Option<&'static str> {
    dashes(index / SERIES.len())
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_model_has_a_colour_and_dashes_of_its_own() {
        let names: Vec<&str> = model::MODELS.iter().map(|model| model.name()).collect();
        let symbols = model_symbols(names.iter().copied());
        let looks: Vec<_> = symbols
            .iter()
            .map(|symbol| (symbol_color(*symbol), symbol_dashes(*symbol)))
            .collect();
        for (i, look) in looks.iter().enumerate() {
            assert!(!looks[..i].contains(look), "{}", names[i]);
        }
        // It is the same in another figure.
        assert_eq!(model_symbols(["plugging", "chain"]), [9, 0]);
        let free = models().count();
        assert_eq!(
            model_symbols(["chain: column", "mine", "chain: diverging", "fdm"]),
            [0, free, free + 1, 1]
        );
    }
}
