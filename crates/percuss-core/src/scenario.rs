//! A case with its materials looked up and its quantities in SI units: what models run on.

mod check;

use std::{f64::consts::PI, sync::Arc};

use crate::{
    history::GaugePlace,
    material::Material,
    options::{ModelOptions, TargetResistanceModel},
    outcome::BandQuantity,
    problem::{EdgeSupport, Extensions, LayerInterface, Nose, RearFaceCondition},
    resistance::CustomResistance,
    units::ResultUnit,
};

/// A case in SI units: projectile, target, impact velocity and options.
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
    /// Impact velocity [m/s].
    pub impact_velocity: f64,
    /// Angle between the path and the normal of the struck face [rad].
    pub obliquity: f64,
    /// What is struck.
    pub target: TargetBody,
    /// What the target opposes to penetration, where the caller brings a law along; no file can name one.
    pub resistance: Option<CustomResistance>,
    /// Why the default target resistance model of the chain is not the expanding cavity; `None` where it is, and where the case names
    /// one.
    pub resistance_reason: Option<String>,
    /// Options of the models.
    pub options: ModelOptions,
    /// Points of the material at which a numerical run keeps a time history.
    pub gauges: Vec<GaugePlace>,
    /// Time from one sample of its histories to the next [s]; `None` for samples that are spread over its steps.
    pub history_interval: Option<f64>,
    /// Tables of models that are not part of percuss.
    pub extensions: Extensions,
    /// What was measured, for comparison; no model sees it.
    pub experiments: Vec<Measurement>,
    /// Curves that were measured at this impact velocity, for comparison; no model sees them.
    pub measured_curves: Vec<MeasuredCurve>,
    /// Which values that have a default the case gives.
    pub given: Given,
}

/// Which values that have a default a case gives: a study with other defaults leaves them as they are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Given {
    /// `target.back_face`.
    pub rear_face: bool,
    /// `chain.target_resistance`.
    pub target_resistance: bool,
}

/// A measured value of one quantity, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement {
    /// What was measured.
    pub quantity: BandQuantity,
    /// Impact velocity [m/s]; `None` for a ballistic limit without one.
    pub impact_velocity: Option<f64>,
    /// The value [m or m/s].
    pub value: f64,
    /// How far it may be off, either way [m or m/s].
    pub uncertainty: Option<f64>,
    /// Bibliography keys.
    pub sources: Vec<String>,
    /// Remarks on it.
    pub note: String,
}

/// A curve that was measured against time.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredCurve {
    /// Name in tables and figures.
    pub name: String,
    /// Name of the gauge, for a quantity of gauges.
    pub gauge: Option<String>,
    /// Quantity: the name of its column in `history.csv` or `gauges.csv`, without the unit.
    pub quantity: &'static str,
    /// Unit of its kind in results.
    pub unit: ResultUnit,
    /// Times [s] and values in SI units; every time is later than the one before it.
    pub points: Vec<(f64, f64)>,
    /// Columns of its table that nothing reads.
    pub unread_columns: Vec<String>,
    /// Columns of its table with other names or units than those of the program, each as `` `F (lbf)` as `contact_force_kn`, converted ``.
    pub read_as: Vec<String>,
    /// Standard uncertainty of the values, in their SI unit.
    pub uncertainty: Option<f64>,
    /// Correlation time of differences from a model [s].
    pub correlation_time: Option<f64>,
    /// Bibliography keys; its name where the case gives none.
    pub sources: Vec<String>,
    /// Index of its table in the case.
    pub table: usize,
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
    /// Temperature before the impact [K], where the case gives one.
    pub temperature: Option<f64>,
}

impl Rod {
    /// Cross-sectional area of the shank [m2].
    pub fn area(&self) -> f64 {
        PI * self.diameter * self.diameter / 4.0
    }

    /// Temperature before the impact [K].
    pub fn start_temperature(&self) -> f64 {
        start_temperature(self.temperature, &self.material)
    }
}

/// What is struck.
#[derive(Debug, Clone, PartialEq)]
pub enum TargetBody {
    /// One or more layers.
    Layers {
        /// From the struck face to the back.
        layers: Vec<Plate>,
        /// Boundary condition of the rear face.
        back_face: RearFaceCondition,
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
    pub support: EdgeSupport,
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
    /// Temperature before the impact [K], where the case gives one.
    pub temperature: Option<f64>,
}

impl Plate {
    /// Temperature before the impact [K].
    pub fn start_temperature(&self) -> f64 {
        start_temperature(self.temperature, &self.material)
    }

    /// Flow stress at unit plastic strain, slow and at its temperature before the impact [Pa]: the one number that border shear uses.
    pub fn flow_stress_at_unit_strain(&self) -> Option<f64> {
        match is_heated(self.temperature, &self.material) {
            false => {
                let law = self.material.strength.law();
                law.flow_stress_at_unit_strain(&self.material)
            }
            true => self.material.flow_stress_at(1.0, self.start_temperature()),
        }
    }
}

/// Temperature of a body before the impact [K], where a case may give one.
fn start_temperature(given: Option<f64>, material: &Material) -> f64 {
    given.unwrap_or(material.room_temperature.si())
}

/// Difference from the temperature of a material's record that counts as none [K]: rooms differ by as much.
const ROOM: f64 = 5.0;

/// Whether a temperature [K] is that at which a material was measured.
pub(crate) fn is_room_temperature(temperature: f64, material: &Material) -> bool {
    (temperature - material.room_temperature.si()).abs() <= ROOM
}

/// Whether a body is not at the temperature that its material was measured at.
fn is_heated(given: Option<f64>, material: &Material) -> bool {
    !is_room_temperature(start_temperature(given, material), material)
}

/// What is named, each once, in the order of its first place.
pub fn each_once<'a>(names: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let mut known = Vec::new();
    for name in names {
        if !known.contains(&name) {
            known.push(name);
        }
    }
    known
}

