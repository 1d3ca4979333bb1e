//! A case with its materials looked up and its quantities in SI units: what models run on.

use std::{f64::consts::PI, sync::Arc};

use crate::{
    case::{
        BackFace, Case, Experiment, Layer, LayerInterface, ModelOptions, Nose, Scheme, Support,
        TargetClosure, Thickness, Uncertainty,
    },
    chain,
    check::{Check, limits},
    material::{Library, Material, MaterialEntry},
    outcome::BandQuantity,
    resistance::OwnResistance,
    units::{Length, Mass, Quantity, Velocity},
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
    /// Angle between the path and the normal of the struck face [rad].
    pub obliquity: f64,
    /// What is struck.
    pub target: TargetBody,
    /// What the target opposes to penetration, where the caller brings a law along; no file can name one.
    pub resistance: Option<OwnResistance>,
    /// Why the default target resistance model of the chain is not the expanding cavity; `None` where it is, and where the case names
    /// one.
    pub resistance_reason: Option<String>,
    /// Options of the models.
    pub options: ModelOptions,
    /// What was measured, for comparison; no model sees it.
    pub experiments: Vec<Measurement>,
    /// Which values that have a default the case gives.
    pub given: Given,
}

/// Which values that have a default a case gives: a study with other defaults leaves them as they are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Given {
    /// `target.back_face`.
    pub rear_face: bool,
    /// `chain.target_closure`.
    pub target_closure: bool,
}

/// A measured value of one quantity, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement {
    /// What was measured.
    pub quantity: BandQuantity,
    /// Impact speed [m/s]; `None` for a ballistic limit without one.
    pub impact_speed: Option<f64>,
    /// The value [m or m/s].
    pub value: f64,
    /// How far it may be off, either way [m or m/s].
    pub uncertainty: Option<f64>,
    /// Bibliography keys.
    pub sources: Vec<String>,
    /// What a user should know of it.
    pub note: String,
}

impl Measurement {
    fn resolve(experiment: &Experiment) -> Option<Self> {
        let (quantity, value) = experiment.measured()?;
        Some(Self {
            quantity,
            impact_speed: experiment.velocity.map(Velocity::si),
            value,
            uncertainty: experiment.uncertainty.map(Uncertainty::si),
            sources: experiment.source.0.clone(),
            note: experiment.note.clone(),
        })
    }
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
    /// Temperature before the impact [K], where it is not the one that its material was measured at.
    pub temperature: Option<f64>,
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
        /// Diameter of the column that is modelled [m], where a layer has none of its own.
        column_diameter: f64,
        /// Whether a layer has a gap, an interface or a diameter of its own.
        separate_layers: bool,
        /// Where the plate ends; `None` where the case does not say.
        edge: Option<PlateEdge>,
    },
    /// A rigid, frictionless wall.
    RigidWall,
    /// A constant pressure on the projectile's face [Pa].
    ConstantPressure(f64),
}

/// Edge of a plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlateEdge {
    /// Diameter inside the support [m].
    pub diameter: f64,
    /// How it is held there.
    pub support: Support,
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
    /// Distance to the layer before it [m].
    pub gap: f64,
    /// How it is joined to the layer before it.
    pub interface: LayerInterface,
    /// Diameter of the column that is modelled [m]; that of the target where `None`.
    pub column_diameter: Option<f64>,
}

impl Scenario {
    /// The same case at another impact speed [m/s].
    pub fn at_speed(&self, impact_speed: f64) -> Self {
        Self {
            impact_speed,
            ..self.clone()
        }
    }

    /// The case as its ballistic limit is asked for: the rear face of a plate is free unless the case gives another one. `None`
    /// where nothing changes.
    pub fn with_free_rear_face(&self) -> Option<Self> {
        let mut free = self.clone();
        let TargetBody::Layers {
            layers, back_face, ..
        } = &mut free.target
        else {
            return None;
        };
        if self.given.rear_face || layers.last()?.thickness.is_none() {
            return None;
        }
        *back_face = BackFace::Free;
        free.choose_target_closure();
        Some(free)
    }

    /// Sets the target resistance model of a case that gives none; it depends on the rest of the case.
    fn choose_target_closure(&mut self) {
        if !self.given.target_closure {
            self.options.chain.target_closure = None;
            let (closure, reason) = chain::default_closure(self);
            self.options.chain.target_closure = Some(closure);
            self.resistance_reason = reason;
        }
    }

