use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{FailureLaw, FailureState, PreparedFailure};
use crate::{
    check::{Check, limits},
    material::Material,
    units::Pressure,
};

/// Instant failure at a tension: the spall strength.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Spall {
    /// Spall strength of every body [Pa]; `spall_strength` of each material's record when not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strength: Option<Pressure>,
}

#[derive(Debug)]
struct Prepared {
    strength: f64,
}

impl PreparedFailure for Prepared {
    fn damage(&self, _: f64, state: &FailureState, _: f64) -> f64 {
        state.tension.max(0.0) / self.strength
    }
}

impl FailureLaw for Spall {
    fn prepare(&self, material: &Material) -> Option<Box<dyn PreparedFailure>> {
        let strength = self.strength.or(material.spall_strength)?.si();
        Some(Box::new(Prepared { strength }))
    }

    fn record_key(&self) -> &'static str {
        "spall_strength"
    }

    fn check(&self, check: &mut Check<'_>) {
        check.quantity("strength", self.strength, limits::FLOW_STRESS);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Library;

    #[test]
    fn it_fails_at_its_strength_and_keeps_no_memory() {
        let copper = &Library::built_in().find("copper").unwrap().material;
        let law = Spall {
            strength: Some(Pressure::new(1.2e9)),
        };
        let law = law.prepare(copper).unwrap();
        let damage = |tension: f64| {
            let state = FailureState {
                tension,
                triaxiality: 1.0 / 3.0,
                plastic_strain_increment: 0.0,
                strain_rate: 0.0,
                temperature: 293.0,
            };
            law.damage(0.7, &state, 1e-9)
        };
        assert_eq!(damage(1.2e9), 1.0);
        assert_eq!(damage(0.6e9), 0.5);
        assert_eq!(damage(-5e9), 0.0);
    }

    #[test]
    fn a_material_without_a_strength_does_not_fail() {
        let mut material = Library::built_in()
            .find("copper")
            .unwrap()
            .material
            .as_ref()
            .clone();
        material.spall_strength = None;
        assert!(Spall::default().prepare(&material).is_none());
        material.spall_strength = Some(Pressure::new(1e9));
        assert!(Spall::default().prepare(&material).is_some());
    }
}
