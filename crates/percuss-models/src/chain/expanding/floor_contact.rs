//! Contact of the projectile's tip with the crater floor and the ground under it.

use super::{
    crater_floor::{Contact, Tip},
    state::State,
};
use crate::chain::part::Role;

impl State {
    /// What the tip brings to the floor.
    fn tip(&self) -> Tip {
        let (Some(node), Some(slice)) = (self.rod.front.tip(), self.rod.front.slices.last()) else {
            return Tip::default();
        };
        Tip {
            area: slice.area(),
            flow_stress: slice.flow_stress(),
            yield_stress: slice.yield_point.stress(),
            density: self.rod.front.metal.density,
            closing: (self.rod.front.nodes.get(0).velocity - node.velocity).max(0.0),
        }
    }

    /// Speed at which the tip comes closer to the floor [m/s].
    fn approach(&self) -> f64 {
        let tip = self.rod.front.tip().map_or(0.0, |node| node.velocity);
        tip - self.far_field_velocity() - self.floor.speed
    }

    /// Velocity of the ground under the floor [m/s].
    pub(super) fn far_field_velocity(&self) -> f64 {
        self.far_field.mouth().velocity + self.echo_velocity()
    }

    /// Part of it that reflected waves bring along [m/s].
    fn echo_velocity(&self) -> f64 {
        self.rear_face.as_ref().map_or(0.0, |face| face.velocity)
    }

    /// Limits the approach velocity of a tip in contact with the floor, as a plastic impact.
    pub(super) fn limit_approach(&mut self, allowed: f64, drift: f64) {
        if self.floor.contact == Contact::Open {
            return;
        }
        let change = self.approach() - allowed;
        let mobility = self.floor.mobility();
        let before = self.floor.kinetic_energy();
        let (Some(mut tip), mut far_field) = (self.rod.front.tip(), self.far_field.mouth()) else {
            return;
        };
        let impulse = change / (tip.mobility() + far_field.mobility() + mobility);
        let mut loss = tip.jump(-impulse * tip.mobility(), drift);
        loss += far_field.jump(impulse * far_field.mobility(), drift);
        self.rod.front.nodes.set_last(tip);
        self.far_field.nodes.set(0, far_field);
        self.floor.speed = (self.floor.speed + impulse * mobility).max(0.0);
        let reflected = impulse * self.echo_velocity();
        self.accumulated.contact_impulse += impulse;
        self.accumulated.reflected_work += reflected;
        self.accumulated.contact_loss += loss + before - self.floor.kinetic_energy() - reflected;
    }

    /// New velocities of the tip, the floor and the ground under it, whose velocity gains something by reflected waves [m/s].
    pub(super) fn kick_floor(&mut self, kick: f64, echo_gain: f64) {
        let echo = self.echo_velocity();
        let echo_mean = echo - 0.5 * echo_gain;
        let echo_pull = echo_gain / kick;
        let resisting = self.floor.resistance(self.tip());
        let tip = self.rod.front.tip();
        let (tip_force, tip_mass) = tip.map_or((0.0, 0.0), |n| (n.whole_force(), n.mass()));
        let mut far_field = self.far_field.mouth();
        let far_field_force = far_field.whole_force();
        let force = match self.floor.contact {
            Contact::Open => None,
            Contact::Closed => {
                let together = (tip_force + far_field_force + far_field.mass() * echo_pull)
                    / (tip_mass + far_field.mass());
                let held = tip_force - tip_mass * together;
                if self.floor.speed == 0.0 && held <= resisting {
                    Some((held, 0.0))
                } else {
                    let added = self.floor.added_mass();
                    let pull = (tip_force - resisting) / tip_mass
                        - (resisting + far_field_force) / far_field.mass()
                        - echo_pull;
                    let gain = pull / (1.0 + added * (1.0 / tip_mass + 1.0 / far_field.mass()));
                    Some((resisting + added * gain, gain))
                }
            }
        };
        let Some((force, gain)) = force.filter(|(force, _)| *force >= 0.0) else {
            self.floor.contact = Contact::Open;
            self.contact_force = 0.0;
            self.accumulated.plastic[Role::Target as usize] += self.floor.coast(kick);
            if let Some(mut tip) = tip {
                tip.kick(tip_force * kick);
                self.rod.front.nodes.set_last(tip);
            }
            far_field.kick(far_field_force * kick);
            self.far_field.nodes.set(0, far_field);
            return;
        };
        self.contact_force = force;
        let before = self.floor.speed;
        let after = before + gain * kick;
        let Some(mut tip) = tip else {
            return;
        };
        if after >= 0.0 {
            tip.kick((tip_force - force) * kick);
            far_field.kick((far_field_force + force) * kick);
            self.rod.front.nodes.set_last(tip);
            self.far_field.nodes.set(0, far_field);
            self.floor.speed = after;
            self.accumulated.contact_impulse += force * kick;
            self.accumulated.reflected_work += force * kick * echo_mean;
            let work = resisting * 0.5 * (before + after) * kick;
            self.accumulated.plastic[Role::Target as usize] += if gain == 0.0 { 0.0 } else { work };
            return;
        }
        // The floor comes to rest on the way: tip and ground go on together, and the target has taken what they lose.
        let kinetic =
            tip.kinetic_energy() + far_field.kinetic_energy() + self.floor.kinetic_energy();
        let momentum = tip.mass() * tip.velocity
            + far_field.mass() * far_field.velocity
            + (tip_force + far_field_force) * kick;
        let common = (momentum + far_field.mass() * echo) / (tip.mass() + far_field.mass());
        let below = common - echo;
        let work = kick
            * 0.5
            * (tip_force * (tip.velocity + common)
                + far_field_force * (far_field.velocity + below));
        let impulse = far_field.mass() * (below - far_field.velocity) - far_field_force * kick;
        tip.take_velocity(common);
        far_field.take_velocity(below);
        self.rod.front.nodes.set_last(tip);
        self.far_field.nodes.set(0, far_field);
        self.floor.speed = 0.0;
        let left = tip.kinetic_energy() + far_field.kinetic_energy();
        self.accumulated.contact_impulse += impulse;
        self.accumulated.reflected_work += impulse * echo_mean;
        self.accumulated.plastic[Role::Target as usize] +=
            kinetic + work - left - impulse * echo_mean;
    }

    /// Brings a tip that would pass the floor within the step to touch it at the end of the step.
    pub(super) fn close(&mut self, time_step: f64) {
        if self.floor.contact == Contact::Closed {
            return;
        }
        let Some(tip) = self.rod.front.tip() else {
            return;
        };
        let gap = self.position() - (tip.position + self.floor.lost_length);
        if gap > self.approach() * time_step {
            return;
        }
        self.floor.contact = Contact::Closed;
        self.limit_approach(gap.max(0.0) / time_step, time_step);
    }
}
