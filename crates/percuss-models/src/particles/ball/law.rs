//! Forces between two elastic balls: Hertz along the line of centres, Mindlin across it, damping and Coulomb friction.

use serde::{Deserialize, Serialize};

use crate::particles::{lattice::Solid, restitution::hertz_damping};

/// Contact of two balls, or of a ball and a plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HertzLaw {
    /// Force over the approach to the power 3/2, `4/3 E* √R*`.
    stiffness: f64,
    /// Stiffness across the line of centres over the root of the approach, `8 G* √R*`.
    shear: f64,
    /// Coefficient of Coulomb friction.
    friction: f64,
    /// Damping over that of a linear oscillator that just does not swing.
    damping: f64,
    /// Mass of the motion of both against each other [kg].
    mass: f64,
}

/// Two balls before they meet.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Meeting {
    /// Their materials; `None` for a rigid one.
    pub(crate) solids: [Option<Solid>; 2],
    /// Their radii [m]; a plane has an infinite one.
    pub(crate) radii: [f64; 2],
    /// One over their masses [1/kg]; 0 where one is held.
    pub(crate) inverse_masses: [f64; 2],
}

/// Forces of a contact now, and what it has lost.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Touch {
    /// How far the centres are nearer than at the first touch [m]; negative of balls apart.
    pub(crate) approach: f64,
    /// Force along the line of centres, pressure positive [N].
    pub(crate) push: f64,
    /// Part of it that damps [N].
    drag: f64,
    /// Force across it: on the first ball in the direction in which the second slides past [N].
    pub(crate) shear: f64,
    /// Stiffness across it [N/m].
    shear_stiffness: f64,
    /// Energy lost to damping [J].
    pub(crate) damped: f64,
    /// Energy lost to friction, and to slip within the contact as it grows and shrinks [J].
    pub(crate) rubbed: f64,
}

impl HertzLaw {
    /// The contact of a meeting. At least one of the two is elastic and free to move.
    pub(crate) fn new(meeting: &Meeting, restitution: f64, friction: f64) -> Self {
        let radius = 1.0 / meeting.radii.map(|radius| 1.0 / radius).iter().sum::<f64>();
        let [normal, across] = compliances(meeting.solids).map(|[a, b]| 1.0 / (a + b));
        Self {
            stiffness: 4.0 / 3.0 * normal * radius.sqrt(),
            shear: 8.0 * across * radius.sqrt(),
            friction,
            damping: hertz_damping(restitution),
            mass: 1.0 / meeting.inverse_masses.iter().sum::<f64>(),
        }
    }

    /// Largest approach of an impact without damping at a velocity along the line of centres [m]: all energy is elastic.
    pub(crate) fn largest_approach(&self, velocity: f64) -> f64 {
        (1.25 * self.mass * velocity * velocity / self.stiffness).powf(0.4)
    }

    /// Angular frequency of small motions about an approach [rad/s].
    pub(crate) fn frequency(&self, approach: f64) -> f64 {
        (self.slope(approach) / self.mass).sqrt()
    }

    /// Stiffness along the line of centres at an approach [N/m].
    fn slope(&self, approach: f64) -> f64 {
        1.5 * self.stiffness * approach.sqrt()
    }
}

/// Shares of both in the approach and in the slide under a force: `(1 − ν²)/E` and `(2 − ν)/G` [1/Pa]; 0 of a rigid one.
fn compliances(solids: [Option<Solid>; 2]) -> [[f64; 2]; 2] {
    let of = |share: fn(f64, f64) -> f64| {
        solids.map(|solid| solid.map_or(0.0, |s| share(s.youngs_modulus, s.poissons_ratio)))
    };
    [
        of(|modulus, ratio| (1.0 - ratio * ratio) / modulus),
        of(|modulus, ratio| 2.0 * (2.0 - ratio) * (1.0 + ratio) / modulus),
    ]
}

/// Part of the elastic energy of a contact that the first of two has.
pub(crate) fn energy_share(solids: [Option<Solid>; 2]) -> f64 {
    let [[first, second], _] = compliances(solids);
    first / (first + second)
}

impl Touch {
    /// Advances it to an approach [m] at the end of a step [s], in which the balls part and slide past each other at two speeds [m/s].
    pub(crate) fn update(
        &mut self,
        law: &HertzLaw,
        approach: f64,
        [apart, past]: [f64; 2],
        step: f64,
    ) {
        let before = *self;
        self.approach = approach;
        let depth = approach.max(0.0);
        let elastic = law.stiffness * depth.powf(1.5);
        let damping = 2.0 * law.damping * (law.mass * law.slope(depth)).sqrt();
        // A contact pushes and never pulls.
        self.push = (elastic - damping * apart).max(0.0);
        self.drag = self.push - elastic;
        self.shear_stiffness = law.shear * depth.sqrt();
        // A contact that shrinks lets go of what its lost rim held: otherwise its springs would give back more than they took.
        let kept = match self.shear_stiffness < before.shear_stiffness {
            true => before.shear * self.shear_stiffness / before.shear_stiffness,
            false => before.shear,
        };
        let most = law.friction * self.push;
        self.shear = (kept + self.shear_stiffness * past * step).clamp(-most, most);
        // Work of the mean forces of both steps, less what the springs keep.
        self.damped -= 0.5 * (before.drag + self.drag) * apart * step;
        let work = 0.5 * (before.shear + self.shear) * past * step;
        self.rubbed += work - (self.shear_energy() - before.shear_energy());
    }

    /// Elastic energy [J].
    pub(crate) fn energy(&self, law: &HertzLaw) -> f64 {
        0.4 * law.stiffness * self.approach.max(0.0).powf(2.5) + self.shear_energy()
    }

    fn shear_energy(&self) -> f64 {
        match self.shear_stiffness > 0.0 {
            true => 0.5 * self.shear * self.shear / self.shear_stiffness,
            false => 0.0,
        }
    }
}
