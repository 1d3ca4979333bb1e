//! Eight particles side by side, so that one instruction works on all of them.

use std::ops::{Deref, DerefMut};

use super::{
    field::Field,
    kernel::Stencils,
    mesh::Places,
    transfer::{Motion, gather},
};
use crate::{
    lanes::{LANES, Lanes, each_of, lanes, one, settled},
    solid::{Law, MaterialPoints, set_one},
    solver::Particle,
};

/// Rate, per unit of strain, at which the part of an affine field that the nodes do not resolve decays.
const FORGETTING: f64 = 2.0;

/// Particles of a body, named as there. Those without mass have left the body or fill up the last block of a chunk.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(64))]
pub(super) struct Block {
    pub(super) position: [Lanes; 2],
    pub(super) velocity: [Lanes; 2],
    pub(super) gradient: [Lanes; 4],
    pub(super) sides: [Lanes; 2],
    /// Whether a particle is alone in its group: 1 if it is.
    pub(super) lone: Lanes,
    /// Their material, which a block stands for wherever only that is asked for.
    pub(super) points: MaterialPoints,
}

impl Deref for Block {
    type Target = MaterialPoints;

    #[inline(always)]
    fn deref(&self) -> &MaterialPoints {
        &self.points
    }
}

impl DerefMut for Block {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut MaterialPoints {
        &mut self.points
    }
}

/// Motion of the nodes at the particles of a block in a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Drawn {
    /// Velocity of the nodes at a particle, which carries it.
    pub(super) drift: [Lanes; 2],
    /// Velocity gradient of the nodes.
    pub(super) rate: [Lanes; 4],
    /// What the nodes did not resolve of the affine field before the step.
    unresolved: [Lanes; 4],
}

impl Block {
    /// A particle.
    #[inline]
    pub(super) fn particle(&self, lane: usize) -> Particle {
        Particle {
            position: one(&self.position, lane),
            velocity: one(&self.velocity, lane),
            gradient: one(&self.gradient, lane),
            sides: one(&self.sides, lane),
            ..self.points.particle(lane)
        }
    }

    /// Replaces a particle.
    #[inline]
    pub(super) fn set_particle(&mut self, lane: usize, particle: &Particle) {
        set_one(&mut self.position, lane, particle.position);
        set_one(&mut self.velocity, lane, particle.velocity);
        set_one(&mut self.gradient, lane, particle.gradient);
        set_one(&mut self.sides, lane, particle.sides);
        self.points.set_particle(lane, particle);
    }

    /// Takes a particle out of the body. Its lane goes on at the origin, where it harms nobody.
    pub(super) fn take_out(&mut self, lane: usize) {
        self.mass[lane] = 0.0;
        set_one(&mut self.position, lane, [0.0; 2]);
    }

    /// Weights in the means of groups: volumes of particles that are in the body and sound, 0 of others. A failed one bears no tension.
    #[inline(always)]
    pub(super) fn weights(&self) -> Lanes {
        let (mass, damage, volume) = (self.mass, self.damage, self.volume);
        lanes(|l| {
            let is_sound = (mass[l] > 0.0) & (damage[l] < 1.0);
            if is_sound { volume[l] } else { 0.0 }
        })
    }

    /// Takes the motion of the nodes: what the step changed there is added to the velocity of a particle and to its affine field.
    ///
    /// So a particle keeps what the nodes do not resolve of its motion. Means over the nodes alone \[jiang2015\] would lose that in every
    /// step, the more the shorter the steps are; with the velocity alone kept \[fei2021\], the affine field still does.
    #[inline(always)]
    pub(super) fn gather(&mut self, places: &Places, cell: f64, field: &Field) -> Drawn {
        let [radial, axial] = &places.index;
        let (radial, axial) = (settled(Stencils::at(radial)), settled(Stencils::at(axial)));
        // One particle after the other into memory: so the work on each becomes vector instructions too.
        let mut motions = [Motion::default(); LANES];
        for (lane, motion) in motions.iter_mut().enumerate() {
            if self.mass[lane] > 0.0 {
                *motion = gather([radial.of(lane), axial.of(lane)], field);
            }
        }
        let [stretch_r, stretch_z] = places.stretch;
        let scale = 4.0 / cell;
        let drift = each_of(|l| [motions[l].velocity[0], motions[l].velocity[1]]);
        let before = self.velocity;
        self.velocity = each_of(|l| {
            let [r, z, r_before, z_before] = motions[l].velocity;
            [r + (before[0][l] - r_before), z + (before[1][l] - z_before)]
        });
        let rate = each_of(|l| {
            let (along_r, along_z) = (scale / stretch_r[l], scale / stretch_z[l]);
            let ([rr, zr, ..], [rz, zz, ..]) = (motions[l].along_r, motions[l].along_z);
            [along_r * rr, along_z * rz, along_r * zr, along_z * zz]
        });
        let before = self.gradient;
        let unresolved = each_of(|l| {
            let (along_r, along_z) = (scale / stretch_r[l], scale / stretch_z[l]);
            let ([_, _, rr, zr], [_, _, rz, zz]) = (motions[l].along_r, motions[l].along_z);
            [
                before[0][l] - along_r * rr,
                before[1][l] - along_z * rz,
                before[2][l] - along_r * zr,
                before[3][l] - along_z * zz,
            ]
        });
        Drawn {
            drift,
            rate,
            unresolved,
        }
    }

    /// Carries the affine fields along: neighbours that a step has moved apart by `1 + C Δt` have the same velocities as before, so the
    /// gradient of the nodes is that before times its inverse. In a turning body that balances what its centripetal forces add.
    ///
    /// What the nodes do not resolve is forgotten as the material deforms, not as steps pass: kept for ever, it would grow in jets. The
    /// strain of a particle that is alone in its cell, which no neighbours stand for, decays as well: a fluid particle whose inertia
    /// does not shrink with it would draw energy from being carried.
    #[inline(always)]
    fn carry(&mut self, drawn: &Drawn, time_step: f64) {
        let lone = self.lone;
        let ([rr, rz, zr, zz], rest) = (drawn.rate, drawn.unresolved);
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
    pub(super) fn travel(&mut self, drawn: &Drawn, time_step: f64) {
        self.carry(drawn, time_step);
        let [radius, depth] = self.position;
        let [radial, axial] = drawn.drift;
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
    pub(super) fn hoop_rate(&self, drawn: &Drawn, law: &Law) -> Lanes {
        let (radius, velocity) = (self.position[0], drawn.drift[0]);
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
