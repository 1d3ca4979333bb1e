//! Momentum on the axis of rod and target: a rod that erodes, a rigid one, and the target's own flow after it.

use super::{
    super::{
        impact_wave::ImpactWave,
        long_rod::{STOPPED, USED_UP, erosion_ends, failure, flattened},
        moving_mass::MovingMass,
        ode::{FinalState, Problem},
        rod_flow::RodFlow,
    },
    zone::Zone,
};
use crate::{bisection::bisected, error::NumericalError};

/// Error of a step as a part of the quantity.
const TOLERANCE: f64 = 1e-9;
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
    pub(super) wave: ImpactWave,
    /// Length of the slice of the rod that plane waves stop at first [m]: its radius, or 0 in a limit.
    pub(super) slice: f64,
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
    /// Mass of target per area that moves with the floor once the zone has formed [kg/m2].
    pub(super) fn full_mass(&self) -> f64 {
        self.zone.density * self.radius * Zone::moving_length(self.zone.extent(0.0))
    }

    /// Pressure of the target at the middle of a floor in steady flow [Pa].
    pub(super) fn against(&self, floor: f64) -> f64 {
        self.zone.resistance(self.zone.extent(floor)) + 0.5 * self.zone.density * floor * floor
    }

    /// Speed of the floor in a zone that forms from nothing [m/s]: the target's pressure, with that of the zone which forms, is that of the rod.
    /// Zero where the rod does not penetrate, and the impact velocity where it stays rigid.
    pub(super) fn first_speed(&self, speed: f64) -> f64 {
        let excess = |floor: f64| {
            let forming = 2.0 * self.full_mass() / self.radius * floor * floor;
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
        bisected(0.0, speed, BISECTIONS, |floor| excess(floor) > 0.0)
    }

    fn rates(
        &self,
        &[tail, floor, length, depth, _]: &State,
        moving: MovingMass,
        phase: Phase,
    ) -> State {
        let rod = &self.rod;
        let speed = floor.max(0.0);
        let (mass, growth) = moving.at(depth);
        let forming = growth * speed * speed;
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
        moving: MovingMass,
        phase: Phase,
        (speed, length): (f64, f64),
    ) -> Result<FinalState<5>, NumericalError> {
        let event = |&[tail, floor, left, ..]: &State| match phase {
            Phase::Flowing => erosion_ends([tail, floor, left], (speed, length)),
            Phase::Rigid | Phase::After => floor / speed,
        };
        let momentum = self.rod.density * length * speed;
        Problem {
            rates: &|state| self.rates(state, moving, phase),
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
    fn momentum(&self, moving: MovingMass, &[tail, floor, length, depth, _]: &State) -> f64 {
        self.rod.density * length * tail + moving.at(depth).0 * floor
    }

    /// State and moving mass after the first contact: a slice of a rod that flows and the target that the wave has reached move at one
    /// speed, with the momentum of the rod. A rigid rod meets a zone that forms from nothing.
    fn first_contact(&self, speed: f64, length: f64) -> (State, MovingMass, f64) {
        let slice = self.slice.min(length);
        let full = self.full_mass();
        if slice <= 0.0 || self.rod.strength > self.against(speed) {
            let from = FIRST_DEPTH * self.radius;
            let moving = MovingMass {
                radius: self.radius,
                first: 0.0,
                full,
                from: 0.0,
            };
            return (
                [speed, self.first_speed(speed), length, from, 0.0],
                moving,
                0.0,
            );
        }
        let struck = self.zone.density * self.wave.ratio * slice;
        let carried = self.rod.density * slice;
        let floor = speed * self.wave.share;
        let time = slice / self.wave.speed;
        let moving = MovingMass {
            radius: self.radius,
            first: struck + carried,
            full: struck.max(full) + carried,
            from: floor * time,
        };
        (
            [speed, floor, length - slice, floor * time, 0.0],
            moving,
            time,
        )
    }

    /// Follows a rod of a length [m] from its impact at a speed [m/s] to rest.
    ///
    /// # Errors
    /// When an integration finds no end.
    pub(super) fn penetrate(&self, speed: f64, length: f64) -> Result<Stop, NumericalError> {
        let (mut state, moving, time) = self.first_contact(speed, length);
        // Moves with the floor, and is still part of the rod.
        let head = length - state[2];
        let first_speed = state[1];
        let mut stop = Stop {
            depth: 0.0,
            after_erosion: 0.0,
            length,
            first_speed,
            time,
            balance_error: 0.0,
        };
        let (density, strength) = (self.rod.density, self.rod.strength);
        if first_speed <= STOPPED * speed {
            stop.length = flattened(length, speed, density, strength);
            return Ok(stop);
        }
        let start = self.momentum(moving, &state);
        if first_speed < speed && state[2] > USED_UP * length {
            let end = self.solve(state, moving, Phase::Flowing, (speed, length))?;
            state = end.state;
            stop.time += end.time;
        }
        let before = state[3];
        if state[2] <= 2.0 * USED_UP * length {
            let end = self.solve(state, moving, Phase::After, (speed, length))?;
            (state, stop.time, stop.length) = (end.state, stop.time + end.time, 0.0);
        } else if state[1] <= 2.0 * STOPPED * speed {
            stop.length = head + flattened(state[2], state[0], density, strength);
        } else {
            let end = self.solve(state, moving, Phase::Rigid, (speed, length))?;
            (state, stop.time, stop.length) = (end.state, stop.time + end.time, head + state[2]);
        }
        stop.depth = state[3];
        stop.after_erosion = state[3] - before;
        stop.balance_error = (self.momentum(moving, &state) + state[4] - start) / start;
        Ok(stop)
    }
}
