//! Every depth model against the axisymmetric reference, over a design of experiments.

pub mod design;
pub mod reference;

pub use design::{Shot, shots};
pub use reference::Reference;
