//! Time step: particles in parallel, their sums on the nodes, motion of the nodes, contact.

use rayon::prelude::*;

use super::{
    advance::advance,
    body::{Body, Limits, Pass, Sums, Task},
    boundary::BoundaryConditions,
    contact::{Contact, exchange_contact_impulses},
    deposit::deposit,
    field::Field,
    mesh::Mesh,
    nodes::{RowSums, add_up, move_row},
    surface::Surface,
};
use crate::{
    Error,
    solver::{Control, Particle, archive::Archive},
};

/// Part of a cell that particles may go until they are put in order again.
const ORDER: f64 = 0.5;
/// Chunks between two questions whether to go on, of a state that is set up.
const PORTION: usize = 512;

/// Bodies in motion. The first one is the projectile.
#[derive(Debug)]
pub(super) struct Grid {
    pub(super) bodies: Vec<Body>,
    pub(super) supports: Vec<BoundaryConditions>,
    pub(super) contact: Contact,
    /// Surface of the projectile where contact follows it: under a nose that is not flat.
    pub(super) surface: Option<Surface>,
    pub(super) mesh: Mesh,
    pub(super) courant: f64,
    pub(super) limits: Limits,
    pub(super) step: u64,
    pub(super) time: f64,
    /// Step that the next advance of particles takes [s]; 0 before the first.
    pub(super) time_step: f64,
    /// Way of the fastest particle since the particles were last put in order [m].
    pub(super) travel: f64,
    /// Sums over the particles of each body after the last step.
    pub(super) sums: Vec<Sums>,
    /// Accumulators as of the particles' last step.
    pub(super) accumulated: Accumulators,
    /// What the nodes did since, which the particles have yet to take over.
    pub(super) deferred: DeferredWork,
}

/// What has passed since the start.
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub(super) struct Accumulators {
    pub(super) initial_energy: f64,
    pub(super) initial_momentum: f64,
    /// Work done in the projectile and in the target [J]: all, plastic, viscous, failure. Velocities stand half a step behind
    /// positions, so half of the last step's work belongs to the time of the velocities: of all work the half that the stresses
    /// before the step do, whose forces have changed the velocities already. In a linear system the sum of both energies is then
    /// the same after every step.
    pub(super) work: [[f64; 4]; 2],
    /// The other half.
    pub(super) half_work: [[f64; 4]; 2],
    pub(super) transfer: f64,
    pub(super) contact: f64,
    pub(super) boundary: f64,
    pub(super) lost_energy: f64,
    pub(super) support_impulse: f64,
    pub(super) lost_momentum: f64,
    /// Particles that left, of the projectile and of the target.
    pub(super) lost: [usize; 2],
    /// Mass of the projectile that left at the front [kg].
    pub(super) passed: f64,
}

/// What a motion of the nodes adds to the accumulated.
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub(super) struct DeferredWork {
    pub(super) transfer: f64,
    pub(super) contact: f64,
    pub(super) boundary: f64,
    pub(super) support_impulse: f64,
    /// Kinetic energy of the nodes [J].
    pub(super) nodal: f64,
    /// Axial force of the projectile on what is in front of it [N].
    pub(super) contact_force: f64,
}

