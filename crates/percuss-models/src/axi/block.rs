//! Eight particles side by side, so that one instruction works on all of them.

use super::{field::Field, law::Law, transfer::gather};
use crate::{
    lanes::{LANES, Lanes, each_of, lanes, one},
    solver::{Particle, kinetic_energy},
};

/// What a step reads and changes of its particles, named as there.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(super) struct Block {
    pub(super) position: [Lanes; 2],
    pub(super) velocity: [Lanes; 2],
    pub(super) gradient: [Lanes; 4],
    pub(super) deviator: [Lanes; 3],
    pub(super) pressure: Lanes,
    pub(super) viscous_pressure: Lanes,
    pub(super) mass: Lanes,
    pub(super) volume: Lanes,
    pub(super) temperature: Lanes,
    pub(super) energy: Lanes,
    pub(super) damage: Lanes,
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
    /// Particles as they are, except for their velocities and gradients: those are yet to come.
    #[inline(always)]
    pub(super) fn of(particles: &[Particle], members: &Members) -> Self {
        let places = &members.places;
        let each = |value: fn(&Particle) -> f64| lanes(|l| value(&particles[places[l]]));
        Self {
            position: [each(|p| p.position[0]), each(|p| p.position[1])],
            velocity: [Lanes::all(0.0); 2],
            gradient: [Lanes::all(0.0); 4],
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
    pub(super) fn hoop_rate(&self, law: &Law) -> Lanes {
        let (radius, velocity) = (self.position[0], self.velocity[0]);
        if law.axisymmetric {
            lanes(|l| velocity[l] / radius[l])
        } else {
            Lanes::all(0.0)
        }
    }

    /// Kinetic energies [J].
    #[inline(always)]
    pub(super) fn kinetic_energy(&self, cell: f64) -> Lanes {
        let (mass, velocity, gradient) = (self.mass, self.velocity, self.gradient);
        lanes(|l| {
            let velocity = one(&velocity, l);
            kinetic_energy(mass[l], velocity, one(&gradient, l), cell)
        })
    }
}
