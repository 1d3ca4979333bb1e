//! The state of eight runs on meshes alike.

use std::ops::Range;

use super::{interfaces::Interface, scalars::RunScalars};
use crate::{
    chain::{
        element::{Plastic, Spring},
        flow::FlowConstants,
    },
    lanes::{LANES, Lanes},
    material::{LaneLaw, LawKind, Material, YieldPoint},
    problem::RearFaceCondition,
    scenario::{Scenario, TargetBody},
};

/// What runs must have in common to be scheduled together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Mesh {
    /// Elements of projectile and target.
    pub(super) elements: [usize; 2],
    /// What holds the back of the target.
    pub(super) back: RearFaceCondition,
    /// Equations of their strength.
    pub(super) laws: [LawKind; 2],
}

impl Mesh {
    pub(super) fn of(scenario: &Scenario) -> Self {
        let chain = &scenario.options.chain;
        let (back, target) = match &scenario.target {
            TargetBody::Layers {
                back_face, layers, ..
            } => (*back_face, layers.first().map(|plate| &plate.material)),
            _ => (RearFaceCondition::Free, None),
        };
        let kind = |material: &Material| law(material).map(|law| law.kind());
        let projectile = kind(&scenario.projectile.material);
        Self {
            laws: [projectile, target.and_then(|material| kind(material))]
                .map(|kind| kind.unwrap_or(LawKind::Hardening)),
            elements: [chain.projectile_elements(), chain.target_elements()],
            back,
        }
    }

    /// Whether a node is one of the projectile (0) or the target (1).
    pub(super) fn holds(&self, body: usize, node: usize) -> bool {
        (node > self.elements[0]) == (body == 1)
    }

    /// Elements of the projectile (0) or the target (1).
    pub(super) fn elements_of(&self, body: usize) -> Range<usize> {
        let [projectile, target] = self.elements;
        match body {
            0 => 0..projectile,
            _ => projectile..projectile + target,
        }
    }
}

/// Strength of a material if it rides in lanes, without a constraint.
pub(super) fn law(material: &Material) -> Option<LaneLaw> {
    material.strength.law().prepare(material, 1.0).in_lanes()
}

/// Stable time steps that are compared at once.
pub(super) const LIMITS_AT_ONCE: usize = 4;

/// A point mass.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Node {
    pub(super) position: Lanes,
    pub(super) velocity: Lanes,
}

/// What is known of an element in all lanes together.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Mark {
    /// Whether an update to the same length would change nothing in any lane.
    pub(super) settled: bool,
    /// Whether it flowed in the last step in any lane.
    pub(super) flowed: bool,
    /// Lanes in which it has eroded.
    pub(super) gone: u8,
}

percuss_core::per_lane! {
    /// What is the same for all of a projectile or target.
    #[derive(Debug, Clone, Copy, Default)]
    pub(super) struct Body<R = f64> {
        pub(super) flow: FlowConstants<R>,
        pub(super) compliance: R,
        pub(super) slowness: R,
        /// Volume of an element.
        pub(super) volume: R,
        /// Mass of a node, and of one at an end.
        pub(super) mass: R,
        pub(super) end_mass: R,
        /// Largest friction on a node, on the first and on the last one.
        pub(super) friction: R,
        pub(super) first_friction: R,
        pub(super) last_friction: R,
        /// Lengths at which an element erodes.
        pub(super) shortest: R,
        pub(super) longest: R,
    }
}

/// Eight runs.
#[derive(Debug)]
pub(super) struct Bundle {
    pub(super) mesh: Mesh,
    /// Of the projectile, then of the target.
    pub(super) nodes: Vec<Node>,
    pub(super) springs: Vec<Spring<Lanes>>,
    pub(super) forces: Vec<Lanes>,
    pub(super) plastics: Vec<Plastic<Lanes>>,
    pub(super) points: Vec<YieldPoint<Lanes>>,
    /// Whether a node moves in any lane.
    pub(super) moves: Vec<bool>,
    /// Masses of the nodes, and largest friction on them.
    pub(super) masses: Vec<Lanes>,
    pub(super) frictions: Vec<Lanes>,
    /// Lanes in which a interface kicks and moves a node.
    pub(super) in_contact: Vec<u8>,
    /// Nodes between the ends of a body that are not like the others, in their order.
    pub(super) irregular: Vec<usize>,
    /// What is between the pieces of eroded bodies, from tail to back.
    pub(super) interfaces: Vec<Interface>,
    /// Lanes in which projectile and target meet at other nodes than those of whole bodies.
    pub(super) displaced: u8,
    /// Tail of the projectile, and its tip with the face of the target, in every lane.
    pub(super) tails: [usize; LANES],
    pub(super) contacts: [[usize; 2]; LANES],
    /// What is known of the elements.
    pub(super) marks: Vec<Mark>,
    /// Largest stable time step of every element, and of none up to a multiple of [`LIMITS_AT_ONCE`].
    pub(super) limits: Vec<Lanes>,
    /// Those that flow or flowed in the last step, and their plastic strains in that one.
    pub(super) working: Vec<usize>,
    pub(super) steps_before: Vec<Lanes>,
    /// Where single lanes of elements flow: elements and lanes.
    pub(super) gathered: Vec<(u32, u32)>,
    pub(super) bodies: [Body<Lanes>; 2],
    /// Their strength.
    pub(super) laws: Vec<LaneLaw<Lanes>>,
    pub(super) scalars: RunScalars<Lanes>,
}

impl Bundle {
    pub(super) fn new(mesh: Mesh) -> Self {
        let elements = mesh.elements[0] + mesh.elements[1];
        let mut bundle = Self {
            mesh,
            nodes: vec![Node::default(); elements + 2],
            springs: vec![Spring::default(); elements],
            forces: vec![Lanes::default(); elements],
            plastics: vec![Plastic::default(); elements],
            points: vec![YieldPoint::default(); elements],
            moves: vec![false; elements + 2],
            masses: vec![Lanes::default(); elements + 2],
            frictions: vec![Lanes::default(); elements + 2],
            in_contact: vec![0; elements + 2],
            irregular: Vec::new(),
            interfaces: Vec::new(),
            displaced: 0,
            tails: [0; LANES],
            contacts: [[0, 1].map(|side| mesh.elements[0] + side); LANES],
            marks: vec![Mark::default(); elements],
            limits: vec![Lanes::all(f64::INFINITY); elements.next_multiple_of(LIMITS_AT_ONCE)],
            working: vec![0; elements],
            steps_before: vec![Lanes::default(); elements],
            gathered: vec![(0, 0); (elements + 1) * LANES],
            bodies: [Body::default(); 2],
            laws: mesh.laws.map(LaneLaw::of_kind).to_vec(),
            scalars: RunScalars::default(),
        };
        for lane in 0..LANES {
            bundle.clear_lane(lane);
        }
        bundle
    }
}
