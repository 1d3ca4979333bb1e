//! Contact at a surface that is followed: friction, and the way of the surface.

use super::{Grid, Solid, body, rectangle, solver, uniform};
use crate::{
    axi::{contact::Contact, surface::Surface},
    solver::Control,
};

const SPEED: f64 = 10.0;
const SIDE: f64 = 8e-3;

/// A ring that moves out and along within another, its outer face followed.
fn rings(coefficient: f64) -> Grid {
    let cell = SIDE / 8.0;
    let ring = |radius: (f64, f64), depth: (f64, f64), velocity: [f64; 2]| {
        let law = Solid::elastic(7850.0, 200e9, 0.3).law();
        body(
            law,
            rectangle(radius, depth, 0.5 * cell),
            &uniform(velocity),
        )
    };
    let first = ring((3.0 * SIDE, 4.0 * SIDE), (0.0, 4.0 * SIDE), [SPEED; 2]);
    let second = ring((4.0 * SIDE, 5.0 * SIDE), (-SIDE, 5.0 * SIDE), [0.0; 2]);
    let mut solver = solver(vec![first, second], cell);
    solver.contact = Contact::Frictional(coefficient);
    let depth = |k: i32| 4.0 * SIDE - 0.5 * cell * f64::from(k);
    solver.surface = Some(Surface {
        points: (0..=64).map(|k| [4.0 * SIDE, depth(k)]).collect(),
    });
    solver.start(&mut Control::default()).unwrap();
    solver
}

#[test]
fn friction_is_its_coefficient_times_the_pressure_and_no_contact_gives_energy() {
    for coefficient in [0.0, 0.1, 0.2] {
        let mut solver = rings(coefficient);
        let mut passed = [0.0; 2];
        let mut lost = 0.0;
        while solver.time < SIDE / 6000.0 {
            let [first, second] = [0, 1].map(|index: usize| {
                let impulses = solver.bodies[index].field.impulse.iter();
                impulses.fold([0.0; 2], |sum, part| [sum[0] + part[0], sum[1] + part[1]])
            });
            for k in 0..2 {
                assert!((first[k] + second[k]).abs() <= 1e-12 * first[0].abs());
                passed[k] += first[k];
            }
            assert!(solver.advance());
            let contact = solver.energy().contact;
            assert!(contact >= lost - 1e-9 * solver.energy().initial);
            lost = contact;
        }
        let ratio = passed[1] / passed[0];
        let (energy, momentum) = (solver.energy(), solver.momentum());
        println!(
            "coefficient {coefficient}: {ratio:.5}, lost in contact {:.1e}, residual {:.1e}",
            lost / energy.initial,
            energy.residual()
        );
        // The surface turns a little as the rings strain.
        assert!(passed[0] > 0.0 && (ratio - coefficient).abs() < 2e-3);
        assert!(momentum.residual().abs() < 1e-12 && energy.residual().abs() < 2e-5);
    }
}

#[test]
fn a_surface_has_the_points_of_its_body_and_goes_where_its_particles_go() {
    const CELL: f64 = 1e-3;
    let radius = |behind: f64| (behind * (8e-3 - behind)).max(0.0).sqrt();
    let mut surface = Surface::new(radius, 4e-3, CELL);
    assert_eq!(surface.points.first(), Some(&[0.0, 0.0]));
    assert_eq!(surface.points.last(), Some(&[0.0, -4e-3]));
    for point in &surface.points {
        // On the hemisphere, or on the plane of its tail.
        let off = point[0].hypot(point[1] + 4e-3) - 4e-3;
        assert!(off.abs() < 1e-9 || point[1] == -4e-3, "{point:?}");
    }
    let gaps = surface.points.windows(2).map(|ends| {
        let [a, b] = [ends[0], ends[1]];
        (a[0] - b[0]).hypot(a[1] - b[1])
    });
    assert!(gaps.clone().all(|gap| gap > 0.1 * CELL && gap < 0.6 * CELL));

    // Stretched to 2.7 times its width: points come in between.
    let law = Solid::elastic(7850.0, 200e9, 0.3).law();
    let wide = |[r, _]: [f64; 2]| ([1e3 * r, 1.0], [1e3, 0.0, 0.0, 0.0]);
    let sections = rectangle((0.0, 12e-3), (-8e-3, 4e-3), 0.5 * CELL);
    let solver = solver(vec![body(law, sections, &wide)], CELL);
    let before = surface.points.len();
    for _ in 0..100 {
        surface.follow(&solver.bodies[0].field, &solver.mesh, 1e-5);
    }
    let widest = surface.points.iter().map(|p| p[0]).fold(0.0, f64::max);
    let tip = surface.points[0];
    println!(
        "widest {widest:.4e}, tip {tip:?}, {} points",
        surface.points.len()
    );
    assert!(tip[0] < 1e-12 && (tip[1] - 1e-3).abs() < 1e-6);
    assert!((widest / (4e-3 * 1.01_f64.powi(100)) - 1.0).abs() < 1e-2);
    assert!(surface.points.len() > before);
}
