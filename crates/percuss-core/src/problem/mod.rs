//! The parts of a problem as a case file has them: projectile, target with its boundary conditions, experiments.

mod experiment;
mod extensions;
mod gauge;
mod measured_table;
mod nose;
mod projectile;
mod target;

pub use experiment::{Experiment, SourceKeys, Uncertainty};
pub use extensions::Extensions;
pub use gauge::{Gauge, HistoryOptions};
pub use measured_table::{CurveUncertainty, MeasuredTable};
pub use nose::{ConeGeometry, Nose, NoseGeometry, OgiveGeometry};
pub use projectile::Projectile;
pub use target::{EdgeSupport, Layer, LayerInterface, RearFaceCondition, Target, Thickness};