impl Grid {
    /// Everything that a step changes: the strips say how far the particles of a body have spread, and the field moves them in the next
    /// step.
    pub(super) fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        archive.item(&mut self.step)?;
        archive.item(&mut self.time)?;
        archive.item(&mut self.time_step)?;
        archive.item(&mut self.travel)?;
        archive.item(&mut self.sums)?;
        archive.item(&mut self.accumulated)?;
        archive.item(&mut self.deferred)?;
        archive.item(&mut self.surface)?;
        for (body, supports) in self.bodies.iter_mut().zip(&mut self.supports) {
            let mut particles: Vec<Particle> = body.particles().collect();
            archive.item(&mut particles)?;
            archive.item(&mut body.chunks)?;
            if archive.is_read() {
                body.set_particles(&particles, &mut Control::default())?;
            }
            archive.item(&mut body.field)?;
            archive.item(&mut supports.displacement)?;
        }
        Ok(())
    }

    /// Makes the nodes ready from particles as they are.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub(super) fn start(&mut self, control: &mut Control<'_>) -> Result<(), Error> {
        for body in &mut self.bodies {
            body.put_in_order(&self.mesh, control)?;
        }
        self.time_step = 0.0;
        self.pass(false, control)?;
        let (energy, momentum) = self.motion();
        self.accumulated.initial_energy = energy;
        self.accumulated.initial_momentum = momentum;
        control.ask()?;
        self.move_nodes();
        Ok(())
    }

    /// Kinetic energy [J] and axial momentum [N s] of all particles.
    pub(super) fn motion(&self) -> (f64, f64) {
        let sum = |value: fn(&Sums) -> f64| self.sums.iter().map(value).sum();
        (sum(|s| s.kinetic), sum(|s| s.momentum))
    }

    /// Advances by one step; false when a number ceased to be one.
    pub(super) fn advance(&mut self) -> bool {
        if !self.take_over() {
            return false;
        }
        self.move_nodes();
        true
    }

    /// Lets the particles take over what the nodes did, and adds them up on the nodes; false when a number ceased to be one.
    pub(super) fn take_over(&mut self) -> bool {
        let deferred = self.deferred;
        let fastest = self.sums.iter().map(|sums| sums.speed_squared);
        self.travel += self.time_step * fastest.fold(0.0, f64::max).sqrt();
        let in_order = self.travel < ORDER * self.mesh.cell;
        // Between two steps nobody is asked.
        if self.pass(!in_order, &mut Control::default()).is_err() {
            return false;
        }
        self.step += 1;
        self.time += self.time_step;
        let accumulated = &mut self.accumulated;
        let stresses: f64 = self.sums.iter().map(|sums| sums.work.power_at_start).sum();
        accumulated.transfer +=
            deferred.transfer + deferred.nodal - 0.5 * self.time_step * stresses;
        accumulated.contact += deferred.contact;
        accumulated.boundary += deferred.boundary;
        accumulated.support_impulse += deferred.support_impulse;
        for role in 0..2 {
            for k in 0..4 {
                accumulated.work[role][k] += std::mem::take(&mut accumulated.half_work[role][k]);
            }
        }
        for (index, sums) in self.sums.iter().enumerate() {
            let role = index.min(1);
            let work = &sums.work;
            let halves = [
                (work.total, 0.5 * self.time_step * work.power_at_start),
                (work.plastic, 0.5 * work.plastic),
                (work.viscous, 0.5 * work.viscous),
                (work.failure, 0.5 * work.failure),
            ];
            for (k, (work, first)) in halves.into_iter().enumerate() {
                accumulated.work[role][k] += first;
                accumulated.half_work[role][k] += work - first;
            }
            accumulated.lost[role] += sums.lost.0;
            if role == 0 {
                accumulated.passed += sums.passed;
            }
            accumulated.lost_momentum += sums.lost.1;
            accumulated.lost_energy += sums.lost.2;
            accumulated.transfer -= sums.kinetic + sums.lost.2;
        }
        !self.sums.iter().any(|sums| sums.broken)
    }

    /// Moves all particles by the current step and adds them up on the nodes, in a new order if asked to.
    ///
    /// The nodes get the pressures of the groups that are to share a rate of volume in the next step.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    fn pass(&mut self, reorder: bool, control: &mut Control<'_>) -> Result<(), Error> {
        let mesh = self.mesh;
        let pass = Pass {
            time_step: self.time_step,
            mesh,
            limits: self.limits,
        };
        self.sums = vec![Sums::default(); self.bodies.len()];
        let mut tasks = Vec::new();
        for (index, body) in self.bodies.iter_mut().enumerate() {
            tasks.extend(body.tasks().map(|task| (index, task)));
        }
        let at_once = chunks_at_once(tasks.len());
        for portion in tasks.chunks_mut(PORTION) {
            control.ask()?;
            let sums: Vec<(usize, Sums)> = portion
                .par_iter_mut()
                .with_min_len(at_once)
                .map(|(index, task)| {
                    let sums = advance(task, &pass);
                    if !reorder {
                        deposit(task, &mesh);
                    }
                    (*index, sums)
                })
                .collect();
            for (index, sum) in &sums {
                self.sums[*index].add(sum);
            }
        }
        if reorder {
            self.travel = 0.0;
            for body in &mut self.bodies {
                body.put_in_order(&mesh, control)?;
            }
            let tasks: Vec<Task<'_>> = self.bodies.iter_mut().flat_map(Body::tasks).collect();
            tasks
                .into_par_iter()
                .with_min_len(at_once)
                .for_each(|mut task| deposit(&mut task, &mesh));
        }
        for body in &mut self.bodies {
            control.ask()?;
            body.field.cover(&body.chunks);
            let Field {
                first_row,
                columns,
                nodes,
                ..
            } = &mut body.field;
            let (first_row, columns) = (*first_row, *columns);
            let chunks = &body.chunks;
            let rows = nodes.len() / columns.max(1);
            nodes
                .par_chunks_mut(columns.max(1))
                .enumerate()
                .with_min_len(rows_at_once(rows, columns))
                .for_each(|(index, row)| add_up(chunks, first_row + index as isize, row));
        }
        Ok(())
    }

    /// Chooses the step that comes next and moves the nodes by it.
    pub(super) fn move_nodes(&mut self) {
        let most = |value: fn(&Sums) -> f64| self.sums.iter().map(value).fold(0.0, f64::max).sqrt();
        let (wave, speed) = (most(|s| s.wave_squared), most(|s| s.speed_squared));
        self.time_step = self.courant * self.mesh.cell / (wave + speed);
        let (time_step, mesh) = (self.time_step, self.mesh);
        let (contact, surface) = (self.contact, self.surface.as_ref());
        let passed =
            exchange_contact_impulses(contact, &mut self.bodies, surface, &mesh, time_step);
        let mut total = RowSums::default();
        for (body, supports) in self.bodies.iter_mut().zip(&self.supports) {
            let columns = body.field.columns;
            let mut velocity = std::mem::take(&mut body.field.velocity);
            let field = &body.field;
            let rows: Vec<RowSums> = velocity
                .par_chunks_mut(columns.max(1))
                .enumerate()
                .with_min_len(rows_at_once(field.rows, columns))
                .map(|(index, row)| {
                    let at = field.first_row + index as isize;
                    move_row(field, supports, at, row, &mesh, time_step)
                })
                .collect();
            body.field.velocity = velocity;
            for row in rows {
                for (sum, added) in total.kinetic.iter_mut().zip(row.kinetic) {
                    *sum += added;
                }
                total.boundary += row.boundary;
                total.contact += row.contact;
                total.power += row.power;
                total.impulse += row.impulse;
                total.wall += row.wall;
            }
        }
        let (particles, _) = self.motion();
        let [came, walled, held] = total.kinetic;
        let mut deferred = DeferredWork {
            transfer: particles - came,
            contact: came - walled + total.contact,
            boundary: total.boundary,
            support_impulse: total.impulse,
            nodal: held,
            contact_force: (total.wall + passed) / time_step,
        };
        // Nodal forces work on velocities that the way from particles to nodes has smoothed; on the particles' own strain rates,
        // before and after, the stresses would have done half the work each. The second half is known after the next step.
        let stresses: f64 = self.sums.iter().map(|sums| sums.work.power_at_end).sum();
        deferred.transfer -= 0.5 * time_step * (total.power + stresses);
        self.deferred = deferred;
        for (body, supports) in self.bodies.iter().zip(&mut self.supports) {
            supports.follow(&body.field, time_step);
        }
        if let (Some(surface), Some(projectile)) = (&mut self.surface, self.bodies.first()) {
            surface.follow(&projectile.field, &mesh, time_step);
        }
    }
}

/// Rows of nodes that one task takes: all of them where the work is too small to be shared out.
fn rows_at_once(rows: usize, columns: usize) -> usize {
    const SMALL: usize = 10_000;
    match rows * columns {
        0..SMALL => rows.max(1),
        _ => 8,
    }
}

/// Chunks that one task takes: all of them where there is one thread.
fn chunks_at_once(chunks: usize) -> usize {
    match rayon::current_num_threads() {
        1 => chunks.max(1),
        _ => 1,
    }
}
