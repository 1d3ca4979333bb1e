//! Time step of a body of stresses, its energies and its largest stable step.

use rayon::prelude::*;

use super::{
    body::{StressBody, depths},
    kernel::{Deformation, differences, forces, softened, strain, volumes},
    ring::{Ring, WHOLE},
    state::{KeptPoints, StressRow, Taken},
};
use crate::{
    Error,
    lanes::{LANES, Lanes, each_of, lanes, load, smaller, store},
    particles::{
        bonded::Load,
        energy::BodySums,
        frequency::{Oscillator, largest_frequency},
        row::{RowMotion, RowState},
        tasks::{LEAST_ROWS, rows_at_once},
    },
    random::unit,
    solver::Control,
};

/// Particles below which one task takes all.
const SMALL: usize = 2048;
/// Random numbers that the search for the largest frequency starts from.
const FREQUENCY_STREAM: u64 = 0x57e55;

/// How stresses follow from deformations.
#[derive(Debug, Clone, Copy)]
pub(super) enum Response {
    /// By the law, in a step of so many seconds.
    Law(f64),
    /// Elastic, for small displacements: nothing is kept of them.
    Elastic,
}

/// Copies of the rows before and behind those of a task, as they are before a step.
struct Halo {
    states: [RowState; 2],
    rows: [StressRow; 2],
}

/// Rows that a task brings to the end of a step: behind the row that is accelerated follow the one that moves and the one that is strained, so that
/// a row comes into the cache once. Its first and its last row are strained when those around them have moved.
struct Advance<'a> {
    body: &'a StressBody,
    first: usize,
    halo: &'a Halo,
    loads: &'a [Load<2>],
    step: f64,
    states: &'a mut [RowState],
    motion: &'a mut [RowMotion],
    rows: &'a mut [StressRow],
    depths: &'a mut [[f64; 2]],
}

impl pulp::NullaryFnOnce for Advance<'_> {
    /// Impulse on the support [N s per m].
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        let Self {
            body,
            first,
            halo,
            loads,
            step,
            states,
            motion,
            rows,
            depths,
        } = self;
        let is_moved = body.frame.rows[0].is_moved();
        let mut support = 0.0;
        let mut force = [0, 1].map(|_| vec![0.0; body.frame.stride]);
        let count = states.len();
        for lead in 0..count + 2 {
            if lead < count {
                let states = around(states, lead, &halo.states);
                let rows = around(rows, lead, &halo.rows);
                body.row_forces(first + lead, states, rows, loads, &mut force);
                support += body.kick_row(first + lead, step, &mut force, &mut motion[lead]);
            }
            if let Some(index) = lead.checked_sub(1).filter(|&index| index < count) {
                body.drift_row(
                    first + index,
                    step,
                    &mut states[index],
                    &motion[index],
                    &mut depths[index],
                );
            }
            if let Some(index) = lead.checked_sub(2).filter(|&i| i > 0 && i + 1 < count) {
                let states = [&states[index - 1], &states[index], &states[index + 1]];
                let (number, row) = (first + index, &mut rows[index]);
                match is_moved {
                    true => body.strain_row::<true>(number, states, Response::Law(step), row),
                    false => body.strain_row::<false>(number, states, Response::Law(step), row),
                }
            }
        }
        support
    }
}

/// Rows that a task accelerates.
struct Kick<'a> {
    body: &'a StressBody,
    first: usize,
    loads: &'a [Load<2>],
    step: f64,
    motion: &'a mut [RowMotion],
}

impl pulp::NullaryFnOnce for Kick<'_> {
    /// Impulse on the support [N s per m].
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        let Self {
            body,
            first,
            loads,
            step,
            motion,
        } = self;
        let mut support = 0.0;
        let mut force = [0, 1].map(|_| vec![0.0; body.frame.stride]);
        for (index, motion) in motion.iter_mut().enumerate() {
            let row = first + index;
            body.present_forces(row, loads, &mut force);
            support += body.kick_row(row, step, &mut force, motion);
        }
        support
    }
}

/// Rows whose deformations and stresses a task brings to the places of the particles: all, or the first and the last one.
struct Strain<'a> {
    body: &'a StressBody,
    first: usize,
    only_ends: bool,
    response: Response,
    rows: &'a mut [StressRow],
}

