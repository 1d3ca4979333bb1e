//! Pictures of bodies from material points.

use super::{layer::Layer, vtp_points::Points};

/// Pixels along an edge of one pixel of the finished picture, which is their mean.
const FINER: usize = 2;
/// Index where there is no body.
pub(crate) const NOTHING: u8 = u8::MAX;

/// Part of the plane that a picture shows: as wide on either side of the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Largest radius [m].
    pub radius: f64,
    /// Smallest and largest depth [m].
    pub depth: (f64, f64),
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
    // A body of revolution has only the half beyond the axis, and the other one is its mirror image; a plane body has both.
    let is_whole = points.places.iter().any(|[across, _]| *across < 0.0);
    let half = width.div_ceil(2);
    let shown = if is_whole { width } else { half };
    let (columns, rows) = (shown * FINER, height * FINER);
    let across = (width * FINER) as f32 / (2.0 * view.radius as f32);
    let down = rows as f32 / (view.depth.1 - view.depth.0) as f32;
    let place = |[radius, depth]: [f32; 2]| {
        let y = (depth - view.depth.0 as f32) * down;
        let left = if is_whole { view.radius as f32 } else { 0.0 };
        [(radius + left) * across, y]
    };
    let size = middle(&points.sizes) * down;
    let mut fine = Fine {
        columns,
        body: vec![NOTHING; columns * rows],
        inside: vec![0.0; columns * rows],
        value: vec![0.0; columns * rows],
    };
    // Each body by itself, so that what closes gaps in one leaves those between two. The last plane body is the lattice: its gaps are slots and cracks.
    let last = points.bodies.iter().copied().max().unwrap_or(0);
    for this in 0..=last {
        let mut layer = Layer::new((columns, rows), size, is_whole && this == last);
        for (index, _) in points
            .bodies
            .iter()
            .enumerate()
            .filter(|(_, body)| **body == this)
        {
            layer.add(place(points.places[index]), points.values[index]);
        }
        layer.close();
        fine.paint(&layer, this);
    }
    let mut pixels = vec![[0; 3]; width * height];
    for row in 0..height {
        for column in 0..shown {
            let mut mean = [0_u32; 3];
            for i in 0..FINER * FINER {
                let (x, y) = (column * FINER + i % FINER, row * FINER + i / FINER);
                let depth = || view.depth.0 + (y as f64 + 0.5) / f64::from(down);
                let color = fine.color((x, y), depth, paint);
                for (sum, entry) in mean.iter_mut().zip(color) {
                    *sum += u32::from(entry);
                }
            }
            let color = mean.map(|sum| (sum / (FINER * FINER) as u32) as u8);
            if is_whole {
                pixels[row * width + column] = color;
                continue;
            }
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

/// Pixels of the finer picture of the half beyond the axis.
struct Fine {
    columns: usize,
    body: Vec<u8>,
    /// How far a pixel lies inside its body [px].
    inside: Vec<f32>,
    value: Vec<f32>,
}

impl Fine {
    /// Takes the pixels that lie deeper inside a body than in those before.
    fn paint(&mut self, layer: &Layer, body: u8) {
        let columns = self.columns.max(1);
        let bodies = self.body.chunks_exact_mut(columns);
        let insides = self.inside.chunks_exact_mut(columns);
        let values = self.value.chunks_exact_mut(columns);
        for (row, ((bodies, insides), values)) in bodies.zip(insides).zip(values).enumerate() {
            let line = layer.line(row as f32 + 0.5);
            for column in 0..columns {
                let [inside, value] = line.at(column as f32 + 0.5);
                if inside > insides[column] {
                    (bodies[column], insides[column], values[column]) = (body, inside, value);
                }
            }
        }
    }

    fn color(
        &self,
        (column, row): (usize, usize),
        depth: impl Fn() -> f64,
        paint: &dyn Paint,
    ) -> [u8; 3] {
        let at = row * self.columns + column;
        let own = self.body[at];
        if own == NOTHING {
            return paint.nothing(depth());
        }
        let differs = |column: usize, row: usize| {
            let other = self.body.get(row * self.columns + column);
            column < self.columns && other.is_some_and(|other| *other != own)
        };
        let is_edge = differs(column + FINER, row)
            || differs(column.saturating_sub(FINER), row)
            || differs(column, row + FINER)
            || differs(column, row.saturating_sub(FINER));
        if is_edge {
            paint.edge()
        } else {
            paint.color(own, self.value[at])
        }
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

    /// A square of 10 by 10 to the left of the axis.
    #[test]
    fn a_body_on_both_sides_of_the_axis_is_not_mirrored() {
        let mut points = Points::default();
        for cell in 0..100_u8 {
            let (column, row) = (f32::from(cell % 10), f32::from(cell / 10));
            points.places.push([column - 19.5, row + 0.5]);
            points.bodies.push(0);
            points.sizes.push(1.0);
            points.values.push(7.0);
        }
        let view = View {
            radius: 50.0,
            depth: (-50.0, 50.0),
        };
        let picture = draw(&points, view, (200, 200), &Plain);
        let at = |column: usize| picture.pixels[110 * 200 + column];
        assert_eq!(at(70), [200, 0, 7]);
        assert_eq!((at(55), at(130)), ([255; 3], [255; 3]));
    }

    /// A plane projectile on a plane target with a slot 1.6 particles wide: gaps of the target stay open, those of the projectile are closed.
    #[test]
    fn slots_of_a_plane_target_stay_open() {
        let mut points = Points::default();
        for (body, depths) in [(0_u8, -20..0), (1, 0..20)] {
            for depth in depths {
                for column in (-30..30).filter(|column| *column != 0) {
                    let aside = if column > 0 { 0.3 } else { -0.3 };
                    points
                        .places
                        .push([column as f32 + aside, depth as f32 + 0.5]);
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
        let picture = draw(&points, view, (200, 200), &Plain);
        let at = |depth: usize| picture.pixels[(100 + 2 * depth - 20) * 200 + 100];
        assert_eq!((at(0), at(20)), ([200, 0, 7], [255; 3]));
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
