//! The staggered grid: velocities at nodes, stresses in cells, in segments that touch, part or meet again.
//!
//! A step drifts half a step with the velocities at its start, loads the cells there, kicks the nodes over the whole step
//! with those stresses and drifts the second half with the new velocities. Displacement is then exactly the mean of the
//! velocities before and after the kick times the step, so the work of a force is exactly what it adds to the kinetic
//! energy. Position is measured from the struck face, positive into the target; force and stress are positive in compression.

mod balance;
mod contact;
mod kick;
mod law;
mod snapshot;
mod spall;

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::{
    Error,
    error::NumericalError,
    solver::{archive::Archive, monitor::Clock},
};

pub(in crate::fdm) use balance::Accumulators;
pub(in crate::fdm) use law::{Law, Motion, Stored, View};
pub(in crate::fdm) use spall::Spall;

/// Largest change of length of a cell in one step, as a part of its length.
const LARGEST_SHORTENING: f64 = 0.02;
/// The time step grows only when it could grow by this factor, and no faster than by the second one.
const SLACK: f64 = 1.1;
const GROWTH: f64 = 1.05;
/// Factor on a step that no rounding of the stable step of a cell makes up for.
const ROUNDING: f64 = 1.0 + 1e-9;

/// Boundary condition of an end of the grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::fdm) enum BoundaryCondition {
    /// Nothing.
    Free,
    /// A piston of this velocity [m/s]; at 0 a fixed end.
    Driven(f64),
    /// Viscous boundary that takes up a wave without reflecting it \[lysmer1969\]; its impedance [N s/m].
    Dashpot(f64),
}

/// A node: everything that moves at one velocity.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(in crate::fdm) struct Node {
    pub(in crate::fdm) position: f64,
    pub(in crate::fdm) velocity: f64,
    pub(in crate::fdm) mass: f64,
    /// Largest dry friction [N].
    pub(in crate::fdm) friction: f64,
    /// Velocity at the start of the step.
    before: f64,
    /// Force of the cells [N].
    force: f64,
    /// Impulse that friction took in this step [N s].
    lost_impulse: f64,
    /// Jump of velocity at the end of the last step, not yet accounted for to the end [m/s].
    jump: f64,
}

/// Cells of one body that hang together; the nodes of segment `s` are those from `cells.start + s` to `cells.end + s`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(in crate::fdm) struct Segment {
    pub(in crate::fdm) body: usize,
    pub(in crate::fdm) cells: Range<usize>,
}

/// Nodes, cells and accumulated work at one time.
#[derive(Debug)]
pub(in crate::fdm) struct Grid<L: Law> {
    pub(in crate::fdm) bodies: Vec<L>,
    pub(in crate::fdm) segments: Vec<Segment>,
    /// `closed[s]`: whether segments `s` and `s + 1` touch.
    pub(in crate::fdm) closed: Vec<bool>,
    pub(in crate::fdm) nodes: Vec<Node>,
    pub(in crate::fdm) cells: Vec<L::Cell>,
    pub(in crate::fdm) ends: [BoundaryCondition; 2],
    pub(in crate::fdm) time: f64,
    pub(in crate::fdm) step: u64,
    pub(in crate::fdm) time_step: f64,
    /// Largest stable time step of the current state.
    pub(in crate::fdm) stable_step: f64,
    /// Cell that sets it, where the next search begins.
    tightest: usize,
    /// Cells of a segment that a step changes; in a step only.
    moving: Vec<(usize, Motion)>,
    /// Force between projectile and target in the last step [N].
    pub(in crate::fdm) contact_force: f64,
    /// Force on what holds the last node in the last step [N].
    pub(in crate::fdm) back_force: f64,
    /// Force of a constant pressure on the projectile's tip [N]; 0 with any other target.
    pub(in crate::fdm) tip_pressure: f64,
    /// Initial position of the last node [m].
    pub(in crate::fdm) back_position: f64,
    pub(in crate::fdm) accumulated: Accumulators,
    pub(in crate::fdm) spalls: Vec<Spall>,
}

/// A body before it is put on the grid.
#[derive(Debug)]
pub(in crate::fdm) struct Slab<L: Law> {
    pub(in crate::fdm) law: L,
    /// Mass per length [kg/m].
    pub(in crate::fdm) line_density: f64,
    /// Dry friction per length [N/m].
    pub(in crate::fdm) line_friction: f64,
    pub(in crate::fdm) start: f64,
    pub(in crate::fdm) length: f64,
    pub(in crate::fdm) cells: usize,
    pub(in crate::fdm) velocity: f64,
}

