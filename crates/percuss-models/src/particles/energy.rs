//! Energies and momentum of a body.

use rayon::prelude::*;

use super::{
    body::Body,
    bonded::Load,
    row::{Damage, States},
    step::Sweep,
    tasks::LEAST_ROWS,
};

/// Energies [J per m].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct BodySums {
    pub(super) kinetic: f64,
    pub(super) elastic: f64,
    pub(super) fracture: f64,
    pub(super) plastic: f64,
    pub(super) viscous: f64,
    /// Of the forces that hold neighbours where the gradients of particles put them, stored and lost.
    pub(super) stabilisation: f64,
}

impl BodySums {
    /// Sum over the rows of a body, of which a thread takes so many at least. The order is that of the rows, so threads change no bit.
    pub(super) fn of_rows(
        rows: usize,
        least: usize,
        of_row: impl Fn(usize) -> Self + Sync + Send,
    ) -> Self {
        let all: Vec<Self> = (0..rows)
            .into_par_iter()
            .with_min_len(least)
            .map(of_row)
            .collect();
        all.into_iter().sum()
    }
}

impl std::iter::Sum for BodySums {
    fn sum<I: Iterator<Item = Self>>(parts: I) -> Self {
        parts.fold(Self::default(), |sum, part| Self {
            kinetic: sum.kinetic + part.kinetic,
            elastic: sum.elastic + part.elastic,
            fracture: sum.fracture + part.fracture,
            plastic: sum.plastic + part.plastic,
            viscous: sum.viscous + part.viscous,
            stabilisation: sum.stabilisation + part.stabilisation,
        })
    }
}

impl Body {
    /// Energies now, the velocities taken half a step on under the same loads.
    pub(super) fn energies(&self, step: f64, loads: &[Load<2>]) -> BodySums {
        BodySums::of_rows(self.rows.len(), LEAST_ROWS, |row| {
            self.row_sums(row, step, loads)
        })
    }

    /// Kinetic energy as `½ m v₋·v₊` of the velocities half a step before and after, with which leapfrog conserves the energy of
    /// linear springs exactly.
    fn row_sums(&self, row: usize, step: f64, loads: &[Load<2>]) -> BodySums {
        let springs = self.springs();
        let states = States::whole(&self.state);
        let mut sweep = Sweep::new(self, &springs, &states, row);
        sweep.next(self, &springs, &states, row, loads);
        let mut total = sweep.total;
        if let Some(places) = self.held_places(row) {
            total.z[places].fill(0.0);
        }
        let (make, motion) = (&self.rows[row], &self.motion[row]);
        let mut sums = BodySums {
            fracture: self.state[row].lost + sweep.lost,
            ..BodySums::default()
        };
        for place in 1..self.stride - 1 {
            let mass = make.mass[place];
            if mass == 0.0 {
                continue;
            }
            let inertia = 1.0 / make.inverse_inertia[place];
            for (mass, speed, force) in [
                (mass, motion.x[place], total.x[place]),
                (mass, motion.z[place], total.z[place]),
                (inertia, motion.spin[place], total.moment[place]),
            ] {
                sums.kinetic += 0.5 * speed * (mass * speed + step * force);
            }
            for kind in 0..3 {
                let weight = make.weights[kind][place];
                if weight > 0.0 {
                    let found = self.bond_of(row, place, kind);
                    sums.elastic += found.energy;
                }
            }
        }
        sums
    }

    /// Energy that softening takes from the bonds of a row in the step that ends with a damage [J per m].
    pub(super) fn loss(&self, states: &States<'_>, row: usize, damage: &Damage) -> f64 {
        let (Some(softening), Some(state)) = (&self.softening, states.get(row)) else {
            return 0.0;
        };
        let before = &state.damage;
        let mut lost = 0.0;
        for kind in 0..3 {
            let (old, new) = (&before.worst[kind], &damage.worst[kind]);
            for place in 1..self.stride - 1 {
                // Few bonds soften in a step.
                let start = damage.start_of(kind, place);
                if new[place] <= old[place] || new[place] <= start {
                    continue;
                }
                let rest = self.rest(row, place, kind);
                let normal = rest.weight * self.lattice.normal;
                let left = [old[place], new[place]].map(|worst| softening.integrity(worst, start));
                let from = [before.measure[kind][place], left[0]];
                let to = [damage.measure[kind][place], left[1]];
                lost += softening.taken(rest.length, normal, from, to);
            }
        }
        lost
    }
}
