//! State of the chain: nodes joined by elements, in segments that touch, part or meet again.
//!
//! Position is measured from the struck face, positive into the target; force and stress are positive in compression.
//! Every segment has one node more than it has elements, so element `e` joins the nodes `e + shift` and `e + shift + 1`, where the
//! shift of the first segment is 0 and grows by one at every place where ends meet.

use serde::{Deserialize, Serialize};

use super::{
    dishing::Dishing,
    drift::WorkingBlock,
    element::{Plastic, Spring},
    interface::Interface,
    pair::KickSums,
    part::{Role, Section},
    penetration::Penetration,
    plug::PlugConstraint,
    shear_band::Bands,
    tate::Tip,
};
use crate::{
    Error,
    lanes::{Blocks, Lanes, PerLane, Real},
    ledger::{EnergyLedger, MomentumLedger},
    material::YieldPoint,
    solver::archive::Archive,
};

/// What holds the last node of the chain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum BoundaryCondition {
    Free,
    Fixed,
    /// Boundary that takes up a wave without reflecting it: a dashpot \[lysmer1969\], and behind a cone a spring beside it
    /// \[wolf1994\].
    Open {
        /// [N s/m].
        impedance: f64,
        /// Stiffness of the endless cone beyond the last node [N/m]; 0 behind a column.
        stiffness: f64,
    },
}

/// A run of nodes joined by elements of one part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Segment {
    pub(super) part: usize,
    pub(super) first_node: usize,
    pub(super) last_node: usize,
    /// Number of its first node less that of its first element.
    pub(super) shift: usize,
}

impl Segment {
    pub(super) fn elements(self) -> std::ops::Range<usize> {
        self.first_node - self.shift..self.last_node - self.shift
    }
}

percuss_core::number_lists! {
    /// A point mass.
    pub(in crate::chain) Node,
    /// All of them, from the projectile's tail to the target's back.
    Nodes {
        /// [m].
        position,
        /// [m/s].
        velocity,
        /// Velocity at the start of the current kick [m/s].
        velocity_before,
        /// [kg].
        mass,
        /// Force of the elements, viscosity included [N].
        force,
        /// Force of the elements without viscosity [N].
        spring_force,
        /// Force of local damping in this step, part of `force` [N].
        damping,
        /// Largest friction force [N]: none from a gap on, where it has left its layer.
        friction,
    }
}

impl Nodes {
    pub(super) fn len(&self) -> usize {
        self.position.len()
    }
}

percuss_core::per_lane! {
    /// A normal spring with its constitutive state.
    #[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
    pub(super) struct Element<R: Real = f64> {
        pub(super) rest_length: R,
        /// Area at rest [m2].
        pub(super) rest_area: R,
        /// [m3]; plastic flow does not change it.
        pub(super) volume: R,
        pub(super) spring: Spring<R>,
        /// [N].
        pub(super) axial_force: R,
        pub(super) plastic: Plastic<R>,
        /// What it gives to the masses of its two nodes [kg].
        pub(super) end_masses: [R; 2],
        pub(super) length: R,
        pub(super) strain: R,
        pub(super) viscous_force: R,
        pub(super) yield_point: YieldPoint<R>,
        /// Initial position of its middle.
        pub(super) initial_position: R,
        pub(super) eroded: R::Flag,
        /// Damage by the failure law; 1 is failed.
        pub(super) damage: R,
        /// Whether its failure has parted it from a neighbour.
        pub(super) parted: R::Flag,
        /// Length of target that the tip has penetrated [m], and its part in the last step.
        pub(super) advance: R,
        pub(super) advance_step: R,
    }
}

/// A place where a body or a bonded interface has parted.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Parting {
    /// Initial position, struck face at 0 [m].
    pub(super) position: f64,
    /// [s].
    pub(super) time: f64,
}

percuss_core::per_lane! {
    /// Work and impulse that have gone where the state itself does not show them.
    #[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
    pub(super) struct Accumulators<R = f64> {
        pub(super) initial_energy: R,
        pub(super) initial_momentum: R,
        pub(super) plastic: [R; 2],
        pub(super) kicks: KickSums<R>,
        pub(super) viscous_work: R,
        pub(super) boundary_work: R,
        pub(super) eroded_energy: R,
        pub(super) fracture_work: R,
        pub(super) support_impulse: R,
        pub(super) eroded_momentum: R,
        pub(super) damping_impulse: R,
    }
}

percuss_core::per_lane! {
    /// Energy and momentum of projectile or target.
    #[derive(Debug, Clone, Copy, Default)]
    pub(super) struct BodySums<R = f64> {
        pub(super) kinetic: R,
        pub(super) elastic: R,
        pub(super) momentum: R,
    }
}

