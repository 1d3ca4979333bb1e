//! Warnings of states that leave the range of a material's record.

use super::{Material, Strength};
use crate::units::{StrainRate, Temperature, significant};

/// Extremes that a material reached in a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reached {
    /// Largest plastic strain.
    pub plastic_strain: f64,
    /// Largest strain rate [1/s]; `None` where the model does not keep it.
    pub strain_rate: Option<f64>,
    /// Largest temperature [K].
    pub temperature: f64,
}

/// Part of the way from room temperature to melting that may be left: the strength goes with it, and with the strength the heat,
/// so that nothing quite gets there.
const NEARLY_MOLTEN: f64 = 0.01;

impl Reached {
    /// What the record of `material`, which `what` is made of, does not cover; `heated` says whether plastic work heats it.
    pub fn warnings(&self, what: &str, material: &Material, heated: bool) -> Vec<String> {
        let mut warnings = Vec::new();
        let melting = material.melting_temperature;
        let room = material.room_temperature.si();
        if let Some(melting) = melting
            && self.temperature >= melting.si() - NEARLY_MOLTEN * (melting.si() - room)
        {
            warnings.push(format!(
                "the {what} reached its melting point ({melting}): there the law has no strength"
            ));
        }
        let softens = material.strength.law().depends_on_temperature();
        if self.plastic_strain > 0.0 && heated && softens {
            let johnson_cook = matches!(&material.strength, Strength::JohnsonCook(_));
            let unmelted = johnson_cook && melting.is_none();
            let missing = match (material.specific_heat, unmelted) {
                (None, true) => {
                    "specific heat and no melting temperature: it does not warm up, so its strength is not reduced"
                }
                (None, false) => {
                    "specific heat: it does not warm up, so its strength is not reduced"
                }
                (Some(_), true) => "melting temperature: heat does not reduce its strength",
                (Some(_), false) => "",
            };
            if !missing.is_empty() {
                warnings.push(format!("the {what}'s material has no {missing}"));
            }
        }
        let mut beyond = |reached: String, limit: String| {
            warnings.push(format!(
                "the {what} reached {reached}, beyond {limit} to which its law was fitted"
            ));
        };
        let validity = &material.validity;
        if let Some(most) = validity.plastic_strain_max
            && self.plastic_strain > most
        {
            let strain = significant(self.plastic_strain, 3);
            beyond(format!("a plastic strain of {strain}"), most.to_string());
        }
        if let (Some(most), Some(rate)) = (validity.strain_rate_max, self.strain_rate)
            && rate > most.si()
        {
            let rate = StrainRate::new(rate);
            beyond(format!("a strain rate of {rate}"), most.to_string());
        }
        if let Some(most) = validity.temperature_max
            && self.temperature > most.si()
        {
            let temperature = Temperature::new(self.temperature);
            beyond(temperature.to_string(), most.to_string());
        }
        warnings
    }
}
