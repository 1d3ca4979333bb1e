use std::f64::consts::PI;

use super::{
    super::{gauss::integral, impact_wave::ImpactWave, rod_flow::RodFlow},
    motion::Motion,
    target::Target,
};

/// A tungsten alloy on steel.
fn tungsten_on_steel() -> Motion {
    Motion {
        rod: RodFlow {
            density: 17600.0,
            strength: 1.5e9,
            area: PI * 0.0025_f64.powi(2),
        },
        target: Target {
            density: 7850.0,
            strength: 1e9,
            youngs_modulus: 205e9,
            entry: true,
        },
        wave: ImpactWave {
            share: 0.66,
            speed: 4030.0,
            ratio: 1.14,
        },
        mass_factor: 1.0,
    }
}

/// Rods that erode, mushroom, stay rigid, turn rigid and flatten.
fn cases() -> Vec<(Motion, f64, f64)> {
    let base = tungsten_on_steel();
    let mut cases = Vec::new();
    for (strength, target_strength) in [(1.5e9, 1e9), (0.3e9, 1e9), (6e9, 0.4e9), (1.5e9, 0.3e9)] {
        for speed in [200.0, 600.0, 1500.0, 4000.0] {
            for length in [0.0025, 0.015, 0.1] {
                let mut motion = base;
                motion.rod.strength = strength;
                motion.target.strength = target_strength;
                cases.push((motion, speed, length));
            }
        }
    }
    cases
}

/// Every share is a rate of its own; no share is what the others leave over.
#[test]
fn the_shares_add_up_to_the_kinetic_energy() {
    let mut worst: f64 = 0.0;
    for (motion, speed, length) in cases() {
        let stop = motion.penetrate(speed, length).unwrap();
        let energy = 0.5 * motion.rod.density * motion.rod.area * length * speed * speed;
        let shares = stop.shares;
        for share in [
            shares.shock,
            shares.rod_plastic,
            shares.debris,
            shares.pressing,
            shares.flow,
        ] {
            assert!(share >= -1e-9 * energy, "{shares:?} {motion:?} {speed}");
        }
        worst = worst.max((shares.total() / energy - 1.0).abs());
    }
    assert!(worst < 1e-9, "{worst:e}");
}

/// Force times the speed of the floor is what the rod's energy leaves after debris and plastic work: momentum and energy of the
/// turned flow agree.
#[test]
fn the_power_on_the_floor_is_what_rod_and_debris_leave() {
    let rod = tungsten_on_steel().rod;
    for (tail, floor) in [
        (200.0, 150.0),
        (800.0, 100.0),
        (1500.0, 900.0),
        (4000.0, 2400.0),
    ] {
        let arriving: f64 = tail - floor;
        let turned = rod.turned(arriving);
        let leaving = turned.leaving * arriving;
        // Y and ½ρw² come in, plastic work and ½ρ(xw)² go out.
        let left = rod.strength + 0.5 * rod.density * (arriving.powi(2) - leaving.powi(2));
        assert!((left / rod.plastic_work(turned) - 1.0).abs() < 1e-12);
        let stagnation = rod.strength + 0.5 * rod.density * arriving * arriving;
        let force = rod.force(arriving, turned);
        assert!((force / (rod.area * turned.spread * stagnation) - 1.0).abs() < 1e-12);
        let brought = rod.area * (0.5 * rod.density * arriving * tail * tail + rod.strength * tail);
        let gone = rod.area
            * arriving
            * (0.5 * rod.density * (floor - leaving).powi(2) + rod.plastic_work(turned));
        assert!((force * floor / (brought - gone) - 1.0).abs() < 1e-12);
    }
}

