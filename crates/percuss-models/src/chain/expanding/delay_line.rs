//! Past values of a quantity at even times.

use std::{collections::VecDeque, ops::RangeInclusive};

use serde::{Deserialize, Serialize};

/// Samples of a quantity that is 0 before time 0.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct DelayLine {
    /// Time between two samples [s].
    spacing: f64,
    samples: VecDeque<f64>,
    /// Samples that were dropped because they are too old.
    dropped: usize,
    most: usize,
    last: [f64; 2],
}

impl DelayLine {
    /// With a time between samples [s] and the number of them that are kept.
    pub(super) fn new(spacing: f64, most: usize) -> Self {
        Self {
            spacing,
            samples: VecDeque::from([0.0]),
            dropped: 0,
            most,
            last: [0.0; 2],
        }
    }

    pub(super) fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Adds a value at a later time [s]; between two of them it is linear.
    pub(super) fn push(&mut self, time: f64, value: f64) {
        let [from, before] = self.last;
        loop {
            let next = (self.dropped + self.samples.len()) as f64 * self.spacing;
            if next > time {
                break;
            }
            let part = (next - from) / (time - from);
            self.samples.push_back(before + (value - before) * part);
            if self.samples.len() > self.most {
                self.samples.pop_front();
                self.dropped += 1;
            }
        }
        self.last = [time, value];
    }

    /// Value at a time, by the cubic through four samples (Catmull and Rom), which has a continuous slope.
    pub(super) fn at(&self, time: f64) -> f64 {
        let place = Place::new(time / self.spacing);
        self.interpolate(&place, place.before)
    }

    /// Values at the times `time - k delay spacing` for some rising numbers k, as long as they are not before time 0.
    pub(super) fn delayed(
        &self,
        time: f64,
        delay: i64,
        numbers: RangeInclusive<i64>,
    ) -> impl Iterator<Item = f64> + '_ {
        // Whole numbers of samples apart, all of them have the same place between two samples.
        let place = Place::new(time / self.spacing);
        numbers
            .map(move |k| place.before - k * delay)
            .take_while(|before| *before >= -1)
            .map(move |before| self.interpolate(&place, before))
    }

    /// Value at a place behind the sample of a number.
    fn interpolate(&self, place: &Place, before: i64) -> f64 {
        let [a, b, c, d] = self.four(before - 1);
        let [behind, ahead, slope_behind, slope_ahead] = place.weights;
        b * behind + c * ahead + 0.5 * (c - a) * slope_behind + 0.5 * (d - b) * slope_ahead
    }

    /// Samples from a number on.
    fn four(&self, first: i64) -> [f64; 4] {
        // Mostly they stand side by side.
        let near = usize::try_from(first).ok();
        let near = near.and_then(|number| number.checked_sub(self.dropped));
        let (samples, _) = self.samples.as_slices();
        match near.and_then(|place| samples.get(place..)?.first_chunk()) {
            Some(four) => *four,
            None => [0, 1, 2, 3].map(|k| self.sample(first + k)),
        }
    }

    fn sample(&self, number: i64) -> f64 {
        let Ok(number) = usize::try_from(number) else {
            return 0.0;
        };
        let place = number.saturating_sub(self.dropped);
        let last = self.samples.len() - 1;
        self.samples[place.min(last)]
    }
}

/// A place between two samples.
#[derive(Debug, Clone, Copy)]
struct Place {
    /// Number of the sample before it.
    before: i64,
    /// Weights of the sample before and of the one after it, and of the slopes there.
    weights: [f64; 4],
}

impl Place {
    /// At a time over the time between two samples.
    fn new(place: f64) -> Self {
        // Rounded down without a call.
        let towards_zero = place as i64;
        let before = towards_zero - i64::from(towards_zero as f64 > place);
        let x = place - before as f64;
        let (square, cube) = (x * x, x * x * x);
        Self {
            before,
            weights: [
                2.0 * cube - 3.0 * square + 1.0,
                3.0 * square - 2.0 * cube,
                cube - 2.0 * square + x,
                cube - square,
            ],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::DelayLine;

    #[test]
    fn a_parabola_is_met_and_old_samples_are_dropped() {
        let mut line = DelayLine::new(0.1, 64);
        let mut time = 0.0;
        while time < 20.0 {
            time += 0.013;
            line.push(time, time * time);
        }
        for time in [15.0_f64, 16.04, 17.77, 19.5] {
            // The values between pushes are linear: 0.013²/4 off at most.
            assert!((line.at(time) - time * time).abs() < 5e-5, "{time}");
        }
        assert_eq!(line.samples.len(), 64);
        assert_eq!(line.at(-3.0), 0.0);
    }

    #[test]
    fn delayed_values_are_those_of_earlier_times() {
        let mut line = DelayLine::new(0.1, 1000);
        for i in 1..=400 {
            line.push(f64::from(i) * 0.05, (f64::from(i) * 0.05).sin());
        }
        let values: Vec<f64> = line.delayed(19.03, 50, 1..=10).collect();
        assert_eq!(values.len(), 3);
        for (value, k) in values.iter().zip(1..) {
            assert_eq!(*value, line.at(19.03 - 5.0 * f64::from(k)));
            assert!((value - (19.03 - 5.0 * f64::from(k)).sin()).abs() < 1e-3);
        }
    }
}
