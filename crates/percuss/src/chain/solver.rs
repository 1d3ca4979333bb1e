//! One step of explicit central differences, with the books kept so that only integration error is left in them.

use super::{
    part::Part,
    state::{Element, End, Segment, State},
};
use crate::{
    case::{ArtificialViscosity, Kinematics},
    error::NumericalError,
};

/// Largest change of strain that one element may make in one step.
pub(super) const LARGEST_STRAIN_STEP: f64 = 0.03;
/// Part of the largest time step allowed that is taken, so that the next ones need not be shorter again.
const STEP_MARGIN: f64 = 0.98;
/// The time step grows only when it could grow by this factor, and no faster than by the second one.
const STEP_SLACK: f64 = 1.1;
const LARGEST_STEP_GROWTH: f64 = 1.05;

/// Numbers that control the steps.
#[derive(Debug, Clone, Copy)]
pub(super) struct StepControl {
    pub(super) courant: f64,
    pub(super) viscosity: ArtificialViscosity,
    pub(super) damping_ratio: f64,
    pub(super) erosion_strain: f64,
}

impl StepControl {
    fn is_viscous(&self) -> bool {
        self.viscosity != ArtificialViscosity::default() || self.damping_ratio > 0.0
    }

    /// Factor on the stable step of the undamped chain at the moment of impact.
    pub(super) fn first_step_factor(&self, state: &State, impact_speed: f64) -> f64 {
        let slowness = state
            .parts
            .iter()
            .map(|part| part.slowness)
            .fold(0.0, f64::max);
        let ratio = self.damping_ratio
            + self.viscosity.linear
            + self.viscosity.quadratic * impact_speed * slowness;
        damped_limit(ratio)
    }

    /// Sets the viscous force of an element whose ends approach at a speed; returns the factor on its stable step.
    fn damp(&self, element: &mut Element, part: &Part, approach: f64) -> f64 {
        let mut ratio = self.damping_ratio;
        if approach > 0.0 {
            ratio += self.viscosity.linear + self.viscosity.quadratic * approach * part.slowness;
        }
        element.viscous_force =
            ratio * part.density * part.wave_speed * element.area(part) * approach;
        damped_limit(ratio)
    }
}

/// Part of the undamped stable step that is left with a damping ratio, for central differences with lagged velocities.
fn damped_limit(ratio: f64) -> f64 {
    (1.0 + ratio * ratio).sqrt() - ratio
}

impl State {
    /// Advances by one step.
    pub(super) fn advance(&mut self, control: &StepControl) -> Result<(), NumericalError> {
        let previous = self.time_step;
        let time_step = choose_time_step(previous, control.courant * self.stable_step);
        self.collect_forces();
        // Velocities live half a step behind positions: the kick spans the two half steps around the current time.
        self.kick(0.5 * (previous + time_step), control.is_viscous());
        self.close_gaps(time_step);
        self.drift(control, time_step)?;
        self.time += time_step;
        self.time_step = time_step;
        self.step += 1;
        self.erode(control.erosion_strain);
        Ok(())
    }

    fn collect_forces(&mut self) {
        for node in &mut self.nodes {
            node.force = 0.0;
            node.spring_force = 0.0;
            node.velocity_before = node.velocity;
        }
        for segment in &self.segments {
            let nodes = &mut self.nodes[segment.first_node..=segment.last_node];
            let elements = &self.elements[segment.elements()];
            for (i, element) in elements.iter().enumerate() {
                let force = element.axial_force + element.viscous_force;
                nodes[i].force -= force;
                nodes[i].spring_force -= element.axial_force;
                nodes[i + 1].force += force;
                nodes[i + 1].spring_force += element.axial_force;
            }
        }
    }

    /// New velocities from forces, friction, contact and the boundary.
    fn kick(&mut self, kick: f64, viscous: bool) {
        self.contact_force = 0.0;
        let last_segment = self.segments.len() - 1;
        // Whether the contact before a segment was closed when the kick began: it may open on the way.
        let mut joined_ahead = false;
        for s in 0..=last_segment {
            let Segment {
                first_node,
                last_node,
                ..
            } = self.segments[s];
            let from = first_node + usize::from(joined_ahead);
            let joined_behind = s < last_segment && self.closed[s];
            let is_boundary = s == last_segment && self.end != End::Free;
            let to = last_node + 1 - usize::from(joined_behind || is_boundary);
            for i in from..to {
                self.kick_free(i, kick);
            }
            if is_boundary && from <= last_node {
                self.kick_boundary(last_node, kick);
            }
            if joined_behind {
                self.kick_contact(s, kick);
            }
            joined_ahead = joined_behind;
        }
        if viscous {
            self.book_viscous_work(kick);
        }
    }

