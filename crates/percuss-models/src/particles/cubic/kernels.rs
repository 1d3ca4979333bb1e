//! Loops over a layer: elongations, changes of volume, pulls and forces of its bonds.
//!
//! `V = Σ ½ k w e² + Σ ½ K V θ²` with `θ = (3/Σ w d²) Σ w d e` of the bonds of each particle: all forces are along bonds.

use super::{
    super::fracture::Softening,
    body::{Bonds, Change, Damage, Layer, Vector},
    grid::Grid,
    lattice::{Cubic, KINDS, relative},
};
use crate::lanes::larger;

/// Smallest length of a bond, in that at rest.
const LEAST_LENGTH: f64 = 1e-6;

/// What all layers have in common.
#[derive(Debug, Clone, Copy)]
pub(super) struct Common<'a> {
    pub(super) lattice: &'a Cubic,
    pub(super) grid: Grid,
    pub(super) softening: Option<&'a [Softening; 2]>,
    pub(super) is_moved: bool,
}

/// A layer and the two behind it; a vector of nothing stands for what is not there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Next<'a> {
    pub(super) number: usize,
    pub(super) layers: [&'a Layer; 3],
    pub(super) state: [&'a Vector; 3],
    pub(super) volume_pull: [&'a [f64]; 3],
}

/// Places that have particles, with one row and one place before and behind.
pub(super) fn inside(grid: &Grid) -> (usize, usize) {
    let start = grid.stride() + 1;
    (start, grid.rows * grid.stride() - 2)
}

/// The places with particles of an array, moved by an offset.
#[inline(always)]
pub(super) fn at<'a>(array: &'a [f64], grid: &Grid, offset: isize) -> &'a [f64] {
    let (start, count) = inside(grid);
    &array[start.saturating_add_signed(offset)..][..count]
}

#[inline(always)]
pub(super) fn at_mut<'a>(array: &'a mut [f64], grid: &Grid) -> &'a mut [f64] {
    let (start, count) = inside(grid);
    &mut array[start..][..count]
}

/// Kind of law of a kind of bonds.
#[inline(always)]
pub(super) fn law(softening: &[Softening; 2], kind: usize) -> &Softening {
    &softening[usize::from(kind < 3)]
}

/// Adds to the particles of a layer what every bond has, that starts at them or ends there.
#[inline(always)]
fn gather(
    grid: &Grid,
    number: usize,
    bonds: [Option<&Bonds>; 3],
    mut add: impl FnMut(usize, (isize, usize), &[f64], f64),
) {
    let [own, before, second] = bonds;
    for kind in 0..KINDS {
        if let Some(own) = own {
            let to = grid.offset(kind, number);
            add(kind, to, at(&own.pull[kind], grid, 0), 1.0);
        }
    }
    for kind in 0..KINDS {
        let (_, on) = grid.offset(kind, number);
        let from = [own, before, second][on];
        if let Some(from) = from {
            let (offset, _) = grid.offset(kind, number - on);
            add(
                kind,
                (-offset, on),
                at(&from.pull[kind], grid, -offset),
                -1.0,
            );
        }
    }
}

/// The bonds of a layer and of the two before it.
pub(super) fn before(bonds: &[Bonds], number: usize) -> [Option<&Bonds>; 3] {
    [0, 1, 2].map(|on| number.checked_sub(on).and_then(|number| bonds.get(number)))
}

/// Sum of what the bonds of a particle add to its change of volume.
pub(super) struct Dilatation<'a> {
    pub(super) grid: Grid,
    pub(super) number: usize,
    pub(super) layer: &'a Layer,
    pub(super) bonds: [Option<&'a Bonds>; 3],
    pub(super) volume_pull: &'a mut [f64],
}

impl pulp::NullaryFnOnce for Dilatation<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let grid = &self.grid;
        let volume_pull = at_mut(self.volume_pull, grid);
        volume_pull.fill(0.0);
        gather(grid, self.number, self.bonds, |_, _, parts, _| {
            for (sum, part) in volume_pull.iter_mut().zip(parts) {
                *sum += part;
            }
        });
        let stiff = at(&self.layer.volume_stiffness, grid, 0);
        for (sum, stiff) in volume_pull.iter_mut().zip(stiff) {
            *sum *= stiff;
        }
    }
}

/// Forces of the bonds that start in a layer, over their lengths.
pub(super) struct Pull<'a> {
    pub(super) common: Common<'a>,
    pub(super) next: Next<'a>,
    pub(super) bonds: &'a mut Bonds,
    pub(super) damage: &'a mut Damage,
}

impl pulp::NullaryFnOnce for Pull<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self {
            common,
            next,
            bonds,
            damage,
        } = self;
        let layer = next.layers[0];
        for kind in 0..KINDS {
            match (common.softening.is_some(), common.is_moved) {
                (false, false) => pull::<false, false>(common, next, kind, bonds, damage),
                (false, true) => pull::<false, true>(common, next, kind, bonds, damage),
                (true, false) => pull::<true, false>(common, next, kind, bonds, damage),
                (true, true) => pull::<true, true>(common, next, kind, bonds, damage),
            }
        }
        // The work of the mean of both forces, less what the springs store.
        for change in damage.changes.drain(..) {
            let Change {
                kind,
                place,
                damage: more,
                elongations: [old, new],
                volume_pull,
            } = change;
            let (offset, on) = common.grid.offset(kind, next.number);
            let other = place.saturating_add_signed(offset);
            let after = next.volume_pull[0][place] + next.volume_pull[on][other];
            let length = match common.is_moved {
                true => layer.rests[kind][place],
                false => norm(common.lattice.vector(kind)),
            };
            let weight = layer.weights[kind][place];
            let of_spring = common.lattice.stiffness(kind) * old * new;
            let of_volume = relative(kind) * length * (volume_pull * new + after * old);
            damage.lost += 0.5 * weight * more * (of_spring + of_volume);
        }
    }
}

