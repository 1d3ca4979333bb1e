//! Balls that collide: tests 1 to 4 of Chung and Ooi, exact sliding and rolling, and balances.

use std::f64::consts::PI;

use crate::{
    case,
    outcome::{Outcome, RunResult},
    particles::{
        Particles,
        ball::{
            law::{HertzLaw, Meeting, Touch},
            motion::{Ball, Facing, Push},
        },
        lattice::Solid,
    },
    solver::{self, Control},
};

/// Modulus [GPa], Poisson's ratio and density [kg/m3].
type Elastic = (f64, f64, f64);

const GLASS: Elastic = (48.0, 0.2, 2800.0);
const LIMESTONE: Elastic = (20.0, 0.25, 2500.0);
const ALUMINIUM: Elastic = (70.0, 0.3, 2699.0);
const MAGNESIUM: Elastic = (40.0, 0.35, 1800.0);
const ALUMINA: Elastic = (380.0, 0.23, 4000.0);
const IRON: Elastic = (100.0, 0.25, 7000.0);

fn material(id: &str, (modulus, ratio, density): Elastic) -> String {
    format!(
        "materials.{id} = {{ name = 'Elastic', density = '{density} kg/m3', youngs_modulus = '{modulus} GPa', poissons_ratio = {ratio}, \
         strength.elastic = {{}} }}\n"
    )
}

/// A case of a ball of a diameter [mm] and a velocity [m/s].
fn text(ball: Elastic, (diameter, velocity): (f64, f64), target: &str, options: &str) -> String {
    let mass = ball.2 * PI / 6.0 * (1e-3 * diameter).powi(3) * 1e3;
    format!(
        "target = {{ {target} }}\nparticles = {{ contact = 'hertz', {options} }}\n[projectile]\nmaterial = 'own'\nmass = '{mass:.12} g'\n\
         diameter = '{diameter} mm'\nnose = 'hemisphere'\nimpact_velocity = '{velocity} m/s'\n"
    )
}

fn run(ball: Elastic, of: (f64, f64), target: &str, options: &str, more: &str) -> RunResult {
    let text = text(ball, of, target, options);
    let text = format!("{}{text}{more}", material("own", ball));
    let scenario = case::load_str("balls", &text).unwrap_or_else(|error| panic!("{error}"));
    solver::run(&Particles, &scenario, &mut Control::recording()).unwrap()
}

fn detail(result: &RunResult, name: &str) -> f64 {
    let detail = result.details.iter().find(|detail| detail.name == name);
    detail.unwrap().value
}

const WALL: &str = "rigid_wall = true";
const ELASTIC: &str = "restitution = 1.0, friction = 0.0";

/// Approach [µm], force [N] and time [µs] of Hertz's theory, from its closed forms by hand.
#[test]
fn balls_meet_by_the_theory_of_hertz() {
    let ball = "material = 'own', thickness = '20 mm', back_face = 'free'";
    let balls = "restitution = 1.0, friction = 0.0, outline = 'ball'";
    for (material, of, target, options, exact) in [
        (GLASS, (20.0, 20.0), ball, balls, [274.11, 10_696.9, 40.34]),
        (
            LIMESTONE,
            (20.0, 20.0),
            ball,
            balls,
            [368.30, 7108.2, 54.20],
        ),
        (
            ALUMINIUM,
            (200.0, 0.2),
            WALL,
            ELASTIC,
            [49.72, 11_370.0, 731.6],
        ),
        (
            MAGNESIUM,
            (200.0, 0.2),
            WALL,
            ELASTIC,
            [52.12, 7232.7, 767.0],
        ),
    ] {
        let result = run(material, of, target, options, "");
        let found = [
            detail(&result, "largest approach"),
            result.peak_force.unwrap(),
            result.contact_time.unwrap() * 1e6,
        ];
        println!("{found:?} {exact:?}");
        for (found, exact) in found.into_iter().zip(exact) {
            assert!((found / exact - 1.0).abs() < 1e-3, "{found} {exact}");
        }
        let numerics = result.numerics();
        assert!(numerics.energy_residual < 1e-5 && numerics.momentum_residual < 1e-12);
        if target == ball {
            // Equal balls exchange their velocities.
            assert!((detail(&result, "velocity of the target") / of.1 - 1.0).abs() < 1e-5);
            assert_eq!(result.outcome, Outcome::AtRest);
        } else {
            assert!((result.residual_velocity.unwrap() / of.1 + 1.0).abs() < 1e-5);
        }
    }
}

