//! Contact with rigid bodies: shapes, strips on a wall, and whole runs.

use super::{solid, strip};
use crate::particles::bonded::Bonded;
use crate::{
    case,
    options::Space,
    outcome::{Outcome, RunResult, Termination},
    particles::{
        Particles,
        flight::Pose,
        setup,
        shape::{Rigid, Shape, contact},
    },
    problem::Nose,
    solver::{self, Control, Model},
};

pub(super) const NOSES: [Nose; 4] = [
    Nose::Flat,
    Nose::Hemisphere,
    Nose::Cone {
        length_to_diameter: 1.5,
    },
    Nose::Ogive { crh: 3.0 },
];

/// A shape with a shank of one and a half radii.
pub(super) fn long(nose: Nose, radius: f64) -> Shape {
    let mut shape = Shape {
        nose,
        radius,
        length: 0.0,
    };
    shape.length = shape.nose_length() + 1.5 * radius;
    shape
}

/// The depth inside a shape is the distance to its surface: its gradient is the way out, with length 1.
#[test]
fn the_way_out_of_a_shape_is_the_gradient_of_its_depth() {
    for nose in NOSES {
        let shape = long(nose, 2.0);
        let (mut inside, mut outside) = (0, 0);
        for step in 0..2000 {
            let at = [
                4.4 * (f64::from(step) * 0.618_034).fract() - 2.2,
                -12.0 * (f64::from(step) * 0.754_878).fract() + 0.5,
            ];
            let Some((depth, [x, z])) = shape.penetration(at) else {
                outside += 1;
                continue;
            };
            inside += 1;
            assert!((x * x + z * z - 1.0).abs() < 1e-12);
            // The nearest point of the surface lies that way.
            let surface = |part: f64| [at[0] + part * depth * x, at[1] + part * depth * z];
            assert!(
                shape.penetration(surface(1.0 + 1e-9)).is_none(),
                "{nose:?} {at:?}"
            );
            let (left, _) = shape.penetration(surface(0.5)).unwrap();
            assert!(
                (left - 0.5 * depth).abs() < 1e-9,
                "{nose:?} {at:?}: {left} {depth}"
            );
        }
        assert!(inside > 300 && outside > 100, "{nose:?} {inside} {outside}");
    }
}

/// Area against the count of points inside.
#[test]
fn areas_of_shapes_are_those_of_their_points() {
    for nose in NOSES {
        let shape = long(nose, 2.0);
        let (length, cells) = (shape.length, 800);
        let size = [4.0 / f64::from(cells), length / f64::from(cells)];
        let inside = (0..cells * cells)
            .filter(|cell| {
                let x = (f64::from(cell % cells) + 0.5) * size[0] - 2.0;
                let z = -(f64::from(cell / cells) + 0.5) * size[1];
                shape.penetration([x, z]).is_some()
            })
            .count();
        let counted = inside as f64 * size[0] * size[1];
        assert!((counted / shape.area() - 1.0).abs() < 1e-3, "{nose:?}");
    }
}

/// Forces of a contact are in the order of the rows, as the step takes them, and act along the way out.
#[test]
fn forces_of_a_nose_balance_on_a_symmetric_body() {
    let body = strip(Space::PlaneStrain, 0.2, 9, 40);
    for nose in NOSES {
        let shape = long(nose, 5.3e-3);
        let found = contact(
            &body,
            Rigid::Projectile(shape),
            Pose::straight(2.0e-3),
            None,
        );
        assert!(found.loads.is_sorted_by_key(|load| load.row), "{nose:?}");
        let across: f64 = found.loads.iter().map(|load| load.force[0]).sum();
        let along: f64 = found.loads.iter().map(|load| load.force[1]).sum();
        let force = found.force[1];
        assert!(force > 0.0 && found.energy > 0.0, "{nose:?}");
        assert!(across.abs() < 1e-10 * force, "{nose:?}: {across}");
        assert!((along - force).abs() < 1e-12 * force, "{nose:?}");
        assert!(found.moment.abs() < 1e-12 * force, "{nose:?}");
    }
}

