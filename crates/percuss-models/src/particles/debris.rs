//! Contact of particles that no whole bond holds: pieces of a body that meet, and both sides of a crack that closes.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::{
    bonded::{At, Bonded, Load, dot, norm, way},
    onset::part_of_force,
    restitution::linear_damping,
};

/// Distance beyond contact at which a pair is watched, in spacings; half of it is how far particles go between two searches.
const WATCHED: f64 = 0.2;
/// Pairs that one task takes at least.
const AT_ONCE: usize = 1024;

/// Law of contact of two particles, as discs with the spacing as diameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ContactLaw {
    /// Stiffness along the line of centres [N/m per m].
    stiffness: f64,
    /// Stiffness across it, over that along it.
    across: f64,
    /// Coefficient of Coulomb friction.
    friction: f64,
    /// Damping, over that at which a pair just does not swing.
    damping: f64,
    /// Diameter of a particle [m].
    diameter: f64,
}

impl ContactLaw {
    /// Contact of particles of a diameter [m] and a stiffness, of a solid of a Poisson's ratio.
    pub(super) fn new(
        (diameter, stiffness): (f64, f64),
        ratio: f64,
        restitution: f64,
        friction: f64,
    ) -> Self {
        Self {
            stiffness,
            across: 2.0 * (1.0 - ratio) / (2.0 - ratio),
            friction,
            damping: linear_damping(restitution),
            diameter,
        }
    }
}

/// A pair that touches or may touch soon.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Pair {
    ends: [At; 2],
    /// Kind of the broken bond that starts at the first end: its normal spring still pushes, and carries the force of the contact.
    bond: Option<usize>,
    /// Force along the line of centres, pressure positive [N per m].
    push: f64,
    /// Part of it that damps [N per m].
    drag: f64,
    /// What the spring lacks in a step within which the contact begins or ends; 0 or negative [N per m].
    lack: f64,
    /// Elongation of the spring across that line [m].
    slide: f64,
    /// Distance at which the two touch [m].
    reach: f64,
    /// Stiffness along the line of centres [N/m per m].
    stiffness: f64,
}

/// All pairs of a body, and what they have lost.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(bound = "")]
pub(super) struct Debris<const D: usize> {
    pairs: Vec<Pair>,
    /// Displacements at the last search of the particles that have neighbours without a whole bond [m].
    #[serde(with = "super::places")]
    searched: Vec<(At, [f64; D])>,
    /// Energy lost to damping and friction [J per m].
    pub(super) lost: f64,
}

/// Two particles now.
struct Meeting<const D: usize> {
    /// From the first to the second.
    normal: [f64; D],
    distance: f64,
}

impl<const D: usize> Debris<D> {
    /// Whether particles without a whole bond to their neighbours were found.
    pub(super) fn is_empty(&self) -> bool {
        self.searched.is_empty()
    }

    /// Contact of pieces after a step: once a bond is broken, its ends and the faces of the body are watched. A search is due now and then.
    pub(super) fn meet(
        &mut self,
        body: &impl Bonded<D>,
        law: &ContactLaw,
        time_step: f64,
        is_due: bool,
    ) {
        if body.softening().is_none() {
            return;
        }
        // Bonds are counted only where a search is due.
        if (is_due && (!self.is_empty() || body.broken_bonds() > 0)) || self.has_moved(body) {
            self.search(body, law);
        }
        self.update(body, law, time_step);
    }

    /// Whether a particle has gone so far since the last search that a pair may be missing.
    pub(super) fn has_moved(&self, body: &impl Bonded<D>) -> bool {
        let far = 0.5 * WATCHED * body.spacing();
        self.searched.iter().any(|&((row, place), then)| {
            let gone = way(then, body.displacement(row, place));
            dot(gone, gone) > far * far
        })
    }

    /// Finds all pairs. Those that were known keep what they carry.
    pub(super) fn search(&mut self, body: &impl Bonded<D>, law: &ContactLaw) {
        self.searched = body
            .particles()
            .filter(|&(row, place)| !body.is_held_all_round(row, place))
            .map(|(row, place)| ((row, place), body.displacement(row, place)))
            .collect();
        let mut found = self.broken_bonds(body, WATCHED * law.diameter);
        self.add_near(body, law, &mut found);
        found.sort_unstable_by_key(|pair| pair.ends);
        for pair in &mut found {
            if let Ok(old) = self.pairs.binary_search_by_key(&pair.ends, |old| old.ends) {
                let Pair {
                    push,
                    drag,
                    lack,
                    slide,
                    ..
                } = self.pairs[old];
                *pair = Pair {
                    push,
                    drag,
                    lack,
                    slide,
                    ..*pair
                };
            }
        }
        self.pairs = found;
    }

