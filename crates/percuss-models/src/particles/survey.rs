//! Extremes of a body over its bonds and particles.

use rayon::prelude::*;

use super::{body::Body, bonded::Bonded, fields};

/// Largest stretch of a bond, over the spacing, and largest tension of a particle [Pa].
///
/// A stretched bond counts by the part of its springs that is left: one that began to soften nearly unstretched, across the tension, has hardly a force
/// when it has failed at last, at many times the usual stretch.
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
                let bond = body.bond_of(row, place, kind);
                let mut stretch = bond.elongation.abs();
                if let Some(law) = body.softening.as_ref().filter(|_| bond.elongation > 0.0) {
                    let damage = body.damage_of((row, place, kind));
                    stretch *= law.integrity(damage.worst, damage.start);
                }
                extremes.0 = extremes.0.max(stretch / body.lattice.spacing);
            }
        }
    }
    extremes
}
