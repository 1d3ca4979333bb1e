//! Contacts that begin or end within a time step.

/// Part of its spring's force that a contact has at a depth, with the way that its sides have gone along the normal in the step: less than 1 in
/// the first and the last step, which the contact is closed in part of.
///
/// A spring that begins within a step takes `½ k δ (w − δ)` too much from the motion, at the depth `δ` and the way `w`, by the trapezoidal rule of
/// leapfrog: on average `k w²/12`. With half of what lies outside taken off the force, that step and the next together take nothing.
pub(super) fn part_of_force(depth: f64, way: f64) -> f64 {
    let way = way.abs();
    if depth < way {
        0.5 * (1.0 + depth / way)
    } else {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::part_of_force;

    /// Error of the energy of a mass inside a spring that begins within a step, over the energy of its impact, as mean and largest over a hundred
    /// moments of the first touch: with this part of the force, or the whole of it. `size` is the largest angular frequency times the step.
    fn errors(size: f64, part: fn(f64, f64) -> f64) -> (f64, f64) {
        let stiffness = size * size;
        let of = |moment: f64| {
            let (mut depth, mut speed, mut force) = (-moment, 1.0, 0.0);
            while speed > 0.5 {
                speed -= force;
                depth += speed;
                force = if depth > 0.0 {
                    stiffness * depth * part(depth, speed)
                } else {
                    0.0
                };
            }
            2.0 * (0.5 * speed * (speed - force) + 0.5 * stiffness * depth * depth) - 1.0
        };
        let all: Vec<f64> = (0..100).map(|i| of((f64::from(i) + 0.5) / 100.0)).collect();
        let mean = all.iter().sum::<f64>() / 100.0;
        (
            mean,
            all.iter()
                .fold(0.0, |most: f64, error| most.max(error.abs())),
        )
    }

    /// Whole forces lose a sixth of `ω² Δt²`, and these two orders of the step less.
    #[test]
    fn a_spring_that_begins_within_a_step_loses_no_energy() {
        for size in [0.05, 0.1, 0.2, 0.4] {
            let (whole, _) = errors(size, |_, _| 1.0);
            assert!((whole / (-size * size / 6.0) - 1.0).abs() < 0.02, "{size}");
            let (mean, largest) = errors(size, part_of_force);
            assert!(mean.abs() < 0.04 * size.powi(4), "{size}: {mean:e}");
            assert!(largest < 0.1 * size.powi(4), "{size}: {largest:e}");
        }
    }
}
