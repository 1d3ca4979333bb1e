//! Motion of rod and crater floor, with the account of every joule.

use std::f64::consts::PI;

use super::{
    super::{
        impact_wave::ImpactWave,
        long_rod::{STOPPED, USED_UP, erosion_ends, failure},
        moving_mass::MovingMass,
        ode::{FinalState, Problem},
        rod_flow::RodFlow,
    },
    target::Target,
};
use crate::error::NumericalError;

/// Error of a step as a part of the quantity.
const TOLERANCE: f64 = 1e-12;

/// A rod, a target and the waves of their first contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Motion {
    pub(super) rod: RodFlow,
    pub(super) target: Target,
    pub(super) wave: ImpactWave,
    /// Factor on the mass of target that moves with the floor: 1, or 0 in a limit.
    pub(super) mass_factor: f64,
}

/// Where the kinetic energy of the rod has gone [J].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Shares {
    /// Dissipated where rod and target first meet.
    pub(super) shock: f64,
    /// Plastic work in the rod.
    pub(super) rod_plastic: f64,
    /// Kinetic energy of metal of the rod that has left the floor.
    pub(super) debris: f64,
    /// Work of pressing the floor into the target.
    pub(super) pressing: f64,
    /// Kinetic energy of target left behind the floor, which widens the crater.
    pub(super) flow: f64,
}

impl Shares {
    /// Sum of all [J].
    pub(super) fn total(&self) -> f64 {
        self.shock + self.rod_plastic + self.debris + self.pressing + self.flow
    }

    /// Energy that the target has taken [J].
    pub(super) fn target(&self) -> f64 {
        self.pressing + self.flow
    }
}

/// Where a rod ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stop {
    pub(super) depth: f64,
    /// Part of it after the rod has stopped to flow [m].
    pub(super) after_erosion: f64,
    /// Length that has not flowed [m].
    pub(super) length: f64,
    pub(super) time: f64,
    pub(super) shares: Shares,
    /// Area of the floor over the rod's right after impact.
    pub(super) spread: f64,
}

/// Tail speed, floor speed, length, depth; plastic work in the rod, energy of debris, pressing, flow left behind.
type State = [f64; 8];

impl Motion {
    /// Rates in a phase.
    fn rates(&self, state: &State, zone: MovingMass, phase: Phase) -> State {
        let &[tail, floor, length, depth, ..] = state;
        let (rod, target) = (&self.rod, &self.target);
        let arriving = match phase {
            Phase::Flowing | Phase::Flattening => (tail - floor).max(0.0),
            Phase::Joined => 0.0,
        };
        let turned = rod.turned(arriving);
        let (mass, growth) = zone.at(depth);
        let own = rod.density * rod.area * length;
        let area = match phase {
            // Rod and zone go on as one, each through an area of its own.
            Phase::Joined => (own * rod.area + mass * zone.area()) / (own + mass),
            _ => rod.area * turned.spread,
        };
        let resistance = target.resistance(depth, (area / PI).sqrt());
        let inertia = 0.5 * target.density * floor * floor;
        let against = area * (resistance + inertia);
        // What the growth of the mass takes: its kinetic energy is ½MU².
        let forming = 0.5 * growth * floor * floor;
        let (tail_rate, floor_rate) = match phase {
            Phase::Flowing => (
                -rod.strength / (rod.density * length),
                (rod.force(arriving, turned) - against - forming) / mass,
            ),
            Phase::Flattening => (-rod.strength / (rod.density * length), 0.0),
            Phase::Joined => {
                let rate = -(against + forming) / (mass + own);
                (rate, rate)
            }
        };
        let flux = rod.area * arriving;
        let debris = floor - turned.leaving * arriving;
        [
            tail_rate,
            floor_rate,
            -arriving,
            floor,
            flux * rod.plastic_work(turned),
            0.5 * rod.density * flux * debris * debris,
            area * resistance * floor,
            area * inertia * floor,
        ]
    }

    fn solve(
        &self,
        start: State,
        zone: MovingMass,
        phase: Phase,
        scale: (f64, f64),
    ) -> Result<FinalState<8>, NumericalError> {
        let (speed, length) = scale;
        let energy = 0.5 * self.rod.density * self.rod.area * length * speed * speed;
        let event = |&[tail, floor, left, ..]: &State| match phase {
            Phase::Flowing => erosion_ends([tail, floor, left], (speed, length)),
            Phase::Flattening => (tail / speed - STOPPED).min(left / length - USED_UP),
            Phase::Joined => floor,
        };
        let [v, l, e] = [speed, length, energy].map(|scale| TOLERANCE * scale);
        Problem {
            rates: &|state| self.rates(state, zone, phase),
            event: &event,
            relative: TOLERANCE,
            absolute: [v, v, USED_UP * l, l, e, e, e, e],
            first_step: 1e-4 * length / speed,
        }
        .solve(start, |_, _| ())
        .map_err(failure)
    }

