//! Bodies whose particles have a stress: deformation gradients averaged over the triangles around a particle, and the constitutive law of a solid that flows.

mod body;
mod kernel;
mod ring;
mod run;
mod setup;
mod state;
mod step;
#[cfg(test)]
mod tests;

pub(super) use self::{
    body::StressBody,
    setup::{expected, is_meant, not_applicable},
};
