//! Fields of a run at even intervals of time, for a caller that draws or writes them.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use super::Particle;
use crate::{Scenario, history::ElementState};

/// Fields at one time.
#[derive(Debug, Clone)]
pub struct Frame<'a> {
    /// Number of the frame: its time in whole intervals. The last frame may repeat the number of the one before, at the same time.
    pub number: u64,
    /// Whether this is the end of the run.
    pub last: bool,
    /// Time step.
    pub step: u64,
    /// Time [s].
    pub time: f64,
    /// Depth of the crater floor on the axis [m].
    pub depth: f64,
    /// The fields.
    pub fields: Fields<'a>,
}

/// Bond between two particles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bond {
    /// Its ends: numbers of particles, counted over all bodies that a frame has.
    pub ends: [u32; 2],
    /// 0 of a whole bond, 1 of a broken one.
    pub damage: f32,
}

/// Places of particles in space, across the plane of the first axis and the depth.
#[derive(Debug, Clone, PartialEq)]
pub struct Across {
    /// Distance from the plane [m] and velocity away from it [m/s] of every particle, counted over all bodies.
    pub places: Vec<[f64; 2]>,
    /// Thickness of the section that a picture shows [m].
    pub section: f64,
}

/// Particles of a body that a model makes for a frame, one after the other: nobody needs all of them at once.
pub trait PointSource: std::fmt::Debug {
    /// Their number.
    fn len(&self) -> usize;

    /// Whether there are none.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Them, in one order.
    fn points(&self) -> Box<dyn Iterator<Item = Particle> + '_>;
}

/// Particles of a body.
#[derive(Debug, Clone)]
pub enum Points<'a> {
    /// Those that a model has.
    Kept(Cow<'a, [Particle]>),
    /// Those that it makes.
    Made(&'a dyn PointSource),
}

impl Points<'_> {
    /// Their number, with those that have left the body.
    pub fn len(&self) -> usize {
        match self {
            Self::Kept(particles) => particles.len(),
            Self::Made(source) => source.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Them, in order.
    pub fn iter(&self) -> Box<dyn Iterator<Item = Particle> + '_> {
        match self {
            Self::Kept(particles) => Box::new(particles.iter().copied()),
            Self::Made(source) => source.points(),
        }
    }
}

impl FromIterator<Particle> for Points<'_> {
    fn from_iter<I: IntoIterator<Item = Particle>>(particles: I) -> Self {
        Self::Kept(particles.into_iter().collect())
    }
}

/// Bonds of a body that a model makes for a frame, one after the other.
pub trait BondSource: std::fmt::Debug {
    /// Them, in one order, between particles that are counted from a number on.
    fn bonds(&self, first: u32) -> Box<dyn Iterator<Item = Bond> + '_>;
}

/// Bonds between particles.
#[derive(Debug, Clone)]
pub enum Bonds<'a> {
    /// Those that a model has.
    Kept(Cow<'a, [Bond]>),
    /// Those that it makes, with the number of its first particle.
    Made(&'a dyn BondSource, u32),
}

impl Default for Bonds<'_> {
    /// None.
    fn default() -> Self {
        Self::Kept(Cow::Borrowed(&[]))
    }
}

impl Bonds<'_> {
    /// Them, in order.
    pub fn iter(&self) -> Box<dyn Iterator<Item = Bond> + '_> {
        match self {
            Self::Kept(bonds) => Box::new(bonds.iter().copied()),
            Self::Made(source, first) => source.bonds(*first),
        }
    }
}

/// Where a model has its fields.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub enum Fields<'a> {
    /// At material points in the plane of the radius and the depth.
    Particles {
        /// Side of a cell of the grid [m].
        cell: f64,
        /// Particles of each body: the projectile, then the layers of the target.
        bodies: Vec<Points<'a>>,
        /// Bonds between particles; none of a model that has none.
        bonds: Bonds<'a>,
        /// What particles in space have beside their plane; none of plane and axisymmetric bodies.
        across: Option<Across>,
    },
    /// In elements along the axis, from the projectile's tail to the rear face of the target.
    Elements(Vec<ElementState>),
}

impl Fields<'_> {
    /// Particles that have not left, each with the index of its body; none of a model that has elements.
    pub fn particles(&self) -> impl Iterator<Item = (usize, Particle)> {
        let bodies: &[Points<'_>] = match self {
            Self::Particles { bodies, .. } => bodies,
            Self::Elements(_) => &[],
        };
        bodies.iter().enumerate().flat_map(|(index, particles)| {
            let present = particles.iter().filter(|particle| particle.mass > 0.0);
            present.map(move |particle| (index, particle))
        })
    }

    /// The same, of bodies in space only those of the section that a picture shows.
    pub fn section(&self) -> impl Iterator<Item = (usize, Particle)> {
        let across = match self {
            Self::Particles { across, .. } => across.as_ref(),
            Self::Elements(_) => None,
        };
        let shown = move |number: usize| {
            across.is_none_or(|across| across.places[number][0].abs() <= 0.5 * across.section)
        };
        let all = self.particles().enumerate();
        all.filter_map(move |(number, found)| shown(number).then_some(found))
    }
}

/// Frames in the shorter of the times that the projectile takes for its own length and that waves take to go along it six times.
const FRAMES: f64 = 100.0;

/// Says when the next frame is due.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FrameClock {
    interval: f64,
    next: u64,
    /// Time of the frame that was due last [s].
    shown: f64,
}

impl FrameClock {
    /// A clock for a case: the length of a run is unknown beforehand, so the interval is that of a short one.
    pub fn new(scenario: &Scenario) -> Self {
        let rod = &scenario.projectile;
        let waves = 6.0 * rod.length / rod.material.bar_wave_speed();
        let passage = rod.length / scenario.impact_velocity.max(1.0);
        Self {
            interval: waves.min(passage) / FRAMES,
            next: 0,
            shown: f64::NAN,
        }
    }

    /// The number of the frame that is due at a time [s], if one is.
    pub fn tick(&mut self, time: f64) -> Option<u64> {
        let number = (time / self.interval).floor() as u64;
        if number < self.next {
            return None;
        }
        self.next = number + 1;
        self.shown = time;
        Some(number)
    }

    /// The number of the last frame, at the end of the run [s].
    pub fn last(&self, time: f64) -> u64 {
        if self.shown == time {
            self.next - 1
        } else {
            self.next
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_due_once_in_an_interval() {
        let mut clock = FrameClock {
            interval: 1.0,
            next: 0,
            shown: f64::NAN,
        };
        let due: Vec<_> = [0.0, 0.4, 1.1, 1.9, 4.2, 4.9, 5.0]
            .map(|time| clock.tick(time))
            .to_vec();
        assert_eq!(due, [Some(0), None, Some(1), None, Some(4), None, Some(5)]);
        assert_eq!(clock.last(5.5), 6);
        assert_eq!(clock.last(5.0), 5);
    }
}
