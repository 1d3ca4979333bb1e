//! Options of the 1-D discrete element model.

use std::{borrow::Cow, fmt};

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::{
    check::{Check, limits},
    units::{Mass, Time},
};

/// Options of the model `chain`; a key that is not given has the default that the scheme states.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ChainOptions {
    /// Scheme.
    pub scheme: Scheme,
    /// Elements along the projectile; 40 when not given.
    pub projectile_elements: Option<u32>,
    /// Elements through the target, shared among its layers by thickness; 80 when not given.
    pub target_elements: Option<u32>,
    /// Factor on the target's flow stress for the lateral constraint; 2.7 \[woodward1982\] when not given.
    pub constraint_factor: Option<ConstraintFactor>,
    /// Border-shear coefficient C in `Fy = C π d h σ_f` \[paper, eq. 24\]; 0.577 when not given.
    pub border_shear: Option<f64>,
    /// Strain measure and area change; scheme `conservative` only.
    pub kinematics: Option<Kinematics>,
    /// Courant number on the current smallest transit time; scheme `conservative` only.
    pub courant: Option<f64>,
    /// Magnitude of strain at which an element erodes, or `"never"`; 2 when not given; scheme `conservative` only.
    pub erosion_strain: Option<ErosionStrain>,
    /// Artificial viscosity in compression; none when not given; scheme `conservative` only.
    pub artificial_viscosity: Option<ArtificialViscosity>,
    /// Viscous damping of every spring as a fraction of critical; 0 when not given; scheme `conservative` only.
    pub damping_ratio: Option<f64>,
    /// Whether strength laws see the strain rate; true when not given; scheme `conservative` only.
    pub rate_effects: Option<bool>,
    /// Whether plastic work heats the material; true when not given; scheme `conservative` only.
    pub adiabatic_heating: Option<bool>,
    /// Fraction of plastic work that becomes heat; 0.9 when not given; scheme `conservative` only.
    pub heat_fraction: Option<f64>,
    /// Time at which a run is ended [s]; long enough for the case to end by itself when not given.
    pub end_time: Option<Time>,
    /// Time steps after which a run is ended; 20 million when not given.
    pub max_steps: Option<u64>,
    /// Readings of the paper; scheme `published` only.
    pub published: Option<PublishedOptions>,
}

/// Scheme of the 1-D discrete element model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Scheme {
    /// Large strain, plastic unloading, balanced books; converges.
    #[default]
    Conservative,
    /// The equations of the paper as printed, with every ambiguous reading selectable.
    Published,
}

impl Scheme {
    /// Name as the file has it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Conservative => "conservative",
            Self::Published => "published",
        }
    }
}

/// Strain measure of the conservative scheme.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Kinematics {
    /// `ε = ln(l₀/l)` and an area that grows as the element shortens: `A = A₀ l₀/l`.
    #[default]
    Logarithmic,
    /// `ε = (l₀ − l)/l₀` and a constant area: for comparison with small-strain theory.
    SmallStrain,
}

/// Artificial viscosity `q = ρ l |ε̇| (c_l c + c_q l |ε̇|)` in compression.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ArtificialViscosity {
    /// Linear coefficient c_l.
    pub linear: f64,
    /// Quadratic coefficient c_q.
    pub quadratic: f64,
}

/// Readings of the paper where its text leaves a choice.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PublishedOptions {
    /// How rod and target are joined.
    pub interface: Interface,
    /// Whether the factor 2 of equation (21) is in the time step.
    pub time_step: PublishedTimeStep,
    /// Which masses feel the border shear, and in which direction.
    pub border_shear: PublishedBorderShear,
    /// Stiffness of a spring below the strain at which the elastic line meets the power law.
    pub small_strain: SmallStrainStiffness,
    /// Lengths of rod and target that deform in the contact spring of the `chain` interface.
    pub contact_spring: ContactSpring,
    /// Mass of the target column [kg]; density times volume when not given.
    ///
    /// Table 1 prints 1.22 g, where its own density and size give 1.26 g.
    pub target_mass: Option<Mass>,
}

/// How rod and target are joined in the published scheme.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Interface {
    /// Every mass has its own equation; a contact spring with both stiffnesses in series joins rod and target (eq. 22).
    #[default]
    Chain,
    /// The first masses of rod and target move as one from the impact speed on (eq. 15 taken literally) and are stopped
    /// by the target's springs alone.
    Joined,
    /// As `joined`, and the rod's next spring pushes the joined mass from behind.
    JoinedPushed,
}

/// Contact spring of the `chain` interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ContactSpring {
    /// Half an element of each: the masses stand in the middle of their elements.
    #[default]
    HalfElements,
    /// A whole element of each.
    WholeElements,
}

