//! Cracks: notches, how far and how fast cracks run, and the results of it.

use serde::{Deserialize, Serialize};

use super::{
    body::Body,
    bonded::{At, Bond, Bonded, norm, way},
};
use crate::outcome::Cracks;

/// Distance from the tip of a notch within which its cracks start, in spacings.
const START: f64 = 2.0;
/// Part of an end of a notch by which it also cuts a bond there: rounding does not decide about a bond on the face.
const ROUNDING: f64 = 1e-9;
/// Parts of the way of a crack between which its mean speed is taken.
const WAY: [f64; 2] = [0.1, 0.9];
/// Entries of the path of a crack at most; then every second one is left out.
const MOST: usize = 4096;

/// What is followed of the cracks of a run.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Front {
    /// Bonds that are broken, without those of notches.
    pub(super) broken: usize,
    /// Length [m] of a straight crack that takes as many, or area of a plane one [m2].
    pub(super) size: f64,
    /// Largest distance of a broken bond of a crack from where it starts [m].
    pub(super) reach: f64,
    /// Times at which the distance grew, and the distance then [s, m].
    path: Vec<[f64; 2]>,
}

/// The notches of a run.
#[derive(Debug, Clone, Default)]
pub(super) struct Notches<const D: usize> {
    /// Ends of each: where it starts, and its tip [m].
    ends: Vec<[[f64; D]; 2]>,
    /// Whether each is a slot, which no bond crosses.
    slots: Vec<bool>,
    /// Bonds that they cut, in order.
    cut: Vec<Bond>,
    /// Particles from which the cracks of each notch start.
    starts: Vec<Vec<At>>,
}

impl Notches<2> {
    /// The notches of a body that they are cut into: ends of each, and whether it is a slot.
    pub(super) fn of(body: &Body, notches: &[([[f64; 2]; 2], bool)]) -> Self {
        let cut: Vec<Bond> = body.bonds().filter(|&bond| body.is_broken(bond)).collect();
        let near = START * body.lattice.spacing;
        let is_near = |&(row, place): &At, tip| norm(way(body.reference(row, place), tip)) < near;
        let of_tip = |&([_, tip], is_slot): &([[f64; 2]; 2], bool)| match is_slot {
            true => body.particles().filter(|at| is_near(at, tip)).collect(),
            false => {
                let ends = cut.iter().flat_map(|&bond| body.ends(bond));
                ends.filter(|end| is_near(end, tip)).collect()
            }
        };
        Self {
            starts: notches.iter().map(of_tip).collect(),
            ends: notches.iter().map(|(ends, _)| *ends).collect(),
            slots: notches.iter().map(|(_, is_slot)| *is_slot).collect(),
            cut,
        }
    }

    /// Numbers, from 1, of notches that cut no bond, and of slots whose tip is not in the body.
    pub(super) fn idle(&self, body: &Body) -> Vec<usize> {
        let is_idle = |index: &usize| match self.slots[*index] {
            true => self.starts[*index].is_empty(),
            false => body.crossed(self.ends[*index]).next().is_none(),
        };
        let idle = (0..self.ends.len()).filter(is_idle);
        idle.map(|index| index + 1).collect()
    }
}

impl<const D: usize> Notches<D> {
    fn is_cut(&self, bond: Bond) -> bool {
        self.cut.binary_search(&bond).is_ok()
    }

    /// Broken bond of the crack from the tip of each notch that is farthest from the tip, as the way to it [m]; none where no crack has started.
    fn farthest(&self, body: &impl Bonded<D>) -> Vec<Option<[f64; D]>> {
        let of = |([_, tip], starts): (&[[f64; D]; 2], &Vec<At>)| {
            let mut farthest: Option<[f64; D]> = None;
            body.follow(starts, |bond| {
                if self.is_cut(bond) {
                    return false;
                }
                let found = way(*tip, body.middle(bond));
                let is_farther = farthest.is_none_or(|old| norm(found) > norm(old));
                farthest = if is_farther { Some(found) } else { farthest };
                true
            });
            farthest
        };
        self.ends.iter().zip(&self.starts).map(of).collect()
    }

    /// Angle between the notches and the ways to the ends of their cracks, the mean over them [rad].
    fn angle(&self, body: &impl Bonded<D>) -> Option<f64> {
        let ways = self.farthest(body);
        let angles = ways
            .iter()
            .zip(&self.ends)
            .filter_map(|(way, [from, tip])| {
                // In the plane of the first axis and the depth.
                let [[a, b], [c, d]] = [(*way)?, super::bonded::way(*from, *tip)]
                    .map(|vector| [vector[0], vector[D - 1]]);
                Some((a * d - b * c).abs().atan2(a * c + b * d))
            });
        let angles: Vec<f64> = angles.collect();
        (!angles.is_empty()).then(|| angles.iter().sum::<f64>() / angles.len() as f64)
    }
}

