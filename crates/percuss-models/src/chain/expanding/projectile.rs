//! The projectile as one rod, or as the pieces that it has separated into.

use super::{
    node::Node,
    rod::{Loss, Rod},
    slice::{Metal, Particulars, Slice},
};
use crate::{
    Error,
    chain::{
        interface::{CohesiveLaw, Interface},
        solver::StepControl,
    },
    fragments::Fragment,
    material::{DamageState, FailureState, PreparedFailure},
    solver::archive::Archive,
};

/// Rods one behind the other.
#[derive(Debug)]
pub(super) struct Projectile {
    /// From the tail on, without the foremost.
    behind: Vec<Piece>,
    /// What strikes the target.
    pub(super) front: Rod,
    failure: Option<Failure>,
    /// Energy that went into cracks and collisions of pieces [J].
    pub(super) fracture_work: f64,
    pub(super) contact_loss: f64,
}

/// A rod with what stands between its tip and the next one ahead.
#[derive(Debug)]
struct Piece {
    rod: Rod,
    interface: Interface,
}

/// When the projectile parts, and the energy per area that a crack takes [J/m2].
#[derive(Debug)]
pub(super) struct Failure {
    pub(super) law: Box<dyn PreparedFailure>,
    pub(super) energy: f64,
}

impl Projectile {
    pub(super) fn new(rod: Rod, failure: Option<Failure>) -> Self {
        Self {
            behind: Vec::new(),
            front: rod,
            failure,
            fracture_work: 0.0,
            contact_loss: 0.0,
        }
    }

