//! Shape of a rigid projectile, a strip or a body of revolution, and the contact of particles with it.

use super::{
    bonded::{Bonded, Load, dot},
    flight::{Flight, Pose},
    onset::part_of_force,
};
use crate::problem::Nose;

/// Part of the radius within which a particle is on the axis.
const ON_AXIS: f64 = 1e-6;

/// A rigid body that particles touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Rigid {
    /// A wall at rest, whose face is at depth 0.
    Wall,
    /// A projectile as a strip with a nose, symmetric about `x = 0`.
    Projectile(Shape),
}

/// Plane shape of a projectile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Shape {
    pub(super) nose: Nose,
    /// Half of its thickness [m].
    pub(super) radius: f64,
    /// Length over all [m].
    pub(super) length: f64,
}

/// Forces of a contact.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Contact<const D: usize> {
    /// Forces on particles, in the order of the rows.
    pub(super) loads: Vec<Load<D>>,
    /// Force on the particles [N per m].
    pub(super) force: [f64; 2],
    /// Its moment about the tip of the projectile [N m per m].
    pub(super) moment: f64,
    /// Elastic energy of the contact springs [J per m].
    pub(super) energy: f64,
}

impl Shape {
    /// Length of the nose [m].
    pub(super) fn nose_length(&self) -> f64 {
        self.nose.length(2.0 * self.radius)
    }

    /// How deep a point is inside a body whose tip is at the origin [m], and the direction of the way out; `None` outside.
    ///
    /// The depth is the distance to the surface, so that the force `k δ` has a potential everywhere.
    pub(super) fn penetration(&self, [x, z]: [f64; 2]) -> Option<(f64, [f64; 2])> {
        let (radius, side) = (self.radius, if x < 0.0 { -1.0 } else { 1.0 });
        let shank = (radius - x.abs(), [side, 0.0]);
        let below_shoulder = z + self.nose_length();
        let nearest = match self.nose {
            Nose::Flat => nearer(shank, (-z, [0.0, 1.0])),
            Nose::Cone { .. } => {
                let length = self.nose_length();
                let slant = (length * length + radius * radius).sqrt();
                let normal = [length / slant, radius / slant];
                let depth = -(normal[0] * x.abs() + normal[1] * z);
                nearer(shank, (depth, [side * normal[0], normal[1]]))
            }
            Nose::Hemisphere if below_shoulder > 0.0 => to_arc(radius, [x, below_shoulder]),
            Nose::Ogive { crh } if below_shoulder > 0.0 => {
                // Both arcs end at the shoulder, where their tangents are along the shank.
                let arc = 2.0 * crh * radius;
                let centre = radius - arc;
                let right = to_arc(arc, [x - centre, below_shoulder]);
                let left = to_arc(arc, [x + centre, below_shoulder]);
                nearer(right, left)
            }
            Nose::Hemisphere | Nose::Ogive { .. } => shank,
        };
        let tail = (z + self.length, [0.0, -1.0]);
        let (depth, [across, along]) = nearer(nearest, tail);
        // On the axis both flanks are equally near, and what they push to the sides cancels.
        let on_axis = x.abs() < ON_AXIS * radius && along > 0.0;
        let direction = [if on_axis { 0.0 } else { across }, along];
        (depth > 0.0).then_some((depth, direction))
    }

    /// The same of a position in a plane, or of one in space about a body of revolution, in a pose.
    fn penetration_from<const D: usize>(
        &self,
        pose: Pose,
        position: [f64; D],
    ) -> Option<(f64, [f64; D])> {
        let [x, z] = pose.point_at([position[0], position[D - 1]]);
        let mut way_out = [0.0; D];
        if D == 2 {
            let (depth, direction) = self.penetration([x, z])?;
            [way_out[0], way_out[D - 1]] = pose.turned(direction);
            return Some((depth, way_out));
        }
        let across = position[1];
        let radius = (x * x + across * across).sqrt();
        let (depth, [out, along]) = self.penetration([radius, z])?;
        let unit = out / radius.max(f64::MIN_POSITIVE);
        [way_out[0], way_out[D - 1]] = pose.turned([unit * x, along]);
        way_out[1] = unit * across;
        Some((depth, way_out))
    }

    /// Area [m2].
    pub(super) fn area(&self) -> f64 {
        let (radius, nose) = (self.radius, self.nose_length());
        let of_nose = match self.nose {
            Nose::Flat => 0.0,
            Nose::Cone { .. } => radius * nose,
            Nose::Hemisphere => 0.5 * std::f64::consts::PI * radius * radius,
            Nose::Ogive { crh } => {
                // Twice the sector of the arc from the shoulder to the tip, less its triangle to the axis.
                let arc = 2.0 * crh * radius;
                let angle = (nose / arc).asin();
                arc * arc * angle - (arc - radius) * nose
            }
        };
        2.0 * radius * (self.length - nose) + of_nose
    }

    /// Distance of the centre of area behind the tip [m], and the second moment of area about it, in the plane [m4].
    pub(super) fn moments(&self) -> (f64, f64) {
        let (_, centre, second) = self.integrals(|half| [2.0 * half, half * half / 3.0]);
        (centre, second)
    }

    /// Volume of the body of revolution [m3], distance of its centre behind the tip [m], and second moment of volume about an axis across it there [m5].
    pub(super) fn round_moments(&self) -> (f64, f64, f64) {
        self.integrals(|half| [std::f64::consts::PI * half * half, 0.25 * half * half])
    }

