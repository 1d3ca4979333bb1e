//! From a case to bodies of particles.

use super::{
    body::{Body, Limits},
    boundary::{BoundaryCondition, BoundaryConditions},
    contact::Contact,
    fill::{Division, Filling},
    mesh::{Axis, Mesh},
    run::materials,
    solver::{Accumulators, DeferredWork, Grid},
    surface::{STEP, Surface},
};
use crate::{
    Error, Scenario,
    material::Material,
    options::{ContactKind, Edge},
    problem::{Nose, RearFaceCondition},
    regime::{THICK, is_thinner},
    scenario::{Rod, TargetBody},
    solid::{Behaviour, Law},
    solver::{Control, Particle, estimate::expected_depth},
};

/// Radii of the projectile that a target is modelled out to, and below the depth that the impact is expected to reach.
const MARGIN: f64 = 10.0;

/// Part of a target that is modelled.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Extent {
    /// Radius [m].
    pub(super) radius: f64,
    /// Thickness of each layer that is modelled [m].
    pub(super) layers: Vec<f64>,
    /// Whether the last layer goes on behind what is modelled.
    pub(super) cut: bool,
}

/// Side of a cell [m].
pub(super) fn cell(scenario: &Scenario) -> f64 {
    0.5 * scenario.projectile.diameter / f64::from(scenario.options.axi.cells_per_radius())
}

/// Largest speed of a longitudinal wave in the bodies before the impact [m/s].
pub(super) fn wave_speed(scenario: &Scenario) -> f64 {
    let speeds = materials(scenario).map(|(material, _)| {
        let modulus = material.bulk_modulus() + 4.0 / 3.0 * material.shear_modulus();
        (modulus / material.density.si()).sqrt()
    });
    speeds.fold(0.0, f64::max)
}

/// Part of the target that is modelled; `None` for a rigid wall.
pub(super) fn extent(scenario: &Scenario) -> Option<Extent> {
    let TargetBody::Layers { layers, .. } = &scenario.target else {
        return None;
    };
    let options = &scenario.options.axi;
    let reach = MARGIN * 0.5 * scenario.projectile.diameter;
    let needed = options.target_depth.map_or_else(
        || reach + expected_depth(scenario, layers),
        |depth| depth.si(),
    );
    let total = scenario.target_thickness();
    // A little more than needed is modelled whole: the rear face is then the case's own.
    let slack = if options.target_depth.is_some() {
        1.0
    } else {
        1.5
    };
    let cut = total.is_none_or(|total| total > slack * needed);
    let mut left = if cut { needed } else { f64::INFINITY };
    let mut modelled = Vec::new();
    for plate in layers {
        let thickness = plate.thickness.unwrap_or(f64::INFINITY).min(left);
        left -= thickness;
        if thickness > 0.0 {
            modelled.push(thickness);
        }
    }
    Some(Extent {
        radius: options.target_radius.map_or(reach, |radius| radius.si()),
        layers: modelled,
        cut,
    })
}

/// Radii of the projectile within which the grid is even, about the axis and below the expected depth.
const EVEN: (f64, f64) = (2.5, 2.0);
/// Part of the first cell by which each one beyond is larger than the one before.
const GROWTH: f64 = 0.5;

/// Least distance of a rear face from the even part, in radii of the projectile: closer, the plate is even all the way through.
const CLEAR: f64 = 4.0;

/// Nodes of a case: even about the projectile and where the crater is expected. The far edge and the rear face stand on nodes.
fn mesh(scenario: &Scenario) -> Mesh {
    let cell = cell(scenario);
    let mut mesh = Mesh {
        cell,
        radial: Axis::even(cell),
        axial: Axis::even(cell),
    };
    if let (Some(extent), TargetBody::Layers { layers, .. }) = (extent(scenario), &scenario.target)
    {
        let radius = 0.5 * scenario.projectile.diameter;
        let even = (EVEN.0 * radius / cell).ceil();
        mesh.radial = Axis::fitted(cell, even, GROWTH, extent.radius);
        let even = ((expected_depth(scenario, layers) + EVEN.1 * radius) / cell).ceil();
        let thickness: f64 = extent.layers.iter().sum();
        if extent.cut || thickness > even * cell + CLEAR * radius {
            mesh.axial = Axis::fitted(cell, even, GROWTH, thickness);
        }
    }
    mesh
}

