//! A case with its materials looked up and its quantities in SI units: what models run on.

use std::{f64::consts::PI, sync::Arc};

use crate::{
    analytic::{
        AwerbuchBodnerOptions, LambertJonasOptions, PlateCavityOptions, PluggingOptions,
        RechtIpsonOptions,
    },
    case::{BackFace, Case, ChainOptions, Layer, Nose, Thickness},
    check::{Check, limits},
    material::{Library, Material, MaterialEntry},
    units::{Length, Mass, Quantity},
};

/// What strikes what, how fast, and by which options.
#[derive(Debug, Clone, PartialEq)]
pub struct Scenario {
    /// Name of the case.
    pub name: String,
    /// One line that says what it is.
    pub title: String,
    /// Bibliography keys.
    pub sources: Vec<String>,
    /// What strikes.
    pub projectile: Rod,
    /// Impact speed [m/s].
    pub impact_speed: f64,
    /// What is struck.
    pub target: TargetBody,
    /// Options of the model `chain`.
    pub chain: ChainOptions,
    /// Options of the model `plate_cavity`.
    pub plate_cavity: PlateCavityOptions,
    /// Options of the model `plugging`.
    pub plugging: PluggingOptions,
    /// Options of the model `recht_ipson`.
    pub recht_ipson: RechtIpsonOptions,
    /// Options of the model `lambert_jonas`.
    pub lambert_jonas: LambertJonasOptions,
    /// Options of the model `awerbuch_bodner`.
    pub awerbuch_bodner: AwerbuchBodnerOptions,
}

/// A projectile.
#[derive(Debug, Clone, PartialEq)]
pub struct Rod {
    /// Its material.
    pub material: Arc<Material>,
    /// Id of its material.
    pub material_id: String,
    /// Length over all [m].
    pub length: f64,
    /// Mass [kg].
    pub mass: f64,
    /// Diameter of the shank [m].
    pub diameter: f64,
    /// Shape of the nose.
    pub nose: Nose,
}

impl Rod {
    /// Cross-sectional area of the shank [m2].
    pub fn area(&self) -> f64 {
        PI * self.diameter * self.diameter / 4.0
    }
}

/// What is struck.
#[derive(Debug, Clone, PartialEq)]
pub enum TargetBody {
    /// One or more layers.
    Layers {
        /// From the struck face to the back.
        layers: Vec<Plate>,
        /// What holds the back face.
        back_face: BackFace,
        /// Diameter of the column that is modelled [m].
        column_diameter: f64,
    },
    /// A rigid, frictionless wall.
    RigidWall,
    /// A constant pressure on the projectile's face [Pa].
    ConstantPressure(f64),
}

/// A layer of a target.
#[derive(Debug, Clone, PartialEq)]
pub struct Plate {
    /// Its material.
    pub material: Arc<Material>,
    /// Id of its material.
    pub material_id: String,
    /// Thickness [m]; `None` for a semi-infinite layer.
    pub thickness: Option<f64>,
}

impl Scenario {
    /// The same case at another impact speed [m/s].
    pub fn at_speed(&self, impact_speed: f64) -> Self {
        Self {
            impact_speed,
            ..self.clone()
        }
    }

    /// Thickness of all layers together [m]; `None` for a semi-infinite target, a wall or a constant pressure.
    pub fn target_thickness(&self) -> Option<f64> {
        match &self.target {
            TargetBody::Layers { layers, .. } => layers.iter().map(|layer| layer.thickness).sum(),
            _ => None,
        }
    }

    /// The same case on a mesh that is `factor` times finer.
    pub fn refined(&self, factor: u32) -> Self {
        let finer = |elements: usize| {
            let elements = u32::try_from(elements).unwrap_or(u32::MAX);
            Some(elements.saturating_mul(factor))
        };
        let mut refined = self.clone();
        refined.chain.projectile_elements = finer(self.chain.projectile_elements());
        refined.chain.target_elements = finer(self.chain.target_elements());
        refined
    }

