//! From a scenario to the chain at the moment of impact.

use std::f64::consts::PI;

use super::{
    cone::{Cone, Grading},
    element::{Plastic, Spring},
    interface::Interface,
    part::{Role, Section},
    solver::LARGEST_STRAIN_STEP,
    state::{Accumulators, BoundaryCondition, Element, Node, Nodes, Segment, State},
};
use crate::{
    lanes::Blocks,
    material::{FlowState, YieldPoint},
    options::{ErosionCriterion, Kinematics, TargetResistanceModel, constraint_factor},
    problem::{LayerInterface, RearFaceCondition},
    scenario::{Plate, Scenario, TargetBody, modelled_thickness},
};

/// Elements of each layer: as the grading shares them, at least one each.
fn layer_elements(plates: &[Plate], scenario: &Scenario, grading: Option<Grading>) -> Vec<usize> {
    let total: f64 = plates.iter().map(|p| modelled_thickness(p, scenario)).sum();
    let elements = scenario.options.chain.target_elements() as f64;
    let mut start = 0.0;
    plates
        .iter()
        .map(|plate| {
            let thickness = modelled_thickness(plate, scenario);
            let share = grading.map_or(elements * thickness / total, |grading| {
                grading.elements_to(start + thickness) - grading.elements_to(start)
            });
            start += thickness;
            (share.round() as usize).max(1)
        })
        .collect()
}

/// The cone that stands for a target, and the sizes of its elements: at the mouth that of the projectile's.
fn cone_and_grading(layers: &[Plate], scenario: &Scenario, mouth: f64) -> Option<(Cone, Grading)> {
    let options = &scenario.options.chain;
    if options.target_resistance() == TargetResistanceModel::Column {
        return None;
    }
    let cone = Cone::under_disc(mouth, layers.first()?.material.poissons_ratio);
    let thickness = scenario.modelled_length();
    let first = scenario.projectile.length / options.projectile_elements() as f64;
    let grading = Grading::new(first, thickness, options.target_elements());
    Some((cone, grading))
}

pub(super) fn build(scenario: &Scenario) -> State {
    let options = &scenario.options.chain;
    let rod = &scenario.projectile;
    let rod_elements = options.projectile_elements();
    let mut projectile = Section::new(
        Role::Projectile,
        &rod.material,
        rod.mass / (rod.material.density.si() * rod.length),
        rod_elements,
        1.0,
        options,
    );
    projectile.start_temperature = rod.start_temperature();
    let mut parts = vec![projectile];
    let mut lengths = vec![rod.length];
    let mut interfaces = vec![Before::TOUCHING];
    let mut cone = None;
    let mut struck = None;
    let mut end = BoundaryCondition::Free;
    match &scenario.target {
        TargetBody::Layers {
            layers,
            back_face,
            column_diameter,
            ..
        } => {
            let diameter = |plate: &Plate| plate.column_diameter.unwrap_or(*column_diameter);
            let area = |plate: &Plate| match options.erosion_criterion() {
                ErosionCriterion::Strain => PI * diameter(plate) * diameter(plate) / 4.0,
                ErosionCriterion::Tate => parts[0].area,
            };
            let areas: Vec<f64> = layers.iter().map(area).collect();
            struck = layers.first();
            cone = cone_and_grading(layers, scenario, parts[0].area);
            let grading = cone.map(|(_, grading)| grading);
            for ((plate, elements), &area) in layers
                .iter()
                .zip(layer_elements(layers, scenario, grading))
                .zip(&areas)
            {
                let material = &plate.material;
                let factor = match cone {
                    Some(_) => 1.0,
                    None => constraint_factor(
                        options.constraint_factor(),
                        material,
                        plate.start_temperature(),
                    ),
                };
                let mut part =
                    Section::new(Role::Target, material, area, elements, factor, options);
                part.start_temperature = plate.start_temperature();
                let flow_stress = plate.flow_stress_at_unit_strain();
                part.friction_per_length =
                    options.border_shear() * PI * diameter(plate) * flow_stress.unwrap_or(0.0);
                if options.erosion_criterion() == ErosionCriterion::Tate || cone.is_some() {
                    // What holds the target ahead of the tip stands instead of border shear; a cone widens instead.
                    part.friction_per_length = 0.0;
                }
                parts.push(part);
                lengths.push(modelled_thickness(plate, scenario));
                interfaces.push(Before {
                    gap: plate.gap,
                    bonded: plate.interface == LayerInterface::Bonded,
                });
            }
            let area = areas.last().copied().unwrap_or_default();
            end = match (back_face, layers.last()) {
                (RearFaceCondition::Fixed, _) => BoundaryCondition::Fixed,
                (RearFaceCondition::NonReflecting, Some(last)) => {
                    let thickness = lengths[1..].iter().sum();
                    let behind = |cone: Cone| cone.area_at(thickness);
                    BoundaryCondition::Open {
                        impedance: last.material.bar_impedance()
                            * cone.map_or(area, |(cone, _)| behind(cone)),
                        stiffness: cone.map_or(0.0, |(cone, _)| {
                            last.material.youngs_modulus.si() * cone.stiffness_beyond(thickness)
                        }),
                    }
                }
                (RearFaceCondition::Free, _) | (_, None) => BoundaryCondition::Free,
            };
        }
        TargetBody::RigidWall => {
            parts.push(Section::new(
                Role::Target,
                &rod.material,
                0.0,
                0,
                1.0,
                options,
            ));
            interfaces.push(Before::TOUCHING);
            lengths.push(0.0);
            end = BoundaryCondition::Fixed;
        }
        TargetBody::ConstantPressure(_) => {}
    }
    let mut state = assemble(parts, &lengths, &interfaces, end, cone);
    if let TargetBody::ConstantPressure(pressure) = scenario.target {
        state.tip_friction = pressure * state.parts[0].area;
        state.nodes.friction[rod_elements] = state.tip_friction;
    }
    if options.erosion_criterion() == ErosionCriterion::Tate {
        state.add_tip(rod.diameter);
    }
    if options.target_resistance() == TargetResistanceModel::DivergingPenetrable
        && let Some(plate) = struck
    {
        state.let_penetrate(&plate.material, plate.start_temperature());
    }
    state.constrain_plug(scenario);
    state.nodes.velocity[..=rod_elements].fill(scenario.impact_velocity);
    // At the first step the elements at the interface see the whole impact velocity.
    if state.parts[0].kinematics == Kinematics::Logarithmic {
        let lengths =
            (0..state.elements.len()).map(|e| state.elements.part(e, |block| &block.rest_length));
        let smallest = lengths.fold(f64::INFINITY, f64::min);
        let first_step = LARGEST_STRAIN_STEP * smallest / scenario.impact_velocity;
        state.stable_step = state.stable_step.min(first_step);
    }
    state.accumulated.initial_energy = state.energy().kinetic_projectile;
    state.accumulated.initial_momentum = state.momentum().projectile;
    state
}

