//! Softening of bonds: their energy, pieces, spall, and what a crack takes.

use super::{displace, solid, strip};
use crate::particles::bonded::Bonded;
use crate::{
    options::FailureCriterion::{self, Elongation, PrincipalStress},
    options::Space,
    particles::{
        body::{Body, Rows},
        fracture::{BondKind, Softening, Softenings, lattice_factor},
        lattice::ROW,
        packing::{Moved, Packing},
    },
    solver::Control,
};

const SPACE: Space = Space::PlaneStress;
const RATIO: f64 = 0.22;
const SPACING: f64 = 1e-3;

fn irregular(seed: u64) -> Packing {
    Packing::Irregular(Moved {
        amplitude: 0.3,
        seed,
    })
}

const fn bonds(irregular: bool, criterion: FailureCriterion) -> BondKind {
    BondKind {
        irregular,
        criterion,
    }
}

const REGULAR: BondKind = bonds(false, Elongation);

/// Lets bonds fail that start to soften at a strain along them.
fn soften(body: &mut Body, strain: f64, end: f64, bonds: BondKind) -> f64 {
    let lattice = body.lattice;
    let elongation = strain * lattice.spacing;
    let of_bond = 0.5 * lattice.normal * elongation * elongation * end;
    let energy = 2.0 * of_bond * lattice_factor(bonds, end) / lattice.spacing;
    let softening = Softening::new(&lattice, energy, end, bonds);
    body.soften(softening, &mut Control::default()).unwrap();
    energy
}

#[test]
fn a_bond_takes_its_energy_and_no_more() {
    for (end, start) in [(1.5, 1.0), (3.0, 1.0), (3.0, 1.4), (10.0, 0.5), (10.0, 2.5)] {
        let lattice = solid(RATIO).lattice(SPACE, SPACING);
        let energy = 20.0;
        let law = Softening::new(&lattice, energy, end, bonds(false, PrincipalStress));
        let first = law.first_elongation(SPACING);
        let (mut worst, mut work, mut before) = (0.0_f64, 0.0, 0.0);
        let (mut booked, mut measure) = (0.0, 0.0);
        let steps = 200_000;
        let step = 1.2 * law.end_of(start) * first / f64::from(steps);
        for i in 1..=steps {
            let elongation = f64::from(i) * step;
            let from = [measure, law.integrity(worst, start)];
            measure = law.measure(SPACING, elongation, 0.0);
            if measure >= start {
                worst = worst.max(measure);
            }
            let left = law.integrity(worst, start);
            booked += law.taken(SPACING, lattice.normal, from, [measure, left]);
            let force = left * lattice.normal * elongation;
            work += 0.5 * (force + before) * step;
            before = force;
        }
        let factor = lattice_factor(bonds(false, PrincipalStress), end);
        let exact = 0.5 * energy * SPACING / factor;
        assert!(
            (work / exact - 1.0).abs() < 1e-6,
            "{end} {start}: {work} {exact}"
        );
        assert!(
            (booked / work - 1.0).abs() < 1e-9,
            "{end} {start}: {booked} {work}"
        );
    }
}

