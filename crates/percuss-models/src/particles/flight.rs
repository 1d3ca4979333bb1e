//! Plane motion of a rigid projectile.
//!
//! At normal impact it is held on its axis; at an angle it moves and turns freely. Angles go from `x` to `z`, as in the lattice.

use serde::{Deserialize, Serialize};

use super::shape::{Contact, Shape};

/// Place and turn of a projectile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pose {
    /// Place of its tip: distance from the axis, and depth [m].
    pub(super) tip: [f64; 2],
    /// Cosine and sine of its turn.
    pub(super) turn: [f64; 2],
}

/// Inertia of a projectile; of a strip per metre of width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Inertia {
    pub(super) mass: f64,
    /// Distance from the tip to the point whose path is followed [m].
    pub(super) behind_tip: f64,
    /// Moment of inertia about that point [kg m2 per m]; none where it is held on its axis.
    pub(super) moment: Option<f64>,
}

/// Motion of a projectile.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Flight {
    /// Place of the centre of mass, or of the tip where it is held on its axis [m].
    pub(super) point: [f64; 2],
    /// Cosine and sine of its turn.
    pub(super) turn: [f64; 2],
    /// Velocity of that point, half a step behind [m/s].
    pub(super) velocity: [f64; 2],
    /// Angular velocity, half a step behind [rad/s].
    pub(super) spin: f64,
}

impl Pose {
    /// A projectile on its axis, with its tip at a depth [m].
    pub(super) fn straight(depth: f64) -> Self {
        Self {
            tip: [0.0, depth],
            turn: [1.0, 0.0],
        }
    }

    /// A vector of the body as it stands.
    pub(super) fn turned(&self, [x, z]: [f64; 2]) -> [f64; 2] {
        let [cosine, sine] = self.turn;
        [cosine * x - sine * z, sine * x + cosine * z]
    }

    /// Position of a point of the body.
    pub(super) fn place(&self, point: [f64; 2]) -> [f64; 2] {
        let [x, z] = self.turned(point);
        [self.tip[0] + x, self.tip[1] + z]
    }

    /// The point of the body at a position.
    pub(super) fn point_at(&self, position: [f64; 2]) -> [f64; 2] {
        let [cosine, sine] = self.turn;
        let [x, z] = [position[0] - self.tip[0], position[1] - self.tip[1]];
        [cosine * x + sine * z, cosine * z - sine * x]
    }

    /// Largest depth of a shape [m].
    pub(super) fn deepest(&self, shape: &Shape) -> f64 {
        let [cosine, sine] = self.turn;
        self.place(shape.farthest([sine, cosine]))[1]
    }
}

impl Inertia {
    /// That of a mass, free to turn or held on its axis; distance of the centre behind the tip [m] and second moment about it, which the density makes
    /// a moment of inertia.
    pub(super) fn of(
        mass: f64,
        (behind_tip, second): (f64, f64),
        density: f64,
        turns: bool,
    ) -> Self {
        if !turns {
            return Self::on_axis(mass);
        }
        Self {
            mass,
            behind_tip,
            moment: Some(density * second),
        }
    }

    /// That of a mass held on its axis.
    pub(super) fn on_axis(mass: f64) -> Self {
        Self {
            mass,
            behind_tip: 0.0,
            moment: None,
        }
    }
}

impl Flight {
    /// A projectile that touches the face at `x = 0` and comes at an angle to its normal [rad], towards larger `x`.
    pub(super) fn at_impact(shape: &Shape, inertia: &Inertia, speed: f64, angle: f64) -> Self {
        if inertia.moment.is_none() {
            return Self {
                point: [0.0; 2],
                turn: [1.0, 0.0],
                velocity: [0.0, speed],
                spin: 0.0,
            };
        }
        let (sine, cosine) = angle.sin_cos();
        let mut pose = Pose::straight(0.0);
        pose.turn = [cosine, -sine];
        let [x, z] = pose.place(shape.farthest([-sine, cosine]));
        pose.tip = [-x, -z];
        Self {
            point: pose.place([0.0, -inertia.behind_tip]),
            turn: pose.turn,
            velocity: [speed * sine, speed * cosine],
            spin: 0.0,
        }
    }

    pub(super) fn pose(&self, inertia: &Inertia) -> Pose {
        let [cosine, sine] = self.turn;
        let [x, z] = self.point;
        let back = inertia.behind_tip;
        Pose {
            tip: [x - sine * back, z + cosine * back],
            turn: self.turn,
        }
    }

    /// Advances it by a step [s] under the forces that it meets.
    pub(super) fn advance<const D: usize>(
        &mut self,
        step: f64,
        inertia: &Inertia,
        contact: &Contact<D>,
    ) {
        let first = usize::from(inertia.moment.is_none());
        let moment = self.moment(inertia, contact);
        for axis in first..2 {
            self.velocity[axis] -= step * contact.force[axis] / inertia.mass;
            self.point[axis] += step * self.velocity[axis];
        }
        if let Some(inertia) = inertia.moment {
            self.spin += step * moment / inertia;
            // Cayley's form of a rotation, as of the particles.
            let half = 0.5 * step * self.spin;
            let scale = 1.0 / (1.0 + half * half);
            let (c, s) = ((1.0 - half * half) * scale, 2.0 * half * scale);
            let [cosine, sine] = self.turn;
            self.turn = [c * cosine - s * sine, s * cosine + c * sine];
        }
    }

    /// Moment of the forces of a contact on the projectile about the point that is followed [N m per m].
    fn moment<const D: usize>(&self, inertia: &Inertia, contact: &Contact<D>) -> f64 {
        let tip = self.pose(inertia).tip;
        let [x, z] = [tip[0] - self.point[0], tip[1] - self.point[1]];
        -(contact.moment + x * contact.force[1] - z * contact.force[0])
    }

    /// Kinetic energy of the velocities half a step before and after [J per m].
    pub(super) fn kinetic_energy<const D: usize>(
        &self,
        step: f64,
        inertia: &Inertia,
        contact: &Contact<D>,
    ) -> f64 {
        let along = |axis: usize| {
            let before = self.velocity[axis];
            0.5 * before * (inertia.mass * before - step * contact.force[axis])
        };
        match inertia.moment {
            None => along(1),
            Some(own) => {
                let after = own * self.spin + step * self.moment(inertia, contact);
                along(0) + along(1) + 0.5 * self.spin * after
            }
        }
    }

    /// Velocity of a point at a position [m/s].
    pub(super) fn velocity_at(&self, [x, z]: [f64; 2]) -> [f64; 2] {
        let [u, w] = self.velocity;
        [
            u - self.spin * (z - self.point[1]),
            w + self.spin * (x - self.point[0]),
        ]
    }
}
