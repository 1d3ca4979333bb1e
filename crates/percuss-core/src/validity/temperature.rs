//! Projectiles that are not at the temperature their material was measured at.

use super::ValidityDomain;
use crate::{
    material::{FlowState, Material},
    scenario::Scenario,
    units::Temperature,
};

/// Why a model cannot take a projectile at its temperature, if it cannot.
pub(super) fn reason(validity: &ValidityDomain, scenario: &Scenario) -> Option<String> {
    let material = &scenario.projectile.material;
    let room = material.room_temperature;
    let temperature = scenario
        .projectile
        .temperature
        .filter(|temperature| *temperature != room.si())?;
    let shown = Temperature::new(temperature);
    if !validity.start_temperature {
        return Some(format!(
            "it takes a projectile at the temperature of its material's record, {room}, and this one has {shown}"
        ));
    }
    (flow_stress(material, temperature) == flow_stress(material, room.si())).then(|| {
        format!(
            "the strength law of {} does not tell {shown}, the projectile's temperature, from {room}",
            material.name
        )
    })
}

/// Flow stress at a temperature [K] and a strain that any impact reaches [Pa]; `None` for a law that never flows.
fn flow_stress(material: &Material, temperature: f64) -> Option<f64> {
    let law = material.strength.law();
    law.initial_yield_stress(material)?;
    let state = FlowState {
        plastic_strain: 0.1,
        strain_rate: 0.0,
        temperature,
        pressure: 0.0,
    };
    Some(law.prepare(material, 1.0).flow_stress(&state).stress)
}
