//! Dishing: plug and plate around it as elastic–plastic Mindlin plates, followed in the radius.
//!
//! Rings between the axis, the rim of the plug, and a support. Every ring bends (M_r, M_θ) and shears (Q) between two circles
//! that have a deflection and a rotation each. At the rim the bands lie between two circles, which turn as one while the bands hold. The plug
//! deflects about the mean motion of its slices, which the chain has: `∫ v r dr = 0`. Moments and shear force lie inside the
//! yield surface of von Mises, `M_r² − M_r M_θ + M_θ² + 3 (Q h/4)² ≤ (σ h²/4)²`, with the flow stress σ at the mean strain of the section.

use super::{
    band_law::Failure,
    dishing_mesh::{Circle, rings, widths},
    plate_flow::FlowingRings,
    plate_section::{PlateSection, Ring},
};
use crate::{
    Error, lanes::LANES, material::Material, options::ChainOptions, problem::EdgeSupport,
    scenario::PlateEdge, solver::archive::Archive,
};

/// A plug and the plate around it.
#[derive(Debug)]
pub(super) struct Dishing {
    section: PlateSection,
    circles: Vec<Circle>,
    rings: Vec<Ring>,
    /// Numbers of the rings that move in a step, and of those that flow.
    moved: Vec<usize>,
    flowing: Vec<usize>,
    /// Circles of the plug, the first of `circles`; none where it is a boss that does not deform.
    plug: usize,
    support: EdgeSupport,
    /// Whether plug and plate turn as one at the rim.
    pub(super) edge_held: bool,
    /// Impulse that the support took [N s].
    pub(super) support_impulse: f64,
    /// Plastic work [J].
    pub(super) plastic_work: f64,
    /// Largest deflection of the inner edge of the plate [m].
    pub(super) largest_deflection: f64,
}

