//! Projectiles that come at an angle: shape, motion and whole runs.

use crate::particles::bonded::Bonded;
use std::f64::consts::{FRAC_PI_2, PI};

use super::{
    contact::{NOSES, long, scenario},
    strip,
};
use crate::{
    options::Space,
    outcome::Outcome,
    particles::{
        Particles,
        body::Body,
        flight::{Flight, Inertia, Pose},
        run::Impact,
        shape::{Rigid, Shape, contact},
    },
    problem::Nose,
    solver::{self, Control, interface::Solver},
};

/// Rectangle, half disc and triangle have closed forms.
#[test]
fn moments_of_shapes_are_those_of_their_figures() {
    let (r, length) = (2.0_f64, 7.0_f64);
    let shape = |nose, length| Shape {
        nose,
        radius: r,
        length,
    };
    let cone = Nose::Cone {
        length_to_diameter: 1.5,
    };
    let high = 3.0 * r;
    let away = 4.0 * r / (3.0 * PI);
    let half_disc = FRAC_PI_2 * r * r;
    for (shape, centre, moment) in [
        (
            shape(Nose::Flat, length),
            0.5 * length,
            2.0 * r * length * (length * length + 4.0 * r * r) / 12.0,
        ),
        (
            shape(Nose::Hemisphere, r),
            r - away,
            half_disc * (0.5 * r * r - away * away),
        ),
        (
            shape(cone, high),
            2.0 / 3.0 * high,
            2.0 * r * high.powi(3) / 36.0 + high * (2.0 * r).powi(3) / 48.0,
        ),
    ] {
        let found = shape.moments();
        assert!(
            (found.0 / centre - 1.0).abs() < 1e-10,
            "{shape:?} {found:?}"
        );
        assert!(
            (found.1 / moment - 1.0).abs() < 1e-10,
            "{shape:?} {found:?}"
        );
    }
    // An ogive, against the points inside of it.
    let ogive = long(Nose::Ogive { crh: 3.0 }, r);
    let cells = 2000;
    let (across, along) = (2.0 * r / f64::from(cells), ogive.length / f64::from(cells));
    let (mut count, mut first, mut second) = (0.0, 0.0, 0.0);
    for cell in 0..cells * cells {
        let x = (f64::from(cell % cells) + 0.5) * across - r;
        let z = -(f64::from(cell / cells) + 0.5) * along;
        if ogive.penetration([x, z]).is_some() {
            count += 1.0;
            first -= z;
            second += x * x + z * z;
        }
    }
    let centre = first / count;
    let moment = (second / count - centre * centre) * ogive.area();
    let found = ogive.moments();
    assert!((found.0 / centre - 1.0).abs() < 1e-4, "{found:?} {centre}");
    assert!((found.1 / moment - 1.0).abs() < 1e-3, "{found:?} {moment}");
}

/// No point inside lies farther in a direction than the farthest one, and that one is on the surface.
#[test]
fn the_farthest_point_of_a_shape_is_farther_than_all_inside() {
    for nose in NOSES {
        let shape = long(nose, 2.0);
        for turn in 0..24 {
            let (z, x) = (2.0 * PI * (f64::from(turn) + 0.3) / 24.0).sin_cos();
            let [a, b] = shape.farthest([x, z]);
            let most = x * a + z * b;
            let mut inside = f64::NEG_INFINITY;
            for step in 0..200_000 {
                let at = [
                    4.4 * (f64::from(step) * 0.618_034).fract() - 2.2,
                    -1.05 * shape.length * (f64::from(step) * 0.754_878).fract() + 0.1,
                ];
                if shape.penetration(at).is_some() {
                    inside = inside.max(x * at[0] + z * at[1]);
                }
            }
            let left = most - inside;
            assert!((-1e-12..0.05).contains(&left), "{nose:?} {turn}: {left}");
        }
    }
}

