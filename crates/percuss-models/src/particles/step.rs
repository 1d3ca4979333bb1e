//! Time step of a body: forces of the rows in order, leapfrog of every particle.

use std::ops::Range;

use rayon::prelude::*;

use super::{
    body::Body,
    bonded::{Bonded, Load},
    bonds::{BondDamage, BondForce, Forces, Pair, Pose, Rest, RowForces, Springs, bond, offset},
    frequency::{Oscillator, largest_frequency},
    lattice::DIRECTIONS,
    row::{Halo, RowMake, RowMotion, RowState, States},
    tasks::rows_at_once,
};
use crate::{Error, random::unit, solver::Control};

/// Particles below which one task takes all.
const SMALL: usize = 4096;

/// Random numbers that the search for the largest frequency starts from.
const FREQUENCY_STREAM: u64 = 0xf1e1d;

impl Forces {
    /// Sum of what the bonds of a row and of the row above it do.
    #[inline(always)]
    fn sum(&mut self, odd: usize, own: &RowForces, above: &RowForces) {
        let [along, right, left] = &own.of;
        let [_, from_left, from_right] = &above.of;
        let count = self.x.len() - 2;
        let [xx, zz, xz] = self.virial.each_mut();
        // The row above has the other parity: its bonds to the right start `1 − odd` places before, those to the left one place later.
        let (first, second) = (odd, odd + 1);
        for (total, of, sign) in [
            (&mut self.x, (|f| &f.x) as fn(&Forces) -> &Vec<f64>, -1.0),
            (&mut self.z, |f| &f.z, -1.0),
            (&mut self.moment, |f| &f.moment, 1.0),
            (xx, |f| &f.virial[0], 1.0),
            (zz, |f| &f.virial[1], 1.0),
            (xz, |f| &f.virial[2], 1.0),
        ] {
            if total.is_empty() {
                continue;
            }
            let total = &mut total[1..][..count];
            let (a, before) = (&of(along)[1..][..count], &of(along)[..count]);
            let (b, c) = (&of(right)[1..][..count], &of(left)[1..][..count]);
            let d = &of(from_left)[first..][..count];
            let e = &of(from_right)[second..][..count];
            for i in 0..count {
                total[i] = ((a[i] + b[i]) + c[i]) + sign * ((before[i] + d[i]) + e[i]);
            }
        }
    }
}

/// Rows that a task computes one after the other.
struct Slice<'a> {
    body: &'a Body,
    first: usize,
    loads: &'a [Load<2>],
    /// Time step [s].
    step: f64,
    /// They are changed one after the other: what is behind is still that of before the step.
    state: &'a mut [RowState],
    motion: &'a mut [RowMotion],
    halo: &'a Halo,
}

impl pulp::NullaryFnOnce for Slice<'_> {
    /// Impulse on the support [N s per m].
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        let Self {
            body,
            first,
            loads,
            step,
            state,
            motion,
            halo,
        } = self;
        let springs = body.springs();
        let mut support = 0.0;
        let states = States::around(first, state, halo);
        let mut forces = Sweep::new(body, &springs, &states, first);
        for (index, motion) in motion.iter_mut().enumerate() {
            let row = first + index;
            let states = States::around(first, state, halo);
            forces.next(body, &springs, &states, row, loads);
            let state = &mut state[index];
            let total = &mut forces.total;
            if let Some(places) = body.held_places(row) {
                let held = &mut total.z[places];
                support += step * held.iter().sum::<f64>();
                held.fill(0.0);
            }
            advance(&body.rows[row], total, step, state, motion);
            if body.softening.is_some() {
                // What was the row's own is what is above the next one.
                std::mem::swap(&mut state.damage, &mut forces.above.damage);
                state.lost += forces.lost;
                std::mem::swap(&mut state.virial, &mut forces.total.virial);
            }
        }
        support
    }
}

/// Forces of one row after the other.
pub(super) struct Sweep {
    above: RowForces,
    own: RowForces,
    pub(super) total: Forces,
    /// Energy that the softening of the row's bonds takes in the step that ends now [J per m].
    pub(super) lost: f64,
    /// Larger principal stresses around the particles of the row and of the next one; empty where no bond fails by its
    /// stress.
    tension: [Vec<f64>; 2],
    virial: [Vec<f64>; 3],
}

impl Sweep {
    #[inline(always)]
    pub(super) fn new(body: &Body, springs: &Springs, states: &States<'_>, first: usize) -> Self {
        let by_stress = body.softening.is_some_and(|law| law.by_stress);
        let places = if by_stress { body.stride } else { 0 };
        let zeros = || vec![0.0; places];
        let mut above = RowForces::new(body.stride, body.softening.as_ref());
        let (mut tension, mut virial) = ([zeros(), zeros()], [zeros(), zeros(), zeros()]);
        if first > 0 {
            if by_stress {
                body.tension(states, first - 1, &mut virial, &mut tension[0]);
                body.tension(states, first, &mut virial, &mut tension[1]);
            }
            body.row_forces(springs, states, first - 1, &tension, &mut above);
        } else if by_stress {
            body.tension(states, 0, &mut virial, &mut tension[1]);
        }
        Self {
            tension,
            virial,
            above,
            own: RowForces::new(body.stride, body.softening.as_ref()),
            total: Forces::new(body.stride, by_stress),
            lost: 0.0,
        }
    }