/// Two cuts through a strip leave three pieces of the masses that are made by hand.
#[test]
fn pieces_are_those_between_the_cuts() {
    let mut body = strip(SPACE, RATIO, 9, 31);
    soften(&mut body, 1e-3, 3.0, REGULAR);
    assert_eq!(body.pieces().len(), 1);
    let cuts = [-5.25e-3, 8.25e-3];
    let bonds: Vec<_> = body
        .particles()
        .flat_map(|(row, place)| [0, 1, 2].map(|kind| (row, place, kind)))
        .collect();
    for (row, place, kind) in bonds {
        let (other_row, other) = body.other_end(row, place, kind);
        if other_row >= body.rows.len() {
            continue;
        }
        let ends = [(row, place), (other_row, other)];
        let [a, b] = ends.map(|(row, place)| body.reference(row, place)[0]);
        if cuts.iter().any(|cut| (a - cut) * (b - cut) < 0.0) {
            let damage = &mut body.state[row].damage;
            damage.worst[kind][place] = 3.0;
        }
    }
    let pieces = body.pieces();
    let by_hand = |from: f64, to: f64| {
        let inside = body.particles().filter(|&(row, place)| {
            let x = body.reference(row, place)[0];
            x > from && x < to
        });
        inside
            .map(|(row, place)| body.rows[row].mass[place])
            .sum::<f64>()
    };
    let mut masses = [
        by_hand(-1.0, cuts[0]),
        by_hand(cuts[0], cuts[1]),
        by_hand(cuts[1], 1.0),
    ];
    masses.sort_by(|a, b| b.total_cmp(a));
    assert_eq!(pieces.len(), 3);
    for (piece, mass) in pieces.iter().zip(masses) {
        assert!((piece.mass / mass - 1.0).abs() < 1e-12, "{piece:?} {mass}");
    }
}

/// A strip that is torn apart by its own motion: what motion and springs lose is what the cracks take, within half a percent of it.
#[test]
fn the_energy_balance_closes_while_bonds_break() {
    for (packing, kind) in [
        (Packing::Regular, REGULAR),
        (irregular(2), bonds(true, Elongation)),
        (Packing::Regular, bonds(false, PrincipalStress)),
        (irregular(2), bonds(true, PrincipalStress)),
    ] {
        let lattice = solid(RATIO).lattice(SPACE, SPACING);
        let rows = Rows {
            count: 21,
            particles: 60,
        };
        let mut body = Body::strip(lattice, rows, 0.0, packing, &mut Control::default()).unwrap();
        soften(&mut body, 1e-3, 5.0, kind);
        let particles: Vec<_> = body.particles().collect();
        for (row, place) in particles {
            body.motion[row].x[place] = 1e3 * body.reference(row, place)[0];
        }
        let step = 0.25 * 2.0 / body.measured_frequency(&mut Control::default()).unwrap();
        let start = body.sums(0.0, &[]).kinetic;
        let mut worst: f64 = 0.0;
        for _ in 0..1200 {
            body.advance(step, &[]);
            let sums = body.sums(step, &[]);
            let error = (sums.kinetic + sums.elastic + sums.fracture) / start - 1.0;
            worst = worst.max(error.abs());
        }
        let sums = body.sums(step, &[]);
        println!(
            "{packing:?} {kind:?}: worst {worst:.1e}, fracture {}",
            sums.fracture / start
        );
        assert!(body.pieces().len() > 1, "{}", body.broken_bonds());
        assert!(sums.fracture > 0.02 * start);
        let error = worst * start / sums.fracture;
        assert!(error < 5e-3, "{packing:?}: {error}");
    }
}

/// Impact of a flyer of the same solid on a plate, without a Poisson's ratio: the wave is plane in a strip.
struct Spall {
    rows: usize,
    columns: usize,
    flyer: u32,
    /// Rows over which the velocity of the flyer falls to zero.
    ramp: f64,
    /// Tension that the waves would make, over the strength.
    tension: f64,
    criterion: FailureCriterion,
}

/// What the free face of the plate shows.
struct FreeFace {
    /// Stress of the pull-back `½ ρ c Δu`, over the strength.
    pull_back: f64,
    pieces: usize,
}

