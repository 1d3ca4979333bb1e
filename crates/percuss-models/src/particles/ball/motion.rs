//! Plane motion of balls, and the geometry of two that meet. Angles go from `x` to `z`, as in the lattice.

use serde::{Deserialize, Serialize};

use super::law::Touch;
use crate::particles::bonded::{dot, norm, way};

/// A ball, or a plane at depth 0: a ball of infinite radius that is held.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Ball {
    /// Radius [m].
    pub(crate) radius: f64,
    /// One over the mass [1/kg]; 0 where it is held.
    pub(crate) inverse_mass: f64,
    /// One over the moment of inertia [1/(kg m2)]; 0 where it cannot turn.
    pub(crate) inverse_inertia: f64,
    /// Centre: distance from the axis, and depth [m].
    pub(crate) centre: [f64; 2],
    /// Velocity, half a step behind [m/s].
    pub(crate) velocity: [f64; 2],
    /// Angular velocity, half a step behind [rad/s].
    pub(crate) spin: f64,
}

/// Force [N] and moment about the centre [N m].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Push {
    pub(crate) force: [f64; 2],
    pub(crate) moment: f64,
}

/// Two balls as they stand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Facing {
    /// Direction from the first to the second.
    pub(crate) normal: [f64; 2],
    /// How far they are nearer than at the first touch [m].
    pub(crate) approach: f64,
    /// Distances from their centres to the contact [m].
    arms: [f64; 2],
}

impl Ball {
    /// A solid ball at rest, with the moment of inertia `2/5 m R²`.
    pub(crate) fn new(radius: f64, mass: f64, centre: [f64; 2]) -> Self {
        Self {
            radius,
            inverse_mass: 1.0 / mass,
            inverse_inertia: 1.0 / (0.4 * mass * radius * radius),
            centre,
            velocity: [0.0; 2],
            spin: 0.0,
        }
    }

    /// The plane at depth 0.
    pub(crate) fn plane() -> Self {
        Self {
            radius: f64::INFINITY,
            inverse_mass: 0.0,
            inverse_inertia: 0.0,
            centre: [0.0; 2],
            velocity: [0.0; 2],
            spin: 0.0,
        }
    }

    /// The same, held.
    pub(crate) fn held(self) -> Self {
        Self {
            inverse_mass: 0.0,
            inverse_inertia: 0.0,
            ..self
        }
    }

    /// Advances it by a step [s].
    pub(crate) fn advance(&mut self, step: f64, push: &Push) {
        for axis in 0..2 {
            self.velocity[axis] += step * push.force[axis] * self.inverse_mass;
            self.centre[axis] += step * self.velocity[axis];
        }
        self.spin += step * push.moment * self.inverse_inertia;
    }

    /// Kinetic energy of the velocities half a step before and after [J].
    pub(crate) fn kinetic_energy(&self, step: f64, push: &Push) -> f64 {
        let of = |inverse: f64, speed: f64, force: f64| match inverse > 0.0 {
            true => 0.5 * speed * (speed / inverse + step * force),
            false => 0.0,
        };
        let [x, z] = self.velocity;
        of(self.inverse_mass, x, push.force[0])
            + of(self.inverse_mass, z, push.force[1])
            + of(self.inverse_inertia, self.spin, push.moment)
    }

    /// Momentum along the normal of the struck face, half a step behind [N s].
    pub(crate) fn momentum(&self) -> f64 {
        match self.inverse_mass > 0.0 {
            true => self.velocity[1] / self.inverse_mass,
            false => 0.0,
        }
    }
}

impl Facing {
    /// Two balls, the second of which may be the plane.
    pub(crate) fn of(first: &Ball, second: &Ball) -> Self {
        if second.radius.is_infinite() {
            // Approaches are small beside the radius, as in Hertz's theory.
            return Self {
                normal: [0.0, 1.0],
                approach: first.centre[1] + first.radius,
                arms: [first.radius, 0.0],
            };
        }
        let between = way(first.centre, second.centre);
        let (distance, reach) = (norm(between), first.radius + second.radius);
        Self {
            normal: between.map(|part| part / distance),
            approach: reach - distance,
            // One point for both, so that angular momentum is kept.
            arms: [first.radius, second.radius].map(|radius| radius * distance / reach),
        }
    }

    /// Direction in which the second slides past the first.
    fn side(&self) -> [f64; 2] {
        [-self.normal[1], self.normal[0]]
    }

    /// Speeds at which both part, and at which the surface of the second slides past that of the first [m/s].
    pub(crate) fn speeds(&self, first: &Ball, second: &Ball) -> [f64; 2] {
        let past = way(first.velocity, second.velocity);
        let rolling = self.arms[0] * first.spin + self.arms[1] * second.spin;
        [dot(past, self.normal), dot(past, self.side()) - rolling]
    }

    /// Forces of a contact on both.
    pub(crate) fn pushes(&self, touch: &Touch) -> [Push; 2] {
        let side = self.side();
        let force: [f64; 2] =
            std::array::from_fn(|axis| touch.push * self.normal[axis] - touch.shear * side[axis]);
        let of = |sign: f64, arm: f64| Push {
            force: force.map(|part| sign * part),
            moment: arm * touch.shear,
        };
        [of(-1.0, self.arms[0]), of(1.0, self.arms[1])]
    }
}