/// Forces and moment of a tilted body are the derivatives of the energy of its contact.
#[test]
fn forces_and_moment_of_a_tilted_body_come_from_the_energy() {
    let body = strip(Space::PlaneStrain, 0.2, 9, 40);
    for nose in NOSES {
        let shape = long(nose, 5.3e-3);
        let at = |x: f64, z: f64, angle: f64| {
            let (sine, cosine) = angle.sin_cos();
            let pose = Pose {
                tip: [x, z],
                turn: [cosine, sine],
            };
            contact(&body, Rigid::Projectile(shape), pose, None)
        };
        let (x, z, angle) = (0.31e-3, 2.13e-3, -0.4);
        let found = at(x, z, angle);
        let step = 1e-9;
        let slope = |plus: f64, minus: f64, step: f64| (plus - minus) / (2.0 * step);
        let of_x = slope(
            at(x + step, z, angle).energy,
            at(x - step, z, angle).energy,
            step,
        );
        let of_z = slope(
            at(x, z + step, angle).energy,
            at(x, z - step, angle).energy,
            step,
        );
        let turn = 1e-6;
        let of_turn = slope(
            at(x, z, angle + turn).energy,
            at(x, z, angle - turn).energy,
            turn,
        );
        let size = found.force[0].hypot(found.force[1]);
        assert!(found.loads.len() > 1 && size > 0.0, "{nose:?}");
        // The forces on the particles push them out of the way of the body.
        for (found, slope, scale) in [
            (found.force[0], of_x, size),
            (found.force[1], of_z, size),
            (found.moment, of_turn, size * shape.radius),
        ] {
            assert!(
                (found - slope).abs() < 1e-5 * scale,
                "{nose:?}: {found} {slope}"
            );
        }
    }
}

/// A round nose on a bed of springs that does not move: the impulse acts along the normal, through the middle of the nose.
#[test]
fn a_round_nose_bounces_off_by_the_laws_of_impulse() {
    let body = strip(Space::PlaneStrain, 0.2, 5, 120);
    let shape = Shape {
        nose: Nose::Hemisphere,
        radius: 30e-3,
        length: 120e-3,
    };
    let density = 7850.0;
    for degrees in [10.0_f64, 30.0, 60.0] {
        let inertia = Inertia::of(density * shape.area(), shape.moments(), density, true);
        let angle = degrees.to_radians();
        let mut flight = Flight::at_impact(&shape, &inertia, 10.0, angle);
        let start = flight;
        let rigid = Rigid::Projectile(shape);
        assert!(flight.pose(&inertia).deepest(&shape).abs() < 1e-15);
        let step = 2e-8;
        let mut touched = false;
        for _ in 0..200_000 {
            let found = contact(&body, rigid, flight.pose(&inertia), None);
            flight.advance(step, &inertia, &found);
            if touched && found.loads.is_empty() {
                break;
            }
            touched |= !found.loads.is_empty();
        }
        let (mass, moment) = (inertia.mass, inertia.moment.unwrap());
        let lever = (inertia.behind_tip - shape.radius) * angle.sin();
        let impulse = 2.0 * start.velocity[1] / (1.0 / mass + lever * lever / moment);
        let across = (flight.velocity[0] - start.velocity[0]).abs() / 10.0;
        let along = (flight.velocity[1] - start.velocity[1]) * mass / -impulse;
        let spin = flight.spin * moment / (impulse * lever);
        assert!(
            touched && flight.velocity[1] < start.velocity[1],
            "{degrees}"
        );
        assert!(across < 0.01, "{degrees}: {across}");
        assert!((along - 1.0).abs() < 0.01, "{degrees}: {along}");
        assert!((spin.abs() - 1.0).abs() < 0.02, "{degrees}: {spin}");
        // The tail swings down: the axis turns away from the normal.
        assert!(-flight.spin > 0.0, "{degrees}: {}", flight.spin);
    }
}

const ROD: &str = "length = '20 mm', diameter = '6 mm', impact_velocity = '5 m/s'";
const PLATE: &str = "material = 'own', thickness = '6 mm', back_face = 'free'";

