//! Constraint factor of a target: what the material around it adds to its flow stress.

use super::ConstraintFactor;
use crate::material::{Material, cavity_expansion_pressure};

/// Factor on the flow stress of a target material.
///
/// A number is taken as it is; `cavity-expansion` gives the quasi-static pressure that expands a spherical cavity
/// over the yield stress ([`cavity_expansion_pressure`]).
pub fn constraint_factor(factor: ConstraintFactor, material: &Material) -> f64 {
    match factor {
        ConstraintFactor::Value(value) => value,
        ConstraintFactor::CavityExpansion => {
            let yield_stress = material.strength.law().initial_yield_stress(material);
            match (cavity_expansion_pressure(material), yield_stress) {
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
        assert!(constraint_factor(ConstraintFactor::CavityExpansion, &material.material) > 2.7);
    }
}
