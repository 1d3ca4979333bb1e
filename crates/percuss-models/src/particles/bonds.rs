//! Forces of the bonds of a row of particles to their next neighbours.

use super::{
    fracture::Softening,
    lattice::DIRECTIONS,
    row::{Damage, RowMake, RowState},
};
use crate::lanes::larger;

/// Smallest square of a bond's length, in squares of the spacing: what is no bond may have any length.
const LEAST_SQUARE: f64 = 1e-12;

/// Constants of all bonds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Springs {
    /// Length at rest on the regular lattice [m].
    pub(super) length: f64,
    /// Stiffness of the normal spring [N/m per m].
    pub(super) normal: f64,
    /// Stiffness of the shear spring [N/m per m].
    pub(super) shear: f64,
}

/// Force on the first particle of a bond and moment on both.
#[derive(Debug, Clone, Copy)]
pub(super) struct BondForce {
    pub(super) force: [f64; 2],
    pub(super) moment: f64,
    /// Energy of both springs [J per m].
    pub(super) energy: f64,
    /// Elongation [m].
    pub(super) elongation: f64,
    /// State of its damage.
    pub(super) damage: BondDamage,
}

/// Deformations of both springs of a bond, in elongations at which one along the tension starts to soften.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct BondDamage {
    /// Largest one with an elongation since it started to soften.
    pub(super) worst: f64,
    /// Present one.
    pub(super) measure: f64,
    /// At which it starts to soften; by the principal stress at which it did, and 0 before.
    pub(super) start: f64,
}

/// A bond at rest.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rest {
    /// Direction to its second particle.
    pub(super) direction: [f64; 2],
    /// Length [m].
    pub(super) length: f64,
    /// Share of its springs.
    pub(super) weight: f64,
}

/// Displacement, and cosine and sine of the rotation of a particle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pose {
    pub(super) displacement: [f64; 2],
    pub(super) turn: [f64; 2],
}

/// Bond between two particles, with its weight: the shares of its springs that are there.
///
/// `V = ½ k_n (l − d)² + ½ k_s d² sin²γ`, where γ is the angle of the bond to its direction at rest, turned by the mean rotation of
/// its ends. Differences of displacements alone enter, so that small strains keep all their digits.
///
/// A stretched bond starts to soften at its first elongation, or where the `tension` of an end, in the stress of that start, has come to 1. It then
/// loses the part `1 − D` of its springs, except of the normal one under pressure; `before` is the state of its damage a step ago.
#[inline(always)]
pub(super) fn bond(
    springs: &Springs,
    softening: Option<&Softening>,
    bond: Rest,
    before: BondDamage,
    tension: f64,
    a: Pose,
    b: Pose,
) -> BondForce {
    let Rest {
        direction: [n_x, n_z],
        length: rest,
        weight,
    } = bond;
    let x = b.displacement[0] - a.displacement[0];
    let z = b.displacement[1] - a.displacement[1];
    // l² − d² = 2 d n·Δu + Δu².
    let excess = 2.0 * rest * (n_x * x + n_z * z) + (x * x + z * z);
    let square = (rest * rest + excess).max(LEAST_SQUARE * rest * rest);
    let length = square.sqrt();
    let inverse = 1.0 / length;
    let elongation = excess / (length + rest);
    let along = [(rest * n_x + x) * inverse, (rest * n_z + z) * inverse];
    let turn = [a.turn[0] + b.turn[0], a.turn[1] + b.turn[1]];
    let norm = 1.0 / (turn[0] * turn[0] + turn[1] * turn[1]).sqrt();
    let [cosine, sine] = [turn[0] * norm, turn[1] * norm];
    let turned = [cosine * n_x - sine * n_z, sine * n_x + cosine * n_z];
    let sine_of_shear = (turned[0] * z - turned[1] * x - rest * sine) * inverse;
    let cosine_of_shear = turned[0] * along[0] + turned[1] * along[1];
    let (mut normal, mut shear) = (weight * springs.normal, weight * springs.shear);
    let mut damage = before;
    if let Some(softening) = softening {
        damage.measure = softening.measure(rest, elongation, rest * sine_of_shear);
        let stretched = elongation > 0.0;
        if softening.by_stress {
            let starts = stretched & (tension >= 1.0) & (before.start == 0.0);
            damage.start = if starts { damage.measure } else { before.start };
        }
        let softens = stretched & (damage.start > 0.0);
        damage.worst = larger(before.worst, if softens { damage.measure } else { 0.0 });
        let integrity = softening.integrity(damage.worst, damage.start);
        shear *= integrity;
        normal *= if stretched { integrity } else { 1.0 };
    }
    let pull = normal * elongation;
    let couple = shear * rest * rest * sine_of_shear * cosine_of_shear;
    let across = couple * inverse;
    BondForce {
        force: [
            pull * along[0] - across * along[1],
            pull * along[1] + across * along[0],
        ],
        moment: 0.5 * couple,
        energy: 0.5 * pull * elongation
            + 0.5 * shear * (rest * sine_of_shear) * (rest * sine_of_shear),
        elongation,
        damage,
    }
}

