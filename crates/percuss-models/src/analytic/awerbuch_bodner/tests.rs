use std::f64::consts::PI;

use super::{history, stages::Impact};

/// 197 g, 20 mm, on 12 mm of steel.
fn impact(crushing: f64, shear: f64) -> Impact {
    let diameter = 0.02;
    let area = PI * diameter * diameter / 4.0;
    Impact {
        mass: 0.197,
        area,
        thickness: 0.012,
        density: 7850.0,
        crushing_force: crushing * area,
        rim_force: shear * PI * diameter,
    }
}

#[test]
fn without_strength_momentum_is_kept() {
    let impact = impact(0.0, 0.0);
    for speed in [10.0, 200.0, 2000.0] {
        let case = impact.case(speed, false);
        let expected = impact.mass * speed / impact.joint_mass();
        assert!((case.last.speed / expected - 1.0).abs() < 1e-12);
        assert!(case.contact_time.is_some());
    }
}

#[test]
fn without_a_plate_nothing_is_lost() {
    let thin = Impact {
        thickness: 1e-9,
        ..impact(1.5e9, 3e8)
    };
    let case = thin.case(100.0, false);
    assert!((case.last.speed / 100.0 - 1.0).abs() < 1e-6, "{case:?}");
}

#[test]
fn all_energy_and_momentum_have_a_line() {
    // The last three crush first, and the very last stops there.
    for (crushing, shear, speed) in [
        (1.5e9, 3.3e8, 300.0),
        (1.5e9, 3.3e8, 100.0),
        (5e8, 3.3e8, 300.0),
        (2e8, 3.3e8, 150.0),
        (3e8, 6e8, 20.0),
    ] {
        let impact = impact(crushing, shear);
        let case = impact.case(speed, true);
        for sample in history::of(&impact, &case, 0.08).samples {
            let (energy, momentum) = (sample.energy.residual(), sample.momentum.residual());
            assert!(energy.abs() < 1e-7, "{crushing} {speed} {sample:?}");
            assert!(momentum.abs() < 1e-7, "{crushing} {speed} {sample:?}");
        }
        assert!(case.last.capture >= 0.0 && case.last.crushing_work > 0.0);
    }
}

#[test]
fn the_force_gives_the_impulse_on_the_projectile() {
    let impact = impact(5e8, 3.3e8);
    let case = impact.case(300.0, true);
    let impulse: f64 = case
        .moments
        .windows(2)
        .map(|pair| (pair[1].0.time - pair[0].0.time) * (pair[0].1 + pair[1].1) / 2.0)
        .sum();
    let expected = impact.mass * (300.0 - case.last.speed);
    assert!(
        (impulse / expected - 1.0).abs() < 1e-3,
        "{impulse} {expected}"
    );
}

#[test]
fn a_plate_that_cannot_be_crushed_gives_recht_and_ipson() {
    let impact = impact(1e15, 3.3e8);
    let limit = impact.plugging_limit();
    assert!((impact.ballistic_limit(limit) / limit - 1.0).abs() < 1e-6);
    let residual = impact.case(300.0, false).last.speed;
    let factor = impact.mass / impact.joint_mass();
    let expected = factor * (300.0_f64.powi(2) - limit * limit).sqrt();
    assert!(
        (residual / expected - 1.0).abs() < 1e-6,
        "{residual} {expected}"
    );
}

#[test]
fn a_heavy_projectile_takes_the_work_of_shear_from_its_energy() {
    // Rigid limit: neither the plug's mass nor the capture counts, V² − V_r² = 2 W/m.
    let impact = Impact {
        mass: 1e4,
        ..impact(1e12, 3.3e8)
    };
    let work = impact.rim_force * impact.thickness.powi(2) / 2.0;
    let residual = impact.case(10.0, false).last.speed;
    let lost = 0.5 * impact.mass * (100.0 - residual * residual);
    // The plug of 30 g carries ½ m_p V² = 1.5 J and its capture takes as much again.
    assert!((lost - work - 2.96).abs() < 0.05, "{lost} {work}");
}

#[test]
fn residual_velocity_grows_from_zero_at_the_limit() {
    for crushing in [2e8, 5e8, 1.5e9] {
        let impact = impact(crushing, 3.3e8);
        let limit = impact.ballistic_limit(impact.plugging_limit());
        assert!(
            impact
                .case(limit * (1.0 - 1e-6), false)
                .contact_time
                .is_none()
        );
        let mut before = impact.case(limit * (1.0 + 1e-6), false).last.speed;
        assert!(before < 0.02 * limit, "{before} {limit}");
        for i in 1..200 {
            let speed = limit * (1.0 + 0.02 * f64::from(i));
            let residual = impact.case(speed, false).last.speed;
            assert!(residual > before && residual < speed, "{crushing} {speed}");
            before = residual;
        }
    }
}

#[test]
fn fast_projectiles_pass_in_the_time_of_their_flight() {
    let impact = Impact {
        mass: 100.0,
        ..impact(1.5e9, 3.3e8)
    };
    let time = impact.case(5000.0, false).contact_time.unwrap();
    assert!((time * 5000.0 / 0.012 - 1.0).abs() < 1e-3, "{time}");
}