    /// The first contact. Plane waves run until the release from the edge reaches the axis: a slice of the rod of the length of
    /// its radius and the target that the wave has reached move at one speed, inelastically. Both stay with the floor.
    fn first_contact(&self, speed: f64, length: f64) -> Contact {
        let (rod, target) = (&self.rod, &self.target);
        let line = rod.density * rod.area;
        let own_radius = (rod.area / PI).sqrt();
        let rigid = target.deep() + 0.5 * target.density * speed * speed < rod.strength;
        let plane = speed * self.wave.share;
        let spread = match rigid {
            true => 1.0,
            false => rod.turned(speed - plane).spread,
        };
        let radius = own_radius * spread.sqrt();
        let least = f64::EPSILON.sqrt() * line * length;
        let struck = match rigid {
            true => target.moving_mass(own_radius),
            false => target.density * rod.area * own_radius * self.wave.ratio,
        };
        let struck = (self.mass_factor * struck).max(least);
        let full = (self.mass_factor * target.moving_mass(radius)).max(struck);
        // The momentum of both waves is the same: it is the slice of length a.
        let slice = struck * plane / (line * (speed - plane));
        let (slice, joined) = match (rigid, slice < length) {
            (true, _) => (0.0, line * length),
            (false, true) => (slice, line * slice),
            (false, false) => (length, line * length),
        };
        let floor = joined * speed / (joined + struck);
        let shares = Shares {
            shock: 0.5 * joined * speed * speed - 0.5 * (joined + struck) * floor * floor,
            ..Shares::default()
        };
        let carried = line * slice;
        let time = slice / self.wave.speed;
        Contact {
            zone: MovingMass {
                first: struck + carried,
                full: full + carried,
                radius,
                from: floor * time,
            },
            rigid,
            floor,
            length: length - slice,
            depth: floor * time,
            time,
            spread,
            shares,
        }
    }

    /// Follows a rod of a length [m] from its impact at a speed [m/s] to rest.
    ///
    /// # Errors
    /// When an integration finds no end.
    pub(super) fn penetrate(&self, speed: f64, length: f64) -> Result<Stop, NumericalError> {
        let contact = self.first_contact(speed, length);
        let tail = if contact.rigid { contact.floor } else { speed };
        let mut state = [
            tail,
            contact.floor,
            contact.length,
            contact.depth,
            0.0,
            0.0,
            0.0,
            0.0,
        ];
        let mut time = contact.time;
        let mut run = |state: &mut State, phase| -> Result<(), NumericalError> {
            let end = self.solve(*state, contact.zone, phase, (speed, length))?;
            *state = end.state;
            time += end.time;
            Ok(())
        };
        if !contact.rigid && contact.length > USED_UP * length {
            run(&mut state, Phase::Flowing)?;
        }
        let before = state[3];
        let mut left;
        if state[2] <= 2.0 * USED_UP * length {
            // What is left of the rod goes with the debris.
            left = self.kinetic(state[2], state[0]);
            state[2] = 0.0;
            state[0] = state[1];
            run(&mut state, Phase::Joined)?;
        } else if state[1] <= 2.0 * STOPPED * speed {
            left = 0.5 * contact.zone.at(state[3]).0 * state[1] * state[1];
            state[1] = 0.0;
            run(&mut state, Phase::Flattening)?;
            left += self.kinetic(state[2], state[0]);
        } else {
            // Tail and floor meet: one speed for both, and the momentum of both.
            let own = self.rod.density * self.rod.area * state[2];
            let mass = contact.zone.at(state[3]).0;
            let common = (own * state[0] + mass * state[1]) / (own + mass);
            let lost = self.kinetic(state[2], state[0]) + 0.5 * mass * state[1] * state[1]
                - 0.5 * (own + mass) * common * common;
            left = lost;
            (state[0], state[1]) = (common, common);
            run(&mut state, Phase::Joined)?;
        }
        let first = contact.shares;
        Ok(Stop {
            depth: state[3],
            after_erosion: state[3] - before,
            length: state[2],
            time,
            shares: Shares {
                shock: first.shock,
                rod_plastic: state[4],
                debris: state[5] + left,
                pressing: state[6],
                flow: state[7],
            },
            spread: contact.spread,
        })
    }

    /// Kinetic energy of a length of rod [J].
    fn kinetic(&self, length: f64, speed: f64) -> f64 {
        0.5 * self.rod.density * self.rod.area * length * speed * speed
    }
}

/// What rod and floor do.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Phase {
    /// The rod flows and the floor moves.
    Flowing,
    /// The rod flows on a floor at rest.
    Flattening,
    /// What is left of the rod and the floor move as one.
    Joined,
}

/// State right after the first contact.
struct Contact {
    zone: MovingMass,
    rigid: bool,
    floor: f64,
    length: f64,
    /// Depth [m] and time [s] of the plane waves.
    depth: f64,
    time: f64,
    spread: f64,
    shares: Shares,
}