fn own_material(ratio: f64) -> String {
    format!(
        "materials.own = {{ name = 'Elastic', density = '2500 kg/m3', youngs_modulus = '70 GPa', poissons_ratio = {ratio}, \
         strength.elastic = {{}} }}"
    )
}

fn run(projectile: &str, target: &str, options: &str) -> RunResult {
    let scenario = scenario(projectile, target, options, 0.0);
    solver::run(&Particles, &scenario, &mut Control::recording())
        .unwrap_or_else(|error| panic!("{error}"))
}

pub(super) fn scenario(
    projectile: &str,
    target: &str,
    options: &str,
    ratio: f64,
) -> crate::Scenario {
    let text = format!(
        "projectile = {{ material = 'own', {projectile} }}\ntarget = {{ {target} }}\nparticles = {{ {options} }}\n{}\n",
        own_material(ratio)
    );
    case::load_str("case", &text).unwrap_or_else(|error| panic!("{text}{error}"))
}

/// A strip without lateral contraction: stress `ρ c v`, contact for `2 L/c`, rebound at the impact velocity.
#[test]
fn a_strip_on_a_wall_rebounds_after_a_round_trip_of_its_wave() {
    let result = run(
        "length = '60 mm', diameter = '20 mm', impact_velocity = '10 m/s'",
        "rigid_wall = true",
        "spacing = '0.3 mm'",
    );
    let speed = (70e9_f64 / 2500.0).sqrt();
    let passage = 60e-3 / speed;
    let contact = result.contact_time.unwrap();
    assert!(
        (contact / (2.0 * passage) - 1.0).abs() < 0.01,
        "{contact} {passage}"
    );
    let width = result
        .details
        .iter()
        .find(|detail| detail.name == "width of the lattice")
        .unwrap();
    let exact = 2500.0 * speed * 10.0 * width.value * 1e-3;
    let force = mean(&result, 0.3 * passage, 1.7 * passage);
    assert!((force / exact - 1.0).abs() < 0.01, "{force} {exact}");
    let residual = result.residual_velocity.unwrap();
    assert!((residual / -10.0 - 1.0).abs() < 0.02, "{residual}");
    assert_eq!(
        (result.outcome, result.termination),
        (Outcome::Rebounded, Termination::Parted)
    );
    let numerics = result.numerics();
    println!(
        "energy {:e}, momentum {:e}, contact {}, force {}, residual {residual}",
        numerics.energy_residual,
        numerics.momentum_residual,
        contact / (2.0 * passage),
        force / exact
    );
    assert!(
        numerics.energy_residual < 1e-4,
        "{:e}",
        numerics.energy_residual
    );
    assert!(
        numerics.momentum_residual < 1e-12,
        "{:e}",
        numerics.momentum_residual
    );
}

/// Mean force of a contact between two times.
fn mean(result: &RunResult, from: f64, to: f64) -> f64 {
    let samples = &result.history.as_ref().unwrap().samples;
    let within: Vec<f64> = samples
        .iter()
        .filter(|sample| (from..to).contains(&sample.time))
        .map(|sample| sample.contact_force)
        .collect();
    assert!(within.len() > 20);
    within.iter().sum::<f64>() / within.len() as f64
}

