//! Limits of a run: the time and the number of steps that end it at the latest.

use crate::{
    Scenario,
    scenario::{TargetBody, modelled_thickness},
    units::Time,
};

/// Times that waves and the projectile take through all bodies, after which a run ends when a case gives no time.
const PASSAGES: f64 = 20.0;
/// Part of a plate beyond which a crater whose projectile rests may still reach the rear face.
const REST_DEPTH: f64 = 0.5;

/// When a run ends at the latest.
#[derive(Debug, Clone, Copy)]
pub struct Limits {
    /// Time [s].
    pub end_time: f64,
    /// Number of steps.
    pub max_steps: u64,
    /// Depth below which a run ends when the projectile's momentum is used up [m]; `None` where that does not end it.
    pub at_rest_below: Option<f64>,
}

impl Limits {
    /// The limits of a case; `end_time` has a default.
    pub fn new(scenario: &Scenario, end_time: Option<Time>, max_steps: u64) -> Self {
        Self {
            end_time: end_time.map_or_else(|| default_end_time(scenario), |time| time.si()),
            max_steps,
            at_rest_below: None,
        }
    }

    /// The same; with `end_at_rest` the run ends as soon as the depth is known, and nothing can come through the target any more.
    #[must_use]
    pub fn or_at_rest(self, scenario: &Scenario, end_at_rest: bool) -> Self {
        let far_from_rear = || {
            let thickness = scenario.target_thickness();
            thickness.map_or(f64::INFINITY, |thickness| REST_DEPTH * thickness)
        };
        Self {
            at_rest_below: end_at_rest.then(far_from_rear),
            ..self
        }
    }
}

/// Many times what waves and the projectile take through all bodies [s].
fn default_end_time(scenario: &Scenario) -> f64 {
    let rod = &scenario.projectile;
    let speed = scenario.impact_velocity.max(1.0);
    let mut time = 2.0 * rod.length / rod.material.bar_wave_speed() + 2.0 * rod.length / speed;
    match &scenario.target {
        TargetBody::Layers { layers, .. } => {
            for plate in layers {
                let thickness = modelled_thickness(plate, scenario);
                time += 2.0 * thickness / plate.material.bar_wave_speed()
                    + 2.0 * (thickness + plate.gap) / speed;
            }
        }
        TargetBody::RigidWall => {}
        TargetBody::ConstantPressure(pressure) => {
            time += rod.material.density.si() * rod.length * speed / pressure;
        }
    }
    PASSAGES * time
}