    #[inline(always)]
    pub(super) fn next(
        &mut self,
        body: &Body,
        springs: &Springs,
        states: &States<'_>,
        row: usize,
        loads: &[Load<2>],
    ) {
        self.tension.swap(0, 1);
        if !self.tension[1].is_empty() {
            body.tension(states, row + 1, &mut self.virial, &mut self.tension[1]);
        }
        body.row_forces(springs, states, row, &self.tension, &mut self.own);
        self.total.sum(row % 2, &self.own, &self.above);
        let start = loads.partition_point(|load| load.row < row);
        for load in loads[start..].iter().take_while(|load| load.row == row) {
            self.total.x[load.place] += load.force[0];
            self.total.z[load.place] += load.force[1];
            self.total.moment[load.place] += load.moment;
        }
        self.lost = body.loss(states, row, &self.own.damage);
        std::mem::swap(&mut self.above, &mut self.own);
    }
}

impl Body {
    /// Springs of its bonds.
    pub(super) fn springs(&self) -> Springs {
        Springs {
            length: self.lattice.spacing,
            normal: self.lattice.normal,
            shear: self.lattice.shear,
        }
    }

    /// Places of a row that cannot move along the normal of the struck face, if there are any.
    pub(super) fn held_places(&self, row: usize) -> Option<Range<usize>> {
        let (held, places) = self.held.as_ref()?;
        (*held == row).then(|| places.clone())
    }

    /// Forces of the bonds that start in a row.
    #[inline(always)]
    fn row_forces(
        &self,
        springs: &Springs,
        states: &States<'_>,
        row: usize,
        tension: &[Vec<f64>; 2],
        forces: &mut RowForces,
    ) {
        let Some(own) = states.get(row) else {
            return;
        };
        // The last row has no bonds to a next one: their weights are 0.
        let next = states.get(row + 1).unwrap_or(own);
        let pair = Pair {
            springs,
            softening: self.softening.as_ref(),
            odd: row % 2,
            make: &self.rows[row],
            row: own,
            next,
            tension: tension.each_ref().map(Vec::as_slice),
        };
        pair.compute(forces);
    }

    /// Advances all particles by a step [s] under the loads of contacts, which are in the order of the rows; returns the impulse on the
    /// support [N s per m]. Every particle sums its own forces in the same order, so threads change no bit.
    pub(super) fn advance_rows(&mut self, step: f64, loads: &[Load<2>]) -> f64 {
        let at_once = self.rows_at_once();
        self.copy_halos(at_once);
        let mut motion = std::mem::take(&mut self.motion);
        let mut states = std::mem::take(&mut self.state);
        let body = &*self;
        let support: f64 = states
            .par_chunks_mut(at_once)
            .zip(motion.par_chunks_mut(at_once))
            .zip(&body.halos)
            .enumerate()
            .map(|(slice, ((state, motion), halo))| {
                pulp::Arch::new().dispatch(Slice {
                    body,
                    first: slice * at_once,
                    loads,
                    step,
                    state,
                    motion,
                    halo,
                })
            })
            // The support stands behind the last slice: all others add nothing.
            .sum();
        self.motion = motion;
        self.state = states;
        support
    }

    /// Copies the rows around those of each task: another one changes them meanwhile.
    fn copy_halos(&mut self, at_once: usize) {
        let by_stress = self.softening.is_some_and(|law| law.by_stress);
        let depth = if by_stress { 2 } else { 1 };
        let rows = &self.state;
        self.halos
            .resize_with(rows.len().div_ceil(at_once.max(1)), Halo::default);
        let copy = |copies: &mut Vec<RowState>, from: &[RowState]| {
            copies.resize_with(from.len(), RowState::default);
            for (copy, row) in copies.iter_mut().zip(from) {
                copy.copy_for_forces(row);
            }
        };
        for (slice, halo) in self.halos.iter_mut().enumerate() {
            let first = slice * at_once;
            let end = (first + at_once).min(rows.len());
            copy(&mut halo.before, &rows[first.saturating_sub(depth)..first]);
            copy(&mut halo.behind, &rows[end..(end + depth).min(rows.len())]);
        }
    }

    fn rows_at_once(&self) -> usize {
        rows_at_once(self.rows.len(), self.stride, SMALL)
    }