    /// Makes a column the target resistance model, unless the case gives one: a study varies a key that only a column has.
    pub(crate) fn choose_column(&mut self, key: &str) {
        if !self.given.target_closure {
            self.options.chain.target_closure = Some(TargetClosure::Column);
            self.resistance_reason = Some(format!("`{key}` is varied, and only a column has it"));
        }
    }

    /// Whether the constants of one of its materials were calibrated on shots of a source.
    pub fn is_calibrated_on(&self, source: &str) -> bool {
        let layers: &[Plate] = match &self.target {
            TargetBody::Layers { layers, .. } => layers,
            _ => &[],
        };
        std::iter::once(&self.projectile.material)
            .chain(layers.iter().map(|layer| &layer.material))
            .filter_map(|material| material.calibrated.as_ref())
            .any(|calibrated| calibrated.sources.iter().any(|key| key == source))
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
        refined.options.chain.projectile_elements = finer(self.options.chain.projectile_elements());
        refined.options.chain.target_elements = finer(self.options.chain.target_elements());
        let (projectile, target) = self.options.fdm.elements(self);
        let cells = self.options.axi.cells_per_radius();
        refined.options.axi.cells_per_radius = Some(cells.saturating_mul(factor));
        refined.options.fdm.projectile_elements = finer(projectile as usize);
        refined.options.fdm.target_elements = finer(target as usize);
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
        let options = case.model_options();
        let given = Given {
            rear_face: case.target.back_face.is_some(),
            target_closure: options.chain.target_closure.is_some(),
        };
        let mut scenario = Self {
            name: name.to_owned(),
            title: case.title,
            sources: case.sources,
            projectile: projectile?,
            impact_speed: case.projectile.velocity.si(),
            obliquity: case.projectile.obliquity(),
            target: target?,
            resistance: None,
            resistance_reason: None,
            options,
            experiments: case
                .experiments
                .iter()
                .filter_map(Measurement::resolve)
                .collect(),
            given,
        };
        let chain = &mut scenario.options.chain;
        if chain.target_elements.is_none() && chain.scheme == Scheme::Conservative {
            scenario.options.chain.target_elements = scenario.thin_target_elements();
        }
        scenario.choose_target_closure();
        Some(scenario)
    }

    /// Elements through a target so thin that the default number would make them far shorter than the projectile's: a fourth of
    /// that length is short enough. The shortest element sets the time step of all.
    fn thin_target_elements(&self) -> Option<u32> {
        const ENOUGH: f64 = 24.0;
        let shortest =
            0.25 * self.projectile.length / self.options.chain.projectile_elements() as f64;
        let elements = (self.target_thickness()? / shortest).ceil().max(ENOUGH);
        (elements < self.options.chain.target_elements() as f64).then_some(elements as u32)
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
        let near = library.suggestion(name);
        check.of_material().fail(
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
    let temperature = case.projectile.temperature;
    if let (Some(temperature), Some(melting)) = (temperature, entry.material.melting_temperature)
        && temperature.si() >= melting.si()
    {
        check.fail(
            "projectile.temperature",
            format!("{temperature} is at or above the melting temperature"),
            format!("the material `{}` melts at {melting}", entry.id),
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
        temperature: temperature.map(Quantity::si),
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
                gap: layer.gap.map_or(0.0, Length::si),
                interface: layer.interface.unwrap_or_default(),
                column_diameter: layer.column_diameter.map(Length::si),
            })
        })
        .collect();
    let natural = if semi_infinite {
        BackFace::NonReflecting
    } else {
        BackFace::Fixed
    };
    let column_diameter = target
        .column_diameter
        .map_or(case.projectile.diameter.si(), Length::si);
    if let Some(diameter) = target.plate_diameter
        && diameter.si() <= 2.0 * column_diameter
    {
        check.fail(
            "target.plate_diameter",
            format!("{diameter} leaves no plate around what is struck"),
            format!(
                "give more than twice the diameter of what is struck, {}",
                Length::new(column_diameter)
            ),
        );
        return None;
    }
    Some(TargetBody::Layers {
        layers: layers?,
        back_face: target.back_face.unwrap_or(natural),
        column_diameter: target
            .column_diameter
            .map_or(case.projectile.diameter.si(), Length::si),
        separate_layers: target.has_separate_layers(),
        edge: target.plate_diameter.map(|diameter| PlateEdge {
            diameter: diameter.si(),
            support: target.support.unwrap_or_default(),
        }),
    })
}
