use std::f64::consts::PI;

use super::{
    super::{
        cavity_expansion::CavityExpansion, gauss::integral, impact_wave::ImpactWave,
        rod_flow::RodFlow, tate::Rods,
    },
    motion::Motion,
    zone::Zone,
};

const STEEL: CavityExpansion = CavityExpansion {
    density: 7850.0,
    youngs_modulus: 205e9,
    poissons_ratio: 0.29,
    yield_stress: 1e9,
};

fn tungsten_on_steel() -> Motion {
    Motion {
        rod: RodFlow {
            density: 17600.0,
            strength: 1.5e9,
            area: PI * 0.0025_f64.powi(2),
        },
        zone: Zone::new(&STEEL, true),
        radius: 4e-3,
        wave: ImpactWave {
            share: 17600.0 * 4030.0 / (17600.0 * 4030.0 + 7850.0 * 4570.0),
            speed: 4030.0,
            ratio: 4570.0 / 4030.0,
        },
        slice: 2.5e-3,
    }
}

/// A zone of one extent.
fn constant(zone: Zone, alpha: f64) -> Zone {
    Zone {
        extents: vec![(0.0, alpha)],
        ..zone
    }
}

/// Without shear between rays a slow zone has the static pressure of spherical cavity expansion, compressible or not.
#[test]
fn a_slow_zone_has_the_pressure_of_cavity_expansion() {
    for poissons_ratio in [0.2, 0.29, 0.4, 0.499_999_9] {
        for yield_stress in [0.1e9, 1e9, 3e9] {
            let body = CavityExpansion {
                poissons_ratio,
                yield_stress,
                ..STEEL
            };
            let zone = Zone::new(&body, false);
            let pressure = zone.resistance(zone.extent(0.0));
            assert!((pressure / body.static_pressure() - 1.0).abs() < 1e-5);
            if poissons_ratio > 0.49 {
                let ratio: f64 = 2.0 * 205e9 / (3.0 * yield_stress);
                let hill = 2.0 / 3.0 * yield_stress * (1.0 + ratio.ln());
                assert!((pressure / hill - 1.0).abs() < 2e-3, "{pressure} {hill}");
            }
        }
    }
}

/// Momentum on the axis: the integral of `2Y/r` and of the shear, whose stress is `τ = −Yθ/3` near the axis.
#[test]
fn the_stress_gradient_is_that_of_the_field() {
    let alpha: f64 = 5.0;
    let f = |r: f64| Zone::velocity(alpha, r);
    let h = 1e-4;
    let slope = |r: f64| (f(r + h) - f(r - h)) / (2.0 * h);
    let curvature = |r: f64| (f(r + h) - 2.0 * f(r) + f(r - h)) / (h * h);
    // v_r = f cos θ, v_θ = −g sin θ with g = f + r f'/2, so that the volume stays; 2ε_rθ = −sin θ (g' − g/r + f/r).
    let gradient = |r: f64| {
        let (g, g_slope) = (
            f(r) + 0.5 * r * slope(r),
            1.5 * slope(r) + 0.5 * r * curvature(r),
        );
        let shear = -0.5 * (g_slope - g / r + f(r) / r);
        let stress = 2.0 / 3.0 * shear / slope(r).abs();
        2.0 / r - 2.0 * stress / r
    };
    let sum = integral(1.0 + h, alpha - h, 200, gradient);
    let zone = tungsten_on_steel().zone;
    let exact = zone.gradient * ((alpha - h) / (1.0 + h)).ln();
    assert!((sum / exact - 1.0).abs() < 1e-4, "{sum} {exact}");
}

/// The mass on the axis is the integral of the velocity; the convective term is Bernoulli's for any extent.
#[test]
fn the_inertia_is_that_of_the_field() {
    for alpha in [1.2, 2.0, 5.0, 20.0] {
        let moved = integral(1.0, alpha, 400, |r| Zone::velocity(alpha, r));
        assert!((moved / Zone::moving_length(alpha) - 1.0).abs() < 1e-9);
        assert_eq!(
            (Zone::velocity(alpha, 1.0), Zone::velocity(alpha, alpha)),
            (1.0, 0.0)
        );
    }
}

#[test]
fn a_faster_floor_has_a_smaller_zone() {
    let zone = tungsten_on_steel().zone;
    let mut before = f64::INFINITY;
    for speed in 0..60 {
        let extent = zone.extent(100.0 * f64::from(speed) + 1.0);
        assert!(extent <= before && extent >= 1.0);
        before = extent;
    }
    let (last, alpha) = *zone.extents.last().unwrap();
    assert!((zone.extent(last * 1.000_001) / alpha - 1.0).abs() < 1e-5);
}

