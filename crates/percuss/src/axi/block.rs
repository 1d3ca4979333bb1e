//! Eight particles side by side, so that one instruction works on all of them.

use super::{field::Field, law::Law, transfer::gather};
use crate::solver::{Particle, kinetic_energy};

/// Particles in a block: as many numbers as the widest registers hold.
pub(super) const LANES: usize = 8;

/// A number of every particle of a block.
pub(super) type Lane = [f64; LANES];

/// A number of every particle. Loops over lanes work on copies of whole arrays: what a compiler can tell apart from memory becomes
/// vector instructions.
#[inline(always)]
pub(super) fn lanes(value: impl Fn(usize) -> f64) -> Lane {
    let mut all = [0.0; LANES];
    for (lane, entry) in all.iter_mut().enumerate() {
        *entry = value(lane);
    }
    all
}

/// Several numbers of every particle.
#[inline(always)]
pub(super) fn each_of<const N: usize>(values: impl Fn(usize) -> [f64; N]) -> [Lane; N] {
    let mut all = [[0.0; LANES]; N];
    for lane in 0..LANES {
        for (entry, value) in all.iter_mut().zip(values(lane)) {
            entry[lane] = value;
        }
    }
    all
}

/// The numbers of one particle. (`map` would now and then not be inlined, and then lacks the wide instructions.)
#[inline(always)]
pub(super) fn one<const N: usize>(all: &[Lane; N], lane: usize) -> [f64; N] {
    let mut values = [0.0; N];
    for (value, entry) in values.iter_mut().zip(all) {
        *value = entry[lane];
    }
    values
}

/// What a step reads and changes of its particles, named as there.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(super) struct Block {
    pub(super) position: [Lane; 2],
    pub(super) velocity: [Lane; 2],
    pub(super) gradient: [Lane; 4],
    pub(super) deviator: [Lane; 3],
    pub(super) pressure: Lane,
    pub(super) viscous_pressure: Lane,
    pub(super) mass: Lane,
    pub(super) volume: Lane,
    pub(super) temperature: Lane,
    pub(super) energy: Lane,
    pub(super) damage: Lane,
}

/// The particles of a block: their places among those of a chunk.
#[derive(Debug, Clone, Copy)]
pub(super) struct Members {
    places: [usize; LANES],
    count: usize,
}

impl Members {
    /// The next particles from a place on that are still in the body, and where to go on; `None` when there are no more.
    #[inline(always)]
    pub(super) fn next(particles: &[Particle], from: &mut usize) -> Option<Self> {
        let mut members = Self {
            places: [0; LANES],
            count: 0,
        };
        while members.count < LANES && *from < particles.len() {
            members.places[members.count] = *from;
            members.count += usize::from(particles[*from].mass > 0.0);
            *from += 1;
        }
        let last = members.count.checked_sub(1)?;
        // Lanes that are left over do the last particle's work again; nobody asks for it.
        let place = members.places[last];
        members.places[last..].fill(place);
        Some(members)
    }

    /// Lanes in use.
    #[inline(always)]
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// Lanes in use and the places of their particles.
    #[inline(always)]
    pub(super) fn iter(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        self.places.into_iter().take(self.count).enumerate()
    }
}

impl Block {
    /// Particles as they are, but for their velocities and gradients: those are yet to come.
    #[inline(always)]
    pub(super) fn of(particles: &[Particle], members: &Members) -> Self {
        let places = &members.places;
        let each = |value: fn(&Particle) -> f64| lanes(|l| value(&particles[places[l]]));
        Self {
            position: [each(|p| p.position[0]), each(|p| p.position[1])],
            velocity: [[0.0; LANES]; 2],
            gradient: [[0.0; LANES]; 4],
            deviator: [
                each(|p| p.deviator[0]),
                each(|p| p.deviator[1]),
                each(|p| p.deviator[2]),
            ],
            pressure: each(|p| p.pressure),
            viscous_pressure: each(|p| p.viscous_pressure),
            mass: each(|p| p.mass),
            volume: each(|p| p.volume),
            temperature: each(|p| p.temperature),
            energy: each(|p| p.energy),
            damage: each(|p| p.damage),
        }
    }

    /// Writes back what a step changes, damage left out.
    #[inline(always)]
    pub(super) fn store(&self, particles: &mut [Particle], members: &Members) {
        for (lane, place) in members.iter() {
            let particle = &mut particles[place];
            particle.position = one(&self.position, lane);
            particle.velocity = one(&self.velocity, lane);
            particle.gradient = one(&self.gradient, lane);
            particle.deviator = one(&self.deviator, lane);
            particle.pressure = self.pressure[lane];
            particle.viscous_pressure = self.viscous_pressure[lane];
            particle.volume = self.volume[lane];
            particle.temperature = self.temperature[lane];
            particle.energy = self.energy[lane];
        }
    }

    /// Takes over velocities and their gradients as the particles have them.
    pub(super) fn keep_motion(&mut self, particles: &[Particle], members: &Members) {
        let places = &members.places;
        self.velocity = each_of(|l| particles[places[l]].velocity);
        self.gradient = each_of(|l| particles[places[l]].gradient);
    }

    /// Takes velocities and their gradients from the nodes.
    #[inline(always)]
    pub(super) fn gather(&mut self, per_cell: f64, field: &Field) {
        let [radius, depth] = self.position;
        // One particle after the other into memory: so the work on each becomes vector instructions too.
        let mut motions = [[0.0; 6]; LANES];
        for lane in 0..LANES {
            motions[lane] = gather([radius[lane], depth[lane]], per_cell, field);
        }
        let scale = 4.0 * per_cell;
        self.velocity = each_of(|l| [motions[l][0], motions[l][1]]);
        self.gradient = each_of(|l| {
            let [_, _, rr, zr, rz, zz] = motions[l];
            [scale * rr, scale * rz, scale * zr, scale * zz]
        });
    }

    /// Moves the particles, reflected in the axis.
    #[inline(always)]
    pub(super) fn travel(&mut self, time_step: f64) {
        let [radius, depth] = self.position;
        let [radial, axial] = self.velocity;
        self.position = [
            lanes(|l| (radius[l] + time_step * radial[l]).abs()),
            lanes(|l| depth[l] + time_step * axial[l]),
        ];
    }

    /// Hoop rate before the particles move [1/s].
    #[inline(always)]
    pub(super) fn hoop_rate(&self, law: &Law) -> Lane {
        let (radius, velocity) = (self.position[0], self.velocity[0]);
        if law.axisymmetric {
            lanes(|l| velocity[l] / radius[l])
        } else {
            [0.0; LANES]
        }
    }

    /// Kinetic energies [J].
    #[inline(always)]
    pub(super) fn kinetic_energy(&self, cell: f64) -> Lane {
        let (mass, velocity, gradient) = (self.mass, self.velocity, self.gradient);
        lanes(|l| {
            let velocity = one(&velocity, l);
            kinetic_energy(mass[l], velocity, one(&gradient, l), cell)
        })
    }
}
