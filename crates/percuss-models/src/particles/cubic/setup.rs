//! The body of a case in space.

use super::{
    super::{
        fracture::Softenings,
        packing::{Moved, Packing},
        setup::{self, extent, packing, solid, toughness},
        shape::Rigid,
    },
    body::CubicBody,
    grid::Grid,
    lattice::{Cubic, SIDE},
    toughness as bonds,
};
use crate::{Error, Scenario, problem::RearFaceCondition, solver::Control};

/// Part of the radius by which a particle may be outside of a rod.
const ROUNDING: f64 = 1e-9;

fn moved(scenario: &Scenario) -> Option<Moved> {
    match packing(scenario) {
        Packing::Irregular(moved) => Some(moved),
        _ => None,
    }
}

/// Softening of a case's bonds, if they break.
pub(super) fn softenings(scenario: &Scenario, lattice: &Cubic) -> Option<Softenings> {
    let toughness = toughness(scenario)?;
    let modulus = solid(scenario).youngs_modulus;
    let irregular = moved(scenario).is_some();
    Some(Softenings::of(
        bonds::exact_product(lattice, modulus, toughness),
        |softening| bonds::lattice_factor(irregular, softening),
        scenario.options.particles.softening,
    ))
}

/// Layers, rows and columns of a case.
pub(in super::super) fn grid(scenario: &Scenario) -> Grid {
    let extent = extent(scenario);
    let columns = extent.columns() as usize;
    Grid {
        layers: extent.layers() as usize + 1,
        columns,
        rows: columns,
    }
}

/// The body of a case at the moment of impact, and the rigid body that it meets.
///
/// # Errors
/// [`Error::Cancelled`].
pub(super) fn build(
    scenario: &Scenario,
    control: &mut Control<'_>,
) -> Result<(CubicBody, Rigid), Error> {
    let (extent, moved) = (extent(scenario), moved(scenario));
    let solid = solid(scenario);
    let mut lattice = Cubic::of(&solid, extent.spacing());
    if let Some(moved) = moved {
        lattice = lattice.tuned(moved.amplitude);
    }
    let is_plate = setup::is_plate(scenario);
    let radius = 0.5 * extent.width + ROUNDING * extent.width;
    let is_there = |[x, y, _]: [f64; 3]| is_plate || x * x + y * y <= radius * radius;
    let grid = grid(scenario);
    let mut body = CubicBody::of_particles(lattice, grid, extent.start, moved, is_there, control)?;
    if let (Some(toughness), Some(softenings)) =
        (toughness(scenario), softenings(scenario, &lattice))
    {
        let modulus = solid.youngs_modulus;
        let softening = bonds::softening(
            &lattice,
            modulus,
            toughness.energy,
            softenings.used,
            moved.is_some(),
        );
        body.soften(softening);
    }
    if !is_plate {
        body.launch(scenario.impact_velocity);
        return Ok((body, Rigid::Wall));
    }
    if scenario.rear_face() == Some(RearFaceCondition::Fixed) {
        body.hold_rear();
    }
    Ok((body, Rigid::Projectile(setup::shape(scenario))))
}

/// Distance of the layers over that of nearest neighbours.
pub(in super::super) const LAYER: f64 = 0.5 * SIDE;