/// Peak force and approach of a half-space as soft as the ball: `E*` is half that of a rigid wall.
#[test]
fn an_elastic_half_space_doubles_the_compliance() {
    let half_space = "material = 'own', thickness = 'semi-infinite'";
    let [soft, rigid] = [half_space, WALL].map(|target| {
        let result = run(ALUMINIUM, (200.0, 0.2), target, ELASTIC, "");
        (
            detail(&result, "largest approach"),
            result.peak_force.unwrap(),
        )
    });
    assert!((soft.0 / rigid.0 / 2.0_f64.powf(0.4) - 1.0).abs() < 1e-5);
    assert!((soft.1 / rigid.1 / 0.5_f64.powf(0.4) - 1.0).abs() < 1e-5);
}

/// Test 3: what goes in as restitution comes out, whatever the velocity and the material.
#[test]
fn restitution_is_the_one_that_is_asked_for() {
    for (material, velocity) in [(ALUMINA, 3.9), (IRON, 3.9), (IRON, 0.1)] {
        for restitution in [0.05, 0.2, 0.4, 0.6, 0.8, 1.0] {
            let options = format!("restitution = {restitution:?}, friction = 0.0");
            let result = run(material, (5.0, velocity), WALL, &options, "");
            let found = -result.residual_velocity.unwrap() / velocity;
            assert!((found - restitution).abs() < 1e-3, "{found} {restitution}");
            let energy = result.numerics().energy;
            let lost = energy.viscous / energy.initial;
            assert!((lost - 1.0 + found * found).abs() < 1e-3, "{lost}");
        }
    }
}

/// Test 4 at an angle [°]: tangential restitution and angular velocity [rad/s].
fn oblique(angle: f64) -> ([f64; 2], RunResult) {
    // The wall of the benchmark is a thousand times as stiff as the ball; this one is rigid.
    let more = format!("obliquity = '{angle} deg'\n");
    let options = "restitution = 0.98, friction = 0.092";
    let result = run(ALUMINA, (5.0, 3.9), WALL, options, &more);
    let speed = result.residual_velocity.unwrap().abs();
    let along = speed * result.flight_direction.unwrap().sin();
    let tangential = along / (3.9 * angle.to_radians().sin());
    let spin = detail(&result, "angular velocity of the projectile");
    ([tangential, spin.abs()], result)
}

/// Test 4: an independent integration to its last digit, the published points within 3 %.
#[test]
fn oblique_balls_are_those_of_the_benchmark() {
    for (angle, exact) in [
        (15.0, [0.631, 372.0]),
        (30.0, [0.685, 615.0]),
        (45.0, [0.818, 502.0]),
        (60.0, [0.895, 355.0]),
        (80.0, [0.968, 123.0]),
    ] {
        let (found, result) = oblique(angle);
        println!("{angle}: {found:?} {exact:?}");
        assert!((found[0] - exact[0]).abs() < 1e-3, "{found:?}");
        assert!((found[1] / exact[1] - 1.0).abs() < 5e-3, "{found:?}");
        let numerics = result.numerics();
        assert!(numerics.energy_residual < 1e-5 && numerics.momentum_residual < 1e-12);
    }
    for (angle, tangential, spin) in [
        (15.0, Some(0.624), 378.0),
        (30.1, Some(0.684), 617.0),
        (50.0, None, 457.0),
        (60.0, Some(0.893), 357.0),
        (80.0, Some(0.966), 126.0),
    ] {
        let (found, _) = oblique(angle);
        let error = tangential.map_or(0.0, |of| found[0] / of - 1.0);
        println!("{angle}: {error:+.4} {:+.4}", found[1] / spin - 1.0);
        assert!(error.abs() < 0.03 && (found[1] / spin - 1.0).abs() < 0.03);
    }
}

