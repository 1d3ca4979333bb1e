//! Frames of a run as the page draws them: the sections of all particles with four quantities, in 16 bits each.

use percuss::{
    Scenario,
    axi::Particle,
    frames::{Fields, Frame},
    scenario::TargetBody,
};
use percuss_report::{
    FieldColors, FieldQuantity, FieldSpan, FieldView, FrameSelection, usual_range,
};
use serde::Serialize;

/// Quantities of a frame.
pub(super) const QUANTITIES: [FieldQuantity; 4] = [
    FieldQuantity::PlasticStrain,
    FieldQuantity::Pressure,
    FieldQuantity::Temperature,
    FieldQuantity::Speed,
];
/// Columns of a frame: radius, depth, width and height of the section of a particle, then the quantities.
const LENGTHS: usize = 4;
const COLUMNS: usize = LENGTHS + QUANTITIES.len();
/// Largest number of frames of a run, and their largest size [bytes].
const FRAMES: usize = 120;
const BYTES: usize = 24 << 20;
/// Fewest frames that a run may have, whatever their size.
const FEWEST: usize = 8;

/// What stands before the numbers of a frame.
#[derive(Debug, Serialize)]
pub(super) struct FrameHead {
    /// Cells along the projectile's radius.
    cells: u32,
    number: u64,
    /// Whether it is the first of a run, which may be a repeated one.
    first: bool,
    /// Numbers of earlier frames that are left out from now on.
    dropped: Vec<u64>,
    time_us: f64,
    depth_mm: f64,
    /// Side of a cell of the grid.
    cell_mm: f64,
    /// The projectile, then the layers of the target.
    bodies: Vec<BodyHead>,
    /// Values of the smallest and the largest integer of each column: lengths in mm, quantities in the units of their labels.
    scales: [(f32, f32); COLUMNS],
    /// Values of the first and the last colour of each quantity, from all frames so far.
    ranges: [(f64, f64); QUANTITIES.len()],
    /// The same from this frame alone.
    own_ranges: [(f64, f64); QUANTITIES.len()],
    view: ViewHead,
}

#[derive(Debug, Serialize)]
struct BodyHead {
    particles: usize,
    mass_kg: f64,
}

/// Part of the plane to show, from all frames so far.
#[derive(Debug, Serialize)]
struct ViewHead {
    radius_mm: f64,
    depth_mm: (f64, f64),
}

/// Chooses and encodes the frames of a run on one mesh.
pub(super) struct FrameEncoder<'a> {
    scenario: &'a Scenario,
    cells: u32,
    selection: Option<FrameSelection>,
    /// Extremes of each quantity so far.
    values: [Option<(f32, f32)>; QUANTITIES.len()],
    span: Option<FieldSpan>,
}

impl<'a> FrameEncoder<'a> {
    pub(super) fn new(scenario: &'a Scenario, cells: u32) -> Self {
        Self {
            scenario,
            cells,
            selection: None,
            values: [None; QUANTITIES.len()],
            span: None,
        }
    }

    /// A frame as head and body, if it is one of those that are kept.
    pub(super) fn encode(&mut self, frame: &Frame<'_>) -> Option<(FrameHead, Vec<u8>)> {
        let Fields::Particles { cell, bodies, .. } = &frame.fields else {
            return None;
        };
        let first = frame.step == 0;
        if first {
            *self = Self::new(self.scenario, self.cells);
        }
        let particles: Vec<(usize, Particle)> = frame.fields.section().collect();
        let selection = self
            .selection
            .get_or_insert_with(|| FrameSelection::new(most_frames(particles.len())));
        let dropped = selection.add(frame.number, frame.last)?;
        let columns = columns(&particles);
        let own: [(f32, f32); QUANTITIES.len()] =
            std::array::from_fn(|k| usual_range(columns[LENGTHS + k].clone()));
        self.follow(frame, &particles, own);
        let (scales, body) = quantised(&columns);
        let body_head = |index: usize| {
            let own = particles.iter().filter(|(body, _)| *body == index);
            BodyHead {
                particles: own.clone().count(),
                mass_kg: own.map(|(_, particle)| particle.mass).sum(),
            }
        };
        let head = FrameHead {
            cells: self.cells,
            number: frame.number,
            first,
            dropped,
            time_us: frame.time * 1e6,
            depth_mm: frame.depth * 1e3,
            cell_mm: cell * 1e3,
            bodies: (0..bodies.len()).map(body_head).collect(),
            scales,
            ranges: self.ranges(self.values.map(Option::unwrap_or_default)),
            own_ranges: self.ranges(own),
            view: self.view(),
        };
        Some((head, body))
    }

    /// Includes a frame in the extremes.
    fn follow(
        &mut self,
        frame: &Frame<'_>,
        particles: &[(usize, Particle)],
        own: [(f32, f32); QUANTITIES.len()],
    ) {
        for (sofar, (low, high)) in self.values.iter_mut().zip(own) {
            let (least, most) = sofar.unwrap_or((low, high));
            *sofar = Some((least.min(low), most.max(high)));
        }
        let places = particles.iter().map(|(body, particle)| {
            let [radius, depth] = particle.position;
            let half = 0.5 * particle.sides[1];
            ([radius as f32, (depth + half) as f32], *body as u8)
        });
        let span = FieldSpan::new((0.0, 0.0), places, frame.depth);
        self.span = Some(self.span.map_or(span, |sofar| sofar.with(span)));
    }