    /// Largest angular frequency [rad/s] of small displacements.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub(super) fn measured_frequency(&mut self, control: &mut Control<'_>) -> Result<f64, Error> {
        control.ask()?;
        // In place, and back again: a copy of the body would take as much memory as a run.
        let places = self.state.iter().map(RowState::place).collect::<Vec<_>>();
        let motion = self.motion.clone();
        let softening = self.softening.take();
        let found = self.frequency_of_random_motion(control);
        self.softening = softening;
        self.motion = motion;
        for (state, [x, z, cosine, sine]) in self.state.iter_mut().zip(places) {
            (state.x, state.z, state.cosine, state.sine) = (x, z, cosine, sine);
        }
        found
    }

    fn frequency_of_random_motion(&mut self, control: &mut Control<'_>) -> Result<f64, Error> {
        let size = 1e-9 * self.lattice.spacing;
        for row in 0..self.rows.len() {
            let make = &self.rows[row];
            let motion = &mut self.motion[row];
            for place in (0..self.stride).filter(|&place| make.mass[place] > 0.0) {
                let index = 3 * (row * self.stride + place) as u64;
                let draw = |part| unit(FREQUENCY_STREAM, index + part) - 0.5;
                motion.x[place] = draw(0);
                motion.z[place] = draw(1);
                motion.spin[place] = draw(2) / self.lattice.spacing;
            }
        }
        largest_frequency(self, size, control)
    }

    /// Force and energy of one bond.
    pub(super) fn bond_of(&self, row: usize, place: usize, kind: usize) -> BondForce {
        let (other_row, other) = self.end_of(row, place, kind);
        let pose = |row: usize, place: usize| {
            let state = &self.state[row];
            Pose {
                displacement: [state.x[place], state.z[place]],
                turn: [state.cosine[place], state.sine[place]],
            }
        };
        let (a, b) = (pose(row, place), pose(other_row, other));
        let (softening, rest) = (self.softening.as_ref(), self.rest(row, place, kind));
        let damage = match softening {
            Some(_) => self.damage_of((row, place, kind)),
            None => BondDamage::default(),
        };
        // A bond that starts to soften now has all of its springs.
        bond(&self.springs(), softening, rest, damage, 0.0, a, b)
    }

    /// A bond at rest.
    pub(super) fn rest(&self, row: usize, place: usize, kind: usize) -> Rest {
        let make = &self.rows[row];
        let (direction, length) = match make.is_moved() {
            true => {
                let rests = &make.rests[kind];
                ([rests.x[place], rests.z[place]], rests.length[place])
            }
            false => (DIRECTIONS[kind], self.lattice.spacing),
        };
        Rest {
            direction,
            length,
            weight: make.weights[kind][place],
        }
    }

    /// Row and place of the second particle of a bond.
    pub(super) fn end_of(&self, row: usize, place: usize, kind: usize) -> (usize, usize) {
        let other = place.saturating_add_signed(offset(kind, row % 2));
        (row + usize::from(kind > 0), other)
    }
}

/// The speed counts rotation by its kinetic energy.
impl Oscillator for Body {
    fn speed(&self) -> f64 {
        let mut sum = 0.0;
        for (make, motion) in self.rows.iter().zip(&self.motion) {
            for place in (0..self.stride).filter(|&place| make.inverse_mass[place] > 0.0) {
                let speeds = motion.x[place].powi(2) + motion.z[place].powi(2);
                sum += make.mass[place] * speeds
                    + motion.spin[place].powi(2) / make.inverse_inertia[place];
            }
        }
        (sum / self.mass()).sqrt()
    }

    fn displace_by_motion(&mut self, factor: f64) {
        for (state, motion) in self.state.iter_mut().zip(&mut self.motion) {
            for place in 0..self.stride {
                state.x[place] = factor * std::mem::take(&mut motion.x[place]);
                state.z[place] = factor * std::mem::take(&mut motion.z[place]);
                let angle = factor * std::mem::take(&mut motion.spin[place]);
                (state.cosine[place], state.sine[place]) = (1.0, angle);
            }
        }
    }

    fn accelerate(&mut self) {
        self.advance_rows(1.0, &[]);
    }
}

/// Leapfrog of the particles of a row.
#[inline(always)]
fn advance(
    make: &RowMake,
    total: &Forces,
    step: f64,
    state: &mut RowState,
    motion: &mut RowMotion,
) {
    let count = make.mass.len();
    let (inverse_mass, inverse_inertia) =
        (&make.inverse_mass[..count], &make.inverse_inertia[..count]);
    for (force, speed, place) in [
        (&total.x, &mut motion.x, &mut state.x),
        (&total.z, &mut motion.z, &mut state.z),
    ] {
        let (force, speed) = (&force[..count], &mut speed[..count]);
        let place = &mut place[..count];
        for i in 0..count {
            speed[i] += step * force[i] * inverse_mass[i];
            place[i] += step * speed[i];
        }
    }
    let (moment, spin) = (&total.moment[..count], &mut motion.spin[..count]);
    let (cosine, sine) = (&mut state.cosine[..count], &mut state.sine[..count]);
    for i in 0..count {
        spin[i] += step * moment[i] * inverse_inertia[i];
        // Cayley's form of a rotation keeps cosine and sine on the unit circle without a root.
        let half = 0.5 * step * spin[i];
        let scale = 1.0 / (1.0 + half * half);
        let (c, s) = ((1.0 - half * half) * scale, 2.0 * half * scale);
        let (old_cosine, old_sine) = (cosine[i], sine[i]);
        cosine[i] = c * old_cosine - s * old_sine;
        sine[i] = s * old_cosine + c * old_sine;
    }
}
