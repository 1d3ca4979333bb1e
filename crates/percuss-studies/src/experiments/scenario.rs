//! From a test to a case that models compute.

use super::{Experiment, Properties, Strength, Struck};
use crate::{
    Scenario,
    case::{Case, Projectile, RearFaceCondition, Target, Thickness},
    check::Diagnostic,
    material::{self, Library, Material, MaterialTable},
    units::{Angle, Density, Length, Mass, Pressure, Temperature, Velocity},
};

/// Difference from the temperature at which a material was measured that is not worth telling [K]: all laboratories are rooms.
const ROOM: f64 = 20.0;
/// Temperature of a laboratory [K].
const ROOM_TEMPERATURE: f64 = 295.0;

impl Experiment {
    /// The test as a case, with one of its material records for the projectile.
    ///
    /// A ballistic limit becomes an impact at the limit. A plate that brought its properties has the strength law
    /// `σ = Y (E ε/Y)ⁿ`; its rear face is free. The projectile has a temperature of its own where it differs by more than 20 K from
    /// the one at which its material was measured.
    ///
    /// # Errors
    /// Why no case can be made of it, in words.
    pub fn scenario(&self, record: &str, library: &Library) -> Result<Scenario, String> {
        if let Some(reason) = self.no_case() {
            return Err(reason);
        }
        self.resolve(record, library).map_err(|diagnostics| {
            let words: Vec<String> = diagnostics
                .into_iter()
                .map(|diagnostic| diagnostic.message)
                .collect();
            words.join("; ")
        })
    }

    /// Why no case can be made of it, whichever material stands for its projectile.
    pub fn no_case(&self) -> Option<String> {
        self.unusable.clone()
    }

    /// Whether its projectile was heated or cooled: most models take room temperature alone.
    pub fn is_hot(&self) -> bool {
        self.temperature
            .is_some_and(|temperature| (temperature - ROOM_TEMPERATURE).abs() > 2.0 * ROOM)
    }

    /// Whether statistics may count it: it is neither suspect nor a repetition.
    pub fn counts(&self) -> bool {
        self.flag.is_none() && self.duplicate_of.is_none()
    }

    pub(super) fn resolve(
        &self,
        record: &str,
        library: &Library,
    ) -> Result<Scenario, Vec<Diagnostic>> {
        self.case(record, library).into_scenario(&self.id, library)
    }

    pub(crate) fn case(&self, record: &str, library: &Library) -> Case {
        let room = library
            .find(record)
            .map(|entry| entry.material.room_temperature.si());
        let temperature = self
            .temperature
            .filter(|temperature| room.is_none_or(|room| (temperature - room).abs() > ROOM));
        let mut materials = MaterialTable::new();
        let target = match &self.target {
            Struck::RigidWall => Target {
                rigid_wall: true,
                ..Target::default()
            },
            Struck::Body {
                material,
                thickness,
                properties,
            } => {
                let name = match properties {
                    Some(properties) => {
                        let id = id_of(material);
                        materials.insert(id.clone(), properties.material(material, self));
                        id
                    }
                    None => material.clone(),
                };
                Target {
                    material: Some(name),
                    thickness: Some(thickness.map_or(Thickness::SemiInfinite, |thickness| {
                        Thickness::Finite(Length::new(thickness))
                    })),
                    back_face: thickness.map(|_| RearFaceCondition::Free),
                    ..Target::default()
                }
            }
        };
        let projectile = Projectile {
            material: record.to_owned(),
            length: self.length.map(Length::new),
            mass: self.mass.map(Mass::new),
            diameter: Length::new(self.diameter.unwrap_or(0.0)),
            nose: self.nose.into(),
            impact_velocity: Velocity::new(self.impact_velocity),
            obliquity: (self.obliquity_deg != 0.0)
                .then(|| Angle::new(self.obliquity_deg.to_radians())),
            yaw: None,
            temperature: temperature.map(Temperature::new),
        };
        Case {
            title: format!("{}: {}", self.id, self.projectile_class),
            sources: vec![self.source.clone()],
            materials,
            ..Case::new(projectile, target)
        }
    }
}

/// Id of a target's material: letters and digits joined by hyphens, unlike any id of the library.
fn id_of(name: &str) -> String {
    let words = name
        .split(|c: char| !c.is_ascii_alphanumeric())
        .filter(|word| !word.is_empty());
    words.fold("target".to_owned(), |id, word| {
        format!("{id}-{}", word.to_ascii_lowercase())
    })
}

impl Properties {
    fn material(&self, name: &str, test: &Experiment) -> Material {
        let (strength, yield_stress) = match self.strength {
            Strength::Metal {
                yield_stress,
                exponent,
            } => {
                let law = if exponent == 0.0 {
                    material::Strength::PerfectlyPlastic(material::PerfectlyPlastic {
                        flow_stress: Pressure::new(yield_stress),
                    })
                } else {
                    let ratio = self.youngs_modulus / yield_stress;
                    material::Strength::PowerLaw(material::PowerLaw {
                        coefficient: Pressure::new(yield_stress * ratio.powf(exponent)),
                        exponent,
                    })
                };
                (law, Some(Pressure::new(yield_stress)))
            }
            Strength::Concrete(strength) => {
                let law = material::Concrete {
                    compressive_strength: Pressure::new(strength),
                };
                (material::Strength::Concrete(law), None)
            }
        };
        Material {
            trust: test.trust,
            sources: vec![test.source.clone()],
            yield_stress,
            ultimate_strength: self.ultimate_strength.map(Pressure::new),
            brinell_hardness: self.brinell_hardness,
            ..Material::new(
                name,
                Density::new(self.density),
                Pressure::new(self.youngs_modulus),
                self.poissons_ratio,
                strength,
            )
        }
    }
}