impl<L: Law> Grid<L> {
    /// Lines slabs up, back to front; slabs without a gap between them touch.
    pub(in crate::fdm) fn new(slabs: Vec<Slab<L>>, ends: [BoundaryCondition; 2]) -> Self {
        let mut grid = Self {
            bodies: Vec::new(),
            segments: Vec::new(),
            closed: Vec::new(),
            nodes: Vec::new(),
            cells: Vec::new(),
            ends,
            time: 0.0,
            step: 0,
            time_step: 0.0,
            stable_step: f64::INFINITY,
            tightest: 0,
            moving: Vec::new(),
            contact_force: 0.0,
            back_force: 0.0,
            tip_pressure: 0.0,
            back_position: 0.0,
            accumulated: Accumulators::default(),
            spalls: Vec::new(),
        };
        for (body, slab) in slabs.into_iter().enumerate() {
            grid.add(body, slab);
        }
        let last = grid.nodes.len() - 1;
        grid.back_position = grid.nodes[last].position;
        if let [BoundaryCondition::Driven(velocity), _] = grid.ends {
            grid.nodes[0].velocity = velocity;
        }
        if let [_, BoundaryCondition::Driven(velocity)] = grid.ends {
            grid.nodes[last].velocity = velocity;
        }
        grid.accumulated.initial_energy = grid.energy().total();
        grid.accumulated.initial_momentum = grid.momentum().residual();
        grid.join_moving();
        grid.join_met();
        grid.find_stable_step();
        grid
    }

    fn add(&mut self, body: usize, slab: Slab<L>) {
        let size = slab.length / slab.cells.max(1) as f64;
        let first = self.nodes.len();
        if let Some(before) = self.nodes.last() {
            self.closed.push(slab.start <= before.position);
        }
        for i in 0..=slab.cells {
            self.nodes.push(Node {
                position: slab.start + slab.length - size * (slab.cells - i) as f64,
                velocity: slab.velocity,
                ..Node::default()
            });
        }
        let start = self.cells.len();
        for i in first..first + slab.cells {
            let (back, front) = (self.nodes[i].position, self.nodes[i + 1].position);
            self.cells.push(slab.law.cell(back, front));
            for node in &mut self.nodes[i..=i + 1] {
                node.mass += 0.5 * slab.line_density * size;
                node.friction += 0.5 * slab.line_friction * size;
            }
        }
        self.segments.push(Segment {
            body,
            cells: start..self.cells.len(),
        });
        self.bodies.push(slab.law);
    }

