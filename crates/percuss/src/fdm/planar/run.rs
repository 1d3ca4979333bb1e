//! A shot in the geometry `planar`.

use super::{
    DEFAULT_CELLS, DEFAULT_VISCOSITY,
    column::Medium,
    interface::InterfaceForce,
    law::PlanarLaw,
    results::{Ending, sum_up},
};
use crate::{
    Error, Scenario,
    fdm::grid::{AUDIT_INTERVAL, End, Grid, Slab, Watch},
    history::Recorder,
    material::{Library, Material},
    outcome::{RunResult, Termination},
    problem::BackFace,
    scenario::{TargetBody, modelled_thickness},
    solver::{Control, Progress},
};

const DEFAULT_COURANT: f64 = 0.7;
const DEFAULT_MAX_STEPS: u64 = 20_000_000;
/// Passages of a wave through both bodies that a run lasts when a case gives no end.
const PASSAGES: f64 = 3.0;
/// Most cells of a target whose cells are to be as long as the projectile's.
const MOST_CELLS: f64 = 20_000.0;

/// Motion of the back face: whether it is one that can move freely, its largest speed, and the smallest one after that.
#[derive(Debug, Clone, Copy, Default)]
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
pub(in crate::fdm) fn not_applicable(scenario: &Scenario) -> Option<String> {
    let rod = &scenario.projectile;
    let mut materials = vec![("projectile", &rod.material_id, &rod.material)];
    match &scenario.target {
        TargetBody::ConstantPressure(_) => {
            return Some("geometry `planar` takes layers or a rigid wall, and this target is a constant pressure".to_owned());
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
            return Some(format!(
                "geometry `planar` needs a shock equation of state, and the {what}'s material `{id}` has none: add \
                 `[materials.NAME.equation_of_state]` with sound_speed, slope and gruneisen, or take one of {}",
                with_equation_of_state().join(", ")
            ));
        }
    }
    let law = law(&rod.material, scenario)?;
    let ratio = rod.length / rod.diameter;
    (ratio > 0.5).then(|| {
        let speed = law.wave_speed_at_rest();
        format!(
            "geometry `planar` is uniaxial strain, and this projectile is {ratio:.2} diameters long: release from its edge \
             reaches the axis after {:.2} us, before a wave has gone through it once ({:.2} us); uniaxial strain needs a \
             projectile shorter than half its diameter",
            0.5 * rod.diameter / speed * 1e6,
            rod.length / speed * 1e6
        )
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
    let options = &scenario.options.fdm;
    let mut medium = Medium::of(material)?;
    if let Some(strength) = options.spall_strength {
        medium.spall_strength = Some(strength.si());
    }
    Some(medium.law(
        scenario.projectile.area(),
        options.artificial_viscosity.unwrap_or(DEFAULT_VISCOSITY),
        scenario.options.chain.rate_effects.unwrap_or(true),
    ))
}

/// Cells along the projectile and through the target.
pub(in crate::fdm) fn cells(scenario: &Scenario) -> (u32, u32) {
    let options = &scenario.options.fdm;
    let projectile = options.projectile_elements.unwrap_or(DEFAULT_CELLS);
    let size = scenario.projectile.length / f64::from(projectile);
    let natural = (target_length(scenario) / size)
        .ceil()
        .clamp(1.0, MOST_CELLS);
    (
        projectile,
        options.target_elements.unwrap_or(natural as u32),
    )
}

fn target_length(scenario: &Scenario) -> f64 {
    match &scenario.target {
        TargetBody::Layers { layers, .. } => layers
            .iter()
            .map(|plate| modelled_thickness(plate, scenario))
            .sum(),
        _ => 0.0,
    }
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
    slabs[0].velocity = scenario.impact_speed;
    let mut end = End::Driven(0.0);
    match &scenario.target {
        TargetBody::Layers {
            layers, back_face, ..
        } => {
            let total = target_length(scenario);
            let mut start = 0.0;
            for plate in layers {
                let law = law(&plate.material, scenario)?;
                let thickness = modelled_thickness(plate, scenario);
                passage += thickness / law.wave_speed_at_rest();
                let cells = (f64::from(target) * thickness / total).round().max(1.0);
                if *back_face == BackFace::NonReflecting {
                    let impedance = law.start_density * law.wave_speed_at_rest();
                    end = End::Dashpot(impedance * law.area);
                }
                slabs.push(slab(law, start, thickness, cells as usize));
                start += thickness;
            }
            if *back_face == BackFace::Free {
                end = End::Free;
            }
        }
        _ => slabs.push(slab(law(&rod.material, scenario)?, 0.0, 0.0, 0)),
    }
    let interface = InterfaceForce::new(&slabs, scenario.impact_speed);
    Some((Grid::new(slabs, [End::Free, end]), passage, interface))
}

/// Runs a case to which the geometry applies.
pub(in crate::fdm) fn run(
    scenario: &Scenario,
    control: &mut Control<'_>,
) -> Result<RunResult, Error> {
    let refuse = || Error::NotApplicable {
        model: "fdm",
        reason: not_applicable(scenario).unwrap_or_default(),
    };
    let (mut grid, passage, mut interface) = build(scenario).ok_or_else(refuse)?;
    let options = &scenario.options.fdm;
    let courant = options.courant.unwrap_or(DEFAULT_COURANT);
    let end_time = options
        .end_time
        .map_or(PASSAGES * passage, |time| time.si());
    let max_steps = options.max_steps.unwrap_or(DEFAULT_MAX_STEPS);
    let mut watch = Watch::default();
    let mut back = BackFaceMotion {
        free: grid.ends[1] == End::Free,
        ..BackFaceMotion::default()
    };
    let mut recorder = control.record.then(Recorder::new);
    record(&grid, &mut recorder);
    let termination = loop {
        if scenario.impact_speed == 0.0 {
            break Termination::NothingMoves;
        }
        let before = grid.time;
        grid.advance(courant, end_time - grid.time)?;
        interface.follow(&grid, before);
        watch.follow(&grid, scenario.impact_speed);
        back.follow(grid.nodes[grid.nodes.len() - 1].velocity);
        record(&grid, &mut recorder);
        if grid.step.is_multiple_of(AUDIT_INTERVAL) {
            watch.audit(&grid, courant)?;
            watch.check_time_step(&grid)?;
            control.report(Progress {
                step: grid.step,
                time: grid.time,
                fraction: (grid.time / end_time).clamp(0.0, 1.0),
                depth: grid.depth(),
            })?;
        }
        if grid.time >= end_time * (1.0 - 1e-12) {
            let interface = grid.tip_segment();
            break match grid.closed.get(interface) {
                Some(false) => Termination::Parted,
                _ => Termination::EndTime,
            };
        }
        if grid.step >= max_steps {
            break Termination::StepLimit;
        }
    };
    watch.audit(&grid, courant)?;
    let ending = Ending {
        scenario,
        grid: &grid,
        watch: &watch,
        termination,
        back,
        interface: &interface,
    };
    Ok(sum_up(&ending, recorder))
}

fn record(grid: &Grid<PlanarLaw>, recorder: &mut Option<Recorder>) {
    let Some(recorder) = recorder else { return };
    if recorder.wants_sample(grid.step) {
        recorder.sample(grid.sample());
    }
    if recorder.wants_profile(grid.step) {
        recorder.profile(grid.profile());
    }
}
