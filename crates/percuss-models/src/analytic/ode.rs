//! Ordinary differential equations: an explicit embedded Runge–Kutta pair of order 5(4) that stops at an event.

use crate::bisection::bisect;

/// Nodes and weights of the pair \[dormand1980\]; its last stage is the first one of the next step.
const STAGES: usize = 7;
const WEIGHTS: [[f64; 6]; 6] = [
    [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [
        19372.0 / 6561.0,
        -25360.0 / 2187.0,
        64448.0 / 6561.0,
        -212.0 / 729.0,
        0.0,
        0.0,
    ],
    [
        9017.0 / 3168.0,
        -355.0 / 33.0,
        46732.0 / 5247.0,
        49.0 / 176.0,
        -5103.0 / 18656.0,
        0.0,
    ],
    [
        35.0 / 384.0,
        0.0,
        500.0 / 1113.0,
        125.0 / 192.0,
        -2187.0 / 6784.0,
        11.0 / 84.0,
    ],
];
/// Fifth-order weights less the fourth-order ones.
const ERROR_WEIGHTS: [f64; STAGES] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];
const SAFETY: f64 = 0.9;
const SMALLEST_FACTOR: f64 = 0.2;
const LARGEST_FACTOR: f64 = 5.0;
/// Attempts after which an integration counts as failed.
const MAX_ATTEMPTS: u32 = 200_000;
/// Bisections of the last step: they place the event to rounding.
const BISECTIONS: u32 = 60;

/// One step of the classical Runge–Kutta method of fourth order.
pub(super) fn fourth_order<const N: usize>(
    rates: impl Fn(f64, [f64; N]) -> [f64; N],
    at: f64,
    state: [f64; N],
    step: f64,
) -> [f64; N] {
    let moved = |by: f64, slope: [f64; N]| std::array::from_fn(|k| state[k] + by * slope[k]);
    let first = rates(at, state);
    let second = rates(at + step / 2.0, moved(step / 2.0, first));
    let third = rates(at + step / 2.0, moved(step / 2.0, second));
    let fourth = rates(at + step, moved(step, third));
    let mean = |k: usize| (first[k] + 2.0 * (second[k] + third[k]) + fourth[k]) / 6.0;
    moved(step, std::array::from_fn(mean))
}

/// An autonomous initial value problem that ends when its event function falls to zero.
pub(super) struct Problem<'a, const N: usize> {
    /// Rates of the state.
    pub(super) rates: &'a dyn Fn(&[f64; N]) -> [f64; N],
    /// Positive before the event.
    pub(super) event: &'a dyn Fn(&[f64; N]) -> f64,
    /// Error allowed in a step as a part of the magnitude of each component.
    pub(super) relative: f64,
    /// Error allowed in a step of each component.
    pub(super) absolute: [f64; N],
    /// First step to try.
    pub(super) first_step: f64,
}

/// Where an integration ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FinalState<const N: usize> {
    pub(super) time: f64,
    pub(super) state: [f64; N],
    pub(super) steps: u32,
}

/// An integration that found no step small enough, or no end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct IntegrationError {
    pub(super) time: f64,
    pub(super) attempts: u32,
}

