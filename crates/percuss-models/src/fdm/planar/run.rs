//! Geometry `planar` as a solver.

use serde::{Deserialize, Serialize};

use super::{column::Medium, interface::InterfaceForce, law::PlanarLaw, results};
use crate::{
    Error, Refusal, Scenario,
    error::NumericalError,
    fdm::{
        audit::{self, AUDIT},
        grid::{BoundaryCondition, Grid, Slab},
    },
    history::{PROFILE_ELEMENTS, Profile, Sample},
    ledger::{EnergyLedger, MomentumLedger},
    material::{Library, Material},
    options::{FdmOptions, MAX_STEPS},
    outcome::{Outcome, RunResult, Termination},
    problem::RearFaceCondition,
    scenario::{TargetBody, modelled_thickness},
    solver::{
        Control,
        archive::Archive,
        driver::Drive,
        frames::Fields,
        interface::{Audit, Extremes, Solver},
        limits::Limits,
        monitor::{Clock, Probe, RunMonitor},
    },
};

/// Passages of a wave through both bodies that a run lasts when a case gives no end.
const PASSAGES: f64 = 3.0;
/// Most cells of a target whose cells are to be as long as the projectile's.
const MOST_CELLS: f64 = 20_000.0;

/// Motion of the rear face: whether it is one that can move freely, its largest speed, and the smallest one after that.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(super) struct BackFaceMotion {
    pub(super) free: bool,
    pub(super) largest: f64,
    pub(super) smallest_after: f64,
}

impl BackFaceMotion {
    fn follow(&mut self, speed: f64) {
        if speed > self.largest {
            self.largest = speed;
            self.smallest_after = speed;
        }
        self.smallest_after = self.smallest_after.min(speed);
    }
}

/// Why the geometry does not apply to a case, if it does not.
pub(in crate::fdm) fn not_applicable(scenario: &Scenario) -> Option<Refusal> {
    let rod = &scenario.projectile;
    let mut materials = vec![("projectile", &rod.material_id, &rod.material)];
    match &scenario.target {
        TargetBody::ConstantPressure(_) => {
            return Some("geometry `planar` takes layers or a rigid wall, and this target is a constant pressure".into());
        }
        TargetBody::RigidWall => {}
        TargetBody::Layers { layers, .. } => {
            let layers = layers
                .iter()
                .map(|plate| ("target", &plate.material_id, &plate.material));
            materials.extend(layers);
        }
    }
    for (what, id, material) in materials {
        if material.equation_of_state.is_none() {
            let reason = format!(
                "geometry `planar` needs a shock equation of state, and the {what}'s material `{id}` has none"
            );
            return Some(Refusal::new(reason).with_remedy(format!(
                "add `[materials.NAME.equation_of_state]` with sound_speed, slope and gruneisen, or take one of {}",
                with_equation_of_state().join(", ")
            )));
        }
    }
    let law = law(&rod.material, scenario)?;
    let ratio = rod.length / rod.diameter;
    (ratio > 0.5).then(|| {
        let speed = law.wave_speed_at_rest();
        Refusal::new(format!(
            "geometry `planar` is uniaxial strain, and this projectile is {ratio:.2} diameters long: release from its edge \
             reaches the axis after {:.2} us, before a wave has crossed it once ({:.2} us); uniaxial strain needs a \
             projectile shorter than half its diameter",
            0.5 * rod.diameter / speed * 1e6,
            rod.length / speed * 1e6
        ))
    })
}

/// Ids of the built-in materials that have an equation of state.
fn with_equation_of_state() -> Vec<String> {
    let library = Library::built_in();
    let with = library
        .iter()
        .filter(|entry| entry.material.equation_of_state.is_some());
    with.map(|entry| entry.id.clone()).collect()
}

fn law(material: &Material, scenario: &Scenario) -> Option<PlanarLaw> {
    let (options, chain) = (&scenario.options.fdm, &scenario.options.chain);
    let mut medium = Medium::of(material)?;
    if let Some(strength) = options.spall_strength {
        medium.spall_strength = Some(strength.si());
    }
    let viscosity = (options.artificial_viscosity).unwrap_or(FdmOptions::PLANAR_VISCOSITY);
    let heats = chain.adiabatic_heating();
    Some(PlanarLaw {
        heat_fraction: if heats { chain.heat_fraction() } else { 0.0 },
        rate_effects: chain.rate_effects(),
        ..medium.law(scenario.projectile.area(), viscosity)
    })
}