/// The mean strain of the flow `v_z = wz/s` out to the rod's own radius is 1.
#[test]
fn metal_that_spreads_has_the_mean_strain_of_its_field() {
    let strain = |part: f64| -2.0 * part.ln() * 2.0 * part;
    assert!((integral(0.0, 1.0, 4000, strain) - 1.0).abs() < 1e-6);
    let rod = tungsten_on_steel().rod;
    let still = rod.turned(0.0);
    assert_eq!((still.spread, still.leaving), (1.0, 0.0));
    assert_eq!(rod.plastic_work(still), rod.strength);
    // The series of a slow flow meets the root.
    let edge = (1e-9 * rod.strength / rod.density).sqrt();
    let (below, above) = (rod.turned(0.999 * edge), rod.turned(1.001 * edge));
    assert!((above.spread - below.spread).abs() < 1e-11);
    assert!((above.leaving - below.leaving).abs() < 1e-6);
    let fast = rod.turned(1e6);
    assert!((fast.spread - 4.0).abs() < 1e-3 && (fast.leaving - 1.0).abs() < 1e-3);
}

#[test]
fn at_high_speed_the_depth_is_hydrodynamic() {
    for densities in [(17600.0, 7850.0), (7850.0, 7850.0), (2700.0, 7850.0)] {
        let mut motion = tungsten_on_steel();
        (motion.rod.density, motion.target.density) = densities;
        (motion.rod.strength, motion.target.strength) = (1e6, 1e6);
        motion.mass_factor = 0.01;
        let limit: f64 = densities.0 / densities.1;
        let depth = motion.penetrate(20_000.0, 2.0).unwrap().depth;
        assert!(
            (depth / (2.0 * limit.sqrt()) - 1.0).abs() < 1e-3,
            "{depth} {limit}"
        );
        // With the target's moving mass entry and the flow after the rod add a depth that does not depend on the length.
        motion.mass_factor = 1.0;
        let of = |length| motion.penetrate(20_000.0, length).unwrap().depth;
        let gained = of(4.0) - of(2.0);
        assert!(
            (gained / (2.0 * limit.sqrt()) - 1.0).abs() < 1e-3,
            "{gained}"
        );
    }
}

/// A rigid rod and a target without inertia: the crater is the rod's, `½ρLV² = R P`, as in `crater_energy`.
#[test]
fn a_rigid_rod_pays_for_its_crater() {
    let mut motion = tungsten_on_steel();
    motion.rod.strength = 20e9;
    motion.target.density = 1e-6;
    motion.target.entry = false;
    motion.mass_factor = 1e-9;
    let stop = motion.penetrate(600.0, 0.1).unwrap();
    let depth = 0.5 * 17600.0 * 600.0 * 600.0 * 0.1 / motion.target.deep();
    assert!((stop.depth / depth - 1.0).abs() < 1e-6, "{stop:?} {depth}");
    let volume = stop.shares.target() / motion.target.deep();
    assert!((volume / (motion.rod.area * depth) - 1.0).abs() < 1e-6);
}

/// The mass is twice the kinetic energy of the irrotational flow over U², by quadrature of its field.
#[test]
fn the_moving_mass_is_that_of_its_field() {
    let target = tungsten_on_steel().target;
    let alpha = target.extent();
    let cube = alpha.powi(3);
    // v_r = f(r) cos θ and v_θ = −(f + r f'/2) sin θ with f = (α³/r³ − 1)/(α³ − 1); means of cos² and sin² over a hemisphere: 1/3, 2/3.
    let energy = |r: f64| {
        let radial = (cube / r.powi(3) - 1.0) / (cube - 1.0);
        let slope = -3.0 * cube / r.powi(4) / (cube - 1.0);
        let around = radial + 0.5 * r * slope;
        2.0 * PI * r * r * (radial * radial / 3.0 + 2.0 * around * around / 3.0)
    };
    let mass = target.density * 1e-6 * integral(1.0, alpha, 200, energy);
    assert!((target.moving_mass(0.01) / mass - 1.0).abs() < 1e-9);
}

/// The resistance rises from that of a punch on a surface to that of a deep cavity, and no field is below the exact punch.
#[test]
fn the_resistance_rises_from_punch_to_cavity() {
    let target = tungsten_on_steel().target;
    let mut before = 2.845 * target.strength;
    for depth in 0..20 {
        let resistance = target.resistance(1e-3 * f64::from(depth), 0.004);
        assert!(resistance >= before && resistance <= target.deep());
        before = resistance;
    }
    assert_eq!(before, target.deep());
}
