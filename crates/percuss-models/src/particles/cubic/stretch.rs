//! Elongations of the bonds of a layer, and their damage.

use super::{
    super::fracture::Softening,
    body::{Bonds, Change, Damage},
    kernels::{Common, Next, at, at_mut, inside, law},
    lattice::{KINDS, relative},
};
use crate::lanes::larger;

/// Smallest square of a bond's length, in squares of that at rest.
const LEAST_SQUARE: f64 = 1e-12;

/// Layers that are computed at once, with what they need.
pub(super) struct Stretch<'a> {
    pub(super) common: Common<'a>,
    pub(super) next: Next<'a>,
    pub(super) bonds: &'a mut Bonds,
    pub(super) damage: &'a mut Damage,
}

impl pulp::NullaryFnOnce for Stretch<'_> {
    type Output = ();

    /// Elongations of the bonds that start in the layer, their damage, and what they add to the change of volume of their ends.
    #[inline(always)]
    fn call(self) {
        let Self {
            common,
            next,
            bonds,
            damage,
        } = self;
        for kind in 0..KINDS {
            match (common.softening.is_some(), common.is_moved) {
                (false, false) => stretch::<false, false>(common, next, kind, bonds, damage),
                (false, true) => stretch::<false, true>(common, next, kind, bonds, damage),
                (true, false) => stretch::<true, false>(common, next, kind, bonds, damage),
                (true, true) => stretch::<true, true>(common, next, kind, bonds, damage),
            }
        }
    }
}

#[inline(always)]
fn stretch<const SOFTENS: bool, const MOVED: bool>(
    common: Common<'_>,
    next: Next<'_>,
    kind: usize,
    bonds: &mut Bonds,
    damage: &mut Damage,
) {
    let grid = &common.grid;
    let (offset, on) = grid.offset(kind, next.number);
    let (_, count) = inside(grid);
    let [x, y, z] = common.lattice.vector(kind);
    let rest_square = x * x + y * y + z * z;
    let rest_length = rest_square.sqrt();
    let [ax, ay, az] = next.state[0].each_ref().map(|array| at(array, grid, 0));
    let [bx, by, bz] = next.state[on]
        .each_ref()
        .map(|array| at(array, grid, offset));
    let moved = |array, offset| if MOVED { at(array, grid, offset) } else { &[] };
    let [px, py, pz] = next.layers[0].shift.each_ref().map(|array| moved(array, 0));
    let other = match next.layers[on].shift[0].is_empty() {
        true => &next.layers[0].shift,
        false => &next.layers[on].shift,
    };
    let [qx, qy, qz] = other.each_ref().map(|array| moved(array, offset));
    let rests = moved(&next.layers[0].rests[kind], 0);
    let weights = at(&next.layers[0].weights[kind], grid, 0);
    let softening = common.softening.map(|laws| *law(laws, kind));
    let worst = if SOFTENS {
        at_mut(&mut damage.worst[kind], grid)
    } else {
        &mut []
    };
    let elongation = at_mut(&mut bonds.elongation[kind], grid);
    let fresh = at_mut(&mut bonds.pull[kind], grid);
    let mut grown = 0.0_f64;
    for i in 0..count {
        let (u, v, w) = (bx[i] - ax[i], by[i] - ay[i], bz[i] - az[i]);
        let (mut rx, mut ry, mut rz) = (x, y, z);
        let (mut square, mut length) = (rest_square, rest_length);
        if MOVED {
            (rx, ry, rz) = (
                x + (qx[i] - px[i]),
                y + (qy[i] - py[i]),
                z + (qz[i] - pz[i]),
            );
            length = rests[i];
            square = length * length;
        }
        // l² − d² = 2 d·Δu + Δu².
        let excess = 2.0 * (rx * u + ry * v + rz * w) + (u * u + v * v + w * w);
        let now = larger(square + excess, LEAST_SQUARE * square).sqrt();
        fresh[i] = excess / (now + length);
        if SOFTENS && let Some(law) = &softening {
            grown = larger(grown, over(law, length, fresh[i], weights[i], worst[i]));
        }
    }
    let length_of = |i: usize| if MOVED { rests[i] } else { rest_length };
    // Few bonds soften in a step.
    if SOFTENS
        && grown > 0.0
        && let Some(law) = &softening
    {
        let [own, other] = [(0, 0), (on, offset)]
            .map(|(on, offset): (usize, isize)| at(next.volume_pull[on], grid, offset));
        for i in 0..count {
            if over(law, length_of(i), fresh[i], weights[i], worst[i]) <= 0.0 {
                continue;
            }
            let measure = law.measure(length_of(i), fresh[i], 0.0);
            damage.changes.push(Change {
                kind,
                place: inside(grid).0 + i,
                damage: law.integrity(worst[i], 1.0) - law.integrity(measure, 1.0),
                elongations: [elongation[i], fresh[i]],
                volume_pull: own[i] + other[i],
            });
            worst[i] = measure;
        }
    }
    let share = relative(kind);
    for i in 0..count {
        let mut part = share * weights[i] * fresh[i] * length_of(i);
        if SOFTENS && let Some(law) = &softening {
            part *= law.integrity(worst[i], 1.0);
        }
        (elongation[i], fresh[i]) = (fresh[i], part);
    }
}

/// How far a bond is beyond its largest deformation and beyond the start of its softening.
#[inline(always)]
fn over(law: &Softening, length: f64, elongation: f64, weight: f64, worst: f64) -> f64 {
    let measure = law.measure(length, elongation, 0.0);
    let is_pulled = (elongation > 0.0) & (weight > 0.0);
    let beyond = measure - larger(worst, 1.0);
    if is_pulled { beyond } else { 0.0 }
}
