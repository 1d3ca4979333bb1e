//! The plate alone, against the theory of plates.

use std::f64::consts::PI;

use super::*;

const MODULUS: f64 = 200e9;
const POISSONS_RATIO: f64 = 0.3;
const DENSITY: f64 = 7850.0;

fn metal(strength: &str) -> Material {
    toml::from_str(&format!(
        "name = 'a'\ndensity = '7850 kg/m3'\nyoungs_modulus = '200 GPa'\npoissons_ratio = {POISSONS_RATIO}\nstrength.{strength}"
    ))
    .unwrap()
}

fn plate(strength: &str, thickness: f64, inner_radius: f64, diameter: f64) -> Dishing {
    build(
        Dishing::around_boss,
        strength,
        thickness,
        inner_radius,
        diameter,
    )
}

type Build = fn(&Material, f64, f64, f64, PlateEdge, Failure, &ChainOptions) -> Dishing;

fn build(build: Build, strength: &str, thickness: f64, radius: f64, diameter: f64) -> Dishing {
    let edge = PlateEdge {
        diameter,
        support: EdgeSupport::Clamped,
    };
    let material = metal(strength);
    build(
        &material,
        thickness,
        material.room_temperature.si(),
        radius,
        edge,
        Failure::Never,
        &ChainOptions::default(),
    )
}

fn bending(thickness: f64) -> f64 {
    MODULUS * thickness.powi(3) / (12.0 * (1.0 - POISSONS_RATIO * POISSONS_RATIO))
}

/// Steps with a force of time and deflection, and what `look` sees after every step.
fn drive(
    plate: &mut Dishing,
    end: f64,
    mut force: impl FnMut(f64, &Dishing) -> f64,
    mut look: impl FnMut(f64, &Dishing),
) -> f64 {
    let step = 0.8 * plate.stable_step();
    let (mut time, mut work) = (0.0, 0.0);
    let mut kick = 0.5 * step;
    while time < end {
        let force = force(time, plate);
        let before = plate.velocity();
        plate.kick(force, kick);
        work += force * 0.5 * (before + plate.velocity()) * kick;
        plate.drift(step);
        time += step;
        kick = step;
        look(time, plate);
    }
    work
}

#[test]
fn its_energy_balance_closes() {
    let strengths = [
        "elastic = {}",
        "perfectly_plastic = { flow_stress = '400 MPa' }",
    ];
    let plates: [Build; 2] = [Dishing::around_boss, Dishing::new];
    for (strength, kind) in strengths.into_iter().flat_map(|s| plates.map(|p| (s, p))) {
        let mut plate = build(kind, strength, 0.012, 0.01, 0.5);
        let mut impulse = 0.0;
        let step = 0.8 * plate.stable_step();
        let mut kick = 0.5 * step;
        let work = drive(
            &mut plate,
            2e-4,
            |time, _| {
                let force = if time < 6e-5 { 400e3 } else { -50e3 };
                impulse += force * kick;
                kick = step;
                force
            },
            |_, _| {},
        );
        let energy = plate.kinetic_energy() + plate.elastic_energy() + plate.plastic_work;
        assert!(
            (energy / work - 1.0).abs() < 1e-9,
            "{strength}: {energy} {work}"
        );
        let momentum = plate.momentum() + plate.support_impulse;
        assert!(
            (momentum / impulse - 1.0).abs() < 1e-9,
            "{momentum} {impulse}"
        );
        assert_eq!(plate.plastic_work > 0.0, strength.starts_with("perf"));
    }
}

/// An endless plate takes a force at a point with the speed F/(8√(Dρh)), whatever the time, once the waves are long against plate and plug.
#[test]
fn before_the_edge_answers_it_is_a_dashpot() {
    let (thickness, force) = (0.005, 1000.0);
    let mut plate = plate("elastic = {}", thickness, 0.002, 1.6);
    let (mut from, mut to) = ((0.0, 0.0), (0.0, 0.0));
    drive(
        &mut plate,
        8e-4,
        |_, _| force,
        |time, plate| {
            if time < 4e-4 {
                from = (time, plate.deflection());
            }
            to = (time, plate.deflection());
        },
    );
    let speed = (to.1 - from.1) / (to.0 - from.0);
    let impedance = 8.0 * (bending(thickness) * DENSITY * thickness).sqrt();
    let ratio = speed * impedance / force;
    println!("speed over that of a dashpot: {ratio:.4}");
    assert!((ratio - 1.0).abs() < 0.02, "{ratio}");
}