fn law(material: &Material, scenario: &Scenario) -> Law {
    let options = &scenario.options.axi;
    let rear_face = scenario.rear_face();
    let heated = options.adiabatic_heating();
    let fraction = if heated { options.heat_fraction() } else { 0.0 };
    let behaviour = Behaviour {
        equation_of_state: options.equation_of_state(),
        rate_effects: options.rate_effects(),
        heat_fraction: fraction,
        viscosity: options.artificial_viscosity(),
    };
    Law {
        spall_strength: options
            .spalls()
            .then(|| options.spall_strength.or(material.spall_strength))
            .flatten()
            .map(|strength| strength.si()),
        damage: material
            .damage
            .as_ref()
            .filter(|_| options.damages(rear_face))
            .map(|damage| damage.prepare(material)),
        band_width: options.band_width().si(),
        failure_strain: options.failure_strain,
        erode_failed: options.erodes_failed(rear_face, is_thick(scenario)),
        erosion_strain: options.erosion_strain,
        axisymmetric: true,
        ..Law::of(material, &behaviour)
    }
}

/// Whether a target is so thick that its rear face is far from the crater.
pub(super) fn is_thick(scenario: &Scenario) -> bool {
    let thickness = scenario.target_thickness();
    thickness.is_none_or(|thickness| !is_thinner(thickness, THICK, scenario))
}

/// Number of particles of a case before its nose is cut to shape, without building it.
pub(super) fn particles(scenario: &Scenario) -> f64 {
    let (mesh, per_cell) = (mesh(scenario), scenario.options.axi.particles_per_side());
    let count = |radius: f64, span: (f64, f64)| {
        Division::new(&mesh.radial, (0.0, radius), per_cell).count()
            * Division::new(&mesh.axial, span, per_cell).count()
    };
    let rod = &scenario.projectile;
    let mut sum = count(0.5 * rod.diameter, (-rod.length, 0.0));
    if let Some(extent) = extent(scenario) {
        let mut from = 0.0;
        for thickness in &extent.layers {
            sum += count(extent.radius, (from, from + thickness));
            from += thickness;
        }
    }
    sum
}

fn projectile(
    rod: &Rod,
    law: &Law,
    mesh: (&Mesh, u32),
    speed: f64,
    control: &mut Control<'_>,
) -> Result<Vec<Particle>, Error> {
    let radius = 0.5 * rod.diameter;
    let temperature = rod.start_temperature();
    let filling = Filling {
        law,
        radius,
        span: (-rod.length, 0.0),
        mesh,
        velocity: speed,
        temperature,
    };
    let surface = |depth: f64, _: f64| rod.nose.radius(rod.diameter, -depth);
    filling.fill(surface, control)
}

/// Whether contact follows the surface of the projectile. A flat face has its normals from the nodes, what is taken out of a body leaves no
/// surface behind, and what sticks needs none.
fn follows_surface(scenario: &Scenario) -> bool {
    let rod = &scenario.projectile;
    let meets_layers = matches!(scenario.target, TargetBody::Layers { .. });
    let slides = scenario.options.axi.contact() != ContactKind::Sticking;
    if rod.nose == Nose::Flat || !meets_layers || !slides {
        return false;
    }
    let law = law(&rod.material, scenario);
    let fails =
        law.damage.is_some() || law.failure_strain.is_some() || law.spall_strength.is_some();
    law.erosion_strain.is_none() && !(law.erode_failed && fails)
}

/// Courant number of a case's time steps, for one of runs at nodes.
pub(super) fn courant(scenario: &Scenario, courant: f64) -> f64 {
    if follows_surface(scenario) {
        STEP * courant
    } else {
        courant
    }
}