/// Time step of the published scheme.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PublishedTimeStep {
    /// `Δt = 0.1 sqrt(m/K)`: what the numbers of Table 1 follow.
    #[default]
    #[serde(rename = "table-1")]
    Table1,
    /// `Δt = 0.1 · 2 sqrt(m/K)`: equation (21) as printed.
    #[serde(rename = "equation-21")]
    Equation21,
}

/// Border shear of the published scheme.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PublishedBorderShear {
    /// Dry friction on every target mass: it opposes motion and can hold a mass still.
    #[default]
    Friction,
    /// Friction on the target masses, and on the penetrator masses that have passed the target's original face.
    FrictionAndPenetrator,
    /// A constant force against the shot on every target mass that has started to move (eq. 23 as printed).
    Constant,
    /// None.
    None,
}

/// Stiffness of a spring of the published scheme at small strain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SmallStrainStiffness {
    /// The power law down to zero strain, where it is infinitely stiff (eqs 13 and 14 as printed).
    #[default]
    PowerLaw,
    /// The elastic stiffness `E A/l` is the largest.
    Elastic,
}

/// Factor on a target's flow stress.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ConstraintFactor {
    /// A number.
    Value(f64),
    /// Quasi-static spherical cavity expansion pressure over the yield stress, from the target's own strength law.
    CavityExpansion,
}

/// Strain at which an element erodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ErosionStrain {
    /// Magnitude of strain.
    At(f64),
    /// No erosion.
    Never,
}

/// A key that takes a number or one word.
trait NumberOrWord: Sized {
    const WORD: &'static str;
    const EXPECTING: &'static str;
    fn from_number(number: f64) -> Self;
    fn from_word() -> Self;
    fn number(&self) -> Option<f64>;
}

impl NumberOrWord for ConstraintFactor {
    const WORD: &'static str = "cavity-expansion";
    const EXPECTING: &'static str = "a number such as 2.7, or \"cavity-expansion\"";

    fn from_number(number: f64) -> Self {
        Self::Value(number)
    }

    fn from_word() -> Self {
        Self::CavityExpansion
    }

    fn number(&self) -> Option<f64> {
        match self {
            Self::Value(number) => Some(*number),
            Self::CavityExpansion => None,
        }
    }
}

impl NumberOrWord for ErosionStrain {
    const WORD: &'static str = "never";
    const EXPECTING: &'static str = "a number such as 2.0, or \"never\"";

    fn from_number(number: f64) -> Self {
        Self::At(number)
    }

    fn from_word() -> Self {
        Self::Never
    }

    fn number(&self) -> Option<f64> {
        match self {
            Self::At(number) => Some(*number),
            Self::Never => None,
        }
    }
}

struct NumberOrWordVisitor<T>(std::marker::PhantomData<T>);

impl<T: NumberOrWord> serde::de::Visitor<'_> for NumberOrWordVisitor<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(T::EXPECTING)
    }

    fn visit_f64<E: serde::de::Error>(self, number: f64) -> Result<T, E> {
        Ok(T::from_number(number))
    }

    fn visit_i64<E: serde::de::Error>(self, number: i64) -> Result<T, E> {
        Ok(T::from_number(number as f64))
    }

    fn visit_str<E: serde::de::Error>(self, word: &str) -> Result<T, E> {
        if word == T::WORD {
            Ok(T::from_word())
        } else {
            Err(E::custom(format!(
                "`{word}` is not understood here\nallowed: {}",
                T::EXPECTING
            )))
        }
    }
}

macro_rules! number_or_word {
    ($($name:ident),*) => {$(
        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                deserializer.deserialize_any(NumberOrWordVisitor(std::marker::PhantomData))
            }
        }

        impl Serialize for $name {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                match self.number() {
                    Some(number) => serializer.serialize_f64(number),
                    None => serializer.serialize_str(Self::WORD),
                }
            }
        }

        impl JsonSchema for $name {
            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                json_schema!({ "anyOf": [{ "type": "number" }, { "const": Self::WORD }] })
            }
        }
    )*};
}

number_or_word!(ConstraintFactor, ErosionStrain);

/// Most elements that one body may have: beyond it a run takes hours and its histories gigabytes.
pub const MAX_ELEMENTS: u32 = 100_000;

impl ChainOptions {
    /// Elements along the projectile.
    pub fn projectile_elements(&self) -> usize {
        self.projectile_elements.unwrap_or(40) as usize
    }

    /// Elements through the target.
    pub fn target_elements(&self) -> usize {
        self.target_elements.unwrap_or(80) as usize
    }

