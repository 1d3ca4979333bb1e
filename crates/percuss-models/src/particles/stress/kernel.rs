//! Deformation gradients, stresses and forces of eight particles.

use super::{
    ring::{RING, ROWS, Ring, places},
    state::{StressRow, Taken},
};
use crate::{
    lanes::{Lanes, each_of, lanes, larger, load, settled, smaller},
    particles::row::RowState,
    solid::{Law, MaterialPoints, Rates},
};

/// What the neighbours of eight particles say of their deformation.
#[derive(Debug, Clone, Copy)]
pub(super) struct Deformation {
    /// Displacement gradient.
    pub(super) gradient: [Lanes; 4],
    /// Sum over the neighbours of the distance from where the gradient puts them, times their vector before the impact [m2].
    skew: [Lanes; 4],
    /// Sum of the squares of those distances [m2].
    pub(super) misfit: Lanes,
}

/// Displacements of the particles from a place on, less those of the neighbours.
#[inline(always)]
pub(super) fn differences(
    states: [&RowState; 3],
    place: usize,
    odd: usize,
) -> ([Lanes; RING], [Lanes; RING]) {
    let own = [load(&states[1].x, place), load(&states[1].z, place)];
    let places = places(place, odd);
    let (mut x, mut z) = ([Lanes::all(0.0); RING], [Lanes::all(0.0); RING]);
    for k in 0..RING {
        let state = states[ROWS[k]];
        let (other_x, other_z) = (load(&state.x, places[k]), load(&state.z, places[k]));
        x[k] = lanes(|l| other_x[l] - own[0][l]);
        z[k] = lanes(|l| other_z[l] - own[1][l]);
    }
    (x, z)
}

impl Deformation {
    /// The average of the gradients of the triangles around each particle, and what it leaves of the displacements.
    #[inline(always)]
    pub(super) fn of(
        ring: &Ring,
        (x, z): &([Lanes; RING], [Lanes; RING]),
        per_volume: &Lanes,
    ) -> Self {
        let [xx, xz, zx, zz, skew_xx, skew_xz, skew_zx, skew_zz, misfit] = each_of(|l| {
            let (mut gradient, mut products, mut inertia) = ([0.0; 4], [0.0; 4], [0.0; 3]);
            let mut squares = 0.0;
            for k in 0..RING {
                let [b_x, b_z] = ring.own_edge(k, l);
                let (u, w) = (x[k][l], z[k][l]);
                gradient[0] += u * b_x;
                gradient[1] += u * b_z;
                gradient[2] += w * b_x;
                gradient[3] += w * b_z;
                let bond = ring.bond[k][l];
                let (r_x, r_z) = (ring.x[k][l], ring.z[k][l]);
                let (along_x, along_z) = (bond * r_x, bond * r_z);
                products[0] += u * along_x;
                products[1] += u * along_z;
                products[2] += w * along_x;
                products[3] += w * along_z;
                inertia[0] += r_x * along_x;
                inertia[1] += r_x * along_z;
                inertia[2] += r_z * along_z;
                squares += bond * (u * u + w * w);
            }
            let per_volume = per_volume[l];
            let [xx, xz, zx, zz] = [
                per_volume * gradient[0],
                per_volume * gradient[1],
                per_volume * gradient[2],
                per_volume * gradient[3],
            ];
            let [i_xx, i_xz, i_zz] = inertia;
            let fitted = [
                xx * i_xx + xz * i_xz,
                xx * i_xz + xz * i_zz,
                zx * i_xx + zz * i_xz,
                zx * i_xz + zz * i_zz,
            ];
            // Of `Σ |Δu − G r|²` the middle term has twice the products.
            let along = xx * (2.0 * products[0] - fitted[0])
                + xz * (2.0 * products[1] - fitted[1])
                + zx * (2.0 * products[2] - fitted[2])
                + zz * (2.0 * products[3] - fitted[3]);
            [
                xx,
                xz,
                zx,
                zz,
                products[0] - fitted[0],
                products[1] - fitted[1],
                products[2] - fitted[2],
                products[3] - fitted[3],
                larger(squares - along, 0.0),
            ]
        });
        Self {
            gradient: [xx, xz, zx, zz],
            skew: [skew_xx, skew_xz, skew_zx, skew_zz],
            misfit,
        }
    }

    /// First Piola–Kirchhoff stresses of Cauchy stresses `[xx, zz, xz]`, with what the stabilisation adds.
    #[inline(always)]
    pub(super) fn piola(
        &self,
        cauchy: &[Lanes; 3],
        stiffness: &Lanes,
        per_volume: &Lanes,
    ) -> [Lanes; 4] {
        let ([g_xx, g_xz, g_zx, g_zz], skew) = (&self.gradient, &self.skew);
        each_of(|l| {
            let (f_xx, f_zz) = (1.0 + g_xx[l], 1.0 + g_zz[l]);
            let (xx, zz, xz) = (cauchy[0][l], cauchy[1][l], cauchy[2][l]);
            let stabilising = stiffness[l] * per_volume[l];
            [
                (xx * f_zz - xz * g_xz[l]) - stabilising * skew[0][l],
                (xz * f_xx - xx * g_zx[l]) - stabilising * skew[1][l],
                (xz * f_zz - zz * g_xz[l]) - stabilising * skew[2][l],
                (zz * f_xx - xz * g_zx[l]) - stabilising * skew[3][l],
            ]
        })
    }
}

/// Determinants of deformation gradients.
#[inline(always)]
pub(super) fn volumes([xx, xz, zx, zz]: &[Lanes; 4]) -> Lanes {
    lanes(|l| (1.0 + xx[l]) * (1.0 + zz[l]) - xz[l] * zx[l])
}

