//! Materials: elastic constants, a strength law and where every number comes from.

mod brittle;
mod calibrated;
mod cavity;
mod damage;
mod equation_of_state;
mod failure;
mod flow_curve;
mod group;
mod library;
mod plastic_return;
mod reached;
mod references;
mod sanity;
mod search;
mod state_equation;
mod strength;
mod tensile;
#[cfg(test)]
mod tests;
mod unmodelled;
mod yield_point;

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::units::{Density, Pressure, SpecificHeat, StrainRate, Temperature};

pub use brittle::Brittle;
pub use calibrated::Calibrated;
pub use cavity::{
    cavity_expansion_pressure, cavity_expansion_pressure_at, cylindrical_cavity_pressure,
    plastic_cavity_pressure,
};
pub use damage::{Damage, DamageState, PreparedDamage};
pub use equation_of_state::EquationOfState;
pub use failure::*;
pub use flow_curve::IsothermalFlowCurve;
pub use group::MaterialGroup;
pub use library::{Library, MaterialEntry};
pub use plastic_return::plastic_increments;
pub use reached::Reached;
pub use references::{Reference, references};
pub use search::Filter;
pub use state_equation::{StateEquation, impedance_match};
pub use strength::strength_factor;
pub use strength::*;
pub use tensile::tensile_strength;
pub use unmodelled::reason_not_modelled;
pub use yield_point::{Called, LaneTrial, Trial, YieldPoint};

/// One parameter set of a material, as a file holds it.
///
/// Rival sets for the same material stay separate records of one `family`; one of them is recommended.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Plain name, for example `OFHC copper`; the id by default.
    #[serde(default)]
    pub name: String,
    /// Group of rival records that describe the same material; its recommended record answers to this name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub family: Option<String>,
    /// What the material is made of, for lists and searches.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub group: Option<MaterialGroup>,
    /// Other names of the material, in lower case. A name that several families have selects none of them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub aliases: Vec<String>,
    /// Temper, heat treatment or condition.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub state: Option<String>,
    /// Whether this record answers to the name of its family.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub recommended: bool,
    /// How far the numbers can be trusted.
    #[serde(default)]
    pub trust: Trust,
    /// Bibliography keys of the works that the numbers come from.
    #[serde(default)]
    pub sources: Vec<String>,
    /// Limitations of the record.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub note: String,
    /// What its constants were calibrated on, where `percuss calibrate` made the record.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub calibrated: Option<Calibrated>,
    /// Density at rest [kg/m3].
    pub density: Density,
    /// Young's modulus [Pa].
    pub youngs_modulus: Pressure,
    /// Poisson's ratio.
    pub poissons_ratio: f64,
    /// Static yield stress [Pa], for information; the strength law decides.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub yield_stress: Option<Pressure>,
    /// Ultimate tensile strength [Pa].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ultimate_strength: Option<Pressure>,
    /// Brinell hardness number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub brinell_hardness: Option<f64>,
    /// Tensile stress at which the material spalls [Pa].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spall_strength: Option<Pressure>,
    /// Cumulative failure in tension by the law of Tuler and Butcher.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tuler_butcher: Option<TulerButcher>,
    /// Specific heat [J/(kg K)]; needed for adiabatic heating.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub specific_heat: Option<SpecificHeat>,
    /// Melting temperature [K].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub melting_temperature: Option<Temperature>,
    /// Temperature at which the parameters were measured [K].
    #[serde(default = "room_temperature")]
    pub room_temperature: Temperature,
    /// Where the strength law was fitted.
    #[serde(default, skip_serializing_if = "Validity::is_empty")]
    pub validity: Validity,
    /// Shock equation of state; models of planar shocks need it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub equation_of_state: Option<EquationOfState>,
    /// Damage by plastic strain; models use it where they are asked to.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damage: Option<Damage>,
    /// Fracture energy and tensile strength; models of cracks need them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fracture: Option<Brittle>,
    /// The strength law.
    pub strength: Strength,
}

fn room_temperature() -> Temperature {
    Temperature::new(293.0)
}

impl Material {
    /// A record of a density [kg/m3], Young's modulus [Pa], Poisson's ratio and strength law; it says nothing else.
    pub fn new(
        name: impl Into<String>,
        density: Density,
        youngs_modulus: Pressure,
        poissons_ratio: f64,
        strength: Strength,
    ) -> Self {
        Self {
            name: name.into(),
            family: None,
            group: None,
            aliases: Vec::new(),
            state: None,
            recommended: false,
            trust: Trust::default(),
            sources: Vec::new(),
            note: String::new(),
            calibrated: None,
            density,
            youngs_modulus,
            poissons_ratio,
            yield_stress: None,
            ultimate_strength: None,
            brinell_hardness: None,
            spall_strength: None,
            tuler_butcher: None,
            specific_heat: None,
            melting_temperature: None,
            room_temperature: room_temperature(),
            validity: Validity::default(),
            equation_of_state: None,
            damage: None,
            fracture: None,
            strength,
        }
    }