    /// Pairs that a bond held, and that are not farther beyond its length than a distance [m].
    fn broken_bonds<B: Bonded<D>>(&self, body: &B, beyond: f64) -> Vec<Pair> {
        let mut found = Vec::new();
        for &((row, place), _) in &self.searched {
            for kind in 0..B::KINDS {
                let bond = (row, place, kind);
                if body.weight(bond) == 0.0 || !body.is_broken(bond) {
                    continue;
                }
                let [a, b] = (body.ends(bond)).map(|(row, place)| body.position(row, place));
                let spring = body.spring_of(bond);
                if norm(way(a, b)) < spring.0 + beyond {
                    found.push(Pair::new(body.ends(bond), Some(kind), spring));
                }
            }
        }
        found
    }

    /// Pairs that no bond held, by cells of a grid.
    fn add_near(&self, body: &impl Bonded<D>, law: &ContactLaw, found: &mut Vec<Pair>) {
        let reach = (1.0 + WATCHED) * law.diameter;
        let positions: Vec<[f64; D]> = (self.searched.iter())
            .map(|&((row, place), _)| body.position(row, place))
            .collect();
        let cell = |place: [f64; D]| place.map(|part| (part / reach).floor() as i64);
        let mut cells: Vec<([i64; D], usize)> = (positions.iter().enumerate())
            .map(|(index, &position)| (cell(position), index))
            .collect();
        cells.sort_unstable();
        let mut bonded = Vec::new();
        for (index, &(end, _)) in self.searched.iter().enumerate() {
            let own = cell(positions[index]);
            bonded.clear();
            // Cells that differ in their last number alone stand one behind the other.
            for column in 0..3_usize.pow(D as u32 - 1) {
                let mut first = own;
                for (axis, number) in first.iter_mut().enumerate() {
                    let off = column / 3_usize.pow(axis as u32) % 3;
                    *number += if axis + 1 < D { off as i64 - 1 } else { -1 };
                }
                let mut last = first;
                last[D - 1] += 2;
                let start = cells.partition_point(|(cell, _)| *cell < first);
                for &(_, other) in cells[start..].iter().take_while(|(cell, _)| *cell <= last) {
                    let between = way(positions[index], positions[other]);
                    if other <= index || dot(between, between) >= reach * reach {
                        continue;
                    }
                    if bonded.is_empty() {
                        add_bonded(body, end, &mut bonded);
                    }
                    let other_end = self.searched[other].0;
                    if !bonded.contains(&other_end) {
                        found.push(Pair::new(
                            [end, other_end],
                            None,
                            (law.diameter, law.stiffness),
                        ));
                    }
                }
            }
        }
    }

    /// Forces of all pairs at the positions and velocities after a step [s].
    pub(super) fn update(&mut self, body: &impl Bonded<D>, law: &ContactLaw, step: f64) {
        let lost: Vec<f64> = (self.pairs.par_iter_mut())
            .with_min_len(AT_ONCE)
            .map(|pair| pair.update(body, law, step))
            .collect();
        for lost in lost {
            self.lost += lost;
        }
    }

    /// Forces on particles, in the order of the pairs.
    pub(super) fn loads(&self, body: &impl Bonded<D>, law: &ContactLaw) -> Vec<Load<D>> {
        let mut loads = Vec::new();
        for pair in self
            .pairs
            .iter()
            .filter(|pair| pair.push > 0.0 || pair.drag != 0.0 || pair.lack != 0.0)
        {
            let meeting = pair.meeting(body);
            // The spring of a broken bond pushes by itself.
            let along = if pair.bond.is_some() {
                pair.drag + pair.lack
            } else {
                pair.push
            };
            let across = -law.across * pair.stiffness * pair.slide;
            let (normal, side) = (meeting.normal, sideways(meeting.normal));
            let force: [f64; D] =
                std::array::from_fn(|axis| along * normal[axis] + across * side[axis]);
            let moment = -0.5 * meeting.distance * across;
            for ((row, place), sign) in pair.ends.into_iter().zip([-1.0, 1.0]) {
                loads.push(Load {
                    row,
                    place,
                    force: force.map(|part| sign * part),
                    moment,
                });
            }
        }
        loads
    }

