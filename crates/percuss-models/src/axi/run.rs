//! The bodies as a solver.

use std::iter;

use super::{
    axial,
    body::Body,
    crater,
    end::{Window, is_held},
    floor::Floor,
    results,
    setup::{build, cell},
    solver::Grid,
};
use crate::{
    Error, Refusal, Scenario,
    error::NumericalError,
    history::{ElementState, Profile, Sample},
    ledger::{EnergyLedger, MomentumLedger},
    material::Material,
    options::{AxiOptions, Eos},
    outcome::{Outcome, RunResult, Termination},
    problem::RearFaceCondition,
    scenario::{Plate, TargetBody},
    solver::{
        Control,
        archive::Archive,
        driver::Drive,
        frames::{Bonds, Fields},
        gauge::Gauge,
        interface::{Audit, BalanceTolerance, Extremes, Retry, Solver, slowed},
        limits::Limits,
        monitor::{Clock, Probe, RunMonitor},
    },
};

/// Courant number below which a run is not repeated.
const SMALLEST_COURANT: f64 = 0.1;
/// Fewest cells along a projectile.
const FEWEST_CELLS: f64 = 1.0;
/// Part of the largest force so far below which bodies do not touch: nodes of the grid that two bodies share still exchange the impulses
/// of what rings in them.
const TOUCHING_FRACTION: f64 = 1e-2;

/// Projectile and target as bodies of material points.
#[derive(Debug)]
pub(crate) struct Axisymmetric<'a> {
    pub(super) scenario: &'a Scenario,
    pub(super) grid: Grid,
    pub(super) window: Window,
    pub(super) floor: Floor,
    /// Depth of the crater floor [m], from the face of a target that flies where its centre of mass carries it, and whether the last step left it where it
    /// was or higher.
    pub(super) depth: f64,
    floor_stopped: bool,
    /// Whether the projectile presses on the target in the step that comes next.
    touches: bool,
    /// Time before the last step [s].
    before: f64,
    /// Current positions of the gauges [m], which move with the material on the axis unless they are fixed.
    gauges: Vec<f64>,
    /// Body of each gauge.
    gauge_bodies: Vec<usize>,
}

/// A run of the model.
pub(super) type AxiRun<'a> = Drive<'a, Axisymmetric<'a>>;