/// Forces [N per m] and moments [N m per m] at the places of a row.
#[derive(Debug, Clone, Default)]
pub(super) struct Forces {
    pub(super) x: Vec<f64>,
    pub(super) z: Vec<f64>,
    pub(super) moment: Vec<f64>,
    /// Products of forces and the bonds along which they act, `xx`, `zz` and the mean of `xz` and `zx` [N m per m]; empty where no bond fails by
    /// its stress.
    pub(super) virial: [Vec<f64>; 3],
}

impl Forces {
    pub(super) fn new(stride: usize, by_stress: bool) -> Self {
        let zeros = || vec![0.0; stride];
        Self {
            x: zeros(),
            z: zeros(),
            moment: zeros(),
            virial: [0, 1, 2].map(|_| if by_stress { zeros() } else { Vec::new() }),
        }
    }
}

/// Forces of the three kinds of bonds that start in a row, and the state of their damage where they soften.
#[derive(Debug, Clone, Default)]
pub(super) struct RowForces {
    pub(super) of: [Forces; 3],
    pub(super) damage: Damage,
}

impl RowForces {
    /// Without forces, for rows of a number of places.
    pub(super) fn new(stride: usize, softening: Option<&Softening>) -> Self {
        let places = if softening.is_some() { stride } else { 0 };
        let by_stress = softening.is_some_and(|law| law.by_stress);
        Self {
            of: [0, 1, 2].map(|_| Forces::new(stride, by_stress)),
            damage: Damage::new(places, by_stress),
        }
    }
}

/// A row of particles and the next one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair<'a> {
    pub(super) springs: &'a Springs,
    pub(super) softening: Option<&'a Softening>,
    /// 1 in an odd row, 0 in an even one.
    pub(super) odd: usize,
    pub(super) make: &'a RowMake,
    pub(super) row: &'a RowState,
    pub(super) next: &'a RowState,
    /// Larger principal stresses around the particles of both; empty where no bond fails by its stress.
    pub(super) tension: [&'a [f64]; 2],
}

