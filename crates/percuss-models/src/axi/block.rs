//! Eight particles side by side, so that one instruction works on all of them.

use super::{
    field::Field,
    law::Law,
    mesh::Places,
    transfer::{Motion, gather},
};
use crate::{
    lanes::{LANES, Lanes, each_of, lanes, one},
    solver::Particle,
};

/// Rate, per unit of strain, at which the part of an affine field that the nodes do not resolve decays.
const FORGETTING: f64 = 2.0;

/// What a step reads and changes of its particles, named as there.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(super) struct Block {
    pub(super) position: [Lanes; 2],
    pub(super) velocity: [Lanes; 2],
    /// Velocity of the nodes at the particle, which carries it.
    pub(super) drift: [Lanes; 2],
    /// Affine velocity field of the particle, and velocity gradient of the nodes in this step.
    pub(super) gradient: [Lanes; 4],
    pub(super) rate: [Lanes; 4],
    /// What the nodes did not resolve of the affine field before the step.
    unresolved: [Lanes; 4],
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

    /// Values of the members.
    #[inline(always)]
    pub(super) fn lanes(&self, values: &[f64]) -> Lanes {
        lanes(|l| values[self.places[l]])
    }

    /// Lanes in use and the places of their particles.
    #[inline(always)]
    pub(super) fn iter(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        self.places.into_iter().take(self.count).enumerate()
    }
}

impl Block {
    /// Particles as they are.
    #[inline(always)]
    pub(super) fn of(particles: &[Particle], members: &Members) -> Self {
        let places = &members.places;
        let each = |value: fn(&Particle) -> f64| lanes(|l| value(&particles[places[l]]));
        Self {
            position: [each(|p| p.position[0]), each(|p| p.position[1])],
            velocity: [each(|p| p.velocity[0]), each(|p| p.velocity[1])],
            drift: [Lanes::all(0.0); 2],
            rate: [Lanes::all(0.0); 4],
            unresolved: [Lanes::all(0.0); 4],
            gradient: each_of(|l| particles[places[l]].gradient),
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

    /// Takes the motion of the nodes: what the step changed there is added to the velocity of a particle and to its affine field.
    ///
    /// So a particle keeps what the nodes do not resolve of its motion. Means over the nodes alone \[jiang2015\] would lose that in every
    /// step, the more the shorter the steps are; with the velocity alone kept \[fei2021\], the affine field still does.
    #[inline(always)]
    pub(super) fn gather(&mut self, places: &Places, cell: f64, field: &Field) {
        let [radius, depth] = places.index;
        // One particle after the other into memory: so the work on each becomes vector instructions too.
        let mut motions = [Motion::default(); LANES];
        for lane in 0..LANES {
            motions[lane] = gather([radius[lane], depth[lane]], field);
        }
        let [stretch_r, stretch_z] = places.stretch;
        let scale = 4.0 / cell;
        self.drift = each_of(|l| [motions[l].velocity[0], motions[l].velocity[1]]);
        let before = self.velocity;
        self.velocity = each_of(|l| {
            let [r, z, r_before, z_before] = motions[l].velocity;
            [r + (before[0][l] - r_before), z + (before[1][l] - z_before)]
        });
        self.rate = each_of(|l| {
            let (along_r, along_z) = (scale / stretch_r[l], scale / stretch_z[l]);
            let ([rr, zr, ..], [rz, zz, ..]) = (motions[l].along_r, motions[l].along_z);
            [along_r * rr, along_z * rz, along_r * zr, along_z * zz]
        });
        let before = self.gradient;
        self.unresolved = each_of(|l| {
            let (along_r, along_z) = (scale / stretch_r[l], scale / stretch_z[l]);
            let ([_, _, rr, zr], [_, _, rz, zz]) = (motions[l].along_r, motions[l].along_z);
            [
                before[0][l] - along_r * rr,
                before[1][l] - along_z * rz,
                before[2][l] - along_r * zr,
                before[3][l] - along_z * zz,
            ]
        });
    }

    /// Carries the affine fields along: neighbours that a step has moved apart by `1 + C Δt` have the same velocities as before, so the
    /// gradient of the nodes is that before times its inverse. In a turning body that balances what its centripetal forces add.
    ///
    /// What the nodes do not resolve is forgotten as the material deforms, not as steps pass: kept for ever, it would grow in jets. The
    /// strain of a particle that is alone in its cell, which no neighbours stand for, decays as well: a fluid particle whose inertia
    /// does not shrink with it would draw energy from being carried.
    #[inline(always)]
    fn carry(&mut self, time_step: f64, lone: &Lanes) {
        let ([rr, rz, zr, zz], rest) = (self.rate, self.unresolved);
        self.gradient = each_of(|l| {
            let product = time_step * (rr[l] * zz[l] - rz[l] * zr[l]);
            let scale = 1.0 / (1.0 + time_step * (rr[l] + zz[l] + product));
            let squared = rr[l] * rr[l] + rz[l] * rz[l] + zr[l] * zr[l] + zz[l] * zz[l];
            let kept = 1.0 / (1.0 + FORGETTING * time_step * squared.sqrt());
            let shear = rz[l] + zr[l];
            let strain = (rr[l] * rr[l] + zz[l] * zz[l] + 0.5 * shear * shear).sqrt();
            let left = 1.0 / (1.0 + FORGETTING * time_step * lone[l] * strain);
            let scale = left * scale;
            [
                (rr[l] + product) * scale + kept * rest[0][l],
                rz[l] * scale + kept * rest[1][l],
                zr[l] * scale + kept * rest[2][l],
                (zz[l] + product) * scale + kept * rest[3][l],
            ]
        });
    }

    /// Moves the particles, reflected in the axis.
    #[inline(always)]
    pub(super) fn travel(&mut self, time_step: f64, lone: &Lanes) {
        self.carry(time_step, lone);
        let [radius, depth] = self.position;
        let [radial, axial] = self.drift;
        let place = lanes(|l| radius[l] + time_step * radial[l]);
        self.position = [
            lanes(|l| place[l].abs()),
            lanes(|l| depth[l] + time_step * axial[l]),
        ];
        // Beyond the axis it is the mirror image that goes on.
        let side = lanes(|l| 1.0_f64.copysign(place[l]));
        for l in 0..LANES {
            self.velocity[0][l] *= side[l];
            self.gradient[1][l] *= side[l];
            self.gradient[2][l] *= side[l];
            self.deviator[2][l] *= side[l];
        }
    }

    /// Hoop rate before the particles move [1/s].
    #[inline(always)]
    pub(super) fn hoop_rate(&self, law: &Law) -> Lanes {
        let (radius, velocity) = (self.position[0], self.drift[0]);
        if law.axisymmetric {
            lanes(|l| velocity[l] / radius[l])
        } else {
            Lanes::all(0.0)
        }
    }

    /// Kinetic energies, those of the velocity gradients within the kernels included [J].
    #[inline(always)]
    pub(super) fn kinetic_energy(&self, places: &Places, cell: f64) -> Lanes {
        let (mass, [v_r, v_z]) = (self.mass, self.velocity);
        let ([rr, rz, zr, zz], [radial, axial]) = (self.gradient, places.stretch);
        lanes(|l| {
            let along_r = radial[l] * radial[l] * (rr[l] * rr[l] + zr[l] * zr[l]);
            let along_z = axial[l] * axial[l] * (rz[l] * rz[l] + zz[l] * zz[l]);
            let affine = 0.25 * cell * cell * (along_r + along_z);
            0.5 * mass[l] * (v_r[l] * v_r[l] + v_z[l] * v_z[l] + affine)
        })
    }
}
