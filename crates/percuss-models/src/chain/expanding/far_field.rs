//! The target away from the crater: an elastic cone that is as stiff as a half-space under the projectile.

use pulp::{Arch, NullaryFnOnce};
use serde::{Deserialize, Serialize};

use super::{
    blocks::{Blocks, ahead},
    node::{Dashpot, Node, Nodes},
};
use crate::{
    Error,
    chain::{
        cone::{Cone, Grading},
        solver::{OpenEnd, StepControl},
    },
    lanes::{Lanes, lanes},
    solver::archive::Archive,
};

/// From the crater floor to the rear face; positions are displacements in waves that leave the crater. What is behind takes those waves
/// up as the cone beyond would: [`RearFace`](super::rear_face::RearFace) sends them back.
#[derive(Debug)]
pub(super) struct FarField {
    pub(super) nodes: Nodes,
    springs: Blocks<Spring<Lanes>>,
    arch: Arch,
    /// Of the cone beyond the last node: impedance [kg/s] and static stiffness [N/m].
    beyond: [f64; 2],
    /// Inverse of its wave speed [s/m].
    pub(super) slowness: f64,
    /// It stays elastic, so it stays as cold as it is [K].
    pub(super) temperature: f64,
    /// What has left through the last node: force [N], impulse [N s] and work [J].
    pub(super) passing_force: f64,
    pub(super) passed_impulse: f64,
    pub(super) passed_work: f64,
}

percuss_core::per_lane! {
    /// A spring between two nodes, or one in every lane.
    #[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
    struct Spring<R = f64> {
        stiffness: R,
        /// Inverse of the stiffness [m/N].
        compliance: R,
        /// Over one of these the strain is 1 [m].
        length: R,
        /// Initial position of its middle [m].
        middle: R,
        /// Area [m2].
        area: R,
        /// Now and a step before [N].
        force: [R; 2],
    }
}

/// A spring as histories show it.
#[derive(Debug)]
pub(super) struct Strained {
    pub(super) middle: f64,
    pub(super) displacement: f64,
    pub(super) velocity: f64,
    pub(super) length: f64,
    pub(super) strain: f64,
    pub(super) stress: f64,
    pub(super) area: f64,
    modulus: f64,
}

impl Strained {
    /// Adds the displacement [m], the strain and the velocity [m/s] of other waves.
    pub(super) fn superpose(&mut self, [displacement, strain, velocity]: [f64; 3]) {
        self.displacement += displacement;
        self.velocity += velocity;
        self.strain += strain;
        self.stress += self.modulus * strain;
    }
}

impl FarField {
    /// Everything that a step changes.
    pub(super) fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        self.nodes.archive(archive)?;
        self.springs.archive(archive)?;
        archive.item(&mut self.passing_force)?;
        archive.item(&mut self.passed_impulse)?;
        archive.item(&mut self.passed_work)
    }

    pub(super) fn new(
        cone: Cone,
        grading: Grading,
        thickness: f64,
        count: usize,
        [density, modulus, temperature]: [f64; 3],
        beyond: [f64; 2],
    ) -> Self {
        let depths = grading.nodes(0.0, thickness, count);
        let mut masses = vec![0.0; count + 1];
        let mut springs = Vec::with_capacity(count);
        for (i, pair) in depths.windows(2).enumerate() {
            let volumes = cone.volumes_between(pair[0], pair[1]);
            masses[i] += density * volumes[0];
            masses[i + 1] += density * volumes[1];
            let area = cone.area_between(pair[0], pair[1]);
            let stiffness = modulus * area / (pair[1] - pair[0]);
            springs.push(Spring {
                stiffness,
                compliance: 1.0 / stiffness,
                length: pair[1] - pair[0],
                middle: 0.5 * (pair[0] + pair[1]),
                area,
                force: [0.0; 2],
            });
        }
        Self {
            nodes: Blocks::new(
                masses.into_iter().map(|mass| Node::new(mass, 0.0, 0.0)),
                Node::INERT,
            ),
            springs: Blocks::new(springs, Spring::default()),
            arch: Arch::new(),
            beyond,
            slowness: (density / modulus).sqrt(),
            temperature,
            passing_force: 0.0,
            passed_impulse: 0.0,
            passed_work: 0.0,
        }
    }

    /// The first node: the mouth of the cone, which carries the crater floor.
    #[inline(always)]
    pub(super) fn mouth(&self) -> Node {
        self.nodes.get(0)
    }

    /// Forces of the springs on the nodes.
    pub(super) fn collect(&mut self) {
        self.arch.dispatch(Collect(self));
    }

    /// Adds damping; `pushed` is the force from outside on the first node [N].
    pub(super) fn damp(&mut self, control: &StepControl, pushed: f64) {
        for (i, spring) in self.springs.iter().enumerate() {
            let dashpot = Dashpot {
                slowness: self.slowness,
                impedance: spring.stiffness * spring.length * self.slowness,
            };
            self.nodes.damp(i, &dashpot, control);
        }
        self.nodes.change(|i, node| {
            let outside = if i == 0 { pushed } else { 0.0 };
            let accelerating = node.whole_force() + outside;
            node.damp_locally(control.local_damping, accelerating);
        });
    }

    /// New velocities of all but the first node.
    pub(super) fn kick(&mut self, kick: f64) {
        self.arch.dispatch(Kick {
            far_field: self,
            kick,
        });
    }

    pub(super) fn drift(&mut self, time_step: f64) {
        self.arch.dispatch(Drift {
            far_field: self,
            time_step,
        });
    }

    pub(super) fn momentum(&self) -> f64 {
        self.nodes.momentum()
    }

    /// Forces times the changes of velocities in the last kick [N m/s].
    pub(super) fn forced_change(&self) -> f64 {
        self.arch.dispatch(ForcedChange(&self.nodes))
    }

    /// Kinetic and elastic energy [J].
    pub(super) fn energies(&self) -> [f64; 2] {
        self.arch.dispatch(Energies(self))
    }

    pub(super) fn strained(&self) -> impl Iterator<Item = Strained> + '_ {
        let ends = self.nodes.iter().zip(self.nodes.iter().skip(1));
        self.springs
            .iter()
            .zip(ends)
            .map(|(spring, (near, far))| Strained {
                middle: spring.middle,
                displacement: 0.5 * (near.position + far.position),
                velocity: 0.5 * (near.velocity + far.velocity),
                length: spring.length,
                strain: (near.position - far.position) / spring.length,
                stress: spring.force[1] / spring.area,
                area: spring.area,
                modulus: spring.stiffness * spring.length / spring.area,
            })
    }
}