    /// Looks up materials and works out what is given indirectly; findings go to `check`.
    pub(crate) fn resolve(
        name: &str,
        case: Case,
        library: &Library,
        check: &mut Check<'_>,
    ) -> Option<Self> {
        let projectile = resolve_rod(&case, library, check);
        let target = resolve_target(&case, library, check);
        Some(Self {
            name: name.to_owned(),
            title: case.title,
            sources: case.sources,
            projectile: projectile?,
            impact_speed: case.projectile.velocity.si(),
            target: target?,
            chain: case.chain,
            plate_cavity: case.plate_cavity,
            plugging: case.plugging,
            recht_ipson: case.recht_ipson,
            lambert_jonas: case.lambert_jonas,
            awerbuch_bodner: case.awerbuch_bodner,
        })
    }
}

fn look_up<'a>(
    library: &'a Library,
    name: &str,
    table: &str,
    check: &mut Check<'_>,
) -> Option<&'a MaterialEntry> {
    let found = library.find(name);
    if found.is_none() {
        let near = library
            .nearest(name)
            .map_or_else(String::new, |near| format!("did you mean `{near}`? "));
        check.fail(
            &format!("{table}.material"),
            format!("no material is named `{}`", crate::units::shorten(name)),
            format!("{near}`percuss materials` lists all; your own go under `[materials.NAME]`"),
        );
    }
    found
}

fn resolve_rod(case: &Case, library: &Library, check: &mut Check<'_>) -> Option<Rod> {
    let entry = look_up(library, &case.projectile.material, "projectile", check)?;
    let (length, mass) = case
        .projectile
        .length_and_mass(entry.material.density.si())?;
    let diameter = case.projectile.diameter.si();
    let nose = case.projectile.nose;
    let given = if case.projectile.length.is_some() {
        "length"
    } else {
        "mass"
    };
    let key = format!("projectile.{given}");
    if length <= nose.length(diameter) && nose != Nose::Flat {
        check.fail(
            &key,
            format!(
                "the projectile has no shank behind its {} nose",
                nose.name()
            ),
            format!(
                "the nose alone is {} long; give more than that, or a mass above {}",
                Length::new(nose.length(diameter)),
                Mass::new(entry.material.density.si() * nose.volume(diameter))
            ),
        );
        return None;
    }
    let derived: (&str, String, bool) = if given == "length" {
        let inside = (limits::MASS.min..=limits::MASS.max).contains(&mass);
        ("mass", Quantity::to_string(&Mass::new(mass)), inside)
    } else {
        let inside = (limits::LENGTH.min..=limits::LENGTH.max).contains(&length);
        ("length", Quantity::to_string(&Length::new(length)), inside)
    };
    if !derived.2 {
        check.fail(
            &key,
            format!(
                "the {given} gives a {} of {}, which is out of range",
                derived.0, derived.1
            ),
            "check the units of length, mass, diameter and density",
        );
        return None;
    }
    Some(Rod {
        material: entry.material.clone(),
        material_id: entry.id.clone(),
        length,
        mass,
        diameter,
        nose,
    })
}

fn resolve_target(case: &Case, library: &Library, check: &mut Check<'_>) -> Option<TargetBody> {
    let target = &case.target;
    if target.rigid_wall {
        return Some(TargetBody::RigidWall);
    }
    if let Some(pressure) = target.constant_pressure {
        return Some(TargetBody::ConstantPressure(pressure.si()));
    }
    let written = target.layers_with_keys();
    let semi_infinite = written
        .last()
        .is_some_and(|(_, layer)| layer.thickness == Thickness::SemiInfinite);
    let layers: Option<Vec<Plate>> = written
        .iter()
        .map(|(key, layer): &(String, Layer)| {
            let entry = look_up(library, &layer.material, key, check)?;
            Some(Plate {
                material: entry.material.clone(),
                material_id: entry.id.clone(),
                thickness: match layer.thickness {
                    Thickness::Finite(thickness) => Some(thickness.si()),
                    Thickness::SemiInfinite => None,
                },
            })
        })
        .collect();
    let natural = if semi_infinite {
        BackFace::NonReflecting
    } else {
        BackFace::Fixed
    };
    Some(TargetBody::Layers {
        layers: layers?,
        back_face: target.back_face.unwrap_or(natural),
        column_diameter: target
            .column_diameter
            .map_or(case.projectile.diameter.si(), Length::si),
    })
}