/// Why a case inside the validity domain gets no number, if it does not.
pub(super) fn not_applicable(scenario: &Scenario) -> Option<Refusal> {
    let options = &scenario.options.axi;
    let cells = scenario.projectile.length / cell(scenario);
    if cells < FEWEST_CELLS {
        let needed = (FEWEST_CELLS / cells * f64::from(options.cells_per_radius())).ceil();
        let refusal = Refusal::new(format!("the projectile is {cells:.2} cells long"));
        return Some(
            refusal.with_remedy(format!("give `axi.cells_per_radius = {needed}` or more")),
        );
    }
    let materials: Vec<(&Material, &str)> = materials(scenario).collect();
    if options.equation_of_state == Some(Eos::MieGruneisen) {
        let lacking = materials
            .iter()
            .find(|(m, _)| m.equation_of_state.is_none());
        if let Some((_, id)) = lacking {
            return Some(Refusal::new(format!(
                "`axi.equation_of_state = \"mie-gruneisen\"` needs an equation of state, and the material `{id}` has none"
            )));
        }
    }
    if options.damage == Some(true) && materials.iter().all(|(m, _)| m.damage.is_none()) {
        return Some(
            "`axi.damage = true` needs a material that has a `damage` table, and none has one"
                .into(),
        );
    }
    let spalls = options.spalls() && options.spall_strength.is_none();
    if spalls && materials.iter().all(|(m, _)| m.spall_strength.is_none()) {
        let reason =
            "`axi.spall = true` needs a material that has a `spall_strength`, and none has one";
        return Some(Refusal::new(reason).with_remedy("give one, or `axi.spall_strength`"));
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

impl<'a> Solver<'a> for Axisymmetric<'a> {
    const NAMES: (&'static str, &'static str) = ("axi", "material-point");
    const AUDIT: Audit = Audit {
        interval: 1,
        report_interval: 10,
        tolerance: BalanceTolerance {
            energy: 1e-2,
            momentum: 1e-9,
        },
        retry: Retry::OfAnyError {
            smallest: SMALLEST_COURANT,
        },
    };

    fn build(
        scenario: &'a Scenario,
        courant: f64,
        control: &mut Control<'_>,
    ) -> Result<Self, Error> {
        let grid = build(scenario, courant, control)?;
        let rows = match scenario.gauges.is_empty() {
            true => Vec::new(),
            false => axial::profile(&grid).elements,
        };
        let gauges = scenario.gauges.iter();
        Ok(Self {
            gauge_bodies: gauges
                .clone()
                .map(|place| Gauge::new(place, &rows).part)
                .collect(),
            gauges: gauges.map(|place| place.position).collect(),
            scenario,
            touches: grid.deferred.contact_force > 0.0,
            grid,
            window: Window::default(),
            floor: Floor::new(scenario.projectile.nose, scenario.projectile.diameter),
            depth: 0.0,
            floor_stopped: false,
            before: 0.0,
        })
    }

    fn size(&self) -> usize {
        self.grid.bodies.iter().map(Body::len).sum()
    }

    fn courant(scenario: &Scenario) -> (Option<f64>, f64) {
        (
            scenario.options.axi.courant,
            AxiOptions::default().courant(),
        )
    }

    fn limits(&self) -> Limits {
        let options = &self.scenario.options.axi;
        Limits::new(self.scenario, options.end_time, options.max_steps())
            .or_at_rest(self.scenario, options.end_at_rest())
    }

    fn advance(&mut self) -> Result<(), NumericalError> {
        self.before = self.grid.time;
        if self.grid.advance() {
            return Ok(());
        }
        Err(self.clock().failure(
            "the state of a particle is not finite".to_owned(),
            "lower `axi.courant`".to_owned(),
        ))
    }

    fn clock(&self) -> Clock {
        Clock {
            step: self.grid.step,
            time: self.grid.time,
            time_step: self.grid.time_step,
        }
    }

    fn probe(&mut self, monitor: &RunMonitor) -> Probe {
        let grid = &self.grid;
        let places = self.scenario.gauges.iter();
        let gauges = self.gauges.iter_mut().zip(&self.gauge_bodies).zip(places);
        for ((gauge, &body), _) in gauges.filter(|(_, place)| !place.fixed) {
            let velocity = crater::axis_velocity(&grid.bodies[body], *gauge, &grid.mesh);
            *gauge += velocity * (grid.time - self.before);
        }
        let before = self.depth;
        if grid.bodies.len() > 1 {
            let elapsed = grid.time - self.before;
            self.floor.follow(&grid.bodies[1], &grid.mesh, elapsed);
            if !is_held(self.scenario) && self.scenario.rear_face() == Some(RearFaceCondition::Free)
            {
                let layers = grid.sums[1..].iter();
                let sum = layers.fold((0.0, 0.0), |(mass, momentum), layer| {
                    (mass + layer.mass, momentum + layer.momentum)
                });
                self.floor.fly(sum, elapsed);
            }
            let tip = || {
                let pushes = self.touches.then_some(&grid.bodies[0])?;
                crater::ends(pushes, &grid.mesh).map(|(_, tip)| tip)
            };
            match self.floor.depth(&grid.bodies[1..], &grid.mesh, tip) {
                Some(depth) => self.depth = depth,
                None => self.window.perforated = true,
            }
            let thickness = self.scenario.target_thickness();
            self.window.perforated |= thickness.is_some_and(|thickness| self.depth >= thickness);
        }
        // Debris of an eroding rod flies back while the rod goes on: its floor must have stopped too.
        self.floor_stopped = self.depth <= before;
        let force = grid.deferred.contact_force;
        let touched = self.touches;
        self.touches = force > TOUCHING_FRACTION * monitor.peak_force.max(force);
        Probe {
            depth: self.depth,
            contact_force: force,
            contact_time: if touched {
                grid.time - self.before
            } else {
                0.0
            },
        }
    }

    fn is_at_rest(&self) -> bool {
        self.floor_stopped && self.grid.sums[0].momentum <= 0.0
    }

    fn energy(&self) -> EnergyLedger {
        self.grid.energy()
    }

    fn momentum(&self) -> MomentumLedger {
        self.grid.momentum()
    }

    fn progress(&self) -> f64 {
        let projectile = &self.grid.sums[0];
        let speed = self.scenario.impact_velocity;
        let slowed = slowed((projectile.mass, projectile.momentum), speed);
        // A plate slows its projectile but a little: there the way through it counts.
        let passed = self.scenario.target_thickness().map_or(0.0, |thickness| {
            let way = thickness + self.scenario.projectile.length;
            self.grid.time * speed / (2.0 * way)
        });
        slowed.max(passed).min(1.0)
    }

    fn event(&mut self, monitor: &RunMonitor) -> Result<Option<Termination>, NumericalError> {
        Ok(self.window.end(&self.grid, self.scenario, monitor))
    }

    fn sample(&self, _: &RunMonitor) -> Sample {
        axial::sample(&self.grid, self.depth, self.floor.flight())
    }

    fn gauges(&self, gauges: &[Gauge]) -> Vec<ElementState> {
        if gauges.is_empty() {
            return Vec::new();
        }
        let rows = axial::profile(&self.grid).elements;
        let places = gauges.iter().zip(&self.gauges).zip(&self.gauge_bodies);
        places
            .map(|((gauge, &position), &body)| match gauge.fixed {
                true => axial::at_place(&rows, body, position),
                false => axial::at_gauge(&rows, body, position, gauge.position),
            })
            .collect()
    }

    fn profile(&self) -> Profile {
        axial::profile(&self.grid)
    }

    fn fields(&self) -> Fields<'_> {
        let bodies = self.grid.bodies.iter();
        Fields::Particles {
            cell: self.grid.mesh.cell,
            bodies: bodies.map(|body| body.particles().collect()).collect(),
            bonds: Bonds::default(),
            across: None,
        }
    }

    fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        archive.item(&mut self.window)?;
        archive.item(&mut self.floor)?;
        archive.item(&mut self.depth)?;
        archive.item(&mut self.touches)?;
        archive.item(&mut self.gauges)?;
        self.grid.archive(archive)
    }

    fn outcome(&self, termination: Termination, monitor: &RunMonitor) -> (Outcome, String) {
        let impact_velocity = self.scenario.impact_velocity;
        let outcome = self
            .window
            .outcome(termination, &self.grid, monitor, impact_velocity);
        (outcome, String::new())
    }

    fn extremes(&self) -> Extremes {
        results::extremes(&self.grid)
    }

    fn complete(&self, result: &mut RunResult, monitor: &RunMonitor) {
        results::complete(self, result, monitor);
    }
}
