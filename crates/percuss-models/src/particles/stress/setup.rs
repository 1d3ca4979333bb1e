//! The body of a case whose particles have a stress.

use super::body::StressBody;
use crate::{
    Error, Refusal, Scenario,
    material::StateEquation,
    options::{Eos, Formulation, ParticlesOptions},
    particles::{lattice::ROW, setup, shape::Rigid},
    scenario::TargetBody,
    solid::{Law, Pressure},
    solver::{Control, limits::Limits},
};

/// Largest angular frequency of a regular body times the spacing over the speed of longitudinal waves, for the estimate of a run.
const FREQUENCY: f64 = 2.6;
/// Ways along a strip on a wall, and through a plate, for the estimate of a run.
const WAYS: f64 = 12.0;

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
    let state = match options.equation_of_state() {
        Eos::Linear => None,
        Eos::MieGruneisen => StateEquation::of(material),
    };
    Law {
        density: material.density.si(),
        shear_modulus: material.shear_modulus(),
        bulk_modulus: material.bulk_modulus(),
        pressure: state.map_or(Pressure::Linear, Pressure::MieGruneisen),
        strength: material.strength.law().prepare(material, 1.0),
        rate_effects: options.rate_effects(),
        heating: material
            .specific_heat
            .map_or(0.0, |heat| fraction / heat.si()),
        viscosity: options.artificial_viscosity(),
        spall_strength: None,
        damage: None,
        band_width: 1.0,
        failure_strain: None,
        erode_failed: false,
        erosion_strain: None,
        axisymmetric: false,
    }
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

/// Time step [s], expected duration [s] and limits of a run before it starts.
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
    let end = match scenario.target {
        TargetBody::Layers { .. } => crossing + extent.length / scenario.impact_velocity.max(1.0),
        // A bar that yields comes to rest in about its length over the velocity of the impact.
        _ => crossing.max(extent.length / scenario.impact_velocity.max(1.0)),
    };
    let limits = setup::limits(scenario, wave_speed, false);
    (time_step, end, limits)
}