/// A flat punch as wide as the plate, without lateral contraction: `M dv/dt = −ρ c W v` until the wave is back from the free face.
#[test]
fn a_rigid_punch_slows_by_the_impedance_of_the_plate() {
    let result = run(
        "length = '60 mm', diameter = '30 mm', impact_velocity = '10 m/s'",
        "material = 'own', thickness = '40 mm', back_face = 'free'",
        "spacing = '0.5 mm', width = '29 mm'",
    );
    let speed = (70e9_f64 / 2500.0).sqrt();
    let width = result
        .details
        .iter()
        .find(|detail| detail.name == "width of the lattice")
        .unwrap()
        .value
        * 1e-3;
    let decay = 2500.0 * speed * width / (2500.0 * 60e-3 * 30e-3);
    let samples = &result.history.as_ref().unwrap().samples;
    let mut looked_at = 0;
    for sample in samples
        .iter()
        .filter(|sample| (1e-6..0.9 * 80e-3 / speed).contains(&sample.time))
    {
        let exact = 10.0 * (-decay * sample.time).exp();
        assert!(
            (sample.mean_velocity - exact).abs() < 0.01 * 10.0,
            "{}: {} {exact}",
            sample.time,
            sample.mean_velocity
        );
        looked_at += 1;
    }
    assert!(looked_at > 20);
    let numerics = result.numerics();
    println!(
        "energy {:e}, momentum {:e}",
        numerics.energy_residual, numerics.momentum_residual
    );
    assert!(
        numerics.energy_residual < 1e-4,
        "{:e}",
        numerics.energy_residual
    );
    assert!(
        numerics.momentum_residual < 1e-12,
        "{:e}",
        numerics.momentum_residual
    );
}

#[test]
fn what_the_model_does_not_compute_is_refused_with_a_remedy() {
    let rod = "length = '20 mm', diameter = '6 mm', impact_velocity = '20 m/s'";
    let plate = "material = 'own', thickness = '6 mm'";
    let refusal = |target: &str, options: &str, ratio: f64| {
        let scenario = scenario(rod, target, options, ratio);
        let error = solver::run(&Particles, &scenario, &mut Control::default()).unwrap_err();
        error.to_string()
    };
    for (target, options, ratio, words) in [
        (
            "material = 'weldox-460-e', thickness = '6 mm'",
            "",
            0.2,
            "springs have no plastic flow",
        ),
        (
            "material = 'own', thickness = 'semi-infinite'",
            "",
            0.2,
            "a semi-infinite target",
        ),
        (
            "material = 'own', thickness = '6 mm', back_face = 'non-reflecting'",
            "",
            0.2,
            "it has no non-reflecting rear face",
        ),
        (
            plate,
            "",
            0.3,
            "springs reach a Poisson's ratio of 0.25 in plane strain",
        ),
        (
            plate,
            "space = 'plane-stress'",
            0.34,
            "0.333 in plane stress",
        ),
        (
            plate,
            "formulation = 'particle-stress', equation_of_state = 'mie-gruneisen'",
            0.3,
            "needs an equation of state",
        ),
        (
            "material = 'soda-lime-glass-float', thickness = '6 mm'",
            "formulation = 'particle-stress'",
            0.3,
            "no bond breaks with",
        ),
        (plate, "softening = 5.0", 0.2, "no table `fracture`"),
        (plate, "seed = 7", 0.2, "`particles.seed` has no effect"),
        (plate, "friction = 0.9", 0.2, "or remove the key"),
        (plate, "spacing = '0.01 um'", 0.2, "of memory"),
    ] {
        if options.contains("um") {
            // Below the range of lengths: by the memory of a fine spacing that is allowed.
            let words = refusal(
                "material = 'own', thickness = '1 m'",
                "spacing = '10 um', width = '100 m'",
                0.2,
            );
            assert!(words.contains("of memory"), "{words}");
            continue;
        }
        let found = refusal(target, options, ratio);
        assert!(found.contains(words), "{found}");
    }
    let metal = case::load_str(
        "case",
        &format!(
            "projectile = {{ material = 'weldox-460-e', {rod} }}\ntarget = {{ {plate} }}\n{}\n",
            own_material(0.2)
        ),
    );
    let refused = solver::run(&Particles, &metal.unwrap(), &mut Control::default()).unwrap_err();
    assert!(
        refused.to_string().contains("it takes rigid projectiles"),
        "{refused}"
    );
}

