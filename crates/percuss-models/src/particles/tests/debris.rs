//! Contact of pieces: exact collisions of discs, books, and bodies that meet.

use super::strip;
use crate::particles::bonded::Bonded;
use crate::{
    options::Space,
    particles::{
        body::Body,
        bonded::Load,
        debris::{ContactLaw, Debris},
    },
};

const SPACE: Space = Space::PlaneStress;
const SPACING: f64 = 1e-3;

/// A body with the contacts of its particles.
struct Scene {
    body: Body,
    debris: Debris<2>,
    law: ContactLaw,
    loads: Vec<Load<2>>,
    step: f64,
}

impl Scene {
    /// A scene whose time step is a part of the time in which a pair swings by a radian.
    fn new(body: Body, restitution: f64, friction: f64, part: f64) -> Self {
        let lattice = body.lattice;
        let step = part / (2.0 * lattice.normal / lattice.mass).sqrt();
        let mut scene = Self {
            law: ContactLaw::new(
                (lattice.spacing, lattice.normal),
                0.0,
                restitution,
                friction,
            ),
            debris: Debris::default(),
            loads: Vec::new(),
            body,
            step,
        };
        scene.debris.search(&scene.body, &scene.law);
        scene
    }

    fn advance(&mut self) {
        self.body.advance(self.step, &self.loads);
        if self.debris.has_moved(&self.body) {
            self.debris.search(&self.body, &self.law);
        }
        self.debris.update(&self.body, &self.law, self.step);
        self.loads = self.debris.loads(&self.body, &self.law);
        self.loads.sort_by_key(|load| (load.row, load.place));
    }

    /// Energy, with that which contacts have lost.
    fn energy(&self) -> f64 {
        let sums = self.body.sums(self.step, &self.loads);
        sums.kinetic + sums.elastic + self.debris.energy(&self.body, &self.law) + self.debris.lost
    }

    fn speeds(&self, (row, place): (usize, usize)) -> [f64; 3] {
        let motion = &self.body.motion[row];
        [motion.x[place], motion.z[place], motion.spin[place]]
    }

    /// Both momenta and the angular momentum about the origin, and sums of the sizes of their parts.
    fn momenta(&self) -> ([f64; 3], [f64; 3]) {
        let (mut sum, mut size) = ([0.0; 3], [0.0; 3]);
        for (row, place) in self.body.particles() {
            let mass = self.body.rows[row].mass[place];
            let inertia = 1.0 / self.body.rows[row].inverse_inertia[place];
            let [x, z] = self.body.position(row, place);
            let [vx, vz, spin] = self.speeds((row, place));
            // Positions half a step back, where the velocities are.
            let (x, z) = (x - 0.5 * self.step * vx, z - 0.5 * self.step * vz);
            for (axis, parts) in [
                [mass * vx, 0.0, 0.0],
                [mass * vz, 0.0, 0.0],
                [mass * x * vz, -mass * z * vx, inertia * spin],
            ]
            .into_iter()
            .enumerate()
            {
                for part in parts {
                    sum[axis] += part;
                    size[axis] += part.abs();
                }
            }
        }
        (sum, size)
    }
}

/// Free discs, at rest, the first ones at these positions and the others far from them, with their rows and places.
fn discs(positions: &[[f64; 2]]) -> (Body, Vec<(usize, usize)>) {
    let mut body = strip(SPACE, 0.0, 3, 6);
    let ids: Vec<_> = body.particles().collect();
    let (mass, inertia) = (body.lattice.mass, body.lattice.inertia);
    for (index, &(row, place)) in ids.iter().enumerate() {
        let make = &mut body.rows[row];
        make.mass[place] = mass;
        make.inverse_mass[place] = 1.0 / mass;
        make.inverse_inertia[place] = 1.0 / inertia;
        for weights in &mut make.weights {
            weights[place] = 0.0;
        }
        let far = [1.0 + 0.1 * index as f64, 0.0];
        let [x, z] = positions.get(index).copied().unwrap_or(far);
        let [x0, z0] = body.reference(row, place);
        body.state[row].x[place] = x - x0;
        body.state[row].z[place] = z - z0;
    }
    (body, ids)
}

