//! Cost of a run, estimated from its case before anything is allocated.

use serde::Serialize;

use super::limits::Limits;
use crate::{
    Scenario,
    scenario::{Plate, TargetBody, modelled_thickness},
};

/// Cost of a run.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Estimate {
    /// Memory [bytes].
    pub memory: f64,
    /// Time steps.
    pub steps: f64,
    /// Processor time [s].
    pub seconds: f64,
}

/// Mesh of a run, from which its cost follows.
#[derive(Debug, Clone, Copy)]
pub struct Work {
    /// Elements, cells or particles.
    pub elements: f64,
    /// Memory of one of them [bytes].
    pub bytes: f64,
    /// How many of them a second of processor time advances by a step.
    pub rate: f64,
}

/// Memory and speed of a solver.
#[derive(Debug, Clone, Copy)]
pub struct WorkRate {
    /// Memory of an element [bytes].
    pub bytes: f64,
    /// Elements that a second of processor time advances by a step.
    pub rate: f64,
}

impl WorkRate {
    /// The work on so many elements.
    pub const fn of(self, elements: f64) -> Work {
        Work {
            elements,
            bytes: self.bytes,
            rate: self.rate,
        }
    }
}

impl Estimate {
    /// A run of less than a millisecond.
    pub const LITTLE: Self = Self {
        memory: 0.0,
        steps: 0.0,
        seconds: 0.0,
    };

    /// A run of so many steps, within the limit of the case.
    pub fn of_steps(work: Work, steps: f64, max_steps: u64) -> Self {
        let steps = steps.clamp(0.0, max_steps as f64).ceil();
        Self {
            memory: work.bytes * work.elements,
            steps,
            seconds: work.elements * steps / work.rate,
        }
    }

    /// A run that ends after a time at a time step [s], or at the limits of the case.
    pub fn of_time(work: Work, (end, time_step): (f64, f64), limits: Limits) -> Self {
        let steps = end.min(limits.end_time) / time_step;
        Self::of_steps(work, steps, limits.max_steps)
    }

    /// The same runs so many times.
    #[must_use]
    pub fn times(self, runs: f64) -> Self {
        Self {
            memory: self.memory,
            steps: runs * self.steps,
            seconds: runs * self.seconds,
        }
    }
}

impl std::iter::Sum for Estimate {
    /// Runs one after the other.
    fn sum<I: Iterator<Item = Self>>(runs: I) -> Self {
        runs.fold(Self::LITTLE, |sum, run| Self {
            memory: sum.memory.max(run.memory),
            steps: sum.steps + run.steps,
            seconds: sum.seconds + run.seconds,
        })
    }
}

/// Depth for estimates only: the energy of the impact against three times the target's flow stress over the rod's area, and no more
/// than a jet of no strength would reach [m].
pub fn expected_depth(scenario: &Scenario, layers: &[Plate]) -> f64 {
    let rod = &scenario.projectile;
    let plate = &layers[layers.len() - 1];
    let target = &plate.material;
    let density = rod.material.density.si();
    let jet = 1.2 * rod.length * (density / target.density.si()).sqrt();
    let kinetic = 0.5 * density * scenario.impact_velocity.powi(2) * rod.length;
    match target.flow_stress_at(0.2, plate.start_temperature()) {
        Some(stress) => jet.min(kinetic / (3.0 * stress)),
        None => jet,
    }
}

/// Times of an impact, for estimates only.
#[derive(Debug, Clone, Copy)]
pub struct ExpectedTimes {
    /// Of a wave along the projectile and back [s].
    pub wave: f64,
    /// Until the projectile stops or has passed the target [s].
    pub stop: f64,
}

impl ExpectedTimes {
    /// Those of a case.
    pub fn of(scenario: &Scenario) -> Self {
        let rod = &scenario.projectile;
        let speed = scenario.impact_velocity.max(1.0);
        // Momentum over a constant pressure.
        let against = |pressure: f64| rod.material.density.si() * rod.length * speed / pressure;
        let stop = match &scenario.target {
            TargetBody::Layers { layers, .. } => {
                let depth = expected_depth(scenario, layers);
                let through = |thickness: f64| thickness + rod.length;
                2.0 * scenario
                    .target_thickness()
                    .map_or(depth, |thickness| depth.min(through(thickness)))
                    / speed
            }
            TargetBody::RigidWall => rod.material.flow_stress(0.2).map_or(0.0, against),
            TargetBody::ConstantPressure(pressure) => against(*pressure),
        };
        Self {
            wave: 2.0 * rod.length / rod.material.bar_wave_speed(),
            stop,
        }
    }

    /// A time of so many of both [s].
    pub fn weighted(self, [waves, stops]: [f64; 2]) -> f64 {
        waves * self.wave + stops * self.stop
    }
}

/// Smallest time in which a wave along a bar crosses one of so many elements of projectile and target [s].
pub fn element_time(scenario: &Scenario, (projectile, target): (usize, usize)) -> f64 {
    let rod = &scenario.projectile;
    let of_rod = rod.length / projectile.max(1) as f64 / rod.material.bar_wave_speed();
    let TargetBody::Layers { layers, .. } = &scenario.target else {
        return of_rod;
    };
    let total: f64 = layers
        .iter()
        .map(|plate| modelled_thickness(plate, scenario))
        .sum();
    let speeds = layers.iter().map(|plate| plate.material.bar_wave_speed());
    of_rod.min(total / target.max(1) as f64 / speeds.fold(f64::MIN_POSITIVE, f64::max))
}

/// A time as `90 s`, `5 min`, `2 h` or `3 days`.
pub fn time_in_words(seconds: f64) -> String {
    match seconds {
        ..120.0 => format!("{seconds:.0} s"),
        ..7200.0 => format!("{:.0} min", seconds / 60.0),
        ..172_800.0 => format!("{:.0} h", seconds / 3600.0),
        _ => format!("{:.0} days", seconds / 86_400.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WORK: Work = Work {
        elements: 1000.0,
        bytes: 100.0,
        rate: 1e6,
    };

    #[test]
    fn steps_and_time_end_at_the_limits_of_the_case() {
        let limits = Limits {
            end_time: 2e-6,
            max_steps: 5000,
            at_rest_below: None,
        };
        let estimate = |end: f64, limits: Limits| Estimate::of_time(WORK, (end, 1e-9), limits);
        let whole = estimate(1e-6, limits);
        assert_eq!((whole.steps, whole.memory), (1000.0, 1e5));
        assert!((whole.seconds - 1.0).abs() < 1e-12);
        assert_eq!(estimate(1.0, limits).steps, 2000.0);
        let few = Limits {
            max_steps: 7,
            ..limits
        };
        assert_eq!(estimate(1.0, few).steps, 7.0);
        assert_eq!(whole.times(3.0).steps, 3000.0);
        assert_eq!(whole.times(3.0).memory, 1e5);
    }

    #[test]
    fn times_are_written_in_units_of_their_size() {
        for (seconds, words) in [
            (31.4, "31 s"),
            (119.0, "119 s"),
            (600.0, "10 min"),
            (20_000.0, "6 h"),
            (1e6, "12 days"),
        ] {
            assert_eq!(time_in_words(seconds), words);
        }
    }
}
