//! Perforation in time: projectile, plug and dish, by steps of least power.

use super::{
    bulge::Bulge,
    fields::{Dish, HoleStress, Rim},
    flow::Flow,
    forces::Forces,
    links::{BODIES, Body, Row, Step, potential, step},
};
use crate::{minimum::least, problem::Nose};

/// A rigid projectile against one plate.
#[derive(Debug)]
pub(super) struct Impact {
    /// Mass of the projectile [kg].
    pub mass: f64,
    /// Diameter of its shank [m].
    pub diameter: f64,
    /// Nose.
    pub nose: Nose,
    /// Thickness of the plate [m].
    pub thickness: f64,
    /// Density of the plate [kg/m3].
    pub density: f64,
    /// Flow stress of the plate.
    pub flow: Flow,
    /// Stress around a growing hole.
    pub hole_stress: HoleStress,
    /// Pressure of a spherical and a cylindrical cavity in the plate's metal [Pa].
    pub cavity_pressures: [f64; 2],
    /// Force that the elastic plate opposes to a velocity of its middle [N s/m]: `8 √(ρ h D)`.
    pub impedance: f64,
    /// Whether the flat face sinks into the plate.
    pub indentation: bool,
    /// Whether the plate around the rim dishes.
    pub bulging: bool,
}

/// One moment.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct MotionState {
    /// Time [s].
    pub time: f64,
    /// How far the nose has sunk into the plate or plug [m].
    pub sunk: f64,
    /// How far the plug has slipped along its rim [m].
    pub slip: f64,
    /// Deflection of the plate at the rim [m].
    pub deflection: f64,
    /// Elastic deflection [m].
    pub flexure: f64,
    /// Its rate [m/s].
    pub flexing: f64,
    /// Whether all bodies move as one with the elastic plate.
    pub held: bool,
    /// Radius b out to which the plate moves [m].
    pub edge: f64,
    /// Velocities of projectile, plug and rim of the plate [m/s].
    pub velocities: [f64; BODIES],
    /// Force on the projectile [N].
    pub force: f64,
    /// Band at the rim of the plug.
    pub rim: Rim,
    /// Radius of the metal that moves around the hole of a pointed or round nose, over that of the hole.
    pub extent: Option<f64>,
    /// Plastic work of the local field [J].
    pub local_work: f64,
    /// Kinetic energy of the metal that the nose pushed aside [J].
    pub displaced: f64,
    /// Momentum of the metal that left the plug [N s].
    pub displaced_momentum: f64,
    /// Plastic work at the rim of the plug [J].
    pub rim_work: f64,
    /// Plastic work of the dish [J].
    pub dish_work: f64,
    /// Energy of the elastic waves in the plate [J].
    pub wave_work: f64,
    /// Kinetic energy lost where bodies became one, and to changes of the dish's field [J].
    pub capture: f64,
    /// Impulse that the plate at rest took [N s].
    pub impulse: f64,
}

/// A whole case.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Perforation {
    /// Last moment.
    pub last: MotionState,
    /// Whether the projectile went through.
    pub perforated: bool,
    /// Largest force on the projectile [N].
    pub peak_force: f64,
    /// Times at which the plate began to dish and the plug to slip [s].
    pub stages: [Option<f64>; 2],
    /// All moments, where they were asked for.
    pub moments: Vec<MotionState>,
    /// Plastic deflection of the plate, unless the end alone was asked for.
    pub bulge: Bulge,
}

/// What is kept of a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Keep {
    /// Its end.
    End,
    /// Its end, and the shape of the plate.
    Shape,
    /// All moments, and the shape of the plate.
    Moments,
}

/// Steps over the time that the plate's thickness takes at the impact velocity.
const STEPS: f64 = 250.0;
/// First step over the others: what is at rest is set in motion at once, and the work of that step is not exact.
const START: f64 = 1e-4;
/// Growth of the first steps with time.
const GROWTH: f64 = 0.2;
/// Part of the impact velocity below which the time step no longer grows.
const SLOW: f64 = 0.03;
/// Step over the time m/Z in which an elastic plate stops what moves as one with it.
const DECAY: f64 = 0.004;
/// Bound on the number of steps; every run ends before it.
const MOST_STEPS: u32 = 200_000;
/// Radius of the dish over that of the rim, less 1: where it is looked for.
const EDGES: (f64, f64) = (0.02, 50.0);
/// Part by which the logarithm of that number may change in a step.
const EDGE_CHANGE: f64 = 0.3;

/// Bracket of the ballistic limit, over the limit.
const LIMIT_TOLERANCE: f64 = 1e-6;
/// Part of the bracket by which a speed lies beside the root of the line.
const ASIDE: f64 = 0.02;

impl Impact {
    pub fn radius(&self) -> f64 {
        self.diameter / 2.0
    }

