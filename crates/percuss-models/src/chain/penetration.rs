//! Target resistance model `diverging-penetrable`: the tip goes through the target where the cone would push back harder than the target can.
//!
//! A target resists slow penetration with the pressure p_s that expands a cavity in it, on the stream tube of the projectile. What the
//! projectile has spread beyond its stream tube flows outwards and presses with its own flow stress. No more than the sum of both
//! gets through the first element of the cone: where it would, the tip advances through the element, which keeps its length of
//! undisturbed target ahead of it. What the tip meets with the speed w is turned aside and pushes back on it with `½ρ_t w²`, as in
//! the equation of Alekseevskii and Tate.

use pulp::{Arch, NullaryFnOnce};
use serde::{Deserialize, Serialize};

use super::{
    part::Section,
    state::{Element, State},
};
use crate::material::{Material, cavity_expansion_pressure_at};

/// Added mass of a disc that moves normal to itself, on one side of it, over `ρ a³` \[lamb1932\].
const ADDED_MASS: f64 = 4.0 / 3.0;
/// Section of the force to which the advance is found.
const TOLERANCE: f64 = 1e-12;

/// What a target opposes to steady penetration.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct Penetration {
    /// Quasi-static resistance [Pa].
    resistance: f64,
    /// Area of the stream tube: that of the undeformed projectile [m2].
    area: f64,
    /// Density of the target [kg/m3].
    density: f64,
    /// Mass that the tip has still to take up until the flow around it is steady [kg].
    missing_mass: f64,
}

/// Largest force [N] that the first element of the cone can take at this time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limit {
    /// The element.
    pub(super) element: usize,
    /// [N].
    force: f64,
}

impl State {
    /// Lets the tip penetrate a target of a material at a temperature [K]; one that never yields cannot be penetrated.
    pub(super) fn let_penetrate(&mut self, material: &Material, temperature: f64) {
        let Some(resistance) = cavity_expansion_pressure_at(material, temperature) else {
            return;
        };
        let (area, density) = (self.parts[0].area, material.density.si());
        let radius = (area / std::f64::consts::PI).sqrt();
        self.penetration = Some(Penetration {
            resistance,
            area,
            density,
            missing_mass: ADDED_MASS * density * radius.powi(3),
        });
    }

    /// What the first element of the cone can take now.
    pub(super) fn penetration_limit(&self) -> Option<Limit> {
        let penetration = self.penetration?;
        let mouth = self.segments[self.face_segment()?];
        let spread = self.spread_load(&penetration);
        Some(Limit {
            element: mouth.elements().start,
            force: penetration.area * penetration.resistance + spread,
        })
    }

    /// Load of what the projectile has spread beyond its stream tube [N].
    ///
    /// It presses with the flow stress of the tip. What a tip that upsets brings to rest on the axis, `½ρ_p w²`, is part of the
    /// same force and not spread; once the projectile erodes, that part arrives element by element and comes on top of it.
    fn spread_load(&self, penetration: &Penetration) -> f64 {
        let Some(tip) = self
            .tip_segment()
            .filter(|&tip| self.interfaces[tip].closed)
        else {
            return 0.0;
        };
        let segment = self.segments[tip];
        let part = &self.parts[segment.part];
        let Some(last) = segment.elements().next_back() else {
            return 0.0;
        };
        let last = self.elements.get(last);
        let beyond = last.area(part) - penetration.area;
        let spread = beyond.max(0.0) * last.spring.stress.clamp(0.0, penetration.resistance);
        let closing = self.nodes.velocity[0] - self.nodes.velocity[segment.last_node];
        let on_axis = 0.5 * part.density * penetration.area * closing.max(0.0).powi(2);
        let eroded = |e| self.elements.part(e, |block| &block.eroded);
        if (0..part.elements).any(eroded) {
            spread
        } else {
            (spread - on_axis).max(0.0)
        }
    }