/// Builds the bodies of a case.
///
/// # Errors
/// [`Error::Cancelled`].
pub(super) fn build(
    scenario: &Scenario,
    courant: f64,
    control: &mut Control<'_>,
) -> Result<Grid, Error> {
    let options = &scenario.options.axi;
    let mesh = mesh(scenario);
    let filled = (&mesh, options.particles_per_side());
    let rod = &scenario.projectile;
    let rod_law = law(&rod.material, scenario);
    let speed = scenario.impact_velocity;
    let particles = projectile(rod, &rod_law, filled, speed, control)?;
    let contact = match options.contact() {
        ContactKind::Sticking => Contact::Sticking,
        ContactKind::Frictional => Contact::Frictional(options.friction()),
    };
    let surface = follows_surface(scenario).then(|| {
        let radius = |behind| rod.nose.radius(rod.diameter, behind);
        Surface::new(radius, rod.length, mesh.cell)
    });
    let mut bodies = vec![Body::set_up(rod_law, particles, control)?];
    let mut supports = vec![BoundaryConditions {
        wall: scenario.target == TargetBody::RigidWall,
        ..BoundaryConditions::NONE
    }];
    let reach = MARGIN * rod.diameter / 2.0;
    let mut limits = Limits {
        radius: reach,
        back: -2.0 * rod.length - reach,
        front: reach,
    };
    if let (
        Some(extent),
        TargetBody::Layers {
            layers, back_face, ..
        },
    ) = (extent(scenario), &scenario.target)
    {
        let total: f64 = extent.layers.iter().sum();
        limits.radius = extent.radius + reach;
        limits.front = total + 2.0 * rod.length + reach;
        let mut from = 0.0;
        for (plate, thickness) in layers.iter().zip(&extent.layers) {
            let law = law(&plate.material, scenario);
            let to = from + thickness;
            let temperature = plate.start_temperature();
            let filling = Filling {
                law: &law,
                radius: extent.radius,
                span: (from, to),
                mesh: filled,
                velocity: 0.0,
                temperature,
            };
            let particles = filling.fill(|_, _| f64::INFINITY, control)?;
            bodies.push(Body::set_up(law, particles, control)?);
            let last = supports.len() == extent.layers.len();
            let held = if extent.cut {
                RearFaceCondition::NonReflecting
            } else {
                *back_face
            };
            supports.push(BoundaryConditions {
                back: (
                    mesh.row(to),
                    if last {
                        back_support(held, &plate.material, total)
                    } else {
                        BoundaryCondition::Free
                    },
                ),
                edge: (
                    mesh.column(extent.radius),
                    edge_support(options.edge(), &plate.material),
                ),
                ..BoundaryConditions::NONE
            });
            from = to;
        }
    }
    let mut solver = Grid {
        bodies,
        supports,
        contact,
        courant: self::courant(scenario, courant),
        surface,
        mesh,
        limits,
        step: 0,
        time: 0.0,
        time_step: 0.0,
        travel: 0.0,
        sums: Vec::new(),
        accumulated: Accumulators::default(),
        deferred: DeferredWork::default(),
    };
    solver.start(control)?;
    Ok(solver)
}

/// Impedance per area of longitudinal and of shear waves [kg/(m2 s)].
fn impedance(material: &Material) -> [f64; 2] {
    let density = material.density.si();
    let shear = material.shear_modulus();
    let longitudinal = material.bulk_modulus() + 4.0 / 3.0 * shear;
    [(longitudinal * density).sqrt(), (shear * density).sqrt()]
}

/// Boundary condition of a rear face at a depth.
///
/// Below a point force on a half-space the axial stress is `3F/(2πz²)` and the displacement `F(1 + ν)(3 − 2ν)/(2πEz)`
/// \[johnson1985\]: what was cut off has the stiffness of their ratio.
fn back_support(
    back_face: RearFaceCondition,
    material: &Material,
    depth: f64,
) -> BoundaryCondition {
    match back_face {
        RearFaceCondition::Free => BoundaryCondition::Free,
        RearFaceCondition::Fixed => BoundaryCondition::Smooth,
        RearFaceCondition::NonReflecting => {
            let ratio = material.poissons_ratio;
            let modulus = material.youngs_modulus.si();
            BoundaryCondition::NonReflecting {
                impedance: impedance(material),
                stiffness: 3.0 * modulus / ((1.0 + ratio) * (3.0 - 2.0 * ratio) * depth),
            }
        }
    }
}

fn edge_support(edge: Edge, material: &Material) -> BoundaryCondition {
    match edge {
        Edge::Free => BoundaryCondition::Free,
        Edge::Fixed => BoundaryCondition::Smooth,
        Edge::NonReflecting => BoundaryCondition::NonReflecting {
            impedance: impedance(material),
            stiffness: 0.0,
        },
    }
}
