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
mod nodes;
mod snapshot;
mod spall;

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::{
    Error,
    error::NumericalError,
    lanes::LANES,
    solver::{archive::Archive, monitor::Clock},
};

pub(in crate::fdm) use balance::Accumulators;
pub(in crate::fdm) use law::{
    Cells, Law, Motion, Motions, Stored, View, load_one_by_one, stable_step_one_by_one,
};
pub(in crate::fdm) use spall::Spall;

use nodes::{Collect, Drift, Measure, Node, Nodes};

/// Largest change of length of a cell in one step, as a part of its length.
const LARGEST_SHORTENING: f64 = 0.02;
/// The time step grows only when it could grow by this factor, and no faster than by the second one.
const SLACK: f64 = 1.1;
const GROWTH: f64 = 1.05;

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
    pub(in crate::fdm) nodes: Nodes,
    pub(in crate::fdm) cells: L::Cells,
    pub(in crate::fdm) ends: [BoundaryCondition; 2],
    pub(in crate::fdm) time: f64,
    pub(in crate::fdm) step: u64,
    pub(in crate::fdm) time_step: f64,
    /// Largest stable time step of the current state.
    pub(in crate::fdm) stable_step: f64,
    /// Of every cell, in a step only: its length [m], the speed at which its faces approach [m/s], its force [N].
    lengths: Vec<f64>,
    approaches: Vec<f64>,
    forces: Vec<f64>,
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
            nodes: Nodes::default(),
            cells: L::Cells::default(),
            ends,
            time: 0.0,
            step: 0,
            time_step: 0.0,
            stable_step: f64::INFINITY,
            lengths: Vec::new(),
            approaches: Vec::new(),
            forces: Vec::new(),
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
        grid.back_position = grid.nodes.position[last];
        if let [BoundaryCondition::Driven(velocity), _] = grid.ends {
            grid.nodes.velocity[0] = velocity;
        }
        if let [_, BoundaryCondition::Driven(velocity)] = grid.ends {
            grid.nodes.velocity[last] = velocity;
        }
        let count = grid.cells.count().next_multiple_of(LANES);
        (grid.lengths, grid.approaches) = (vec![1.0; count], vec![0.0; count]);
        grid.forces = vec![0.0; count];
        grid.accumulated.initial_energy = grid.energy().total();
        grid.accumulated.initial_momentum = grid.momentum().residual();
        grid.join_moving();
        grid.join_met();
        grid.measure(0.0);
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
        let start = self.cells.count();
        for i in first..first + slab.cells {
            let (back, front) = (self.nodes.position[i], self.nodes.position[i + 1]);
            self.cells.add(slab.law.cell(back, front));
            for node in [i, i + 1] {
                self.nodes.mass[node] += 0.5 * slab.line_density * size;
                self.nodes.friction[node] += 0.5 * slab.line_friction * size;
            }
        }
        self.segments.push(Segment {
            body,
            cells: start..self.cells.count(),
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

    /// Finds the lengths of the cells after `lead` [s]; whether every cell has one.
    fn measure(&mut self, lead: f64) -> bool {
        let mut whole = true;
        for s in 0..self.segments.len() {
            let ((first, last), cells) = (self.span(s), self.segments[s].cells.clone());
            whole &= pulp::Arch::new().dispatch(Measure {
                positions: &self.nodes.position[first..=last],
                velocities: &self.nodes.velocity[first..=last],
                lead,
                lengths: &mut self.lengths[cells.clone()],
                approaches: &mut self.approaches[cells],
            });
        }
        whole
    }

    /// Why a step ends in which cells have no length.
    fn no_length(&self) -> NumericalError {
        let lengths = &self.lengths[..self.cells.count()];
        let cell = lengths.iter().position(|l| l.is_nan() || *l <= 0.0);
        self.inverted(cell.unwrap_or(0))
    }

    /// Brings the cells to where they are after `lead` [s] and collects the forces on the nodes.
    fn load(&mut self, time_step: f64, lead: f64) -> Result<(), NumericalError> {
        if !self.measure(lead) {
            return Err(self.no_length());
        }
        let motions = Motions {
            lengths: &self.lengths,
            approaches: &self.approaches,
            since_load: 0.5 * (self.time_step + time_step),
            time_step,
        };
        for (s, segment) in self.segments.iter().enumerate() {
            let (law, range) = (&self.bodies[segment.body], segment.cells.clone());
            law.load_all(&mut self.cells, range.clone(), &motions, &mut self.forces);
            pulp::Arch::new().dispatch(Collect {
                of_cells: &self.forces[range.clone()],
                on_nodes: &mut self.nodes.force[range.start + s..=range.end + s],
            });
        }
        Ok(())
    }

    /// Moves the nodes, finishes the cells and finds the next stable step.
    fn drift(&mut self, time_step: f64) -> Result<(), NumericalError> {
        pulp::Arch::new().dispatch(Drift {
            nodes: &mut self.nodes,
            time_step,
        });
        let nodes = &self.nodes;
        for (i, lost) in nodes.lost_impulse.iter().enumerate() {
            let mean = 0.5 * (nodes.before[i] + nodes.velocity[i]);
            self.accumulated.friction_impulse += lost;
            self.accumulated.friction_work += lost * mean;
        }
        if !self.measure(0.0) {
            return Err(self.no_length());
        }
        for (s, segment) in self.segments.iter().enumerate() {
            let (law, nodes) = (&self.bodies[segment.body], &self.nodes);
            if !law.finishes() {
                continue;
            }
            for c in segment.cells.clone() {
                let (a, b) = (nodes.at(c + s), nodes.at(c + s + 1));
                let mean = 0.5 * (a.before + a.velocity - b.before - b.velocity);
                let (length, shortening) = (self.lengths[c], mean * time_step);
                let finish = |cell: &mut L::Cell| law.finish(cell, length, shortening);
                if !self.cells.change(c, finish) {
                    return Err(self.inverted(c));
                }
            }
        }
        self.find_stable_step();
        Ok(())
    }

    /// Finds the next stable step.
    fn find_stable_step(&mut self) {
        let ends = [&self.lengths[..], &self.approaches[..]];
        let steps = self.segments.iter().map(|segment| {
            let law = &self.bodies[segment.body];
            law.stable_step_of_all(&self.cells, segment.cells.clone(), ends)
        });
        self.stable_step = steps.fold(f64::INFINITY, f64::min);
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

/// The step in which a cell may shorten, by its law or by how fast it does [s].
#[inline(always)]
pub(in crate::fdm) fn limited(stable: f64, length: f64, approach: f64) -> f64 {
    let most = LARGEST_SHORTENING * length;
    if approach.abs() * stable > most {
        most / approach.abs()
    } else {
        stable
    }
}