/// Balls that slide through the whole contact: `e_t = 1 − μ(1 + e)/tan θ`, `ω = 5 μ(1 + e) v_n/(2 R)`.
#[test]
fn gross_slip_has_its_closed_form() {
    for angle in [35.0_f64, 45.0, 60.0, 80.0, 85.0] {
        let ([tangential, spin], _) = oblique(angle);
        let impulse = 0.092 * 1.98;
        let angle = angle.to_radians();
        let exact = [
            1.0 - impulse / angle.tan(),
            2.5 * impulse * 3.9 * angle.cos() / 2.5e-3,
        ];
        assert!(
            (tangential - exact[0]).abs() < 2e-4,
            "{tangential} {exact:?}"
        );
        assert!((spin / exact[1] - 1.0).abs() < 1e-3, "{spin} {exact:?}");
    }
}

const GRAVITY: f64 = 9.81;
const FRICTION: f64 = 0.3;

fn solid((modulus, ratio, density): Elastic) -> Solid {
    Solid {
        density,
        youngs_modulus: 1e9 * modulus,
        poissons_ratio: ratio,
    }
}

/// A body of round section on a plane under its weight.
struct Slide {
    body: Ball,
    plane: Ball,
    law: HertzLaw,
    touch: Touch,
    step: f64,
}

impl Slide {
    /// One that slides at a velocity [m/s], with a moment of inertia over `m R²`; one without does not turn.
    fn new(speed: f64, gyration: Option<f64>) -> Self {
        let radius = 0.01;
        let mass = 2800.0 * 4.0 / 3.0 * PI * radius * radius * radius;
        let mut body = Ball::new(radius, mass, [0.0, -radius]);
        body.inverse_inertia = gyration.map_or(0.0, |of| 1.0 / (of * mass * radius * radius));
        let plane = Ball::plane();
        let meeting = Meeting {
            solids: [Some(solid(GLASS)), None],
            radii: [radius, plane.radius],
            inverse_masses: [body.inverse_mass, 0.0],
        };
        let law = HertzLaw::new(&meeting, 1.0, FRICTION);
        // It rests at the approach whose force is its weight: the largest of an impact has `F = 5/4 m v²/δ`.
        let mut touch = Touch::default();
        let mut approach = 1e-9;
        for _ in 0..200 {
            touch.update(&law, approach, [0.0; 2], 0.0);
            approach *= (mass * GRAVITY / touch.push).powf(2.0 / 3.0);
        }
        body.centre[1] += approach;
        let step = 0.2 / law.frequency(approach);
        // Velocities are those of half a step before.
        body.velocity[0] = speed + 0.5 * step * FRICTION * GRAVITY;
        Self {
            body,
            plane,
            law,
            touch: Touch::default(),
            step,
        }
    }

    /// Goes a step, and returns the speed at which its surface slides.
    fn advance(&mut self) -> f64 {
        let facing = Facing::of(&self.body, &self.plane);
        let speeds = facing.speeds(&self.body, &self.plane);
        self.touch
            .update(&self.law, facing.approach, speeds, self.step);
        let [mut push, _]: [Push; 2] = facing.pushes(&self.touch);
        push.force[1] += GRAVITY / self.body.inverse_mass;
        self.body.advance(self.step, &push);
        let [_, past] = Facing::of(&self.body, &self.plane).speeds(&self.body, &self.plane);
        past
    }
}

/// A block goes `v²/(2 μ g)`.
#[test]
fn a_block_slides_to_rest() {
    let speed = 2.0;
    let mut slide = Slide::new(speed, None);
    let mut steps = 0;
    while slide.body.velocity[0] > 0.0 {
        slide.advance();
        steps += 1;
    }
    let exact = speed * speed / (2.0 * FRICTION * GRAVITY);
    let found = slide.body.centre[0];
    println!("{} in {steps} steps", found / exact - 1.0);
    assert!((found / exact - 1.0).abs() < 1e-6, "{found} {exact}");
}