/// Cells along the projectile and through the target.
pub(in crate::fdm) fn cells(scenario: &Scenario) -> (u32, u32) {
    let options = &scenario.options.fdm;
    let projectile = options
        .projectile_elements
        .unwrap_or(FdmOptions::PLANAR_ELEMENTS);
    let size = scenario.projectile.length / f64::from(projectile);
    let natural = (scenario.modelled_length() / size)
        .ceil()
        .clamp(1.0, MOST_CELLS);
    (
        projectile,
        options.target_elements.unwrap_or(natural as u32),
    )
}

fn slab(law: PlanarLaw, start: f64, length: f64, cells: usize) -> Slab<PlanarLaw> {
    Slab {
        line_density: law.start_density * law.area,
        line_friction: 0.0,
        start,
        length,
        cells,
        velocity: 0.0,
        law,
    }
}

/// The grid at the moment of impact, the time that waves take through all of it [s], and the force on the struck face.
fn build(scenario: &Scenario) -> Option<(Grid<PlanarLaw>, f64, InterfaceForce)> {
    let rod = &scenario.projectile;
    let (projectile, target) = cells(scenario);
    let flyer = law(&rod.material, scenario)?;
    let mut passage = rod.length / flyer.wave_speed_at_rest();
    let mut slabs = vec![slab(flyer, -rod.length, rod.length, projectile as usize)];
    slabs[0].velocity = scenario.impact_velocity;
    let mut end = BoundaryCondition::Driven(0.0);
    match &scenario.target {
        TargetBody::Layers {
            layers, back_face, ..
        } => {
            let total = scenario.modelled_length();
            let mut start = 0.0;
            for plate in layers {
                let law = law(&plate.material, scenario)?;
                let thickness = modelled_thickness(plate, scenario);
                passage += thickness / law.wave_speed_at_rest();
                let cells = (f64::from(target) * thickness / total).round().max(1.0);
                if *back_face == RearFaceCondition::NonReflecting {
                    let impedance = law.start_density * law.wave_speed_at_rest();
                    end = BoundaryCondition::Dashpot(impedance * law.area);
                }
                slabs.push(slab(law, start, thickness, cells as usize));
                start += thickness;
            }
            if *back_face == RearFaceCondition::Free {
                end = BoundaryCondition::Free;
            }
        }
        _ => slabs.push(slab(law(&rod.material, scenario)?, 0.0, 0.0, 0)),
    }
    let interface = InterfaceForce::new(&slabs, scenario.impact_velocity);
    Some((
        Grid::new(slabs, [BoundaryCondition::Free, end]),
        passage,
        interface,
    ))
}

/// Limits of a run whose waves take a time through all of it [s].
fn limits(scenario: &Scenario, passage: f64) -> Limits {
    let options = &scenario.options.fdm;
    let max_steps = options.max_steps.unwrap_or(MAX_STEPS);
    let mut limits = Limits::new(scenario, options.end_time, max_steps);
    if options.end_time.is_none() {
        limits.end_time = PASSAGES * passage;
    }
    limits
}

/// Time step [s] and limits of a run before it starts.
pub(in crate::fdm) fn expected(scenario: &Scenario) -> (f64, Limits) {
    let rod = &scenario.projectile;
    let (projectile, target) = cells(scenario);
    let speed = |material: &Material| {
        law(material, scenario).map_or(f64::NAN, |law| law.wave_speed_at_rest())
    };
    let of_rod = rod.length / speed(&rod.material);
    let (mut passage, mut step) = (of_rod, of_rod / f64::from(projectile));
    if let TargetBody::Layers { layers, .. } = &scenario.target {
        let size = scenario.modelled_length() / f64::from(target);
        for plate in layers {
            let speed = speed(&plate.material);
            passage += modelled_thickness(plate, scenario) / speed;
            step = step.min(size / speed);
        }
    }
    (
        scenario.options.fdm.courant() * step,
        limits(scenario, passage),
    )
}

