//! Strength that depends on pressure: the yield stress is evaluated again in every step, also where a particle bears no stress.

use super::{Particle, Solid, deform};
use crate::{material::Library, solid::Law};

/// Tungsten by Steinberg and Guinan, in small elastic constants of its own.
fn tungsten() -> Law {
    let material = &Library::built_in()
        .find("tungsten-steinberg")
        .unwrap()
        .material;
    Law {
        strength: material.strength.law().prepare(material, 1.0),
        ..Solid::elastic(material.density.si(), material.youngs_modulus.si(), 0.28).law()
    }
}

fn at_rest(law: &Law, temperature: f64) -> Particle {
    let mut particle = Particle {
        mass: law.density,
        volume: 1.0,
        temperature,
        ..Particle::default()
    };
    particle.yield_point = law.slow_yield_point(&particle);
    particle
}

#[test]
fn a_particle_without_stress_stays_at_rest() {
    let law = tungsten();
    assert!(law.strength.depends_on_pressure());
    // Beyond its melting point a metal has no strength: a stress of 0 then lies on the yield surface.
    for temperature in [300.0, 20e3] {
        let rest = at_rest(&law, temperature);
        let mut particle = rest;
        for _ in 0..3 {
            assert_eq!(deform(&law, &mut particle, 0.0), [0.0; 3]);
        }
        assert_eq!(particle.deviator, [0.0; 3]);
        assert_eq!(particle.pressure, 0.0);
        assert_eq!(particle.plastic_strain, 0.0);
    }
}

#[test]
fn the_stress_after_flow_is_the_yield_stress_of_the_pressure() {
    let law = tungsten();
    let mut particle = at_rest(&law, 300.0);
    // Two steps: the first compresses, the second shears at the pressure that the first one left.
    particle.gradient = [-0.01, 0.0, 0.0, -0.01];
    deform(&law, &mut particle, -0.01);
    let compressed = particle;
    assert!(compressed.pressure > 5e9 && compressed.plastic_strain == 0.0);
    particle.gradient = [-0.01, 0.0, 0.0, 0.02];
    deform(&law, &mut particle, -0.01);
    let state = crate::material::FlowState {
        plastic_strain: particle.plastic_strain,
        ..compressed.flow_state()
    };
    let exact = law.strength.flow_stress(&state).stress;
    let unloaded = crate::material::FlowState {
        pressure: 0.0,
        ..state
    };
    assert!(exact > 1.05 * law.strength.flow_stress(&unloaded).stress);
    assert!((particle.equivalent_stress() / exact - 1.0).abs() < 1e-7);
}