/// A stretch that breaks any solid ends the run with a remedy.
#[test]
fn a_lattice_that_is_torn_ends_the_run() {
    let scenario = scenario(
        "length = '20 mm', diameter = '6 mm', impact_velocity = '1500 m/s', nose = 'hemisphere'",
        "material = 'own', thickness = '6 mm', back_face = 'free'",
        "width = '40 mm'",
        0.2,
    );
    let error = solver::run(&Particles, &scenario, &mut Control::default())
        .unwrap_err()
        .to_string();
    assert!(error.contains("the bonds of this run do not"), "{error}");
}

/// Memory that is estimated is at least that of the arrays and of the fields, and at most twice as much.
#[test]
fn memory_is_estimated_before_it_is_taken() {
    let scenario = scenario(
        "length = '20 mm', diameter = '6 mm', impact_velocity = '10 m/s'",
        "material = 'own', thickness = '6 mm'",
        "spacing = '0.1 mm'",
        0.2,
    );
    let (body, _) = setup::build(&scenario, &mut Control::default()).unwrap();
    // State, motion, masses and weights; arrays of a file before they are packed, and three bonds.
    let arrays = body.rows.len() * body.stride * 13 * 8;
    let file = 65 + 3 * size_of::<solver::frames::Bond>();
    let taken = (arrays + body.particles().count() * file) as f64;
    let estimated = Particles.estimate(&scenario).memory;
    assert!(
        (1.0..2.0).contains(&(estimated / taken)),
        "{estimated} {taken}"
    );
    let count = body.particles().count() as f64;
    assert!((setup::extent(&scenario).particles() / count - 1.0).abs() < 0.01);
    assert!(
        solid(0.2)
            .lattice(Space::PlaneStrain, 1e-3)
            .largest_frequency()
            > 0.0
    );
}

/// Glass that breaks at 8 J/m2 and 41 MPa.
const GLASS: &str = "materials.glass = { name = 'Glass', density = '2500 kg/m3', youngs_modulus = '72 GPa', poissons_ratio = 0.23, \
     strength.elastic = {}, fracture = { energy = '8 J/m2', tensile_strength = '41 MPa' } }";

/// A ball-nosed strip goes through thin glass: the run ends when nothing is left in its way.
#[test]
fn a_projectile_that_has_come_through_ends_its_run() {
    let text = format!(
        "projectile = {{ material = 'own', length = '20 mm', diameter = '4 mm', nose = 'hemisphere', impact_velocity = '100 m/s' }}\n\
         target = {{ material = 'glass', thickness = '2 mm', back_face = 'free' }}\n\
         particles = {{ spacing = '0.25 mm', width = '12 mm', end_time = '2 ms' }}\n{GLASS}\n{}",
        own_material(0.2)
    );
    let scenario = case::load_str("glass", &text).unwrap();
    let result = solver::run(&Particles, &scenario, &mut Control::default()).unwrap();
    assert_eq!(
        (result.outcome, result.termination),
        (Outcome::Perforated, Termination::LeftTarget)
    );
    assert!(result.end_time.unwrap() < 1e-3 && result.residual_velocity.unwrap() > 50.0);
    assert_eq!(result.largest_depth, None);
}

/// Rows of a disc may begin and end without a particle: depth and profile are those of the particles that are there.
#[test]
fn a_disc_is_pressed_in_at_every_spacing() {
    for spacing in [0.5, 0.45, 0.4, 0.3] {
        let scenario = scenario(
            "length = '20 mm', diameter = '10 mm', impact_velocity = '1 m/s'",
            "material = 'own', thickness = '5 mm', back_face = 'free'",
            &format!("outline = 'disc', spacing = '{spacing} mm', end_time = '3 us'"),
            0.2,
        );
        let result = solver::run(&Particles, &scenario, &mut Control::recording()).unwrap();
        let depth = result.largest_depth.unwrap();
        assert!((1e-6..4e-6).contains(&depth), "{spacing} mm: {depth}");
        let history = result.history.unwrap();
        let last = history.profiles.last().unwrap();
        let is_whole = |state: &crate::history::ElementState| {
            state.stress.is_finite() && state.strain.abs() < 0.01
        };
        assert!(last.elements.iter().all(is_whole), "{spacing} mm: {last:?}");
    }
}