impl pulp::NullaryFnOnce for Strain<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self {
            body,
            first,
            only_ends,
            response,
            rows,
        } = self;
        let is_moved = body.frame.rows[0].is_moved();
        let last = rows.len() - 1;
        for (index, row) in rows.iter_mut().enumerate() {
            if only_ends && index > 0 && index < last {
                continue;
            }
            let number = first + index;
            let states = around_whole(&body.frame.state, number);
            match is_moved {
                true => body.strain_row::<true>(number, states, response, row),
                false => body.strain_row::<false>(number, states, response, row),
            }
        }
    }
}

/// A row of a task and those around it.
#[inline(always)]
fn around<'a, T>(own: &'a [T], index: usize, ends: &'a [T; 2]) -> [&'a T; 3] {
    let before = index.checked_sub(1).map_or(&ends[0], |before| &own[before]);
    [before, &own[index], own.get(index + 1).unwrap_or(&ends[1])]
}

/// A row of the body and those around it; beyond its ends the own one, whose part is 0.
#[inline(always)]
fn around_whole<T>(all: &[T], row: usize) -> [&T; 3] {
    [
        &all[row.saturating_sub(1)],
        &all[row],
        &all[(row + 1).min(all.len() - 1)],
    ]
}

impl StressBody {
    /// Advances all particles by a step [s] under the loads of contacts, which are in the order of the rows; returns the impulse on the
    /// support [N s per m]. Every particle sums up its own neighbours in one order, so threads change no bit.
    pub(super) fn advance_particles(&mut self, step: f64, loads: &[Load<2>]) -> f64 {
        let at_once = self.rows_at_once();
        let last = self.rows.len() - 1;
        let halos: Vec<Halo> = (0..self.rows.len())
            .step_by(at_once)
            .map(|first| {
                let ends = [first.saturating_sub(1), (first + at_once).min(last)];
                Halo {
                    states: ends.map(|row| self.frame.state[row].displacements()),
                    rows: ends.map(|row| self.rows[row].for_forces()),
                }
            })
            .collect();
        let mut states = std::mem::take(&mut self.frame.state);
        let mut motion = std::mem::take(&mut self.frame.motion);
        let mut rows = std::mem::take(&mut self.rows);
        let mut depths = std::mem::take(&mut self.depths);
        let body = &*self;
        let support: Vec<f64> = (states.par_chunks_mut(at_once))
            .zip(motion.par_chunks_mut(at_once))
            .zip(rows.par_chunks_mut(at_once))
            .zip(depths.par_chunks_mut(at_once))
            .zip(&halos)
            .enumerate()
            .map(|(slice, ((((states, motion), rows), depths), halo))| {
                pulp::Arch::new().dispatch(Advance {
                    body,
                    first: slice * at_once,
                    halo,
                    loads,
                    step,
                    states,
                    motion,
                    rows,
                    depths,
                })
            })
            .collect();
        self.frame.state = states;
        self.frame.motion = motion;
        self.rows = rows;
        self.depths = depths;
        self.strain_rows(Response::Law(step), true);
        // The support stands behind one slice: all others add nothing.
        support.iter().sum()
    }

    fn rows_at_once(&self) -> usize {
        rows_at_once(self.rows.len(), self.frame.stride, SMALL)
    }

    /// Changes the velocities by the forces.
    pub(super) fn kick(&mut self, step: f64, loads: &[Load<2>]) -> f64 {
        let at_once = self.rows_at_once();
        let mut motion = std::mem::take(&mut self.frame.motion);
        let body = &*self;
        let support: Vec<f64> = motion
            .par_chunks_mut(at_once)
            .enumerate()
            .map(|(slice, motion)| {
                pulp::Arch::new().dispatch(Kick {
                    body,
                    first: slice * at_once,
                    loads,
                    step,
                    motion,
                })
            })
            .collect();
        self.frame.motion = motion;
        // The support stands behind one slice: all others add nothing.
        support.iter().sum()
    }