    /// Energy of the springs of all pairs [J per m], without that of bonds.
    pub(super) fn energy(&self, body: &impl Bonded<D>, law: &ContactLaw) -> f64 {
        let of = |pair: &Pair| {
            let meeting = pair.meeting(body);
            let depth = (pair.reach - meeting.distance).max(0.0);
            let along = if pair.bond.is_some() {
                0.0
            } else {
                depth * depth
            };
            0.5 * pair.stiffness * (along + law.across * pair.slide * pair.slide)
        };
        self.pairs.iter().map(of).sum()
    }
}

impl Pair {
    fn new(ends: [At; 2], bond: Option<usize>, (reach, stiffness): (f64, f64)) -> Self {
        Self {
            ends,
            bond,
            push: 0.0,
            drag: 0.0,
            lack: 0.0,
            slide: 0.0,
            reach,
            stiffness,
        }
    }

    fn meeting<const D: usize>(&self, body: &impl Bonded<D>) -> Meeting<D> {
        let [a, b] = self.ends.map(|(row, place)| body.position(row, place));
        let between = way(a, b);
        let distance = norm(between).max(f64::MIN_POSITIVE);
        Meeting {
            normal: between.map(|part| part / distance),
            distance,
        }
    }

    /// Computes the forces after a step [s], and returns the energy that damping and friction took in it [J per m].
    fn update<const D: usize>(
        &mut self,
        body: &impl Bonded<D>,
        law: &ContactLaw,
        step: f64,
    ) -> f64 {
        let meeting = self.meeting(body);
        let depth = self.reach - meeting.distance;
        let (drag, slide) = (self.drag, self.slide);
        if depth <= 0.0 && drag == 0.0 && slide == 0.0 {
            (self.push, self.lack) = (0.0, 0.0);
            return 0.0;
        }
        let [apart, past] = self.speeds(body, &meeting);
        let spring = law.across * self.stiffness;
        let trial = slide + past * step;
        if depth > 0.0 {
            let whole = self.stiffness * depth;
            let elastic = part_of_force(depth, step * apart) * whole;
            self.lack = elastic - whole;
            let damping = 2.0 * law.damping * (self.stiffness * self.mass(body)).sqrt();
            self.push = (elastic - damping * apart).max(0.0);
            self.drag = self.push - elastic;
            let most = law.friction * self.push / spring;
            self.slide = trial.clamp(-most, most);
        } else {
            (self.push, self.drag, self.lack, self.slide) = (0.0, 0.0, 0.0, 0.0);
        }
        // Work of the mean forces of both steps, less what the springs keep.
        let damped = -0.5 * (drag + self.drag) * apart * step;
        damped + 0.5 * spring * (slide + self.slide) * (trial - self.slide)
    }

    /// Speeds at which the centres part, and at which the second particle slides past the first [m/s].
    fn speeds<const D: usize>(&self, body: &impl Bonded<D>, meeting: &Meeting<D>) -> [f64; 2] {
        let [a, b] = self.ends.map(|(row, place)| body.velocity(row, place));
        let [first, second] = self.ends.map(|(row, place)| body.spin(row, place));
        let past = way(a, b);
        let rolling = 0.5 * meeting.distance * (first + second);
        let sliding = dot(past, sideways(meeting.normal)) - rolling;
        [dot(past, meeting.normal), sliding]
    }

    /// Mass of the motion of both against each other.
    fn mass<const D: usize>(&self, body: &impl Bonded<D>) -> f64 {
        let [a, b] = self
            .ends
            .map(|(row, place)| body.inverse_mass_of(row, place));
        if a + b > 0.0 { 1.0 / (a + b) } else { 0.0 }
    }
}

/// Direction in which particles of a plane slide past each other. In space they have no rotation, and so no friction.
fn sideways<const D: usize>(normal: [f64; D]) -> [f64; D] {
    let mut side = [0.0; D];
    if D == 2 {
        (side[0], side[D - 1]) = (-normal[D - 1], normal[0]);
    }
    side
}

/// Adds the particles that a particle has, or had, a bond with, and itself.
fn add_bonded<const D: usize>(body: &impl Bonded<D>, end: At, others: &mut Vec<At>) {
    others.push(end);
    for bond in body.bonds_of(end.0, end.1) {
        if body.weight(bond) > 0.0 {
            others.extend(body.ends(bond).into_iter().filter(|other| *other != end));
        }
    }
}
