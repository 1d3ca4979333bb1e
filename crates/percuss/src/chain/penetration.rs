//! Target closure `penetrable-cone`: the tip goes through the target where the cone would push back harder than the target can.
//!
//! A target resists steady penetration with the pressure `p = p_s + ½ρ_t w²` on the stream tube of the projectile: p_s expands a
//! cavity, and `½ρ_t w²` turns what comes at the tip with the speed w aside, as in the equation of Alekseevskii and Tate. What the
//! projectile has spread beyond its stream tube flows outwards and presses with its own flow stress. No more than the sum of both
//! gets through the first element of the cone: where it would, the tip advances through the element, which keeps its length of
//! undisturbed target ahead of it.

use super::{
    part::Part,
    state::{Element, State},
};
use crate::material::{Material, cavity_expansion_pressure};

/// Added mass of a disc that moves normal to itself, on one side of it, over `ρ a³` \[lamb1932\].
const ADDED_MASS: f64 = 4.0 / 3.0;
/// Part of the force to which the advance is found.
const TOLERANCE: f64 = 1e-12;

/// What a target opposes to steady penetration.
#[derive(Debug, Clone, Copy)]
pub(super) struct Penetration {
    /// Quasi-static resistance [Pa].
    resistance: f64,
    /// Area of the stream tube: that of the undeformed projectile [m2].
    area: f64,
    /// Density of the target [kg/m3].
    density: f64,
}

/// Largest force that the first element of the cone can take at this time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limit {
    /// The element.
    pub(super) element: usize,
    /// [N].
    force: f64,
}

impl State {
    /// Lets the tip penetrate a target of a material; one that never yields cannot be penetrated.
    pub(super) fn let_penetrate(&mut self, material: &Material) {
        let (Some(resistance), Some(face)) =
            (cavity_expansion_pressure(material), self.face_segment())
        else {
            return;
        };
        let (area, density) = (self.parts[0].area, material.density.si());
        let radius = (area / std::f64::consts::PI).sqrt();
        self.nodes[self.segments[face].first_node].mass +=
            ADDED_MASS * density * radius.powi(3);
        self.penetration = Some(Penetration {
            resistance,
            area,
            density,
        });
    }

    /// What the first element of the cone can take now.
    pub(super) fn penetration_limit(&self) -> Option<Limit> {
        let penetration = self.penetration?;
        let mouth = self.segments[self.face_segment()?];
        let spread = self
            .tip_segment()
            .filter(|&tip| self.closed[tip] && !self.segments[tip].elements().is_empty())
            .map_or(0.0, |tip| {
                let last = &self.elements[self.segments[tip].elements().end - 1];
                let beyond = last.area(&self.parts[self.segments[tip].part]) - penetration.area;
                beyond.max(0.0) * last.stress.clamp(0.0, penetration.resistance)
            });
        Some(Limit {
            element: mouth.elements().start,
            force: penetration.area * penetration.resistance + spread,
        })
    }

    /// Pushes back on the tip with the inertia of the target that it turned aside in the last step.
    pub(super) fn turn_target_aside(&mut self) {
        self.drag = 0.0;
        let (Some(penetration), Some(face)) = (self.penetration, self.face_segment()) else {
            return;
        };
        let mouth = self.segments[face];
        let speed = self.elements[mouth.elements().start].advance_step / self.time_step;
        if speed > 0.0 {
            self.drag = 0.5 * penetration.density * penetration.area * speed * speed;
            self.nodes[mouth.first_node].force -= self.drag;
        }
    }

    /// Books what the target that was turned aside took with it.
    pub(super) fn book_target_turned_aside(&mut self, kick: f64) {
        let Some(face) = self.face_segment().filter(|_| self.drag > 0.0) else {
            return;
        };
        let node = &self.nodes[self.segments[face].first_node];
        let impulse = self.drag * kick;
        self.books.eroded_momentum += impulse;
        self.books.eroded_energy += impulse * 0.5 * (node.velocity_before + node.velocity);
    }

    /// Whether the pressure that brings the tail to rest, `½ρ_p V² + Y`, is more than the target's resistance: the threshold of
    /// Alekseevskii and Tate. Below it the tip spreads on a floor that stands, and nothing is turned back.
    pub(super) fn can_penetrate(&self, penetration: &Penetration) -> bool {
        let Some(tip) = self.tip_segment().map(|tip| self.segments[tip]) else {
            return false;
        };
        let tail = self.nodes[self.segments[0].first_node].velocity.max(0.0);
        let inertia = 0.5 * self.parts[tip.part].density * tail * tail;
        let strength = self.elements[tip.elements().end - 1].flow_stress;
        inertia + strength > penetration.resistance
    }
}

impl Element {
    /// Advances the tip over a time step as far as the limit asks, the ends of the element being a distance apart, and returns the
    /// plastic work around the cavity between the half steps around the current time [J].
    pub(super) fn penetrate(
        &mut self,
        part: &Part,
        distance: f64,
        time_step: f64,
        limit: Limit,
    ) -> f64 {
        let step = self.advance_step_to(part, distance, time_step, limit);
        // As with plastic strain, the work that belongs to a time is its force times half the advances around it.
        let work = self.axial_force * 0.5 * (self.advance_step + step);
        self.advance += step;
        self.advance_step = step;
        work
    }

    fn advance_step_to(&self, part: &Part, distance: f64, time_step: f64, limit: Limit) -> f64 {
        let excess = |step: f64| {
            let length = distance + self.advance + step;
            if length <= 0.0 {
                return f64::INFINITY;
            }
            let mut trial = *self;
            trial.deform(part, length, time_step);
            trial.axial_force - limit.force
        };
        if excess(0.0) <= 0.0 {
            return 0.0;
        }
        let (mut low, mut high) = (0.0, 1e-3 * self.rest_length);
        while excess(high) > 0.0 {
            low = high;
            high *= 2.0;
        }
        let (mut over, mut under) = (excess(low), excess(high));
        // Regula falsi, with the weight of an end that stays halved.
        let mut kept = 0;
        for _ in 0..60 {
            let step = if over.is_finite() {
                (low * under - high * over) / (under - over)
            } else {
                0.5 * (low + high)
            };
            let value = excess(step);
            if value.abs() <= TOLERANCE * limit.force {
                return step;
            }
            if value > 0.0 {
                (low, over) = (step, value);
                if kept == 1 {
                    under *= 0.5;
                }
                kept = 1;
            } else {
                (high, under) = (step, value);
                if kept == -1 {
                    over *= 0.5;
                }
                kept = -1;
            }
        }
        0.5 * (low + high)
    }
}
