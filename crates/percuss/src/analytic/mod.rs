//! Models that are a formula or a few differential equations.

mod awerbuch_bodner;
mod lambert_jonas;
mod limit;
mod nose_shape;
mod plate_cavity;
mod plate_shot;
mod plugging;
mod recht_ipson;

pub use awerbuch_bodner::{AwerbuchBodner, AwerbuchBodnerOptions};
pub use lambert_jonas::{LambertJonas, LambertJonasOptions};
pub use plate_cavity::{Cavity, PlateCavity, PlateCavityOptions};
pub use plugging::{Plugging, PluggingOptions};
pub use recht_ipson::{RechtIpson, RechtIpsonOptions};