    /// Applies the resistance of the target that the tip penetrated in the last step.
    ///
    /// What it meets first piles up on it and moves with it from then on, until that is the added mass of the flow; the rest is
    /// turned aside.
    pub(super) fn apply_target_reaction(&mut self) {
        self.drag = 0.0;
        let (Some(mut penetration), Some(face)) = (self.penetration, self.face_segment()) else {
            return;
        };
        let mouth = self.segments[face];
        let advance = self.elements.get(mouth.elements().start).advance_step;
        if advance <= 0.0 {
            return;
        }
        let met = penetration.density * penetration.area * advance;
        let i = mouth.first_node;
        if penetration.missing_mass > 0.0 {
            let mass = met.min(penetration.missing_mass);
            penetration.missing_mass -= mass;
            let node = self.nodes.at(i);
            // It is taken up at rest, as by a plastic impact.
            let jump = -node.velocity * mass / (node.mass + mass);
            self.account_for_jump(i, jump, -self.time_step);
            let after = node.velocity + jump;
            self.accumulated.kicks.contact_loss -= 0.5 * mass * after * after;
            self.nodes.mass[i] += mass;
            self.nodes.velocity[i] = after;
            self.nodes.velocity_before[i] = after;
            self.penetration = Some(penetration);
        } else {
            self.drag = 0.5 * met * advance / (self.time_step * self.time_step);
            self.nodes.force[i] -= self.drag;
        }
    }

    /// Accumulators what the target that was turned aside took with it.
    pub(super) fn account_for_target_turned_aside(&mut self, kick: f64) {
        let Some(face) = self.face_segment().filter(|_| self.drag > 0.0) else {
            return;
        };
        let node = self.nodes.at(self.segments[face].first_node);
        let impulse = self.drag * kick;
        self.accumulated.eroded_momentum += impulse;
        self.accumulated.eroded_energy += impulse * 0.5 * (node.velocity_before + node.velocity);
    }

    /// Whether the pressure that brings the tail to rest, `½ρ_p V² + Y`, is more than the target's resistance: the threshold of
    /// Alekseevskii and Tate. Below it the tip spreads on a floor that stands, and nothing is turned back.
    pub(super) fn can_penetrate(&self, penetration: &Penetration) -> bool {
        let Some(tip) = self.tip_segment().map(|tip| self.segments[tip]) else {
            return false;
        };
        let tail = self.nodes.velocity[self.segments[0].first_node].max(0.0);
        let inertia = 0.5 * self.parts[tip.part].density * tail * tail;
        let strength = self
            .elements
            .get(tip.elements().end - 1)
            .yield_point
            .stress();
        inertia + strength > penetration.resistance
    }
}

/// Force of an element at another length [N], compiled once for every instruction set.
struct ForceAt<'a> {
    trial: Element,
    part: &'a Section,
    length: f64,
    time_step: f64,
}

impl NullaryFnOnce for ForceAt<'_> {
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        let mut trial = self.trial;
        trial.deform(self.part, self.length, self.time_step);
        trial.axial_force
    }
}

impl Element {
    /// Advances the tip over a time step as far as the limit asks, the ends of the element being a distance apart, and returns the
    /// plastic work around the cavity between the half steps around the current time [J].
    pub(super) fn penetrate(
        &mut self,
        part: &Section,
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

    fn advance_step_to(&self, part: &Section, distance: f64, time_step: f64, limit: Limit) -> f64 {
        let excess = |step: f64| {
            let length = distance + self.advance + step;
            if length <= 0.0 {
                return f64::INFINITY;
            }
            let force = Arch::new().dispatch(ForceAt {
                trial: *self,
                part,
                length,
                time_step,
            });
            force - limit.force
        };
        let mut over = excess(0.0);
        if over <= 0.0 {
            return 0.0;
        }
        let (mut low, mut high) = (0.0, 1e-3 * self.rest_length);
        let mut under = excess(high);
        while under > 0.0 {
            (low, over) = (high, under);
            high *= 2.0;
            under = excess(high);
        }
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
