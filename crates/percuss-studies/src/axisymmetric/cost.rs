//! Estimated cost of a run of `axi`, before it starts.

use crate::{
    Scenario,
    scenario::{Plate, TargetBody},
};

/// Processor time that an axisymmetric answer may take unasked [s].
pub const BUDGET: f64 = 60.0;

/// Particles times steps per second of processor time: 8.6 to 11.4 million on one core of 2024.
const RATE: f64 = 1e7;
/// Radii of the projectile to which the target is modelled, and below the depth that the impact may reach.
const MARGIN: f64 = 10.0;
/// Steps of a run per cell along the radius: at least, and per diameter of the projectile's length.
///
/// Of 322 runs of the benchmark (7 pairs of metals, 1 to 10 diameters, 150 to 1500 m/s, 4 to 12 cells) the estimated cost is 0.76 to 1.6
/// times the counted one (10th to 90th percentile, at most 2.4 times), the number of particles 0.99 to 1.01 times.
const STEPS: (f64, f64) = (30.0, 60.0);

/// Estimated processor time of a run of `axi` on a mesh [s]: particles times steps over a rate. It grows with the third power of the
/// number of cells.
pub fn seconds(scenario: &Scenario, cells_per_radius: u32) -> f64 {
    let cells = f64::from(cells_per_radius);
    let slenderness = scenario.projectile.length / scenario.projectile.diameter;
    let steps = cells * (STEPS.0 + STEPS.1 * slenderness);
    particles(scenario, cells) * steps / RATE
}

/// Particles of projectile and target.
fn particles(scenario: &Scenario, cells: f64) -> f64 {
    let rod = &scenario.projectile;
    let radius = 0.5 * rod.diameter;
    let side = f64::from(scenario.options.axi.particles_per_side());
    let projectile = rod.length / radius;
    let target = match &scenario.target {
        TargetBody::Layers { layers, .. } => {
            let options = &scenario.options.axi;
            let width = options.target_radius.map_or(MARGIN, |r| r.si() / radius);
            width * modelled_depth(scenario, layers) / radius
        }
        _ => 0.0,
    };
    side * side * cells * cells * (projectile + target)
}

/// Depth of the target that is modelled [m].
fn modelled_depth(scenario: &Scenario, layers: &[Plate]) -> f64 {
    let rod = &scenario.projectile;
    let needed = scenario.options.axi.target_depth.map_or_else(
        || {
            let jet = layers.last().map_or(0.0, |layer| {
                let density = layer.material.density.si();
                1.2 * rod.length * (rod.material.density.si() / density).sqrt()
            });
            let flow_stress = layers.last().and_then(|l| l.material.flow_stress(0.2));
            let energy = 0.5 * rod.material.density.si() * scenario.impact_velocity.powi(2);
            let crater = flow_stress.map_or(jet, |y| (energy * rod.length / (3.0 * y)).min(jet));
            MARGIN * 0.5 * rod.diameter + crater
        },
        |depth| depth.si(),
    );
    match scenario.target_thickness() {
        Some(thickness) if thickness < 1.5 * needed => thickness,
        _ => needed,
    }
}