impl Pair<'_> {
    /// Forces between a row and itself and the next one.
    #[inline(always)]
    pub(super) fn compute(&self, forces: &mut RowForces) {
        // Six loops: what a body has not costs nothing.
        let by_stress = self.softening.map(|law| law.by_stress);
        match (by_stress, self.make.is_moved()) {
            (None, false) => self.kinds::<false, false, false>(forces),
            (None, true) => self.kinds::<false, false, true>(forces),
            (Some(false), false) => self.kinds::<true, false, false>(forces),
            (Some(false), true) => self.kinds::<true, false, true>(forces),
            (Some(true), false) => self.kinds::<true, true, false>(forces),
            (Some(true), true) => self.kinds::<true, true, true>(forces),
        }
    }

    #[inline(always)]
    fn kinds<const SOFTENS: bool, const BY_STRESS: bool, const MOVED: bool>(
        &self,
        forces: &mut RowForces,
    ) {
        let odd = self.odd;
        self.kind::<SOFTENS, BY_STRESS, MOVED>((0, 2), self.row, forces);
        self.kind::<SOFTENS, BY_STRESS, MOVED>((1, 1 + odd), self.next, forces);
        self.kind::<SOFTENS, BY_STRESS, MOVED>((2, odd), self.next, forces);
    }

    /// One kind of bonds along a row: the second particle of the first bond stands at `start` of the other row.
    #[inline(always)]
    fn kind<const SOFTENS: bool, const BY_STRESS: bool, const MOVED: bool>(
        &self,
        (kind, start): (usize, usize),
        other: &RowState,
        forces: &mut RowForces,
    ) {
        let (damage, forces) = (&mut forces.damage, &mut forces.of[kind]);
        let (row, make) = (self.row, self.make);
        let count = make.mass.len() - 2;
        let weights = &make.weights[kind][1..][..count];
        let (ax, az) = (&row.x[1..][..count], &row.z[1..][..count]);
        let (ac, a_s) = (&row.cosine[1..][..count], &row.sine[1..][..count]);
        let (bx, bz) = (&other.x[start..][..count], &other.z[start..][..count]);
        let (bc, bs) = (
            &other.cosine[start..][..count],
            &other.sine[start..][..count],
        );
        let (fx, fz) = (&mut forces.x[1..][..count], &mut forces.z[1..][..count]);
        let moment = &mut forces.moment[1..][..count];
        let rests = &make.rests[kind];
        let moved = |array| inside::<MOVED>(array, count);
        let (nx, nz, lengths) = (moved(&rests.x), moved(&rests.z), moved(&rests.length));
        let (worst, began) = (
            inside::<SOFTENS>(&row.damage.worst[kind], count),
            inside::<BY_STRESS>(&row.damage.start[kind], count),
        );
        let worsts = inside_mut::<SOFTENS>(&mut damage.worst[kind], count);
        let measures = inside_mut::<SOFTENS>(&mut damage.measure[kind], count);
        let starts = inside_mut::<BY_STRESS>(&mut damage.start[kind], count);
        let [xx, zz, xz] = forces
            .virial
            .each_mut()
            .map(|virial| inside_mut::<BY_STRESS>(virial, count));
        let tension = inside::<BY_STRESS>(self.tension[0], count);
        let other_tension = match BY_STRESS {
            true => &self.tension[usize::from(kind > 0)][start..][..count],
            false => &[],
        };
        // Known here, it costs the loops nothing.
        let by_stress = BY_STRESS;
        let softening = self.softening.map(|law| law.with_criterion(by_stress));
        let softening = if SOFTENS { softening.as_ref() } else { None };
        for i in 0..count {
            let a = Pose {
                displacement: [ax[i], az[i]],
                turn: [ac[i], a_s[i]],
            };
            let b = Pose {
                displacement: [bx[i], bz[i]],
                turn: [bc[i], bs[i]],
            };
            let (direction, length) = match MOVED {
                true => ([nx[i], nz[i]], lengths[i]),
                false => (DIRECTIONS[kind], self.springs.length),
            };
            let rest = Rest {
                direction,
                length,
                weight: weights[i],
            };
            let (mut damage, mut largest) = (BondDamage::default(), 0.0);
            if SOFTENS {
                (damage.worst, damage.start) = (worst[i], 1.0);
            }
            if BY_STRESS {
                damage.start = began[i];
                largest = larger(tension[i], other_tension[i]);
            }
            let found = bond(self.springs, softening, rest, damage, largest, a, b);
            let [x, z] = found.force;
            (fx[i], fz[i], moment[i]) = (x, z, found.moment);
            if SOFTENS {
                worsts[i] = found.damage.worst;
                measures[i] = found.damage.measure;
            }
            if BY_STRESS {
                starts[i] = found.damage.start;
                let [along_x, along_z] = direction.map(|part| part * length);
                xx[i] = x * along_x;
                zz[i] = z * along_z;
                xz[i] = 0.5 * (x * along_z + z * along_x);
            }
        }
    }
}

/// Place in a row of the second particle of a bond of a kind, less that of the first.
pub(super) fn offset(kind: usize, odd: usize) -> isize {
    match kind {
        0 => 1,
        1 => odd as isize,
        _ => odd as isize - 1,
    }
}

/// The places of particles in a row, of an array that is there.
#[inline(always)]
fn inside<const IS_THERE: bool>(array: &[f64], count: usize) -> &[f64] {
    if IS_THERE { &array[1..][..count] } else { &[] }
}

/// The same of an array that is written.
#[inline(always)]
fn inside_mut<const IS_THERE: bool>(array: &mut [f64], count: usize) -> &mut [f64] {
    if IS_THERE {
        &mut array[1..][..count]
    } else {
        &mut []
    }
}