impl Spall {
    fn run(&self) -> FreeFace {
        let mut body = strip(SPACE, 0.0, self.rows, self.columns);
        let strain = 1e-3;
        soften(&mut body, strain, 1.2, bonds(false, self.criterion));
        let (density, modulus) = (2500.0_f64, 70e9_f64);
        let speed = (modulus / density).sqrt();
        let strength = match self.criterion {
            // A bond at 30° to the tension softens at a strain of its elongation over `√3/2`.
            Elongation => modulus * strain / ROW,
            PrincipalStress => modulus * strain,
        };
        let velocity = 2.0 * self.tension * strength / (density * speed);
        let particles: Vec<_> = body.particles().collect();
        for (row, place) in particles {
            // A ramp of some rows: a step would ring.
            let along = (row as f64 - f64::from(self.flyer)) / self.ramp + 0.5;
            body.motion[row].z[place] = velocity * (1.0 - along.clamp(0.0, 1.0));
        }
        let step = 0.25 * 2.0 / body.lattice.largest_frequency();
        let length = ROW * SPACING * (self.rows as f64 - 1.0);
        let (mut least, mut time) = (velocity, 0.0);
        // The front takes a time for the target, and the signal of the spall the same again.
        while time < 2.0 * length / speed {
            body.advance(step, &[]);
            time += step;
            let face = body.motion[self.rows - 1].z[self.columns.div_ceil(2)];
            let arrived = time > 0.9 * length / speed;
            least = if arrived { least.min(face) } else { velocity };
            if least < 0.8 * velocity && face > least + 0.1 * velocity {
                break;
            }
        }
        FreeFace {
            pull_back: 0.5 * density * speed * (velocity - least) / strength,
            pieces: body.pieces().len(),
        }
    }
}

/// A plate spalls under a tension of its strength: at 3 % less it holds, at 3 % more it fails, and the free face then slows by `2 σ/(ρ c)`.
#[test]
fn a_plate_spalls_at_its_strength() {
    let of = |tension| Spall {
        criterion: Elongation,
        rows: 1201,
        columns: 5,
        flyer: 400,
        ramp: 400.0,
        tension,
    };
    let (below, above) = (of(0.97).run(), of(1.03).run());
    println!("below {} above {}", below.pull_back, above.pull_back);
    assert_eq!(below.pieces, 1);
    assert!(above.pieces > 1);
    assert!((above.pull_back - 1.0).abs() < 0.03, "{}", above.pull_back);
}

/// By the principal stress it does so between 0.93 and 1 of its strength.
#[test]
fn a_plate_spalls_at_its_strength_by_the_principal_stress() {
    let of = |tension| Spall {
        criterion: PrincipalStress,
        rows: 1201,
        columns: 5,
        flyer: 400,
        ramp: 400.0,
        tension,
    };
    let (below, above) = (of(0.93).run(), of(1.0).run());
    println!("below {} above {}", below.pull_back, above.pull_back);
    assert_eq!(below.pieces, 1);
    assert!(above.pieces > 1);
    assert!((above.pull_back - 0.97).abs() < 0.03, "{}", above.pull_back);
}

/// Bonds of a lattice that is strained evenly start to soften where the larger principal stress is the strength, whatever its direction and the stress
/// across it; by elongation they start far below it under compression.
#[test]
fn the_principal_stress_starts_the_softening_in_any_direction() {
    let (first, second) = solid(RATIO).plane_constants(SPACE);
    let started = |criterion, angle: f64, stresses: [f64; 2]| {
        let mut body = strip(SPACE, RATIO, 13, 15);
        soften(&mut body, 1e-4, 3.0, bonds(false, criterion));
        let strength = body.softening.unwrap().strength;
        // Strains of the principal stresses.
        let [a, b] = stresses.map(|stress| stress * strength);
        let sum = (a + b) / (2.0 * (first + second));
        let [a, b] = [a, b].map(|stress| (stress - first * sum) / (2.0 * second));
        let (sine, cosine) = angle.to_radians().sin_cos();
        let xx = a * cosine * cosine + b * sine * sine;
        let zz = a * sine * sine + b * cosine * cosine;
        let xz = (a - b) * sine * cosine;
        displace(&mut body, |[x, z]| [xx * x + xz * z, xz * x + zz * z]);
        // One step gives the stress, the next one the start.
        let step = 1e-6 / body.lattice.largest_frequency();
        body.advance(step, &[]);
        body.advance(step, &[]);
        let damage = &body.state[6].damage;
        [0, 1, 2].map(|kind| match criterion {
            Elongation => damage.worst[kind][8] > 1.0,
            PrincipalStress => damage.start[kind][8] > 0.0,
        })
    };
    for angle in [0.0, 15.0, 30.0, 77.0] {
        for across in [-3.0, -1.0, 0.0, 0.5] {
            let of = |criterion, part| started(criterion, angle, [part, part * across]);
            assert_eq!(of(PrincipalStress, 0.999), [false; 3], "{angle} {across}");
            assert!(
                of(PrincipalStress, 1.001).contains(&true),
                "{angle} {across}"
            );
        }
    }
    // Plane stress: a bond along the tension is stretched by `(1 + 3 ν) σ/E` where three times the tension presses across.
    let part = 1.0 / (1.0 + 3.0 * RATIO);
    assert_eq!(
        started(Elongation, 0.0, [0.99 * part, -3.0 * 0.99 * part]),
        [false; 3]
    );
    assert!(started(Elongation, 0.0, [1.01 * part, -3.0 * 1.01 * part])[0]);
}

