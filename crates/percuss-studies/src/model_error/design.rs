//! Lengths and velocities of the benchmark's design: an estimate of the model error reaches no further.

/// Lengths of the projectiles over their diameter.
pub const LENGTHS: &[f64] = &[1.0, 3.0, 10.0];

/// Impact velocities [m/s].
pub const VELOCITIES: &[f64] = &[150.0, 300.0, 600.0, 1000.0, 1500.0];
