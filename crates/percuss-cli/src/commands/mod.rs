//! One file a command: its arguments, its help and what it does.

mod calibrate;
mod compare;
mod completions;
mod converge;
mod judge;
mod limit;
mod man;
mod materials;
mod models;
mod new;
mod reproduce;
mod run;
mod schema;
mod serve;
mod sweep;
mod uncertainty;
mod validate;

pub use calibrate::Calibrate;
pub use compare::Compare;
pub use completions::Completions;
pub use converge::Converge;
pub use judge::Judge;
pub use limit::Limit;
pub use man::Man;
pub use materials::Materials;
pub use models::Models;
pub use new::New;
pub use reproduce::Reproduce;
pub use run::Run;
pub use schema::Schema;
pub use serve::Serve;
pub use sweep::Sweep;
pub use uncertainty::Uncertainty;
pub use validate::Validate;
