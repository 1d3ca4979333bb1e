//! Balls as one particle each: contact by Hertz and by Mindlin.

pub(super) mod law;
pub(super) mod motion;
mod run;

use std::f64::consts::PI;

pub(super) use self::run::Collision;
use self::{
    law::{HertzLaw, Meeting},
    motion::Ball,
};
use super::lattice::Solid;
use crate::{
    Refusal, Scenario,
    check::limits::MOVING,
    material::{Material, Strength},
    options::{Outline, ParticleContact},
    problem::{Nose, RearFaceCondition},
    scenario::TargetBody,
    solver::{Estimate, estimate::WorkRate, limits::Limits},
    units::{Length, Mass},
};

/// Memory of a ball [bytes], and balls times steps per second of processor time.
const WORK: WorkRate = WorkRate {
    bytes: 1e4,
    rate: 2e6,
};
/// Part of the mass of a ball by which that of the case may differ: tables round diameters and masses.
const MASS_TOLERANCE: f64 = 0.01;
/// Time steps in the largest that is stable, at a Courant number of 1: some 4000 per contact at the default.
const STEPS: f64 = 1000.0;

/// Whether projectile and target are one particle each.
pub(super) fn is_meant(scenario: &Scenario) -> bool {
    scenario.options.particles.contact() == ParticleContact::Hertz
}

/// Number of balls.
pub(super) fn count(scenario: &Scenario) -> f64 {
    if is_target_ball(scenario) { 2.0 } else { 1.0 }
}

fn is_target_ball(scenario: &Scenario) -> bool {
    scenario.options.particles.outline() == Outline::Ball
}

/// Material of the target with its id, if it has one.
fn target_material(scenario: &Scenario) -> Option<(&Material, &str)> {
    match &scenario.target {
        TargetBody::Layers { layers, .. } => {
            let plate = layers.first()?;
            Some((&plate.material, &plate.material_id))
        }
        _ => None,
    }
}

/// Why a case inside the validity domain gets no number, if it does not.
pub(super) fn not_applicable(scenario: &Scenario) -> Option<Refusal> {
    let rod = &scenario.projectile;
    let own: (&Material, &str) = (&rod.material, &rod.material_id);
    let yielding = std::iter::once(own)
        .chain(target_material(scenario))
        .find(|(material, _)| !matches!(material.strength, Strength::Elastic(_)));
    if let Some((_, id)) = yielding {
        let reason = format!(
            "a Hertz contact is elastic, and the material `{id}` yields: it takes materials of the strength law `elastic`"
        );
        return Some(Refusal::new(reason).with_remedy("use the model `axi` or `chain`"));
    }
    not_a_ball(scenario).or_else(|| not_a_target(scenario))
}

/// Why the projectile is no ball, if it is none.
fn not_a_ball(scenario: &Scenario) -> Option<Refusal> {
    let rod = &scenario.projectile;
    let mass = rod.material.density.si() * PI / 6.0 * rod.diameter.powi(3);
    if rod.nose == Nose::Hemisphere && (rod.mass / mass - 1.0).abs() <= MASS_TOLERANCE {
        return None;
    }
    let reason = "`particles.contact = \"hertz\"` takes the projectile as a ball of its diameter, and its nose or its mass is not that of one";
    let remedy = format!(
        "give `projectile.nose = \"hemisphere\"` and `projectile.mass = \"{}\"` instead of a length",
        Mass::new(mass)
    );
    Some(Refusal::new(reason).with_remedy(remedy))
}

/// Why a ball does not meet the target, if it does not.
fn not_a_target(scenario: &Scenario) -> Option<Refusal> {
    if is_target_ball(scenario) {
        if scenario.rear_face() == Some(RearFaceCondition::NonReflecting) {
            let reason = "a ball as the target has no non-reflecting rear face";
            let remedy =
                "give `target.back_face` as \"free\", or \"fixed\" for a ball that is held";
            return Some(Refusal::new(reason).with_remedy(remedy));
        }
        return None;
    }
    scenario.target_thickness().map(|thickness| {
        let reason = format!(
            "a Hertz contact is that of a half-space, and the target is a plate of {}: its bending and its rear face are not described",
            Length::new(thickness)
        );
        let remedy = "give `target.thickness = \"semi-infinite\"`, a rigid wall, or a ball by `particles.outline = \"ball\"`";
        Refusal::new(reason).with_remedy(remedy)
    })
}

fn solid(material: &Material) -> Solid {
    Solid {
        density: material.density.si(),
        youngs_modulus: material.youngs_modulus.si(),
        poissons_ratio: material.poissons_ratio,
    }
}

/// Materials of projectile and target; `None` for a rigid wall.
fn solids(scenario: &Scenario) -> [Option<Solid>; 2] {
    let target = target_material(scenario).map(|(material, _)| solid(material));
    [Some(solid(&scenario.projectile.material)), target]
}

/// Projectile and target as they touch.
fn balls(scenario: &Scenario) -> [Ball; 2] {
    let (rod, angle) = (&scenario.projectile, scenario.obliquity);
    let radius = 0.5 * rod.diameter;
    let mut projectile = Ball::new(radius, rod.mass, [0.0, -radius]);
    let speed = scenario.impact_velocity;
    projectile.velocity = [speed * angle.sin(), speed * angle.cos()];
    let target = match (is_target_ball(scenario), target_material(scenario)) {
        (true, Some((material, _))) => {
            let radius = 0.5 * scenario.target_thickness().unwrap_or(rod.diameter);
            let mass = material.density.si() * 4.0 / 3.0 * PI * radius.powi(3);
            let ball = Ball::new(radius, mass, [0.0, radius]);
            match scenario.rear_face() {
                Some(RearFaceCondition::Free) => ball,
                _ => ball.held(),
            }
        }
        _ => Ball::plane(),
    };
    [projectile, target]
}

/// Law of the contact of a case.
fn law(scenario: &Scenario) -> HertzLaw {
    let options = &scenario.options.particles;
    let balls = balls(scenario);
    let meeting = Meeting {
        solids: solids(scenario),
        radii: balls.map(|ball| ball.radius),
        inverse_masses: balls.map(|ball| ball.inverse_mass),
    };
    HertzLaw::new(&meeting, options.restitution(), options.friction())
}

/// Time step at a Courant number [s], and time of an impact without damping.
fn times(scenario: &Scenario, courant: f64) -> (f64, f64) {
    let law = law(scenario);
    let velocity = (scenario.impact_velocity * scenario.obliquity.cos()).max(MOVING.min);
    let approach = law.largest_approach(velocity);
    let stable = 2.0 / law.frequency(approach);
    (courant * stable / STEPS, CONTACT_TIME * approach / velocity)
}

/// Time of an elastic contact over that in which its largest approach is gone at the velocity of the impact: the integral of
/// `2 (1 − x^{5/2})^{−1/2}` from 0 to 1, `(4/5) √π Γ(2/5)/Γ(9/10)`.
const CONTACT_TIME: f64 = 2.943_275;

/// When a run ends at the latest.
fn limits(scenario: &Scenario) -> Limits {
    let options = &scenario.options.particles;
    Limits::new(scenario, options.end_time, options.max_steps())
}

/// Cost of a run.
pub(super) fn estimate(scenario: &Scenario) -> Estimate {
    let (step, contact) = times(scenario, scenario.options.particles.courant());
    let work = WORK.of(count(scenario));
    Estimate::of_time(work, (contact, step), limits(scenario))
}