    /// Everything that a step changes.
    pub(super) fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        let mut interfaces: Vec<Interface> =
            self.behind.iter().map(|piece| piece.interface).collect();
        archive.item(&mut interfaces)?;
        if archive.is_read() {
            let piece = |interface| Piece {
                rod: self.front.of_same_metal(),
                interface,
            };
            self.behind = interfaces.into_iter().map(piece).collect();
        }
        for rod in self.rods_mut() {
            rod.archive(archive)?;
        }
        archive.item(&mut self.fracture_work)?;
        archive.item(&mut self.contact_loss)
    }

    /// Its rods from the tail to the tip.
    fn rods(&self) -> impl Iterator<Item = &Rod> {
        let behind = self.behind.iter().map(|piece| &piece.rod);
        behind.chain(std::iter::once(&self.front))
    }

    fn rods_mut(&mut self) -> impl Iterator<Item = &mut Rod> {
        let behind = self.behind.iter_mut().map(|piece| &mut piece.rod);
        behind.chain(std::iter::once(&mut self.front))
    }

    pub(super) fn tail(&self) -> Option<Node> {
        self.rods().next().and_then(|rod| rod.nodes.first())
    }

    pub(super) fn nodes(&self) -> impl Iterator<Item = Node> {
        self.rods().flat_map(|rod| rod.nodes.iter())
    }

    /// Slices, each with what it has by itself and with its two nodes.
    pub(super) fn slices(&self) -> impl Iterator<Item = (Slice, &Particulars, [Node; 2])> {
        self.rods().flat_map(|rod| {
            let ends = rod.nodes.iter().zip(rod.nodes.iter().skip(1));
            let slices = rod.slices.iter().zip(&rod.particulars).zip(ends);
            slices.map(|((slice, own), (back, front))| (slice, own, [back, front]))
        })
    }

    /// Forces of the slices on the nodes.
    pub(super) fn collect(&mut self) {
        for rod in self.rods_mut() {
            rod.collect();
        }
        for i in 0..self.behind.len() {
            let gap = self.gap(i);
            let pull = self.behind[i].interface.pull_at(gap);
            if let Some((mut behind, mut ahead)) = self.ends(i) {
                behind.damping += pull;
                ahead.damping -= pull;
                self.set_ends(i, behind, ahead);
            }
        }
    }

    /// Adds damping; `pushed` is the force of the target on the tip [N].
    pub(super) fn damp(&mut self, control: &StepControl, pushed: f64) {
        for piece in &mut self.behind {
            piece.rod.damp(control, 0.0);
        }
        self.front.damp(control, pushed);
    }

    /// New velocities of all nodes but the tip.
    pub(super) fn kick(&mut self, kick: f64) {
        self.front.kick(kick);
        for piece in &mut self.behind {
            piece.rod.kick(kick);
            if let Some(mut tip) = piece.rod.tip() {
                tip.kick(tip.whole_force() * kick);
                piece.rod.nodes.set_last(tip);
            }
        }
    }

    /// Closes the interfaces of pieces that would overlap within the step, as a plastic impact. Closed interfaces open when they are pulled
    /// harder than their bond bears.
    pub(super) fn close_interfaces(&mut self, kick: f64, time_step: f64) {
        for i in 0..self.behind.len() {
            let gap = self.gap(i).max(0.0);
            let Interface { closed, bond, pull } = self.behind[i].interface;
            let Some((mut behind, mut ahead)) = self.ends(i) else {
                continue;
            };
            let opening = ahead.mean_velocity() - behind.mean_velocity();
            let change = behind.velocity - ahead.velocity - gap / time_step;
            let wanted = change / (behind.mobility() + ahead.mobility());
            let least = if closed { -bond.holds() * kick } else { 0.0 };
            let impulse = wanted.max(least);
            let mut loss = behind.jump(-impulse * behind.mobility(), time_step);
            loss += ahead.jump(impulse * ahead.mobility(), time_step);
            self.set_ends(i, behind, ahead);
            let drifts = (ahead.velocity - behind.velocity) * time_step;
            let touches = wanted >= 0.0 || wanted > least;
            if touches {
                self.contact_loss += loss;
            } else {
                self.fracture_work += loss;
            }
            // What the bond does over the drift is work of fracture, the rest of what it did in the kick went into the collision.
            self.fracture_work += pull * drifts;
            self.contact_loss += pull * (opening * kick - drifts);
            self.behind[i].interface.closed = touches;
        }
    }

    /// Distance between a piece and the one ahead of it [m].
    fn gap(&self, i: usize) -> f64 {
        let ends = self.ends(i);
        ends.map_or(0.0, |(behind, ahead)| ahead.position - behind.position)
    }

    /// The two nodes at the interface ahead of a piece.
    fn ends(&self, i: usize) -> Option<(Node, Node)> {
        let mut rods = self.rods().skip(i);
        let (behind, ahead) = (rods.next()?, rods.next()?);
        Some((behind.nodes.last()?, ahead.nodes.first()?))
    }

    /// Replaces them.
    fn set_ends(&mut self, i: usize, behind: Node, ahead: Node) {
        let mut rods = self.rods_mut().skip(i);
        if let (Some(rod), Some(next)) = (rods.next(), rods.next()) {
            rod.nodes.set_last(behind);
            next.nodes.set(0, ahead);
        }
    }

    /// Forces times the changes of velocities in the last kick [N m/s].
    pub(super) fn forced_change(&self, kick: f64) -> f64 {
        self.rods().map(|rod| rod.forced_change(kick)).sum()
    }

    /// Moves on and gives the plastic work [J]; an error names a slice that was crushed.
    pub(super) fn drift(&mut self, time_step: f64) -> Result<f64, usize> {
        let mut work = 0.0;
        let mut first = 0;
        for rod in self.rods_mut() {
            work += rod.drift(time_step).map_err(|slice| first + slice)?;
            first += rod.slices.len();
        }
        Ok(work)
    }

    /// Brings damage up to the end of a step and parts rods where slices have failed and something pulls: one place a rod and step, where
    /// the two slices are damaged most, as the new ends unload their neighbours. Gives the initial positions [m] of the new cracks.
    pub(super) fn split_failed_interfaces(&mut self, time_step: f64) -> Vec<f64> {
        let Some(failure) = &self.failure else {
            return Vec::new();
        };
        let mut cracks = Vec::new();
        let mut i = 0;
        while i <= self.behind.len() {
            let rod = match self.behind.get_mut(i) {
                Some(piece) => &mut piece.rod,
                None => &mut self.front,
            };
            rod.damage(&*failure.law, time_step);
            if let Some(node) = rod.weakest_node() {
                let ahead = &rod.particulars[node];
                cracks.push(ahead.initial_position - 0.5 * rod.size.length);
                let (strength, area) = rod.pull_at(node);
                let (rod, energy) = rod.split(node);
                self.contact_loss += energy;
                let interface =
                    Interface::new(true, CohesiveLaw::crack(strength, failure.energy * area));
                self.behind.insert(i, Piece { rod, interface });
                i += 1;
            }
            i += 1;
        }
        cracks
    }

    /// Largest stable step [s], in which no slice changes its size by more than a part either.
    pub(super) fn stable_step(&self, largest_strain: f64) -> f64 {
        let steps = self.rods().map(|rod| rod.stable_step(largest_strain));
        steps.fold(f64::INFINITY, f64::min)
    }

    /// Takes the foremost slice out, with what leaves with it; the next piece follows when the foremost is used up.
    pub(super) fn erode_tip(&mut self) -> Loss {
        let loss = self.front.erode_tip();
        if self.front.slices.is_empty()
            && let Some(next) = self.behind.pop()
        {
            let reached = self.front.reached();
            self.front = next.rod;
            self.front.remember(reached);
        }
        loss
    }

    /// Momentum [N s].
    pub(super) fn momentum(&self) -> f64 {
        self.rods().map(Rod::momentum).sum()
    }

    /// Mass [kg] and momentum [N s].
    pub(super) fn motion(&self) -> (f64, f64) {
        let motions = self.rods().map(Rod::motion);
        motions.fold((0.0, 0.0), |sum, (mass, momentum)| {
            (sum.0 + mass, sum.1 + momentum)
        })
    }

    /// Kinetic and elastic energy [J].
    pub(super) fn energies(&self) -> [f64; 2] {
        let energies = self.rods().map(Rod::energies);
        energies.fold([0.0; 2], |sum, own| [sum[0] + own[0], sum[1] + own[1]])
    }

    /// Largest plastic strain, plastic strain rate [1/s] and temperature [K] so far.
    pub(super) fn reached(&self) -> [f64; 3] {
        let reached = self.rods().map(Rod::reached);
        reached.fold([0.0; 3], |most, own| {
            std::array::from_fn(|k| f64::max(most[k], own[k]))
        })
    }

    /// Whether loose pieces are still to collide at more than a speed [m/s].
    pub(super) fn pieces_approach(&self, least: f64) -> bool {
        let speeds: Vec<f64> = self
            .rods()
            .map(|rod| {
                let (mass, momentum) = rod.motion();
                momentum / mass
            })
            .collect();
        self.behind
            .iter()
            .zip(speeds.windows(2))
            .any(|(piece, pair)| {
                let is_loose = !piece.interface.closed && piece.interface.bond.holds() == 0.0;
                is_loose && pair[0] - pair[1] > least
            })
    }

    /// The pieces from the tail on that no crack holds together any more, where there is more than one.
    pub(super) fn fragments(&self) -> Vec<Fragment> {
        let mut pieces: Vec<Vec<&Rod>> = Vec::new();
        let mut joined = false;
        let holds = self.behind.iter();
        let holds = holds.map(|piece| piece.interface.bond.holds() > 0.0);
        for (rod, holds) in self.rods().zip(holds.chain([false])) {
            match pieces.last_mut().filter(|_| joined) {
                Some(piece) => piece.push(rod),
                None => pieces.push(vec![rod]),
            }
            joined = holds;
        }
        if pieces.len() < 2 {
            return Vec::new();
        }
        pieces.iter().map(|piece| fragment(piece)).collect()
    }
}