impl Front {
    /// Follows the cracks at a time [s].
    pub(super) fn follow<const D: usize>(
        &mut self,
        body: &impl Bonded<D>,
        notches: &Notches<D>,
        time: f64,
    ) {
        let is_new = |bond: &Bond| body.is_broken(*bond) && !notches.is_cut(*bond);
        let broken: Vec<Bond> = body.bonds().filter(is_new).collect();
        if broken.len() == self.broken {
            return;
        }
        self.broken = broken.len();
        self.size = broken.iter().map(|&bond| body.crack_of(bond)).sum();
        let reach = match notches.ends.is_empty() {
            true => broken
                .iter()
                .map(|&bond| norm(body.middle(bond)))
                .fold(0.0, f64::max),
            false => notches
                .farthest(body)
                .into_iter()
                .flatten()
                .map(norm)
                .fold(0.0, f64::max),
        };
        if reach > self.reach {
            self.reach = reach;
            self.path.push([time, reach]);
            if self.path.len() > MOST {
                let mut index = 0;
                self.path.retain(|_| {
                    index += 1;
                    index % 2 == 1
                });
            }
        }
    }

    /// Mean speed of the farthest tip over most of its way [m/s].
    fn tip_speed(&self) -> Option<f64> {
        let [first, last] = WAY.map(|part| {
            let reached = self.path.iter().find(|[_, way]| *way >= part * self.reach);
            reached.copied()
        });
        let ([from, start], [to, end]) = (first?, last?);
        (to > from).then(|| (end - start) / (to - from))
    }

    /// Cracks at the end of a run.
    pub(super) fn results<const D: usize>(
        &self,
        body: &impl Bonded<D>,
        notches: &Notches<D>,
    ) -> Cracks {
        let pieces = body.pieces();
        let mut cracks = Cracks::default();
        cracks.broken_bonds = self.broken;
        match D {
            2 => cracks.length = Some(self.size),
            _ => cracks.area = Some(self.size),
        }
        // Without a notch bonds break in many places at once, which is no way of one tip.
        cracks.tip_speed = self.tip_speed().filter(|_| !notches.ends.is_empty());
        cracks.angle = notches.angle(body);
        cracks.pieces = pieces.len();
        cracks.largest_piece = pieces.first().map_or(0.0, |piece| piece.mass) / body.mass();
        cracks
    }
}

impl Body {
    /// Bonds that a straight cut crosses.
    fn crossed(&self, cut: [[f64; 2]; 2]) -> impl Iterator<Item = Bond> + '_ {
        self.bonds().filter(move |&bond| {
            let ends = self.ends(bond);
            crosses(cut, ends.map(|(row, place)| self.reference(row, place)))
        })
    }

    /// Breaks the bonds that a straight cut crosses.
    pub(super) fn cut(&mut self, cut: [[f64; 2]; 2]) {
        let Some(end) = self.softening.map(|law| law.end) else {
            return;
        };
        let bonds: Vec<Bond> = self.crossed(cut).collect();
        for (row, place, kind) in bonds {
            let damage = &mut self.state[row].damage;
            damage.worst[kind][place] = end;
            if let Some(start) = damage.start[kind].get_mut(place) {
                *start = 1.0;
            }
        }
    }
}

/// Whether a cut crosses a bond; a particle on the cut is on one side of it.
fn crosses([from, to]: [[f64; 2]; 2], [a, b]: [[f64; 2]; 2]) -> bool {
    let way = [to[0] - from[0], to[1] - from[1]];
    let side = |[x, z]: [f64; 2]| way[0] * (z - from[1]) - way[1] * (x - from[0]);
    let (first, second) = (side(a), side(b));
    if (first >= 0.0) == (second >= 0.0) {
        return false;
    }
    // Where the bond meets the line of the cut, as a part of the cut.
    let part = first / (first - second);
    let at = [0, 1].map(|axis| a[axis] + part * (b[axis] - a[axis]) - from[axis]);
    let along = (at[0] * way[0] + at[1] * way[1]) / (way[0] * way[0] + way[1] * way[1]);
    (-ROUNDING..=1.0 + ROUNDING).contains(&along)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tip that runs at one speed has that speed, wherever it started and however long it waited.
    #[test]
    fn a_steady_tip_has_its_speed() {
        let speed = 1500.0;
        let path = (0..=40).map(|i| {
            let way = 1e-3 * f64::from(i);
            [2e-6 + way / speed, way]
        });
        let front = Front {
            reach: 0.04,
            path: path.collect(),
            ..Front::default()
        };
        let found = front.tip_speed().unwrap();
        assert!((found / speed - 1.0).abs() < 1e-12, "{found}");
        assert_eq!(Front::default().tip_speed(), None);
    }
}