impl<const N: usize> Problem<'_, N> {
    /// Integrates from a state to the event; `watch` sees time and state after every step.
    pub(super) fn solve(
        &self,
        start: [f64; N],
        mut watch: impl FnMut(f64, &[f64; N]),
    ) -> Result<FinalState<N>, IntegrationError> {
        let mut end = FinalState {
            time: 0.0,
            state: start,
            steps: 0,
        };
        if (self.event)(&start) <= 0.0 {
            return Ok(end);
        }
        let mut step = self.first_step;
        for attempts in 1..=MAX_ATTEMPTS {
            let (next, error) = self.step(&end.state, step);
            // Written so that NaN counts as too large an error.
            let accepted = error <= 1.0;
            if accepted {
                if (self.event)(&next) <= 0.0 {
                    return Ok(self.locate(end, step));
                }
                end.time += step;
                end.state = next;
                end.steps += 1;
                watch(end.time, &next);
            }
            let factor = SAFETY * error.powf(-0.2);
            step *= if factor.is_nan() {
                SMALLEST_FACTOR
            } else {
                factor.clamp(SMALLEST_FACTOR, if accepted { LARGEST_FACTOR } else { 1.0 })
            };
            if end.time + step == end.time && end.time > 0.0 {
                return Err(IntegrationError {
                    time: end.time,
                    attempts,
                });
            }
        }
        Err(IntegrationError {
            time: end.time,
            attempts: MAX_ATTEMPTS,
        })
    }

    /// Shortens the last step until it ends at the event.
    fn locate(&self, mut end: FinalState<N>, step: f64) -> FinalState<N> {
        let is_before = |part: f64| (self.event)(&self.step(&end.state, part).0) > 0.0;
        let (_, after) = bisect(0.0, step, BISECTIONS, is_before);
        end.state = self.step(&end.state, after).0;
        end.time += after;
        end.steps += 1;
        end
    }

    /// The state after a step and its error over the error allowed.
    fn step(&self, state: &[f64; N], step: f64) -> ([f64; N], f64) {
        let mut slopes = [[0.0; N]; STAGES];
        slopes[0] = (self.rates)(state);
        let mut next = *state;
        for (stage, weights) in WEIGHTS.iter().enumerate() {
            for (i, value) in next.iter_mut().enumerate() {
                let slope: f64 = (0..=stage).map(|s| weights[s] * slopes[s][i]).sum();
                *value = state[i] + step * slope;
            }
            slopes[stage + 1] = (self.rates)(&next);
        }
        let mut largest: f64 = 0.0;
        for i in 0..N {
            let difference: f64 = (0..STAGES).map(|s| ERROR_WEIGHTS[s] * slopes[s][i]).sum();
            let allowed = self.absolute[i] + self.relative * state[i].abs().max(next[i].abs());
            let error = (step * difference).abs() / allowed;
            // `max` would drop a NaN.
            if error.is_nan() {
                return (next, f64::NAN);
            }
            largest = largest.max(error);
        }
        (next, largest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fall(relative: f64) -> FinalState<2> {
        Problem {
            rates: &|&[_, speed]| [speed, -9.81 - 0.1 * speed],
            event: &|&[height, _]| height,
            relative,
            absolute: [relative; 2],
            first_step: 1e-3,
        }
        .solve([10.0, 0.0], |_, _| ())
        .unwrap()
    }

    /// With a linear drag the height is `h₀ + (g/c²)(1 − ct − e^{−ct})`.
    #[test]
    fn a_fall_with_drag_ends_at_the_ground_at_the_exact_time() {
        let end = fall(1e-12);
        let (drag, time) = (0.1, end.time);
        let height = 10.0 + 9.81 / (drag * drag) * (1.0 - drag * time - (-drag * time).exp());
        assert!(height.abs() < 1e-9, "{height:e}");
        assert!((end.state[1] + 9.81 / drag * (1.0 - (-drag * time).exp())).abs() < 1e-9);
    }

    #[test]
    fn the_error_follows_the_tolerance() {
        let exact = fall(1e-13).time;
        let error = |tolerance| (fall(tolerance).time - exact).abs();
        assert!(error(1e-6) < 1e-5);
        assert!(error(1e-9) < 1e-8);
        assert!(error(1e-9) < error(1e-4));
    }

    #[test]
    fn a_singularity_is_reported_and_not_stepped_over() {
        let stuck = Problem {
            rates: &|&[value]: &[f64; 1]| [value * value],
            event: &|_| 1.0,
            relative: 1e-9,
            absolute: [1e-9],
            first_step: 0.1,
        }
        .solve([1.0], |_, _| ());
        assert!((stuck.unwrap_err().time - 1.0).abs() < 1e-3);
    }

    #[test]
    fn an_event_that_has_come_ends_it_at_once() {
        let end = Problem {
            rates: &|_: &[f64; 1]| [1.0],
            event: &|_| 0.0,
            relative: 1e-9,
            absolute: [1e-9],
            first_step: 0.1,
        }
        .solve([1.0], |_, _| ())
        .unwrap();
        assert_eq!((end.time, end.steps), (0.0, 0));
    }
}
