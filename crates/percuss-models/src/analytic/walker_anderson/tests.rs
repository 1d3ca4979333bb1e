use super::{flow::Flow, motion::Motion};
use crate::analytic::Rods;

/// A tungsten alloy on steel, L = 100 mm, D = 5 mm.
const TUNGSTEN_ON_STEEL: Motion = Motion {
    density: 17600.0,
    strength: 1.5e9,
    bar_speed: 4200.0,
    sound_speed: 4030.0,
    slope: 1.24,
    target: Flow {
        density: 7850.0,
        shear_modulus: 77e9,
        strength: 1.2e9,
        sound_speed: 4570.0,
        slope: 1.49,
    },
    crater_radius: 5e-3,
};
const LENGTH: f64 = 0.1;

fn tate(motion: &Motion, resistance: f64) -> Rods {
    Rods {
        projectile_density: motion.density,
        target_density: motion.target.density,
        projectile_strength: motion.strength,
        target_resistance: resistance,
    }
}

#[test]
fn equal_materials_meet_half_way_and_the_shock_pressures_agree() {
    let target = TUNGSTEN_ON_STEEL.target;
    let equal = Motion {
        density: target.density,
        sound_speed: target.sound_speed,
        slope: target.slope,
        ..TUNGSTEN_ON_STEEL
    };
    assert!((equal.tip_speed_at_impact(2000.0) / 1000.0 - 1.0).abs() < 1e-14);
    for speed in [10.0, 500.0, 3000.0] {
        let motion = TUNGSTEN_ON_STEEL;
        let u = motion.tip_speed_at_impact(speed);
        let w = speed - u;
        let behind = motion.density * w * (motion.sound_speed + motion.slope * w);
        let ahead = target.density * u * (target.sound_speed + target.slope * u);
        assert!(u < speed && (behind / ahead - 1.0).abs() < 1e-12);
    }
}

/// As the crater radius goes to zero and wave speeds to infinity, plastic zones and their inertia vanish, `α` goes to `√(2G/Y)`
/// and the equations become Tate's with `R = (7/6) Y ln(2G/Y)`.
#[test]
fn it_tends_to_tate_as_its_own_assumptions_vanish() {
    for (strength, target_strength) in [(1.5e9, 1.2e9), (4e9, 0.5e9)] {
        for speed in [1000.0, 1500.0, 2500.0] {
            let mut before = f64::INFINITY;
            for smallness in [1e-1, 1e-2, 1e-3] {
                let mut motion = TUNGSTEN_ON_STEEL;
                motion.strength = strength;
                motion.target.strength = target_strength;
                motion.crater_radius *= smallness;
                motion.bar_speed /= smallness * smallness;
                motion.target.sound_speed /= smallness;
                // The impedance match stays that of the material: only the start depends on it.
                motion.sound_speed /= smallness;
                let resistance = 7.0 / 6.0 * target_strength * (2.0 * 77e9 / target_strength).ln();
                let exact = tate(&motion, resistance).penetrate(speed, LENGTH).unwrap();
                let stop = motion.penetrate(speed, LENGTH).unwrap();
                let error = (stop.depth / exact.depth - 1.0).abs();
                println!(
                    "Y {strength:e}, {speed} m/s, smallness {smallness:e}: depth off by {error:.2e}"
                );
                assert!(error < 0.35 * before, "{error} {before}");
                before = error;
            }
            assert!(before < 1e-2, "{before}");
        }
    }
}

