//! Time step of a body in space: elongations, changes of volume, pulls, then forces and motion, layer by layer.
//!
//! Every particle sums its own forces in the same order, so threads change no bit.

use rayon::prelude::*;

use super::{
    super::{
        bonded::Load,
        energy::BodySums,
        frequency::{Oscillator, largest_frequency},
    },
    body::{Bonds, CubicBody, Damage, Vector},
    kernels::{Common, Dilatation, Move, Next, Pull, Sum, before},
    lattice::KINDS,
    stretch::Stretch,
};
use crate::{Error, random::unit, solver::Control};

/// Particles below which one thread takes all layers.
const SMALL: usize = 8192;
/// Random numbers that the search for the largest frequency starts from.
const FREQUENCY_STREAM: u64 = 0xf1e1e;

/// Forces of bonds on the particles of a layer, and of contacts.
fn add_loads(force: &mut Vector, layer: usize, loads: &[Load<3>]) {
    let start = loads.partition_point(|load| load.row < layer);
    for load in loads[start..].iter().take_while(|load| load.row == layer) {
        for (force, part) in force.iter_mut().zip(load.force) {
            force[load.place] += part;
        }
    }
}

impl CubicBody {
    fn common(&self) -> Common<'_> {
        Common {
            lattice: &self.lattice,
            grid: self.grid,
            softening: self.softening.as_ref(),
            is_moved: self.is_moved(),
        }
    }

    /// A layer and the two behind it; the last ones stand for what is not there, as no bond goes to it.
    fn next(&self, number: usize) -> Next<'_> {
        let last = self.layers.len() - 1;
        let numbers = [0, 1, 2].map(|on| (number + on).min(last));
        Next {
            number,
            layers: numbers.map(|number| &self.layers[number]),
            state: numbers.map(|number| &self.state[number]),
            volume_pull: numbers.map(|number| &*self.volume_pull[number]),
        }
    }

    /// Layers that one task takes.
    fn at_once(&self) -> usize {
        let layers = self.layers.len();
        match layers * self.grid.places() {
            0..SMALL => layers,
            _ => layers.div_ceil(4 * rayon::current_num_threads()).max(1),
        }
    }

    /// Bonds and damage at the present displacements.
    pub(in super::super) fn refresh(&mut self) {
        let arch = pulp::Arch::new();
        let mut bonds = std::mem::take(&mut self.bonds);
        let mut damage = std::mem::take(&mut self.damage);
        let mut volume_pull = std::mem::take(&mut self.next_volume_pull);
        self.each_layer(&mut bonds, &mut damage, |common, next, bonds, damage| {
            arch.dispatch(Stretch {
                common,
                next,
                bonds,
                damage,
            });
        });
        let body = &*self;
        volume_pull
            .par_iter_mut()
            .enumerate()
            .with_min_len(body.at_once())
            .for_each(|(number, volume_pull)| {
                arch.dispatch(Dilatation {
                    grid: body.grid,
                    number,
                    layer: &body.layers[number],
                    bonds: before(&bonds, number),
                    volume_pull,
                });
            });
        self.next_volume_pull = std::mem::replace(&mut self.volume_pull, volume_pull);
        self.each_layer(&mut bonds, &mut damage, |common, next, bonds, damage| {
            arch.dispatch(Pull {
                common,
                next,
                bonds,
                damage,
            });
        });
        self.bonds = bonds;
        self.damage = damage;
    }

    /// Computes something of the bonds that start in each layer.
    fn each_layer(
        &self,
        bonds: &mut [Bonds],
        damage: &mut [Damage],
        compute: impl Fn(Common<'_>, Next<'_>, &mut Bonds, &mut Damage) + Sync,
    ) {
        (bonds.par_iter_mut().zip(damage).enumerate())
            .with_min_len(self.at_once())
            .for_each(|(number, (bonds, damage))| {
                compute(self.common(), self.next(number), bonds, damage);
            });
    }

    /// Forces on the particles of a layer [N].
    fn forces(&self, number: usize, loads: &[Load<3>], force: &mut Vector) {
        pulp::Arch::new().dispatch(Sum {
            common: self.common(),
            number,
            layers: &self.layers,
            state: &self.state,
            bonds: before(&self.bonds, number),
            force,
        });
        add_loads(force, number, loads);
    }

    /// Takes the forces on what is held, and returns their sum along the normal of the struck face [N].
    fn hold(&self, number: usize, force: &mut Vector) -> f64 {
        let start = self.held.partition_point(|held| held.0 < number);
        let mut sum = 0.0;
        for &(_, place, axis) in self.held[start..]
            .iter()
            .take_while(|held| held.0 == number)
        {
            let taken = std::mem::take(&mut force[axis][place]);
            sum += if axis == 2 { taken } else { 0.0 };
        }
        sum
    }

    /// Advances all particles by a step [s]; returns the impulse on the support [N s].
    pub(super) fn advance_layers(&mut self, step: f64, loads: &[Load<3>]) -> f64 {
        let mut motion = std::mem::take(&mut self.motion);
        let mut next = std::mem::take(&mut self.next);
        let body = &*self;
        let at_once = body.at_once();
        let supports: Vec<f64> = next
            .par_chunks_mut(at_once)
            .zip(motion.par_chunks_mut(at_once))
            .enumerate()
            .map(|(slice, (after, motion))| {
                let mut force = [(); 3].map(|()| vec![0.0; body.grid.places()]);
                let mut support = 0.0;
                for (index, (after, motion)) in after.iter_mut().zip(motion).enumerate() {
                    let number = slice * at_once + index;
                    body.forces(number, loads, &mut force);
                    support += step * body.hold(number, &mut force);
                    pulp::Arch::new().dispatch(Move {
                        grid: body.grid,
                        layer: &body.layers[number],
                        force: &force,
                        step,
                        before: &body.state[number],
                        after,
                        motion,
                    });
                }
                support
            })
            .collect();
        self.motion = motion;
        self.next = std::mem::replace(&mut self.state, next);
        self.refresh();
        // The support stands behind the last slice: all others add nothing.
        supports.iter().sum()
    }

    /// Energies now, the velocities taken half a step on under the same loads.
    pub(super) fn energies(&self, step: f64, loads: &[Load<3>]) -> BodySums {
        BodySums::of_rows(self.layers.len(), 1, |number| {
            self.layer_energies(number, step, loads)
        })
    }

    /// Kinetic energy as `½ m v₋·v₊` of the velocities half a step before and after.
    fn layer_energies(&self, number: usize, step: f64, loads: &[Load<3>]) -> BodySums {
        let mut force = [(); 3].map(|()| vec![0.0; self.grid.places()]);
        self.forces(number, loads, &mut force);
        self.hold(number, &mut force);
        let (layer, motion) = (&self.layers[number], &self.motion[number]);
        let mut sums = BodySums {
            fracture: self.damage[number].lost,
            ..BodySums::default()
        };
        for (place, &mass) in layer.mass.iter().enumerate() {
            if mass == 0.0 {
                continue;
            }
            for axis in 0..3 {
                let speed = motion[axis][place];
                sums.kinetic += 0.5 * speed * (mass * speed + step * force[axis][place]);
            }
            for kind in 0..KINDS {
                sums.elastic += self.spring_energy(number, place, kind);
            }
            let (volume_pull, stiff) = (
                self.volume_pull[number][place],
                layer.volume_stiffness[place],
            );
            if stiff != 0.0 {
                sums.elastic += 0.5 * volume_pull * volume_pull / stiff;
            }
        }
        sums
    }

    /// Energy of the spring of a bond [J].
    fn spring_energy(&self, layer: usize, place: usize, kind: usize) -> f64 {
        let elongation = self.bonds[layer].elongation[kind][place];
        let stiffness = self.layers[layer].weights[kind][place] * self.lattice.stiffness(kind);
        let left = match elongation > 0.0 {
            true => self.integrity(layer, place, kind),
            false => 1.0,
        };
        0.5 * left * stiffness * elongation * elongation
    }

    /// Part of its springs that a bond has left.
    pub(super) fn integrity(&self, layer: usize, place: usize, kind: usize) -> f64 {
        self.softening.map_or(1.0, |laws| {
            laws[0].integrity(self.damage[layer].worst[kind][place], 1.0)
        })
    }

    /// Largest angular frequency [rad/s] of small displacements.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub(super) fn measured_frequency(&mut self, control: &mut Control<'_>) -> Result<f64, Error> {
        control.ask()?;
        // In place, and back again: a copy of the body would take as much memory as a run.
        let (state, motion) = (self.state.clone(), self.motion.clone());
        let (damage, softening) = (self.damage.clone(), self.softening.take());
        let found = self.frequency_of_random_motion(control);
        (self.state, self.motion) = (state, motion);
        (self.damage, self.softening) = (damage, softening);
        self.refresh();
        found
    }

    fn frequency_of_random_motion(&mut self, control: &mut Control<'_>) -> Result<f64, Error> {
        let size = 1e-9 * self.lattice.side;
        for layer in 0..self.layers.len() {
            for place in 0..self.grid.places() {
                if self.layers[layer].mass[place] > 0.0 {
                    let index = 3 * (layer * self.grid.places() + place) as u64;
                    for axis in 0..3 {
                        let draw = unit(FREQUENCY_STREAM, index + axis as u64) - 0.5;
                        self.motion[layer][axis][place] = draw;
                    }
                }
            }
        }
        largest_frequency(self, size, control)
    }

    /// Stress `[xx, yy, zz, yz, xz, xy]` of a particle [Pa], tension positive: the mean over its volume by the virial of its bonds.
    pub(in super::super) fn stress(&self, layer: usize, place: usize) -> [f64; 6] {
        let mut sum = [0.0; 6];
        for (first, at, kind) in self.around(layer, place) {
            let bonds: &Bonds = &self.bonds[first];
            let pull = 0.5 * bonds.pull[kind][at];
            if self.layers[first].weights[kind][at] == 0.0 {
                continue;
            }
            let (other_layer, other) = self.end_of(first, at, kind);
            let [from, to] = [self.now(first, at), self.now(other_layer, other)];
            let [x, y, z] = [0, 1, 2].map(|axis| to[axis] - from[axis]);
            for (sum, part) in sum
                .iter_mut()
                .zip([x * x, y * y, z * z, y * z, x * z, x * y])
            {
                *sum += pull * part;
            }
        }
        let volume = self.layers[layer].mass[place] / self.lattice.density;
        sum.map(|part| part / volume)
    }

    /// Position of a particle now [m].
    pub(super) fn now(&self, layer: usize, place: usize) -> [f64; 3] {
        let start = self.rest_place(layer, place);
        let state = &self.state[layer];
        [0, 1, 2].map(|axis| start[axis] + state[axis][place])
    }
}

impl Oscillator for CubicBody {
    fn speed(&self) -> f64 {
        let mut sum = 0.0;
        let mut all = 0.0;
        for (layer, motion) in self.layers.iter().zip(&self.motion) {
            for (place, mass) in layer.mass.iter().enumerate() {
                let square: f64 = motion.iter().map(|part| part[place] * part[place]).sum();
                sum += mass * square;
                all += mass;
            }
        }
        (sum / all).sqrt()
    }

    fn displace_by_motion(&mut self, factor: f64) {
        for (state, motion) in self.state.iter_mut().zip(&mut self.motion) {
            for (to, from) in state.iter_mut().zip(motion) {
                for (to, from) in to.iter_mut().zip(from) {
                    *to = factor * std::mem::take(from);
                }
            }
        }
        self.refresh();
    }

    fn accelerate(&mut self) {
        self.advance_layers(1.0, &[]);
    }
}
