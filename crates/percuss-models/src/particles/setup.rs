//! Bodies of a case: which one is a lattice, its rows and its memory.

use super::{
    body::{Body, Rows},
    cubic::{Cubic, LAYER},
    flight::{Flight, Inertia},
    fracture::{self, BondKind, Softening, Softenings, Toughness},
    lattice::{Lattice, ROW, Solid, poissons_ratio_refusal},
    packing::{Moved, Packing},
    shape::{Rigid, Shape},
    slot::Slot,
    stress,
};
use crate::{
    Error, Refusal, Scenario,
    material::{Material, Strength},
    options::{Outline, PackingKind, ParticlesOptions, Space},
    problem::RearFaceCondition,
    scenario::{Plate, TargetBody},
    solver::{Control, limits::Limits},
    units::Length,
};

/// Ways of a longitudinal wave across a body that breaks, after which its run ends where the case gives no time.
const WAYS: f64 = 10.0;
/// Ways along a strip on a wall, for the estimate of its run.
const WAYS_ON_WALL: f64 = 8.0;
/// Spacings across the thinner of diameter and thickness, unless the case gives a spacing.
const SPACINGS: f64 = 10.0;
/// Width of a target in diameters of the projectile and in thicknesses, unless the case gives it.
const WIDTH_IN_DIAMETERS: f64 = 10.0;
const WIDTH_IN_THICKNESSES: f64 = 4.0;
/// Rows of triangles, and triangles along a row, of the smallest body.
const LEAST: f64 = 2.0;

/// The body that is a lattice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Extent {
    /// Size along the normal of the struck face [m].
    pub(super) length: f64,
    /// Size across it [m].
    pub(super) width: f64,
    /// Depth of its first row [m].
    pub(super) start: f64,
    /// Distance of particles that is asked for [m].
    spacing: f64,
    /// Whether it is a body in space.
    in_space: bool,
}

/// The layer of the target, if it has one.
fn layer(scenario: &Scenario) -> Option<&Plate> {
    match &scenario.target {
        TargetBody::Layers { layers, .. } => layers.first(),
        _ => None,
    }
}

/// Material of the lattice, with its id.
pub(super) fn material(scenario: &Scenario) -> (&Material, &str) {
    match layer(scenario) {
        Some(plate) => (&plate.material, &plate.material_id),
        None => (
            &scenario.projectile.material,
            &scenario.projectile.material_id,
        ),
    }
}

/// Why a case inside the validity domain gets no number, if it does not.
pub(super) fn not_applicable(scenario: &Scenario) -> Option<Refusal> {
    let (material, id) = material(scenario);
    let has_stress = stress::is_meant(scenario);
    if has_stress && let Some(refusal) = stress::not_applicable(scenario) {
        return Some(refusal);
    }
    let yields = !matches!(material.strength, Strength::Elastic(_));
    if layer(scenario).is_some() && yields && !has_stress {
        let reason = format!(
            "springs have no plastic flow, and the target's material `{id}` yields: they take targets of the strength law `elastic`"
        );
        let remedy = "give `particles.formulation = \"particle-stress\"` in plane strain; or use the model `axi` or `chain`";
        return Some(Refusal::new(reason).with_remedy(remedy));
    }
    if layer(scenario).is_some() && scenario.target_thickness().is_none() {
        let reason = "a semi-infinite target is computed under a ball with `particles.contact = \"hertz\"` alone";
        let remedy = "give the target a thickness";
        return Some(Refusal::new(reason).with_remedy(remedy));
    }
    if scenario.rear_face() == Some(RearFaceCondition::NonReflecting) {
        let reason = "it has no non-reflecting rear face";
        let remedy = "give `target.back_face` as \"free\" or \"fixed\", and a thickness from which no wave returns in time";
        return Some(Refusal::new(reason).with_remedy(remedy));
    }
    if scenario.options.particles.fracture == Some(true) && material.fracture.is_none() {
        let reason = format!(
            "`particles.fracture = true` needs the fracture energy and the tensile strength of the material `{id}`"
        );
        let remedy = "give the material a table `fracture` with `energy` and `tensile_strength`, or remove the option";
        return Some(Refusal::new(reason).with_remedy(remedy));
    }
    if scenario.options.particles.notches.is_some() && toughness(scenario).is_none() {
        let reason = "`particles.notches` needs bonds that break: the faces of a notch meet as those of a crack";
        let remedy = format!(
            "give the material `{id}` a table `fracture` with `energy` and `tensile_strength`, remove `particles.fracture = false`, or \
             remove the notches"
        );
        return Some(Refusal::new(reason).with_remedy(remedy));
    }
    if let Some(refusal) = without_effect(scenario) {
        return Some(refusal);
    }
    if scenario.obliquity != 0.0 && layer(scenario).is_none() {
        let reason = "a lattice on a rigid wall takes normal impact alone";
        let remedy = "remove `projectile.obliquity`, or give a plate as the target";
        return Some(Refusal::new(reason).with_remedy(remedy));
    }
    if has_stress {
        return None;
    }
    let space = scenario.options.particles.space();
    poissons_ratio_refusal(space, material.poissons_ratio, id)
}

