//! Force on the struck face: its plateau, and its largest value once the start of the calculation is over.
//!
//! Behind the first waves the stress on the struck face is constant until a wave returns from the rear of a body. The artificial viscosity
//! needs time to build up its shock profile: until then the stress overshoots, by the same part on every mesh.

use super::law::PlanarLaw;
use crate::{
    Error,
    fdm::grid::{Grid, Slab},
    solver::archive::Archive,
};

/// Part of the time in which a wave crosses the thinner body that the plateau is not taken from.
const START: f64 = 0.5;

/// Force between projectile and target during a run.
#[derive(Debug)]
pub(super) struct InterfaceForce {
    /// Times between which the plateau is taken [s].
    plateau: [f64; 2],
    /// Impulse [N s] and time [s] of the steps between them.
    sums: [f64; 2],
    /// Largest force from the start of the plateau on [N].
    pub(super) peak: f64,
}

impl InterfaceForce {
    /// The force at the moment of impact: the plateau is the second half of the time in which the fastest wave crosses the thinner of the
    /// two bodies that meet.
    pub(super) fn new(slabs: &[Slab<PlanarLaw>], velocity: f64) -> Self {
        let bodies = slabs.iter().take(2).filter(|slab| slab.cells > 0);
        let passage = bodies
            .map(|slab| slab.length / slab.law.fastest_wave(velocity))
            .fold(f64::INFINITY, f64::min);
        Self {
            plateau: [START * passage, passage],
            sums: [0.0; 2],
            peak: 0.0,
        }
    }

    /// Everything that a step changes.
    pub(super) fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        archive.item(&mut self.sums)?;
        archive.item(&mut self.peak)
    }

    /// Takes the force of the step that ended.
    pub(super) fn follow(&mut self, grid: &Grid<PlanarLaw>, before: f64) {
        let [from, to] = self.plateau;
        if before < from {
            return;
        }
        self.peak = self.peak.max(grid.contact_force);
        if grid.time <= to {
            let step = grid.time - before;
            self.sums[0] += grid.contact_force * step;
            self.sums[1] += step;
        }
    }

    /// Mean force on the plateau [N]; `None` in a run that ended before it, or on a mesh too coarse for it.
    pub(super) fn plateau(&self) -> Option<f64> {
        let [impulse, time] = self.sums;
        (time > 0.0).then(|| impulse / time)
    }
}
