//! Gauges in a chain of elements: between the middles of two elements that stay the same, or at a place.

use crate::history::{ElementState, GaugePlace};

/// A point of the material, between the middles of two elements, or a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gauge {
    /// Body or layer that it belongs to.
    pub part: usize,
    /// Position before the impact [m].
    pub position: f64,
    /// Whether it stays there.
    pub fixed: bool,
    /// Initial positions of the elements' middles [m]; one element twice at the end of a body.
    elements: [f64; 2],
}

impl Gauge {
    /// The gauge among the elements before the impact.
    pub fn new(place: &GaugePlace, elements: &[ElementState]) -> Self {
        let position = place.position;
        let distance = |e: &&ElementState| (e.initial_position - position).abs();
        let nearest = elements
            .iter()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let (part, middle) = nearest.map_or((0, position), |e| (e.part, e.initial_position));
        // The neighbour beyond the position, where the body has one.
        let beyond = (position - middle).signum();
        let neighbour = elements
            .iter()
            .filter(|e| e.part == part && (e.initial_position - middle) * beyond > 0.0)
            .min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let other = neighbour.map_or(middle, |e| e.initial_position);
        Self {
            part,
            position,
            fixed: place.fixed,
            elements: [middle.min(other), middle.max(other)],
        }
    }

    /// State at the gauge, interpolated; not a number when one of the elements has eroded, or where there is no material.
    pub fn read(&self, elements: &[ElementState]) -> ElementState {
        if self.fixed {
            return self.read_place(elements);
        }
        let find = |middle: f64| {
            elements
                .iter()
                .find(|e| e.part == self.part && e.initial_position == middle)
        };
        let [behind, ahead] = self.elements;
        match (find(behind), find(ahead)) {
            (Some(a), Some(b)) if ahead > behind => {
                let fraction = (self.position - behind) / (ahead - behind);
                let state = a.between(b, fraction);
                ElementState {
                    initial_position: self.position,
                    ..state
                }
            }
            // At the end of a body: the state of its last element.
            (Some(a), Some(_)) => *a,
            _ => ElementState::gone(self.part, self.position),
        }
    }

    /// State of the material that is at the place now; of the projectile where it overlaps with the target.
    fn read_place(&self, elements: &[ElementState]) -> ElementState {
        let of_body = |body: &[ElementState]| {
            let behind = body.iter().rfind(|e| e.position <= self.position);
            let ahead = body.iter().find(|e| e.position > self.position);
            match (behind, ahead) {
                (Some(a), Some(b)) if touch(a, b) => {
                    let way = b.position - a.position;
                    Some(a.between(b, (self.position - a.position) / way))
                }
                (a, b) => {
                    let holds =
                        |e: &&ElementState| (e.position - self.position).abs() <= 0.5 * e.length;
                    a.filter(holds).or(b.filter(holds)).copied()
                }
            }
        };
        let found = elements
            .chunk_by(|a, b| a.part == b.part)
            .find_map(of_body)
            .unwrap_or(ElementState::gone(self.part, f64::NAN));
        ElementState {
            position: self.position,
            ..found
        }
    }
}

/// Ends of two neighbours that are no farther apart than this part of their lengths touch.
const ROUNDING: f64 = 1e-6;

/// Whether two elements of a body touch: no crack and no eroded element lies between them.
fn touch(behind: &ElementState, ahead: &ElementState) -> bool {
    let lengths = 0.5 * (behind.length + ahead.length);
    ahead.position - behind.position <= lengths * (1.0 + ROUNDING)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(position: f64, fixed: bool) -> GaugePlace {
        GaugePlace {
            name: String::new(),
            position,
            fixed,
        }
    }

    #[test]
    fn a_fixed_gauge_reads_what_is_there() {
        let start = elements(&[-1.5, -0.5, 0.5, 1.5]);
        let gauge = Gauge::new(&place(0.9, true), &start);
        let moved = |by: f64| {
            let moved = start.iter().map(|e| ElementState {
                position: e.position + by,
                ..*e
            });
            gauge.read(&moved.collect::<Vec<_>>())
        };
        let now = moved(0.0);
        assert!((now.velocity - 9.0).abs() < 1e-12 && (now.initial_position - 0.9).abs() < 1e-12);
        // The other body comes to the place, and then nothing is there.
        let later = moved(1.5);
        assert_eq!((later.part, later.position), (0, 0.9));
        assert!((later.velocity + 6.0).abs() < 1e-12, "{later:?}");
        assert!(moved(5.0).velocity.is_nan());
        // Between elements that have come apart, or without the one in between, is nothing.
        let mut apart = elements(&[0.5, 1.5]);
        apart[1].position += 0.5;
        let gauge = Gauge::new(&place(1.2, true), &start);
        assert!(gauge.read(&apart).velocity.is_nan());
        assert_eq!(
            Gauge::new(&place(1.6, true), &start).read(&apart).velocity,
            15.0
        );
    }

    fn elements(middles: &[f64]) -> Vec<ElementState> {
        let state = |&middle: &f64| ElementState {
            length: 1.0,
            position: middle,
            velocity: 10.0 * middle,
            ..ElementState::gone(usize::from(middle > 0.0), middle)
        };
        middles.iter().map(state).collect()
    }

    #[test]
    fn a_gauge_is_interpolated_within_its_body() {
        let all = elements(&[-1.5, -0.5, 0.5, 1.5]);
        let at = |position: f64| Gauge::new(&place(position, false), &all).read(&all);
        for position in [-1.5, -1.2, -0.8, 0.6, 1.0, 1.4] {
            let state = at(position);
            assert_eq!(state.part, usize::from(position > 0.0));
            assert!(
                (state.velocity - 10.0 * position).abs() < 1e-12,
                "{position}"
            );
        }
        // Beyond the last middle of a body: that of its element.
        assert_eq!(at(-0.1).velocity, -5.0);
        assert_eq!(at(1.9).velocity, 15.0);
    }

    #[test]
    fn a_gauge_ends_with_its_element() {
        let all = elements(&[-1.5, -0.5, 0.5, 1.5]);
        let gauge = Gauge::new(&place(1.0, false), &all);
        let left = elements(&[-1.5, -0.5, 1.5]);
        assert!(gauge.read(&left).velocity.is_nan());
        assert_eq!(gauge.read(&left).initial_position, 1.0);
    }
}
