//! Momentum on the axis of rod and target: a rod that erodes, a rigid one, and the target's own flow after it.

use super::{
    super::{
        long_rod::failure,
        ode::{FinalState, Problem},
        rod_flow::RodFlow,
    },
    zone::Zone,
};
use crate::error::NumericalError;

/// Error of a step as a part of the quantity.
const TOLERANCE: f64 = 1e-9;
/// Part of the impact velocity at which a speed counts as zero.
const STOPPED: f64 = 1e-7;
/// Part of the length at which a rod counts as used up.
const USED_UP: f64 = 1e-7;
/// Depth in radii of the floor at which the flow starts: the zone grows from nothing.
const FIRST_DEPTH: f64 = 1e-4;
const BISECTIONS: u32 = 80;

/// A rod and the zone ahead of it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Motion {
    pub(super) rod: RodFlow,
    pub(super) zone: Zone,
    /// Radius of the floor [m].
    pub(super) radius: f64,
}

/// Tail speed, floor speed, length, depth, and the momentum on the axis that has left it [m/s, m/s, m, m, Pa s].
pub(super) type State = [f64; 5];

/// Where a rod ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stop {
    pub(super) depth: f64,
    /// Part of the depth after the erosion [m].
    pub(super) after_erosion: f64,
    pub(super) length: f64,
    pub(super) first_speed: f64,
    pub(super) time: f64,
    /// Momentum on the axis that no term accounts for, over that at the start.
    pub(super) balance_error: f64,
}

/// What rod and floor do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Phase {
    Flowing,
    Rigid,
    After,
}

impl Motion {
    /// Part of the zone that a depth [m] has formed, and its slope [1/m]: that of the floor's area in contact, `1 − (1 − P/b)²`.
    fn formed(&self, depth: f64) -> (f64, f64) {
        let rest = (1.0 - depth / self.radius).max(0.0);
        (1.0 - rest * rest, 2.0 * rest / self.radius)
    }

    /// Mass of target per area that moves with the floor once the zone has formed [kg/m2].
    fn full_mass(&self) -> f64 {
        self.zone.density * self.radius * Zone::moving_length(self.zone.extent(0.0))
    }

    /// Mass of target per area that moves with the floor at a depth [m] [kg/m2].
    pub(super) fn moving_mass(&self, depth: f64) -> f64 {
        self.full_mass() * self.formed(depth).0
    }

    /// Pressure of the target at the middle of a floor in steady flow [Pa].
    pub(super) fn against(&self, floor: f64) -> f64 {
        self.zone.resistance(self.zone.extent(floor)) + 0.5 * self.zone.density * floor * floor
    }

    /// Speed of the floor right after impact [m/s]: the target's pressure, with that of the zone which forms, is that of the rod.
    /// Zero where the rod does not penetrate, and the impact velocity where it stays rigid.
    pub(super) fn first_speed(&self, speed: f64) -> f64 {
        let excess = |floor: f64| {
            let forming = self.full_mass() * self.formed(0.0).1 * floor * floor;
            self.rod.strength + 0.5 * self.rod.density * (speed - floor).powi(2)
                - self.against(floor)
                - forming
        };
        if self.rod.strength > self.against(speed) {
            return speed;
        }
        if excess(0.0) <= 0.0 {
            return 0.0;
        }
        let (mut low, mut high) = (0.0, speed);
        for _ in 0..BISECTIONS {
            let middle = f64::midpoint(low, high);
            if excess(middle) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        f64::midpoint(low, high)
    }

    fn rates(&self, &[tail, floor, length, depth, _]: &State, phase: Phase) -> State {
        let rod = &self.rod;
        let speed = floor.max(0.0);
        let (formed, formed_slope) = self.formed(depth);
        let mass = self.full_mass() * formed;
        let forming = self.full_mass() * formed_slope * speed * speed;
        let against = self.against(speed);
        let own = rod.density * length;
        match phase {
            Phase::Flowing => {
                let arriving = (tail - floor).max(0.0);
                let behind = rod.strength + 0.5 * rod.density * arriving * arriving;
                let leaving = 0.5 * rod.density * arriving * (tail + floor);
                [
                    -rod.strength / own,
                    (behind - against - forming) / mass,
                    -arriving,
                    floor,
                    leaving + against,
                ]
            }
            Phase::Rigid => {
                let rate = -(against + forming) / (own + mass);
                [rate, rate, 0.0, floor, against]
            }
            Phase::After => [0.0, -(against + forming) / mass, 0.0, floor, against],
        }
    }

    fn solve(
        &self,
        start: State,
        phase: Phase,
        (speed, length): (f64, f64),
    ) -> Result<FinalState<5>, NumericalError> {
        let event = |&[tail, floor, left, ..]: &State| match phase {
            Phase::Flowing => ((tail - floor) / speed - STOPPED)
                .min(floor / speed - STOPPED)
                .min(left / length - USED_UP),
            Phase::Rigid | Phase::After => floor / speed,
        };
        let momentum = self.rod.density * length * speed;
        Problem {
            rates: &|state| self.rates(state, phase),
            event: &event,
            relative: TOLERANCE,
            absolute: [
                TOLERANCE * speed,
                TOLERANCE * speed,
                TOLERANCE * USED_UP * length,
                TOLERANCE * length,
                TOLERANCE * momentum,
            ],
            first_step: 0.01 * FIRST_DEPTH * self.radius / speed,
        }
        .solve(start, |_, _| ())
        .map_err(failure)
    }

    /// Momentum per area on the axis [Pa s].
    fn momentum(&self, &[tail, floor, length, depth, _]: &State) -> f64 {
        self.rod.density * length * tail + self.moving_mass(depth) * floor
    }

    /// Follows a rod of a length [m] from its impact at a speed [m/s] to rest.
    ///
    /// # Errors
    /// When an integration finds no end.
    pub(super) fn penetrate(&self, speed: f64, length: f64) -> Result<Stop, NumericalError> {
        let first_speed = self.first_speed(speed);
        let mut state = [speed, first_speed, length, FIRST_DEPTH * self.radius, 0.0];
        let mut stop = Stop {
            depth: 0.0,
            after_erosion: 0.0,
            length,
            first_speed,
            time: 0.0,
            balance_error: 0.0,
        };
        let (density, strength) = (self.rod.density, self.rod.strength);
        let flattened =
            |left: f64, tail: f64| left * (-0.5 * density * tail * tail / strength).exp();
        if first_speed <= STOPPED * speed {
            stop.length = flattened(length, speed);
            return Ok(stop);
        }
        let start = self.momentum(&state);
        if first_speed < speed {
            let end = self.solve(state, Phase::Flowing, (speed, length))?;
            state = end.state;
            stop.time = end.time;
        }
        let before = state[3];
        if state[2] <= 2.0 * USED_UP * length {
            let end = self.solve(state, Phase::After, (speed, length))?;
            (state, stop.time, stop.length) = (end.state, stop.time + end.time, 0.0);
        } else if state[1] <= 2.0 * STOPPED * speed {
            stop.length = flattened(state[2], state[0]);
        } else {
            let end = self.solve(state, Phase::Rigid, (speed, length))?;
            (state, stop.time, stop.length) = (end.state, stop.time + end.time, state[2]);
        }
        stop.depth = state[3];
        stop.after_erosion = state[3] - before;
        stop.balance_error = (self.momentum(&state) + state[4] - start) / start;
        Ok(stop)
    }
}