/// Projectile and target in uniaxial strain.
#[derive(Debug)]
pub(in crate::fdm) struct PlanarImpact<'a> {
    pub(super) scenario: &'a Scenario,
    pub(super) grid: Grid<PlanarLaw>,
    pub(super) interface: InterfaceForce,
    pub(super) back: BackFaceMotion,
    courant: f64,
    limits: Limits,
    /// Time before the last step [s].
    before: f64,
}

/// A run in the geometry `planar`.
pub(in crate::fdm) type PlanarRun<'a> = Drive<'a, PlanarImpact<'a>>;

impl<'a> Solver<'a> for PlanarImpact<'a> {
    const NAMES: (&'static str, &'static str) = ("fdm", "planar");
    const AUDIT: Audit = AUDIT;

    fn build(scenario: &'a Scenario, courant: f64, _: &mut Control<'_>) -> Result<Self, Error> {
        let refuse = || Error::not_applicable("fdm", not_applicable(scenario).unwrap_or_default());
        let (grid, passage, interface) = build(scenario).ok_or_else(refuse)?;
        let back = BackFaceMotion {
            free: grid.ends[1] == BoundaryCondition::Free,
            ..BackFaceMotion::default()
        };
        Ok(Self {
            scenario,
            grid,
            interface,
            back,
            courant,
            limits: limits(scenario, passage),
            before: 0.0,
        })
    }

    fn size(&self) -> usize {
        self.grid.cells.len()
    }

    fn courant(scenario: &Scenario) -> (Option<f64>, f64) {
        (
            scenario.options.fdm.courant,
            FdmOptions::default().courant(),
        )
    }

    fn limits(&self) -> Limits {
        self.limits
    }

    fn advance(&mut self) -> Result<(), NumericalError> {
        self.before = self.grid.time;
        let left = self.limits.end_time - self.grid.time;
        self.grid.advance(self.courant, left)
    }

    fn clock(&self) -> Clock {
        self.grid.clock()
    }

    fn probe(&mut self, _: &RunMonitor) -> Probe {
        self.interface.follow(&self.grid, self.before);
        let last = self.grid.nodes.last().unwrap_or_default();
        self.back.follow(last.velocity);
        audit::probe(&self.grid, self.before)
    }

    fn is_at_rest(&self) -> bool {
        audit::is_at_rest(&self.grid, self.scenario.impact_velocity)
    }

    fn energy(&self) -> EnergyLedger {
        self.grid.energy()
    }

    fn momentum(&self) -> MomentumLedger {
        self.grid.momentum()
    }

    fn progress(&self) -> f64 {
        // The end is that of the time.
        0.0
    }

    fn check(&self, monitor: &RunMonitor) -> Result<(), NumericalError> {
        audit::check_time_step(&self.grid, monitor)
    }

    fn event(&mut self, _: &RunMonitor) -> Result<Option<Termination>, NumericalError> {
        if self.grid.time < self.limits.end_time * (1.0 - 1e-12) {
            return Ok(None);
        }
        let interface = self.grid.tip_segment();
        Ok(Some(match self.grid.closed.get(interface) {
            Some(false) => Termination::Parted,
            _ => Termination::EndTime,
        }))
    }

    fn sample(&self, _: &RunMonitor) -> Sample {
        self.grid.sample()
    }

    fn profile(&self) -> Profile {
        self.grid.profile(PROFILE_ELEMENTS)
    }

    fn fields(&self) -> Fields<'_> {
        Fields::Elements(self.grid.profile(usize::MAX).elements)
    }

    fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        self.interface.archive(archive)?;
        archive.item(&mut self.back)?;
        archive.item(&mut self.before)?;
        self.grid.archive(archive)
    }

    fn outcome(&self, termination: Termination, _: &RunMonitor) -> (Outcome, String) {
        (results::outcome(self, termination), String::new())
    }

    fn extremes(&self) -> Extremes {
        audit::extremes(&self.grid)
    }

    fn complete(&self, result: &mut RunResult, _: &RunMonitor) {
        results::complete(self, result);
    }
}