/// Under a tension that would rise beyond the strength, the velocity of the face has the form of a V, and dispersion rounds its tip over a
/// few rows. The pull-back is less by that length over the ramp, and a longer ramp brings it nearer to the strength.
#[test]
fn a_steep_pull_back_is_rounded_over_a_few_rows() {
    for ramp in [32.0, 64.0, 96.0] {
        let found = Spall {
            criterion: Elongation,
            rows: 481,
            columns: 9,
            flyer: 120,
            ramp,
            tension: 1.5,
        };
        let pull_back = found.run().pull_back;
        // The velocity falls by `2·1.5` strengths over the ramp.
        let rows = (1.0 - pull_back) * ramp / 1.5;
        println!("ramp {ramp}: {pull_back}, {rows} rows");
        assert!((3.0..4.5).contains(&rows), "{ramp}: {pull_back} {rows}");
    }
}

/// Clamped strip with a slit, strained across it: energy per area at which the slit runs, over the fracture energy.
fn factor_of_start(packing: Packing, criterion: FailureCriterion, columns: usize, end: f64) -> f64 {
    let kind = bonds(packing != Packing::Regular, criterion);
    let mut lattice = solid(RATIO).lattice(SPACE, SPACING);
    if let Packing::Irregular(moved) = packing {
        lattice = moved.tuned(&lattice);
    }
    let rows = Rows {
        count: 21,
        particles: columns,
    };
    let mut start = Body::strip(lattice, rows, 0.0, packing, &mut Control::default()).unwrap();
    let first = 1e-3;
    let energy = soften(&mut start, first, end, kind) / lattice_factor(kind, end);
    for row in [0, rows.count - 1] {
        start.rows[row].inverse_mass.fill(0.0);
        start.rows[row].inverse_inertia.fill(0.0);
    }
    slit(&mut start);
    let step = 0.4 * 2.0 / start.measured_frequency(&mut Control::default()).unwrap();
    let height = ROW * SPACING * (rows.count as f64 - 1.0);
    let (first, second) = solid(RATIO).plane_constants(SPACE);
    let constant = first + 2.0 * second;
    // Energy per area of a strip that cannot contract: ½ C11 ε² h.
    let strain_of = |factor: f64| (2.0 * factor * energy / (constant * height)).sqrt();
    let (mut low, mut high) = (0.3, 6.0);
    while high / low > 1.01 {
        let factor = f64::sqrt(low * high);
        match runs(&start, strain_of(factor), step) {
            true => high = factor,
            false => low = factor,
        }
    }
    f64::sqrt(low * high)
}