/// Two discs that meet with a normal and a tangential relative speed [m/s], after the collision.
fn collision(speeds: [f64; 2], restitution: f64, friction: f64) -> (Scene, [(usize, usize); 2]) {
    let gap = 1e-6 * SPACING;
    let (mut body, ids) = discs(&[[0.0, 0.0], [SPACING + gap, 0.0]]);
    let [a, b] = [ids[0], ids[1]];
    for (end, sign) in [(a, 0.5), (b, -0.5)] {
        body.motion[end.0].x[end.1] = sign * speeds[0];
        body.motion[end.0].z[end.1] = -sign * speeds[1];
    }
    let part = 2e-4;
    let mut scene = Scene::new(body, restitution, friction, part);
    let steps = gap / speeds[0] / scene.step + 8.0 / part;
    for _ in 0..steps as usize {
        scene.advance();
    }
    (scene, [a, b])
}

#[test]
fn discs_part_with_their_restitution() {
    for restitution in [0.2, 0.4, 0.6, 0.8, 0.9, 1.0] {
        let (scene, [a, b]) = collision([100.0, 0.0], restitution, 0.3);
        let parted = scene.speeds(b)[0] - scene.speeds(a)[0];
        println!("{restitution}: {}", parted / 100.0);
        assert!(
            (parted / 100.0 - restitution).abs() < 1e-3,
            "{restitution}: {parted}"
        );
        assert!(scene.speeds(a)[2].abs() < 1e-9);
        let energy = scene.energy() / (0.25 * scene.body.lattice.mass * 1e4) - 1.0;
        assert!(energy.abs() < 1e-3, "{restitution}: {energy}");
    }
}

/// Discs that slide all the time: tangential impulse `μ` times the normal one, and spins of its moment.
#[test]
fn gross_slip_takes_the_impulse_of_coulomb() {
    let (restitution, friction) = (0.8, 0.2);
    let speeds = [0.002, 0.01];
    let (scene, [a, b]) = collision(speeds, restitution, friction);
    let (first, second) = (scene.speeds(a), scene.speeds(b));
    let change = friction * (1.0 + restitution) * speeds[0];
    let past = second[1] - first[1];
    println!("past {past}, change {}", speeds[1] - past);
    assert!(((speeds[1] - past) / change - 1.0).abs() < 5e-3, "{past}");
    let lattice = scene.body.lattice;
    let spin = 0.5 * change * lattice.mass * 0.5 * SPACING / lattice.inertia;
    assert!((first[2] / spin - 1.0).abs() < 5e-3, "{} {spin}", first[2]);
    assert!(
        (second[2] / spin - 1.0).abs() < 5e-3,
        "{} {spin}",
        second[2]
    );
    let start = 0.25 * lattice.mass * (speeds[0].powi(2) + speeds[1].powi(2));
    assert!((scene.energy() / start - 1.0).abs() < 1e-4);
    assert!(scene.debris.lost > 0.01 * start);
}

/// Balls in a row, not quite touching: the last one leaves with the speed of the first.
#[test]
fn a_cradle_hands_its_speed_on() {
    let positions: Vec<[f64; 2]> = (0..5)
        .map(|i| [1.05 * SPACING * f64::from(i), 0.0])
        .collect();
    let (mut body, ids) = discs(&positions);
    body.motion[ids[0].0].x[ids[0].1] = 100.0;
    let mut scene = Scene::new(body, 1.0, 0.0, 0.01);
    let before = scene.momenta().0[0];
    for _ in 0..6000 {
        scene.advance();
    }
    for (index, &end) in ids[..5].iter().enumerate() {
        let expected = if index == 4 { 100.0 } else { 0.0 };
        let speed = scene.speeds(end)[0];
        assert!((speed - expected).abs() < 0.1, "{index}: {speed}");
    }
    assert!((scene.momenta().0[0] / before - 1.0).abs() < 1e-12);
}