impl<R: Real> BodySums<R> {
    #[inline(always)]
    pub(super) fn add_node(&mut self, mass: &R, velocity: &R) {
        let before = *self;
        for l in 0..R::LANES {
            let (mass, velocity) = (mass.lane(l), velocity.lane(l));
            let mut one = before.lane(l);
            one.kinetic += 0.5 * mass * velocity * velocity;
            one.momentum += mass * velocity;
            self.set_lane(l, one);
        }
    }

    #[inline(always)]
    pub(super) fn add_spring(&mut self, spring: &Spring<R>, volume: &R, modulus: &R) {
        let mut sum = self.elastic;
        for l in 0..R::LANES {
            let energy = (spring.lane(l)).elastic_energy(volume.lane(l), modulus.lane(l));
            sum.set_lane(l, sum.lane(l) + energy);
        }
        self.elastic = sum;
    }
}

/// Nodes, elements and accumulated work at one time. Node velocities stand half a step behind the positions.
#[derive(Debug)]
pub(super) struct State {
    pub(super) parts: Vec<Section>,
    /// From the projectile's tail to the target's back.
    pub(super) segments: Vec<Segment>,
    /// `interfaces[s]`: what is between segments `s` and `s + 1`.
    pub(super) interfaces: Vec<Interface>,
    pub(super) end: BoundaryCondition,
    /// Force of a constant-pressure target on the projectile's tip [N]; 0 with any other target.
    pub(super) tip_friction: f64,
    /// What moves with the tip under the erosion closure of Tate.
    pub(super) tip: Option<Tip>,
    /// What the tip has to overcome to penetrate a cone.
    pub(super) penetration: Option<Penetration>,
    /// What holds a plug, in the place of friction.
    pub(super) hold: Option<PlugConstraint>,
    /// Force of the target that is turned aside on the tip [N].
    pub(super) drag: f64,
    /// Initial position of the last node [m].
    pub(super) back_position: f64,

    /// Depths between which there is nothing around the target before the impact [m].
    pub(super) gaps: Vec<[f64; 2]>,

    pub(super) nodes: Nodes,
    /// All elements, eroded ones too.
    pub(super) elements: Blocks<Element<Lanes>>,

    /// Blocks with elements that flow in a step or flowed in the one before: kept for its memory.
    pub(super) working: Vec<WorkingBlock>,

    pub(super) time: f64,
    pub(super) step: u64,
    pub(super) time_step: f64,
    /// Largest stable time step of the current state.
    pub(super) stable_step: f64,
    /// Places where bodies and bonded interfaces have parted, in the order of time.
    pub(super) partings: Vec<Parting>,
    /// How often two ends have met.
    pub(super) meetings: u64,
    pub(super) contact_force: f64,
    pub(super) back_force: f64,
    pub(super) accumulated: Accumulators,
}