    /// Changes the velocities of a row by the forces on it; gives the impulse on the support [N s per m].
    #[inline(always)]
    fn kick_row(
        &self,
        row: usize,
        step: f64,
        force: &mut [Vec<f64>; 2],
        motion: &mut RowMotion,
    ) -> f64 {
        let support = step * self.hold(row, &mut force[1]);
        let inverse = &self.frame.rows[row].inverse_mass;
        let count = inverse.len();
        for (force, speed) in force.iter().zip([&mut motion.x, &mut motion.z]) {
            let (force, speed) = (&force[..count], &mut speed[..count]);
            for i in 0..count {
                speed[i] += step * force[i] * inverse[i];
            }
        }
        support
    }

    /// Moves the particles of a row, and finds their depths.
    #[inline(always)]
    pub(super) fn drift_row(
        &self,
        row: usize,
        step: f64,
        state: &mut RowState,
        motion: &RowMotion,
        range: &mut [f64; 2],
    ) {
        for (place, speed) in [(&mut state.x, &motion.x), (&mut state.z, &motion.z)] {
            for (place, speed) in place.iter_mut().zip(speed) {
                *place += step * speed;
            }
        }
        *range = depths(&self.frame, row, &state.z);
    }

    /// Brings deformations and stresses to the places of the particles.
    pub(super) fn strain_all(&mut self, response: Response) {
        self.strain_rows(response, false);
    }

    /// The same of all rows, or of the first and the last one of each task.
    fn strain_rows(&mut self, response: Response, only_ends: bool) {
        let at_once = self.rows_at_once();
        let mut rows = std::mem::take(&mut self.rows);
        let body = &*self;
        rows.par_chunks_mut(at_once)
            .enumerate()
            .for_each(|(slice, rows)| {
                pulp::Arch::new().dispatch(Strain {
                    body,
                    first: slice * at_once,
                    only_ends,
                    response,
                    rows,
                });
            });
        self.rows = rows;
    }

    #[inline(always)]
    fn strain_row<const MOVED: bool>(
        &self,
        number: usize,
        states: [&RowState; 3],
        response: Response,
        row: &mut StressRow,
    ) {
        let law = &*self.law;
        let make = &self.frame.rows[number];
        let masks = &self.triangles[number];
        let size = Lanes::all(self.frame.lattice.spacing);
        let per_density = 1.0 / law.density;
        let (mut taken, mut lost) = ([Lanes::all(0.0); 3], Lanes::all(0.0));
        for block in 0..row.points.len() {
            let place = 1 + block * LANES;
            let mass = load(&make.mass, place);
            let inverse = load(&make.inverse_mass, place);
            let per_volume = lanes(|l| law.density * inverse[l]);
            let ring = Ring::of::<MOVED>(&self.frame, masks, number, place);
            let moves = differences(states, place, number % 2);
            let deformation = Deformation::of(&ring, &moves, &per_volume);
            let stiffness = load(&row.stiffness, place);
            let cauchy = match response {
                Response::Elastic => {
                    let [xx, xz, zx, zz] = deformation.gradient;
                    let shear = law.shear_modulus;
                    let first = law.bulk_modulus - 2.0 / 3.0 * shear;
                    each_of(|l| {
                        let sum = first * (xx[l] + zz[l]);
                        [
                            sum + 2.0 * shear * xx[l],
                            sum + 2.0 * shear * zz[l],
                            shear * (xz[l] + zx[l]),
                        ]
                    })
                }
                Response::Law(step) => {
                    let volume = lanes(|l| {
                        if mass[l] > 0.0 {
                            mass[l] * per_density
                        } else {
                            1.0
                        }
                    });
                    let before = row.gradients(place);
                    let mut points = row.points[block].whole(&self.present(&mass), &volume);
                    let strain_before = points.plastic_strain;
                    let cauchy = strain(
                        law,
                        &mut points,
                        (&before, &deformation.gradient),
                        &volume,
                        (step, &size),
                        &mut taken,
                    );
                    let softer =
                        softened(law, &points, &strain_before, (&stiffness, self.stiffness));
                    row.points[block] = KeptPoints::of(&points);
                    // The mean of both forces, on the way between both misfits.
                    let misfit = load(&row.misfit, place);
                    let all = lost;
                    lost = lanes(|l| {
                        let both = misfit[l] + deformation.misfit[l];
                        all[l] + 0.25 * (stiffness[l] - softer[l]) * both
                    });
                    store(&mut row.stiffness, place, &softer);
                    cauchy
                }
            };
            let stiffness = load(&row.stiffness, place);
            let stress = deformation.piola(&cauchy, &stiffness, &per_volume);
            for (part, found) in row.gradient.iter_mut().zip(&deformation.gradient) {
                store(part, place, found);
            }
            for (part, found) in row.stress.iter_mut().zip(&stress) {
                store(part, place, found);
            }
            store(&mut row.misfit, place, &deformation.misfit);
        }
        row.taken.add(&taken, &lost);
    }

