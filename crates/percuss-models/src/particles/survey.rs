//! Extremes of a body over its bonds and particles.

use rayon::prelude::*;

use super::{body::Body, bonded::Bonded, fields};

/// Largest stretch of a bond, over the spacing, and largest tension of a particle [Pa].
pub(super) fn extremes(body: &Body) -> (f64, f64) {
    (0..body.rows.len())
        .into_par_iter()
        .map(|row| of_row(body, row))
        .reduce(|| (0.0, 0.0), |a, b| (a.0.max(b.0), a.1.max(b.1)))
}

/// Extremes of a row: only these are compared, so their order is of no account.
fn of_row(body: &Body, row: usize) -> (f64, f64) {
    let mut extremes = (0.0_f64, 0.0_f64);
    for place in (1..body.stride - 1).filter(|&place| body.rows[row].mass[place] > 0.0) {
        let tension = fields::largest_tension(fields::stress(body, row, place));
        extremes.1 = extremes.1.max(tension);
        for kind in 0..3 {
            let holds = body.softening.is_none() || !body.is_broken((row, place, kind));
            if body.rows[row].weights[kind][place] > 0.0 && holds {
                let stretch = body.bond_of(row, place, kind).elongation.abs();
                extremes.0 = extremes.0.max(stretch / body.lattice.spacing);
            }
        }
    }
    extremes
}