    pub fn area(&self) -> f64 {
        std::f64::consts::PI * self.radius().powi(2)
    }

    pub fn flat(&self) -> bool {
        self.nose == Nose::Flat
    }

    /// How far a nose sinks until it is through [m].
    pub fn passage(&self) -> f64 {
        self.thickness + self.nose.length(self.diameter)
    }

    /// Mass of the plug [kg]: the plate in line with a flat face, less what the face has pushed aside.
    pub fn plug_mass(&self, now: &MotionState) -> f64 {
        if !self.flat() {
            return 0.0;
        }
        let left = (self.thickness - now.sunk).max(1e-6 * self.thickness);
        self.density * self.area() * left
    }

    pub fn dish(&self) -> Dish {
        let disc = self.density * self.area() * self.thickness;
        Dish {
            rim: self.radius(),
            thickness: self.thickness,
            density: self.density,
            inner_mass: if self.flat() { 0.0 } else { disc },
        }
    }

    /// Kinetic energy of everything that moves [J].
    pub fn kinetic_energy(&self, now: &MotionState) -> [f64; 3] {
        let [projectile, plug, dish] = now.velocities;
        let dish_mass = if self.bulging {
            self.dish().mass(now.edge)
        } else {
            0.0
        };
        [
            0.5 * self.mass * projectile * projectile,
            0.5 * self.plug_mass(now) * plug * plug,
            0.5 * dish_mass * dish * dish,
        ]
    }

    /// The case at an impact velocity above zero [m/s].
    pub fn case(&self, speed: f64, keep: Keep) -> Perforation {
        let mut now = MotionState {
            velocities: [speed, 0.0, 0.0],
            edge: 2.0 * self.radius(),
            ..MotionState::default()
        };
        let mut run = Perforation {
            last: now,
            perforated: false,
            peak_force: 0.0,
            stages: [None; 2],
            moments: Vec::new(),
            bulge: match self.bulging && keep != Keep::End {
                true => Bulge::new(self.radius()),
                false => Bulge::default(),
            },
        };
        for _ in 0..MOST_STEPS {
            let before = now.deflection;
            now = self.advance(&now, speed);
            run.bulge.add(now.edge, now.deflection - before);
            run.peak_force = run.peak_force.max(now.force);
            self.note_stages(&mut run.stages, &now);
            if keep == Keep::Moments {
                run.moments.push(now);
            }
            run.perforated = now.sunk + now.slip >= self.passage();
            if run.perforated || now.velocities.iter().all(|&v| v.abs() <= 1e-9 * speed) {
                break;
            }
        }
        run.last = now;
        if run.perforated && self.bulging && keep != Keep::End {
            self.settle(&now, &mut run.bulge);
        }
        run
    }

    /// Lets the plate that a projectile has left move on until it no longer yields: its dish alone, in the same fields.
    pub fn settle(&self, exit: &MotionState, bulge: &mut Bulge) -> MotionState {
        let dish = self.dish();
        let momentum = dish.mass(exit.edge) * exit.velocities[2];
        let mut now = *exit;
        for _ in 0..MOST_STEPS {
            if self.dishing(&now) <= 0.0 {
                break;
            }
            let stress = self.dish_stress(&now);
            let resistance = dish.resistance(now.edge, now.deflection, stress);
            let duration = momentum / (resistance * STEPS);
            let edge = self.best_edge(&now, duration, |edge| {
                let alone = self.dish_body(&now, edge, stress, duration);
                ([alone, Body::default(), Body::default()], 1)
            });
            let body = self.dish_body(&now, edge, stress, duration);
            let mobility = self.mobility(&now, duration);
            let taken = step(Row {
                bodies: &[body],
                mobility,
            });
            let (velocity, impulse) = (taken.velocities[0], taken.impulses[0]);
            let elastic = mobility * impulse;
            let plastic = 0.5 * (body.velocity + velocity) - elastic;
            if impulse < body.largest * (1.0 - 1e-12) || plastic <= 0.0 {
                break;
            }
            let before = dish.mass(now.edge) * now.velocities[2].powi(2);
            now.capture += 0.5 * (before - body.mass * body.velocity.powi(2));
            now.dish_work += impulse * plastic;
            now.wave_work += impulse * elastic;
            now.deflection += duration * plastic;
            now.flexure += duration * elastic;
            now.flexing = elastic;
            now.velocities[2] = velocity;
            now.edge = edge;
            now.time += duration;
            bulge.add(edge, duration * plastic);
        }
        now
    }

    fn note_stages(&self, stages: &mut [Option<f64>; 2], now: &MotionState) {
        let began = [
            now.deflection > 1e-6 * self.thickness,
            now.slip > 1e-6 * self.thickness,
        ];
        for (stage, began) in stages.iter_mut().zip(began) {
            if began {
                stage.get_or_insert(now.time);
            }
        }
    }

