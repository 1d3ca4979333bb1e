//! Dry friction.

/// Velocity after a kick with dry friction.
///
/// `change` is what the forces alone would add and `limit` the most that friction can take away. The motion within the
/// step is followed exactly: friction slows, holds the node if it can, and opposes the motion that starts afresh.
pub(super) fn rub(before: f64, change: f64, limit: f64) -> f64 {
    if limit == 0.0 {
        return before + change;
    }
    if before == 0.0 {
        return if change.abs() <= limit {
            0.0
        } else {
            change - limit.copysign(change)
        };
    }
    let sign = before.signum();
    let loss = limit - sign * change;
    if loss <= 0.0 || before.abs() >= loss {
        return before + change - sign * limit;
    }
    let after = if change.abs() <= limit {
        0.0
    } else {
        let rest = 1.0 - before.abs() / loss;
        rest * (change + sign * limit)
    };
    // Where the node turns almost symmetrically, the mean velocity would let friction push: it may not.
    let friction = after - before - change;
    if friction * (before + after) > 0.0 {
        before + change
    } else {
        after
    }
}

#[cfg(test)]
mod tests {
    use super::rub;

    #[test]
    fn friction_holds_slows_and_never_pushes() {
        assert_eq!(rub(0.0, 0.5, 1.0), 0.0);
        assert_eq!(rub(0.0, 1.5, 1.0), 0.5);
        assert_eq!(rub(3.0, -0.5, 1.0), 1.5);
        assert_eq!(rub(0.5, -0.2, 1.0), 0.0);
        for i in 0..200 {
            for j in 0..200 {
                let (before, change) = (i as f64 * 0.05 - 5.0, j as f64 * 0.05 - 5.0);
                for limit in [0.1, 1.0, 3.0] {
                    let after = rub(before, change, limit);
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