    /// Masses of eight particles; where there is none, that of 1 m³, so that no number is undefined.
    #[inline(always)]
    fn present(&self, mass: &Lanes) -> Lanes {
        let density = self.law.density;
        lanes(|l| if mass[l] > 0.0 { mass[l] } else { density })
    }

    /// Forces on the particles of a row of the whole body, with the loads of contacts.
    #[inline(always)]
    fn present_forces(&self, row: usize, loads: &[Load<2>], force: &mut [Vec<f64>; 2]) {
        let states = around_whole(&self.frame.state, row);
        self.row_forces(row, states, around_whole(&self.rows, row), loads, force);
    }

    /// Forces on the particles of a row between those around it, with the loads of contacts.
    #[inline(always)]
    fn row_forces(
        &self,
        row: usize,
        states: [&RowState; 3],
        rows: [&StressRow; 3],
        loads: &[Load<2>],
        force: &mut [Vec<f64>; 2],
    ) {
        match self.frame.rows[0].is_moved() {
            true => self.inner_forces::<true>(row, states, rows, force),
            false => self.inner_forces::<false>(row, states, rows, force),
        }
        let start = loads.partition_point(|load| load.row < row);
        for load in loads[start..].iter().take_while(|load| load.row == row) {
            force[0][load.place] += load.force[0];
            force[1][load.place] += load.force[1];
        }
    }

    #[inline(always)]
    fn inner_forces<const MOVED: bool>(
        &self,
        row: usize,
        states: [&RowState; 3],
        rows: [&StressRow; 3],
        force: &mut [Vec<f64>; 2],
    ) {
        let masks = &self.triangles[row];
        for block in 0..rows[1].points.len() {
            let place = 1 + block * LANES;
            let is_whole = masks[place..][..LANES].iter().all(|&mask| mask == WHOLE);
            let ring = Ring::of::<MOVED>(&self.frame, masks, row, place);
            let found = forces(&ring, is_whole, states, rows, place, row % 2);
            for (force, found) in force.iter_mut().zip(&found) {
                store(force, place, found);
            }
        }
    }

    /// Takes the forces off particles that are held along the normal of the struck face, and gives their sum.
    #[inline(always)]
    fn hold(&self, row: usize, force: &mut [f64]) -> f64 {
        let Some(places) = self.frame.held_places(row) else {
            return 0.0;
        };
        let held = &mut force[places];
        let sum = held.iter().sum();
        held.fill(0.0);
        sum
    }

    /// Energies now, the velocities taken half a step on under the same loads.
    pub(super) fn energies(&self, step: f64, loads: &[Load<2>]) -> BodySums {
        BodySums::of_rows(self.rows.len(), LEAST_ROWS, |row| {
            self.row_sums(row, step, loads)
        })
    }

    /// Kinetic energy as of the lattice, with velocities half a step before and after.
    fn row_sums(&self, row: usize, step: f64, loads: &[Load<2>]) -> BodySums {
        let mut force = [0, 1].map(|_| vec![0.0; self.frame.stride]);
        self.present_forces(row, loads, &mut force);
        self.hold(row, &mut force[1]);
        let (make, motion, own) = (
            &self.frame.rows[row],
            &self.frame.motion[row],
            &self.rows[row],
        );
        let Taken {
            work,
            plastic,
            viscous,
            softened,
        } = own.taken;
        let mut sums = BodySums {
            elastic: work - plastic - viscous,
            plastic,
            viscous,
            stabilisation: softened,
            ..BodySums::default()
        };
        for place in 1..self.frame.stride - 1 {
            let mass = make.mass[place];
            if mass == 0.0 {
                continue;
            }
            for (speed, force) in [
                (motion.x[place], force[0][place]),
                (motion.z[place], force[1][place]),
            ] {
                sums.kinetic += 0.5 * speed * (mass * speed + step * force);
            }
            sums.stabilisation += 0.5 * own.stiffness[place] * own.misfit[place];
        }
        sums
    }

