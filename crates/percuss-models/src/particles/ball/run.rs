//! A ball that meets a plane or another ball, as a solver.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use super::{
    law::{HertzLaw, Touch, energy_share},
    motion::{Ball, Facing, Push},
};
use crate::{
    Error, Scenario,
    error::NumericalError,
    history::{ElementState, Profile, Sample},
    ledger::{EnergyLedger, MomentumLedger},
    outcome::{Detail, Outcome, RunResult, Termination},
    particles::{self, AUDIT, results},
    solver::{
        Control, Particle,
        archive::Archive,
        frames::{Bonds, Fields, Points},
        gauge::Gauge,
        interface::{Audit, Extremes, Solver},
        limits::Limits,
        monitor::{Clock, Probe, RunMonitor},
    },
};

/// Points along the diameter of a ball in pictures.
const POINTS: u32 = 30;
/// Approach over the radius up to which a contact is small beside the ball, as Hertz's theory takes it.
const SMALL: f64 = 0.05;

/// A collision of two balls, or of a ball and a plane.
#[derive(Debug, Clone)]
pub(crate) struct Collision<'a> {
    scenario: &'a Scenario,
    law: HertzLaw,
    time_step: f64,
    state: State,
    pushes: [Push; 2],
    /// Kinetic energy, and momentum along the normal.
    initial: (f64, f64),
}

/// What a step changes.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct State {
    step: u64,
    time: f64,
    balls: [Ball; 2],
    touch: Touch,
    largest_approach: f64,
    /// Impulse along the normal on what is held [N s].
    support: f64,
}

impl Collision<'_> {
    fn facing(&self) -> Facing {
        let [first, second] = &self.state.balls;
        Facing::of(first, second)
    }

    fn projectile(&self) -> &Ball {
        &self.state.balls[0]
    }

    /// Whether the target moves.
    fn is_free(&self) -> bool {
        self.state.balls[1].inverse_mass > 0.0
    }

    /// Velocity of the projectile, negative away from the target [m/s].
    fn signed_speed(&self) -> f64 {
        results::signed_speed(self.projectile().velocity)
    }

    fn has_obliquity(&self) -> bool {
        self.scenario.obliquity != 0.0
    }
}

