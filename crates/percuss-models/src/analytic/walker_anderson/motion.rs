//! Equations of motion along the axis: an eroding rod, then a rigid one.

use super::{
    super::{
        long_rod::{STOPPED, USED_UP, erosion_ends, failure},
        ode::{FinalState, IntegrationError, Problem},
    },
    flow::Flow,
};
use crate::error::NumericalError;

/// Error of a step as a part of the quantity.
const TOLERANCE: f64 = 1e-10;

/// A rod, a target and a crater.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Motion {
    /// Density of the rod [kg/m3].
    pub(super) density: f64,
    /// Flow stress of the rod [Pa].
    pub(super) strength: f64,
    /// Speed of an elastic wave along the rod [m/s].
    pub(super) bar_speed: f64,
    /// Bulk sound speed of the rod's material [m/s].
    pub(super) sound_speed: f64,
    /// Slope of its shock speed against particle speed.
    pub(super) slope: f64,
    /// Target.
    pub(super) target: Flow,
    /// Radius of the crater [m].
    pub(super) crater_radius: f64,
}

/// Tail speed [m/s], tip speed [m/s], length [m] and depth [m].
pub(super) type State = [f64; 4];

/// Where a rod ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stop {
    pub(super) depth: f64,
    pub(super) rigid_depth: f64,
    pub(super) length: f64,
    pub(super) hand_over_speed: f64,
    pub(super) time: f64,
}

impl Motion {
    /// Tip speed right after impact [m/s]: the shocks in rod and target have one pressure,
    /// `ρ_p w (c_p + k_p w) = ρ_t u (c_t + k_t u)` with `w = V − u`.
    pub(super) fn tip_speed_at_impact(&self, speed: f64) -> f64 {
        let target = &self.target;
        let square = self.density * self.slope - target.density * target.slope;
        let linear = self.density * (self.sound_speed + 2.0 * self.slope * speed)
            + target.density * target.sound_speed;
        let constant = self.density * speed * (self.sound_speed + self.slope * speed);
        2.0 * constant / (linear + (linear * linear - 4.0 * square * constant).sqrt())
    }

    /// Length of the plastic zone in the rod [m]: `s = (R_c/2)(v/u − 1)(1 − 1/α²)`.
    pub(super) fn plastic_length(&self, tail: f64, tip: f64) -> f64 {
        let alpha = self.target.extent(tip).alpha;
        0.5 * self.crater_radius * (tail / tip - 1.0) * (1.0 - 1.0 / (alpha * alpha))
    }

    /// Rates of an eroding rod.
    ///
    /// Both equations of motion are linear in the accelerations of tail and tip once `ṡ` and `α̇` are written by the chain rule.
    fn eroding_rates(&self, &[tail, tip, length, _]: &State) -> State {
        let (radius, target) = (self.crater_radius, &self.target);
        let extent = target.extent(tip);
        let alpha = extent.alpha;
        let share = 1.0 - 1.0 / (alpha * alpha);
        let share_slope = 2.0 * extent.slope / alpha.powi(3);
        let plastic = 0.5 * radius * (tail / tip - 1.0) * share;
        let plastic_by_tail = 0.5 * radius * share / tip;
        let plastic_by_tip =
            0.5 * radius * ((tail / tip - 1.0) * share_slope - tail * share / (tip * tip));
        // (v − u)/s = 2u/(R_c share) depends on the tip's speed alone.
        let gradient_slope = 2.0 / radius * (1.0 / share - tip * share_slope / (share * share));
        let elastic = self.density * (length - plastic);
        let drag = self.strength / self.bar_speed;
        let tail_row = (
            elastic + drag * plastic_by_tail,
            drag * plastic_by_tip,
            -self.strength * (1.0 + (tail - tip) / self.bar_speed),
        );
        let carried = self.density * plastic * (1.0 + 0.5 * plastic * gradient_slope)
            + self.target_inertia(tip, alpha, extent.slope);
        let pressure = 0.5 * self.density * (tail - tip).powi(2)
            - 0.5 * target.density * tip * tip
            - target.resistance(alpha);
        let determinant = tail_row.0 * carried - tail_row.1 * elastic;
        [
            (tail_row.2 * carried - tail_row.1 * pressure) / determinant,
            (tail_row.0 * pressure - elastic * tail_row.2) / determinant,
            tip - tail,
            tip,
        ]
    }

    /// Mass of target per area that moves with the tip [kg/m2]; the growth of the plastic zone counts with it.
    fn target_inertia(&self, tip: f64, alpha: f64, alpha_slope: f64) -> f64 {
        let moved = (alpha - 1.0) / (alpha + 1.0) + alpha_slope * 2.0 * tip / (alpha + 1.0).powi(2);
        self.target.density * self.crater_radius * moved
    }

    /// Rates of a rigid rod of a length [m].
    fn rigid_rates(&self, length: f64, tip: f64) -> f64 {
        let extent = self.target.extent(tip);
        let mass = self.density * length + self.target_inertia(tip, extent.alpha, extent.slope);
        -(0.5 * self.target.density * tip * tip + self.target.resistance(extent.alpha)) / mass
    }

    /// Integrates from impact to the end of the erosion.
    pub(super) fn erode(
        &self,
        speed: f64,
        length: f64,
        watch: impl FnMut(f64, &State),
    ) -> Result<FinalState<4>, IntegrationError> {
        let event =
            |&[tail, tip, left, _]: &State| erosion_ends([tail, tip, left], (speed, length));
        Problem {
            rates: &|state| self.eroding_rates(state),
            event: &event,
            relative: TOLERANCE,
            absolute: [
                TOLERANCE * speed,
                TOLERANCE * speed,
                TOLERANCE * USED_UP * length,
                TOLERANCE * length,
            ],
            first_step: 1e-3 * self.crater_radius.min(length) / speed,
        }
        .solve([speed, self.tip_speed_at_impact(speed), length, 0.0], watch)
    }

    /// Integrates a rod of a length [m] from its impact at a speed [m/s] to its end.
    ///
    /// # Errors
    /// When an integration finds no end.
    pub(super) fn penetrate(&self, speed: f64, length: f64) -> Result<Stop, NumericalError> {
        let end = self.erode(speed, length, |_, _| ()).map_err(failure)?;
        let [_, tip, left, depth] = end.state;
        let mut stop = Stop {
            depth,
            rigid_depth: 0.0,
            length: if left > 2.0 * USED_UP * length {
                left
            } else {
                0.0
            },
            hand_over_speed: tip,
            time: end.time,
        };
        if tip > 2.0 * STOPPED * speed && stop.length > 0.0 {
            let rigid = Problem {
                rates: &|&[tip, _]: &[f64; 2]| {
                    let tip = tip.max(0.0);
                    [self.rigid_rates(left, tip), tip]
                },
                event: &|&[tip, _]| tip,
                relative: TOLERANCE,
                absolute: [TOLERANCE * speed, TOLERANCE * length],
                first_step: 1e-3 * left / speed,
            }
            .solve([tip, 0.0], |_, _| ())
            .map_err(failure)?;
            stop.rigid_depth = rigid.state[1];
            stop.depth += rigid.state[1];
            stop.time += rigid.time;
        }
        Ok(stop)
    }
}
