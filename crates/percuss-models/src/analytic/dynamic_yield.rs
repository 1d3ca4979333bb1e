//! The one flow stress that stands for a strength law in a model of a rigid, perfectly plastic rod.

use crate::{
    Refusal, Scenario,
    bisection::bisect_ratio,
    material::{FlowState, Material},
    options::ChainOptions,
    units::Pressure,
};

/// Panels of the mean over plastic strain.
const PANELS: u32 = 100;
/// How far from the initial yield stress a mean flow stress is looked for.
const FACTOR: f64 = 1e4;
const BISECTIONS: u32 = 100;

/// What a rod of one flow stress does on a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Shortening {
    /// Final length over initial length.
    pub(super) length: f64,
    /// Mean logarithmic strain of the part that the plastic front has passed.
    pub(super) strain: f64,
}

/// The flow stress of a rod with what it rests on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct DynamicYield {
    /// Flow stress [Pa].
    pub(super) stress: f64,
    /// Mean logarithmic strain of the deformed part.
    pub(super) strain: f64,
    /// Mean strain rate [1/s].
    pub(super) strain_rate: f64,
}

/// Mean flow stress over a plastic strain at a constant strain rate [1/s] [Pa], `∫₀^ε σ dε/ε`; `None` for a law that never flows.
///
/// Where heat softens the law and the record has a specific heat, 0.9 of the plastic work stays as heat.
pub fn mean_flow_stress(material: &Material, plastic_strain: f64, strain_rate: f64) -> Option<f64> {
    let law = material.strength.law();
    law.initial_yield_stress(material)?;
    let prepared = law.prepare(material, 1.0);
    let heat = match material.specific_heat {
        Some(specific_heat) if law.depends_on_temperature() => {
            ChainOptions::default().heat_fraction() / (material.density.si() * specific_heat.si())
        }
        _ => 0.0,
    };
    let step = plastic_strain / f64::from(PANELS);
    let mut temperature = material.room_temperature.si();
    let mut sum = 0.0;
    for i in 0..PANELS {
        let state = FlowState {
            plastic_strain: (f64::from(i) + 0.5) * step,
            strain_rate,
            temperature,
            pressure: 0.0,
        };
        let stress = prepared.flow_stress(&state).stress;
        temperature += heat * stress * step;
        sum += stress;
    }
    Some(sum / f64::from(PANELS))
}

/// The flow stress of the projectile [Pa] that is its own mean over the strain that it leads to, at the rate that it leads to.
///
/// Strain is the mean logarithmic one of the deformed part; the rate is that strain over the time `2(L₀ − L_f)/V` in which a rear
/// that slows down evenly comes to rest. Nothing is fitted. `shorten` gives strain and length for `ρV²/Y`.
///
/// # Errors
/// The reason in words when the law never flows or melts away.
pub(super) fn dynamic_yield(
    scenario: &Scenario,
    given: Option<Pressure>,
    table: &str,
    shorten: impl Fn(f64) -> Shortening,
) -> Result<DynamicYield, Refusal> {
    let rod = &scenario.projectile;
    let speed = scenario.impact_velocity;
    let number = |stress: f64| rod.material.density.si() * speed * speed / stress;
    let reached = |stress: f64| {
        let Shortening { length, strain } = shorten(number(stress));
        let shortening = rod.length * (1.0 - length);
        let strain_rate = if shortening > 0.0 {
            strain * speed / (2.0 * shortening)
        } else {
            0.0
        };
        DynamicYield {
            stress,
            strain,
            strain_rate,
        }
    };
    if let Some(given) = given {
        return Ok(reached(given.si()));
    }
    let remedy = || format!("give `{table}.dynamic_yield_stress`");
    let law = rod.material.strength.law();
    let initial = law.initial_yield_stress(&rod.material).ok_or_else(|| {
        Refusal::new("the projectile's material never yields").with_remedy(remedy())
    })?;
    let excess = |stress: f64| {
        let rod_state = reached(stress);
        mean_flow_stress(&rod.material, rod_state.strain, rod_state.strain_rate)
            .map_or(f64::NAN, |mean| mean - stress)
    };
    let (low, high) = (initial / FACTOR, initial * FACTOR);
    if excess(low) <= 0.0 || excess(high) >= 0.0 {
        let reason = "no flow stress is its own mean over the strain that it leads to, as the projectile would melt";
        return Err(Refusal::new(reason).with_remedy(remedy()));
    }
    let (low, high) = bisect_ratio(low, high, BISECTIONS, |stress| excess(stress) > 0.0);
    Ok(reached((low * high).sqrt()))
}

impl DynamicYield {
    /// Says where the strength law was taken beyond the range of its fit.
    pub(super) fn warnings(&self, material: &Material) -> Vec<String> {
        let beyond = |what: &str, value: f64, limit: Option<f64>| {
            limit.filter(|limit| value > *limit).map(|limit| {
                format!(
                    "the mean {what} of {value:.3} is beyond {limit}, where the strength law of {} was fitted",
                    material.name
                )
            })
        };
        let rate = material.validity.strain_rate_max.map(|rate| rate.si());
        beyond("strain", self.strain, material.validity.plastic_strain_max)
            .into_iter()
            .chain(beyond("strain rate [1/s]", self.strain_rate, rate))
            .collect()
    }
}