    fn book_viscous_work(&mut self, kick: f64) {
        let mut work = 0.0;
        for segment in &self.segments {
            for e in segment.elements() {
                let (a, b) = (e + segment.part, e + segment.part + 1);
                let before = self.nodes[a].velocity_before - self.nodes[b].velocity_before;
                let after = self.nodes[a].velocity - self.nodes[b].velocity;
                work += self.elements[e].viscous_force * 0.5 * (before + after) * kick;
            }
        }
        self.books.viscous_work += work;
    }

    fn kick_free(&mut self, i: usize, kick: f64) {
        let change = self.nodes[i].force * kick / self.nodes[i].mass;
        self.nodes[i].velocity = if self.nodes[i].friction > 0.0 {
            let before = self.nodes[i].velocity;
            let limit = self.nodes[i].friction * kick / self.nodes[i].mass;
            let after = rub(before, change, limit);
            let impulse = self.book_friction(self.nodes[i].mass, before, change, after);
            if self.tip_friction > 0.0 {
                // A constant-pressure target has no other friction.
                self.contact_force = impulse / kick;
            }
            after
        } else {
            self.nodes[i].velocity + change
        };
    }

    /// Books what friction took and returns its impulse.
    fn book_friction(&mut self, mass: f64, before: f64, change: f64, after: f64) -> f64 {
        let impulse = mass * (before + change - after);
        self.books.friction_impulse += impulse;
        self.books.friction_work += impulse * 0.5 * (before + after);
        impulse
    }

    fn kick_boundary(&mut self, i: usize, kick: f64) {
        match self.end {
            End::Free => self.kick_free(i, kick),
            End::Fixed => {
                self.nodes[i].velocity = 0.0;
                self.books.support_impulse += self.nodes[i].force * kick;
                self.back_force = self.nodes[i].force;
            }
            End::Dashpot(impedance) => {
                let inertia = self.nodes[i].mass / kick;
                let before = self.nodes[i].velocity;
                let after = ((inertia - 0.5 * impedance) * before + self.nodes[i].force)
                    / (inertia + 0.5 * impedance);
                let mean = 0.5 * (before + after);
                self.nodes[i].velocity = after;
                self.back_force = impedance * mean;
                self.books.support_impulse += impedance * mean * kick;
                self.books.boundary_work += impedance * mean * mean * kick;
            }
        }
    }

    /// Moves the two nodes of a closed contact as one, or lets them part when the contact would pull.
    fn kick_contact(&mut self, s: usize, kick: f64) {
        let (a, b) = (self.segments[s].last_node, self.segments[s + 1].first_node);
        let fixed = self.is_fixed(b);
        let (before, combined_mass) = if fixed {
            (0.0, f64::INFINITY)
        } else {
            let mass = self.nodes[a].mass + self.nodes[b].mass;
            let momentum = self.nodes[a].mass * self.nodes[a].velocity
                + self.nodes[b].mass * self.nodes[b].velocity;
            (momentum / mass, mass)
        };
        // Both nodes start the kick with their common velocity; what that costs is the loss of a plastic impact.
        for i in [a, b] {
            let jump = before - self.nodes[i].velocity;
            self.book_jump(i, jump, -self.time_step);
            if fixed && i == a {
                self.books.support_impulse -= self.nodes[i].mass * jump;
            }
            self.nodes[i].velocity_before = before;
        }
        let contact_force = if fixed {
            self.nodes[a].velocity = 0.0;
            self.nodes[b].velocity = 0.0;
            self.nodes[a].force
        } else {
            let change = (self.nodes[a].force + self.nodes[b].force) * kick / combined_mass;
            let friction = self.nodes[a].friction + self.nodes[b].friction;
            let after = rub(before, change, friction * kick / combined_mass);
            self.nodes[a].velocity = after;
            self.nodes[b].velocity = after;
            let own_friction = friction_force(
                self.nodes[a].friction,
                friction,
                combined_mass,
                before,
                change,
                after,
                kick,
            );
            self.nodes[a].force + own_friction - self.nodes[a].mass * (after - before) / kick
        };
        if contact_force < 0.0 {
            self.closed[s] = false;
            self.nodes[a].velocity = before;
            self.nodes[b].velocity = before;
            self.kick_free(a, kick);
            if self.is_boundary(b) {
                self.kick_boundary(b, kick);
            } else {
                self.kick_free(b, kick);
            }
            return;
        }
        if fixed {
            self.books.support_impulse += (self.nodes[a].force + self.nodes[b].force) * kick;
            self.back_force = self.nodes[a].force + self.nodes[b].force;
        } else {
            let change = (self.nodes[a].force + self.nodes[b].force) * kick / combined_mass;
            self.book_friction(combined_mass, before, change, self.nodes[a].velocity);
        }
        if Some(s) == self.tip_segment() {
            self.contact_force = contact_force;
        }
    }

