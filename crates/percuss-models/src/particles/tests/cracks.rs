//! Notches, and what is followed of cracks.

use crate::particles::bonded::Bonded;
use std::f64::consts::PI;

use super::{solid, strip};
use crate::{
    options::{FailureCriterion, Space},
    particles::{
        body::{Body, Rows},
        cracks::{Front, Notches},
        fields,
        fracture::{BondKind, Softening},
        lattice::ROW,
        packing::Packing,
        slot::Slot,
    },
    solver::Control,
};

const REGULAR: BondKind = BondKind {
    irregular: false,
    criterion: FailureCriterion::Elongation,
};
const SPACE: Space = Space::PlaneStress;
const RATIO: f64 = 0.22;
/// Spacing of [`strip`] [m].
const SPACING: f64 = 1e-3;

/// A strip of 31 mm by 8 rows whose bonds can break.
fn brittle() -> Body {
    let mut body = strip(SPACE, RATIO, 9, 31);
    soften(&mut body);
    body
}

fn soften(body: &mut Body) {
    let law = Softening::new(&body.lattice, 20.0, 3.0, REGULAR);
    body.soften(law, &mut Control::default()).unwrap();
}

/// A cut from face to face leaves two pieces, a shorter one leaves the body whole; a notch is no crack.
#[test]
fn a_notch_cuts_the_bonds_that_it_crosses_and_no_others() {
    let depth = 8.0 * ROW * SPACING;
    let place = 4.25 * SPACING;
    for (end, pieces) in [(2.0 * depth, 2), (0.5 * depth, 1)] {
        let mut body = brittle();
        let ends = [[place, -depth], [place, end]];
        body.cut(ends);
        let notches = Notches::of(&body, &[(ends, false)]);
        let mut front = Front::default();
        front.follow(&body, &notches, 1e-6);
        let cracks = front.results(&body, &notches);
        assert_eq!((cracks.broken_bonds, cracks.pieces), (0, pieces));
        assert_eq!(
            (cracks.length, cracks.tip_speed, cracks.angle),
            (Some(0.0), None, None)
        );
        // In files the same bonds are broken, between the particles as numbered there.
        let shown: Vec<_> = fields::bonds(&body, 100).collect();
        let numbers: Vec<(usize, usize)> = body.particles().collect();
        assert_eq!(shown.len(), body.bonds().count());
        for (bond, shown) in body.bonds().zip(shown) {
            let ends = shown.ends.map(|end| numbers[end as usize - 100]);
            assert_eq!(ends, body.ends(bond));
            assert_eq!(shown.damage == 1.0, body.is_broken(bond));
            let [a, b] = ends.map(|(row, place)| body.reference(row, place));
            let at = (place - a[0]) / (b[0] - a[0]);
            let crosses = (0.0..1.0).contains(&at) && a[1] + at * (b[1] - a[1]) <= end;
            assert_eq!(body.is_broken(bond), crosses, "{a:?} {b:?}");
        }
    }
}

/// A straight crack from the tip of a notch has its length, within a spacing, and goes straight on.
#[test]
fn a_straight_crack_has_its_length_and_angle() {
    let mut body = brittle();
    let depth = 8.0 * ROW * SPACING;
    let place = 4.25 * SPACING;
    let notch = [[place, -SPACING], [place, 0.4 * depth]];
    body.cut(notch);
    let notches = Notches::of(&body, &[(notch, false)]);
    body.cut([notch[1], [place, 2.0 * depth]]);
    let mut front = Front::default();
    front.follow(&body, &notches, 1e-6);
    let cracks = front.results(&body, &notches);
    let length = 0.6 * depth;
    // Bonds on the faces of a strip have half the weight: a cut takes as many as a straight crack, within the lattice's factor.
    assert!((front.reach - length).abs() < SPACING, "{}", front.reach);
    assert!(
        (0.7..1.5).contains(&(cracks.length.unwrap() / length)),
        "{}",
        cracks.length.unwrap() / length
    );
    assert!(cracks.angle.unwrap() < 0.15, "{:?}", cracks.angle);
    assert_eq!(cracks.pieces, 2);
}

/// A notch outside of the body cuts nothing, and is found.
#[test]
fn a_notch_that_cuts_nothing_is_found() {
    let mut body = brittle();
    let place = 4.25 * SPACING;
    let ends = [
        [[1.0, 0.0], [1.0, 1e-3]],
        [[place, -SPACING], [place, 1e-3]],
    ];
    body.cut(ends[1]);
    let cuts = ends.map(|ends| (ends, false));
    assert_eq!(Notches::of(&body, &cuts).idle(&body), [1]);
    let slots = ends.map(|ends| (ends, true));
    assert_eq!(Notches::of(&body, &slots).idle(&body), [1]);
}

/// No particle stands in a slot, all others do; a crack from its tip starts there.
#[test]
fn a_slot_is_empty_and_its_crack_starts_at_the_tip() {
    let lattice = solid(RATIO).lattice(SPACE, SPACING);
    let rows = Rows {
        count: 41,
        particles: 60,
    };
    let whole = Body::strip(
        lattice,
        rows,
        0.0,
        Packing::Regular,
        &mut Control::default(),
    )
    .unwrap();
    let (width, tip) = (2.5 * SPACING, [4.0 * SPACING, 20.0 * ROW * SPACING]);
    let ends = [[tip[0], -width], tip];
    let slots = [Slot::new(ends, width)];
    let control = &mut Control::default();
    let mut body =
        Body::slotted_strip(lattice, rows, 0.0, Packing::Regular, &slots, control).unwrap();
    let in_slot = |[x, z]: [f64; 2]| {
        let below = z - (tip[1] - 0.5 * width);
        (x - tip[0]).hypot(below.max(0.0)) < 0.5 * width
    };
    let (mut empty, mut kept) = (0, 0);
    for (row, place) in whole.particles() {
        let at = whole.reference(row, place);
        let is_there = body.rows[row].mass[place] > 0.0;
        assert_eq!(is_there, !in_slot(at), "{at:?}");
        empty += usize::from(!is_there);
        kept += usize::from(is_there);
    }
    assert!(empty > 30 && kept > 2000, "{empty} {kept}");
    body.soften(brittle().softening.unwrap(), &mut Control::default())
        .unwrap();
    let notches = Notches::of(&body, &[(ends, true)]);
    body.cut([tip, [tip[0], tip[1] + 5.0 * SPACING]]);
    let mut front = Front::default();
    front.follow(&body, &notches, 1e-6);
    let cracks = front.results(&body, &notches);
    assert!((front.reach / SPACING - 5.0).abs() < 1.0, "{}", front.reach);
    assert!(cracks.angle.unwrap() < 0.15, "{:?}", cracks.angle);
}

/// A disc has the mass of its circle, less the half layer at its rim that belongs to no whole triangle.
#[test]
fn a_disc_has_the_mass_of_its_circle() {
    let lattice = solid(RATIO).lattice(SPACE, SPACING);
    for layers in [40.0_f64, 80.0] {
        let diameter = layers * ROW * SPACING;
        let columns = (diameter / SPACING + 1.5).round() as usize;
        let rows = Rows {
            count: layers as usize + 1,
            particles: columns,
        };
        let body = Body::disc(lattice, rows, Packing::Regular, &mut Control::default()).unwrap();
        let exact = 0.25 * PI * diameter * diameter * 2500.0;
        let error = body.mass() / exact - 1.0;
        println!("disc of {layers} layers: mass {:+.2} %", 100.0 * error);
        assert!(error.abs() < 3.0 / layers, "{error}");
    }
}