/// A clamped plate around a rigid boss: mean deflection of its vibration under a step of force is the static one.
#[test]
fn it_swings_about_the_static_deflection() {
    let (thickness, inner, outer, force): (f64, f64, f64, f64) = (0.004, 0.02, 0.1, 100.0);
    let mut plate = plate("elastic = {}", thickness, inner, 2.0 * outer);
    // Damped to rest by an edge force against the motion.
    let mut last = 0.0;
    drive(
        &mut plate,
        0.05,
        |_, plate| force - 800.0 * plate.velocity(),
        |_, plate| last = plate.deflection(),
    );
    // w' = (F/4πD)(r ln r + A r + B/r), 0 at both edges; and what the section shears.
    let (a, b, d) = (inner, outer, bending(thickness));
    let shear = 5.0 / 6.0 * MODULUS / (2.0 * (1.0 + POISSONS_RATIO)) * thickness;
    let big_a = -(b * b * b.ln() - a * a * a.ln()) / (b * b - a * a);
    let big_b = -a * a * (a.ln() + big_a);
    let slope = |r: f64| force / (4.0 * PI * d) * (r * r.ln() + big_a * r + big_b / r);
    let count = 10_000;
    let step = (b - a) / f64::from(count);
    let bent: f64 = (0..count)
        .map(|i| slope(a + (f64::from(i) + 0.5) * step) * step)
        .sum();
    let exact = bent.abs() + force / (2.0 * PI * shear) * (b / a).ln();
    println!(
        "static deflection {:.6} of {:.6} um",
        last * 1e6,
        exact * 1e6
    );
    assert!((last / exact - 1.0).abs() < 2e-3, "{last} {exact}");
}

/// Limit load of a clamped, perfectly plastic annulus around a rigid boss, in bending and shear (von Mises): `M_r = (2m/√3) cos φ` from
/// φ = 0 at the boss to π at the support, `m = M₀ √(1 − (q/r)²)` being what the shear force leaves, where
/// `r φ' m sin φ = M₀ f + r m' cos φ − m sin(φ − π/6)`, `F = 4π M₀ f/√3` and `q = F/(2π Q₀) = f h/2`.
fn limit_load(stress: f64, thickness: f64, inner: f64, outer: f64) -> f64 {
    let stretch = |f: f64| {
        let count = 200_000;
        let step = PI / f64::from(count);
        let q = 0.5 * f * thickness;
        let mut logarithm = 0.0;
        for i in 0..count {
            let angle = (f64::from(i) + 0.5) * step;
            let used = (q / (inner * f64::exp(logarithm))).powi(2);
            let left = (1.0 - used).sqrt();
            let below = f + used / left * angle.cos() - left * (angle - PI / 6.0).sin();
            logarithm += left * angle.sin() / below * step;
        }
        logarithm
    };
    let (mut low, mut high) = (1.0, 2.0 * inner / thickness);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if stretch(middle) > (outer / inner).ln() {
            low = middle;
        } else {
            high = middle;
        }
    }
    PI * stress * thickness * thickness * low / 3.0_f64.sqrt()
}

/// A point load on a large plate: 2M₀ 2π/√3, as Tresca's 2πM₀ with von Mises' largest moment.
#[test]
fn the_limit_load_of_a_point_is_the_known_one() {
    let load = limit_load(4.0, 1.0, 1e30, 1e90) / (PI * 4.0 / 3.0_f64.sqrt());
    assert!((load - 1.0).abs() < 0.05, "{load}");
}

#[test]
fn pushed_slowly_it_resists_with_its_limit_load() {
    // Bent, and bent and sheared: half and nine tenths of what shears off at the inner circle.
    let large = limit_load_is_met(0.01, 0.02, 0.1);
    let small = limit_load_is_met(0.01, 0.02, 0.028);
    assert!(large < 0.5 && small > 0.85, "{large} {small}");
}

/// Returns the limit load over the shear force that the inner circle bears without a moment.
fn limit_load_is_met(thickness: f64, inner: f64, outer: f64) -> f64 {
    let exact = limit_load(300e6, thickness, inner, outer);
    let sheared_off = 2.0 * PI * inner * thickness * 300e6 / 3.0_f64.sqrt();
    let strength = "perfectly_plastic = { flow_stress = '300 MPa' }";
    let mut plate = plate(strength, thickness, inner, 2.0 * outer);
    // A hand that gives way moves the edge, slowly against the period of the plate.
    let (speed, rise) = (0.2, 2e-3);
    let (mut force_sum, mut count) = (0.0, 0);
    drive(
        &mut plate,
        0.02,
        |time, plate| {
            let way = speed * (time - rise * (1.0 - (-time / rise).exp()));
            let force = 2e8 * (way - plate.deflection()) + 1e4 * (speed - plate.velocity());
            if time > 0.016 {
                force_sum += force;
                count += 1;
            }
            force
        },
        |_, _| {},
    );
    let force = force_sum / f64::from(count);
    println!(
        "limit load {:.3} of {:.3} kN, sheared off at {:.3} kN",
        force * 1e-3,
        exact * 1e-3,
        sheared_off * 1e-3
    );
    assert!((force / exact - 1.0).abs() < 0.02, "{force} {exact}");
    exact / sheared_off
}
