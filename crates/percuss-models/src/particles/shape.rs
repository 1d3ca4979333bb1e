//! Plane shape of a rigid projectile, and the contact of particles with it.

use super::{body::Body, lattice::ROW, step::Load};
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
}

/// Forces of a contact.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Contact {
    /// Forces on particles, in the order of the rows.
    pub(super) loads: Vec<Load>,
    /// Force on the particles along the direction of impact [N per m].
    pub(super) force: f64,
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
        let (depth, [across, along]) = nearest;
        // On the axis both flanks are equally near, and what they push to the sides cancels.
        let on_axis = x.abs() < ON_AXIS * radius && along > 0.0;
        let direction = [if on_axis { 0.0 } else { across }, along];
        (depth > 0.0).then_some((depth, direction))
    }

    /// Area of the plane shape of a projectile of a length over all [m2].
    pub(super) fn area(&self, length: f64) -> f64 {
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
        2.0 * radius * (length - nose) + of_nose
    }
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

/// Stiffness of the contact of a particle [N/m per m]: that of a row of bonds.
pub(super) fn stiffness(body: &Body) -> f64 {
    1.5 * body.lattice.normal + 0.5 * body.lattice.shear
}

/// Forces between a body and a rigid one whose tip is at a depth [m].
pub(super) fn contact(body: &Body, rigid: Rigid, tip: f64) -> Contact {
    match rigid {
        Rigid::Wall => {
            let last = body.rows.len().saturating_sub(1);
            add_up(body, last..=last, |[_, z]| {
                (z > 0.0).then_some((z, [0.0, -1.0]))
            })
        }
        Rigid::Projectile(shape) => {
            let height = ROW * body.lattice.spacing;
            let reached = ((tip / height).max(0.0) as usize + 1).min(body.rows.len() - 1);
            // Pieces go anywhere.
            let last = match body.softening {
                Some(_) => body.rows.len() - 1,
                None => reached,
            };
            add_up(body, 0..=last, |[x, z]| shape.penetration([x, z - tip]))
        }
    }
}

fn add_up(
    body: &Body,
    rows: std::ops::RangeInclusive<usize>,
    penetration: impl Fn([f64; 2]) -> Option<(f64, [f64; 2])>,
) -> Contact {
    let stiffness = stiffness(body);
    let mut contact = Contact::default();
    for row in rows {
        for place in 1..body.stride - 1 {
            if body.rows[row].mass[place] == 0.0 {
                continue;
            }
            let Some((depth, [x, z])) = penetration(body.position(row, place)) else {
                continue;
            };
            let force = stiffness * depth;
            contact.force += force * z;
            contact.energy += 0.5 * force * depth;
            contact.loads.push(Load {
                row,
                place,
                force: [force * x, force * z],
                moment: 0.0,
            });
        }
    }
    contact
}