impl Dishing {
    /// Everything that a step changes.
    pub(super) fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        archive.item(&mut self.circles)?;
        archive.item(&mut self.rings)?;
        archive.item(&mut self.edge_held)?;
        archive.item(&mut self.support_impulse)?;
        archive.item(&mut self.plastic_work)?;
        archive.item(&mut self.largest_deflection)
    }

    pub(super) fn new(
        material: &Material,
        thickness: f64,
        temperature: f64,
        plug_radius: f64,
        edge: PlateEdge,
        failure: Failure,
        options: &ChainOptions,
    ) -> Self {
        let mut outer = Self::around_boss(
            material,
            thickness,
            temperature,
            plug_radius,
            edge,
            failure,
            options,
        );
        let mut widths = widths(plug_radius, thickness);
        widths.reverse();
        let (mut circles, mut rings) = rings(&outer.section, 0.0, &widths);
        outer.plug = circles.len();
        circles.append(&mut outer.circles);
        rings.append(&mut outer.rings);
        Self {
            circles,
            rings,
            ..outer
        }
    }

    /// The plate around a boss that does not deform.
    fn around_boss(
        material: &Material,
        thickness: f64,
        temperature: f64,
        radius: f64,
        edge: PlateEdge,
        failure: Failure,
        options: &ChainOptions,
    ) -> Self {
        let section = PlateSection::new(material, thickness, temperature, failure, options);
        let widths = widths(0.5 * edge.diameter - radius, thickness);
        let (circles, rings) = rings(&section, radius, &widths);
        Self {
            section,
            circles,
            rings,
            moved: Vec::new(),
            flowing: Vec::new(),
            plug: 0,
            support: edge.support,
            edge_held: true,
            support_impulse: 0.0,
            plastic_work: 0.0,
            largest_deflection: 0.0,
        }
    }

    /// The circle of the plug at the rim, where it deforms.
    fn rim(&self) -> Option<&Circle> {
        self.circles[..self.plug].last()
    }

    /// Number of the first ring around the plug.
    fn outer_ring(&self) -> usize {
        self.plug.saturating_sub(1)
    }

    /// Deflection of the plate at the rim of the plug, less what the plug's rim lags behind its mean motion [m].
    pub(super) fn deflection(&self) -> f64 {
        self.circles[self.plug].deflection - self.rim().map_or(0.0, |rim| rim.deflection)
    }

    /// Whether a ring beside the rim has failed, which frees the plug.
    pub(super) fn has_failed(&self) -> bool {
        let outer = self.outer_ring();
        let beside = &self.rings[outer.saturating_sub(1)..=outer];
        beside.iter().any(|ring| ring.has_failed(&self.section))
    }

    /// Speed of the plate against the plug at the rim [m/s].
    #[cfg(test)]
    pub(super) fn velocity(&self) -> f64 {
        self.circles[self.plug].velocity - self.rim().map_or(0.0, |rim| rim.velocity)
    }

    /// Mass against which the bands pull on the rim [kg].
    pub(super) fn edge_mass(&self) -> f64 {
        let inverse = self.rim().map_or(0.0, |rim| 1.0 / rim.mass);
        1.0 / (1.0 / self.circles[self.plug].mass + inverse)
    }

    /// Longest stable time step [s].
    pub(super) fn stable_step(&self) -> f64 {
        let step = |ring: &Ring| self.section.stable_step(ring.width, ring.radius);
        let steps = self.rings[..=self.outer_ring()].iter().map(step);
        steps.fold(f64::INFINITY, f64::min)
    }

    /// Changes the velocities by a kick under a force of the bands on the rim [N].
    pub(super) fn kick(&mut self, edge_force: f64, kick: f64) {
        for circle in &mut self.circles {
            circle.force = 0.0;
            circle.moment = 0.0;
        }
        let outer = self.outer_ring();
        for (i, ring) in self.rings.iter().enumerate() {
            // No ring lies between the two circles at the rim.
            let first = i + usize::from(self.plug > 0 && i >= outer);
            let (force, moments) = ring.loads();
            self.circles[first].force += force;
            self.circles[first + 1].force -= force;
            self.circles[first].moment += moments[0];
            self.circles[first + 1].moment += moments[1];
        }
        self.circles[self.plug].force += edge_force;
        let last = self.circles.len() - 1;
        self.support_impulse += self.circles[last].force * kick;
        let (plug, plate) = self.circles.split_at_mut(self.plug);
        let mut back = 0.0;
        if let Some(rim) = plug.last_mut() {
            rim.force -= edge_force;
            // The mean motion is the chain's.
            back = -edge_force / plug.iter().map(|circle| circle.mass).sum::<f64>();
        }
        for circle in &mut *plug {
            circle.velocity += (circle.force / circle.mass - back) * kick;
        }
        let support = plate.len() - 1;
        for circle in &mut plate[..support] {
            circle.velocity += circle.force * kick / circle.mass;
        }
        if self.edge_held {
            match plug.last_mut() {
                Some(rim) => turn_as_one(rim, &mut plate[0]),
                None => plate[0].moment = 0.0,
            }
        }
        // On the axis nothing turns.
        let inner = plug.iter_mut().skip(1);
        let turning = match self.support {
            EdgeSupport::SimplySupported => &mut plate[..],
            EdgeSupport::Clamped => &mut plate[..support],
        };
        for circle in inner.chain(turning) {
            circle.spin += circle.moment * kick / circle.inertia;
        }
    }

    /// Moves the circles over a time step and updates every ring.
    pub(super) fn drift(&mut self, time_step: f64) {
        for circle in &mut self.circles {
            circle.deflection += circle.velocity * time_step;
            circle.rotation += circle.spin * time_step;
        }
        let edge = self.circles[self.plug].deflection;
        self.largest_deflection = self.largest_deflection.max(edge);
        let between = self.circles.windows(2).enumerate();
        let pairs = between.filter(|(i, _)| i + 1 != self.plug);
        self.moved.clear();
        self.flowing.clear();
        for (i, (ring, (_, pair))) in self.rings.iter_mut().zip(pairs).enumerate() {
            let bent = pair.iter().any(|c| c.velocity != 0.0 || c.spin != 0.0);
            if bent || !ring.is_settled() {
                let deflections = [pair[0].deflection, pair[1].deflection];
                let rotations = [pair[0].rotation, pair[1].rotation];
                self.moved.push(i);
                if ring.deform(&self.section, deflections, rotations) {
                    self.flowing.push(i);
                }
            }
        }
        self.flow(time_step);
        for i in &self.moved {
            self.plastic_work += self.rings[*i].plastic_work();
        }
    }

    /// Returns what is beyond the yield surface, eight rings at a time.
    fn flow(&mut self, time_step: f64) {
        for some in self.flowing.chunks(LANES) {
            let mut rings = FlowingRings::default();
            for lane in 0..LANES {
                // Lanes that are left over have numbers of a ring, too.
                self.rings[*some.get(lane).unwrap_or(&some[0])].join(&mut rings, lane);
                rings.present[lane] = f64::from(u8::from(lane < some.len()));
            }
            rings.find_multipliers(&self.section, time_step);
            for (lane, i) in some.iter().enumerate() {
                self.rings[*i].flow(&self.section, rings.multiplier[lane], time_step);
            }
        }
    }

    pub(super) fn momentum(&self) -> f64 {
        self.circles[self.plug..]
            .iter()
            .map(|c| c.mass * c.velocity)
            .sum()
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

/// Gives two circles the moment over inertia that they have together.
fn turn_as_one(one: &mut Circle, other: &mut Circle) {
    let moment = one.moment + other.moment;
    let inertia = one.inertia + other.inertia;
    for circle in [one, other] {
        circle.moment = moment * circle.inertia / inertia;
    }
}

#[cfg(test)]
#[path = "dishing_tests.rs"]
mod tests;
