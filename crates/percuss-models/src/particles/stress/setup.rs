//! The body of a case whose particles have a stress.

use super::body::StressBody;
use crate::{
    Error, Refusal, Scenario,
    options::{Eos, Formulation, ParticlesOptions},
    particles::{lattice::ROW, setup, shape::Rigid},
    solid::{Behaviour, Law},
    solver::{Control, estimate::ExpectedTimes, limits::Limits},
};

/// Largest angular frequency of a body times the spacing over the speed of longitudinal waves, for the estimate of a run: from 1.84 to 2.32
/// for Poisson's ratios of 0.2 to 0.42, in regular and irregular packings.
const FREQUENCY: f64 = 2.1;
/// Ways of a longitudinal wave across the body after the impact, for the estimate of a run.
const WAYS: f64 = 6.0;
/// How much smaller the time step becomes, per inertia of the impact over the flow stress, for the estimate of a run: with it, steps of strips
/// and plates of copper and steel at 20 to 300 m/s are 0.6 to 2.4 times the estimate.
const SHRINKING: f64 = 5.0;

/// Whether a case asks for particles with a stress.
pub(in super::super) fn is_meant(scenario: &Scenario) -> bool {
    scenario.options.particles.formulation() == Formulation::ParticleStress
}

/// Why a case inside the validity domain gets no number, if it does not.
pub(in super::super) fn not_applicable(scenario: &Scenario) -> Option<Refusal> {
    let (material, id) = setup::material(scenario);
    if material.fracture.is_some() && scenario.options.particles.fracture != Some(false) {
        let reason = format!(
            "no bond breaks with `particles.formulation = \"particle-stress\"`, and the material `{id}` has a table `fracture`"
        );
        let remedy = "add `particles.fracture = false` for a body that does not break, or give `particles.formulation = \"springs\"`";
        return Some(Refusal::new(reason).with_remedy(remedy));
    }
    let is_mie_gruneisen = scenario.options.particles.equation_of_state() == Eos::MieGruneisen;
    if is_mie_gruneisen && material.equation_of_state.is_none() {
        let reason = format!(
            "`particles.equation_of_state = \"mie-gruneisen\"` needs an equation of state, and the material `{id}` has none"
        );
        let remedy = "give the material a table `equation_of_state`, or remove the option";
        return Some(Refusal::new(reason).with_remedy(remedy));
    }
    None
}

/// Constitutive law of a case's particles.
fn law(scenario: &Scenario) -> Law {
    let (material, _) = setup::material(scenario);
    let options: &ParticlesOptions = &scenario.options.particles;
    let fraction = match options.adiabatic_heating() {
        true => options.heat_fraction(),
        false => 0.0,
    };
    let behaviour = Behaviour {
        equation_of_state: options.equation_of_state(),
        rate_effects: options.rate_effects(),
        heat_fraction: fraction,
        viscosity: options.artificial_viscosity(),
    };
    Law::of(material, &behaviour)
}

/// The body of a case at the moment of impact, and the rigid body that it meets.
///
/// # Errors
/// [`Error::Cancelled`].
pub(super) fn build(
    scenario: &Scenario,
    control: &mut Control<'_>,
) -> Result<(StressBody, Rigid), Error> {
    let (frame, rigid) = setup::build(scenario, control)?;
    let temperature = setup::material(scenario).0.room_temperature.si();
    let body = StressBody::new(frame, law(scenario), temperature, control)?;
    Ok((body, rigid))
}

/// Mean time step [s], expected duration [s] and limits of a run before it starts.
pub(in super::super) fn expected(scenario: &Scenario) -> (f64, f64, Limits) {
    let options = &scenario.options.particles;
    let law = law(scenario);
    let modulus = law.bulk_modulus + 4.0 / 3.0 * law.shear_modulus;
    let wave_speed = (modulus / law.density).sqrt();
    let extent = setup::extent(scenario);
    // As of a run: with a spring of the contact beside the triangles, of the mass of a particle inside.
    let frequency =
        (FREQUENCY * FREQUENCY + 2.0 / (ROW * ROW)).sqrt() * wave_speed / extent.spacing();
    let time_step = options.courant() * 2.0 / frequency;
    let crossing = WAYS * extent.length.max(extent.width) / wave_speed;
    let end = crossing + ExpectedTimes::of(scenario).stop;
    let inertia = law.density * scenario.impact_velocity.powi(2);
    let (material, _) = setup::material(scenario);
    let flow_stress = material.flow_stress(0.2).unwrap_or(f64::INFINITY);
    let smaller = 1.0 + SHRINKING * inertia / flow_stress;
    let limits = setup::limits(scenario, wave_speed, false);
    (time_step / smaller, end, limits)
}
