//! Elastic constants of a packing: a periodic cell under a homogeneous strain, relaxed by conjugate gradients.

use super::{
    lattice::{DIRECTIONS, Lattice, ROW},
    packing::{Moved, facet_weight},
};

/// Part of the first residual at which the cell is relaxed, and steps of the search at most.
const RELAXED: f64 = 1e-10;
const MOST_STEPS: usize = 2000;

/// Two displacements and the rotation, in spacings, of every particle.
type Field = Vec<[f64; 3]>;

/// A bond of the cell.
#[derive(Debug, Clone, Copy)]
struct Link {
    ends: [usize; 2],
    direction: [f64; 2],
    length: f64,
    weight: f64,
}

/// A cell of rows and as many columns, repeated without end. Its unit of length is the spacing.
#[derive(Debug)]
pub(super) struct Periodic {
    links: Vec<Link>,
    count: usize,
    area: f64,
    normal: f64,
    shear: f64,
}

impl Periodic {
    /// A cell of an even number of rows.
    pub(super) fn new(lattice: &Lattice, size: usize, moved: Moved) -> Self {
        let wrapped = |row: usize, column: usize| (row % size) * size + column % size;
        let shift = |index: usize| moved.draw((index / size) as u64, (index % size) as u64);
        // Bonds to the right, and to the right and left of the next row, as in a body.
        let end = |row: usize, column: usize, kind: usize| match kind {
            0 => wrapped(row, column + 1),
            1 => wrapped(row + 1, column + row % 2),
            _ => wrapped(row + 1, column + size + row % 2 - 1),
        };
        let mut links = Vec::with_capacity(3 * size * size);
        for own in 0..size * size {
            for (kind, direction) in DIRECTIONS.iter().enumerate() {
                let other = end(own / size, own % size, kind);
                let (from, to) = (shift(own), shift(other));
                let [x, z] = [0, 1].map(|axis| direction[axis] + to[axis] - from[axis]);
                let length = (x * x + z * z).sqrt();
                links.push(Link {
                    ends: [own, other],
                    direction: [x / length, z / length],
                    length,
                    weight: 0.0,
                });
            }
        }
        let mut cell = Self {
            links,
            count: size * size,
            area: ROW * (size * size) as f64,
            normal: lattice.normal,
            shear: lattice.shear,
        };
        for own in 0..size * size {
            let (row, column) = (own / size, own % size);
            let right = wrapped(row, column + 1);
            let below = end(row, column, 1);
            let left = end(row, column, 2);
            cell.add_triangle([3 * own, 3 * own + 1, 3 * right + 2]);
            cell.add_triangle([3 * own + 1, 3 * own + 2, 3 * left]);
            debug_assert_eq!(
                (
                    cell.links[3 * right + 2].ends[1],
                    cell.links[3 * left].ends[1]
                ),
                (below, below)
            );
        }
        cell
    }

    /// Gives a triangle's share to its sides.
    fn add_triangle(&mut self, sides: [usize; 3]) {
        let [a, b, c] = sides.map(|side| self.links[side].length);
        // Heron's area.
        let half = 0.5 * (a + b + c);
        let area = (half * (half - a) * (half - b) * (half - c))
            .max(0.0)
            .sqrt();
        for side in sides {
            let link = &mut self.links[side];
            link.weight += facet_weight(area, link.length);
        }
    }

    /// Elastic constants `[C11, C22, C12, C66]` [Pa].
    pub(super) fn constants(&self) -> [f64; 4] {
        let along = self.stiffness([1.0, 0.0, 0.0]);
        let up = self.stiffness([0.0, 1.0, 0.0]);
        let both = self.stiffness([1.0, 1.0, 0.0]);
        [
            along,
            up,
            0.5 * (both - along - up),
            self.stiffness([0.0, 0.0, 1.0]),
        ]
    }

    /// Twice the energy per area at a strain `[ε_xx, ε_zz, γ]`.
    pub(super) fn stiffness(&self, strain: [f64; 3]) -> f64 {
        let still = vec![[0.0; 3]; self.count];
        let mut residual = self.forces(&still, strain);
        let mut field = still;
        let mut direction = residual.clone();
        let mut square = dot(&residual, &residual);
        let goal = RELAXED * RELAXED * square.max(f64::MIN_POSITIVE);
        let rounding = f64::EPSILON * f64::EPSILON * self.normal * self.normal * self.count as f64;
        for _ in 0..MOST_STEPS {
            if square <= goal.max(rounding) {
                break;
            }
            let bent = self.forces(&direction, [0.0; 3]);
            let step = -square / dot(&direction, &bent);
            for ((field, residual), (direction, bent)) in field
                .iter_mut()
                .zip(&mut residual)
                .zip(direction.iter().zip(&bent))
            {
                for part in 0..3 {
                    field[part] += step * direction[part];
                    residual[part] += step * bent[part];
                }
            }
            let next = dot(&residual, &residual);
            for (direction, residual) in direction.iter_mut().zip(&residual) {
                for part in 0..3 {
                    direction[part] = residual[part] + next / square * direction[part];
                }
            }
            square = next;
        }
        self.links
            .iter()
            .map(|link| {
                let [stretch, slide] = link.strained(&field, strain);
                link.weight * (self.normal * stretch * stretch + self.shear * slide * slide)
            })
            .sum::<f64>()
            / self.area
    }

    /// Forces on all particles: minus the gradient of the energy.
    fn forces(&self, field: &Field, strain: [f64; 3]) -> Field {
        let mut forces = vec![[0.0; 3]; self.count];
        for link in &self.links {
            let [stretch, slide] = link.strained(field, strain);
            let [x, z] = link.direction;
            let pull = link.weight * self.normal * stretch;
            let across = link.weight * self.shear * slide;
            let force = [pull * x - across * z, pull * z + across * x];
            let moment = 0.5 * across * link.length;
            for (end, sign) in link.ends.into_iter().zip([1.0, -1.0]) {
                forces[end][0] += sign * force[0];
                forces[end][1] += sign * force[1];
                forces[end][2] += moment;
            }
        }
        forces
    }
}

impl Link {
    /// Elongation, and sliding of one end past the other beyond their mean rotation.
    fn strained(&self, field: &Field, [xx, zz, gamma]: [f64; 3]) -> [f64; 2] {
        let [x, z] = self.direction;
        let [a, b] = self.ends.map(|end| field[end]);
        // The mean strain moves the copies of the cell; its shear is without a mean rotation.
        let across = b[0] - a[0] + self.length * (xx * x + 0.5 * gamma * z);
        let along = b[1] - a[1] + self.length * (zz * z + 0.5 * gamma * x);
        let turn = 0.5 * (a[2] + b[2]);
        [
            across * x + along * z,
            along * x - across * z - self.length * turn,
        ]
    }
}

fn dot(a: &Field, b: &Field) -> f64 {
    let pairs = a.iter().flatten().zip(b.iter().flatten());
    pairs.map(|(a, b)| a * b).sum()
}
