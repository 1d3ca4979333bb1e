//! Artificial viscosity.

use crate::options::ArtificialViscosity;

/// Viscous pressure `q = ρ Δu (c_q Δu + c_l c)` of a cell whose faces approach at `Δu` [m/s]; none when they part
/// \[vonneumann1950\].
pub(super) fn viscous_pressure(
    viscosity: ArtificialViscosity,
    density: f64,
    sound_speed: f64,
    approach: f64,
) -> f64 {
    if viscosity.is_none() || approach <= 0.0 {
        return 0.0;
    }
    density * approach * (viscosity.quadratic * approach + viscosity.linear * sound_speed)
}

/// Time step up to which a cell of a length [m] is stable [s].
///
/// A wave must not cross the cell; the viscous pressure, taken at the velocity before the kick, shortens that to
/// `l/(√(c² + a²) + a)` with `a = c_l c + c_q Δu`.
pub(super) fn stable_step(
    viscosity: ArtificialViscosity,
    length: f64,
    sound_speed: f64,
    approach: f64,
) -> f64 {
    let drag = viscosity.linear * sound_speed + viscosity.quadratic * approach.max(0.0);
    if drag == 0.0 {
        return length / sound_speed;
    }
    length / (sound_speed.hypot(drag) + drag)
}
