//! Bodies of a case: which one is a lattice, its rows and its memory.

use super::{
    body::{Body, Rows},
    lattice::{ROW, Solid, poissons_ratio_refusal},
    shape::{Rigid, Shape},
};
use crate::{
    Refusal, Scenario,
    material::{Material, Strength},
    options::ParticlesOptions,
    problem::RearFaceCondition,
    scenario::{Plate, TargetBody},
};

/// Spacings across the thinner of diameter and thickness, unless the case gives a spacing.
const SPACINGS: f64 = 10.0;
/// Width of a target in diameters of the projectile and in thicknesses, unless the case gives it.
const WIDTH_IN_DIAMETERS: f64 = 10.0;
const WIDTH_IN_THICKNESSES: f64 = 4.0;
/// Memory of a particle with the fields that show it [bytes].
const PARTICLE: f64 = 350.0;
/// Rows of triangles, and triangles along a row, of the smallest body.
const LEAST: f64 = 2.0;

/// The body that is a lattice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Extent {
    /// Size along the direction of impact [m].
    pub(super) length: f64,
    /// Size across it [m].
    pub(super) width: f64,
    /// Depth of its first row [m].
    pub(super) start: f64,
    /// Distance of particles that is asked for [m].
    spacing: f64,
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
    if layer(scenario).is_some() && !matches!(material.strength, Strength::Elastic(_)) {
        let reason = format!(
            "it has no plastic flow yet, and the target's material `{id}` yields: it takes targets of the strength law `elastic`"
        );
        return Some(Refusal::new(reason).with_remedy("use the model `axi` or `chain`"));
    }
    if scenario.rear_face() == Some(RearFaceCondition::NonReflecting) {
        let reason = "it has no non-reflecting rear face";
        let remedy = "give `target.back_face` as \"free\" or \"fixed\", and a thickness from which no wave returns in time";
        return Some(Refusal::new(reason).with_remedy(remedy));
    }
    let space = scenario.options.particles.space();
    poissons_ratio_refusal(space, material.poissons_ratio, id)
}

/// Size of the lattice of a case.
pub(super) fn extent(scenario: &Scenario) -> Extent {
    let rod = &scenario.projectile;
    let options: &ParticlesOptions = &scenario.options.particles;
    let spacing = |length: f64| {
        let default = rod.diameter.min(length) / SPACINGS;
        options.spacing.map_or(default, |spacing| spacing.si())
    };
    match scenario.target_thickness() {
        Some(thickness) => {
            let default = (WIDTH_IN_DIAMETERS * rod.diameter).max(WIDTH_IN_THICKNESSES * thickness);
            Extent {
                length: thickness,
                width: options.width.map_or(default, |width| width.si()),
                start: 0.0,
                spacing: spacing(thickness),
            }
        }
        None => Extent {
            length: rod.length,
            width: rod.diameter,
            start: -rod.length,
            spacing: spacing(rod.length),
        },
    }
}

impl Extent {
    /// Layers of triangles along the direction of impact.
    fn layers(&self) -> f64 {
        (self.length / (ROW * self.spacing) - 1e-9)
            .ceil()
            .max(LEAST)
    }

    /// Distance of particles: whole layers of triangles fill the length [m].
    pub(super) fn spacing(&self) -> f64 {
        self.length / (ROW * self.layers())
    }

    /// Particles of an even row: two of them and an odd row between bound triangles of this mean width.
    fn columns(&self) -> f64 {
        (self.width / self.spacing() + 1.5).round().max(LEAST + 1.0)
    }

    /// Number of particles.
    pub(super) fn particles(&self) -> f64 {
        (self.layers() + 1.0) * self.columns()
    }
}

/// Memory of a run [bytes].
pub(super) fn memory(scenario: &Scenario) -> f64 {
    PARTICLE * extent(scenario).particles()
}

/// The lattice at the moment of impact, and the rigid body that it meets.
pub(super) fn build(scenario: &Scenario) -> (Body, Rigid) {
    let extent = extent(scenario);
    let (material, _) = material(scenario);
    let solid = Solid {
        density: material.density.si(),
        youngs_modulus: material.youngs_modulus.si(),
        poissons_ratio: material.poissons_ratio,
    };
    let lattice = solid.lattice(scenario.options.particles.space(), extent.spacing());
    let rows = Rows {
        count: extent.layers() as usize + 1,
        particles: extent.columns() as usize,
    };
    let mut body = Body::strip(lattice, rows, extent.start);
    if layer(scenario).is_none() {
        body.launch(scenario.impact_velocity);
        return (body, Rigid::Wall);
    }
    body.held = scenario.rear_face() == Some(RearFaceCondition::Fixed);
    let shape = Shape {
        nose: scenario.projectile.nose,
        radius: 0.5 * scenario.projectile.diameter,
    };
    (body, Rigid::Projectile(shape))
}
