//! Warnings of states beyond the range of a material record.

use super::grid::View;
use crate::{
    material::Material,
    units::{StrainRate, Temperature, significant},
};

/// Adds warnings on one material.
pub(super) fn warn_of_material(
    what: &str,
    material: &Material,
    cells: impl Iterator<Item = View>,
    heated: bool,
    warnings: &mut Vec<String>,
) {
    let (mut strain, mut rate, mut temperature) = (0.0_f64, 0.0_f64, 0.0_f64);
    for view in cells {
        strain = strain.max(view.plastic_strain);
        rate = rate.max(view.strain_rate);
        temperature = temperature.max(view.temperature);
    }
    if let Some(melting) = material.melting_temperature
        && temperature >= melting.si()
    {
        warnings.push(format!(
            "the {what} reached its melting point ({melting}): there the law has no strength"
        ));
    }
    let softens = material.strength.law().depends_on_temperature();
    if strain > 0.0 && heated && softens && material.specific_heat.is_none() {
        warnings.push(format!(
            "the {what}'s material has no specific heat: it does not warm up, so its strength is not reduced"
        ));
    }
    let validity = &material.validity;
    let mut beyond = |reached: String, limit: String| {
        warnings.push(format!(
            "the {what} reached {reached}, beyond {limit} to which its law was fitted"
        ));
    };
    if let Some(most) = validity.plastic_strain_max.filter(|most| strain > *most) {
        beyond(
            format!("a plastic strain of {}", significant(strain, 3)),
            most.to_string(),
        );
    }
    if let Some(most) = validity.strain_rate_max.filter(|most| rate > most.si()) {
        beyond(
            format!("a strain rate of {}", StrainRate::new(rate)),
            most.to_string(),
        );
    }
    if let Some(most) = validity
        .temperature_max
        .filter(|most| temperature > most.si())
    {
        beyond(Temperature::new(temperature).to_string(), most.to_string());
    }
}
