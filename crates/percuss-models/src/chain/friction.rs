//! Dry friction.

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
    let sign = 1.0_f64.copysign(before);
    let slides = free - sign * limit;
    let loss = limit - sign * change;
    let slides_on = (loss <= 0.0) | (before.abs() >= loss);
    let turned = (1.0 - before.abs() / loss) * (change + sign * limit);
    let turned = if is_held { 0.0 } else { turned };
    // Where the node turns almost symmetrically, the mean velocity would let friction push: it may not.
    let pushes = (turned - before - change) * (before + turned) > 0.0;
    let turned = if pushes { free } else { turned };
    let moves = if slides_on { slides } else { turned };
    let lost_impulse = if before == 0.0 { starts } else { moves };
    if limit == 0.0 { free } else { lost_impulse }
}

/// The same for one node by itself, to the same bits: the usual cases first, so that little is worked out in vain.
#[inline(always)]
pub(super) fn dry_friction_one(before: f64, change: f64, limit: f64) -> f64 {
    if before == 0.0 {
        return if change.abs() <= limit {
            0.0
        } else {
            change - limit.copysign(change)
        };
    }
    let sign = 1.0_f64.copysign(before);
    let loss = limit - sign * change;
    if loss <= 0.0 || before.abs() >= loss {
        before + change - sign * limit
    } else {
        dry_friction(before, change, limit)
    }
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