/// A crowd of discs that run into each other with friction and damping.
#[test]
fn a_crowd_keeps_its_momenta_and_its_books() {
    let place = |i: u32| {
        [
            1.3 * SPACING * f64::from(i % 4),
            1.3 * SPACING * f64::from(i / 4),
        ]
    };
    let (mut body, ids) = discs(&(0..12).map(place).collect::<Vec<_>>());
    for (index, &(row, at)) in ids[..12].iter().enumerate() {
        let [x, z] = place(index as u32);
        // Towards the middle, and around it.
        let (x, z) = (x - 2.0 * SPACING, z - 1.2 * SPACING);
        body.motion[row].x[at] = (-60.0 * x + 25.0 * z) / SPACING;
        body.motion[row].z[at] = (-45.0 * z - 31.0 * x) / SPACING;
    }
    let mut scene = Scene::new(body, 0.7, 0.3, 0.01);
    let ((before, _), start) = (scene.momenta(), scene.energy());
    let mut worst: f64 = 0.0;
    for _ in 0..8000 {
        scene.advance();
        worst = worst.max((scene.energy() / start - 1.0).abs());
    }
    let (after, size) = scene.momenta();
    println!("energy {worst:e}, lost {}", scene.debris.lost / start);
    for axis in 0..2 {
        let error = (after[axis] - before[axis]) / size[axis];
        assert!(error.abs() < 1e-12, "{axis}: {error:e}");
    }
    // The arms of the moments are those of the positions, half a step from the velocities.
    let turn = (after[2] - before[2]) / size[2];
    assert!(turn.abs() < 1e-3, "{turn:e}");
    assert!(scene.debris.lost > 0.1 * start);
    assert!(worst < 1e-4, "{worst:e}");
}

/// Two bars of one length: after a wave has gone along both and back, they part with exchanged velocities.
#[test]
fn bars_part_after_a_round_trip_of_their_waves() {
    let columns = 241;
    let mut body = strip(SPACE, 0.0, 9, columns);
    let ids: Vec<_> = body.particles().collect();
    let middle = 0.25 * SPACING;
    let side = |x: f64| if x < middle { 1.0 } else { -1.0 };
    for &(row, place) in &ids {
        let x = body.reference(row, place)[0];
        body.motion[row].x[place] = 5.0 * side(x);
        for kind in 0..3 {
            let (other_row, other) = body.other_end(row, place, kind);
            if other_row < body.rows.len() && side(body.reference(other_row, other)[0]) != side(x) {
                body.rows[row].weights[kind][place] = 0.0;
            }
        }
    }
    let mut scene = Scene::new(body, 1.0, 0.0, 0.2);
    let start = scene.energy();
    let speed = (70e9_f64 / 2500.0).sqrt();
    let passage = 0.5 * SPACING * columns as f64 / speed;
    let mean = |scene: &Scene| {
        let (mut momentum, mut mass) = (0.0, 0.0);
        for &(row, place) in ids
            .iter()
            .filter(|&&(row, place)| scene.body.reference(row, place)[0] < middle)
        {
            momentum += scene.body.rows[row].mass[place] * scene.body.motion[row].x[place];
            mass += scene.body.rows[row].mass[place];
        }
        momentum / mass
    };
    let (mut time, mut touching, mut worst) = (0.0, 0.0, 0.0_f64);
    while time < 3.0 * passage {
        scene.advance();
        time += scene.step;
        if scene
            .loads
            .iter()
            .map(|load| load.force[0].abs())
            .sum::<f64>()
            > 0.0
        {
            touching = time;
        }
        worst = worst.max((scene.energy() / start - 1.0).abs());
    }
    println!(
        "contact {}, velocity {}, energy {worst:e}",
        touching / (2.0 * passage),
        mean(&scene)
    );
    assert!((mean(&scene) / -5.0 - 1.0).abs() < 0.02, "{}", mean(&scene));
    assert!(
        (touching / (2.0 * passage) - 1.0).abs() < 0.05,
        "{touching} {passage}"
    );
    assert!(worst < 1e-3, "{worst:e}");
}