/// With a vanishing floor the moving mass vanishes, and with a constant extent the equations are Tate's.
#[test]
fn it_tends_to_tate_as_the_moving_mass_vanishes() {
    for (strength, alpha) in [(1.5e9, 5.0), (1.5e9, 2.0), (8e9, 3.0)] {
        for speed in [1000.0, 1500.0, 2500.0] {
            let mut before = f64::INFINITY;
            for radius in [4e-4, 4e-5, 4e-6] {
                let mut motion = tungsten_on_steel();
                motion.rod.strength = strength;
                motion.zone = constant(motion.zone, alpha);
                motion.radius = radius;
                motion.slice = 0.0;
                let rods = Rods {
                    projectile_density: 17600.0,
                    target_density: 7850.0,
                    projectile_strength: strength,
                    target_resistance: motion.zone.resistance(alpha),
                };
                let tate = rods.penetrate(speed, 0.1).unwrap().depth;
                let depth = motion.penetrate(speed, 0.1).unwrap().depth;
                let error = (depth / tate - 1.0).abs();
                assert!(
                    error < before || error < 1e-6,
                    "{strength} {speed} {radius} {error:e}"
                );
                before = error;
            }
            assert!(before < 2e-3, "{strength} {alpha} {speed} {before:e}");
        }
    }
}

/// A rigid rod with a constant zone is Poncelet's: `P = (ρL/ρ_t) ln(1 + ρ_t V²/2R)`, C = 1/2.
#[test]
fn a_rigid_rod_is_poncelets() {
    let mut motion = tungsten_on_steel();
    motion.rod.strength = 1e11;
    motion.zone = constant(motion.zone, 4.0);
    motion.radius = 1e-7;
    let resistance = motion.zone.resistance(4.0);
    for speed in [100.0_f64, 500.0, 1500.0] {
        let exact = 17600.0 * 0.1 / 7850.0 * (7850.0 * speed * speed / (2.0 * resistance)).ln_1p();
        let stop = motion.penetrate(speed, 0.1).unwrap();
        assert!(
            (stop.depth / exact - 1.0).abs() < 1e-5,
            "{} {exact}",
            stop.depth
        );
        assert!((stop.after_erosion / stop.depth - 1.0).abs() < 1e-6);
    }
    // With a formed zone its mass goes with the rod's: the depth of a heavier rod, less the energy that forming takes.
    motion.radius = 4e-3;
    let stop = motion.penetrate(500.0, 0.1).unwrap();
    let heavier = 17600.0 * 0.1 + motion.full_mass();
    let bound = heavier / 7850.0 * (7850.0 * 500.0 * 500.0 / (2.0 * resistance)).ln_1p();
    assert!(
        stop.depth < bound && stop.depth > 0.97 * bound,
        "{stop:?} {bound}"
    );
}

/// The slice that the first contact stops is still part of a rod that flows: at the slowest impacts it keeps its length.
#[test]
fn a_slow_rod_keeps_its_length() {
    let motion = tungsten_on_steel();
    for speed in [0.5_f64, 5.0, 50.0] {
        let stop = motion.penetrate(speed, 0.05).unwrap();
        let shorter = 1.0 - stop.length / 0.05;
        // Taylor's `ρ V²/2Y`, of the length.
        let flattened = 0.5 * motion.rod.density * speed * speed / motion.rod.strength;
        println!("{speed} m/s: shorter by {shorter:e}, flattened alone {flattened:e}");
        assert!(
            (0.0..2.0 * flattened).contains(&shorter),
            "{speed}: {stop:?}"
        );
    }
}

/// Momentum on the axis at the end is what it was, less what the stresses and the leaving metal took.
#[test]
fn the_momentum_balance_closes() {
    let mut worst: f64 = 0.0;
    for strength in [0.5e9, 1.5e9, 6e9] {
        for yield_stress in [0.2e9, 1e9] {
            for speed in [300.0, 800.0, 1500.0, 4000.0] {
                for length in [0.01, 0.1] {
                    let mut motion = tungsten_on_steel();
                    motion.rod.strength = strength;
                    let body = CavityExpansion {
                        yield_stress,
                        ..STEEL
                    };
                    motion.zone = Zone::new(&body, true);
                    let stop = motion.penetrate(speed, length).unwrap();
                    worst = worst.max(stop.balance_error.abs());
                    assert!(stop.depth >= 0.0 && stop.length >= 0.0);
                }
            }
        }
    }
    assert!(worst < 1e-5, "{worst:e}");
}

/// The target's own motion goes on after the erosion: deeper by a few radii of the floor, the more the faster.
#[test]
fn the_flow_after_the_erosion_adds_depth() {
    let motion = tungsten_on_steel();
    let mut before = 0.01 * motion.radius;
    for speed in [1500.0, 2000.0, 3000.0, 4000.0] {
        let stop = motion.penetrate(speed, 0.05).unwrap();
        assert!(stop.after_erosion > before, "{speed} {stop:?}");
        before = stop.after_erosion;
    }
    assert!(before < 5.0 * motion.radius, "{before}");
}