impl<'a> Solver<'a> for Collision<'a> {
    const NAMES: (&'static str, &'static str) = ("particles", "hertz");
    const AUDIT: Audit = AUDIT;

    fn build(scenario: &'a Scenario, courant: f64, _: &mut Control<'_>) -> Result<Self, Error> {
        let (time_step, _) = super::times(scenario, courant);
        let balls = super::balls(scenario);
        let none = Push::default();
        Ok(Self {
            scenario,
            law: super::law(scenario),
            time_step,
            initial: (balls[0].kinetic_energy(0.0, &none), balls[0].momentum()),
            state: State {
                step: 0,
                time: 0.0,
                balls,
                touch: Touch::default(),
                largest_approach: 0.0,
                support: 0.0,
            },
            pushes: [none; 2],
        })
    }

    fn size(&self) -> usize {
        1 + usize::from(self.is_free())
    }

    fn courant(scenario: &Scenario) -> (Option<f64>, f64) {
        particles::courant(scenario)
    }

    fn limits(&self) -> Limits {
        super::limits(self.scenario)
    }

    fn advance(&mut self) -> Result<(), NumericalError> {
        let step = self.time_step;
        for (ball, push) in self.state.balls.iter_mut().zip(&self.pushes) {
            ball.advance(step, push);
        }
        if !self.is_free() {
            self.state.support += step * self.pushes[1].force[1];
        }
        self.state.step += 1;
        self.state.time += step;
        let facing = self.facing();
        let State { balls, touch, .. } = &mut self.state;
        let speeds = facing.speeds(&balls[0], &balls[1]);
        touch.update(&self.law, facing.approach, speeds, step);
        self.pushes = facing.pushes(touch);
        self.state.largest_approach = self.state.largest_approach.max(facing.approach);
        Ok(())
    }

    fn clock(&self) -> Clock {
        Clock {
            step: self.state.step,
            time: self.state.time,
            time_step: self.time_step,
        }
    }

    fn probe(&mut self, _: &RunMonitor) -> Probe {
        let touch = &self.state.touch;
        Probe {
            depth: touch.approach,
            contact_force: touch.push,
            contact_time: if touch.push > 0.0 {
                self.time_step
            } else {
                0.0
            },
        }
    }

    fn is_at_rest(&self) -> bool {
        self.projectile().momentum() <= 0.0
    }

    fn energy(&self) -> EnergyLedger {
        let State { balls, touch, .. } = &self.state;
        let [first, second] =
            [0, 1].map(|i| balls[i].kinetic_energy(self.time_step, &self.pushes[i]));
        let elastic = touch.energy(&self.law);
        let share = energy_share(super::solids(self.scenario));
        let mut energy = EnergyLedger::default();
        energy.initial = self.initial.0;
        energy.kinetic_projectile = first;
        energy.kinetic_target = second;
        energy.elastic_projectile = share * elastic;
        energy.elastic_target = (1.0 - share) * elastic;
        energy.viscous = touch.damped;
        energy.contact = touch.rubbed;
        energy
    }

    fn momentum(&self) -> MomentumLedger {
        let [first, second] = &self.state.balls;
        let mut momentum = MomentumLedger::default();
        momentum.initial = self.initial.1;
        momentum.projectile = first.momentum();
        momentum.target = second.momentum();
        momentum.support = self.state.support;
        momentum
    }

    fn progress(&self) -> f64 {
        let lost = 1.0 - self.projectile().momentum() / self.initial.1;
        (0.5 * lost).clamp(0.0, 1.0)
    }

    fn event(&mut self, _: &RunMonitor) -> Result<Option<Termination>, NumericalError> {
        // They began as they touched.
        let apart = self.state.touch.approach < 0.0;
        Ok(apart.then_some(Termination::Parted))
    }

    fn sample(&self, monitor: &RunMonitor) -> Sample {
        let [first, second] = &self.state.balls;
        let mut sample = Sample::default();
        sample.time = self.state.time;
        sample.step = self.state.step;
        sample.mean_velocity = first.velocity[1];
        sample.tip_velocity = first.velocity[1];
        sample.tail_velocity = first.velocity[1];
        sample.interface_velocity = f64::NAN;
        sample.back_velocity = match self.is_free() {
            true => second.velocity[1],
            false => f64::NAN,
        };
        sample.depth = monitor.depth;
        sample.tip_position = first.centre[1] + first.radius;
        sample.projectile_length = 2.0 * first.radius;
        sample.contact_force = self.state.touch.push;
        if !self.is_free() {
            sample.back_force = self.pushes[1].force[1];
        }
        sample.energy = self.energy();
        sample.momentum = self.momentum();
        sample
    }

    fn gauges(&self, gauges: &[Gauge]) -> Vec<ElementState> {
        let balls = self.profile().elements;
        let at = |gauge: &Gauge| {
            let (part, start) = (usize::from(gauge.position >= 0.0), gauge.position);
            let Some(ball) = balls.get(part) else {
                return ElementState::gone(part, start);
            };
            ElementState {
                initial_position: start,
                position: ball.position + start - ball.initial_position,
                ..*ball
            }
        };
        gauges.iter().map(at).collect()
    }

    fn profile(&self) -> Profile {
        let starts = super::balls(self.scenario).map(|ball| ball.centre[1]);
        let balls = self.state.balls.iter().enumerate();
        let finite = balls.filter(|(_, ball)| ball.radius.is_finite());
        Profile {
            time: self.state.time,
            elements: finite
                .map(|(part, ball)| ElementState {
                    position: ball.centre[1],
                    displacement: ball.centre[1] - starts[part],
                    length: 2.0 * ball.radius,
                    diameter: 2.0 * ball.radius,
                    velocity: ball.velocity[1],
                    plastic_strain: 0.0,
                    ..ElementState::gone(part, starts[part])
                })
                .collect(),
        }
    }

    fn fields(&self) -> Fields<'_> {
        let balls = self.state.balls.iter();
        let finite = balls.filter(|ball| ball.radius.is_finite());
        Fields::Particles {
            cell: 2.0 * self.projectile().radius / f64::from(POINTS),
            bonds: Bonds::default(),
            bodies: finite
                .map(|ball| Points::Kept(Cow::Owned(points(ball))))
                .collect(),
            across: None,
        }
    }

    fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        archive.item(&mut self.state)?;
        self.pushes = self.facing().pushes(&self.state.touch);
        Ok(())
    }

    fn outcome(&self, termination: Termination, _: &RunMonitor) -> (Outcome, String) {
        let speeds = (self.signed_speed(), self.scenario.impact_velocity);
        (results::outcome_at(speeds, termination), String::new())
    }

    fn extremes(&self) -> Extremes {
        Extremes {
            elements: (1, usize::from(self.state.balls[1].radius.is_finite())),
            ..Extremes::default()
        }
    }

    fn complete(&self, result: &mut RunResult, _: &RunMonitor) {
        result.residual_velocity = Some(self.signed_speed());
        if self.has_obliquity() {
            let [x, z] = self.projectile().velocity;
            result.flight_direction = Some(x.atan2(z));
        }
        result.details = self.details();
        result.warnings = self.warnings(result.outcome);
    }
}