impl Scenario {
    /// Its title, or its name where it has none.
    pub fn heading(&self) -> &str {
        match self.title.trim().is_empty() {
            true => &self.name,
            false => &self.title,
        }
    }

    /// The same case at another impact velocity [m/s]: 0, or 1 um/s to 10 km/s.
    pub fn at_impact_velocity(&self, impact_velocity: f64) -> Self {
        let mut other = Self {
            impact_velocity,
            ..self.clone()
        };
        if impact_velocity != self.impact_velocity {
            other.measured_curves.clear();
        }
        other
    }

    /// Makes a column the target resistance model, unless the case gives one: a study varies a key that only a column has.
    pub fn choose_column(&mut self, key: &str) {
        if !self.given.target_resistance {
            self.options.chain.target_resistance = Some(TargetResistanceModel::Column);
            self.resistance_reason = Some(format!("`{key}` is varied, and only a column has it"));
        }
    }

    /// Whether the constants of one of its materials were calibrated on tests of a source.
    pub fn is_calibrated_on(&self, source: &str) -> bool {
        std::iter::once(&self.projectile.material)
            .chain(self.layers().iter().map(|layer| &layer.material))
            .filter_map(|material| material.calibrated.as_ref())
            .any(|calibrated| calibrated.sources.iter().any(|key| key == source))
    }

    /// Layers of the target; none of a wall or a constant pressure.
    pub fn layers(&self) -> &[Plate] {
        match &self.target {
            TargetBody::Layers { layers, .. } => layers,
            _ => &[],
        }
    }

    /// Length of the column of target that is modelled [m]; 0 for a target without layers.
    pub fn modelled_length(&self) -> f64 {
        let layers = self.layers().iter();
        layers.map(|plate| modelled_thickness(plate, self)).sum()
    }

    /// The layer of a target that has only one.
    pub fn only_layer(&self) -> Option<&Plate> {
        match self.layers() {
            [layer] => Some(layer),
            _ => None,
        }
    }

    /// Bodies by their names in messages, each with its material: the projectile, then the layers of the target.
    pub fn bodies(&self) -> Vec<(String, &Material)> {
        let layers = self.layers();
        let name = |i: usize| match layers.len() {
            1 => "target".to_owned(),
            _ => format!("layer {}", i + 1),
        };
        let targets = layers.iter().enumerate();
        let targets = targets.map(|(i, layer)| (name(i), &*layer.material));
        [("projectile".to_owned(), &*self.projectile.material)]
            .into_iter()
            .chain(targets)
            .collect()
    }

    /// Whether a body is not at the temperature that its material was measured at.
    pub fn is_heated(&self) -> bool {
        let rod = &self.projectile;
        is_heated(rod.temperature, &rod.material) || self.has_heated_target()
    }

    /// Whether a layer of the target is not at the temperature that its material was measured at.
    pub fn has_heated_target(&self) -> bool {
        let mut layers = self.layers().iter();
        layers.any(|layer| is_heated(layer.temperature, &layer.material))
    }

    /// Boundary condition of the target's rear face, where it has one.
    pub fn rear_face(&self) -> Option<RearFaceCondition> {
        match &self.target {
            TargetBody::Layers { back_face, .. } => Some(*back_face),
            _ => None,
        }
    }

    /// Ids of the materials that are brittle, each once: those with data of fracture.
    pub fn brittle(&self) -> Vec<&str> {
        let rod = &self.projectile;
        let layers = self.layers().iter();
        let layers = layers.map(|layer| (&*layer.material, &*layer.material_id));
        let brittle = std::iter::once((&*rod.material, &*rod.material_id))
            .chain(layers)
            .filter(|(material, _)| material.fracture.is_some());
        each_once(brittle.map(|(_, id)| id))
    }

    /// The same, ended by models with `end_at_rest` when the depth is known, where that and the outcome are those of a whole run; otherwise as it is.
    #[must_use]
    pub fn ended_at_rest(mut self) -> Self {
        let TargetBody::Layers { back_face, .. } = &self.target else {
            return self;
        };
        // A plate with a free rear face may lose a plug after the projectile has stopped.
        if self.target_thickness().is_none() || *back_face != RearFaceCondition::Free {
            let options = &mut self.options;
            options.chain.end_at_rest = Some(true);
            options.fdm.end_at_rest = Some(true);
            options.axi.end_at_rest = Some(true);
        }
        self
    }

    /// Thickness of all layers together [m]; `None` for a semi-infinite target, a wall or a constant pressure.
    pub fn target_thickness(&self) -> Option<f64> {
        match &self.target {
            TargetBody::Layers { layers, .. } => layers.iter().map(|layer| layer.thickness).sum(),
            _ => None,
        }
    }
}

/// Thickness that stands for a semi-infinite layer, in lengths of the projectile: deeper than any projectile of
/// comparable density goes.
const SEMI_INFINITE_LENGTHS: f64 = 4.0;

/// Thickness of a layer as it is modelled [m].
pub fn modelled_thickness(plate: &Plate, scenario: &Scenario) -> f64 {
    plate
        .thickness
        .unwrap_or(SEMI_INFINITE_LENGTHS * scenario.projectile.length)
}
