use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{FailureLaw, FailureState, PreparedFailure};
use crate::{
    check::Check,
    material::{DamageState, Material, PreparedDamage},
};

/// Johnson–Cook damage with the numbers of the materials' records: plastic strain adds up over a failure strain that depends on
/// triaxiality, rate and temperature \[johnson1985a\].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JohnsonCookDamage {}

#[derive(Debug)]
struct Prepared(PreparedDamage);

impl PreparedFailure for Prepared {
    fn damage(&self, before: f64, state: &FailureState, _: f64) -> f64 {
        let increment = state.plastic_strain_increment;
        let state = DamageState {
            triaxiality: state.triaxiality,
            strain_rate: state.strain_rate,
            temperature: state.temperature,
        };
        self.0.grow(before, &state, increment)
    }
}

impl FailureLaw for JohnsonCookDamage {
    fn prepare(&self, material: &Material) -> Option<Box<dyn PreparedFailure>> {
        let damage = material.damage.as_ref()?;
        Some(Box::new(Prepared(damage.prepare(material))))
    }

    fn record_key(&self) -> &'static str {
        "damage"
    }

    fn check(&self, _: &mut Check<'_>) {}
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Library;

    /// At a constant state the bar fails when its plastic strain is the failure strain at its rate and temperature.
    #[test]
    fn a_bar_that_is_drawn_at_a_rate_fails_at_its_failure_strain() {
        let metal = Library::built_in()
            .iter()
            .find(|entry| entry.material.damage.is_some())
            .unwrap();
        let metal = &metal.material;
        let law = JohnsonCookDamage {}.prepare(metal).unwrap();
        let (rate, step) = (2e3, 1e-9);
        let temperature = metal.room_temperature.si() + 100.0;
        let exact = metal
            .damage
            .as_ref()
            .unwrap()
            .prepare(metal)
            .failure_strain(&DamageState {
                triaxiality: 1.0 / 3.0,
                strain_rate: rate,
                temperature,
            });
        let state = FailureState {
            tension: 1e9,
            triaxiality: 1.0 / 3.0,
            plastic_strain_increment: rate * step,
            strain_rate: rate,
            temperature,
        };
        let (mut damage, mut strain) = (0.0, 0.0);
        while damage < 1.0 {
            damage = law.damage(damage, &state, step);
            strain += state.plastic_strain_increment;
        }
        assert!(
            (strain - exact).abs() <= 1.01 * rate * step,
            "{strain} {exact}"
        );
    }
}