    /// Integral of a section over the length, distance of its centre behind the tip [m], and second moment about it: of the size of a section of half a
    /// width and the square of its radius of gyration [m2].
    fn integrals(&self, section: impl Fn(f64) -> [f64; 2]) -> (f64, f64, f64) {
        // With `behind = nose t²` the width of every nose is smooth in `t`.
        let nose = self.nose_length();
        let mut sums = [0.0; 3];
        let mut add = |weight: f64, behind: f64| {
            let [size, square] = section(self.nose.radius(2.0 * self.radius, behind));
            let size = weight * size;
            sums[0] += size;
            sums[1] += size * behind;
            sums[2] += size * (behind * behind + square);
        };
        for i in 0..=PANELS {
            let t = f64::from(i) / f64::from(PANELS);
            add(simpson(i) * 2.0 * nose * t, nose * t * t);
            let shank = self.length - nose;
            add(simpson(i) * shank, nose + shank * t);
        }
        let centre = sums[1] / sums[0];
        (sums[0], centre, sums[2] - sums[1] * centre)
    }

    /// The point farthest in a direction of unit length, from the tip [m].
    pub(super) fn farthest(&self, [x, z]: [f64; 2]) -> [f64; 2] {
        let (radius, nose) = (self.radius, self.nose_length());
        let side = if x < 0.0 { -1.0 } else { 1.0 };
        let of = |point: [f64; 2]| x * point[0] + z * point[1];
        let shoulder = [side * radius, -nose];
        let tip = match self.nose {
            Nose::Flat => shoulder,
            _ => [0.0; 2],
        };
        let arc = match self.nose {
            Nose::Flat | Nose::Cone { .. } => 0.0,
            Nose::Hemisphere => radius,
            Nose::Ogive { crh } => 2.0 * crh * radius,
        };
        // The point of the arc whose tangent is across the direction, if the arc goes so far.
        let mut on_arc = [side * (radius - arc) + arc * x, arc * z - nose];
        if arc == 0.0 || z < 0.0 || side * on_arc[0] < 0.0 {
            on_arc = tip;
        }
        let farther = |a: [f64; 2], b: [f64; 2]| if of(b) > of(a) { b } else { a };
        [shoulder, tip, on_arc]
            .into_iter()
            .fold([side * radius, -self.length], farther)
    }
}

/// Panels of the integrals over a shape.
const PANELS: u32 = 2000;

/// Weight of a point of Simpson's rule on the unit interval.
fn simpson(point: u32) -> f64 {
    let weight = match point {
        0 | PANELS => 1.0,
        _ if point % 2 == 1 => 4.0,
        _ => 2.0,
    };
    weight / (3.0 * f64::from(PANELS))
}

type Depth = (f64, [f64; 2]);

fn nearer(a: Depth, b: Depth) -> Depth {
    if b.0 < a.0 { b } else { a }
}

/// Depth below an arc about the origin.
fn to_arc(arc: f64, [x, z]: [f64; 2]) -> Depth {
    let distance = (x * x + z * z).sqrt();
    let direction = match distance > 0.0 {
        true => [x / distance, z / distance],
        false => [0.0, 1.0],
    };
    (arc - distance, direction)
}

/// How a rigid body moves in a step, within which contacts begin and end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moving<'a> {
    /// Time step [s].
    pub(super) step: f64,
    /// None of a body at rest.
    pub(super) flight: Option<&'a Flight>,
}

/// Forces between a body and a rigid one in a pose; where they do not move, contacts begin and end with steps.
pub(super) fn contact<const D: usize>(
    body: &impl Bonded<D>,
    rigid: Rigid,
    pose: Pose,
    moving: Option<Moving<'_>>,
) -> Contact<D> {
    match rigid {
        Rigid::Wall => add_up(body, 0.0..f64::INFINITY, pose, moving, |position| {
            let depth = position[D - 1];
            let mut direction = [0.0; D];
            direction[D - 1] = -1.0;
            (depth > 0.0).then_some((depth, direction))
        }),
        Rigid::Projectile(shape) => {
            let reached = f64::NEG_INFINITY..pose.deepest(&shape);
            add_up(body, reached, pose, moving, |position| {
                shape.penetration_from(pose, position)
            })
        }
    }
}

/// Forces on the particles at depths of a range [m], which are inside a rigid body.
fn add_up<const D: usize>(
    body: &impl Bonded<D>,
    depths: std::ops::Range<f64>,
    pose: Pose,
    moving: Option<Moving<'_>>,
    penetration: impl Fn([f64; D]) -> Option<(f64, [f64; D])>,
) -> Contact<D> {
    let stiffness = body.contact_stiffness();
    let mut contact = Contact::default();
    for row in 0..body.row_count() {
        for place in body.between(row, &depths) {
            let position = body.position(row, place);
            let Some((depth, direction)) = penetration(position) else {
                continue;
            };
            let pressure = stiffness * depth;
            let part = moving.map_or(1.0, |moving| {
                let mut past = body.velocity(row, place);
                if let Some(flight) = moving.flight {
                    let [across, along] = flight.velocity_at([position[0], position[D - 1]]);
                    past[0] -= across;
                    past[D - 1] -= along;
                }
                part_of_force(depth, moving.step * dot(past, direction))
            });
            let force = direction.map(|along| part * pressure * along);
            let (across, along) = (force[0], force[D - 1]);
            contact.force[0] += across;
            contact.force[1] += along;
            contact.moment +=
                (position[0] - pose.tip[0]) * along - (position[D - 1] - pose.tip[1]) * across;
            contact.energy += 0.5 * pressure * depth;
            contact.loads.push(Load {
                row,
                place,
                force,
                moment: 0.0,
            });
        }
    }
    contact
}
