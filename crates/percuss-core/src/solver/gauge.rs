//! Gauges in a chain of elements: between the middles of two elements that stay the same.

use crate::history::ElementState;

/// A point of the material, between the middles of two elements.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gauge {
    /// Body or layer that it belongs to.
    pub part: usize,
    /// Position before the impact [m].
    pub position: f64,
    /// Initial positions of the elements' middles [m]; one element twice at the end of a body.
    elements: [f64; 2],
}

impl Gauge {
    /// The gauge at a position [m] among the elements before the impact.
    pub fn new(position: f64, elements: &[ElementState]) -> Self {
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
            elements: [middle.min(other), middle.max(other)],
        }
    }

    /// State at the gauge, interpolated; not a number when one of the elements has eroded.
    pub fn read(&self, elements: &[ElementState]) -> ElementState {
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
}

#[cfg(test)]
mod tests {
    use super::*;

    fn elements(middles: &[f64]) -> Vec<ElementState> {
        let state = |&middle: &f64| ElementState {
            position: middle,
            velocity: 10.0 * middle,
            ..ElementState::gone(usize::from(middle > 0.0), middle)
        };
        middles.iter().map(state).collect()
    }

    #[test]
    fn a_gauge_is_interpolated_within_its_body() {
        let all = elements(&[-1.5, -0.5, 0.5, 1.5]);
        let at = |position: f64| Gauge::new(position, &all).read(&all);
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
        let gauge = Gauge::new(1.0, &all);
        let left = elements(&[-1.5, -0.5, 1.5]);
        assert!(gauge.read(&left).velocity.is_nan());
        assert_eq!(gauge.read(&left).initial_position, 1.0);
    }
}
