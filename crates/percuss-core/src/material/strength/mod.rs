//! Strength laws. Adding one is one file here and one line in the `strength_laws!` list.

mod concrete;
mod elastic;
mod johnson_cook;
mod lane_law;
mod own;
mod perfectly_plastic;
mod power_law;
mod steinberg_guinan;

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Material;
use crate::check::Check;

pub use concrete::Concrete;
pub use concrete::strength_factor;
pub use elastic::Elastic;
pub use johnson_cook::{JohnsonCook, JohnsonCookLaw, ModifiedJohnsonCookLaw, RateForm};
pub use lane_law::{LaneLaw, LaneStrength, LawKind, LawVisitor};
pub use own::OwnLaw;
pub use perfectly_plastic::PerfectlyPlastic;
pub use perfectly_plastic::perfectly_plastic;
pub use power_law::{Hardening, PowerLaw};
pub use steinberg_guinan::{SteinbergGuinan, SteinbergGuinanLaw};

/// State that a flow stress depends on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FlowState {
    /// Equivalent plastic strain.
    pub plastic_strain: f64,
    /// Plastic strain rate [1/s].
    pub strain_rate: f64,
    /// Temperature [K].
    pub temperature: f64,
    /// Pressure, compression positive [Pa].
    pub pressure: f64,
}

/// Flow stress with its slopes, for an implicit return to the yield surface.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct FlowStress {
    /// Flow stress [Pa].
    pub stress: f64,
    /// Slope with plastic strain [Pa].
    pub strain_slope: f64,
    /// Slope with strain rate [Pa s].
    pub rate_slope: f64,
}

/// A strength law made ready for one material and one constraint factor.
pub trait PreparedStrength: fmt::Debug + Send + Sync {
    /// Flow stress in a state.
    fn flow_stress(&self, state: &FlowState) -> FlowStress;

    /// Whether neither strain rate nor temperature nor pressure matter: then one evaluation a step is enough.
    fn depends_on_strain_only(&self) -> bool {
        false
    }

    /// The law as one whose equations are known here, if it is one: eight bodies of it flow side by side. Its flow stress is then that of
    /// [`Self::flow_stress`], to the last bit.
    fn in_lanes(&self) -> Option<LaneLaw> {
        None
    }

    /// Whether the flow stress changes with the pressure, without any flow.
    fn depends_on_pressure(&self) -> bool {
        false
    }
}

/// What every strength law says of itself.
pub trait StrengthLaw {
    /// Makes the law ready for a material; all stresses are multiplied by `factor`, the constraint factor.
    fn prepare(&self, material: &Material, factor: f64) -> Box<dyn PreparedStrength>;

    /// Flow stress at unit plastic strain, slow and at room temperature [Pa]: the one number that border shear uses.
    ///
    /// `None` for a law that never flows.
    fn flow_stress_at_unit_strain(&self, material: &Material) -> Option<f64>;

    /// Stress at which flow starts, slow and at room temperature [Pa]; `None` for a law that never flows.
    fn initial_yield_stress(&self, material: &Material) -> Option<f64>;

    /// Whether heat changes the flow stress.
    fn depends_on_temperature(&self) -> bool {
        false
    }

    /// Constitutive equation as text.
    fn equation(&self) -> &'static str;

    /// Parameters with their values and units, in the order of the equation.
    fn parameters(&self) -> Vec<(&'static str, String)>;

    /// Checks the parameters' ranges, reporting keys relative to the law's table.
    fn check(&self, check: &mut Check<'_>);

    /// Of a law of the caller's own, text that differs between laws with different results, numbers with all their digits included: a checkpoint belongs to it. `None`
    /// refuses checkpoints.
    fn fingerprint(&self) -> Option<String> {
        None
    }
}

macro_rules! strength_laws {
    ($($(#[$doc:meta])* $key:literal $law:ident),* $(,)?) => {
        /// The strength law of a material: one sub-table, named after the law.
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(rename_all = "snake_case")]
        pub enum Strength {
            $($(#[$doc])* $law($law),)*
            /// A law of the caller's own; no file can name it.
            #[serde(skip)]
            Own(OwnLaw),
        }

        impl Strength {
            /// The keys of all laws that a file can name.
            pub const KEYS: &'static [&'static str] = &[$($key),*];

            /// The key of this law in a file.
            pub fn key(&self) -> &'static str {
                match self {
                    $(Self::$law(_) => $key,)*
                    Self::Own(_) => "own",
                }
            }

            /// The law behind the name.
            pub fn law(&self) -> &dyn StrengthLaw {
                match self {
                    $(Self::$law(law) => law,)*
                    Self::Own(own) => &*own.0,
                }
            }
        }
    };
}

strength_laws! {
    /// Linear elastic: never yields.
    "elastic" Elastic,
    /// Constant flow stress.
    "perfectly_plastic" PerfectlyPlastic,
    /// `σ = σ₀ εⁿ`, met by the elastic line.
    "power_law" PowerLaw,
    /// Johnson–Cook: strain, strain rate and temperature.
    "johnson_cook" JohnsonCook,
    /// Steinberg–Guinan: strain, pressure and temperature, for high rates.
    "steinberg_guinan" SteinbergGuinan,
    /// Concrete of a given unconfined compressive strength.
    "concrete" Concrete,
}
