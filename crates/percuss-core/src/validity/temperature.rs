//! Bodies that are not at the temperature their material was measured at.

use super::ValidityDomain;
use crate::{
    material::Material,
    scenario::{Scenario, is_room_temperature},
    units::Temperature,
};

/// Plastic strain that any impact reaches.
const REACHED_STRAIN: f64 = 0.1;

/// Why a model cannot take a body at its temperature, if it cannot.
pub(super) fn reason(validity: &ValidityDomain, scenario: &Scenario) -> Option<String> {
    let rod = &scenario.projectile;
    let layers = scenario.layers().iter();
    let layers = layers.map(|layer| ("target", &*layer.material, layer.start_temperature()));
    std::iter::once(("projectile", &*rod.material, rod.start_temperature()))
        .chain(layers)
        .find_map(|(what, material, temperature)| of_body(validity, what, material, temperature))
}

/// Why a model cannot take a projectile or a layer of the target at its temperature [K], if it cannot.
fn of_body(
    validity: &ValidityDomain,
    what: &str,
    material: &Material,
    temperature: f64,
) -> Option<String> {
    let room = material.room_temperature;
    if is_room_temperature(temperature, material) {
        return None;
    }
    let shown = Temperature::new(temperature);
    if !validity.start_temperature {
        return Some(format!(
            "it takes a {what} at the temperature of its material's record, {room}, and this one has {shown}"
        ));
    }
    let flow_stress = |temperature| material.flow_stress_at(REACHED_STRAIN, temperature);
    (flow_stress(temperature) == flow_stress(room.si())).then(|| {
        format!(
            "the strength law of {} does not tell {shown}, the {what}'s temperature, from {room}",
            material.name
        )
    })
}
