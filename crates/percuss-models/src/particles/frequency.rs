//! Largest frequency of a body, by power iteration.

use crate::{Error, solver::Control};

/// Rounds, and by how much the result is raised for what they may leave.
const ROUNDS: usize = 30;
const MARGIN: f64 = 1.05;

/// A body at rest that takes up small motions.
pub(super) trait Oscillator {
    /// Root of the mean square of the velocities, weighted with the masses [m/s].
    fn speed(&self) -> f64;

    /// Makes the velocities, times a factor [s], displacements of the body at rest.
    fn displace_by_motion(&mut self, factor: f64);

    /// Makes the accelerations at these displacements, times 1 s, the velocities.
    fn accelerate(&mut self);
}

/// Largest angular frequency [rad/s] of a body with random velocities, so that every motion is in them; the iteration displaces
/// it by a root mean square of `size` [m].
///
/// # Errors
/// [`Error::Cancelled`].
pub(super) fn largest_frequency(
    body: &mut impl Oscillator,
    size: f64,
    control: &mut Control<'_>,
) -> Result<f64, Error> {
    let mut square = 0.0;
    for _ in 0..ROUNDS {
        control.ask()?;
        body.displace_by_motion(size / body.speed());
        body.accelerate();
        square = body.speed() / size;
    }
    Ok(MARGIN * square.sqrt())
}