/// Why keys of bonds that break do not apply to a material without a fracture energy, if some are given.
fn without_effect(scenario: &Scenario) -> Option<Refusal> {
    let (material, id) = material(scenario);
    if material.fracture.is_some() {
        return None;
    }
    let options = &scenario.options.particles;
    let irregular = packing(scenario) != Packing::Regular;
    let given = [
        ("softening", options.softening.is_some()),
        ("failure_criterion", options.failure_criterion.is_some()),
        ("restitution", options.restitution.is_some()),
        ("friction", options.friction.is_some()),
        ("amplitude", options.amplitude.is_some() && !irregular),
        ("seed", options.seed.is_some() && !irregular),
    ];
    let (key, _) = given.into_iter().find(|(_, given)| *given)?;
    let reason = format!(
        "`particles.{key}` has no effect: no bond breaks, as the material `{id}` has no table `fracture`"
    );
    let remedy = "give the material a table `fracture` with `energy` and `tensile_strength`, or remove the key";
    Some(Refusal::new(reason).with_remedy(remedy))
}

/// Size of the lattice of a case.
pub(super) fn extent(scenario: &Scenario) -> Extent {
    let rod = &scenario.projectile;
    let options: &ParticlesOptions = &scenario.options.particles;
    let in_space = options.space() == Space::ThreeDimensional;
    let spacing = |length: f64| {
        let default = rod.diameter.min(length) / SPACINGS;
        options.spacing.map_or(default, |spacing| spacing.si())
    };
    match scenario.target_thickness() {
        Some(thickness) => {
            let default = match options.outline() {
                Outline::Disc | Outline::Ball => thickness,
                Outline::Plate => {
                    (WIDTH_IN_DIAMETERS * rod.diameter).max(WIDTH_IN_THICKNESSES * thickness)
                }
            };
            Extent {
                length: thickness,
                width: options.width.map_or(default, |width| width.si()),
                start: 0.0,
                spacing: spacing(thickness),
                in_space,
            }
        }
        None => Extent {
            length: rod.length,
            width: rod.diameter,
            start: -rod.length,
            spacing: spacing(rod.length),
            in_space,
        },
    }
}

impl Extent {
    /// Distance of rows or layers over that of particles.
    fn row(&self) -> f64 {
        if self.in_space { LAYER } else { ROW }
    }

    /// Rows or layers less one.
    pub(super) fn layers(&self) -> f64 {
        (self.length / (self.row() * self.spacing) - 1e-9)
            .ceil()
            .max(LEAST)
    }

    /// Distance of particles: whole layers fill the length [m].
    pub(super) fn spacing(&self) -> f64 {
        self.length / (self.row() * self.layers())
    }

    /// Particles of an even row: in a plane two of them and an odd row between bound triangles of this mean width.
    pub(super) fn columns(&self) -> f64 {
        let columns = match self.in_space {
            true => self.width / (2.0 * self.row() * self.spacing()) + 1.0,
            false => self.width / self.spacing() + 1.5,
        };
        columns.round().max(LEAST + 1.0)
    }