    /// Part of the stable step of the body at rest that is stable now: the smallest of all particles, whose size is that of their smaller stretch.
    pub(super) fn stable_part(&self) -> f64 {
        let of_row = |number: usize| {
            let (row, make) = (&self.rows[number], &self.frame.rows[number]);
            let mut least = Lanes::all(f64::INFINITY);
            for (block, points) in row.points.iter().enumerate() {
                let place = 1 + block * LANES;
                let gradient = row.gradients(place);
                let [xx, xz, zx, zz] = gradient;
                let (mass, before) = (load(&make.mass, place), least);
                let (present, per_density) = (self.present(&mass), 1.0 / self.law.density);
                let ratio = volumes(&gradient);
                let volume = lanes(|l| present[l] * per_density * ratio[l]);
                let squared = self
                    .law
                    .wave_speed_squared(&points.whole(&present, &volume));
                least = lanes(|l| {
                    let gradient = [xx[l], xz[l], zx[l], zz[l]];
                    let (_, stretch) = super::state::volume_and_stretch(gradient);
                    let part = stretch * (self.wave_squared / squared[l]).sqrt();
                    if mass[l] > 0.0 {
                        smaller(part, before[l])
                    } else {
                        before[l]
                    }
                });
            }
            least.iter().copied().fold(f64::INFINITY, f64::min)
        };
        (0..self.rows.len())
            .into_par_iter()
            .with_min_len(LEAST_ROWS)
            .map(of_row)
            .reduce(|| f64::INFINITY, f64::min)
    }

    /// Largest angular frequency of the body at rest [rad/s].
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub(super) fn largest_frequency(&mut self, control: &mut Control<'_>) -> Result<f64, Error> {
        let motion = self.frame.motion.clone();
        let found = self.frequency_of_random_motion(control);
        self.frame.motion = motion;
        for (state, row) in self.frame.state.iter_mut().zip(&mut self.rows) {
            for numbers in [&mut state.x, &mut state.z, &mut row.misfit]
                .into_iter()
                .chain(&mut row.gradient)
                .chain(&mut row.stress)
            {
                numbers.fill(0.0);
            }
        }
        found
    }

    fn frequency_of_random_motion(&mut self, control: &mut Control<'_>) -> Result<f64, Error> {
        let size = 1e-9 * self.frame.lattice.spacing;
        let stride = self.frame.stride;
        let draw = |row: usize, place: usize, axis: u64| {
            unit(FREQUENCY_STREAM, 2 * (row * stride + place) as u64 + axis) - 0.5
        };
        for (row, motion) in self.frame.motion.iter_mut().enumerate() {
            for place in (0..stride).filter(|&place| self.frame.rows[row].mass[place] > 0.0) {
                motion.x[place] = draw(row, place, 0);
                motion.z[place] = draw(row, place, 1);
            }
        }
        largest_frequency(self, size, control)
    }
}

impl Oscillator for StressBody {
    fn speed(&self) -> f64 {
        let (mut sum, mut mass) = (0.0, 0.0);
        for (make, motion) in self.frame.rows.iter().zip(&self.frame.motion) {
            for place in 0..self.frame.stride {
                mass += make.mass[place];
                sum += make.mass[place] * (motion.x[place].powi(2) + motion.z[place].powi(2));
            }
        }
        (sum / mass).sqrt()
    }

    fn displace_by_motion(&mut self, factor: f64) {
        for (state, motion) in self.frame.state.iter_mut().zip(&mut self.frame.motion) {
            for (place, speed) in [(&mut state.x, &mut motion.x), (&mut state.z, &mut motion.z)] {
                for (place, speed) in place.iter_mut().zip(speed) {
                    *place = factor * std::mem::take(speed);
                }
            }
        }
    }

    fn accelerate(&mut self) {
        self.strain_all(Response::Elastic);
        self.kick(1.0, &[]);
    }
}
