//! What nodes do not resolve: the field of a lone particle, and pressures that differ within a group.

use super::{Solid, body, solver};
use crate::{
    axi::{
        block::Block,
        mesh::{Axis, Mesh},
    },
    lanes::Lanes,
    solid::{Law, Rates},
    solver::{Control, Particle},
};

const DENSITY: f64 = 2700.0;
const BULK_MODULUS: f64 = 75e9;

/// A liquid in plane strain.
fn liquid() -> Law {
    let solid = Solid {
        density: DENSITY,
        bulk_modulus: BULK_MODULUS,
        shear_modulus: 26e9,
        flow_stress: 1.0,
    };
    Law {
        axisymmetric: false,
        ..solid.law()
    }
}

/// A lone drop that is drawn out keeps its volume, and no energy comes from its motion. Free flight alone would compress it to nothing
/// within one strain; where cells are stretched one way only, its pressure cannot hold it.
#[test]
fn a_lone_drop_draws_no_energy_from_its_motion() {
    let cell = 1e-3;
    for rate in [-1e6, 1e6] {
        let drawn = move |_| ([50.0, 0.0], [rate, 0.0, 0.0, -rate]);
        let place = ([9.3 * cell, 0.2 * cell], 0.25 * cell * cell);
        let mut grid = solver(vec![body(liquid(), [place], &drawn)], cell);
        grid.mesh = Mesh {
            cell,
            radial: Axis::graded(cell, 4.0, 0.5),
            axial: Axis::even(cell),
        };
        grid.start(&mut Control::default()).unwrap();
        let initial = grid.accumulated.initial_energy;
        let volume = grid.bodies[0].blocks[0].volume[0];
        let mut most = 0.0_f64;
        while grid.time * rate.abs() < 6.0 {
            assert!(grid.advance());
            most = most.max(grid.sums[0].kinetic / initial);
            let now = grid.bodies[0].blocks[0].volume[0] / volume;
            assert!((0.9..1.1).contains(&now), "{rate}: volume {now}");
        }
        println!(
            "rate {rate}: at most {most} of the energy, residual {:.1e}",
            grid.energy().residual()
        );
        assert!(most < 1.0 + 1e-3, "{rate}: {most}");
        assert!(grid.energy().residual().abs() < 1e-4);
    }
}

/// Two particles of a group whose pressures differ: the difference decays as `exp(−4 γ)` with the shear γ, their volume stays, and what
/// they lose of elastic energy is heat.
#[test]
fn pressures_of_a_group_come_together_at_the_rate_of_shear() {
    const STEPS: u32 = 1000;
    let (law, shear, time_step) = (liquid(), 1e5, 2e-8);
    let excess = 1e8;
    let mut particles: Vec<Particle> = [3.0, 1.0]
        .into_iter()
        .zip([excess, -3.0 * excess])
        .map(|(volume, pressure)| Particle {
            volume,
            mass: DENSITY * volume * (1.0 + pressure / BULK_MODULUS),
            pressure,
            ..Particle::default()
        })
        .collect();
    for particle in &mut particles {
        particle.yield_point = law.slow_yield_point(particle);
    }
    let volume = |particles: &[Particle]| particles.iter().map(|p| p.volume).sum::<f64>();
    let elastic =
        |particles: &[Particle]| particles.iter().map(|p| law.elastic_energy(p)).sum::<f64>();
    let before = (volume(&particles), elastic(&particles));
    let mut heat = 0.0;
    for _ in 0..STEPS {
        let mut block = Block::default();
        for (lane, particle) in particles.iter().enumerate() {
            block.set_particle(lane, particle);
        }
        let weighted: f64 = particles.iter().map(|p| p.volume * p.pressure).sum();
        let mean = weighted / volume(&particles);
        let mut rates = Rates::NONE;
        rates.relax(
            &block,
            &Lanes::all(mean),
            &Lanes::all(shear),
            &law,
            time_step,
        );
        let cells = Lanes::all(1.0);
        let work = law.deform(&mut block, &rates, time_step, &cells);
        for (lane, particle) in particles.iter_mut().enumerate() {
            *particle = block.particle(lane);
        }
        heat += work.viscous[0] + work.viscous[1];
    }
    let strain = f64::from(STEPS) * time_step * shear;
    let left = (particles[0].pressure - particles[1].pressure) / (4.0 * excess);
    println!("left {left:.4e}, exact {:.4e}", (-4.0 * strain).exp());
    assert!((left / (-4.0 * strain).exp() - 1.0).abs() < 0.05);
    assert!((volume(&particles) / before.0 - 1.0).abs() < 1e-6);
    let lost = before.1 - elastic(&particles);
    assert!(
        lost > 0.99 * before.1 && (heat / lost - 1.0).abs() < 0.02,
        "{heat} {lost}"
    );
}