fn norm(vector: [f64; 3]) -> f64 {
    vector.iter().map(|part| part * part).sum::<f64>().sqrt()
}

#[inline(always)]
fn pull<const SOFTENS: bool, const MOVED: bool>(
    common: Common<'_>,
    next: Next<'_>,
    kind: usize,
    bonds: &mut Bonds,
    damage: &Damage,
) {
    let grid = &common.grid;
    let (offset, on) = grid.offset(kind, next.number);
    let (_, count) = inside(grid);
    let (stiffness, share) = (common.lattice.stiffness(kind), relative(kind));
    let rest_length = norm(common.lattice.vector(kind));
    let own = at(next.volume_pull[0], grid, 0);
    let other = at(next.volume_pull[on], grid, offset);
    let weights = at(&next.layers[0].weights[kind], grid, 0);
    let rests = if MOVED {
        at(&next.layers[0].rests[kind], grid, 0)
    } else {
        &[]
    };
    let worst = if SOFTENS {
        at(&damage.worst[kind], grid, 0)
    } else {
        &[]
    };
    let softening = common.softening.map(|laws| *law(laws, kind));
    let elongation = at(&bonds.elongation[kind], grid, 0);
    let pulls = at_mut(&mut bonds.pull[kind], grid);
    for i in 0..count {
        let length = if MOVED { rests[i] } else { rest_length };
        let found = elongation[i];
        let (mut of_spring, mut of_volume) =
            (stiffness * found, share * length * (own[i] + other[i]));
        if SOFTENS && let Some(law) = &softening {
            let integrity = law.integrity(worst[i], 1.0);
            of_volume *= integrity;
            // A broken spring still pushes.
            of_spring *= if found > 0.0 { integrity } else { 1.0 };
        }
        let now = larger(length + found, LEAST_LENGTH * length);
        pulls[i] = weights[i] * (of_spring + of_volume) / now;
    }
}

/// Forces on the particles of a layer.
pub(super) struct Sum<'a> {
    pub(super) common: Common<'a>,
    pub(super) number: usize,
    pub(super) layers: &'a [Layer],
    pub(super) state: &'a [Vector],
    pub(super) bonds: [Option<&'a Bonds>; 3],
    pub(super) force: &'a mut Vector,
}

impl pulp::NullaryFnOnce for Sum<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self {
            common,
            number,
            layers,
            state,
            bonds,
            force,
        } = self;
        let grid = &common.grid;
        let (_, count) = inside(grid);
        let own = state[number].each_ref().map(|array| at(array, grid, 0));
        let [fx, fy, fz] = force.each_mut().map(|array| at_mut(array, grid));
        for array in [&mut *fx, &mut *fy, &mut *fz] {
            array.fill(0.0);
        }
        gather(grid, number, bonds, |kind, (offset, on), pulls, sign| {
            // Behind, or before.
            let there = if sign > 0.0 { number + on } else { number - on };
            let Some(state) = state.get(there) else {
                return;
            };
            let [ax, ay, az] = own;
            let [bx, by, bz] = state.each_ref().map(|array| at(array, grid, offset));
            let [x, y, z] = common.lattice.vector(kind).map(|part| sign * part);
            let pulls = &pulls[..count];
            if common.is_moved {
                let [px, py, pz] = layers[number].shift.each_ref().map(|s| at(s, grid, 0));
                let [qx, qy, qz] = layers[there].shift.each_ref().map(|s| at(s, grid, offset));
                for i in 0..count {
                    fx[i] += pulls[i] * (x + (qx[i] - px[i]) + (bx[i] - ax[i]));
                    fy[i] += pulls[i] * (y + (qy[i] - py[i]) + (by[i] - ay[i]));
                    fz[i] += pulls[i] * (z + (qz[i] - pz[i]) + (bz[i] - az[i]));
                }
            } else {
                for i in 0..count {
                    fx[i] += pulls[i] * (x + (bx[i] - ax[i]));
                    fy[i] += pulls[i] * (y + (by[i] - ay[i]));
                    fz[i] += pulls[i] * (z + (bz[i] - az[i]));
                }
            }
        });
    }
}

/// Leapfrog of the particles of a layer.
pub(super) struct Move<'a> {
    pub(super) grid: Grid,
    pub(super) layer: &'a Layer,
    pub(super) force: &'a Vector,
    pub(super) step: f64,
    pub(super) before: &'a Vector,
    pub(super) after: &'a mut Vector,
    pub(super) motion: &'a mut Vector,
}

impl pulp::NullaryFnOnce for Move<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let (grid, step) = (&self.grid, self.step);
        let (_, count) = inside(grid);
        let inverse = at(&self.layer.inverse_mass, grid, 0);
        for axis in 0..3 {
            let force = at(&self.force[axis], grid, 0);
            let before = at(&self.before[axis], grid, 0);
            let after = at_mut(&mut self.after[axis], grid);
            let speed = at_mut(&mut self.motion[axis], grid);
            for i in 0..count {
                speed[i] += step * force[i] * inverse[i];
                after[i] = before[i] + step * speed[i];
            }
        }
    }
}
