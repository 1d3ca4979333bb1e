//! Runs a case to its end.

use std::iter;

use super::{
    axial,
    checkpoint::Keeping,
    results::sum_up,
    setup::{build, extent},
    solver::Solver,
    watch::Watch,
};
use crate::{
    Error, Scenario,
    error::NumericalError,
    history::Recorder,
    material::Material,
    options::Eos,
    outcome::{RunResult, Termination},
    scenario::{Plate, TargetBody},
    solver::{
        Control, Progress,
        frames::{Frame, FrameClock},
        go_on,
    },
};

/// Steps between two looks at the books and reports of progress.
const AUDIT_INTERVAL: u64 = 10;
/// Largest part of the initial energy that may stay without an account.
pub const ENERGY_TOLERANCE: f64 = 1e-2;
/// Largest part of the initial momentum that may stay without an account.
pub const MOMENTUM_TOLERANCE: f64 = 1e-9;

/// A case in progress.
#[derive(Debug)]
pub(super) struct Run<'a> {
    pub(super) scenario: &'a Scenario,
    pub(super) solver: Solver,
    pub(super) watch: Watch,
}

/// Why a case that the guard lets pass gets no number, if it does not.
pub(super) fn not_applicable(scenario: &Scenario) -> Option<String> {
    let options = &scenario.options.axi;
    let materials: Vec<(&Material, &str)> = materials(scenario).collect();
    if options.equation_of_state == Some(Eos::MieGruneisen) {
        let lacking = materials
            .iter()
            .find(|(m, _)| m.equation_of_state.is_none());
        if let Some((_, id)) = lacking {
            return Some(format!(
                "`axi.equation_of_state = \"mie-gruneisen\"` needs an equation of state, and the material `{id}` has none"
            ));
        }
    }
    if options.damage == Some(true) && materials.iter().all(|(m, _)| m.damage.is_none()) {
        return Some(
            "`axi.damage = true` needs a material that has a `damage` table, and none has one"
                .to_owned(),
        );
    }
    let spalls = options.spalls() && options.spall_strength.is_none();
    if spalls && materials.iter().all(|(m, _)| m.spall_strength.is_none()) {
        return Some(
            "`axi.spall = true` needs a material that has a `spall_strength`, and none has one: give one, or `axi.spall_strength`"
                .to_owned(),
        );
    }
    None
}

/// Materials of projectile and target, with their ids.
pub(super) fn materials(scenario: &Scenario) -> impl Iterator<Item = (&Material, &str)> {
    let rod = &scenario.projectile;
    let layers: &[Plate] = match &scenario.target {
        TargetBody::Layers { layers, .. } => layers,
        _ => &[],
    };
    let layers = layers
        .iter()
        .map(|layer| (&*layer.material, &*layer.material_id));
    iter::once((&*rod.material, &*rod.material_id)).chain(layers)
}

impl<'a> Run<'a> {
    pub(super) fn new(scenario: &'a Scenario) -> Self {
        let solver = build(scenario);
        Self {
            scenario,
            watch: Watch::new(&solver),
            solver,
        }
    }

    pub(super) fn run(mut self, control: &mut Control<'_>) -> Result<RunResult, Error> {
        let options = &self.scenario.options.axi;
        let end_time = options
            .end_time
            .map_or_else(|| self.longest(), |time| time.si());
        let max_steps = options.max_steps.unwrap_or(20_000_000);
        let thickness = self.scenario.target_thickness();
        let mut keeping = match control.resume {
            Some(bytes) => self.restore(bytes)?,
            None => Keeping {
                clock: FrameClock::new(self.scenario),
                recorder: control.record.then(Recorder::new),
            },
        };
        self.show(&mut keeping.clock, control)?;
        let termination = loop {
            if self.scenario.impact_speed == 0.0 {
                break Termination::NothingMoves;
            }
            if !self.solver.advance() {
                return Err(self
                    .broken("a particle's state is no number", "reduce `axi.courant`")
                    .into());
            }
            self.watch.follow(&self.solver, thickness);
            if let Some(recorder) = &mut keeping.recorder {
                if recorder.wants_sample(self.solver.step) {
                    recorder.sample(axial::sample(&self.solver, &self.watch));
                }
                if recorder.wants_profile(self.solver.step) {
                    recorder.profile(axial::profile(&self.solver));
                }
            }
            self.show(&mut keeping.clock, control)?;
            if self.solver.step.is_multiple_of(AUDIT_INTERVAL) {
                self.audit()?;
                control.report(self.progress(end_time))?;
            }
            if let Some(termination) = self.watch.end(&self.solver, self.scenario) {
                break termination;
            }
            if self.solver.time >= end_time {
                break Termination::EndTime;
            }
            if self.solver.step >= max_steps {
                break Termination::StepLimit;
            }
            // After everything that the step changes, so that a run that goes on from here misses none of it.
            if self.solver.step.is_multiple_of(AUDIT_INTERVAL) {
                self.leave_checkpoint(&mut keeping, control)?;
            }
        };
        self.audit()?;
        let last = keeping.clock.last(self.solver.time);
        self.frame((last, true), control)?;
        Ok(sum_up(&self, termination, keeping.recorder))
    }

