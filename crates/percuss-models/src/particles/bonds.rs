//! Forces of the bonds of a row of particles to their next neighbours.

use super::{body::RowState, lattice::DIRECTIONS};

/// Smallest square of a bond's length, in squares of the spacing: what is no bond may have any length.
const LEAST_SQUARE: f64 = 1e-12;

/// Constants of all bonds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Springs {
    /// Length at rest [m].
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
#[inline(always)]
pub(super) fn bond(
    springs: &Springs,
    direction: [f64; 2],
    weight: f64,
    a: Pose,
    b: Pose,
) -> BondForce {
    let rest = springs.length;
    let [n_x, n_z] = direction;
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
    let pull = weight * springs.normal * elongation;
    let couple = weight * springs.shear * rest * rest * sine_of_shear * cosine_of_shear;
    let across = couple * inverse;
    BondForce {
        force: [
            pull * along[0] - across * along[1],
            pull * along[1] + across * along[0],
        ],
        moment: 0.5 * couple,
        energy: 0.5 * pull * elongation
            + 0.5 * weight * springs.shear * (rest * sine_of_shear) * (rest * sine_of_shear),
        elongation,
    }
}

/// Forces [N per m] and moments [N m per m] at the places of a row.
#[derive(Debug, Clone, Default)]
pub(super) struct Forces {
    pub(super) x: Vec<f64>,
    pub(super) z: Vec<f64>,
    pub(super) moment: Vec<f64>,
}

impl Forces {
    pub(super) fn new(stride: usize) -> Self {
        let zeros = || vec![0.0; stride];
        Self {
            x: zeros(),
            z: zeros(),
            moment: zeros(),
        }
    }
}

/// Forces of the three kinds of bonds that start in a row.
#[derive(Debug, Clone, Default)]
pub(super) struct RowForces(pub(super) [Forces; 3]);

impl RowForces {
    /// Without forces, for rows of a number of places.
    pub(super) fn new(stride: usize) -> Self {
        Self([0, 1, 2].map(|_| Forces::new(stride)))
    }

    /// Forces between a row and itself and the next one.
    #[inline(always)]
    pub(super) fn compute(
        &mut self,
        springs: &Springs,
        odd: usize,
        weights: &[Vec<f64>; 3],
        row: &RowState,
        next: &RowState,
    ) {
        let [along, right, left] = &mut self.0;
        kind(springs, 0, &weights[0], row, row, 2, along);
        kind(springs, 1, &weights[1], row, next, 1 + odd, right);
        kind(springs, 2, &weights[2], row, next, odd, left);
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

/// One kind of bonds along a row: the second particle of the first bond stands at `start` of the other row.
#[inline(always)]
fn kind(
    springs: &Springs,
    kind: usize,
    weights: &[f64],
    row: &RowState,
    other: &RowState,
    start: usize,
    forces: &mut Forces,
) {
    let direction = DIRECTIONS[kind];
    let count = weights.len() - 2;
    let weights = &weights[1..][..count];
    let (ax, az) = (&row.x[1..][..count], &row.z[1..][..count]);
    let (ac, a_s) = (&row.cosine[1..][..count], &row.sine[1..][..count]);
    let (bx, bz) = (&other.x[start..][..count], &other.z[start..][..count]);
    let (bc, bs) = (
        &other.cosine[start..][..count],
        &other.sine[start..][..count],
    );
    let (fx, fz) = (&mut forces.x[1..][..count], &mut forces.z[1..][..count]);
    let moment = &mut forces.moment[1..][..count];
    for i in 0..count {
        let a = Pose {
            displacement: [ax[i], az[i]],
            turn: [ac[i], a_s[i]],
        };
        let b = Pose {
            displacement: [bx[i], bz[i]],
            turn: [bc[i], bs[i]],
        };
        let found = bond(springs, direction, weights[i], a, b);
        fx[i] = found.force[0];
        fz[i] = found.force[1];
        moment[i] = found.moment;
    }
}
