//! Past values of a quantity at even times.

use std::collections::VecDeque;

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
        self.interpolate(time / self.spacing)
    }

    /// Values at the times `time - k delay spacing` for k = 1, 2, … back to time 0, at most so many.
    pub(super) fn delayed(
        &self,
        time: f64,
        delay: f64,
        most: usize,
    ) -> impl Iterator<Item = f64> + '_ {
        let now = time / self.spacing;
        (1..=most)
            .map(move |k| now - k as f64 * delay)
            .take_while(|place| *place > -1.0)
            .map(|place| self.interpolate(place))
    }

    fn interpolate(&self, place: f64) -> f64 {
        let before = place.floor();
        let x = place - before;
        let [a, b, c, d] = [-1.0, 0.0, 1.0, 2.0].map(|k| self.sample(before + k));
        let slope = [0.5 * (c - a), 0.5 * (d - b)];
        let (square, cube) = (x * x, x * x * x);
        b * (2.0 * cube - 3.0 * square + 1.0)
            + c * (3.0 * square - 2.0 * cube)
            + slope[0] * (cube - 2.0 * square + x)
            + slope[1] * (cube - square)
    }

    fn sample(&self, number: f64) -> f64 {
        if number < 0.0 {
            return 0.0;
        }
        let place = (number as usize).saturating_sub(self.dropped);
        let last = self.samples.len() - 1;
        self.samples[place.min(last)]
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
        let values: Vec<f64> = line.delayed(19.03, 50.0, 10).collect();
        assert_eq!(values.len(), 3);
        for (value, k) in values.iter().zip(1..) {
            assert_eq!(*value, line.at(19.03 - 5.0 * f64::from(k)));
            assert!((value - (19.03 - 5.0 * f64::from(k)).sin()).abs() < 1e-3);
        }
    }
}
