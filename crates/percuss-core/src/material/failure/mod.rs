//! Failure laws: when material in tension parts. Adding one is one file here and one line in the `failure_laws!` list.

mod johnson_cook;
mod own;
mod spall;
mod tuler_butcher;

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Material;
use crate::check::Check;

pub use johnson_cook::JohnsonCookDamage;
pub use own::OwnFailure;
pub use spall::Spall;
pub use tuler_butcher::TulerButcher;

/// State that damage grows by over a time step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FailureState {
    /// Axial stress, tension positive [Pa].
    pub tension: f64,
    /// Mean stress over equivalent stress, tension positive.
    pub triaxiality: f64,
    /// Equivalent plastic strain of the step.
    pub plastic_strain_increment: f64,
    /// Rate of the plastic strain [1/s]; 0 where rates have no effect.
    pub strain_rate: f64,
    /// Temperature [K].
    pub temperature: f64,
}

/// A failure law made ready for one material.
pub trait PreparedFailure: fmt::Debug + Send + Sync {
    /// Damage after a time step [s], from that before it and the state at its end; failed at 1.
    fn damage(&self, before: f64, state: &FailureState, time_step: f64) -> f64;
}

/// What every failure law says of itself.
pub trait FailureLaw {
    /// Makes the law ready for a material; `None` when neither the case nor the material's record has its numbers.
    fn prepare(&self, material: &Material) -> Option<Box<dyn PreparedFailure>>;

    /// Key of a material's record that holds the numbers of this law.
    fn record_key(&self) -> &'static str;

    /// Checks what the case gives, reporting keys relative to the law's table.
    fn check(&self, check: &mut Check<'_>);

    /// Of a law of the caller's own, text that differs between laws with different results, numbers with all their digits included: a checkpoint belongs to it. `None`
    /// refuses checkpoints.
    fn fingerprint(&self) -> Option<String> {
        None
    }
}

macro_rules! failure_laws {
    ($($(#[$doc:meta])* $key:literal $law:ident),* $(,)?) => {
        /// A failure law: one sub-table, named after the law.
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
        pub enum Failure {
            $($(#[$doc])* #[serde(rename = $key)] $law($law),)*
            /// A law of the caller's own; no file can name it.
            #[serde(skip)]
            Own(OwnFailure),
        }

        impl Failure {
            /// The key of this law in a file.
            pub fn key(&self) -> &'static str {
                match self {
                    $(Self::$law(_) => $key,)*
                    Self::Own(_) => "own",
                }
            }

            /// The law behind the name.
            pub fn law(&self) -> &dyn FailureLaw {
                match self {
                    $(Self::$law(law) => law,)*
                    Self::Own(own) => &*own.0,
                }
            }
        }
    };
}

failure_laws! {
    /// At once, where the tension reaches the spall strength.
    "spall" Spall,
    /// Cumulative: by how much and for how long the tension passes a threshold.
    "tuler_butcher" TulerButcher,
    /// Johnson–Cook: plastic strain over a failure strain.
    "johnson_cook" JohnsonCookDamage,
}