    /// Everything that a step changes.
    pub(in crate::fdm) fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        archive.item(&mut self.segments)?;
        archive.item(&mut self.closed)?;
        archive.item(&mut self.nodes)?;
        archive.item(&mut self.cells)?;
        archive.item(&mut self.time)?;
        archive.item(&mut self.step)?;
        archive.item(&mut self.time_step)?;
        archive.item(&mut self.stable_step)?;
        archive.item(&mut self.contact_force)?;
        archive.item(&mut self.back_force)?;
        archive.item(&mut self.accumulated)?;
        archive.item(&mut self.spalls)
    }

    pub(in crate::fdm) fn clock(&self) -> Clock {
        Clock {
            step: self.step,
            time: self.time,
            time_step: self.time_step,
        }
    }

    /// First and last node of a segment.
    pub(in crate::fdm) fn span(&self, s: usize) -> (usize, usize) {
        let cells = &self.segments[s].cells;
        (cells.start + s, cells.end + s)
    }

    /// Advances by one step of at most `longest` [s].
    ///
    /// The first one is half as long and loads the cells where they are, so that stress and time begin together.
    pub(in crate::fdm) fn advance(
        &mut self,
        courant: f64,
        longest: f64,
    ) -> Result<(), NumericalError> {
        let nominal = self.next_step(courant * self.stable_step).min(longest);
        let (time_step, lead) = match self.step {
            0 => (0.5 * nominal, 0.0),
            _ => (nominal, 0.5 * nominal),
        };
        self.load(nominal, lead)?;
        self.account_for_jumps(time_step);
        self.kick(time_step);
        self.detect_contact(time_step);
        self.drift(time_step)?;
        self.join_met();
        self.split_spalls();
        self.time += time_step;
        self.time_step = nominal;
        self.step += 1;
        Ok(())
    }

    /// Every change of the time step costs a little energy, so small changes are not made.
    fn next_step(&self, allowed: f64) -> f64 {
        if self.time_step == 0.0 || allowed < self.time_step {
            0.98 * allowed
        } else if allowed > SLACK * self.time_step {
            GROWTH * self.time_step
        } else {
            self.time_step
        }
    }

    /// Brings the cells to where they are after `lead` [s] and collects the forces on the nodes.
    fn load(&mut self, time_step: f64, lead: f64) -> Result<(), NumericalError> {
        let since_load = 0.5 * (self.time_step + time_step);
        for (s, segment) in self.segments.iter().enumerate() {
            let law = &self.bodies[segment.body];
            let nodes = &mut self.nodes[segment.cells.start + s..=segment.cells.end + s];
            let cells = &mut self.cells[segment.cells.clone()];
            self.moving.clear();
            for (i, (cell, ends)) in cells.iter().zip(nodes.windows(2)).enumerate() {
                let (a, b) = (&ends[0], &ends[1]);
                let approach = a.velocity - b.velocity;
                let moves = a.velocity != 0.0 || b.velocity != 0.0;
                if moves || !law.is_settled(cell) {
                    let length = b.position - a.position - approach * lead;
                    if length.is_nan() || length <= 0.0 {
                        return Err(self.inverted(segment.cells.start + i));
                    }
                    let motion = Motion {
                        length,
                        approach,
                        since_load,
                        time_step,
                    };
                    self.moving.push((i, motion));
                }
            }
            law.load_all(cells, &self.moving);
            let mut behind = 0.0;
            for (node, cell) in nodes.iter_mut().zip(&*cells) {
                let force = law.force(cell);
                node.force = behind - force;
                behind = force;
            }
            nodes[cells.len()].force = behind;
        }
        Ok(())
    }

    /// Moves the nodes, finishes the cells and finds the next stable step.
    fn drift(&mut self, time_step: f64) -> Result<(), NumericalError> {
        for node in &mut self.nodes {
            let mean = 0.5 * (node.before + node.velocity);
            node.position += mean * time_step;
            if node.lost_impulse != 0.0 {
                self.accumulated.friction_impulse += node.lost_impulse;
                self.accumulated.friction_work += node.lost_impulse * mean;
            }
        }
        for (s, segment) in self.segments.iter().enumerate() {
            let law = &self.bodies[segment.body];
            let nodes = &self.nodes[segment.cells.start + s..=segment.cells.end + s];
            for (i, cell) in self.cells[segment.cells.clone()].iter_mut().enumerate() {
                let (a, b) = (&nodes[i], &nodes[i + 1]);
                let length = b.position - a.position;
                let mean = 0.5 * (a.before + a.velocity - b.before - b.velocity);
                if length.is_nan() || length <= 0.0 || !law.finish(cell, length, mean * time_step) {
                    return Err(self.inverted(segment.cells.start + i));
                }
            }
        }
        self.find_stable_step();
        Ok(())
    }

    /// Finds the next stable step. The cell that set the last one comes first: most others are then seen to allow it without a division.
    fn find_stable_step(&mut self) {
        let (mut found, last) = ((f64::INFINITY, self.tightest), self.tightest);
        let holds_last = |segment: &Segment| segment.cells.contains(&last);
        if let Some(s) = self.segments.iter().position(holds_last) {
            self.compare_steps(s, last..last + 1, &mut found);
        }
        for s in 0..self.segments.len() {
            self.compare_steps(s, self.segments[s].cells.clone(), &mut found);
        }
        (self.stable_step, self.tightest) = found;
    }

    /// Compares the stable steps of some cells of a segment with the smallest one so far and the cell that has it.
    fn compare_steps(&self, s: usize, cells: Range<usize>, (step, cell): &mut (f64, usize)) {
        let law = &self.bodies[self.segments[s].body];
        let ends = self.nodes[cells.start + s..=cells.end + s].windows(2);
        for ((c, own), ends) in cells.clone().zip(&self.cells[cells]).zip(ends) {
            let length = ends[1].position - ends[0].position;
            let approach = ends[0].velocity - ends[1].velocity;
            let slow = approach.abs() * *step * ROUNDING < LARGEST_SHORTENING * length;
            if slow && law.allows(own, length, *step * ROUNDING) {
                continue;
            }
            let limit = cell_limit(law, own, length, approach);
            if limit < *step {
                (*step, *cell) = (limit, c);
            }
        }
    }

    fn inverted(&self, cell: usize) -> NumericalError {
        NumericalError {
            what: "a cell was compressed beyond what its law can follow".to_owned(),
            step: self.step,
            time_us: self.time * 1e6,
            element: Some(cell),
            remedy: "lower `fdm.courant`, or add `fdm.artificial_viscosity`".to_owned(),
        }
    }
}

fn cell_limit<L: Law>(law: &L, cell: &L::Cell, length: f64, approach: f64) -> f64 {
    let stable = law.stable_step(cell, length, approach);
    if approach.abs() * stable > LARGEST_SHORTENING * length {
        LARGEST_SHORTENING * length / approach.abs()
    } else {
        stable
    }
}