/// How a part is joined to the one before it.
#[derive(Debug, Clone, Copy)]
struct Before {
    /// [m].
    gap: f64,
    bonded: bool,
}

impl Before {
    const TOUCHING: Self = Self {
        gap: 0.0,
        bonded: false,
    };

    fn interface(&self) -> Interface {
        if self.bonded {
            Interface::BONDED
        } else if self.gap > 0.0 {
            Interface::OPEN
        } else {
            Interface::TOUCHING
        }
    }
}

/// Lines the parts up, the first one ending and the second one starting at 0.
fn assemble(
    parts: Vec<Section>,
    lengths: &[f64],
    before: &[Before],
    end: BoundaryCondition,
    cone: Option<(Cone, Grading)>,
) -> State {
    let elements: usize = parts.iter().map(|part| part.elements).sum();
    let nodes = elements + parts.len();
    let mut state = State {
        segments: Vec::new(),
        interfaces: before[1..].iter().map(Before::interface).collect(),
        end,
        tip_friction: 0.0,
        gaps: Vec::new(),
        tip: None,
        penetration: None,
        hold: None,
        drag: 0.0,
        back_position: 0.0,
        nodes: Nodes::default(),
        elements: Blocks::default(),
        time: 0.0,
        step: 0,
        time_step: 0.0,
        stable_step: f64::INFINITY,
        partings: Vec::new(),
        working: Vec::new(),
        meetings: 0,
        contact_force: 0.0,
        back_force: 0.0,
        accumulated: Accumulators::default(),
        parts,
    };
    for i in 0..nodes {
        state.nodes.insert(i, Node::default());
    }
    let mut first_element = 0;
    let mut start = -lengths[0];
    for (p, &length) in lengths.iter().enumerate() {
        let part = &state.parts[p];
        if before[p].gap > 0.0 {
            state.gaps.push([start, start + before[p].gap]);
        }
        start += before[p].gap;
        let count = part.elements;
        let first_node = first_element + p;
        state.segments.push(Segment {
            part: p,
            first_node,
            last_node: first_node + count,
            shift: p,
        });
        let size = length / count.max(1) as f64;
        let widens = cone.filter(|_| part.role == Role::Target);
        let graded = widens.map(|(_, grading)| grading.nodes(start, start + length, count));
        for i in 0..=count {
            // The last node stands exactly where the next part's first one does.
            let from_end = (count - i) as f64;
            state.nodes.position[first_node + i] = match &graded {
                Some(depths) => depths[i],
                None => start + length - size * from_end,
            };
        }
        let yield_point = YieldPoint::slow(
            &*part.strength,
            &FlowState {
                plastic_strain: 0.0,
                strain_rate: 0.0,
                temperature: part.start_temperature,
                pressure: 0.0,
            },
        );
        for e in first_element..first_element + count {
            let node = e + p;
            let (back, front) = (state.nodes.position[node], state.nodes.position[node + 1]);
            let (rest_area, volume, end_masses) = match widens {
                Some((cone, _)) => {
                    let area = cone.area_between(back, front);
                    let volumes = cone.volumes_between(back, front);
                    (
                        area,
                        area * (front - back),
                        volumes.map(|v| part.density * v),
                    )
                }
                // All elements alike: their lengths differ by rounding, as positions do.
                None => (
                    part.area,
                    part.area * size,
                    [0.5 * part.density * part.area * size; 2],
                ),
            };
            let half_friction = 0.5 * part.friction_per_length * size;
            for (node, mass) in [node, node + 1].into_iter().zip(end_masses) {
                state.nodes.mass[node] += mass;
                state.nodes.friction[node] += half_friction;
            }
            state.elements.push(Element {
                rest_length: front - back,
                rest_area,
                volume,
                spring: Spring {
                    unloaded_length: front - back,
                    ..Spring::default()
                },
                plastic: Plastic {
                    temperature: part.start_temperature,
                    ..Plastic::default()
                },
                end_masses,
                length: front - back,
                initial_position: 0.5 * (front + back),
                yield_point,
                ..Element::default()
            });
            state.stable_step = state.stable_step.min((front - back) / part.wave_speed);
        }
        first_element += count;
        start += length;
    }
    state.back_position = state.nodes.position[nodes - 1];
    // The boundary's own impedance stands for everything behind it, border shear included.
    if let (BoundaryCondition::Open { .. }, Some(last)) = (end, state.nodes.friction.last_mut()) {
        *last = 0.0;
    }
    state
}