    /// Border-shear coefficient C.
    pub fn border_shear(&self) -> f64 {
        self.border_shear.unwrap_or(0.577)
    }

    /// Factor on the target's flow stress.
    pub fn constraint_factor(&self) -> ConstraintFactor {
        self.constraint_factor
            .unwrap_or(ConstraintFactor::Value(2.7))
    }

    /// Readings of the paper.
    pub fn published(&self) -> PublishedOptions {
        self.published.unwrap_or_default()
    }

    pub(super) fn check(&self, check: &mut Check<'_>, target_is_solid: bool) {
        self.check_target(check, target_is_solid);
        for (key, elements) in [
            ("projectile_elements", self.projectile_elements),
            ("target_elements", self.target_elements),
        ] {
            if let Some(elements) = elements.filter(|n| !(1..=MAX_ELEMENTS).contains(n)) {
                let size = if elements > MAX_ELEMENTS {
                    format!(
                        "; this mesh would take about {:.0} MB and the time grows with the square of the number; \
                         `percuss converge` shows how many are enough",
                        f64::from(elements) * 200.0 / 1e6
                    )
                } else {
                    String::new()
                };
                check.fail(
                    key,
                    format!("{elements} elements is out of range"),
                    format!("allowed: 1 to {MAX_ELEMENTS}{size}"),
                );
            }
        }
        let numbers = [
            ("border_shear", self.border_shear, limits::BORDER_SHEAR),
            ("courant", self.courant, limits::COURANT),
            ("damping_ratio", self.damping_ratio, limits::DAMPING),
            ("heat_fraction", self.heat_fraction, limits::HEAT_FRACTION),
            (
                "constraint_factor",
                self.constraint_factor.and_then(|factor| factor.number()),
                limits::CONSTRAINT_FACTOR,
            ),
            (
                "erosion_strain",
                self.erosion_strain.and_then(|strain| strain.number()),
                limits::EROSION_STRAIN,
            ),
        ];
        for (key, number, limits) in numbers {
            if let Some(number) = number {
                check.number(key, number, limits);
            }
        }
        if let Some(viscosity) = self.artificial_viscosity {
            let mut check = check.within("artificial_viscosity");
            check.number("linear", viscosity.linear, limits::VISCOSITY);
            check.number("quadratic", viscosity.quadratic, limits::VISCOSITY);
        }
        if let Some(time) = self.end_time {
            check.quantity("end_time", time, limits::TIME);
        }
        if self.max_steps == Some(0) {
            check.fail("max_steps", "0 steps is out of range", "allowed: 1 or more");
        }
        if let Some(mass) = self.published().target_mass {
            check.quantity("published.target_mass", mass, limits::MASS);
        }
        self.check_scheme(check);
    }

    /// Reports keys that would have no effect.
    fn check_target(&self, check: &mut Check<'_>, target_is_solid: bool) {
        let column_only = [
            ("target_elements", self.target_elements.is_some()),
            ("constraint_factor", self.constraint_factor.is_some()),
            ("border_shear", self.border_shear.is_some()),
        ];
        for (key, _) in column_only
            .iter()
            .filter(|(_, given)| *given && !target_is_solid)
        {
            check.fail(
                key,
                format!("a rigid wall or a constant pressure has no `{key}`"),
                "remove the key",
            );
        }
        if self.heat_fraction.is_some() && self.adiabatic_heating == Some(false) {
            check.fail(
                "heat_fraction",
                "`heat_fraction` has no effect without `adiabatic_heating`",
                "remove one of the two keys",
            );
        }
    }

    /// Reports keys that the selected scheme would ignore.
    fn check_scheme(&self, check: &mut Check<'_>) {
        let conservative_only = [
            ("kinematics", self.kinematics.is_some()),
            ("courant", self.courant.is_some()),
            ("erosion_strain", self.erosion_strain.is_some()),
            ("artificial_viscosity", self.artificial_viscosity.is_some()),
            ("damping_ratio", self.damping_ratio.is_some()),
            ("rate_effects", self.rate_effects.is_some()),
            ("adiabatic_heating", self.adiabatic_heating.is_some()),
            ("heat_fraction", self.heat_fraction.is_some()),
        ];
        match self.scheme {
            Scheme::Published => {
                for (key, _) in conservative_only.iter().filter(|(_, given)| *given) {
                    check.fail(
                        key,
                        format!("scheme `published` has no `{key}`"),
                        "remove the key, or use scheme = \"conservative\"",
                    );
                }
            }
            Scheme::Conservative if self.published.is_some() => check.fail(
                "published",
                "scheme `conservative` does not use the readings of the paper",
                "remove the table, or use scheme = \"published\"",
            ),
            Scheme::Conservative => {}
        }
    }
}