    /// The state a time step later.
    fn advance(&self, now: &MotionState, speed: f64) -> MotionState {
        let fastest = now.velocities[0].abs().max(SLOW * speed);
        let mut longest = self.thickness / (STEPS * fastest);
        if self.bulging && now.held {
            longest = longest.max(DECAY * self.mass / self.impedance);
        }
        let duration = (START * longest + GROWTH * now.time).min(longest);
        let mut next = *now;
        let forces = self.forces(now, duration, &mut next);
        let stress = self.dish_stress(now);
        if self.bulging && !now.held && self.bulges(now, &forces) {
            next.edge = self.best_edge(now, duration, |edge| {
                let bodies = self.bodies(now, &forces, edge, stress, duration);
                (bodies, self.count())
            });
        }
        let bodies = self.bodies(now, &forces, next.edge, stress, duration);
        let count = self.count();
        let taken = step(Row {
            bodies: &bodies[..count],
            mobility: self.mobility(now, duration),
        });
        self.account(now, &mut next, &forces, &bodies, &taken, duration);
        next
    }

    /// Velocity of the elastic plate over the impulse of a step [1/kg]. Linear bending ends at a deflection of one thickness: beyond it, and
    /// where it does not bend at all, the plate is rigid.
    fn mobility(&self, now: &MotionState, duration: f64) -> f64 {
        match self.bulging && now.flexure.abs() < self.thickness {
            true => 1.0 / (self.impedance * duration),
            false => 0.0,
        }
    }

    /// Number of bodies that can move.
    fn count(&self) -> usize {
        1 + usize::from(self.flat()) + usize::from(self.bulging)
    }

    /// Plastic part of the velocity of the dish [m/s].
    fn dishing(&self, now: &MotionState) -> f64 {
        let plastic = now.velocities[2] - now.flexing;
        // Rounding.
        if plastic.abs() > 1e-9 * now.velocities[2].abs() {
            plastic
        } else {
            0.0
        }
    }

    /// Flow stress of the dish before a step [Pa].
    fn dish_stress(&self, now: &MotionState) -> f64 {
        if !self.bulging {
            return 0.0;
        }
        let dish = self.dish();
        let (strain, rate) = dish.strain(now.edge, now.deflection, self.dishing(now));
        self.flow.stress(strain, rate)
    }

    /// Bodies in a row at the velocities before a step; the dish has the momentum of its old field in its new one.
    fn bodies(
        &self,
        now: &MotionState,
        forces: &Forces,
        edge: f64,
        dish_stress: f64,
        duration: f64,
    ) -> [Body; BODIES] {
        let local = (forces.local + forces.inertial) * duration;
        let rim = forces.rim * duration;
        let mut bodies = [Body::default(); BODIES];
        bodies[0] = Body {
            mass: self.mass,
            velocity: now.velocities[0],
            largest: local,
            least: 0.0,
        };
        let mut count = 1;
        if self.flat() {
            bodies[1] = Body {
                mass: self.plug_mass(now),
                velocity: now.velocities[1],
                largest: rim,
                least: -rim,
            };
            count = 2;
        }
        if self.bulging {
            bodies[count] = self.dish_body(now, edge, dish_stress, duration);
        }
        bodies
    }

    /// The dish with an edge, with the momentum of its old field.
    fn dish_body(&self, now: &MotionState, edge: f64, stress: f64, duration: f64) -> Body {
        let dish = self.dish();
        let mass = dish.mass(edge);
        let deflection = now.deflection + 0.5 * duration * self.dishing(now);
        let resistance = dish.resistance(edge, deflection, stress) * duration;
        Body {
            mass,
            velocity: now.velocities[2] * dish.common(now.edge, edge) / mass,
            largest: resistance,
            least: -resistance,
        }
    }

    /// Whether the plate around the projectile moves, or is pushed harder than its least resistance.
    fn bulges(&self, now: &MotionState, forces: &Forces) -> bool {
        let push = match self.flat() {
            true => forces.rim,
            false => forces.local + forces.inertial,
        };
        let dish = self.dish();
        let widest = dish.rim * (1.0 + EDGES.1);
        let least = dish.resistance(widest, now.deflection, self.flow.stress(0.0, 0.0));
        self.dishing(now) > 0.0 || push > least
    }