/// A sphere that slides rolls at `5 v/7` from `2 v/(7 μ g)` on, a disc at `2 v/3` from `v/(3 μ g)` on.
#[test]
fn a_ball_and_a_disc_begin_to_roll() {
    for (gyration, part, time) in [(0.4, 5.0 / 7.0, 2.0 / 7.0), (0.5, 2.0 / 3.0, 1.0 / 3.0)] {
        let speed = 10.0;
        let mut slide = Slide::new(speed, Some(gyration));
        let start = slide.advance().signum();
        let mut steps = 1;
        while slide.advance() * start > 0.0 {
            steps += 1;
        }
        let found = f64::from(steps) * slide.step;
        let exact = time * speed / (FRICTION * GRAVITY);
        println!("{gyration}: time {}", found / exact - 1.0);
        assert!((found / exact - 1.0).abs() < 1e-4, "{found} {exact}");
        // Its springs let it swing a little about rolling.
        let mut sum = 0.0;
        for _ in 0..10_000 {
            slide.advance();
            sum += slide.body.velocity[0];
        }
        let found = sum / 1e4 / speed;
        println!("{gyration}: speed {}", found / part - 1.0);
        assert!((found / part - 1.0).abs() < 1e-4, "{found} {part}");
    }
}

/// Equal balls in a row hand their velocity on.
#[test]
fn a_cradle_keeps_its_momentum() {
    let (radius, mass, speed) = (0.01, 0.01, 1.0);
    let mut balls: Vec<Ball> = (0..5)
        .map(|number| Ball::new(radius, mass, [0.0, 2.01 * radius * f64::from(number)]))
        .collect();
    balls[0].velocity[1] = speed;
    let meeting = Meeting {
        solids: [Some(solid(GLASS)); 2],
        radii: [radius; 2],
        inverse_masses: [1.0 / mass; 2],
    };
    let law = HertzLaw::new(&meeting, 1.0, 0.0);
    let step = 2e-3 / law.frequency(law.largest_approach(speed));
    let mut touches = [Touch::default(); 4];
    let mut met = 0;
    for _ in 0..60_000 {
        let mut pushes = [Push::default(); 5];
        for (first, touch) in touches.iter_mut().enumerate() {
            let facing = Facing::of(&balls[first], &balls[first + 1]);
            let speeds = facing.speeds(&balls[first], &balls[first + 1]);
            touch.update(&law, facing.approach, speeds, step);
            met += usize::from(touch.push > 0.0);
            for (end, push) in facing.pushes(touch).into_iter().enumerate() {
                pushes[first + end].force[1] += push.force[1];
            }
        }
        for (ball, push) in balls.iter_mut().zip(&pushes) {
            ball.advance(step, push);
        }
        let momentum: f64 = balls.iter().map(Ball::momentum).sum();
        assert!((momentum / (mass * speed) - 1.0).abs() < 1e-12);
    }
    assert!(met > 1000);
    assert!((balls[4].velocity[1] / speed - 1.0).abs() < 1e-3);
    assert!(balls[..4].iter().all(|ball| ball.velocity[1].abs() < 1e-3));
}

/// Two unequal balls that spin and meet off their line of flight: momenta, angular momentum and energy, and losses that only grow.
#[test]
fn what_two_balls_exchange_is_accounted_for() {
    for friction in [0.0, 0.05, 0.3, 2.0] {
        let mut balls = [
            Ball::new(0.01, 0.012, [0.003, -0.01]),
            Ball::new(0.014, 0.03, [0.0, 0.0139]),
        ];
        balls[0].velocity = [1.0, 3.0];
        (balls[0].spin, balls[1].spin) = (150.0, -40.0);
        let meeting = Meeting {
            solids: [Some(solid(GLASS)), Some(solid(LIMESTONE))],
            radii: balls.map(|ball| ball.radius),
            inverse_masses: balls.map(|ball| ball.inverse_mass),
        };
        let law = HertzLaw::new(&meeting, 0.8, friction);
        let step = 1e-3 / law.frequency(law.largest_approach(3.0));
        let mut touch = Touch::default();
        let mut pushes = [Push::default(); 2];
        let energy = |balls: &[Ball; 2], pushes: &[Push; 2], touch: &Touch| {
            let kinetic = [0, 1].map(|i| balls[i].kinetic_energy(step, &pushes[i]));
            kinetic[0] + kinetic[1] + touch.energy(&law) + touch.damped + touch.rubbed
        };
        let momenta = |balls: &[Ball; 2]| {
            let mut sums = [0.0; 3];
            for ball in balls {
                let (mass, [u, w]) = (1.0 / ball.inverse_mass, ball.velocity);
                // Centres half a step back, where the velocities are.
                let [x, z] = [0, 1].map(|i| ball.centre[i] - 0.5 * step * ball.velocity[i]);
                sums[0] += mass * u;
                sums[1] += mass * w;
                sums[2] += mass * (x * w - z * u) + ball.spin / ball.inverse_inertia;
            }
            sums
        };
        let (start, at_start) = (energy(&balls, &pushes, &touch), momenta(&balls));
        let (mut met, mut error) = (false, 0.0_f64);
        for _ in 0..100_000 {
            for (ball, push) in balls.iter_mut().zip(&pushes) {
                ball.advance(step, push);
            }
            let facing = Facing::of(&balls[0], &balls[1]);
            let before = touch;
            let speeds = facing.speeds(&balls[0], &balls[1]);
            touch.update(&law, facing.approach, speeds, step);
            pushes = facing.pushes(&touch);
            met |= touch.push > 0.0;
            assert!(touch.damped >= before.damped - 1e-12 * start);
            assert!(touch.rubbed >= before.rubbed - 1e-9 * start, "{friction}");
            error = error.max((energy(&balls, &pushes, &touch) / start - 1.0).abs());
            for (now, then) in momenta(&balls).into_iter().zip(at_start) {
                assert!((now / then - 1.0).abs() < 1e-10, "{now} {then}");
            }
        }
        println!(
            "{friction}: energy {error:e}, rubbed {:e}",
            touch.rubbed / start
        );
        assert!(met && touch.approach < 0.0 && error < 1e-5, "{error:e}");
        assert_eq!(touch.rubbed > 1e-3 * start, friction > 0.0);
    }
}

