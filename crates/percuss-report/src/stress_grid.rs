//! Stress along the axis over time, resampled from profiles onto a regular grid.

use percuss::history::{ElementState, Profile};

/// Neighbouring elements farther apart than this many spacings have lost one between them.
pub(crate) const GAP: f64 = 1.6;

/// Times in a row of the grid that its stresses are the mean of: a wave that crosses many columns within a row is a line then.
const TIMES_PER_ROW: usize = 4;

/// Stress on a regular grid over initial position and time.
#[derive(Debug)]
pub(crate) struct StressGrid {
    /// Initial positions that the grid covers [m].
    pub(crate) positions: (f64, f64),
    /// Times that the grid covers [s].
    pub(crate) times: (f64, f64),
    /// Stress [Pa], NaN where the element has eroded; a row for each time, the first time first.
    pub(crate) rows: Vec<Vec<f64>>,
}

impl StressGrid {
    /// Interpolates between elements of a part and between profiles, and takes the mean over the time of a row; `None` without two
    /// profiles of different times.
    pub(crate) fn resample(profiles: &[Profile], [columns, rows]: [usize; 2]) -> Option<Self> {
        let (first, last) = (profiles.first()?, profiles.last()?);
        if first.elements.is_empty() || last.time <= first.time {
            return None;
        }
        let parts = first.elements.chunk_by(|a, b| a.part == b.part);
        let spacings: Vec<f64> = parts.map(|part| spacing(first, part[0].part)).collect();
        let edge = |element: &ElementState, side: f64| {
            element.initial_position + side * 0.5 * spacings[element.part.min(spacings.len() - 1)]
        };
        let front = edge(first.elements.first()?, -1.0);
        let back = edge(first.elements.last()?, 1.0);
        // A rod alone ends at the face: at 0 but for rounding.
        let back = if back.abs() < 1e-9 * (back - front) {
            0.0
        } else {
            back
        };
        let positions = (front, back);
        let times = (first.time, last.time);
        let middle = |range: (f64, f64), i: usize, n: usize| {
            range.0 + (range.1 - range.0) * (i as f64 + 0.5) / n as f64
        };
        let places: Vec<f64> = (0..columns)
            .map(|i| middle(positions, i, columns))
            .collect();
        let on_grid: Vec<Vec<f64>> = profiles
            .iter()
            .map(|profile| stresses(profile, &places, &spacings))
            .collect();
        // Adds a time to the sums and the counts of the columns.
        let add = |time: f64, sums: &mut [(f64, f64)]| {
            let after = profiles
                .partition_point(|profile| profile.time <= time)
                .clamp(1, profiles.len() - 1);
            let (a, b) = (&profiles[after - 1], &profiles[after]);
            let share = if b.time > a.time {
                ((time - a.time) / (b.time - a.time)).clamp(0.0, 1.0)
            } else {
                0.0
            };
            let (earlier, later) = (&on_grid[after - 1], &on_grid[after]);
            for (sum, (a, b)) in sums.iter_mut().zip(earlier.iter().zip(later)) {
                let stress = match b.is_nan() {
                    true if share < 0.5 => *a,
                    true => *b,
                    false => a + share * (b - a),
                };
                if !stress.is_nan() {
                    *sum = (sum.0 + stress, sum.1 + 1.0);
                }
            }
        };
        let row = |j| {
            let mut sums = vec![(0.0, 0.0); columns];
            for i in 0..TIMES_PER_ROW {
                let number = TIMES_PER_ROW * j + i;
                add(middle(times, number, TIMES_PER_ROW * rows), &mut sums);
            }
            // Eroded where it is for most of the row.
            let enough = 0.5 * TIMES_PER_ROW as f64;
            let mean = |(sum, count): (f64, f64)| match count >= enough {
                true => sum / count,
                false => f64::NAN,
            };
            sums.into_iter().map(mean).collect()
        };
        Some(Self {
            positions,
            times,
            rows: (0..rows).map(row).collect(),
        })
    }
}

/// Distance between neighbouring elements of a part [m]; the length of the element if there is but one.
pub(crate) fn spacing(profile: &Profile, part: usize) -> f64 {
    let elements: Vec<&ElementState> = profile.elements.iter().filter(|e| e.part == part).collect();
    match elements[..] {
        [] => 0.0,
        [only] => only.length,
        [first, .., last] => {
            (last.initial_position - first.initial_position) / (elements.len() - 1) as f64
        }
    }
}

/// Length that an element stands for, of a part with this spacing: far from the impact some are longer than most.
pub(crate) fn reach(element: &ElementState, spacing: f64) -> f64 {
    spacing.max(element.length)
}

/// Stress of a profile at ascending places.
fn stresses(profile: &Profile, places: &[f64], spacings: &[f64]) -> Vec<f64> {
    let elements = &profile.elements;
    let reach = |element: &ElementState| {
        let usual = spacings.get(element.part).copied().unwrap_or(0.0);
        reach(element, usual)
    };
    let at = |place: f64| {
        let after = elements.partition_point(|e| e.initial_position < place);
        let left = after.checked_sub(1).map(|i| &elements[i]);
        let right = elements.get(after);
        if let (Some(a), Some(b)) = (left, right)
            && a.part == b.part
            && b.initial_position - a.initial_position <= GAP * reach(a)
        {
            let share = (place - a.initial_position) / (b.initial_position - a.initial_position);
            return a.stress + share * (b.stress - a.stress);
        }
        // At the end of a part or beside a gap: the element that covers the place, if any.
        let covers = |e: &&ElementState| (place - e.initial_position).abs() <= 0.5001 * reach(e);
        left.filter(covers)
            .or(right.filter(covers))
            .map_or(f64::NAN, |e| e.stress)
    };
    places.iter().map(|place| at(*place)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn element(part: usize, initial_position: f64, stress: f64) -> ElementState {
        ElementState {
            part,
            initial_position,
            position: initial_position,
            displacement: 0.0,
            length: 1.0,
            stress,
            strain: 0.0,
            plastic_strain: 0.0,
            diameter: 1.0,
            temperature: 300.0,
            velocity: 0.0,
        }
    }

    #[test]
    fn cells_lie_between_elements_and_profiles_and_eroded_ones_are_empty() {
        let start = Profile {
            time: 0.0,
            elements: vec![
                element(0, -1.5, 0.0),
                element(0, -0.5, 4.0),
                element(1, 0.5, 8.0),
                element(1, 1.5, 8.0),
            ],
        };
        let mut end = start.clone();
        end.time = 2.0;
        end.elements.remove(1);
        let grid = StressGrid::resample(&[start, end], [8, 2]).unwrap();
        assert_eq!(grid.positions, (-2.0, 2.0));
        // Cells at -1.75, -1.25, -0.75, -0.25, 0.25, ...; times 0.5 and 1.5.
        assert_eq!(grid.rows[0], [0.0, 0.75, 3.0, 4.0, 8.0, 8.0, 8.0, 8.0]);
        assert!(grid.rows[1][2].is_nan() && grid.rows[1][3].is_nan());
        assert_eq!(grid.rows[1][4..], [8.0; 4]);
    }
}
