//! From the state at the end of a run to its result.

use super::{part::Role, state::State, warnings::warnings};
use crate::{
    fragments::Fragment,
    material::Reached,
    outcome::{Detail, RunResult},
    scenario::{Scenario, TargetBody},
    solver::{interface::Extremes, monitor::RunMonitor},
};

/// What a result is made of.
pub(super) struct Results<'a> {
    pub(super) scenario: &'a Scenario,
    pub(super) state: &'a State,
    pub(super) erosion_strain: f64,
}

/// Unloaded size of what is left, and what has left.
#[derive(Default)]
struct Remains {
    permanent_depth: f64,
    projectile_length: f64,
    projectile_diameter: Option<f64>,
    eroded: (usize, usize),
}

impl Results<'_> {
    /// Mesh and extremes of the material.
    pub(super) fn extremes(&self) -> Extremes {
        let (options, reached) = (&self.scenario.options.chain, self.reached());
        let most = |role: Role, value: fn(&Reached) -> f64| {
            let own = reached
                .iter()
                .zip(&self.state.parts)
                .filter(|(_, part)| part.role == role);
            own.map(|(reached, _)| value(reached)).fold(0.0, f64::max)
        };
        Extremes {
            elements: (options.projectile_elements(), options.target_elements()),
            eroded_elements: self.remains().eroded,
            largest_plastic_strain: (
                most(Role::Projectile, |r| r.plastic_strain),
                most(Role::Target, |r| r.plastic_strain),
            ),
            largest_temperature: (
                most(Role::Projectile, |r| r.temperature),
                most(Role::Target, |r| r.temperature),
            ),
        }
    }

    /// Adds depths, what is left of the projectile, the plug, fragments and warnings.
    pub(super) fn complete(&self, result: &mut RunResult, monitor: &RunMonitor) {
        let (scenario, state) = (self.scenario, self.state);
        let remains = self.remains();
        let (mass, momentum) = state.projectile_motion();
        let depth = match scenario.target {
            TargetBody::RigidWall => None,
            // What flies has no depth.
            _ if state.left_the_plate() => None,
            _ => Some(monitor.depth_at_rest()),
        };
        result.depth_of_penetration = depth;
        result.largest_depth = depth.map(|_| monitor.largest_depth);
        result.permanent_depth = match scenario.target {
            // The compression of a plug is not its depth.
            _ if state.hold.is_some() => None,
            TargetBody::Layers { .. } => Some(remains.permanent_depth),
            TargetBody::ConstantPressure(_) => Some(monitor.largest_depth),
            TargetBody::RigidWall => None,
        };
        result.residual_velocity = Some(if mass > 0.0 { momentum / mass } else { 0.0 });
        result.projectile_final_length = Some(remains.projectile_length);
        result.projectile_final_diameter = remains.projectile_diameter;
        result.projectile_final_mass = Some(mass);
        if state.left_the_plate() {
            let (mass, velocity) = state.plug_motion();
            result.plug_mass = Some(mass);
            result.plug_velocity = Some(velocity);
        }
        result.fragments = state.fragments();
        result.details = self.details(&result.fragments);
        result.details.extend(state.plug_details());
        result.warnings = warnings(scenario, result, &self.reached(), self.erosion_strain);
    }

    /// What a run with pieces that fly has to say beyond the common numbers.
    fn details(&self, fragments: &[Fragment]) -> Vec<Detail> {
        let partings = &self.state.partings;
        let first = partings.first().map(|first| (first.position, first.time));
        let mut details = of_cracks(partings.len(), first);
        let mut add = |name, unit, value| details.push(Detail { name, unit, value });
        if fragments.len() > 1 {
            let energy = self.state.energy();
            let moving = energy.kinetic_projectile + energy.kinetic_target;
            let elastic = energy.elastic_projectile + energy.elastic_target;
            let flight: f64 = fragments.iter().map(Fragment::kinetic_energy).sum();
            add("kinetic energy of free pieces", "J", flight);
            add("energy of elastic waves", "J", moving + elastic - flight);
        }
        details
    }

    /// Extremes of every part, eroded elements included.
    fn reached(&self) -> Vec<Reached> {
        let mut first = 0;
        let parts = self.state.parts.iter().map(|part| {
            let own = first..first + part.elements;
            first += part.elements;
            let most = |value: fn(super::state::Element) -> f64| {
                let elements = self.state.elements.iter(own.clone());
                elements.map(value).fold(0.0, f64::max)
            };
            Reached {
                plastic_strain: most(|element| element.plastic.strain),
                strain_rate: Some(most(|element| element.plastic.largest_rate)),
                temperature: most(|element| element.plastic.temperature),
            }
        });
        parts.collect()
    }

    fn remains(&self) -> Remains {
        let mut remains = Remains::default();
        let mut first = 0;
        for part in &self.state.parts {
            for element in self.state.elements.iter(first..first + part.elements) {
                let rest = element.rest_length;
                let unloaded = part.length_at(rest, element.plastic.axial);
                let eroded = usize::from(element.eroded);
                match (part.role, element.eroded) {
                    (Role::Projectile, true) => remains.eroded.0 += eroded,
                    (Role::Projectile, false) => {
                        remains.projectile_length += unloaded;
                        let here = part.diameter_at(element.plastic.axial);
                        let widest = remains.projectile_diameter.get_or_insert(here);
                        *widest = widest.max(here);
                    }
                    (Role::Target, _) => {
                        remains.eroded.1 += eroded;
                        remains.permanent_depth += if element.eroded {
                            rest
                        } else {
                            rest - unloaded + element.advance
                        };
                    }
                }
            }
            first += part.elements;
        }
        remains
    }
}

/// Number of cracks, and initial position [m] and time [s] of the first one.
pub(super) fn of_cracks(count: usize, first: Option<(f64, f64)>) -> Vec<Detail> {
    let Some((position, time)) = first else {
        return Vec::new();
    };
    vec![
        Detail::new("cracks", "", count as f64),
        Detail::new("first crack, initial position", "mm", position * 1e3),
        Detail::new("first crack, time", "us", time * 1e6),
    ]
}
