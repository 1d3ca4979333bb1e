//! A step of a rod in blocks of eight lanes, and what limits the next step.

#[cfg(test)]
#[path = "block_tests.rs"]
mod tests;

use pulp::NullaryFnOnce;

use super::{
    blocks::{ahead, behind, first_lanes, sum},
    node::Node,
    respond::{Flow, Stage, Step},
    rod::{Fastest, Rod},
    slice::{Metal, Slice, axial_stress},
};
use crate::lanes::{LANES, Lanes, PerLane, lanes, larger, settled, smaller};

/// Moves a rod on; gives the plastic work between the half steps around the current time [J], or the first slice that was crushed.
pub(super) struct Drift<'a> {
    pub(super) rod: &'a mut Rod,
    pub(super) time_step: f64,
}

impl NullaryFnOnce for Drift<'_> {
    type Output = Result<f64, usize>;

    #[inline(always)]
    fn call(self) -> Result<f64, usize> {
        let Self { rod, time_step } = self;
        rod.nodes.drift(time_step);
        let count = rod.slices.len();
        let step = Step {
            metal: &rod.metal,
            size: &rod.size,
            depends_on_pressure: rod.metal.strength.depends_on_pressure(),
            time_step,
        };
        let nodes = rod.nodes.blocks();
        rod.stages.resize(nodes.len(), Stage::default());
        // One loop for each stage: the chains of dependent operations are shorter, so that a processor works on several blocks at a time.
        // In memory: what a loop adds to would be taken apart into single numbers.
        let mut least = Lanes::all(f64::INFINITY);
        let (least, mut flows) = (settled(&mut least), false);
        for (b, (slices, stage)) in rod.slices.each_mut().zip(&mut rod.stages).enumerate() {
            let ends = Ends::of(nodes, b);
            let present = first_lanes(count.saturating_sub(b * LANES));
            let sizes = step.resize(slices, stage, &ends, present);
            let before = *least;
            *least = lanes(|l| smaller(sizes[l], before[l]));
            step.strain(slices, stage, present);
            flows |= stage.flows;
        }
        if least.iter().any(|size| *size <= 0.0) {
            let is_crushed = |slice: Slice| slice.length <= 0.0 || slice.radius <= 0.0;
            return Err(rod.slices.iter().position(is_crushed).unwrap_or(0));
        }
        if flows {
            let flow = Flow {
                step: &step,
                slices: &mut rod.slices,
                stages: &mut rod.stages,
            };
            flow.by_law();
        }
        let (mut work, mut limits) = (Lanes::all(0.0), Limits::default());
        let (work, limits) = (settled(&mut work), settled(&mut limits));
        for (b, (slices, stage)) in rod.slices.each_mut().zip(&rod.stages).enumerate() {
            add(work, &step.respond(slices, stage));
            let present = first_lanes(count.saturating_sub(b * LANES));
            let ends = Ends::of(nodes, b);
            limits.follow(step.metal, slices, &stage.inverse, &ends, present);
        }
        rod.fastest = Some(limits.fastest());
        let shears = rod.shears.each_mut();
        step.shear(rod.slices.blocks(), shears, count, work);
        Ok(sum(work))
    }
}

/// Looks at what limits the next step of a rod.
pub(super) struct Look<'a>(pub(super) &'a Rod);

impl NullaryFnOnce for Look<'_> {
    type Output = Fastest;

    #[inline(always)]
    fn call(self) -> Fastest {
        let rod = self.0;
        let mut limits = Limits::default();
        let limits = settled(&mut limits);
        for (b, slices) in rod.slices.each().enumerate() {
            let present = first_lanes(rod.slices.len().saturating_sub(b * LANES));
            let ends = Ends::of(rod.nodes.blocks(), b);
            limits.follow(&rod.metal, slices, &Inverse::of(slices), &ends, present);
        }
        limits.fastest()
    }
}

/// New velocities of all nodes but the tip, and of the widening of the slices.
pub(super) struct Kick<'a> {
    pub(super) rod: &'a mut Rod,
    pub(super) kick: f64,
}

impl NullaryFnOnce for Kick<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { rod, kick } = self;
        let tip = rod.nodes.last();
        rod.nodes.kick(kick);
        if let Some(tip) = tip {
            rod.nodes.set_last(tip);
        }
        widen(rod, kick);
    }
}

/// Collects the forces of the slices on the nodes and gives new velocities as [`Kick`] does, where nothing damps.
#[inline(always)]
pub(super) fn push(rod: &mut Rod, kick: f64) {
    let forces = rod.slices.each().map(|slices| slices.axial_force);
    rod.nodes.push(forces, kick, rod.slices.len());
    widen(rod, kick);
}

/// New velocities of the widening of the slices.
#[inline(always)]
fn widen(rod: &mut Rod, kick: f64) {
    let ratio = kick / rod.size.radial_mass();
    let shears = rod.shears.each().map(|shears| shears.force);
    let shears = shears.chain(std::iter::repeat(Lanes::all(0.0)));
    let mut last = 0.0;
    for (slices, ahead) in rod.slices.each_mut().zip(shears) {
        let (own, behind) = (slices.radial_force, behind(&ahead, last));
        let before = slices.radial_velocity;
        slices.radial_velocity = lanes(|l| before[l] + (own[l] - behind[l] + ahead[l]) * ratio);
        last = ahead[LANES - 1];
    }
}