    /// Gives the fields to the caller when it is time to.
    fn show(&self, clock: &mut FrameClock, control: &mut Control<'_>) -> Result<(), Error> {
        match clock.tick(self.solver.time) {
            Some(number) => self.frame((number, false), control),
            None => Ok(()),
        }
    }

    fn frame(&self, (number, last): (u64, bool), control: &mut Control<'_>) -> Result<(), Error> {
        let Some(callback) = &mut control.frames else {
            return Ok(());
        };
        let solver = &self.solver;
        let frame = Frame {
            number,
            last,
            step: solver.step,
            time: solver.time,
            cell: solver.cell,
            depth: self.watch.depth,
            bodies: solver.bodies.iter().map(|body| &*body.particles).collect(),
        };
        go_on(callback(&frame), solver.step, solver.time)
    }

    fn leave_checkpoint(
        &mut self,
        keeping: &mut Keeping,
        control: &mut Control<'_>,
    ) -> Result<(), Error> {
        let Some(checkpoints) = &mut control.checkpoints else {
            return Ok(());
        };
        if !checkpoints.is_due() {
            return Ok(());
        }
        let bytes = self.checkpoint(keeping)?;
        go_on(checkpoints.keep(&bytes), self.solver.step, self.solver.time)
    }

    /// Whether the books balance.
    fn audit(&self) -> Result<(), Error> {
        if self.watch.energy_residual > ENERGY_TOLERANCE {
            let what = format!(
                "{:.2} % of the energy is without an account",
                100.0 * self.watch.energy_residual
            );
            return Err(self.broken(&what, "reduce `axi.courant`").into());
        }
        if self.watch.momentum_residual > MOMENTUM_TOLERANCE {
            let what = format!(
                "a part {:.1e} of the momentum is without an account",
                self.watch.momentum_residual
            );
            return Err(self
                .broken(
                    &what,
                    "please report the case: momentum is kept to rounding",
                )
                .into());
        }
        Ok(())
    }

    fn broken(&self, what: &str, remedy: &str) -> NumericalError {
        NumericalError {
            what: what.to_owned(),
            step: self.solver.step,
            time_us: self.solver.time * 1e6,
            element: None,
            remedy: remedy.to_owned(),
        }
    }

    /// Time at which a run without an `end_time` gives up: many times what waves and the shot itself take.
    fn longest(&self) -> f64 {
        let rod = &self.scenario.projectile;
        let speed = self.scenario.impact_speed.max(1.0);
        let path =
            rod.length + extent(self.scenario).map_or(0.0, |extent| extent.layers.iter().sum());
        20.0 * (2.0 * path / rod.material.bar_wave_speed() + 2.0 * path / speed)
    }

    fn progress(&self, end_time: f64) -> Progress {
        let projectile = &self.solver.sums[0];
        let speed = if projectile.mass > 0.0 {
            projectile.momentum / projectile.mass
        } else {
            0.0
        };
        let slowed = (1.0 - speed / self.scenario.impact_speed).min(1.0);
        // A plate slows its projectile but a little: there the way through it counts.
        let passed = self.scenario.target_thickness().map_or(0.0, |thickness| {
            let way = thickness + self.scenario.projectile.length;
            (self.solver.time * self.scenario.impact_speed / (2.0 * way)).min(1.0)
        });
        Progress {
            step: self.solver.step,
            time: self.solver.time,
            fraction: (self.solver.time / end_time)
                .max(0.95 * slowed.max(passed))
                .clamp(0.0, 1.0),
            depth: self.watch.largest_depth,
        }
    }
}
