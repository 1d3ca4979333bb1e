//! Forces of the local field under the nose and of the rim of a plug.

use std::f64::consts::PI;

use super::{
    fields::{Layer, Rim, Slip, hole, punch, rim},
    motion::{Impact, MotionState},
};
use crate::regime::nose_factor;

/// Layers of the plate.
pub(super) const LAYERS: usize = 16;
/// Slip in thicknesses that a rim at rest is given.
const LEAST_SLIP: f64 = 1e-6;
/// Largest growth of the slip between two bands.
const SLIP_GROWTH: f64 = 1.1;

/// Forces that the local field and the rim transmit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Forces {
    /// Plastic force of the local field [N].
    pub local: f64,
    /// Its inertial force [N].
    pub inertial: f64,
    /// Force at the rim [N].
    pub rim: f64,
}

impl Impact {
    /// Forces in the middle of a step, and the band of the plug.
    pub fn forces(&self, now: &MotionState, duration: f64, next: &mut MotionState) -> Forces {
        let [projectile, plug, dish] = now.velocities;
        if self.flat() {
            let relative = (projectile - plug).max(0.0);
            let (local, inertial) = self.punch(now.sunk, relative);
            let slip_rate = (plug - dish).max(0.0);
            let slip = now.slip + 0.5 * duration * slip_rate;
            next.rim = self.band(now, slip, slip_rate);
            let height = self.thickness - slip - now.sunk - 0.5 * duration * relative;
            let rim = PI * self.diameter * height.max(0.0) * next.rim.stress;
            Forces {
                local,
                inertial,
                rim,
            }
        } else {
            let relative = (projectile - dish).max(0.0);
            let sunk = now.sunk + 0.5 * duration * relative;
            let (local, inertial) = self.opening(sunk, relative, &mut next.extent);
            Forces {
                local,
                inertial,
                rim: 0.0,
            }
        }
    }

    /// The band at the rim.
    ///
    /// It grows to the widest of all slips on the way: a step that passes many of them must not leave one out.
    fn band(&self, now: &MotionState, slip: f64, slip_rate: f64) -> Rim {
        // A rim at rest has the band of the least slip.
        let least = LEAST_SLIP * self.thickness;
        let slip = slip.max(least);
        let mut reached = now.rim.slip().max(least).min(slip);
        let mut width = now.rim.width;
        loop {
            reached = (reached * SLIP_GROWTH).min(slip);
            let band = rim(
                &self.flow,
                &Slip {
                    radius: self.radius(),
                    slip: reached,
                    rate: slip_rate,
                    width,
                },
            );
            if reached >= slip {
                return band;
            }
            width = band.width;
        }
    }

    /// Plastic and inertial force on a flat face [N] that sinks at a relative speed [m/s].
    fn punch(&self, sunk: f64, relative: f64) -> (f64, f64) {
        if !self.indentation {
            return (f64::INFINITY, 0.0);
        }
        let radius = self.radius();
        let strain = punch::RATE * (sunk / radius).min(punch::DEPTH);
        let rate = punch::RATE * relative / radius;
        let pressure = punch::PRESSURE * self.flow.stress(strain, rate);
        let slow = pressure.min(self.cavity_pressures[0]);
        let inertial = 0.5 * self.density * relative * relative;
        (slow * self.area(), inertial * self.area())
    }

    /// Layers of equal thickness around a nose that has sunk so far [m].
    pub fn layers<const COUNT: usize>(&self, sunk: f64) -> [Layer; COUNT] {
        let square = |behind: f64| self.nose.radius(self.diameter, behind).powi(2);
        let height = self.thickness / COUNT as f64;
        std::array::from_fn(|i| {
            let behind = sunk - i as f64 * height;
            let (wide, narrow) = (square(behind), square(behind - height));
            Layer {
                radius: (0.5 * (wide + narrow)).sqrt(),
                gain: PI * (wide - narrow),
            }
        })
    }

    /// Plastic and inertial force on a pointed or round nose [N]; `extent` is that of the field before, then of this one.
    pub fn opening(&self, sunk: f64, relative: f64, extent: &mut Option<f64>) -> (f64, f64) {
        let at = |behind: f64| self.nose.radius(self.diameter, behind);
        let (front, back) = (at(sunk), at(sunk - self.thickness));
        let contact = PI * (front * front - back * back);
        if contact <= 0.0 {
            return (0.0, 0.0);
        }
        let factor = nose_factor(self.nose);
        let growth = relative * factor.sqrt();
        let layers = self.layers::<LAYERS>(sunk);
        let hole = hole(&self.hole_stress, &layers, self.thickness, *extent);
        *extent = Some(hole.extent);
        let slow = hole.force.min(self.cavity_pressures[1] * contact);
        let inertial = hole.inertia * self.density * growth * growth;
        (slow, inertial * contact)
    }
}
