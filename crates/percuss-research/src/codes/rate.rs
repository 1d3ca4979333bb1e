//! Strain rate that enters the flow stress of a run, compared with the rate at which plastic strain grows.
//!
//! A rate-dependent law takes the equivalent plastic strain rate `√(2/3 D_p:D_p)`. Over a time of many steps it is the growth of the
//! plastic strain per time. Where plastic flow starts and stops from step to step, the steps with flow have a larger rate, and so a larger
//! flow stress than the law has at the mean rate. The excess measures that error of a code.

use std::ops::ControlFlow;

use percuss::{
    Error, Scenario,
    material::FlowState,
    model::{self, Control},
    solver::{Particle, frames::Frame},
};

/// Slowest flow that counts [1/s], and smallest plastic strain.
const SLOWEST: f64 = 2e3;
const SMALLEST: f64 = 0.02;

/// Particles of the projectile at one time.
struct Picture {
    time: f64,
    particles: Vec<Particle>,
}

/// Excess of the equivalent stress over the law at the mean plastic strain rate between frames, in a run of `axi` [%]: mean over all
/// particles and frames with flow, weighted by the rate. `None` where nothing flows.
///
/// # Errors
/// Those of the run.
pub fn stress_excess(scenario: &Scenario) -> Result<Option<f64>, Error> {
    let mut pictures = Vec::new();
    let mut keep = |frame: &Frame<'_>| {
        let own = frame.fields.particles().filter(|(body, _)| *body == 0);
        pictures.push(Picture {
            time: frame.time,
            particles: own.map(|(_, particle)| particle).collect(),
        });
        ControlFlow::Continue(())
    };
    let mut control = Control {
        frames: Some(&mut keep),
        ..Control::default()
    };
    model::run(model::model("axi")?, scenario, &mut control)?;
    let material = &scenario.projectile.material;
    let law = material.strength.law().prepare(material, 1.0);
    let (mut sum, mut weights) = (0.0, 0.0);
    for [before, now, after] in pictures.windows(3).filter_map(|part| match part {
        [before, now, after] => Some([before, now, after]),
        _ => None,
    }) {
        let time = after.time - before.time;
        if time <= 0.0 {
            continue;
        }
        for particle in &now.particles {
            let strains = [before, after].map(|picture| strain_of(particle, now.time, picture));
            let [Some(first), Some(last)] = strains else {
                continue;
            };
            let rate = (last - first) / time;
            if rate < SLOWEST || particle.plastic_strain < SMALLEST {
                continue;
            }
            let flow = law.flow_stress(&FlowState {
                strain_rate: rate,
                ..particle.flow_state()
            });
            sum += rate * (particle.equivalent_stress() / flow.stress - 1.0);
            weights += rate;
        }
    }
    Ok((weights > 0.0).then(|| 100.0 * sum / weights))
}

/// Plastic strain of a particle in another picture: that of the nearest particle to where its velocity takes it.
///
/// Particles are sorted during a run. Between frames one moves by a fraction of their distance.
fn strain_of(particle: &Particle, time: f64, picture: &Picture) -> Option<f64> {
    let step = picture.time - time;
    let place = [0, 1].map(|k| particle.position[k] + step * particle.velocity[k]);
    let distance = |other: &Particle| {
        let [r, z] = [0, 1].map(|k| other.position[k] - place[k]);
        r * r + z * z
    };
    let nearest = picture
        .particles
        .iter()
        .filter(|other| (other.mass - particle.mass).abs() <= 1e-9 * particle.mass)
        .min_by(|a, b| distance(a).total_cmp(&distance(b)));
    nearest.map(|other| other.plastic_strain)
}
