//! The state of eight shots on meshes alike.

use std::ops::Range;

use super::{interfaces::Interface, scalars::LaneScalars};
use crate::{
    lanes::{LANES, Lanes},
    problem::RearFaceCondition,
    scenario::{Scenario, TargetBody},
};

/// What shots must have in common to scheduler together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Mesh {
    /// Elements of projectile and target.
    pub(super) elements: [usize; 2],
    pub(super) back: Back,
}

/// What holds the back of the target.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Back {
    Free,
    Fixed,
    Open,
}

impl Mesh {
    pub(super) fn of(scenario: &Scenario) -> Self {
        let chain = &scenario.options.chain;
        let back = match &scenario.target {
            TargetBody::Layers { back_face, .. } => match back_face {
                RearFaceCondition::Free => Back::Free,
                RearFaceCondition::Fixed => Back::Fixed,
                RearFaceCondition::NonReflecting => Back::Open,
            },
            _ => Back::Free,
        };
        Self {
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

/// Stable time steps that are compared at once.
pub(super) const LIMITS_AT_ONCE: usize = 4;

/// A point mass.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Node {
    pub(super) position: Lanes,
    pub(super) velocity: Lanes,
}

/// What every step needs of an element.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Spring {
    pub(super) unloaded_length: Lanes,
    pub(super) yield_stress: Lanes,
    pub(super) force: Lanes,
    /// Stress after the last step and after the one before it, in turn.
    pub(super) stress: [Lanes; 2],
}

/// What only flow needs and changes.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Flow {
    /// Plastic strain of the last step and of the one before it.
    pub(super) plastic_step: Lanes,
    pub(super) step_before: Lanes,
    pub(super) plastic_strain: Lanes,
    pub(super) plastic_axial: Lanes,
    pub(super) strain_slope: Lanes,
    pub(super) temperature: Lanes,
    pub(super) largest_rate: Lanes,
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

/// What is the same for all of a projectile or target.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Body {
    pub(super) modulus: Lanes,
    pub(super) compliance: Lanes,
    pub(super) slowness: Lanes,
    /// Volume of an element.
    pub(super) volume: Lanes,
    /// Mass of a node, and of one at an end.
    pub(super) mass: Lanes,
    pub(super) end_mass: Lanes,
    /// Largest friction on a node, on the first and on the last one.
    pub(super) friction: Lanes,
    pub(super) first_friction: Lanes,
    pub(super) last_friction: Lanes,
    pub(super) heating: Lanes,
    pub(super) coefficient: Lanes,
    pub(super) exponent: Lanes,
    pub(super) first_strain: Lanes,
    /// Lengths at which an element erodes.
    pub(super) shortest: Lanes,
    pub(super) longest: Lanes,
}

/// What the response of an element needs of its body.
#[derive(Clone, Copy)]
pub(super) struct Elastic {
    pub(super) modulus: Lanes,
    pub(super) compliance: Lanes,
    pub(super) slowness: Lanes,
    pub(super) volume: Lanes,
    pub(super) shortest: Lanes,
    pub(super) longest: Lanes,
}

impl Body {
    #[inline(always)]
    pub(super) fn elastic(&self) -> Elastic {
        Elastic {
            modulus: self.modulus,
            compliance: self.compliance,
            slowness: self.slowness,
            volume: self.volume,
            shortest: self.shortest,
            longest: self.longest,
        }
    }
}

/// Eight shots.
#[derive(Debug)]
pub(super) struct Bundle {
    pub(super) mesh: Mesh,
    /// Of the projectile, then of the target.
    pub(super) nodes: Vec<Node>,
    pub(super) springs: Vec<Spring>,
    pub(super) flows: Vec<Flow>,
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
    /// Tail of the projectile and face of the target in every lane.
    pub(super) tails: [usize; LANES],
    pub(super) faces: [usize; LANES],
    /// What is known of the elements.
    pub(super) marks: Vec<Mark>,
    /// Largest stable time step of every element, and of none up to a multiple of [`LIMITS_AT_ONCE`].
    pub(super) limits: Vec<Lanes>,
    /// Those that flow or flowed in the last step.
    pub(super) working: Vec<usize>,
    /// Where single lanes of elements flow: elements and lanes.
    pub(super) gathered: Vec<(u32, u32)>,
    pub(super) bodies: [Body; 2],
    pub(super) scalars: LaneScalars,
    /// Which of the two stresses of an element is the one after the last step.
    pub(super) now: usize,
}

impl Bundle {
    pub(super) fn new(mesh: Mesh) -> Self {
        let elements = mesh.elements[0] + mesh.elements[1];
        let mut bundle = Self {
            mesh,
            nodes: vec![Node::default(); elements + 2],
            springs: vec![Spring::default(); elements],
            flows: vec![Flow::default(); elements],
            moves: vec![false; elements + 2],
            masses: vec![Lanes::default(); elements + 2],
            frictions: vec![Lanes::default(); elements + 2],
            in_contact: vec![0; elements + 2],
            irregular: Vec::new(),
            interfaces: Vec::new(),
            displaced: 0,
            tails: [0; LANES],
            faces: [mesh.elements[0] + 1; LANES],
            marks: vec![Mark::default(); elements],
            limits: vec![Lanes::all(f64::INFINITY); elements.next_multiple_of(LIMITS_AT_ONCE)],
            working: vec![0; elements],
            gathered: vec![(0, 0); (elements + 1) * LANES],
            bodies: [Body::default(); 2],
            scalars: LaneScalars::default(),
            now: 0,
        };
        for lane in 0..LANES {
            bundle.clear_lane(lane);
        }
        bundle
    }
}
