//! What a run, its contacts and its cracks need of a body of bonded particles, in a plane or in space.
//!
//! Vectors have the distances from the axis first and the depth last. In a plane masses, forces and energies are per metre of width.

use std::fmt::Debug;

use super::{
    bonds::BondDamage,
    cracks::Notches,
    debris::ContactLaw,
    energy::BodySums,
    flight::Inertia,
    fracture::{Softening, Softenings},
    pieces::{Piece, root},
    shape::{Rigid, Shape},
};
use crate::{
    Error, Scenario,
    history::ElementState,
    outcome::Detail,
    solver::{Control, Particle, archive::Archive},
    units::significant,
};

/// Row or layer of a particle, and its place there.
pub(super) type At = (usize, usize);
/// Row or layer, place and kind of a bond: it starts at that particle.
pub(super) type Bond = (usize, usize, usize);

/// Force [N] and moment [N m] of a contact on a particle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Load<const D: usize> {
    pub(super) row: usize,
    pub(super) place: usize,
    pub(super) force: [f64; D],
    pub(super) moment: f64,
}

/// Largest plastic strain and temperature [K] of a body; 0 where there is none.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Flow {
    pub(super) plastic_strain: f64,
    pub(super) temperature: f64,
}

/// Largest stretch of a bond that holds: beyond it no brittle solid is whole.
const LARGEST_STRETCH: f64 = 0.1;

/// A body of bonded particles in rows or layers.
pub(super) trait Bonded<const D: usize>: Debug + Clone + Sync {
    /// Name of its lattice in checkpoints.
    const LATTICE: &'static str;
    /// Kinds of bonds that start at a particle.
    const KINDS: usize;

    /// The body of a case at the moment of impact, and the rigid body that it meets.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    fn build(scenario: &Scenario, control: &mut Control<'_>) -> Result<(Self, Rigid), Error>;

