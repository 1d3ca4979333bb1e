//! Dry friction.

use serde::{Deserialize, Serialize};

/// Velocity after a kick with dry friction.
///
/// `change` is what the forces alone would add and `limit` the most that friction can take away. The motion within the
/// step is followed exactly: friction slows, holds the node if it can, and opposes the motion that starts afresh.
// Every case is worked out and one is chosen, so that a loop over many nodes becomes vector instructions.
#[inline(always)]
pub(super) fn dry_friction(before: f64, change: f64, limit: f64) -> f64 {
    let free = before + change;
    let is_held = change.abs() <= limit;
    let starts = if is_held {
        0.0
    } else {
        change - limit.copysign(change)
    };
    let (slides, loss, slides_on) = slide(before, change, limit);
    let sign = 1.0_f64.copysign(before);
    let turned = (1.0 - before.abs() / loss) * (change + sign * limit);
    let turned = if is_held { 0.0 } else { turned };
    // Where the node turns almost symmetrically, the mean velocity would let friction push: it may not.
    let pushes = (turned - before - change) * (before + turned) > 0.0;
    let turned = if pushes { free } else { turned };
    let moves = if slides_on { slides } else { turned };
    let after = if before == 0.0 { starts } else { moves };
    if limit == 0.0 { free } else { after }
}

/// Velocity of a moving node that slides on, the speed that it loses, and whether it does slide on.
#[inline(always)]
pub(super) fn slide(before: f64, change: f64, limit: f64) -> (f64, f64, bool) {
    let sign = 1.0_f64.copysign(before);
    let loss = limit - sign * change;
    let slides = before + change - sign * limit;
    (slides, loss, (loss <= 0.0) | (before.abs() >= loss))
}

/// The same as [`dry_friction`] for one node by itself, to the same bits: the usual cases first, so that little is worked out in vain.
#[inline(always)]
pub(super) fn dry_friction_one(before: f64, change: f64, limit: f64) -> f64 {
    if before == 0.0 {
        return if change.abs() <= limit {
            0.0
        } else {
            change - limit.copysign(change)
        };
    }
    match slide(before, change, limit) {
        (slides, _, true) => slides,
        _ => dry_friction(before, change, limit),
    }
}

percuss_core::per_lane! {
    /// Impulse that friction took, and its work.
    #[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
    pub(super) struct FrictionSums<R = f64> {
        pub(super) impulse: R,
        pub(super) work: R,
    }
}

impl FrictionSums {
    /// Adds an impulse that acted while a velocity changed.
    #[inline(always)]
    pub(super) fn add(&mut self, impulse: f64, before: f64, after: f64) {
        self.impulse += impulse;
        self.work += impulse * 0.5 * (before + after);
    }
}

/// A mass after a kick.
#[derive(Clone, Copy)]
pub(super) struct Kicked {
    pub(super) velocity: f64,
    /// Impulse that friction took.
    pub(super) lost: f64,
}

/// Kicks a mass by a force against friction; `ratio` is the time of the kick over the mass.
#[inline(always)]
pub(super) fn kick([mass, before]: [f64; 2], [force, friction]: [f64; 2], ratio: f64) -> Kicked {
    let change = force * ratio;
    let velocity = dry_friction(before, change, friction * ratio);
    let lost = lost_impulse(mass, before, change, velocity);
    Kicked { velocity, lost }
}

/// Impulse that friction took from a mass.
#[inline(always)]
pub(super) fn lost_impulse(mass: f64, before: f64, change: f64, after: f64) -> f64 {
    mass * (before + change - after)
}

#[cfg(test)]
mod tests {
    use super::{dry_friction, dry_friction_one};

    #[test]
    fn friction_holds_slows_and_never_pushes() {
        assert_eq!(dry_friction(0.0, 0.5, 1.0), 0.0);
        assert_eq!(dry_friction(0.0, 1.5, 1.0), 0.5);
        assert_eq!(dry_friction(3.0, -0.5, 1.0), 1.5);
        assert_eq!(dry_friction(0.5, -0.2, 1.0), 0.0);
        for i in 0..200 {
            for j in 0..200 {
                let (before, change) = (i as f64 * 0.05 - 5.0, j as f64 * 0.05 - 5.0);
                for limit in [0.1, 1.0, 3.0] {
                    let after = dry_friction(before, change, limit);
                    assert_eq!(
                        dry_friction_one(before, change, limit).to_bits(),
                        after.to_bits()
                    );
                    let friction = after - before - change;
                    assert!(friction.abs() <= limit + 1e-12);
                    assert!(
                        friction * (before + after) <= 1e-12,
                        "{before} {change} {limit}"
                    );
                }
            }
        }
    }
}
