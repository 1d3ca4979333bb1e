//! Commands, one file per command: arguments, help and execution.

mod axi_named;
mod calibrate;
mod compare;
mod completions;
mod converge;
mod export;
#[cfg(not(all(feature = "parquet", feature = "png", feature = "serve")))]
mod left_out;
mod limit;
mod man;
mod materials;
mod models;
mod new;
mod research;
mod run;
mod schema;
#[cfg(feature = "serve")]
mod serve;
#[cfg(feature = "parquet")]
mod sweep;
mod uncertainty;
mod validate;

pub use calibrate::Calibrate;
pub use compare::Compare;
pub use completions::Completions;
pub use converge::Converge;
pub use export::Export;
#[cfg(not(feature = "serve"))]
pub use left_out::Serve;
#[cfg(not(feature = "parquet"))]
pub use left_out::Sweep;
pub use limit::Limit;
pub use man::Man;
pub use materials::Materials;
pub use models::Models;
pub use new::New;
pub use research::{Benchmark, Reproduce};
pub use run::Run;
pub use schema::Schema;
#[cfg(feature = "serve")]
pub use serve::Serve;
#[cfg(feature = "parquet")]
pub use sweep::Sweep;
pub use uncertainty::Uncertainty;
pub use validate::Validate;
