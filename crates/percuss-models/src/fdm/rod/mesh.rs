//! From a scenario to the grid at the moment of impact.

use std::f64::consts::PI;

use super::law::RodLaw;
use crate::{
    fdm::grid::{BoundaryCondition, Grid, Slab},
    material::Material,
    options::{RodOptions, constraint_factor},
    problem::RearFaceCondition,
    scenario::{Scenario, TargetBody, modelled_thickness},
};

/// A law for a material; `factor` multiplies its flow stress.
fn law(
    material: &Material,
    area: f64,
    factor: f64,
    options: &RodOptions,
    scenario: &Scenario,
) -> RodLaw {
    let chain = &scenario.options.chain;
    let heating = match material.specific_heat {
        Some(heat) if chain.adiabatic_heating() => {
            // What the constraint adds to the stress is work against the material around the column, not heat in it.
            chain.heat_fraction() / (factor * material.density.si() * heat.si())
        }
        _ => 0.0,
    };
    RodLaw {
        modulus: material.youngs_modulus.si(),
        density: material.density.si(),
        wave_speed: material.bar_wave_speed(),
        area,
        strength: material.strength.law().prepare(material, factor),
        heating,
        start_temperature: material.room_temperature.si(),
        rate_effects: chain.rate_effects(),
        viscosity: options.artificial_viscosity,
    }
}

fn slab(law: RodLaw, start: f64, length: f64, cells: usize) -> Slab<RodLaw> {
    Slab {
        line_density: law.density * law.area,
        line_friction: 0.0,
        start,
        length,
        cells,
        velocity: 0.0,
        law,
    }
}

pub(super) fn build(scenario: &Scenario, options: &RodOptions) -> Grid<RodLaw> {
    let rod = &scenario.projectile;
    let area = rod.mass / (rod.material.density.si() * rod.length);
    let projectile = law(&rod.material, area, 1.0, options, scenario);
    let mut slabs = vec![slab(
        projectile,
        -rod.length,
        rod.length,
        options.projectile_elements as usize,
    )];
    slabs[0].velocity = scenario.impact_velocity;
    let mut end = BoundaryCondition::Free;
    let mut tip_pressure = 0.0;
    match &scenario.target {
        TargetBody::Layers {
            layers,
            back_face,
            column_diameter,
            ..
        } => {
            let area = PI * column_diameter * column_diameter / 4.0;
            let total = scenario.modelled_length();
            let all = options.target_elements as f64;
            let mut start = 0.0;
            for plate in layers {
                let material = &plate.material;
                let temperature = plate.start_temperature();
                let factor = constraint_factor(options.constraint_factor, material, temperature);
                let thickness = modelled_thickness(plate, scenario);
                let cells = ((all * thickness / total).round() as usize).max(1);
                let law = law(material, area, factor, options, scenario);
                let mut slab = slab(law, start, thickness, cells);
                let flow_stress = plate.flow_stress_at_unit_strain();
                slab.line_friction =
                    options.border_shear * PI * column_diameter * flow_stress.unwrap_or(0.0);
                slabs.push(slab);
                start += thickness;
            }
            end = match (back_face, layers.last()) {
                (RearFaceCondition::Fixed, _) => BoundaryCondition::Driven(0.0),
                (RearFaceCondition::NonReflecting, Some(last)) => {
                    BoundaryCondition::Dashpot(last.material.bar_impedance() * area)
                }
                (RearFaceCondition::Free, _) | (_, None) => BoundaryCondition::Free,
            };
        }
        TargetBody::RigidWall => {
            let wall = law(&rod.material, area, 1.0, options, scenario);
            slabs.push(slab(wall, 0.0, 0.0, 0));
            end = BoundaryCondition::Driven(0.0);
        }
        TargetBody::ConstantPressure(pressure) => tip_pressure = pressure * area,
    }
    let mut grid = Grid::new(slabs, [BoundaryCondition::Free, end]);
    if let Some(friction) = grid.nodes.friction.last_mut() {
        if tip_pressure > 0.0 {
            *friction = tip_pressure;
            grid.tip_pressure = tip_pressure;
        }
        // The boundary's own impedance stands for everything behind it, border shear included.
        if let BoundaryCondition::Dashpot(_) = end {
            *friction = 0.0;
        }
    }
    grid
}