    /// Number of particles.
    pub(super) fn particles(&self) -> f64 {
        let (layers, columns) = (self.layers() + 1.0, self.columns());
        match self.in_space {
            true => 0.5 * layers * (columns.powi(2) + (columns - 1.0).powi(2)),
            false => layers * columns,
        }
    }
}

/// Time step [s], expected duration [s] and limits of a run before it starts.
pub(super) fn expected(scenario: &Scenario) -> (f64, f64, Limits) {
    if stress::is_meant(scenario) {
        return stress::expected(scenario);
    }
    let options = &scenario.options.particles;
    let (solid, spacing) = (solid(scenario), extent(scenario).spacing());
    let (wave_speed, frequency) = match options.space() {
        Space::ThreeDimensional => {
            let lattice = Cubic::of(&solid, spacing);
            (lattice.wave_speed, lattice.largest_frequency())
        }
        plane => {
            let lattice = solid.lattice(plane, spacing);
            (lattice.wave_speed, lattice.largest_frequency())
        }
    };
    let time_step = options.courant() * 2.0 / frequency;
    let end = match layer(scenario) {
        Some(_) => time_of_cracks(scenario, wave_speed),
        None => WAYS_ON_WALL * extent(scenario).length / wave_speed,
    };
    let breaks = toughness(scenario).is_some();
    (time_step, end, limits(scenario, wave_speed, breaks))
}

/// Limits of a run, whose bonds break or not.
pub(super) fn limits(scenario: &Scenario, wave_speed: f64, breaks: bool) -> Limits {
    let options = &scenario.options.particles;
    let mut limits = Limits::new(scenario, options.end_time, options.max_steps());
    if breaks && options.end_time.is_none() {
        limits.end_time = limits.end_time.min(time_of_cracks(scenario, wave_speed));
    }
    limits
}

/// Resistance to cracks of the lattice's material, if its bonds break.
pub(super) fn toughness(scenario: &Scenario) -> Option<Toughness> {
    let fracture = material(scenario).0.fracture.as_ref()?;
    let breaks = scenario.options.particles.fracture != Some(false) && !stress::is_meant(scenario);
    breaks.then(|| Toughness {
        energy: fracture.energy.si(),
        strength: fracture.tensile_strength.si(),
    })
}

pub(super) fn packing(scenario: &Scenario) -> Packing {
    let options = &scenario.options.particles;
    let default = match toughness(scenario) {
        Some(_) => PackingKind::Irregular,
        None => PackingKind::Hexagonal,
    };
    match options.packing.unwrap_or(default) {
        PackingKind::Hexagonal | PackingKind::Cubic => Packing::Regular,
        PackingKind::Irregular => Packing::Irregular(Moved {
            amplitude: options.amplitude(),
            seed: options.seed(),
        }),
    }
}

fn bonds(scenario: &Scenario) -> BondKind {
    BondKind {
        irregular: packing(scenario) != Packing::Regular,
        criterion: scenario.options.particles.failure_criterion(),
    }
}

pub(super) fn solid(scenario: &Scenario) -> Solid {
    let (material, _) = material(scenario);
    Solid {
        density: material.density.si(),
        youngs_modulus: material.youngs_modulus.si(),
        poissons_ratio: material.poissons_ratio,
    }
}

/// Softening of a plane case's bonds, if they break.
pub(super) fn softenings(scenario: &Scenario, lattice: &Lattice) -> Option<Softenings> {
    let toughness = toughness(scenario)?;
    let options = &scenario.options.particles;
    let solid = (solid(scenario), options.space());
    let bonds = bonds(scenario);
    Some(Softenings::of(
        fracture::exact_product(solid, lattice, toughness),
        |softening| fracture::lattice_factor(bonds, softening),
        options.softening,
    ))
}

/// Whether the case has a plate as its target, and a rigid projectile.
pub(super) fn is_plate(scenario: &Scenario) -> bool {
    layer(scenario).is_some()
}