/// Nothing acts on the two bodies from outside: both momenta and the angular momentum stay what they are.
#[test]
fn momenta_are_kept_at_an_angle() {
    for nose in ["flat", "hemisphere"] {
        let rod = format!("{ROD}, nose = '{nose}', obliquity = '35 deg'");
        let case = scenario(&rod, PLATE, "width = '40 mm'", 0.2);
        let mut run = Impact::<Body, 2>::build(&case, 0.5, &mut Control::default()).unwrap();
        let start = momenta(&run);
        let energy = run.energy().total();
        for _ in 0..3000 {
            run.advance().unwrap();
        }
        let end = momenta(&run);
        let flight = &run.state.flight;
        assert!(flight.spin.abs() > 1.0 && run.body.momentum() > 0.1 * start[1]);
        let scale = [start[1], start[1], start[1] * 20e-3];
        for (i, scale) in scale.into_iter().enumerate() {
            let change = (end[i] - start[i]).abs() / scale;
            assert!(change < 1e-11, "{nose} {i}: {change:e}");
        }
        assert!((run.energy().total() / energy - 1.0).abs() < 1e-3);
    }
}

/// Momenta across and along the normal, and angular momentum about the origin.
fn momenta(run: &Impact<'_, Body, 2>) -> [f64; 3] {
    let (flight, inertia) = (&run.state.flight, &run.inertia);
    let [u, w] = flight.velocity.map(|part| part * inertia.mass);
    let angular = flight.point[0] * w - flight.point[1] * u + inertia.moment.unwrap() * flight.spin;
    let mut sums = [u, w, angular];
    let body = &run.body;
    for (row, place) in body.particles() {
        let motion = &body.motion[row];
        let mass = body.rows[row].mass[place];
        let [x, z] = body.position(row, place);
        let [u, w] = [mass * motion.x[place], mass * motion.z[place]];
        let own = motion.spin[place] / body.rows[row].inverse_inertia[place];
        sums = [sums[0] + u, sums[1] + w, sums[2] + x * w - z * u + own];
    }
    sums
}

/// On a symmetric lattice a free projectile goes as one that is held on its axis.
#[test]
fn an_angle_that_vanishes_is_normal_impact() {
    let residual = |angle: &str| {
        let rod = format!("{ROD}, nose = 'hemisphere'{angle}");
        let case = scenario(&rod, PLATE, "width = '40 mm'", 0.2);
        let result = solver::run(&Particles, &case, &mut Control::default()).unwrap();
        result.residual_velocity.unwrap()
    };
    let (normal, nearly) = (residual(""), residual(", obliquity = '1e-7 deg'"));
    assert!((nearly / normal - 1.0).abs() < 1e-6, "{nearly} {normal}");
}

/// A flat impact at a large angle glances off, and its axis has turned to the plate.
#[test]
fn a_projectile_glances_off() {
    let rod = format!("{ROD}, nose = 'hemisphere', obliquity = '70 deg'");
    let case = scenario(&rod, PLATE, "width = '60 mm'", 0.2);
    let result = solver::run(&Particles, &case, &mut Control::default()).unwrap();
    assert_eq!(result.outcome, Outcome::Rebounded, "{result:?}");
    let speed = result.residual_velocity.unwrap();
    assert!((-5.0..-4.0).contains(&speed), "{speed}");
    let degrees = |angle: Option<f64>| angle.unwrap().to_degrees();
    assert!((90.0..120.0).contains(&degrees(result.flight_direction)));
    assert!((70.0..110.0).contains(&degrees(result.projectile_axis)));
    let numerics = result.numerics();
    assert!(numerics.energy_residual < 1e-3 && numerics.momentum_residual < 1e-12);
}

#[test]
fn a_strip_on_a_wall_takes_normal_impact_alone() {
    let rod = format!("{ROD}, obliquity = '20 deg'");
    let case = scenario(&rod, "rigid_wall = true", "", 0.2);
    let error = solver::run(&Particles, &case, &mut Control::default()).unwrap_err();
    assert!(error.to_string().contains("normal impact alone"), "{error}");
}