    /// Values of the first and the last colour for extremes of the quantities.
    fn ranges(&self, extremes: [(f32, f32); QUANTITIES.len()]) -> [(f64, f64); QUANTITIES.len()] {
        let wall = self.scenario.target == TargetBody::RigidWall;
        std::array::from_fn(|k| {
            let (least, most) = extremes[k];
            let values = (f64::from(least), f64::from(most));
            FieldColors::new(QUANTITIES[k], values, wall).range
        })
    }

    fn view(&self) -> ViewHead {
        let view = self.span.map(|span| span.view(self.scenario));
        let FieldView { radius, depth } = view.unwrap_or(FieldView {
            radius: 0.0,
            depth: (0.0, 0.0),
        });
        ViewHead {
            radius_mm: radius * 1e3,
            depth_mm: (depth.0 * 1e3, depth.1 * 1e3),
        }
    }
}

/// Largest number of frames of a run with a number of particles.
fn most_frames(particles: usize) -> usize {
    let size = (2 * COLUMNS * particles).max(1);
    (BYTES / size).clamp(FEWEST, FRAMES)
}

/// Columns of a frame, lengths in mm.
fn columns(particles: &[(usize, Particle)]) -> [Vec<f32>; COLUMNS] {
    let mut columns: [Vec<f32>; COLUMNS] =
        std::array::from_fn(|_| Vec::with_capacity(particles.len()));
    for (_, particle) in particles {
        let [radius, depth] = particle.position;
        let [width, height] = section(particle);
        let lengths = [radius, depth, width, height].map(|length| length * 1e3);
        let values = QUANTITIES.map(|quantity| quantity.value(particle));
        for (column, value) in columns.iter_mut().zip(lengths.into_iter().chain(values)) {
            column.push(value as f32);
        }
    }
    columns
}

/// Width and height of the section of a particle [m]: its sides before the impact, by one factor that gives its area now.
fn section(particle: &Particle) -> [f64; 2] {
    let area = particle.volume / (2.0 * std::f64::consts::PI * particle.position[0].abs());
    let [width, height] = particle.sides;
    match width * height > 0.0 {
        true => [width, height].map(|side| side * (area / (width * height)).sqrt()),
        false => [area.sqrt(); 2],
    }
}

/// Scales of columns, and their integers one column after the other, the lower byte first.
fn quantised(columns: &[Vec<f32>; COLUMNS]) -> ([(f32, f32); COLUMNS], Vec<u8>) {
    let scales = std::array::from_fn(|k| {
        let least = columns[k].iter().copied().fold(f32::INFINITY, f32::min);
        let most = columns[k].iter().copied().fold(f32::NEG_INFINITY, f32::max);
        match least <= most {
            true => (least, most),
            false => (0.0, 0.0),
        }
    });
    let mut body = Vec::with_capacity(2 * COLUMNS * columns[0].len());
    for (column, (least, most)) in columns.iter().zip(scales) {
        let per_unit = match most > least {
            true => f32::from(u16::MAX) / (most - least),
            false => 0.0,
        };
        for value in column {
            // The cast saturates.
            let integer = ((value - least) * per_unit).round() as u16;
            body.extend(integer.to_le_bytes());
        }
    }
    (scales, body)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_section_has_the_area_of_the_ring_and_the_sides_in_their_ratio() {
        let particle = Particle {
            position: [2e-3, 0.0],
            volume: 2.0 * std::f64::consts::PI * 2e-3 * 4e-8,
            sides: [2e-4, 1e-4],
            ..Particle::default()
        };
        let [width, height] = section(&particle);
        assert!((width * height / 4e-8 - 1.0).abs() < 1e-12);
        assert!((width / height - 2.0).abs() < 1e-12);
    }

    #[test]
    fn frames_have_a_number_and_a_size() {
        assert_eq!(most_frames(0), FRAMES);
        assert_eq!(most_frames(5_000), FRAMES);
        let many = 100_000;
        let most = most_frames(many);
        assert!(most < FRAMES && most * many * 2 * COLUMNS <= BYTES);
        assert_eq!(most_frames(10_000_000), FEWEST);
    }

    #[test]
    fn integers_give_values_back_to_a_half_of_a_step() {
        let mut columns: [Vec<f32>; COLUMNS] = std::array::from_fn(|_| vec![3.0; 5]);
        columns[1] = vec![-2.0, -0.5, 0.0, 1.25, 8.0];
        let (scales, body) = quantised(&columns);
        assert_eq!((scales[0], scales[1]), ((3.0, 3.0), (-2.0, 8.0)));
        let step = 10.0 / f32::from(u16::MAX);
        for (i, value) in columns[1].iter().enumerate() {
            let at = 2 * (5 + i);
            let integer = u16::from_le_bytes([body[at], body[at + 1]]);
            assert!((-2.0 + f32::from(integer) * step - value).abs() <= 0.51 * step);
        }
    }
}
