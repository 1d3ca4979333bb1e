//! Fracture of bodies and bonded interfaces by their failure laws.
//!
//! A body parts at a node, whose mass goes to its two elements: mass, momentum and energy stay what they are. The two ends touch
//! until the next kick pulls them apart. An element parts from one of its neighbours only.

use super::{
    interface::{CohesiveLaw, Interface},
    state::{Element, Parting, Segment, State},
};
use crate::{
    Refusal,
    lanes::LANES,
    material::{DamageState, FailureState},
    scenario::{Scenario, TargetBody},
};

/// Why the failure law of a case cannot be applied, if it cannot.
pub(super) fn not_applicable(scenario: &Scenario) -> Option<Refusal> {
    let failure = scenario.options.chain.failure.as_ref()?;
    let mut materials = vec![&scenario.projectile.material];
    if let TargetBody::Layers { layers, .. } = &scenario.target {
        materials.extend(layers.iter().map(|plate| &plate.material));
    }
    let law = failure.law();
    let has_none = materials
        .iter()
        .all(|material| law.prepare(material).is_none());
    has_none.then(|| {
        let key = failure.key();
        Refusal::new(format!("the failure law `{key}` has no numbers")).with_remedy(format!(
            "give them in `chain.failure.{key}`, or `{}` in the record of a material",
            law.record_key()
        ))
    })
}

impl State {
    /// Brings the damage of every element up to the end of the step.
    pub(super) fn damage(&mut self, time_step: f64) {
        for segment in &self.segments {
            let part = &self.parts[segment.part];
            let Some(law) = &part.failure else { continue };
            // The column is held sideways: σ = k Y and σ − σ_r = Y give a mean stress of (k − 2/3) Y.
            let triaxiality = part.constraint - 2.0 / 3.0;
            for e in segment.elements() {
                let (block, l) = (&mut self.elements.blocks_mut()[e / LANES], e % LANES);
                let stress = block.spring.stress[l];
                let increment = block.plastic.step[l].abs();
                block.damage[l] = law.damage(
                    block.damage[l],
                    &FailureState {
                        tension: -stress,
                        triaxiality: triaxiality.copysign(-stress),
                        plastic_strain_increment: increment,
                        strain_rate: DamageState::rate(increment, time_step, part.rate_effects),
                        temperature: block.plastic.temperature[l],
                    },
                    time_step,
                );
            }
        }
    }

    /// Parts segments and bonded interfaces where elements have failed and something pulls.
    ///
    /// One node a segment and step, the one whose two elements are damaged most: the new ends unload their neighbours.
    pub(super) fn split_failed_interfaces(&mut self) {
        for s in 0..self.interfaces.len() {
            if self.interfaces[s].bond == CohesiveLaw::Unbroken {
                let ahead = self.segments[s + 1].elements().start;
                let behind = self.segments[s].elements().end;
                if behind > self.segments[s].elements().start && self.fails(behind - 1, ahead) {
                    self.interfaces[s].bond = self.part(s, behind - 1, ahead);
                }
            }
        }
        let mut s = 0;
        while s < self.segments.len() {
            if self.parts[self.segments[s].part].failure.is_some()
                && let Some(element) = self.weakest(s)
            {
                self.split(s, element);
                s += 1;
            }
            s += 1;
        }
    }

    /// Mean damage of two neighbouring elements.
    fn damage_between(&self, behind: usize, ahead: usize) -> f64 {
        let damage = |e| self.elements.part(e, |block| &block.damage);
        0.5 * (damage(behind) + damage(ahead))
    }

    /// Whether the node between two elements parts: one of them has failed, and something pulls.
    fn fails(&self, behind: usize, ahead: usize) -> bool {
        let force = |e| self.elements.part(e, |block| &block.axial_force);
        force(behind) + force(ahead) < 0.0
            && [behind, ahead]
                .iter()
                .any(|&e| self.elements.get(e).has_failed())
    }

    /// The element ahead of the node of a segment that has failed most, if one has.
    fn weakest(&self, s: usize) -> Option<usize> {
        let elements = self.segments[s].elements();
        let damage = |e| self.elements.part(e, |block| &block.damage);
        if elements.clone().all(|e| damage(e) < 1.0) {
            return None;
        }
        (elements.start + 1..elements.end)
            .filter(|&e| self.fails(e - 1, e))
            .max_by(|&a, &b| {
                self.damage_between(a - 1, a)
                    .total_cmp(&self.damage_between(b - 1, b))
            })
    }

    /// Accumulators a parting between two elements and returns the crack that opens there.
    fn part(&mut self, s: usize, behind: usize, ahead: usize) -> CohesiveLaw {
        let after = self.elements.get(ahead);
        self.partings.push(Parting {
            position: after.initial_position - 0.5 * after.rest_length,
            time: self.time,
        });
        for e in [behind, ahead] {
            let failed = |element: &mut Element| element.parted |= element.has_failed();
            self.elements.change(e, failed);
        }
        let part = &self.parts[self.segments[s].part];
        let (behind, ahead) = (self.elements.get(behind), self.elements.get(ahead));
        let strength = -0.5 * (behind.axial_force + ahead.axial_force);
        let area = behind.rest_area.min(ahead.rest_area);
        CohesiveLaw::crack(strength, part.fracture_energy * area)
    }

    /// Parts segment `s` before an element.
    fn split(&mut self, s: usize, element: usize) {
        let segment = self.segments[s];
        let friction_per_length = self.parts[segment.part].friction_per_length;
        let bond = self.part(s, element - 1, element);
        let node = element + segment.shift;
        let mut ahead = self.nodes.at(node);
        let first = self.elements.get(element);
        ahead.mass = first.end_masses[0];
        let share = 0.5 * friction_per_length * first.rest_length;
        ahead.friction = ahead.friction.min(share);
        self.nodes.mass[node] -= ahead.mass;
        self.nodes.friction[node] -= ahead.friction;
        self.nodes.insert(node + 1, ahead);
        if let Some(hold) = &mut self.hold {
            hold.bands.part(node);
        }
        self.segments[s].last_node = node;
        for later in &mut self.segments[s + 1..] {
            later.first_node += 1;
            later.last_node += 1;
            later.shift += 1;
        }
        self.segments.insert(
            s + 1,
            Segment {
                first_node: node + 1,
                last_node: segment.last_node + 1,
                shift: segment.shift + 1,
                ..segment
            },
        );
        self.interfaces.insert(s, Interface::new(true, bond));
    }
}

impl Element {
    /// Whether it has failed and not yet separated from a neighbour.
    fn has_failed(&self) -> bool {
        self.damage >= 1.0 && !self.parted
    }
}
