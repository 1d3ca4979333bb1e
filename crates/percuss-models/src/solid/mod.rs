//! Isotropic solids that flow: the constitutive law of the models in two dimensions, eight material points at a time.

mod deform;
mod law;
mod points;
mod rates;

pub(crate) use self::{
    deform::Work,
    law::{Behaviour, Law},
    points::{MaterialPoints, set_one},
    rates::Rates,
};