    fn is_boundary(&self, i: usize) -> bool {
        self.end != End::Free && self.segments.last().is_some_and(|last| last.last_node == i)
    }

    fn is_fixed(&self, i: usize) -> bool {
        self.end == End::Fixed && self.is_boundary(i)
    }

    /// Books the energy of a sudden change of a node's velocity.
    ///
    /// A kick does its work at the mean of the velocities before and after it, the springs do theirs at the velocities of
    /// the two drifts around it: a jump between kick and drift leaves half a drift's work to book. `drift` is the length
    /// of the drift on the jump's side of the kick, negative when the jump comes before the kick.
    fn book_jump(&mut self, i: usize, jump: f64, drift: f64) {
        let velocity = self.nodes[i].velocity;
        let kinetic = 0.5 * self.nodes[i].mass * ((velocity + jump).powi(2) - velocity.powi(2));
        self.books.contact_loss -= kinetic - 0.5 * drift * self.nodes[i].spring_force * jump;
    }

    /// Closes every gap that would overlap at the end of the step, so that it is zero then.
    fn close_gaps(&mut self, time_step: f64) {
        for s in 0..self.closed.len() {
            if self.closed[s] {
                continue;
            }
            let (a, b) = (self.segments[s].last_node, self.segments[s + 1].first_node);
            let gap = self.nodes[b].position - self.nodes[a].position;
            let approach = self.nodes[a].velocity - self.nodes[b].velocity;
            if gap - approach * time_step > 0.0 {
                continue;
            }
            let allowed = gap.max(0.0) / time_step;
            let (share_a, share_b) = if self.is_fixed(b) {
                (1.0, 0.0)
            } else {
                let mass = self.nodes[a].mass + self.nodes[b].mass;
                (self.nodes[b].mass / mass, self.nodes[a].mass / mass)
            };
            let change = approach - allowed;
            for (i, jump) in [(a, -share_a * change), (b, share_b * change)] {
                self.book_jump(i, jump, time_step);
                self.nodes[i].velocity += jump;
            }
            if self.is_fixed(b) {
                self.books.support_impulse += self.nodes[a].mass * change;
            }
            self.closed[s] = true;
        }
    }

    /// Moves the nodes and updates every element.
    fn drift(&mut self, control: &StepControl, time_step: f64) -> Result<(), NumericalError> {
        let viscous = control.is_viscous();
        let mut stable_step = f64::INFINITY;
        for segment in &self.segments {
            let part = &self.parts[segment.part];
            let nodes = &mut self.nodes[segment.first_node..=segment.last_node];
            for node in nodes.iter_mut() {
                node.position += node.velocity * time_step;
            }
            let elements = &mut self.elements[segment.elements()];
            let mut plastic_work = 0.0;
            for (i, (pair, element)) in nodes.windows(2).zip(elements).enumerate() {
                let length = pair[1].position - pair[0].position;
                if length <= 0.0 {
                    return Err(inverted(self.step, self.time, segment.elements().start + i));
                }
                plastic_work += element.rest_length * element.deform(part, length, time_step);
                let approach = pair[0].velocity - pair[1].velocity;
                let mut limit = element.stable_step(part);
                if viscous {
                    limit *= control.damp(element, part, approach);
                }
                if part.kinematics == Kinematics::Logarithmic
                    && approach.abs() * limit > LARGEST_STRAIN_STEP * length
                {
                    limit = LARGEST_STRAIN_STEP * length / approach.abs();
                }
                stable_step = stable_step.min(limit);
            }
            self.books.plastic[part.role as usize] += part.area * plastic_work;
        }
        self.stable_step = stable_step;
        Ok(())
    }

    /// Takes out the elements whose strain has passed the limit, booking what leaves with them.
    fn erode(&mut self, limit: f64) {
        let mut s = 0;
        while s < self.segments.len() {
            let segment = self.segments[s];
            let found = segment
                .elements()
                .find(|&e| self.elements[e].strain.abs() >= limit);
            match found {
                // The segment at `s` is another one afterwards: look again.
                Some(e) => self.remove_element(s, e),
                None => s += 1,
            }
        }
    }

