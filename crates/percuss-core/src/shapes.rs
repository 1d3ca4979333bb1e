//! Shapes that a run leaves.

/// Crater and projectile at the end of a run. Depths count from the original face of the target, into it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Shapes {
    /// Surface of the target from the axis outwards, or from the edge of the projectile: radius and depth [m]; empty for a rigid wall.
    pub crater: Vec<[f64; 2]>,
    /// Outer surface of the projectile from its tail to its tip: radius and depth [m]; empty when nothing of it is left, or it is rigid.
    pub projectile: Vec<[f64; 2]>,
}