/// Rods one behind the other as one piece.
fn fragment(rods: &[&Rod]) -> Fragment {
    let (mut mass, mut momentum, mut moment) = (0.0, 0.0, 0.0);
    let (mut length, mut radius) = (0.0, 0.0_f64);
    let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
    for rod in rods {
        let motion = rod.motion();
        mass += motion.0;
        momentum += motion.1;
        let moments = rod.nodes.iter().map(|node| node.mass() * node.position);
        moment += moments.sum::<f64>();
        let half = 0.5 * rod.size.length;
        for (slice, own) in rod.slices.iter().zip(&rod.particulars) {
            let (unloaded, widest) = slice.unloaded(&rod.size);
            length += unloaded;
            radius = radius.max(widest);
            from = from.min(own.initial_position - half);
            to = to.max(own.initial_position + half);
        }
    }
    Fragment {
        origin: "projectile".to_owned(),
        initial_from: from,
        initial_to: to,
        mass,
        velocity: momentum / mass,
        length,
        diameter: 2.0 * radius,
        position: moment / mass,
    }
}

/// State that damage of a slice grows by over a step.
pub(super) fn failure_state(slice: &Slice, metal: &Metal, time_step: f64) -> FailureState {
    let increment = slice.plastic.step.abs();
    let equivalent = slice.difference[1].abs();
    FailureState {
        tension: -slice.axial_stress(),
        triaxiality: if equivalent > 0.0 {
            -slice.pressure[1] / equivalent
        } else {
            0.0
        },
        plastic_strain_increment: increment,
        strain_rate: DamageState::rate(increment, time_step, metal.rate_effects),
        temperature: slice.plastic.temperature,
    }
}