    /// What the material is, as far as models tell the difference.
    pub fn class(&self) -> MaterialClass {
        match self.strength {
            Strength::Concrete(_) => MaterialClass::Concrete,
            _ => MaterialClass::Metal,
        }
    }

    /// Speed of a longitudinal wave in a thin elastic bar [m/s].
    pub fn bar_wave_speed(&self) -> f64 {
        (self.youngs_modulus.si() / self.density.si()).sqrt()
    }

    /// Speed of a weak plane wave in the bulk: that of the equation of state, or that of the elastic constants [m/s].
    pub fn bulk_sound_speed(&self) -> f64 {
        match &self.equation_of_state {
            Some(state) => state.sound_speed.si(),
            None => (self.bulk_modulus() / self.density.si()).sqrt(),
        }
    }

    /// Acoustic impedance of a thin elastic bar per area [kg/(m2 s)].
    pub fn bar_impedance(&self) -> f64 {
        (self.youngs_modulus.si() * self.density.si()).sqrt()
    }

    /// Flow stress at a plastic strain, slow and at room temperature [Pa]; `None` for a law that never flows.
    pub fn flow_stress(&self, plastic_strain: f64) -> Option<f64> {
        self.flow_stress_at(plastic_strain, self.room_temperature.si())
    }

    /// The same at a temperature [K].
    pub fn flow_stress_at(&self, plastic_strain: f64, temperature: f64) -> Option<f64> {
        self.strength.law().initial_yield_stress(self)?;
        let state = FlowState {
            plastic_strain,
            strain_rate: 0.0,
            temperature,
            pressure: 0.0,
        };
        let prepared = self.strength.law().prepare(self, 1.0);
        Some(prepared.flow_stress(&state).stress)
    }

    /// Whether the slow flow stress at unit plastic strain and a temperature [K] is above that of first flow.
    pub fn hardens_at(&self, temperature: f64) -> bool {
        let [first, later] = [0.0, 1.0].map(|strain| self.flow_stress_at(strain, temperature));
        first
            .zip(later)
            .is_some_and(|(first, later)| later > first * (1.0 + 1e-9))
    }

    /// Stress at which slow flow starts at a temperature [K] [Pa]; `None` for a law that never flows.
    pub fn yield_stress_at(&self, temperature: f64) -> Option<f64> {
        let yield_stress = self.strength.law().initial_yield_stress(self)?;
        let room = self.room_temperature.si();
        if temperature == room {
            return Some(yield_stress);
        }
        // Laws that start their hardening at a small strain are above their yield stress at none: the ratio is not.
        let [hot, cold] = [temperature, room].map(|at| self.flow_stress_at(0.0, at));
        Some(yield_stress * (hot? / cold?))
    }

    /// Shear modulus [Pa].
    pub fn shear_modulus(&self) -> f64 {
        self.youngs_modulus.si() / (2.0 * (1.0 + self.poissons_ratio))
    }

    /// Bulk modulus [Pa].
    pub fn bulk_modulus(&self) -> f64 {
        self.youngs_modulus.si() / (3.0 * (1.0 - 2.0 * self.poissons_ratio))
    }
}

/// Class of a material, as far as models tell the difference.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MaterialClass {
    /// A solid that flows at a stress which pressure does not raise: metals, and what behaves like them.
    Metal,
    /// Concrete.
    Concrete,
}

impl MaterialClass {
    /// The class in words.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Metal => "metal",
            Self::Concrete => "concrete",
        }
    }
}

/// How far the numbers of a record can be trusted.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default, Serialize, Deserialize, JsonSchema,
)]
pub enum Trust {
    /// Read in two independent readable places.
    A,
    /// One secondary source that names its primary source.
    B,
    /// Secondary source without a named primary one, or values put together from several.
    C,
    /// Supplied by the user; not graded.
    #[default]
    #[serde(rename = "user")]
    User,
}

impl Trust {
    /// The letter as files have it.
    pub fn letter(self) -> &'static str {
        match self {
            Self::A => "A",
            Self::B => "B",
            Self::C => "C",
            Self::User => "user",
        }
    }

    /// What the letter means, in words.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::A => "read in two independent places",
            Self::B => "one secondary source that names its primary source",
            Self::C => "indicative: primary source not named, or put together from several",
            Self::User => "supplied by the user; not graded",
        }
    }
}

/// Range in which a strength law was fitted; outside it a run warns.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Validity {
    /// Largest plastic strain.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plastic_strain_max: Option<f64>,
    /// Largest strain rate [1/s], which `chain` and `fdm` compare; two-dimensional models do not keep it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub strain_rate_max: Option<StrainRate>,
    /// Largest temperature [K].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub temperature_max: Option<Temperature>,
}

impl Validity {
    fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// A file of materials: one table per record, the table's name being the material's id.
pub type MaterialTable = BTreeMap<String, Material>;
