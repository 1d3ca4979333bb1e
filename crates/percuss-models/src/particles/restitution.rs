//! Damping of a contact that pushes and never pulls, from its restitution.

use std::f64::consts::PI;

use crate::bisection::bisected;

/// Halvings of the search for a damping.
const HALVINGS: u32 = 60;
/// Step of the integration of a Hertz contact, in the time in which an undamped one of unit mass, stiffness and velocity swings.
const STEP: f64 = 0.004;

/// Largest damping of a linear contact: it just does not swing.
const LARGEST_LINEAR: f64 = 1.0;
/// Largest damping of a Hertz contact: it leaves two hundredths of the velocity.
const LARGEST_HERTZ: f64 = 3.0;

/// Damping of a linear contact, over that at which it just does not swing.
pub(super) fn linear_damping(restitution: f64) -> f64 {
    damping(restitution, LARGEST_LINEAR, |damping| {
        let tangent = damping / (1.0 - damping * damping).sqrt();
        (-tangent * (PI - 2.0 * tangent.atan())).exp()
    })
}

/// Damping of a Hertz contact, over that at which a linear one of its stiffness just does not swing.
pub(super) fn hertz_damping(restitution: f64) -> f64 {
    match restitution >= 1.0 {
        true => 0.0,
        false => damping(restitution, LARGEST_HERTZ, hertz_restitution),
    }
}

/// Damping that leaves a part of the velocity, by bisection: the larger it is, the less is left.
fn damping(restitution: f64, largest: f64, left: impl Fn(f64) -> f64) -> f64 {
    bisected(0.0, largest, HALVINGS, |damping| {
        left(damping) > restitution
    })
}

/// Restitution of a damping, whatever the velocity: `x'' = −x^{3/2} − 2 ζ √(3/2) x^{1/4} x'` until the force would pull, by Runge and Kutta.
fn hertz_restitution(damping: f64) -> f64 {
    let factor = 2.0 * damping * 1.5_f64.sqrt();
    let slope = |[x, v]: [f64; 2]| {
        let x = x.max(0.0);
        [v, -x.powf(1.5) - factor * x.powf(0.25) * v]
    };
    let along = |[x, v]: [f64; 2], [a, b]: [f64; 2], part: f64| [x + part * a, v + part * b];
    let mut state = [0.0, 1.0];
    while state[1] > 0.0 || slope(state)[1] < 0.0 {
        let first = slope(state);
        let second = slope(along(state, first, 0.5 * STEP));
        let third = slope(along(state, second, 0.5 * STEP));
        let fourth = slope(along(state, third, STEP));
        for (axis, value) in state.iter_mut().enumerate() {
            let middle = second[axis] + third[axis];
            *value += STEP / 6.0 * (first[axis] + 2.0 * middle + fourth[axis]);
        }
    }
    -state[1]
}