/// What is no Hertz contact of a ball is refused with a remedy, or is an error of the case.
#[test]
fn what_is_no_ball_is_refused() {
    let plain = |target: &str, options: &str| {
        let text = text(GLASS, (20.0, 20.0), target, options);
        format!("{}{text}", material("own", GLASS))
    };
    let plate = "material = 'own', thickness = '20 mm'";
    let not_reflecting = "material = 'own', thickness = '20 mm', back_face = 'non-reflecting'";
    let rod = plain(WALL, "").replace("mass = '", "length = '80 mm' # '");
    let yields = plain("material = 'weldox-460-e', thickness = 'semi-infinite'", "");
    for (text, words) in [
        (plain(plate, ""), "a Hertz contact is that of a half-space"),
        (
            plain(not_reflecting, "outline = 'ball'"),
            "a ball as the target has no non-reflecting rear face",
        ),
        (rod, "takes the projectile as a ball of its diameter"),
        (yields, "a Hertz contact is elastic"),
        (
            plain(plate, "outline = 'disc'"),
            "allowed: \"plate\", \"ball\"",
        ),
        (
            plain(WALL, "outline = 'ball'"),
            "a rigid wall or a constant pressure has no `outline`",
        ),
        (plain(WALL, "spacing = '1 mm'"), "`spacing` has no effect"),
        (plain(WALL, "space = 'plane-strain'"), "allowed: \"3d\""),
        (
            plain(plate, "outline = 'ball'").replace("'hertz'", "'lattice'"),
            "allowed: \"plate\", \"disc\"",
        ),
        (plain(WALL, "").replace("'hertz'", "'soft'"), "soft"),
        (plain(WALL, "restitution = 0.0"), "allowed: 0.05 to 1"),
    ] {
        let run = |scenario: crate::Scenario| {
            solver::run(&Particles, &scenario, &mut Control::default())
                .map(|_| ())
                .map_err(|error| error.to_string())
        };
        let found = match case::load_str("balls", &text) {
            Ok(scenario) => run(scenario).unwrap_err(),
            Err(error) => error.to_string(),
        };
        assert!(found.contains(words), "{found}\n{words}");
    }
}

/// A ball that is held is as far from moving as a wall.
#[test]
fn a_ball_that_is_held_takes_the_momentum() {
    let target = "material = 'own', thickness = '20 mm', back_face = 'fixed'";
    let options = "restitution = 1.0, friction = 0.0, outline = 'ball'";
    let result = run(GLASS, (20.0, 20.0), target, options, "");
    assert!((result.residual_velocity.unwrap() / 20.0 + 1.0).abs() < 1e-5);
    let numerics = result.numerics();
    let momentum = numerics.momentum;
    assert!((momentum.support / momentum.initial - 2.0).abs() < 1e-5);
    assert!(numerics.momentum_residual < 1e-12);
}