impl Collision<'_> {
    fn details(&self) -> Vec<Detail> {
        let [first, second] = &self.state.balls;
        let approach = self.state.largest_approach * 1e6;
        // Angular velocities are given as that of an oblique projectile of the lattice: positive from the depth to `x`.
        let mut details = vec![
            Detail::new("largest approach", "um", approach),
            Detail::new("angular velocity of the projectile", "rad/s", -first.spin),
        ];
        if self.is_free() {
            let [x, z] = second.velocity;
            details.extend([
                Detail::new("velocity of the target", "m/s", x.hypot(z)),
                Detail::new("angular velocity of the target", "rad/s", -second.spin),
            ]);
        }
        details
    }

    fn warnings(&self, outcome: Outcome) -> Vec<String> {
        let mut warnings = vec![
            "each ball is one elastic particle: its strength, its vibrations and its damage are not described".to_owned(),
        ];
        let radii = self.state.balls.iter().map(|ball| ball.radius);
        let part = self.state.largest_approach / radii.fold(f64::INFINITY, f64::min);
        if part > SMALL {
            warnings.push(format!(
                "the balls approach by {:.0} % of the smaller one's radius: Hertz's theory takes contacts that are small beside it; lower \
                 `projectile.impact_velocity`",
                100.0 * part
            ));
        }
        if outcome == Outcome::OutOfTime {
            warnings.push(
                "the run ended before the bodies parted: the residual velocity is that of the moment; raise `particles.end_time`"
                    .to_owned(),
            );
        }
        warnings
    }
}

/// Points that show a section of a ball.
fn points(ball: &Ball) -> Vec<Particle> {
    let size = 2.0 * ball.radius / f64::from(POINTS);
    let at = |index: u32| (f64::from(index) + 0.5) * size - ball.radius;
    let places = (0..POINTS * POINTS).map(|index| [at(index % POINTS), at(index / POINTS)]);
    let inside: Vec<[f64; 2]> = (places.filter(|[x, z]| x.hypot(*z) < ball.radius)).collect();
    let mass = match ball.inverse_mass > 0.0 {
        true => 1.0 / ball.inverse_mass,
        // That of a held one is not known: the points only show where it is.
        false => 1.0,
    };
    let share = mass / inside.len() as f64;
    let of = |[x, z]: [f64; 2]| Particle {
        position: [ball.centre[0] + x, ball.centre[1] + z],
        velocity: [
            ball.velocity[0] - ball.spin * z,
            ball.velocity[1] + ball.spin * x,
        ],
        mass: share,
        volume: size * size,
        sides: [size, size],
        ..Particle::default()
    };
    inside.into_iter().map(of).collect()
}