    /// Number of rows or layers.
    fn row_count(&self) -> usize;
    /// Places of a row or layer, of which not all have particles.
    fn row_places(&self) -> usize;
    /// Distance of nearest neighbours [m].
    fn spacing(&self) -> f64;
    /// Speed of a longitudinal wave [m/s].
    fn wave_speed(&self) -> f64;
    /// Mass of a particle inside.
    fn inner_mass(&self) -> f64;
    /// Stiffness of the contact of a particle with a rigid body.
    fn contact_stiffness(&self) -> f64;
    /// Largest angular frequency [rad/s].
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    fn frequency(&mut self, control: &mut Control<'_>) -> Result<f64, Error>;
    /// How bonds fail, if they do.
    fn softening(&self) -> Option<&Softening>;
    /// Whether contacts with a rigid body begin and end within steps. A lattice that holds is that of other programs, whose contacts do not.
    fn begins_within_steps(&self) -> bool {
        self.softening().is_some()
    }
    /// Contact of its pieces.
    fn contact_law(&self, scenario: &Scenario) -> ContactLaw;
    /// Area of a strip or volume of a body of revolution, distance of its centre behind the tip [m], and second moment about it.
    fn moments(shape: &Shape) -> (f64, f64, f64);
    /// Inertia of what meets the rigid body, or of that body.
    fn inertia(&self, scenario: &Scenario, rigid: Rigid) -> Inertia {
        let Rigid::Projectile(shape) = rigid else {
            return Inertia::on_axis(self.mass());
        };
        let density = scenario.projectile.material.density.si();
        let (size, centre, second) = Self::moments(&shape);
        let turns = scenario.obliquity != 0.0;
        Inertia::of(density * size, (centre, second), density, turns)
    }

    /// Mass of a particle; 0 where there is none.
    fn mass_of(&self, row: usize, place: usize) -> f64;
    /// One over the mass; 0 of a particle that is held.
    fn inverse_mass_of(&self, row: usize, place: usize) -> f64;
    /// Position of a particle before the impact [m].
    fn reference(&self, row: usize, place: usize) -> [f64; D];
    /// Position of a particle now [m].
    fn position(&self, row: usize, place: usize) -> [f64; D];
    /// Displacement of a particle [m].
    fn displacement(&self, row: usize, place: usize) -> [f64; D];
    /// Velocity of a particle half a step ago [m/s].
    fn velocity(&self, row: usize, place: usize) -> [f64; D];
    /// Angular velocity of a particle half a step ago [rad/s].
    fn spin(&self, row: usize, place: usize) -> f64;

    /// Share of its springs that a bond has; 0 where there is none.
    fn weight(&self, bond: Bond) -> f64;
    /// The second particle of a bond.
    fn other_end(&self, row: usize, place: usize, kind: usize) -> At;
    /// The bonds of a particle, those that end at it included.
    fn bonds_of(&self, row: usize, place: usize) -> impl Iterator<Item = Bond>;
    /// Length of a bond at rest [m], and stiffness of its normal spring.
    fn spring_of(&self, bond: Bond) -> (f64, f64);
    /// Damage of a bond a step ago.
    fn damage_of(&self, bond: Bond) -> BondDamage;
    /// Length [m] of the crack of a straight cut that a bond stands for, or its area [m2].
    fn crack_of(&self, bond: Bond) -> f64;
    /// The notches of a case.
    fn notches(&self, _: &Scenario) -> Notches<D> {
        Notches::default()
    }
    /// Numbers, from 1, of notches without effect.
    fn idle(&self, _: &Notches<D>) -> Vec<usize> {
        Vec::new()
    }

    /// Advances all particles by a step [s] under the loads of contacts, which are in the order of the rows; returns the impulse on the support.
    fn advance(&mut self, step: f64, loads: &[Load<D>]) -> f64;
    /// Energies now, the velocities taken half a step on under the same loads.
    fn sums(&self, step: f64, loads: &[Load<D>]) -> BodySums;
    /// Momentum along the normal of the struck face half a step ago.
    fn momentum(&self) -> f64;
    /// Mass of all particles.
    fn mass(&self) -> f64;
    /// What a checkpoint keeps of it.
    ///
    /// # Errors
    /// As [`Archive::item`].
    fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error>;

    /// Largest stretch of a bond that holds, over the spacing, in space over its length, and largest principal tension of a particle [Pa].
    fn extremes(&self) -> (f64, f64);
    /// Why and with what remedy a run whose largest stretch of a bond is this one cannot go on, if it cannot.
    fn unbearable(&self, largest_stretch: f64) -> Option<(String, String)> {
        let why = match self.softening() {
            Some(_) => "no spring stands for so large a strain of what is still whole",
            None => "the solid would break, and the bonds of this run do not",
        };
        (largest_stretch > LARGEST_STRETCH).then(|| {
            (
                format!(
                    "a bond is stretched or shortened by {:.0} % of the spacing: {why},",
                    100.0 * largest_stretch
                ),
                "lower `projectile.impact_velocity`, blunt the nose, or use another model"
                    .to_owned(),
            )
        })
    }
    /// Part of the stable step of the body at rest that is stable now; 1 where springs keep their stiffness.
    fn stable_part(&self) -> f64 {
        1.0
    }
    /// Largest plastic strain and temperature.
    fn flow(&self) -> Flow {
        Flow::default()
    }
    /// Largest stretch and tension [Pa] of a run among its results.
    fn extremes_in_words(&self, stretch: f64, tension: f64) -> Vec<Detail> {
        vec![
            Detail::new("largest tension", "MPa", tension * 1e-6),
            Detail::new("largest stretch of a bond", "%", 100.0 * stretch),
        ]
    }
    /// What a reader has to know of them where nothing breaks.
    fn limits_in_words(&self, _: f64, tension: f64) -> Vec<String> {
        vec![format!(
            "the solid cannot break in this run: the largest tension is {} MPa, and beyond the strength of the material its \
             answer does not hold",
            significant(tension * 1e-6, 3)
        )]
    }
    /// Place of a full row that is nearest to the axis.
    fn middle_place(&self, row: usize) -> usize;
    /// Particle of a row that is nearest to the axis; none in a row without particles.
    fn nearest_to_axis(&self, row: usize) -> Option<At> {
        let is_there = |place: &usize| self.mass_of(row, *place) > 0.0;
        let middle = Some(self.middle_place(row)).filter(is_there);
        let distance = |place: usize| from_axis(self.reference(row, place)).abs();
        let place = middle.or_else(|| {
            let places = (0..self.row_places()).filter(is_there);
            places.min_by(|&a, &b| distance(a).total_cmp(&distance(b)))
        });
        Some((row, place?))
    }
    /// State of a particle on the axis, of a part of the case.
    fn on_axis(&self, at: At, part: usize) -> ElementState;
    /// A particle for pictures and files.
    fn particle(&self, row: usize, place: usize) -> Particle;
    /// Distance of a particle from the plane of the axis and the depth [m], and its velocity away from it [m/s]; none in a plane.
    fn across(&self, _: usize, _: usize) -> Option<[f64; 2]> {
        None
    }
    /// Points that show a rigid projectile, and what they have across the plane.
    fn show_rigid(&self, run: &super::run::Impact<'_, Self, D>) -> (Vec<Particle>, Vec<[f64; 2]>);
    /// Thickness of the section of a body in space that pictures show [m].
    fn section(&self) -> f64 {
        self.spacing()
    }
    /// Sizes that this body alone has.
    fn details(&self, scenario: &Scenario, inertia: &Inertia) -> Vec<Detail>;
    /// What a reader of its results has to know, first.
    fn notes(&self, scenario: &Scenario) -> Vec<String>;
    /// Softening that the case asks for, if its bonds break.
    fn softenings(&self, scenario: &Scenario) -> Option<Softenings>;

    /// All particles, in order.
    fn particles(&self) -> impl Iterator<Item = At> {
        (0..self.row_count()).flat_map(move |row| {
            let places = 0..self.row_places();
            places
                .filter(move |&place| self.mass_of(row, place) > 0.0)
                .map(move |place| (row, place))
        })
    }

    /// Depth of a particle now [m].
    fn depth(&self, row: usize, place: usize) -> f64 {
        self.position(row, place)[D - 1]
    }

    /// Places of the particles of a row that are at depths of a range [m]. Of a body that does not break only rows that began near to it have any.
    fn between(&self, row: usize, depths: &std::ops::Range<f64>) -> impl Iterator<Item = usize> {
        let (start, end) = (depths.start, depths.end);
        let began = self.reference(row, 0)[D - 1];
        let near = start - self.spacing()..=end + self.spacing();
        let may = self.softening().is_some() || near.contains(&began);
        let places = if may { 0..self.row_places() } else { 0..0 };
        places.filter(move |&place| {
            let depth = self.depth(row, place);
            depth > start && depth < end && self.mass_of(row, place) > 0.0
        })
    }

    /// All bonds, in order.
    fn bonds(&self) -> impl Iterator<Item = Bond> {
        self.particles()
            .flat_map(|(row, place)| (0..Self::KINDS).map(move |kind| (row, place, kind)))
            .filter(|&bond| self.weight(bond) > 0.0)
    }

    /// Both particles of a bond.
    fn ends(&self, (row, place, kind): Bond) -> [At; 2] {
        [(row, place), self.other_end(row, place, kind)]
    }

    /// Middle of a bond before the impact [m].
    fn middle(&self, bond: Bond) -> [f64; D] {
        let ends = self.ends(bond);
        let [a, b] = ends.map(|(row, place)| self.reference(row, place));
        std::array::from_fn(|axis| 0.5 * (a[axis] + b[axis]))
    }

    /// Whether a bond carries no tension any more.
    fn is_broken(&self, bond: Bond) -> bool {
        let Some(law) = self.softening() else {
            return false;
        };
        let BondDamage { worst, start, .. } = self.damage_of(bond);
        start > 0.0 && worst >= law.end_of(start)
    }

    /// Number of bonds that are broken.
    fn broken_bonds(&self) -> usize {
        self.bonds().filter(|&bond| self.is_broken(bond)).count()
    }

    /// Whether no whole bond holds a particle.
    fn is_loose(&self, row: usize, place: usize) -> bool {
        let holds = |bond: Bond| self.weight(bond) > 0.0 && !self.is_broken(bond);
        self.softening().is_some() && !self.bonds_of(row, place).any(holds)
    }

    /// Whether a particle has all bonds of one inside, whole.
    fn is_held_all_round(&self, row: usize, place: usize) -> bool {
        let holds = |bond: &Bond| self.weight(*bond) > 0.0 && !self.is_broken(*bond);
        self.bonds_of(row, place).filter(holds).count() == 2 * Self::KINDS
    }

    /// Part of the springs of a particle's bonds that softening has taken.
    fn damage(&self, row: usize, place: usize) -> f64 {
        let Some(law) = self.softening() else {
            return 0.0;
        };
        let (mut all, mut left) = (0.0, 0.0);
        for bond in self.bonds_of(row, place) {
            let weight = self.weight(bond);
            all += weight;
            let damage = self.damage_of(bond);
            left += weight * law.integrity(damage.worst, damage.start);
        }
        if all > 0.0 { 1.0 - left / all } else { 0.0 }
    }

    /// Number of a particle among all places.
    fn index(&self, (row, place): At) -> usize {
        row * self.row_places() + place
    }

    /// Pieces that whole bonds hold together, largest first; equal ones in the order of their first particles.
    fn pieces(&self) -> Vec<Piece<D>> {
        let mut parent: Vec<usize> = (0..self.row_count() * self.row_places()).collect();
        for bond in self.bonds().filter(|&bond| !self.is_broken(bond)) {
            let [a, b] = self
                .ends(bond)
                .map(|end| root(&mut parent, self.index(end)));
            parent[a.max(b)] = a.min(b);
        }
        // Numbers of the pieces at their first particles: a piece for each place would take a third of the memory of the body.
        let mut number = vec![u32::MAX; parent.len()];
        let mut pieces: Vec<Piece<D>> = Vec::new();
        for at in self.particles() {
            let number = &mut number[root(&mut parent, self.index(at))];
            if *number == u32::MAX {
                *number = pieces.len() as u32;
                pieces.push(Piece::NONE);
            }
            pieces[*number as usize].add(self, at);
        }
        pieces.sort_by(|a, b| b.mass.total_cmp(&a.mass));
        pieces
    }

    /// Goes along broken bonds from particles, as long as `goes_on` takes a bond.
    fn follow(&self, starts: &[At], mut goes_on: impl FnMut(Bond) -> bool) {
        let mut seen = vec![false; self.row_count() * self.row_places()];
        let mut open: Vec<At> = starts.to_vec();
        for &at in starts {
            seen[self.index(at)] = true;
        }
        while let Some((row, place)) = open.pop() {
            for bond in self.bonds_of(row, place) {
                if self.weight(bond) == 0.0 || !self.is_broken(bond) || !goes_on(bond) {
                    continue;
                }
                for end in self.ends(bond) {
                    let is_seen = &mut seen[self.index(end)];
                    if !std::mem::replace(is_seen, true) {
                        open.push(end);
                    }
                }
            }
        }
    }
}

/// Distance of a position from the axis [m], in a plane with its sign.
pub(super) fn from_axis<const D: usize>(at: [f64; D]) -> f64 {
    match &at[..D - 1] {
        [x] => *x,
        across => across.iter().map(|x| x * x).sum::<f64>().sqrt(),
    }
}

/// Length of a vector.
pub(super) fn norm<const D: usize>(vector: [f64; D]) -> f64 {
    dot(vector, vector).sqrt()
}

pub(super) fn dot<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    a.into_iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Vector from one place to another.
pub(super) fn way<const D: usize>(from: [f64; D], to: [f64; D]) -> [f64; D] {
    std::array::from_fn(|axis| to[axis] - from[axis])
}
