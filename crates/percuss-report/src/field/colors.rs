//! Colours of field values.

use super::{FieldQuantity, raster::Paint};
use crate::palette;

/// Bands of colour: their edges are contours, and an animation of few colours is small.
pub(crate) const LEVELS: usize = 24;
/// Part of the range up to which bodies show themselves.
const BARE: f64 = 0.01;
const EDGE: [u8; 3] = [0x30, 0x30, 0x38];
const WALL: [u8; 3] = [0x9a, 0x9a, 0x9a];
const PAPER: [u8; 3] = [0xff; 3];

/// Colours of a quantity over a range, in the unit of its label.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Colors {
    /// The quantity.
    pub quantity: FieldQuantity,
    /// Values of the first and the last colour.
    pub range: (f64, f64),
    /// Whether a rigid wall stands at depth 0.
    pub wall: bool,
}

impl Colors {
    /// Number of bands.
    pub const LEVELS: usize = LEVELS;
    /// Colour of the edges of bodies.
    pub const EDGE: [u8; 3] = EDGE;
    /// Colour of a rigid wall.
    pub const WALL: [u8; 3] = WALL;

    /// Colours for values between a smallest and a largest one, with ends that read well.
    pub fn new(quantity: FieldQuantity, (least, most): (f64, f64), wall: bool) -> Self {
        let range = match quantity {
            FieldQuantity::Pressure => {
                let most = nice(least.abs().max(most));
                (-most, most)
            }
            FieldQuantity::Damage => (0.0, 1.0),
            _ if quantity.starts_at_zero() => (0.0, nice(most)),
            _ => {
                let step = nice((most - least) / 5.0);
                (
                    (least / step + 1e-9).floor() * step,
                    (most / step).ceil() * step,
                )
            }
        };
        let range = if range.1 > range.0 {
            range
        } else {
            (range.0, range.0 + 1.0)
        };
        Self {
            quantity,
            range,
            wall,
        }
    }

    /// Colour of a body where its values show nothing: the projectile, then the layers of a target.
    pub fn body(index: u8) -> [u8; 3] {
        palette::body(index)
    }

    /// Part of the range up to which bodies show themselves.
    pub fn bare(&self) -> f64 {
        match self.quantity.starts_at_zero() {
            true => BARE,
            false => 0.0,
        }
    }

    /// Colour of a band.
    pub fn band(&self, level: usize) -> [u8; 3] {
        let part = (level as f64 + 0.5) / LEVELS as f64;
        match self.quantity {
            FieldQuantity::Pressure => parsed(&palette::diverging(2.0 * part - 1.0)),
            _ => palette::sequential(level as f64 / (LEVELS - 1) as f64),
        }
    }

    /// All colours that a picture is made of.
    pub(crate) fn all(&self) -> Vec<[u8; 3]> {
        let mut all = vec![EDGE, WALL, PAPER];
        all.extend((0..4).map(palette::body));
        all.extend((0..LEVELS).map(|level| self.band(level)));
        all
    }
}

impl Paint for Colors {
    fn color(&self, body: u8, value: f32) -> [u8; 3] {
        let (_, _, unit) = self.quantity.source();
        let part = (f64::from(value) / unit - self.range.0) / (self.range.1 - self.range.0);
        if part < self.bare() && self.quantity.starts_at_zero() {
            return palette::body(body);
        }
        self.band(((part * LEVELS as f64) as usize).min(LEVELS - 1))
    }

    fn nothing(&self, depth: f64) -> [u8; 3] {
        if self.wall && depth > 0.0 {
            WALL
        } else {
            PAPER
        }
    }

    fn edge(&self) -> [u8; 3] {
        EDGE
    }
}

fn parsed(color: &str) -> [u8; 3] {
    let digits = color.trim_start_matches('#');
    if let Some(inside) = color.strip_prefix("rgb(").and_then(|c| c.strip_suffix(')')) {
        let mut parts = inside
            .split(',')
            .map(|part| part.trim().parse().unwrap_or(0));
        return std::array::from_fn(|_| parts.next().unwrap_or(0));
    }
    std::array::from_fn(|k| {
        let pair = digits.get(2 * k..2 * k + 2).unwrap_or("00");
        u8::from_str_radix(pair, 16).unwrap_or(0)
    })
}

/// The next number upwards that reads well.
fn nice(value: f64) -> f64 {
    if value <= 0.0 || !value.is_finite() {
        return 1.0;
    }
    let decade = 10_f64.powf(value.log10().floor());
    let steps = [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0];
    let step = steps
        .into_iter()
        .find(|step| step * decade >= value * (1.0 - 1e-9));
    step.unwrap_or(10.0) * decade
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_of_a_range_read_well_and_every_band_has_a_colour_of_its_own() {
        let colors = |quantity, range| Colors::new(quantity, range, false);
        assert_eq!(
            colors(FieldQuantity::PlasticStrain, (0.0, 1.71)).range,
            (0.0, 2.0)
        );
        assert_eq!(
            colors(FieldQuantity::Temperature, (293.0, 518.0)).range,
            (250.0, 550.0)
        );
        assert_eq!(
            colors(FieldQuantity::Pressure, (-2e3, 700.0)).range,
            (-2e3, 2e3)
        );
        assert_eq!(colors(FieldQuantity::Speed, (0.0, 0.0)).range, (0.0, 1.0));
        for quantity in FieldQuantity::ALL {
            let mut all = colors(quantity, (1.0, 2.0)).all();
            let count = all.len();
            all.sort_unstable();
            all.dedup();
            // Layers of a target take their colours in turn.
            assert!(all.len() + 1 >= count, "{quantity:?}");
        }
    }
}
