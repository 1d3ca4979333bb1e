use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{FailureLaw, FailureState, PreparedFailure};
use crate::{
    check::{Check, limits},
    material::Material,
    units::{Pressure, Time},
};

/// Cumulative failure: `∫ (σ − σ₀)^λ dt ≥ K` over the times at which the tension σ passes σ₀ \[tuler1968\].
///
/// In a case, numbers hold for every body; without any, those of each material's record do.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TulerButcher {
    /// Threshold σ₀ [Pa].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub threshold: Option<Pressure>,
    /// Exponent λ.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exponent: Option<f64>,
    /// Time that twice the threshold takes to part the material [s]: K is `σ₀^λ` times it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time_at_twice_threshold: Option<Time>,
}

impl TulerButcher {
    fn prepared(&self) -> Option<Prepared> {
        Some(Prepared {
            threshold: self.threshold?.si(),
            exponent: self.exponent?,
            time: self.time_at_twice_threshold?.si(),
        })
    }

    /// Reports numbers that are missing or out of range.
    pub(crate) fn check_numbers(&self, check: &mut Check<'_>) {
        for (key, given) in [
            ("threshold", self.threshold.is_some()),
            ("exponent", self.exponent.is_some()),
            (
                "time_at_twice_threshold",
                self.time_at_twice_threshold.is_some(),
            ),
        ] {
            if !given {
                check.fail(
                    "",
                    format!("the law of Tuler and Butcher has no `{key}`"),
                    "give `threshold`, `exponent` and `time_at_twice_threshold`",
                );
            }
        }
        check.quantity("threshold", self.threshold, limits::FLOW_STRESS);
        check.number("exponent", self.exponent, limits::FAILURE_EXPONENT);
        check.quantity(
            "time_at_twice_threshold",
            self.time_at_twice_threshold,
            limits::FAILURE_TIME,
        );
    }
}

#[derive(Debug)]
struct Prepared {
    threshold: f64,
    exponent: f64,
    time: f64,
}

impl PreparedFailure for Prepared {
    fn damage(&self, before: f64, state: &FailureState, time_step: f64) -> f64 {
        let excess = state.tension / self.threshold - 1.0;
        if excess > 0.0 {
            before + excess.powf(self.exponent) * time_step / self.time
        } else {
            before
        }
    }
}

impl FailureLaw for TulerButcher {
    fn prepare(&self, material: &Material) -> Option<Box<dyn PreparedFailure>> {
        let own = self.prepared();
        let prepared = own.or_else(|| material.tuler_butcher.as_ref()?.prepared())?;
        Some(Box::new(prepared))
    }

    fn record_key(&self) -> &'static str {
        "tuler_butcher"
    }

    fn check(&self, check: &mut Check<'_>) {
        // Without any number, those of the materials' records are meant.
        if *self != Self::default() {
            self.check_numbers(check);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Library;

    /// A triangular pulse of peak p and length d has `∫ (σ − σ₀)^λ dt = (p − σ₀)^{λ+1} d / ((λ + 1) p)`.
    #[test]
    fn a_triangular_pulse_does_the_damage_of_its_integral() {
        let (threshold, exponent, time) = (1e9, 1.7, 2e-7);
        let law = TulerButcher {
            threshold: Some(Pressure::new(threshold)),
            exponent: Some(exponent),
            time_at_twice_threshold: Some(Time::new(time)),
        };
        let copper = &Library::built_in().find("copper").unwrap().material;
        let law = law.prepare(copper).unwrap();
        let (peak, length, steps) = (2.6e9, 1e-6, 200_000);
        let step = length / f64::from(steps);
        let mut damage = 0.0;
        for i in 0..steps {
            let part = (f64::from(i) + 0.5) / f64::from(steps);
            let state = FailureState {
                tension: peak * (1.0 - (2.0 * part - 1.0).abs()),
                triaxiality: 1.0 / 3.0,
                plastic_strain_increment: 0.0,
                strain_rate: 0.0,
                temperature: 293.0,
            };
            damage = law.damage(damage, &state, step);
        }
        let integral = (peak - threshold).powf(exponent + 1.0) * length / ((exponent + 1.0) * peak);
        let exact = integral / (threshold.powf(exponent) * time);
        assert!((damage / exact - 1.0).abs() < 1e-6, "{damage} {exact}");
    }
}
