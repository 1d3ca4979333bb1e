//! What cracks make of a body: damage of its particles, and its pieces.

use super::{body::Body, bonds::BondDamage};
use crate::fragments::Fragment;

/// A piece of a body that no bond holds to the rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Piece {
    pub(super) particles: usize,
    /// Mass [kg per m].
    pub(super) mass: f64,
    /// Momentum along the normal of the struck face [N s per m].
    pub(super) momentum: f64,
    /// Sum of the masses times the depths [kg m per m].
    moment: f64,
    /// Smallest and largest depth before the impact [m].
    pub(super) before: [f64; 2],
    /// Smallest and largest distance from the axis and depth now [m].
    now: [[f64; 2]; 2],
}

impl Piece {
    const NOTHING: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];
    const NONE: Self = Self {
        particles: 0,
        mass: 0.0,
        momentum: 0.0,
        moment: 0.0,
        before: Self::NOTHING,
        now: [Self::NOTHING; 2],
    };

    fn add(&mut self, body: &Body, (row, place): (usize, usize)) {
        let mass = body.rows[row].mass[place];
        let now = body.position(row, place);
        let widen = |[low, high]: [f64; 2], at: f64| [low.min(at), high.max(at)];
        self.particles += 1;
        self.mass += mass;
        self.momentum += mass * body.motion[row].z[place];
        self.moment += mass * now[1];
        self.before = widen(self.before, body.reference(row, place)[1]);
        self.now = [0, 1].map(|axis| widen(self.now[axis], now[axis]));
    }

    /// The piece as one of the fragments of a result; its size is that of the centres of its particles and a spacing.
    pub(super) fn fragment(&self, origin: &str, spacing: f64) -> Fragment {
        let [width, length] = self.now.map(|[low, high]| high - low + spacing);
        Fragment {
            origin: origin.to_owned(),
            initial_from: self.before[0],
            initial_to: self.before[1],
            mass: self.mass,
            velocity: self.momentum / self.mass,
            length,
            diameter: width,
            position: self.moment / self.mass,
        }
    }
}

impl Body {
    /// Whether a bond carries no tension any more.
    pub(super) fn is_broken(&self, (row, place, kind): (usize, usize, usize)) -> bool {
        let Some(law) = &self.softening else {
            return false;
        };
        let damage = &self.state[row].damage;
        let (worst, start) = (damage.worst[kind][place], damage.start_of(kind, place));
        start > 0.0 && worst >= law.end_of(start)
    }

    /// Damage of a bond a step ago.
    pub(super) fn damage_of(&self, (row, place, kind): (usize, usize, usize)) -> BondDamage {
        let damage = &self.state[row].damage;
        BondDamage {
            worst: damage.worst[kind][place],
            measure: damage.measure[kind][place],
            start: damage.start_of(kind, place),
        }
    }

    /// The bonds of a particle, by their first one, place and kind.
    pub(super) fn bonds_of(&self, row: usize, place: usize) -> [Option<(usize, usize, usize)>; 6] {
        let own = |kind| Some((row, place, kind));
        let above = row.checked_sub(1).map(|above| (above, place - above % 2));
        [
            own(0),
            own(1),
            own(2),
            Some((row, place - 1, 0)),
            above.map(|(above, before)| (above, before, 1)),
            above.map(|(above, before)| (above, before + 1, 2)),
        ]
    }

    pub(super) fn weight(&self, (row, place, kind): (usize, usize, usize)) -> f64 {
        self.rows[row].weights[kind][place]
    }

    /// Part of the springs of a particle's bonds that softening has taken.
    pub(super) fn damage(&self, row: usize, place: usize) -> f64 {
        let Some(law) = &self.softening else {
            return 0.0;
        };
        let (mut all, mut left) = (0.0, 0.0);
        for bond in self.bonds_of(row, place).into_iter().flatten() {
            let weight = self.weight(bond);
            all += weight;
            let damage = self.damage_of(bond);
            left += weight * law.integrity(damage.worst, damage.start);
        }
        if all > 0.0 { 1.0 - left / all } else { 0.0 }
    }

    /// Number of bonds that are broken.
    pub(super) fn broken_bonds(&self) -> usize {
        self.bonds().filter(|&bond| self.is_broken(bond)).count()
    }

    /// Pieces that whole bonds hold together, largest first; equal ones in the order of their first particles.
    pub(super) fn pieces(&self) -> Vec<Piece> {
        let index = |row: usize, place: usize| row * self.stride + place;
        let mut parent: Vec<usize> = (0..self.rows.len() * self.stride).collect();
        for (row, place) in self.particles() {
            for kind in 0..3 {
                let bond = (row, place, kind);
                if self.weight(bond) == 0.0 || self.is_broken(bond) {
                    continue;
                }
                let (other_row, other) = self.other_end(row, place, kind);
                let a = root(&mut parent, index(row, place));
                let b = root(&mut parent, index(other_row, other));
                parent[a.max(b)] = a.min(b);
            }
        }
        let mut pieces = vec![Piece::NONE; parent.len()];
        for (row, place) in self.particles() {
            pieces[root(&mut parent, index(row, place))].add(self, (row, place));
        }
        pieces.retain(|piece| piece.particles > 0);
        pieces.sort_by(|a, b| b.mass.total_cmp(&a.mass));
        pieces
    }
}

/// First particle of a piece; on the way there every second step is made shorter.
fn root(parent: &mut [usize], mut at: usize) -> usize {
    while parent[at] != at {
        parent[at] = parent[parent[at]];
        at = parent[at];
    }
    at
}