/// Brings the material of eight particles from one displacement gradient to the next; gives the Cauchy stresses `[xx, zz, xz]` with the artificial
/// viscosity [Pa], and adds up what the step took in each lane: work, plastic, viscous.
#[inline(always)]
pub(super) fn strain(
    law: &Law,
    points: &mut MaterialPoints,
    (before, after): (&[Lanes; 4], &[Lanes; 4]),
    volume: &Lanes,
    (step, size): (f64, &Lanes),
    taken: &mut [Lanes; 3],
) -> [Lanes; 3] {
    let (old, new) = (volumes(before), volumes(after));
    points.volume = lanes(|l| volume[l] * old[l]);
    let per_step = 1.0 / step;
    // With this rate the step ends at the very volume of the gradient.
    let expansion = lanes(|l| 2.0 * per_step * (new[l] - old[l]) / (new[l] + old[l]));
    // The increment over the gradient half-way gives the strain to third order, and none for a rotation.
    let rate = settled(each_of(|l| {
        let half = |part: usize| 0.5 * (before[part][l] + after[part][l]);
        let change = |part: usize| after[part][l] - before[part][l];
        let (xx, xz, zx, zz) = (1.0 + half(0), half(1), half(2), 1.0 + half(3));
        let scale = per_step / (xx * zz - xz * zx);
        [
            scale * (change(0) * zz - change(1) * zx),
            scale * (change(1) * xx - change(0) * xz),
            scale * (change(2) * zz - change(3) * zx),
            scale * (change(3) * xx - change(2) * xz),
        ]
    }));
    let rates = Rates::half_way(&rate, expansion);
    let work = law.deform(points, &rates, step, size);
    for (sum, more) in taken
        .iter_mut()
        .zip([work.total, work.plastic, work.viscous])
    {
        let before = *sum;
        *sum = lanes(|l| before[l] + more[l]);
    }
    let pressure = points.whole_pressure();
    let [xx, zz, xz] = points.deviator;
    [
        lanes(|l| xx[l] - pressure[l]),
        lanes(|l| zz[l] - pressure[l]),
        xz,
    ]
}

/// Stiffness of the stabilisation after a step: in plastic flow that of an elastic body of the secant shear modulus, if it is less than before.
#[inline(always)]
pub(super) fn softened(
    law: &Law,
    points: &MaterialPoints,
    strain_before: &Lanes,
    (now, elastic): (&Lanes, f64),
) -> Lanes {
    let modulus = 3.0 * law.shear_modulus;
    let (strain, deviator) = (points.plastic_strain, points.deviator);
    lanes(|l| {
        let stress = crate::solver::equivalent(&[deviator[0][l], deviator[1][l], deviator[2][l]]);
        let secant = elastic * (stress / (stress + modulus * strain[l]));
        if strain[l] > strain_before[l] {
            smaller(now[l], secant)
        } else {
            now[l]
        }
    })
}

/// Forces of the stresses and of the stabilisation on eight particles `[x, z]` [N per m].
#[inline(always)]
pub(super) fn forces(
    ring: &Ring,
    is_whole: bool,
    states: [&RowState; 3],
    rows: [&StressRow; 3],
    place: usize,
    odd: usize,
) -> [Lanes; 2] {
    let (x, z) = differences(states, place, odd);
    let places = places(place, odd);
    let own = rows[1];
    let stiffness = load(&own.stiffness, place);
    let gradient = own.gradients(place);
    let mut force = [Lanes::all(0.0); 2];
    for k in 0..RING {
        let row = rows[ROWS[k]];
        let at = places[k];
        let other = load(&row.stiffness, at);
        let other_gradient = row.gradients(at);
        let stress = [0, 1, 2, 3].map(|part| load(&row.stress[part], at));
        let before = force;
        force = each_of(|l| {
            let [c_x, c_z] = ring.edge_at_neighbour(k, l);
            let (r_x, r_z) = (ring.x[k][l], ring.z[k][l]);
            let bond = ring.bond[k][l];
            let both = stiffness[l] + other[l];
            let fit =
                |part: usize| stiffness[l] * gradient[part][l] + other[l] * other_gradient[part][l];
            let pull_x = both * x[k][l] - (fit(0) * r_x + fit(1) * r_z);
            let pull_z = both * z[k][l] - (fit(2) * r_x + fit(3) * r_z);
            [
                before[0][l] + (bond * pull_x - (stress[0][l] * c_x + stress[1][l] * c_z)),
                before[1][l] + (bond * pull_z - (stress[2][l] * c_x + stress[3][l] * c_z)),
            ]
        });
    }
    if is_whole {
        // Edges that close a ring add up to nothing.
        return force;
    }
    let stress = [0, 1, 2, 3].map(|part| load(&own.stress[part], place));
    each_of(|l| {
        let (mut sum_x, mut sum_z) = (0.0, 0.0);
        for k in 0..RING {
            let [b_x, b_z] = ring.own_edge(k, l);
            sum_x += b_x;
            sum_z += b_z;
        }
        [
            force[0][l] + (stress[0][l] * sum_x + stress[1][l] * sum_z),
            force[1][l] + (stress[2][l] * sum_x + stress[3][l] * sum_z),
        ]
    })
}

impl Taken {
    /// Adds what the lanes took: work, plastic, viscous, and what the stabilisation lost.
    pub(super) fn add(&mut self, lanes: &[Lanes; 3], softened: &Lanes) {
        let [work, plastic, viscous] = lanes.map(|sum| sum.iter().sum::<f64>());
        self.work += work;
        self.plastic += plastic;
        self.viscous += viscous;
        self.softened += softened.iter().sum::<f64>();
    }
}
