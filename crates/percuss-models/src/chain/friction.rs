//! Dry friction.

use serde::{Deserialize, Serialize};

use crate::lanes::{PerLane, Real};

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

/// Masses that are kicked, one of each run.
#[derive(Clone, Copy)]
pub(super) struct KickedMasses<R> {
    pub(super) mass: R,
    /// Time of the kick over the mass.
    pub(super) ratio: R,
    /// Largest change of velocity that friction makes.
    pub(super) limit: R,
}

impl<R: Real> FrictionSums<R> {
    /// Velocities of masses after a kick by forces, to the bits of [`kick`]; `None` where none of them `moves` and friction goes on to
    /// hold all of them.
    // The usual cases first, so that little is worked out in vain.
    #[inline(always)]
    pub(super) fn kick(
        &mut self,
        kicked: &KickedMasses<R>,
        velocity: R,
        moves: bool,
        force: R,
    ) -> Option<R> {
        let KickedMasses { mass, ratio, limit } = kicked;
        let mut change = R::all(0.0);
        let mut is_held = true;
        for l in 0..R::LANES {
            change.set_lane(l, force.lane(l) * ratio.lane(l));
            is_held &= change.lane(l).abs() <= limit.lane(l);
        }
        if is_held & !moves {
            let mut impulse = self.impulse;
            for l in 0..R::LANES {
                impulse.set_lane(l, impulse.lane(l) + mass.lane(l) * change.lane(l));
            }
            self.impulse = impulse;
            return None;
        }
        let mut after = R::all(0.0);
        let mut is_sliding = true;
        for l in 0..R::LANES {
            let (before, limit) = (velocity.lane(l), limit.lane(l));
            let (slides, _, slides_on) = slide(before, change.lane(l), limit);
            after.set_lane(l, slides);
            is_sliding &= (slides_on & (before != 0.0)) | (limit == 0.0);
        }
        if !is_sliding {
            for l in 0..R::LANES {
                let one = dry_friction(velocity.lane(l), change.lane(l), limit.lane(l));
                after.set_lane(l, one);
            }
        }
        let (sums, mut next) = (*self, *self);
        for l in 0..R::LANES {
            let (before, after) = (velocity.lane(l), after.lane(l));
            let lost = lost_impulse(mass.lane(l), before, change.lane(l), after);
            let mut sums = sums.lane(l);
            sums.add(lost, before, after);
            next.set_lane(l, sums);
        }
        *self = next;
        Some(after)
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
    use super::{FrictionSums, KickedMasses, dry_friction, kick};
    use crate::lanes::{LANES, Lanes, PerLane, lanes};

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

    /// Velocity, impulse and work of a mass after a kick, by [`FrictionSums::kick`] for one run.
    fn alone(mass: f64, velocity: f64, force: f64, friction: f64) -> [u64; 3] {
        let ratio = 0.1 / mass;
        let limit = friction * ratio;
        let mut sums = FrictionSums::default();
        let kicked = KickedMasses { mass, ratio, limit };
        let after = sums.kick(&kicked, velocity, velocity != 0.0, force);
        [after.unwrap_or(velocity), sums.impulse, sums.work].map(f64::to_bits)
    }

    #[test]
    fn one_mass_and_eight_have_the_bits_of_a_single_kick() {
        let mut held = 0;
        for i in 0..4000 {
            // Eight masses of which most, some or none are held.
            let random =
                |l: usize, n: usize| ((i * 8 + l) * (2 * n + 1) * 7919 % 1000) as f64 / 1e3;
            let mass = lanes(|l| 0.1 + random(l, 1));
            let velocity = lanes(|l| if i % 3 == 0 { 0.0 } else { random(l, 2) - 0.5 });
            let force = lanes(|l| (random(l, 3) - 0.5) * if i % 2 == 0 { 1.0 } else { 9.0 });
            let friction = lanes(|l| if i % 5 == 0 { 0.0 } else { 0.5 + random(l, 4) });
            let ratio = lanes(|l| 0.1 / mass.lane(l));
            let limit = lanes(|l| friction.lane(l) * ratio.lane(l));
            let mut sums = FrictionSums::<Lanes>::default();
            let kicked = KickedMasses { mass, ratio, limit };
            let after = sums.kick(&kicked, velocity, i % 3 != 0, force);
            held += usize::from(after.is_none());
            for l in 0..LANES {
                let [mass, velocity, force, friction] =
                    [mass, velocity, force, friction].map(|all| all.lane(l));
                let single = kick([mass, velocity], [force, friction], 0.1 / mass);
                let mut single_sums = FrictionSums::default();
                single_sums.add(single.lost, velocity, single.velocity);
                let expected = [single.velocity, single_sums.impulse, single_sums.work];
                let expected = expected.map(f64::to_bits);
                let after = after.map_or(velocity, |after| after.lane(l));
                let side_by_side = [after, sums.impulse.lane(l), sums.work.lane(l)];
                assert_eq!(side_by_side.map(f64::to_bits), expected);
                assert_eq!(alone(mass, velocity, force, friction), expected);
            }
        }
        assert!((500..2000).contains(&held), "{held}");
    }
}