    fn remove_element(&mut self, s: usize, e: usize) {
        let segment = self.segments[s];
        let part = &self.parts[segment.part];
        let half_mass = 0.5 * part.density * part.area * self.elements[e].rest_length;
        let half_friction = 0.5 * part.friction_per_length * self.elements[e].rest_length;
        self.books.eroded_energy += self.elastic_energy(e, part);
        let left = e + segment.part;
        for i in [left, left + 1] {
            let velocity = self.nodes[i].velocity;
            self.books.eroded_energy += 0.5 * half_mass * velocity * velocity;
            self.books.eroded_momentum += half_mass * velocity;
            self.nodes[i].mass -= half_mass;
            self.nodes[i].friction = (self.nodes[i].friction - half_friction).max(0.0);
        }
        self.elements[e].eroded = true;
        let before = Segment {
            last_node: left,
            ..segment
        };
        let after = Segment {
            first_node: left + 1,
            ..segment
        };
        // A node without an element has no mass left and goes too.
        let is_last = s + 1 == self.segments.len();
        let kept: Vec<Segment> = [before, after]
            .into_iter()
            .filter(|piece| !piece.elements().is_empty())
            .collect();
        match kept.len() {
            2 => self.closed.insert(s, false),
            1 => {
                // The contact on the side of the lost node is open now.
                let lost_front = before.elements().is_empty();
                let contact = if lost_front {
                    s.checked_sub(1)
                } else {
                    Some(s)
                };
                if let Some(contact) = contact.filter(|&c| c < self.closed.len()) {
                    self.closed[contact] = false;
                }
                if !lost_front && is_last {
                    self.end = End::Free;
                }
            }
            _ => {
                // The whole segment is gone: its two contacts become one, open.
                if is_last {
                    self.closed.pop();
                    self.end = End::Free;
                } else {
                    self.closed.remove(s);
                    if s > 0 {
                        self.closed[s - 1] = false;
                    }
                }
            }
        }
        self.segments.splice(s..=s, kept);
        if self.tip_friction > 0.0
            && let Some(tip) = self.segments.last()
        {
            self.nodes[tip.last_node].friction = self.tip_friction;
        }
    }
}

fn inverted(step: u64, time: f64, element: usize) -> NumericalError {
    NumericalError {
        what: "an element was compressed to nothing".to_owned(),
        step,
        time_us: time * 1e6,
        element: Some(element),
        remedy: "use logarithmic kinematics, or lower `chain.courant` or `chain.erosion_strain`"
            .to_owned(),
    }
}

/// Time step after one of length `previous`, when `allowed` is the largest one allowed.
///
/// Every change of the time step costs a little energy, so small changes are not made.
fn choose_time_step(previous: f64, allowed: f64) -> f64 {
    if previous == 0.0 || allowed < previous {
        STEP_MARGIN * allowed
    } else if allowed > STEP_SLACK * previous {
        LARGEST_STEP_GROWTH * previous
    } else {
        previous
    }
}

/// Part of the friction on a pair of nodes that acts on the first of them [N].
fn friction_force(
    own_limit: f64,
    limit: f64,
    mass: f64,
    before: f64,
    change: f64,
    after: f64,
    kick: f64,
) -> f64 {
    if limit == 0.0 {
        return 0.0;
    }
    let impulse = mass * (after - before - change);
    impulse / kick * own_limit / limit
}

/// Velocity after a kick with dry friction.
///
/// `change` is what the forces alone would add and `limit` the most that friction can take away. The motion within the
/// step is followed exactly: friction slows, holds the node if it can, and opposes the motion that starts afresh.
pub(super) fn rub(before: f64, change: f64, limit: f64) -> f64 {
    if limit == 0.0 {
        return before + change;
    }
    if before == 0.0 {
        return if change.abs() <= limit {
            0.0
        } else {
            change - limit.copysign(change)
        };
    }
    let sign = before.signum();
    let loss = limit - sign * change;
    if loss <= 0.0 || before.abs() >= loss {
        return before + change - sign * limit;
    }
    let after = if change.abs() <= limit {
        0.0
    } else {
        let rest = 1.0 - before.abs() / loss;
        rest * (change + sign * limit)
    };
    // Where the node turns almost symmetrically, the mean velocity would let friction push: it may not.
    let friction = after - before - change;
    if friction * (before + after) > 0.0 {
        before + change
    } else {
        after
    }
}

#[cfg(test)]
mod tests {
    use super::rub;

    #[test]
    fn friction_holds_slows_and_never_pushes() {
        assert_eq!(rub(0.0, 0.5, 1.0), 0.0);
        assert_eq!(rub(0.0, 1.5, 1.0), 0.5);
        assert_eq!(rub(3.0, -0.5, 1.0), 1.5);
        assert_eq!(rub(0.5, -0.2, 1.0), 0.0);
        for i in 0..200 {
            for j in 0..200 {
                let (before, change) = (i as f64 * 0.05 - 5.0, j as f64 * 0.05 - 5.0);
                for limit in [0.1, 1.0, 3.0] {
                    let after = rub(before, change, limit);
                    let friction = after - before - change;
                    assert!(friction.abs() <= limit + 1e-12);
                    assert!(
                        friction * (before + after) <= 1e-12,
                        "{before} {change} {limit}"
                    );
                }
            }
        }
    }
}
