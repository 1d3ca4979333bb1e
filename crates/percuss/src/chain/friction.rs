//! Dry friction.

use serde::{Deserialize, Serialize};

use crate::lanes::{Mask, Real, per_lane};

/// Velocity after a kick with dry friction.
///
/// `change` is what the forces alone would add and `limit` the most that friction can take away. The motion within the
/// step is followed exactly: friction slows, holds the node if it can, and opposes the motion that starts afresh.
// Nodes that slide on everywhere come first. Otherwise every case is worked out and one is chosen, so that a loop becomes vector instructions.
#[inline(always)]
pub(super) fn dry_friction<R: Real>(before: R, change: R, limit: R) -> R {
    let zero = R::all(0.0);
    let sign = R::all(1.0).signed_as(before);
    let slides = before + change - sign * limit;
    let loss = limit - sign * change;
    let slides_on = loss.at_most(zero) | before.size().at_least(loss);
    let was_still = before.equals(zero);
    let is_free = limit.equals(zero);
    if ((slides_on & !was_still) | is_free).every() {
        return slides;
    }
    let free = before + change;
    let is_held = change.size().at_most(limit);
    if (is_held & was_still).every() {
        return zero;
    }
    let starts = R::select(is_held, zero, change - limit.signed_as(change));
    let turned = (R::all(1.0) - before.size() / loss) * (change + sign * limit);
    let turned = R::select(is_held, zero, turned);
    // Where the node turns almost symmetrically, the mean velocity would let friction push: it may not.
    let pushes = ((turned - before - change) * (before + turned)).above(zero);
    let turned = R::select(pushes, free, turned);
    let moves = R::select(slides_on, slides, turned);
    let after = R::select(was_still, starts, moves);
    R::select(is_free, free, after)
}

/// Impulse that friction took, and its work.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(super) struct FrictionSums<R = f64> {
    pub(super) impulse: R,
    pub(super) work: R,
}
per_lane!(FrictionSums { impulse, work });

impl<R: Real> FrictionSums<R> {
    /// Adds an impulse that acted while a velocity changed.
    #[inline(always)]
    pub(super) fn add(&mut self, impulse: R, before: R, after: R) {
        self.impulse += impulse;
        self.work += impulse * ((before + after) * 0.5);
    }
}

/// What a kick makes of a mass by itself.
#[derive(Clone, Copy)]
pub(super) struct Kicked<R> {
    pub(super) velocity: R,
    /// Impulse that friction took.
    pub(super) lost: R,
}

/// Kicks a mass by a force against friction; `ratio` is the time of the kick over the mass.
#[inline(always)]
pub(super) fn kick<R: Real>(mass: R, before: R, force: R, friction: R, ratio: R) -> Kicked<R> {
    let change = force * ratio;
    let velocity = dry_friction(before, change, friction * ratio);
    let lost = mass * (before + change - velocity);
    Kicked { velocity, lost }
}

#[cfg(test)]
mod tests {
    use super::dry_friction;
    use crate::lanes::{LANES, Lanes};

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

    #[test]
    fn lanes_in_any_company_have_the_bits_of_one() {
        let number = |i: usize, k: f64| (i as f64 * k).fract() * 4.0 - 2.0;
        for i in 0..4000 {
            // Sliding, held, turning and free nodes side by side.
            let lane = |l: usize| {
                let (before, change) = (number(8 * i + l, 0.754_877), number(8 * i + l, 0.569_840));
                let before = if (i + l) % 3 == 0 { 0.0 } else { before };
                [before, change, [0.0, 0.5, 1.5][(i / 3 + l) % 3]]
            };
            let [before, change, limit] = crate::lanes::each_of(lane);
            let together: Lanes = dry_friction(before, change, limit);
            for l in 0..LANES {
                let [before, change, limit] = lane(l);
                assert_eq!(
                    together[l].to_bits(),
                    dry_friction(before, change, limit).to_bits()
                );
            }
        }
    }
}
