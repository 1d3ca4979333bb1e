//! Constraint factor of a target: what the material around it adds to its flow stress.

use super::ConstraintFactor;
use crate::material::{Material, cavity_expansion_pressure_at};

/// Factor on the flow stress of a target material at a temperature [K].
///
/// A number is taken as it is; `cavity-expansion` gives the quasi-static pressure that expands a spherical cavity
/// over the yield stress ([`cavity_expansion_pressure_at`]).
pub fn constraint_factor(factor: ConstraintFactor, material: &Material, temperature: f64) -> f64 {
    match factor {
        ConstraintFactor::Value(value) => value,
        ConstraintFactor::CavityExpansion => {
            let pressure = cavity_expansion_pressure_at(material, temperature);
            match (pressure, material.yield_stress_at(temperature)) {
                (Some(pressure), Some(yield_stress)) => pressure / yield_stress,
                _ => 1.0,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cavity_expansion_constrains_more_than_the_papers_factor() {
        let library = crate::material::Library::built_in();
        let material = library.find("aluminium-2024-t351").unwrap();
        let material = &*material.material;
        let factor = ConstraintFactor::CavityExpansion;
        assert!(constraint_factor(factor, material, material.room_temperature.si()) > 2.7);
    }
}
