//! Tetrahedra of the lattice: masses of particles and weights of bonds.

use super::{body::CubicBody, grid::bond_between, lattice::sharing};

/// Weight of a bond in a face over that of the half that is inside: it also stands for the springs across the face, of which the outer ends are missing.
const IN_FACE: f64 = 5.0 / 3.0;

impl CubicBody {
    /// The six tetrahedra of a particle: two long edges across each other, of which one along an earlier axis starts at it.
    pub(super) fn add_tetrahedra(
        &mut self,
        start: [i64; 3],
        at: &impl Fn([i64; 3]) -> Option<(usize, usize)>,
    ) {
        for (along, across) in [(0, 1), (0, 2), (1, 2)] {
            let third = 3 - along - across;
            for side in [-1, 1] {
                let (mut end, mut low) = (start, start);
                end[along] += 2;
                low[along] += 1;
                low[across] -= 1;
                low[third] += side;
                let mut high = low;
                high[across] += 2;
                self.add_tetrahedron([start, end, low, high], at);
            }
        }
    }

    /// A tetrahedron of two opposite edges.
    fn add_tetrahedron(
        &mut self,
        corners: [[i64; 3]; 4],
        at: &impl Fn([i64; 3]) -> Option<(usize, usize)>,
    ) {
        let found = corners.map(at);
        let missing: Vec<usize> = (0..4).filter(|&i| found[i].is_none()).collect();
        let mut points = [[0.0; 3]; 4];
        for i in 0..4 {
            points[i] = match found[i] {
                Some((layer, place)) => self.rest_place(layer, place),
                None => self.place_of(corners[i]),
            };
        }
        // The particle that takes the mass of each corner.
        let mut owner = [0, 1, 2, 3];
        match missing[..] {
            [] => {}
            [gone] => {
                let other = gone ^ 1;
                let lattice = [gone, other].map(|i| self.place_of(corners[i]));
                points[gone] = [0, 1, 2].map(|axis| 0.5 * (lattice[0][axis] + lattice[1][axis]));
                owner[gone] = other;
            }
            _ => return,
        }
        let volume = volume_of(points);
        self.volume += volume;
        for i in owner {
            if let Some((layer, place)) = found[i] {
                self.layers[layer].mass[place] += 0.25 * self.lattice.density * volume;
            }
        }
        let whole = self.lattice.side.powi(3) / 12.0;
        for a in 0..4 {
            for b in a + 1..4 {
                let (Some(_), Some(_)) = (found[a], found[b]) else {
                    continue;
                };
                let (start, kind) = bond_between(corners[a], corners[b]);
                let rest: f64 = (0..3).map(|i| (points[b][i] - points[a][i]).powi(2)).sum();
                let on_lattice: f64 = self.lattice.vector(kind).iter().map(|v| v * v).sum();
                // The face halves the edge that is in it, not those that end at it.
                let part = match (missing.is_empty(), kind < 3) {
                    (true, _) => volume,
                    (false, true) => IN_FACE * volume,
                    (false, false) => 2.0 * volume,
                };
                if let Some((layer, place)) = self.grid.at(start) {
                    self.layers[layer].weights[kind][place] +=
                        part / whole / sharing(kind) * on_lattice / rest;
                }
            }
        }
    }
}

/// Volume of a tetrahedron [m3].
fn volume_of([a, b, c, d]: [[f64; 3]; 4]) -> f64 {
    let from = |p: [f64; 3]| [0, 1, 2].map(|axis| p[axis] - a[axis]);
    let [b, c, d] = [from(b), from(c), from(d)];
    let cross = [
        c[1] * d[2] - c[2] * d[1],
        c[2] * d[0] - c[0] * d[2],
        c[0] * d[1] - c[1] * d[0],
    ];
    (b[0] * cross[0] + b[1] * cross[1] + b[2] * cross[2]).abs() / 6.0
}