/// Whether the target is a disc.
pub(super) fn is_disc(scenario: &Scenario) -> bool {
    layer(scenario).is_some() && scenario.options.particles.outline() == Outline::Disc
}

/// Time in which cracks have run through a body that breaks, and the projectile has gone its thickness at the speed of the impact [s].
fn time_of_cracks(scenario: &Scenario, wave_speed: f64) -> f64 {
    let size = extent(scenario);
    let waves = WAYS * size.length.max(size.width) / wave_speed;
    let speed = scenario.impact_velocity * scenario.obliquity.cos();
    waves + size.length / speed.max(1.0)
}

/// Ends of the notches of a case [m].
fn notch_ends(scenario: &Scenario) -> Vec<[[f64; 2]; 2]> {
    let notches = scenario.options.particles.notches.iter().flatten();
    notches.map(|notch| notch.ends()).collect()
}

/// The notches of a case that are slots.
fn slots(scenario: &Scenario) -> Vec<Slot> {
    let notches = scenario.options.particles.notches.iter().flatten();
    notches
        .filter_map(|notch| Some(Slot::new(notch.ends(), notch.width?.si())))
        .collect()
}

/// Numbers, from 1, of slots narrower than the particles are apart: their faces touch.
pub(super) fn narrow_slots(scenario: &Scenario, spacing: f64) -> Vec<usize> {
    let notches = scenario.options.particles.notches.iter().flatten();
    let is_narrow = |width: Option<Length>| width.is_some_and(|width| width.si() < spacing);
    let narrow = notches
        .enumerate()
        .filter(|(_, notch)| is_narrow(notch.width));
    narrow.map(|(index, _)| index + 1).collect()
}

/// Motion of the projectile at the moment of impact.
pub(super) fn flight(scenario: &Scenario, inertia: &Inertia) -> Flight {
    Flight::at_impact(
        &shape(scenario),
        inertia,
        scenario.impact_velocity,
        scenario.obliquity,
    )
}

/// Outline of the projectile.
pub(super) fn shape(scenario: &Scenario) -> Shape {
    Shape {
        nose: scenario.projectile.nose,
        radius: 0.5 * scenario.projectile.diameter,
        length: scenario.projectile.length,
    }
}

/// The lattice at the moment of impact, and the rigid body that it meets.
///
/// # Errors
/// [`Error::Cancelled`].
pub(super) fn build(
    scenario: &Scenario,
    control: &mut Control<'_>,
) -> Result<(Body, Rigid), Error> {
    let extent = extent(scenario);
    let packing = packing(scenario);
    let mut lattice = solid(scenario).lattice(scenario.options.particles.space(), extent.spacing());
    if let Packing::Irregular(moved) = packing
        && !stress::is_meant(scenario)
    {
        lattice = moved.tuned(&lattice);
    }
    let rows = Rows {
        count: extent.layers() as usize + 1,
        particles: extent.columns() as usize,
    };
    let mut body = match is_disc(scenario) {
        true => Body::disc(lattice, rows, packing, control)?,
        false => {
            let slots = slots(scenario);
            Body::slotted_strip(lattice, rows, extent.start, packing, &slots, control)?
        }
    };
    if let (Some(toughness), Some(softenings)) =
        (toughness(scenario), softenings(scenario, &lattice))
    {
        let bonds = bonds(scenario);
        let softening = Softening::new(&lattice, toughness.energy, softenings.used, bonds);
        body.soften(softening, control)?;
    }
    for ends in notch_ends(scenario) {
        control.ask()?;
        body.cut(ends);
    }
    if layer(scenario).is_none() {
        body.launch(scenario.impact_velocity);
        return Ok((body, Rigid::Wall));
    }
    if scenario.rear_face() == Some(RearFaceCondition::Fixed) {
        // A disc stands on a support as wide as the projectile.
        body.hold_rear(match scenario.options.particles.outline() {
            Outline::Plate => f64::INFINITY,
            Outline::Disc | Outline::Ball => 0.5 * scenario.projectile.diameter,
        });
    }
    Ok((body, Rigid::Projectile(shape(scenario))))
}
