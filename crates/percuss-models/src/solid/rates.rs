//! Rates of strain of a block of particles.

use super::{law::Law, points::MaterialPoints};
use crate::lanes::{Lanes, each_of, lanes};

/// Rate, per unit of strain, at which the pressures of a group come together.
const RELAXING: f64 = 4.0;

/// Rates of strain of a block [1/s], on the configuration half a step on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rates {
    /// Deviatoric strain rates rr, zz, rz.
    pub(crate) shape: [Lanes; 3],
    /// Rate of volume.
    pub(crate) expansion: Lanes,
    /// Part of the pressure beyond the mean of the group [Pa], and rate of volume by which it decays.
    pub(crate) excess: Lanes,
    pub(crate) relaxation: Lanes,
    pub(crate) spin: Lanes,
}

impl Rates {
    /// Those of a step that takes no time.
    pub(crate) const NONE: Self = Self {
        shape: [Lanes::all(0.0); 3],
        expansion: Lanes::all(0.0),
        relaxation: Lanes::all(0.0),
        excess: Lanes::all(0.0),
        spin: Lanes::all(0.0),
    };

    /// Equivalent rates of shear.
    #[inline(always)]
    pub(crate) fn shear(&self) -> Lanes {
        let [rr, zz, rz] = self.shape;
        lanes(|l| (rr[l] * rr[l] + zz[l] * zz[l] + rr[l] * zz[l] + rz[l] * rz[l]).sqrt())
    }

    /// Lets the pressures of sound particles come together with the mean of their group, at a part of its mean rate of shear.
    #[inline(always)]
    pub(crate) fn relax(
        &mut self,
        block: &MaterialPoints,
        mean: &Lanes,
        shear: &Lanes,
        law: &Law,
        time_step: f64,
    ) {
        let per_modulus = 1.0 / law.bulk_modulus;
        let (damage, pressure) = (block.damage, block.pressure);
        let (mean, shear) = (*mean, *shear);
        [self.excess, self.relaxation] = each_of(|l| {
            let excess = pressure[l] - mean[l];
            let excess = if damage[l] < 1.0 { excess } else { 0.0 };
            let rate = RELAXING * shear[l];
            [
                excess,
                excess * per_modulus * rate / (1.0 + rate * time_step),
            ]
        });
    }

    /// Those of a velocity gradient of the nodes and of hoop rates.
    ///
    /// Particles move by the velocities at the start of the step, which the gradient C belongs to: on the mean configuration,
    /// `C (1 + C Δt/2)⁻¹`, it gives their change of shape to second order, and that of a turning body, which straight ways make larger,
    /// too.
    #[inline(always)]
    pub(crate) fn of(gradient: &[Lanes; 4], hoop_rate: Lanes, time_step: f64) -> Self {
        let [rr, rz, zr, zz] = *gradient;
        let half = 0.5 * time_step;
        let [shape_rr, shape_zz, shape_rz, expansion, spin] = each_of(|l| {
            let product = half * (rr[l] * zz[l] - rz[l] * zr[l]);
            let scale = 1.0 / (1.0 + half * (rr[l] + zz[l] + product));
            let (rr, rz, zr, zz) = (
                (rr[l] + product) * scale,
                rz[l] * scale,
                zr[l] * scale,
                (zz[l] + product) * scale,
            );
            let hoop = hoop_rate[l] / (1.0 + half * hoop_rate[l]);
            let expansion = rr + zz + hoop;
            let third = expansion / 3.0;
            [
                rr - third,
                zz - third,
                0.5 * (rz + zr),
                expansion,
                0.5 * (rz - zr),
            ]
        });
        Self {
            shape: [shape_rr, shape_zz, shape_rz],
            expansion,
            relaxation: Lanes::all(0.0),
            excess: Lanes::all(0.0),
            spin,
        }
    }

    /// Those of a velocity gradient on the configuration half a step on, in plane strain, with the rate of volume.
    #[inline(always)]
    pub(crate) fn half_way(gradient: &[Lanes; 4], expansion: Lanes) -> Self {
        let [rr, rz, zr, zz] = *gradient;
        let [shape_rr, shape_zz, shape_rz, spin] = each_of(|l| {
            let third = (rr[l] + zz[l]) / 3.0;
            [
                rr[l] - third,
                zz[l] - third,
                0.5 * (rz[l] + zr[l]),
                0.5 * (rz[l] - zr[l]),
            ]
        });
        Self {
            shape: [shape_rr, shape_zz, shape_rz],
            expansion,
            spin,
            ..Self::NONE
        }
    }
}
