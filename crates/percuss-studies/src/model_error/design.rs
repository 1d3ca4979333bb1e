//! Lengths and velocities of the benchmark's designs.

use std::ops::RangeInclusive;

/// Lengths of the projectiles over their diameter.
pub const LENGTHS: &[f64] = &[1.0, 3.0, 10.0];

/// Impact velocities [m/s].
pub const VELOCITIES: &[f64] = &[150.0, 300.0, 600.0, 1000.0, 1500.0];

/// L/D of both designs: an estimate of the model error reaches no further.
pub const LENGTH_RANGE: RangeInclusive<f64> = 1.0..=20.0;

/// Impact velocities of both designs [m/s].
pub const VELOCITY_RANGE: RangeInclusive<f64> = 100.0..=2500.0;
