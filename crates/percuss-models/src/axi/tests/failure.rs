//! Failure: damage in a state that does not change, and a bar that is torn.

use super::{Grid, Particle, Solid, body, deform, rectangle, solver};
use crate::{
    material::{Material, PreparedDamage},
    solid::Law,
};

const FLOW_STRESS: f64 = 400e6;
const SPEED: f64 = 200.0;
const D1: f64 = 0.1;
const D2: f64 = 0.8;
const D3: f64 = -1.5;

fn damage() -> PreparedDamage {
    let metal: Material = toml::from_str(&format!(
        "name = 'a'\ndensity = '7850 kg/m3'\nyoungs_modulus = '200 GPa'\npoissons_ratio = 0.3\n\
         strength.perfectly_plastic = {{ flow_stress = '400 MPa' }}\n\
         damage = {{ d1 = {D1}, d2 = {D2}, d3 = {D3} }}"
    ))
    .unwrap();
    metal.damage.as_ref().unwrap().prepare(&metal)
}

fn steel() -> Law {
    let mut solid = Solid::elastic(7850.0, 200e9, 0.3);
    solid.flow_stress = FLOW_STRESS;
    Law {
        damage: Some(damage()),
        ..solid.law()
    }
}

/// A particle under a pressure that is stretched along the axis at constant volume until it fails.
fn stretched(law: &Law, pressure: f64) -> (Particle, f64, f64) {
    const STEP: f64 = 1e-4;
    let mut particle = Particle {
        mass: law.density,
        volume: 1.0 / (1.0 + pressure / law.bulk_modulus),
        pressure,
        ..Particle::default()
    };
    particle.yield_point = law.slow_yield_point(&particle);
    // The midpoint rule makes of this gradient the rates (−1/2, −1/2, 1) times a number, whose trace vanishes.
    let rates = [-0.5, 1.0].map(|rate: f64| STEP * rate / (1.0 - 0.5 * STEP * rate));
    particle.gradient = [rates[0], 0.0, 0.0, rates[1]];
    let (mut work, mut given) = (0.0, 0.0);
    while !particle.has_failed() {
        let [done, plastic, failure] = deform(law, &mut particle, rates[0]);
        work += done - plastic;
        given += failure;
        assert!(particle.plastic_strain < 20.0);
    }
    (particle, work, given)
}

#[test]
fn a_particle_fails_at_the_strain_of_its_stress_triaxiality() {
    let law = steel();
    for pressure in [0.0, 800e6, -300e6] {
        let (particle, elastic, given) = stretched(&law, pressure);
        let exact = D1 + D2 * (D3 * -pressure / FLOW_STRESS).exp();
        let strain = particle.plastic_strain;
        println!("pressure {pressure:e}: fails at {strain:.4}, exact {exact:.4}");
        // To the increment of a step.
        assert!((0.0..1.001e-4).contains(&(strain - exact)));
        assert_eq!(particle.deviator, [0.0; 3]);
        assert_eq!(particle.pressure > 0.0, pressure > 0.0);
        assert!(particle.pressure >= 0.0);
        // What it gave up is the work that was stored in shear, and what the tension before had stored.
        let shear = FLOW_STRESS * FLOW_STRESS / (6.0 * law.shear_modulus);
        let tension = pressure.min(0.0).powi(2) / (2.0 * law.bulk_modulus);
        assert!((elastic / (shear * particle.volume) - 1.0).abs() < 5e-3);
        assert!((given / ((shear + tension) * particle.volume) - 1.0).abs() < 1e-6);
    }
}

#[test]
fn localized_strain_uses_a_particle_up_as_in_a_band_of_its_own_width() {
    let cell = 1.0;
    let law = Law {
        band_width: 0.25 * cell,
        ..steel()
    };
    let exact = D1 + D2;
    for (localization, times) in [(0.0, 1.0), (0.5, 2.5), (1.0, 4.0)] {
        let mut particle = Particle {
            mass: law.density,
            volume: 1.0,
            localization,
            ..Particle::default()
        };
        let mut strain = 0.0;
        while !particle.has_failed() {
            particle.deviator = [-FLOW_STRESS / 3.0, 2.0 / 3.0 * FLOW_STRESS, 0.0];
            law.fail(&mut particle, 1e-4, cell, 1e-6);
            strain += 1e-4;
        }
        println!("localized {localization}: fails at {strain:.4}");
        assert!((strain * times - exact).abs() < 1e-4 * times);
    }
}

/// A bar whose halves fly apart at 200 and 100 m/s, until it is in two.
fn torn(erode_failed: bool) -> Grid {
    const LENGTH: f64 = 20e-3;
    const RADIUS: f64 = 2.5e-3;
    let cell = RADIUS / 4.0;
    // Only the halves' own motion: a uniform stretch would fail everywhere at once.
    let halves = |[_, depth]: [f64; 2]| {
        (
            [0.0, if depth > 0.0 { SPEED } else { -0.5 * SPEED }],
            [0.0; 4],
        )
    };
    let sections = rectangle((0.0, RADIUS), (-LENGTH, LENGTH), 0.5 * cell);
    let law = Law {
        erode_failed,
        ..steel()
    };
    let mut solver = solver(vec![body(law, sections, &halves)], cell);
    while solver.time < 60e-6 {
        assert!(solver.advance());
    }
    solver
}

#[test]
fn a_torn_bar_flies_off_in_halves_and_its_energy_balance_closes() {
    for erode in [false, true] {
        let solver = torn(erode);
        let (energy, lost) = (solver.energy(), solver.accumulated.lost[0]);
        let particles: Vec<Particle> = solver.bodies[0].particles().collect();
        let failed = particles
            .iter()
            .filter(|p| p.mass > 0.0 && p.has_failed())
            .count();
        println!(
            "erode {erode}: {failed} failed, {lost} lost, eroded {:.2e}, to the grid {:.1e}, residual {:.1e}",
            energy.eroded / energy.initial,
            energy.transfer / energy.initial,
            energy.residual()
        );
        assert!(energy.residual().abs() < 1e-3);
        assert!(solver.momentum().residual().abs() < 1e-9);
        if erode {
            assert!(lost > 0 && failed == 0);
        } else {
            assert!(lost == 0 && failed > 0);
        }
        // Beyond the tear the halves go on, slower by what the tear took.
        let far = |side: f64| {
            let own = particles.iter().filter(|p| side * p.position[1] > 12e-3);
            own.map(|p| side * p.velocity[1])
                .fold(f64::INFINITY, f64::min)
        };
        assert!(far(1.0) > 0.7 * SPEED && far(-1.0) > 0.25 * SPEED);
    }
}