impl State {
    /// Everything that a step changes; the parts and the end are those of the case.
    pub(super) fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        archive.item(&mut self.segments)?;
        archive.item(&mut self.interfaces)?;
        archive.item(&mut self.tip_friction)?;
        archive.item(&mut self.tip)?;
        archive.item(&mut self.penetration)?;
        if let Some(hold) = &mut self.hold {
            hold.archive(archive)?;
        }
        archive.item(&mut self.drag)?;
        archive.item(&mut self.nodes)?;
        archive.item(&mut self.elements)?;
        archive.item(&mut self.time)?;
        archive.item(&mut self.step)?;
        archive.item(&mut self.time_step)?;
        archive.item(&mut self.stable_step)?;
        archive.item(&mut self.partings)?;
        archive.item(&mut self.meetings)?;
        archive.item(&mut self.contact_force)?;
        archive.item(&mut self.back_force)?;
        archive.item(&mut self.accumulated)
    }

    /// Section and node range of the projectile's frontmost segment; `None` when all of it has eroded.
    pub(super) fn tip_segment(&self) -> Option<usize> {
        self.segments
            .iter()
            .rposition(|segment| self.parts[segment.part].role == Role::Projectile)
    }

    /// The target's first segment that still has material.
    pub(super) fn face_segment(&self) -> Option<usize> {
        self.segments.iter().position(|segment| {
            self.parts[segment.part].role == Role::Target && !segment.elements().is_empty()
        })
    }

    /// Mass and momentum of the projectile.
    pub(super) fn projectile_motion(&self) -> (f64, f64) {
        let mut sums = (0.0, 0.0);
        for segment in &self.segments {
            if self.parts[segment.part].role == Role::Projectile {
                for i in segment.first_node..=segment.last_node {
                    let mass = self.nodes.mass[i] - self.tip_mass_on(i);
                    sums.0 += mass;
                    sums.1 += mass * self.nodes.velocity[i];
                }
            }
        }
        sums
    }

    /// Depth of the crater floor below the original face [m]; of the projectile's tip where there is no target to crater.
    ///
    /// A non-reflecting end has no static stiffness: the column that it holds drifts as a whole, and that drift is no crater.
    pub(super) fn depth(&self) -> f64 {
        match (self.face_segment(), self.tip_segment(), self.end) {
            (Some(face), _, BoundaryCondition::Open { stiffness: 0.0, .. }) => {
                let back = self.nodes.position[self.nodes.len() - 1] - self.back_position;
                self.nodes.position[self.segments[face].first_node] - back
            }
            (Some(face), ..) => self.nodes.position[self.segments[face].first_node],
            (None, Some(tip), _) if self.tip_friction > 0.0 => {
                self.nodes.position[self.segments[tip].last_node]
            }
            _ => 0.0,
        }
    }

    /// Mean velocity of a segment [m/s]; 0 for a wall.
    pub(super) fn mean_velocity(&self, segment: Segment) -> f64 {
        let (mut mass, mut momentum) = (0.0, 0.0);
        for i in segment.first_node..=segment.last_node {
            mass += self.nodes.mass[i];
            momentum += self.nodes.mass[i] * self.nodes.velocity[i];
        }
        if mass > 0.0 { momentum / mass } else { 0.0 }
    }

    /// Elastic energy of an element between two steps.
    pub(super) fn elastic_energy(&self, element: usize, part: &Section) -> f64 {
        let spring = self.elements.part(element, |block| &block.spring);
        let volume = self.elements.part(element, |block| &block.volume);
        spring.elastic_energy(volume, part.modulus)
    }

    /// Energy and momentum of projectile and target.
    fn sums(&self) -> [BodySums; 2] {
        let mut sums = [BodySums::default(); 2];
        for segment in &self.segments {
            let part = &self.parts[segment.part];
            let sums = &mut sums[part.role as usize];
            for i in segment.first_node..=segment.last_node {
                sums.add_node(&self.nodes.mass[i], &self.nodes.velocity[i]);
            }
            for e in segment.elements() {
                let spring = self.elements.part(e, |block| &block.spring);
                let volume = self.elements.part(e, |block| &block.volume);
                sums.add_spring(&spring, &volume, &part.modulus);
            }
        }
        sums
    }

    pub(super) fn energy(&self) -> EnergyLedger {
        self.energy_of(&self.sums())
    }

    /// The energy balance of a state with these energies of projectile and target.
    pub(super) fn energy_of(&self, [projectile, target]: &[BodySums; 2]) -> EnergyLedger {
        let accumulated = &self.accumulated;
        let bands = self.hold.as_ref().map(|hold| &hold.bands);
        let plate = self.hold.as_ref().and_then(|hold| hold.plate.as_ref());
        let mut energy = EnergyLedger::default();
        energy.initial = accumulated.initial_energy;
        energy.kinetic_projectile = projectile.kinetic;
        energy.kinetic_target = target.kinetic;
        energy.elastic_projectile = projectile.elastic;
        energy.elastic_target = target.elastic + bands.map_or(0.0, Bands::elastic_energy);
        energy.plastic_projectile = accumulated.plastic[0];
        energy.plastic_target = accumulated.plastic[1];
        energy.border_shear =
            accumulated.kicks.friction.work + bands.map_or(0.0, |bands| bands.accumulated.work);
        energy.viscous = accumulated.viscous_work;
        energy.contact = accumulated.kicks.contact_loss;
        energy.boundary = accumulated.boundary_work;
        energy.eroded = accumulated.eroded_energy;
        energy.fracture = accumulated.fracture_work;
        energy.transfer = 0.0;
        energy.kinetic_plate = plate.map_or(0.0, Dishing::kinetic_energy);
        energy.elastic_plate = plate.map_or(0.0, Dishing::elastic_energy);
        energy.plastic_plate = plate.map_or(0.0, |plate| plate.plastic_work);
        energy
    }

    pub(super) fn momentum(&self) -> MomentumLedger {
        self.momentum_of(&self.sums())
    }

    /// The momentum balance of a state with these momenta of projectile and target.
    pub(super) fn momentum_of(&self, [projectile, target]: &[BodySums; 2]) -> MomentumLedger {
        let accumulated = &self.accumulated;
        let plate = self.hold.as_ref().and_then(|hold| hold.plate.as_ref());
        // A plate that does not move hands the impulse of the bands on; one that does keeps what its support does not take.
        let held_still = match (&self.hold, plate) {
            (Some(hold), None) => hold.bands.accumulated.impulse,
            _ => 0.0,
        };
        let mut new_momentum = MomentumLedger::default();
        new_momentum.initial = accumulated.initial_momentum;
        new_momentum.projectile = projectile.momentum;
        new_momentum.target = target.momentum;
        new_momentum.support =
            accumulated.support_impulse + plate.map_or(0.0, |plate| plate.support_impulse);
        new_momentum.border_shear = accumulated.kicks.friction.impulse + held_still;
        new_momentum.eroded = accumulated.eroded_momentum;
        new_momentum.plate = plate.map_or(0.0, Dishing::momentum);
        new_momentum.damping = accumulated.damping_impulse;
        new_momentum
    }
}
