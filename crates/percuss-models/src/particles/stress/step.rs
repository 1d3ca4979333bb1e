//! Time step of a body of stresses, its energies and its largest stable step.

use rayon::prelude::*;

use super::{
    body::{StressBody, depths},
    kernel::{Deformation, differences, forces, softened, strain},
    ring::{Ring, WHOLE, load, store},
    state::{StressRow, Taken},
};
use crate::{
    Error,
    lanes::{LANES, Lanes, each_of, lanes, smaller},
    particles::{
        bonded::Load,
        energy::BodySums,
        row::{RowMotion, RowState},
    },
    random::unit,
    solver::Control,
};

/// Rows that one task takes at least, and particles below which one task takes all.
const LEAST_ROWS: usize = 4;
const SMALL: usize = 2048;
/// Rounds of the search for the largest frequency, what they may leave, and the random numbers that it starts from.
const FREQUENCY_ROUNDS: usize = 30;
const FREQUENCY_MARGIN: f64 = 1.05;
const FREQUENCY_STREAM: u64 = 0x57e55;

/// How stresses follow from deformations.
#[derive(Debug, Clone, Copy)]
pub(super) enum Response {
    /// By the law, in a step of so many seconds.
    Law(f64),
    /// Elastic, for small displacements: nothing is kept of them.
    Elastic,
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
            body.row_forces(row, loads, &mut force);
            support += step * body.hold(row, &mut force[1]);
            let inverse = &body.frame.rows[row].inverse_mass;
            let count = inverse.len();
            for (force, speed) in force.iter().zip([&mut motion.x, &mut motion.z]) {
                let (force, speed) = (&force[..count], &mut speed[..count]);
                for i in 0..count {
                    speed[i] += step * force[i] * inverse[i];
                }
            }
        }
        support
    }
}

/// Rows whose deformations and stresses a task brings to the places of the particles.
struct Strain<'a> {
    body: &'a StressBody,
    first: usize,
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
            response,
            rows,
        } = self;
        let is_moved = body.frame.rows[0].is_moved();
        for (index, row) in rows.iter_mut().enumerate() {
            match is_moved {
                true => body.strain_row::<true>(first + index, response, row),
                false => body.strain_row::<false>(first + index, response, row),
            }
        }
    }
}

impl StressBody {
    /// Advances all particles by a step [s] under the loads of contacts, which are in the order of the rows; returns the impulse on the
    /// support [N s per m]. Every particle sums up its own neighbours in one order, so threads change no bit.
    pub(super) fn advance_particles(&mut self, step: f64, loads: &[Load<2>]) -> f64 {
        let support = self.kick(step, loads);
        self.drift(step);
        self.strain_all(Response::Law(step));
        support
    }

    fn rows_at_once(&self) -> usize {
        let rows = self.rows.len();
        match rows * self.frame.stride {
            0..SMALL => rows,
            _ => rows
                .div_ceil(4 * rayon::current_num_threads())
                .max(LEAST_ROWS),
        }
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

    /// Moves the particles.
    pub(super) fn drift(&mut self, step: f64) {
        let at_once = self.rows_at_once();
        let mut states = std::mem::take(&mut self.frame.state);
        let frame = &self.frame;
        states
            .par_iter_mut()
            .zip(&frame.motion)
            .zip(&mut self.depths)
            .enumerate()
            .with_min_len(at_once)
            .for_each(|(row, ((state, motion), range))| {
                for (place, speed) in [(&mut state.x, &motion.x), (&mut state.z, &motion.z)] {
                    for (place, speed) in place.iter_mut().zip(speed) {
                        *place += step * speed;
                    }
                }
                *range = depths(frame, row, &state.z);
            });
        self.frame.state = states;
    }

    /// Brings deformations and stresses to the places of the particles.
    pub(super) fn strain_all(&mut self, response: Response) {
        let at_once = self.rows_at_once();
        let mut rows = std::mem::take(&mut self.rows);
        let body = &*self;
        rows.par_chunks_mut(at_once)
            .enumerate()
            .for_each(|(slice, rows)| {
                pulp::Arch::new().dispatch(Strain {
                    body,
                    first: slice * at_once,
                    response,
                    rows,
                });
            });
        self.rows = rows;
    }

    /// The row before, the own and the next one; at the ends of the body the own one, whose part is 0.
    #[inline(always)]
    fn around<'a, T>(&self, all: &'a [T], row: usize) -> [&'a T; 3] {
        [
            &all[row.saturating_sub(1)],
            &all[row],
            &all[(row + 1).min(all.len() - 1)],
        ]
    }

    #[inline(always)]
    fn strain_row<const MOVED: bool>(
        &self,
        number: usize,
        response: Response,
        row: &mut StressRow,
    ) {
        let law = &*self.law;
        let make = &self.frame.rows[number];
        let states: [&RowState; 3] = self.around(&self.frame.state, number);
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
                    let points = &mut row.points[block];
                    let strain_before = points.plastic_strain;
                    let cauchy = strain(
                        law,
                        points,
                        (&before, &deformation.gradient),
                        &volume,
                        (step, &size),
                        &mut taken,
                    );
                    let softer =
                        softened(law, points, &strain_before, (&stiffness, self.stiffness));
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

    /// Forces on the particles of a row, with the loads of contacts.
    #[inline(always)]
    fn row_forces(&self, row: usize, loads: &[Load<2>], force: &mut [Vec<f64>; 2]) {
        match self.frame.rows[0].is_moved() {
            true => self.inner_forces::<true>(row, force),
            false => self.inner_forces::<false>(row, force),
        }
        let start = loads.partition_point(|load| load.row < row);
        for load in loads[start..].iter().take_while(|load| load.row == row) {
            force[0][load.place] += load.force[0];
            force[1][load.place] += load.force[1];
        }
    }

    #[inline(always)]
    fn inner_forces<const MOVED: bool>(&self, row: usize, force: &mut [Vec<f64>; 2]) {
        let states: [&RowState; 3] = self.around(&self.frame.state, row);
        let rows: [&StressRow; 3] = self.around(&self.rows, row);
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
        self.row_forces(row, loads, &mut force);
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
                let squared = self.law.wave_speed_squared(points);
                let [xx, xz, zx, zz] = row.gradients(place);
                let (mass, before) = (load(&make.mass, place), least);
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

    /// Largest angular frequency of the body at rest [rad/s], by power iteration from a random motion, raised by what thirty rounds may leave.
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
        let mut square = 0.0;
        for _ in 0..FREQUENCY_ROUNDS {
            control.ask()?;
            let factor = size / self.speed();
            for (state, motion) in self.frame.state.iter_mut().zip(&mut self.frame.motion) {
                for (place, speed) in [(&mut state.x, &mut motion.x), (&mut state.z, &mut motion.z)]
                {
                    for (place, speed) in place.iter_mut().zip(speed) {
                        *place = factor * std::mem::take(speed);
                    }
                }
            }
            self.strain_all(Response::Elastic);
            self.kick(1.0, &[]);
            square = self.speed() / size;
        }
        Ok(FREQUENCY_MARGIN * square.sqrt())
    }

    /// Root of the mean square of the velocities, weighted with the masses [m/s].
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
}
