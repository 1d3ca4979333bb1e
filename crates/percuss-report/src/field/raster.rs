//! Material points as a picture of the bodies that they make up.

use super::vtp::Points;

/// Pixels along an edge of one pixel of the finished picture, which is their mean.
const FINER: usize = 2;
/// Reach of a particle's body and of its value, in sizes of the particle: bodies close, values are smooth.
const COVERED: f32 = 0.85;
const BLENDED: f32 = 1.4;
/// Index where there is no body.
pub(crate) const NOTHING: u8 = u8::MAX;

/// Part of the plane that a picture shows, mirrored in the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct View {
    /// Largest radius [m].
    pub(crate) radius: f64,
    /// Smallest and largest depth [m].
    pub(crate) depth: (f64, f64),
}

/// A picture: three bytes a pixel, row by row from the top.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Raster {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) pixels: Vec<[u8; 3]>,
}

/// How values and bodies are coloured.
pub(crate) trait Paint: Sync {
    /// Colour of a value in a body.
    fn color(&self, body: u8, value: f32) -> [u8; 3];
    /// Colour where there is nothing, at a depth [m].
    fn nothing(&self, depth: f64) -> [u8; 3];
    /// Colour of the edges of bodies.
    fn edge(&self) -> [u8; 3];
}

/// Draws points.
pub(crate) fn draw(
    points: &Points,
    view: View,
    (width, height): (usize, usize),
    paint: &dyn Paint,
) -> Raster {
    // The half beyond the axis; the other one is its mirror image.
    let (columns, rows) = (width.div_ceil(2) * FINER, height * FINER);
    let across = (width * FINER) as f32 / (2.0 * view.radius as f32);
    let down = rows as f32 / (view.depth.1 - view.depth.0) as f32;
    let place = |index: usize| {
        let [radius, depth] = points.places[index];
        let (x, y) = (radius * across, (depth - view.depth.0 as f32) * down);
        (x, y, points.sizes[index] * down)
    };
    let mut body = vec![NOTHING; columns * rows];
    let mut nearest = vec![f32::INFINITY; columns * rows];
    let near = |(x, y, reach): (f32, f32, f32), act: &mut dyn FnMut(usize, f32)| {
        let range = |middle: f32, most: usize| {
            let from = (middle - reach).floor().max(0.0) as usize;
            from..((middle + reach).ceil().max(0.0) as usize).min(most)
        };
        for row in range(y, rows) {
            let off = row as f32 + 0.5 - y;
            for column in range(x, columns) {
                let aside = column as f32 + 0.5 - x;
                let square = off * off + aside * aside;
                if square < reach * reach {
                    act(row * columns + column, square / (reach * reach));
                }
            }
        }
    };
    for (index, own) in points.bodies.iter().enumerate() {
        let (x, y, size) = place(index);
        near((x, y, (COVERED * size).max(0.8)), &mut |at, square| {
            if square < nearest[at] {
                nearest[at] = square;
                body[at] = *own;
            }
        });
    }
    let mut sums = vec![(0.0_f32, 0.0_f32); columns * rows];
    for (index, own) in points.bodies.iter().enumerate() {
        let (x, y, size) = place(index);
        let value = points.values[index];
        near((x, y, (BLENDED * size).max(1.5)), &mut |at, square| {
            if body[at] == *own {
                let weight = (1.0 - square) * (1.0 - square);
                sums[at].0 += weight;
                sums[at].1 += weight * value;
            }
        });
    }
    let fine = |column: usize, row: usize| -> [u8; 3] {
        let at = row * columns + column;
        let own = body[at];
        let differs = |column: usize, row: usize| {
            column < columns && row < rows && body[row * columns + column] != own
        };
        let around = [
            (column + FINER, row),
            (column.saturating_sub(FINER), row),
            (column, row + FINER),
            (column, row.saturating_sub(FINER)),
        ];
        if own == NOTHING {
            let depth = view.depth.0 + (row as f64 + 0.5) / f64::from(down);
            return paint.nothing(depth);
        }
        if around.iter().any(|(column, row)| differs(*column, *row)) {
            return paint.edge();
        }
        let (weight, sum) = sums[at];
        paint.color(own, if weight > 0.0 { sum / weight } else { 0.0 })
    };
    let half = width.div_ceil(2);
    let mut pixels = vec![[0; 3]; width * height];
    for row in 0..height {
        for column in 0..half {
            let mut mean = [0_u32; 3];
            for i in 0..FINER * FINER {
                let color = fine(column * FINER + i % FINER, row * FINER + i / FINER);
                for (sum, entry) in mean.iter_mut().zip(color) {
                    *sum += u32::from(entry);
                }
            }
            let color = mean.map(|sum| (sum / (FINER * FINER) as u32) as u8);
            let right = width / 2 + column;
            if right < width {
                pixels[row * width + right] = color;
            }
            pixels[row * width + half - 1 - column] = color;
        }
    }
    Raster {
        width,
        height,
        pixels,
    }
}