    /// The radius of the dish at which the step of some bodies needs the least power, kinetic and plastic; the dish is the last of them.
    fn best_edge(
        &self,
        now: &MotionState,
        duration: f64,
        bodies_of: impl Fn(f64) -> ([Body; BODIES], usize),
    ) -> f64 {
        let dish = self.dish();
        let mobility = self.mobility(now, duration);
        let before = 0.5 * dish.mass(now.edge) * now.velocities[2].powi(2);
        let needed = |log: f64| {
            let edge = dish.rim * (1.0 + log.exp());
            let (bodies, count) = bodies_of(edge);
            let row = Row {
                bodies: &bodies[..count],
                mobility,
            };
            let taken = step(row);
            let last = bodies[row.bodies.len() - 1];
            before - 0.5 * last.mass * last.velocity.powi(2) + potential(row, &taken)
        };
        let (mut low, mut high) = (EDGES.0.ln(), EDGES.1.ln());
        let last = (now.edge / dish.rim - 1.0).ln();
        if self.dishing(now) > 0.0 {
            (low, high) = (
                (last - EDGE_CHANGE).max(low),
                (last + EDGE_CHANGE).min(high),
            );
        }
        let log = least(low, high, 14, needed);
        dish.rim * (1.0 + log.exp())
    }

    /// Moves everything on and gives all work its line.
    fn account(
        &self,
        now: &MotionState,
        next: &mut MotionState,
        forces: &Forces,
        bodies: &[Body; BODIES],
        taken: &Step,
        duration: f64,
    ) {
        let count = self.count();
        let mean = |i: usize| match i < count {
            true => 0.5 * (bodies[i].velocity + taken.velocities[i]),
            false => 0.0,
        };
        next.time = now.time + duration;
        next.force = taken.impulses[0] / duration;
        let sinking = mean(0) - mean(1);
        next.sunk = (now.sunk + duration * sinking).max(now.sunk);
        let work = taken.impulses[0] * sinking;
        if forces.local.is_finite() {
            let part = forces.inertial / (forces.local + forces.inertial).max(f64::MIN_POSITIVE);
            next.displaced += part * work;
            next.local_work += (1.0 - part) * work;
        } else {
            next.capture += work;
        }
        let mut last = 1;
        next.velocities = [taken.velocities[0], 0.0, 0.0];
        if self.flat() {
            let slipping = mean(1) - mean(2);
            next.slip = now.slip + duration * slipping;
            next.rim_work += taken.impulses[1] * slipping;
            next.velocities[1] = taken.velocities[1];
            let lost = bodies[1].mass - self.plug_mass(next);
            next.displaced += 0.5 * lost * taken.velocities[1].powi(2);
            next.displaced_momentum += lost * taken.velocities[1];
            last = 2;
        }
        next.impulse += taken.impulses[last - 1];
        if self.bulging {
            next.velocities[2] = taken.velocities[last];
            let impulse = taken.impulses[last];
            let yields = impulse.abs() >= bodies[last].largest * (1.0 - 1e-12);
            // Of a plate that does not yield, all motion is elastic.
            let elastic = if yields {
                self.mobility(now, duration) * impulse
            } else {
                mean(last)
            };
            next.held = !yields
                && taken.velocities[..=last]
                    .iter()
                    .all(|v| *v == taken.velocities[0]);
            next.flexing = if yields {
                elastic
            } else {
                taken.velocities[last]
            };
            next.flexure += duration * elastic;
            next.wave_work += impulse * elastic;
            next.deflection += duration * (mean(last) - elastic);
            next.dish_work += impulse * (mean(last) - elastic);
            let dish = self.dish();
            let old = dish.mass(now.edge) * now.velocities[2].powi(2);
            next.capture += 0.5 * (old - bodies[last].mass * bodies[last].velocity.powi(2));
        }
    }

    /// Ballistic limit [m/s]: the lowest speed that perforates, to a part in 1e6, from a speed of this order.
    ///
    /// The square of the exit speed is nearly a line over that of the impact velocity: speeds on both sides of its root narrow the bracket,
    /// or its middle where the root is outside.
    pub fn ballistic_limit(&self, order: f64) -> f64 {
        let exit = |speed: f64| {
            let run = self.case(speed, Keep::End);
            run.perforated.then(|| run.last.velocities[0].powi(2))
        };
        let (mut low, mut high) = (0.0, order);
        let mut square = exit(high);
        while square.is_none() && high < 1e6 {
            low = high;
            high *= 2.0;
            square = exit(high);
        }
        let mut square = square.unwrap_or(0.0);
        let mut before = None;
        while high - low > LIMIT_TOLERANCE * high {
            let aside = ASIDE * (high - low);
            let root = before.and_then(|(speed, other): (f64, f64)| {
                let slope = (other - square) / (speed * speed - high * high);
                let root = (high * high - square / slope).sqrt();
                (root > low + aside && root < high - aside).then_some(root)
            });
            let speed = match root {
                Some(root) if root - low > high - root => root - aside,
                Some(root) => root + aside,
                None => 0.5 * (low + high),
            };
            match exit(speed) {
                Some(leaving) => {
                    before = Some((high, square));
                    (high, square) = (speed, leaving);
                }
                None => low = speed,
            }
        }
        high
    }
}
