//! Material points as a picture of the bodies that they make up.

use super::vtp::Points;

/// Pixels along an edge of one pixel of the finished picture, which is their mean.
const FINER: usize = 2;
/// Reach of a particle, in sizes of the particle, within which it closes gaps to its neighbours in stretched material. What that
/// adds at a surface is taken away again, all but the half size that belongs to the particle.
const REACH: f32 = 2.4;
const OWN: f32 = 0.5;
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
        (radius * across, (depth - view.depth.0 as f32) * down)
    };
    let size = middle(&points.sizes) * down;
    let reach = (REACH * size).max(1.5);
    let near = |(x, y): (f32, f32), act: &mut dyn FnMut(usize, f32)| {
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
    // Each body by itself, so that what closes gaps in one leaves those between two.
    let mut body = vec![NOTHING; columns * rows];
    let mut nearest = vec![f32::INFINITY; columns * rows];
    for this in 0..=points.bodies.iter().copied().max().unwrap_or(0) {
        let mut own = vec![f32::INFINITY; columns * rows];
        for (index, _) in points
            .bodies
            .iter()
            .enumerate()
            .filter(|(_, body)| **body == this)
        {
            near(place(index), &mut |at, square| {
                own[at] = own[at].min(square)
            });
        }
        shrink(&mut own, columns, reach - OWN * size);
        for (at, square) in own.into_iter().enumerate() {
            if square < nearest[at] {
                nearest[at] = square;
                body[at] = this;
            }
        }
    }
    let mut sums = vec![(0.0_f32, 0.0_f32); columns * rows];
    for (index, own) in points.bodies.iter().enumerate() {
        let value = points.values[index];
        near(place(index), &mut |at, square| {
            if body[at] == *own {
                let weight = (1.0 - square).powi(4);
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

/// The middle one of all values.
fn middle(values: &[f32]) -> f32 {
    let mut values = values.to_vec();
    let half = values.len() / 2;
    if values.is_empty() {
        return 0.0;
    }
    *values.select_nth_unstable_by(half, f32::total_cmp).1
}

/// Takes away what is nearer than a distance to a place where there is nothing, which is infinite.
fn shrink(own: &mut [f32], columns: usize, distance: f32) {
    let rows = own.len() / columns.max(1);
    // Distance along the row first; the mirror image beyond the axis, and what is beyond the other edges, is no gap.
    let far = (distance.ceil() as usize + 1) as f32;
    let mut along = vec![far; own.len()];
    for row in 0..rows {
        let row = row * columns;
        let mut last = far;
        for column in 0..columns {
            last = if own[row + column].is_infinite() {
                0.0
            } else {
                (last + 1.0).min(far)
            };
            along[row + column] = last;
        }
        last = far;
        for column in (0..columns).rev() {
            last = if own[row + column].is_infinite() {
                0.0
            } else {
                (last + 1.0).min(far)
            };
            along[row + column] = along[row + column].min(last);
        }
    }
    let square = distance * distance;
    let most = distance as usize;
    for row in 0..rows {
        for column in 0..columns {
            let at = row * columns + column;
            if own[at].is_infinite() {
                continue;
            }
            let near = |other: usize| {
                let off = row.abs_diff(other) as f32;
                let aside = along[other * columns + column];
                off * off + aside * aside <= square
            };
            if (row.saturating_sub(most)..(row + most + 1).min(rows)).any(near) {
                own[at] = f32::INFINITY;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Plain;

    impl Paint for Plain {
        fn color(&self, body: u8, value: f32) -> [u8; 3] {
            [200, body, value.round() as u8]
        }
        fn nothing(&self, _: f64) -> [u8; 3] {
            [255; 3]
        }
        fn edge(&self) -> [u8; 3] {
            [0; 3]
        }
    }

    /// A rod of 20 by 40 particles on a target, stretched across by a factor.
    fn picture(stretch: f32) -> Raster {
        let mut points = Points::default();
        for (body, range) in [(0_u8, -40..0), (1, 0..20)] {
            for depth in range {
                let radii = if body == 0 { 20 } else { 60 };
                for radius in 0..radii {
                    let radius = (radius as f32 + 0.5) * if body == 0 { stretch } else { 1.0 };
                    points.places.push([radius, depth as f32 + 0.5]);
                    points.bodies.push(body);
                    points.sizes.push(1.0);
                    points.values.push(7.0);
                }
            }
        }
        let view = View {
            radius: 50.0,
            depth: (-50.0, 50.0),
        };
        draw(&points, view, (200, 200), &Plain)
    }

    #[test]
    fn bodies_have_their_size_without_gaps_even_where_they_are_stretched() {
        for stretch in [1.0, 2.0] {
            let picture = picture(stretch);
            let count = |color: [u8; 3]| picture.pixels.iter().filter(|c| **c == color).count();
            // Four pixels a unit of area; edges take a part of the perimeter.
            let rod = 4.0 * 40.0 * 40.0 * stretch;
            let share = count([200, 0, 7]) as f32 / rod;
            assert!((0.93..=1.0).contains(&share), "{stretch}: {share}");
            let across = |column: usize| picture.pixels[60 * 200 + column];
            assert_eq!(across(99), across(100));
            assert_eq!(across(100), [200, 0, 7]);
            assert_eq!(across(2), [255; 3]);
        }
    }
}