/// Collects the forces of the springs on the nodes.
struct Collect<'a>(&'a mut FarField);

impl NullaryFnOnce for Collect<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let FarField { nodes, springs, .. } = self.0;
        nodes.collect(springs.each().map(|springs| springs.force[1]));
    }
}

/// New velocities of all but the first node.
struct Kick<'a> {
    far_field: &'a mut FarField,
    kick: f64,
}

impl NullaryFnOnce for Kick<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { far_field, kick } = self;
        let nodes = &mut far_field.nodes;
        let (mouth, last) = (nodes.get(0), nodes.last());
        nodes.kick(kick);
        nodes.set(0, mouth);
        if let Some(last) = last {
            kick_end(far_field, last, kick);
        }
    }
}

/// Collects the forces of the springs on the nodes and gives new velocities as [`Kick`] does, where nothing damps.
#[inline(always)]
pub(super) fn push(far_field: &mut FarField, kick: f64) {
    let FarField { nodes, springs, .. } = far_field;
    let before = nodes.last();
    nodes.push(springs.each().map(|springs| springs.force[1]), kick, 0);
    if let (Some(before), Some(mut last)) = (before, nodes.last()) {
        last.return_to(before);
        kick_end(far_field, last, kick);
    }
}

/// New velocity of the last node, which has not been kicked.
#[inline(always)]
fn kick_end(far_field: &mut FarField, mut last: Node, kick: f64) {
    let [impedance, stiffness] = far_field.beyond;
    let end = OpenEnd {
        impedance,
        spring: stiffness * last.position,
    };
    let [after, mean, force] = end.kick(last.mass(), last.velocity, last.whole_force(), kick);
    last.velocity = after;
    far_field.nodes.set_last(last);
    far_field.passing_force = force;
    far_field.passed_impulse += force * kick;
    far_field.passed_work += force * mean * kick;
}

/// Moves the nodes on, to new forces of the springs.
pub(super) struct Drift<'a> {
    pub(super) far_field: &'a mut FarField,
    pub(super) time_step: f64,
}

impl NullaryFnOnce for Drift<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let FarField { nodes, springs, .. } = self.far_field;
        nodes.drift(self.time_step);
        let nodes = nodes.blocks();
        for (b, springs) in springs.each_mut().enumerate() {
            let near = nodes[b].position;
            let next = nodes.get(b + 1).map_or(0.0, |nodes| nodes.position[0]);
            let far = ahead(&near, next);
            let (stiffness, before) = (springs.stiffness, springs.force[1]);
            let force = lanes(|l| stiffness[l] * (near[l] - far[l]));
            springs.force = [before, force];
        }
    }
}

/// Sums up forces times changes of velocities.
struct ForcedChange<'a>(&'a Nodes);

impl NullaryFnOnce for ForcedChange<'_> {
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        self.0.forced_change()
    }
}

/// Sums up kinetic and elastic energy [J].
struct Energies<'a>(&'a FarField);

impl NullaryFnOnce for Energies<'_> {
    type Output = [f64; 2];

    #[inline(always)]
    fn call(self) -> [f64; 2] {
        let FarField { nodes, springs, .. } = self.0;
        let elastic = springs.sum(|springs| {
            let ([before, now], compliance) = (springs.force, springs.compliance);
            lanes(|l| 0.5 * before[l] * now[l] * compliance[l])
        });
        [nodes.kinetic_energy(), elastic]
    }
}