/// Collects the forces of the slices on the nodes.
pub(super) struct Collect<'a>(pub(super) &'a mut Rod);

impl NullaryFnOnce for Collect<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Rod { nodes, slices, .. } = self.0;
        nodes.collect(slices.each().map(|slices| slices.axial_force));
    }
}

/// Sums up kinetic and elastic energy of a rod [J].
pub(super) struct Energies<'a>(pub(super) &'a Rod);

impl NullaryFnOnce for Energies<'_> {
    type Output = [f64; 2];

    #[inline(always)]
    fn call(self) -> [f64; 2] {
        let Rod {
            metal, size, nodes, ..
        } = self.0;
        let (slices, shears) = (&self.0.slices, &self.0.shears);
        let radial = slices.sum(|slices| lanes(|l| slices.lane(l).radial_energy(size)));
        let elastic = slices.sum(|slices| lanes(|l| slices.lane(l).elastic_energy(metal, size)));
        let sheared = shears.sum(|shears| lanes(|l| shears.lane(l).elastic_energy(metal, size)));
        [nodes.kinetic_energy() + radial, elastic + sheared]
    }
}

/// Sums up what a change of the time step comes to: forces on the degrees of freedom of a rod times the changes of their velocities in
/// the last kick [N m/s].
pub(super) struct ForcedChange<'a> {
    pub(super) rod: &'a Rod,
    pub(super) kick: f64,
}

impl NullaryFnOnce for ForcedChange<'_> {
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        let Self { rod, kick } = self;
        let ratio = kick / rod.size.radial_mass();
        let mut last = 0.0;
        let shears = rod.shears.each().map(|shears| shears.force);
        let mut shears = shears.chain(std::iter::repeat(Lanes::all(0.0)));
        let mut widening = 0.0;
        for (b, slices) in rod.slices.each().enumerate() {
            let ahead = shears.next().unwrap_or_default();
            let (own, behind) = (slices.radial_force, behind(&ahead, last));
            let present = first_lanes(rod.slices.len().saturating_sub(b * LANES));
            let squares = lanes(|l| {
                let force = own[l] - behind[l] + ahead[l];
                present[l] * force * force
            });
            widening += sum(&squares);
            last = ahead[LANES - 1];
        }
        rod.nodes.forced_change() + ratio * widening
    }
}

/// Adds numbers lane by lane.
#[inline(always)]
pub(super) fn add(total: &mut Lanes, more: &Lanes) {
    let before = *total;
    *total = lanes(|l| before[l] + more[l]);
}

/// Inverses of lengths and radii of a block of slices [1/m].
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Inverse {
    pub(super) length: Lanes,
    pub(super) radius: Lanes,
}

impl Inverse {
    #[inline(always)]
    pub(super) fn of(slices: &Slice<Lanes>) -> Self {
        let (length, radius) = (slices.length, slices.radius);
        // One division for both.
        let both = lanes(|l| 1.0 / (length[l] * radius[l]));
        Self {
            length: lanes(|l| both[l] * radius[l]),
            radius: lanes(|l| both[l] * length[l]),
        }
    }
}

/// Ends of the slices of a block.
pub(super) struct Ends<'a> {
    pub(super) back: &'a Node<Lanes>,
    pub(super) front_position: Lanes,
    front_velocity: Lanes,
}

impl<'a> Ends<'a> {
    #[inline(always)]
    fn of(nodes: &'a [Node<Lanes>], b: usize) -> Self {
        let back = &nodes[b];
        let next = nodes.get(b + 1).map(|nodes| nodes.lane(0));
        let next = next.unwrap_or(Node::INERT);
        Self {
            back,
            front_position: ahead(&back.position, next.position),
            front_velocity: ahead(&back.velocity, next.velocity),
        }
    }
}

/// What limits the next step in each lane.
#[derive(Default)]
struct Limits {
    stiffness: Lanes,
    rate: Lanes,
}

impl Limits {
    /// Looks at the slices of a block in the lanes of which there is a 1 in `present`.
    #[inline(always)]
    fn follow(
        &mut self,
        metal: &Metal,
        slices: &Slice<Lanes>,
        inverse: &Inverse,
        ends: &Ends<'_>,
        present: &Lanes,
    ) {
        let (length, radius, widening) = (inverse.length, inverse.radius, slices.radial_velocity);
        let ([_, pressure], [_, difference]) = (slices.pressure, slices.difference);
        let (back, front) = (ends.back.velocity, ends.front_velocity);
        let Self {
            stiffness: stiffest,
            rate: fastest,
        } = *self;
        self.stiffness = lanes(|l| {
            let axial_stress = axial_stress(pressure[l], difference[l]);
            let stiffness = metal.stiffness(axial_stress, [length[l], radius[l]]);
            larger(present[l] * stiffness, stiffest[l])
        });
        self.rate = lanes(|l| {
            let approach = (back[l] - front[l]).abs() * length[l];
            let rate = larger(widening[l].abs() * radius[l], approach);
            larger(present[l] * rate, fastest[l])
        });
    }

    #[inline(always)]
    fn fastest(&self) -> Fastest {
        Fastest {
            stiffness: self.stiffness.iter().copied().fold(0.0, f64::max),
            rate: self.rate.iter().copied().fold(0.0, f64::max),
        }
    }
}