/// The flow starts at the impact shock's speed, above the steady one, and comes near the speed that Tate gives for the
/// resistance of the moment.
#[test]
fn the_tip_starts_fast_and_becomes_nearly_steady() {
    let motion = TUNGSTEN_ON_STEEL;
    let mut middle = None;
    let end = motion
        .erode(1500.0, LENGTH, |time, state| {
            if middle.is_none() && state[2] < 0.6 * LENGTH {
                middle = Some((time, *state));
            }
        })
        .unwrap();
    let (_, [tail, tip, ..]) = middle.unwrap();
    let resistance = motion.target.resistance(motion.target.extent(tip).alpha);
    let steady = tate(&motion, resistance).penetration_speed(tail);
    println!("tip {tip:.1} m/s, Tate with the resistance of the moment {steady:.1} m/s");
    assert!(motion.tip_speed_at_impact(1500.0) > 1.05 * tip);
    assert!((tip / steady - 1.0).abs() < 0.05);
    assert!(end.state[2] < 0.6 * LENGTH);
}

/// What the tail loses in speed is what its own equation says, integrated apart from the solver's state.
#[test]
fn the_momentum_of_the_axis_balances() {
    let motion = TUNGSTEN_ON_STEEL;
    // Momentum per area on the axis in rod and target, of linear and spherical velocity profiles.
    let momentum = |&[tail, tip, length, _]: &[f64; 4]| {
        let alpha = motion.target.extent(tip).alpha;
        let plastic = motion.plastic_length(tail, tip);
        let rod = motion.density * (tail * (length - plastic) + 0.5 * (tail + tip) * plastic);
        let target =
            motion.target.density * tip * motion.crater_radius * (alpha - 1.0) / (alpha + 1.0);
        rod + target
    };
    // What leaves the rod does so, on the mean, with the mean speed of tail and tip, and the target flows off with half the
    // tip's: that is what Bernoulli's pressures say of the axis.
    let mut impulse = 0.0;
    let mut last: Option<(f64, [f64; 4], f64)> = None;
    let mut first = None;
    let rate = |&[tail, tip, ..]: &[f64; 4]| {
        let resistance = motion.target.resistance(motion.target.extent(tip).alpha);
        let eroded = 0.5 * motion.density * (tail - tip) * (tail + tip);
        let flowing_off = 0.5 * motion.target.density * tip * tip;
        -eroded - flowing_off - resistance
    };
    motion
        .erode(1500.0, LENGTH, |time, state| {
            let now = rate(state);
            if let Some((before, _, then)) = last {
                impulse += 0.5 * (time - before) * (now + then);
            } else {
                first = Some(momentum(state));
            }
            last = Some((time, *state, now));
        })
        .unwrap();
    let change = momentum(&last.unwrap().1) - first.unwrap();
    println!("change {change:.6e}, impulse {impulse:.6e}");
    assert!((change / impulse - 1.0).abs() < 1e-3, "{change} {impulse}");
}

#[test]
fn a_strong_rod_turns_rigid_and_a_weak_one_is_used_up() {
    let mut strong = TUNGSTEN_ON_STEEL;
    strong.strength = 5e9;
    strong.target.strength = 0.4e9;
    let stop = strong.penetrate(1200.0, LENGTH).unwrap();
    assert!(stop.rigid_depth > 0.5 * stop.depth && stop.length > 0.5 * LENGTH);
    let stop = TUNGSTEN_ON_STEEL.penetrate(3000.0, LENGTH).unwrap();
    assert!(stop.length < 0.1 * LENGTH, "{stop:?}");
}

#[test]
fn depth_grows_with_speed_and_scales_with_size() {
    let mut before = 0.0;
    for speed in (2..40).map(|i| 100.0 * f64::from(i)) {
        let stop = TUNGSTEN_ON_STEEL.penetrate(speed, LENGTH).unwrap();
        assert!(stop.depth > before, "{speed}: {} {before}", stop.depth);
        before = stop.depth;
        let twice = Motion {
            crater_radius: 2.0 * TUNGSTEN_ON_STEEL.crater_radius,
            ..TUNGSTEN_ON_STEEL
        };
        let scaled = twice.penetrate(speed, 2.0 * LENGTH).unwrap();
        assert!((scaled.depth / stop.depth - 2.0).abs() < 1e-6);
    }
}