/// Breaks the bonds across the middle of the left third.
fn slit(body: &mut Body) {
    let left = body.origin[0];
    let tip = left / 3.0;
    let middle = 0.5 * ROW * SPACING * (body.rows.len() as f64 - 1.0) + 0.25 * SPACING;
    let particles: Vec<_> = body.particles().collect();
    for (row, place) in particles {
        for kind in 1..3 {
            let (other_row, other) = body.other_end(row, place, kind);
            if other_row >= body.rows.len() || body.rows[row].weights[kind][place] == 0.0 {
                continue;
            }
            let at = |row: usize, place: usize| {
                let column = place as f64 - 1.0 + 0.5 * (row % 2) as f64;
                [left + column * SPACING, row as f64 * ROW * SPACING]
            };
            let (a, b) = (at(row, place), at(other_row, other));
            let crosses = (a[1] - middle) * (b[1] - middle) < 0.0;
            if crosses && 0.5 * (a[0] + b[0]) < tip {
                body.rows[row].weights[kind][place] = 0.0;
            }
        }
    }
}

/// Whether the slit runs in a strip that is strained slowly to a strain.
fn runs(start: &Body, strain: f64, step: f64) -> bool {
    let mut body = start.clone();
    let before = body.broken_bonds();
    displace(&mut body, |[_, z]| [0.0, strain * z]);
    // Without damage at the start: the release of the faces of the slit is damped away.
    let softening = body.softening.take();
    let damped = |body: &mut Body, keep: f64| {
        for motion in &mut body.motion {
            for part in [&mut motion.x, &mut motion.z, &mut motion.spin] {
                part.iter_mut().for_each(|speed| *speed *= keep);
            }
        }
    };
    for _ in 0..400 {
        body.advance(step, &[]);
        damped(&mut body, 0.97);
    }
    body.softening = softening;
    for _ in 0..1500 {
        body.advance(step, &[]);
        damped(&mut body, 0.995);
        if body.broken_bonds() > before + 16 {
            return true;
        }
    }
    false
}

/// The table of lattice factors, along the rows of the lattice.
#[test]
fn a_crack_along_the_rows_takes_the_energy_of_the_table() {
    for (criterion, end) in [
        (Elongation, 1.05),
        (Elongation, 3.0),
        (Elongation, 10.0),
        (PrincipalStress, 3.0),
        (PrincipalStress, 10.0),
    ] {
        let found = factor_of_start(Packing::Regular, criterion, 90, end);
        println!("regular, {criterion:?}, softening {end}: {found}");
        let expected = lattice_factor(bonds(false, criterion), end);
        assert!(
            (found / expected - 1.0).abs() < 0.05,
            "{criterion:?} {end}: {found} {expected}"
        );
    }
}

/// The factor of irregular packings, as the mean over five seeds.
#[test]
fn cracks_through_irregular_packings_take_the_energy_of_the_table() {
    for criterion in [Elongation, PrincipalStress] {
        for end in [3.0, 10.0] {
            let found: Vec<f64> = (1..=5)
                .map(|seed| factor_of_start(irregular(seed), criterion, 90, end))
                .collect();
            let mean = found.iter().sum::<f64>() / found.len() as f64;
            println!("irregular, {criterion:?}, softening {end}: {found:.3?}, mean {mean:.3}");
            let expected = lattice_factor(bonds(true, criterion), end);
            assert!(
                (mean / expected - 1.0).abs() < 0.05,
                "{criterion:?} {end}: {mean} {expected}"
            );
        }
    }
}

/// The spacing that is advised has the least softening, with the energy and the strength of the solid.
#[test]
fn the_fitting_spacing_has_the_least_softening() {
    for bonds in [Elongation, PrincipalStress].map(|criterion| bonds(true, criterion)) {
        let factor = |softening: f64| lattice_factor(bonds, softening);
        for product in [0.5, 2.0, 5.0, 7.0] {
            let coarse = Softenings::of(product, factor, None);
            // The product is as one over the spacing.
            let fitting = Softenings::of(product / coarse.fitting, factor, None);
            assert!((fitting.fitting - 1.0).abs() < 1e-12, "{bonds:?} {product}");
            assert!(
                (fitting.used - 3.0).abs() < 1e-3,
                "{bonds:?} {}",
                fitting.used
            );
        }
    }
}
