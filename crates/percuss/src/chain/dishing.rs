//! Dishing: the plate around a plug as an elastic–plastic Mindlin plate, followed in the radius.
//!
//! Rings between an inner edge, which the shear bands drive, and a support. Every ring bends (M_r, M_θ) and shears (Q) between two circles
//! that have a deflection and a rotation each. The inner edge does not turn while the plug is in it. Moments and shear force lie inside the
//! yield surface of von Mises, `M_r² − M_r M_θ + M_θ² + 3 (Q h/4)² ≤ (σ h²/4)²`, with the flow stress σ at the mean strain of the section.

use std::f64::consts::PI;

use super::{
    band_law::Failure,
    plate_section::{PlateSection, Ring},
};
use crate::{
    case::{ChainOptions, Support},
    material::Material,
    scenario::PlateEdge,
};

/// Rings in a length of one thickness of the plate: bending waves shorter than the thickness are no plate theory's.
const RINGS_PER_THICKNESS: f64 = 6.0;
/// Rings would be so narrow at the plug, where strain gathers once the metal softens, and grow by a factor from one to the next.
const FIRST_RINGS_PER_THICKNESS: f64 = 48.0;
const GROWTH: f64 = 1.15;
/// Fewest and most rings away from the plug.
const RINGS: (f64, f64) = (40.0, 4000.0);

/// A circle between two rings.
#[derive(Debug, Clone, Copy, Default)]
struct Circle {
    /// [kg].
    mass: f64,
    /// Rotary inertia [kg m2].
    inertia: f64,
    deflection: f64,
    velocity: f64,
    rotation: f64,
    spin: f64,
    force: f64,
    moment: f64,
}

/// The plate around a plug.
#[derive(Debug)]
pub(super) struct Dishing {
    section: PlateSection,
    circles: Vec<Circle>,
    rings: Vec<Ring>,
    support: Support,
    /// Whether the plug keeps the inner edge from turning.
    pub(super) edge_held: bool,
    /// Impulse that the support took [N s].
    pub(super) support_impulse: f64,
    /// Plastic work [J].
    pub(super) plastic_work: f64,
    /// Largest deflection of the inner edge [m].
    pub(super) largest_deflection: f64,
}

impl Dishing {
    pub(super) fn new(
        material: &Material,
        thickness: f64,
        inner_radius: f64,
        edge: PlateEdge,
        failure: Failure,
        options: &ChainOptions,
    ) -> Self {
        let widths = widths(0.5 * edge.diameter - inner_radius, thickness);
        let section = PlateSection::new(material, thickness, failure, options);
        let areal = material.density.si() * thickness;
        let mut circles = vec![Circle::default(); widths.len() + 1];
        let mut rings = Vec::with_capacity(widths.len());
        let mut radius = inner_radius;
        for (i, width) in widths.into_iter().enumerate() {
            rings.push(Ring::new(&section, radius + 0.5 * width, width));
            // A linear velocity field has the momentum that it should.
            let shares = [
                radius * width / 2.0 + width * width / 6.0,
                radius * width / 2.0 + width * width / 3.0,
            ];
            for (circle, share) in circles[i..=i + 1].iter_mut().zip(shares) {
                let mass = 2.0 * PI * areal * share;
                circle.mass += mass;
                circle.inertia += mass * thickness * thickness / 12.0;
            }
            radius += width;
        }
        Self {
            section,
            circles,
            rings,
            support: edge.support,
            edge_held: true,
            support_impulse: 0.0,
            plastic_work: 0.0,
            largest_deflection: 0.0,
        }
    }

    /// Deflection of the inner edge [m].
    pub(super) fn deflection(&self) -> f64 {
        self.circles[0].deflection
    }

    /// Whether the ring next to the plug has failed, which frees the plug.
    pub(super) fn has_failed(&self) -> bool {
        self.rings[0].has_failed(&self.section)
    }

    /// Speed of the inner edge [m/s].
    #[cfg(test)]
    pub(super) fn velocity(&self) -> f64 {
        self.circles[0].velocity
    }

    /// Mass that the inner edge moves with [kg].
    pub(super) fn edge_mass(&self) -> f64 {
        self.circles[0].mass
    }

    /// Longest stable time step [s].
    pub(super) fn stable_step(&self) -> f64 {
        let ring = &self.rings[0];
        self.section.stable_step(ring.width, ring.radius)
    }

    /// Changes the velocities by a kick under a force on the inner edge [N].
    pub(super) fn kick(&mut self, edge_force: f64, kick: f64) {
        for circle in &mut self.circles {
            circle.force = 0.0;
            circle.moment = 0.0;
        }
        for (i, ring) in self.rings.iter().enumerate() {
            let (force, moments) = ring.loads();
            self.circles[i].force += force;
            self.circles[i + 1].force -= force;
            self.circles[i].moment += moments[0];
            self.circles[i + 1].moment += moments[1];
        }
        self.circles[0].force += edge_force;
        let last = self.circles.len() - 1;
        self.support_impulse += self.circles[last].force * kick;
        for (i, circle) in self.circles.iter_mut().enumerate() {
            if i < last {
                circle.velocity += circle.force * kick / circle.mass;
            }
            let turns = match i {
                0 => !self.edge_held,
                i if i == last => self.support == Support::SimplySupported,
                _ => true,
            };
            if turns {
                circle.spin += circle.moment * kick / circle.inertia;
            }
        }
    }

    /// Moves the circles over a time step and updates every ring.
    pub(super) fn drift(&mut self, time_step: f64) {
        for circle in &mut self.circles {
            circle.deflection += circle.velocity * time_step;
            circle.rotation += circle.spin * time_step;
        }
        self.largest_deflection = self.largest_deflection.max(self.deflection());
        for (ring, pair) in self.rings.iter_mut().zip(self.circles.windows(2)) {
            let bent = pair.iter().any(|c| c.velocity != 0.0 || c.spin != 0.0);
            if bent || !ring.is_settled() {
                let deflections = [pair[0].deflection, pair[1].deflection];
                let rotations = [pair[0].rotation, pair[1].rotation];
                self.plastic_work += ring.deform(&self.section, deflections, rotations, time_step);
            }
        }
    }

    pub(super) fn momentum(&self) -> f64 {
        self.circles.iter().map(|c| c.mass * c.velocity).sum()
    }

    pub(super) fn kinetic_energy(&self) -> f64 {
        let twice = |c: &Circle| c.mass * c.velocity * c.velocity + c.inertia * c.spin * c.spin;
        0.5 * self.circles.iter().map(twice).sum::<f64>()
    }

    pub(super) fn elastic_energy(&self) -> f64 {
        let energy = |ring: &Ring| ring.elastic_energy(&self.section);
        self.rings.iter().map(energy).sum()
    }
}

/// Widths of rings that fill a span [m], narrow at its start.
fn widths(span: f64, thickness: f64) -> Vec<f64> {
    let widest = span / (RINGS_PER_THICKNESS * span / thickness).clamp(RINGS.0, RINGS.1);
    let first = widest * RINGS_PER_THICKNESS / FIRST_RINGS_PER_THICKNESS;
    let mut widths: Vec<f64> = Vec::new();
    let mut filled = 0.0;
    while filled < span {
        let width = (first * GROWTH.powi(widths.len() as i32)).min(widest);
        filled += width;
        widths.push(width);
    }
    for width in &mut widths {
        *width *= span / filled;
    }
    widths
}

#[cfg(test)]
#[path = "dishing_tests.rs"]
mod tests;
