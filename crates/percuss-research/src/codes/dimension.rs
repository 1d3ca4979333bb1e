//! Rods of one length and several diameters on a rigid wall, in one and in two dimensions.
//!
//! A one-dimensional rod has no diameter: its final length depends on length, velocity and material alone. In two dimensions the foot
//! spreads against its own inertia and bends the lines of flow. Both effects have the size of the diameter. So the difference between
//! the solutions vanishes with the ratio of diameter to length where one dimension leaves out nothing else.

use std::ops::ControlFlow;

use percuss::{
    Error,
    model::{self, Control},
    outcome::RunResult,
    solver::frames::Frame,
};
use serde::Serialize;

use super::outside;

/// Ratios of the rod's length to its diameter, times that of the compared rod.
pub(super) const SLENDERNESS: [f64; 5] = [0.5, 1.0, 2.0, 4.0, 8.0];
/// Cells along the radius.
pub(super) const CELLS: u32 = 4;
/// Elements of the one-dimensional rods: the default and meshes of its limit.
pub(super) const ELEMENTS: [u32; 4] = [40, 80, 160, 320];
/// The compared case.
const CASE: &str = "copper-on-wall";
const VELOCITY: f64 = 183.0;

/// A rod by `axi`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RodRun {
    /// Length over diameter before the impact.
    pub length_to_diameter: f64,
    /// Final length [mm].
    pub final_length_mm: f64,
    /// Final over original diameter of the foot.
    pub foot: f64,
    /// Fraction of the impact energy that became plastic work.
    pub plastic_work: f64,
    /// Fraction of the impact energy that artificial viscosity took.
    pub viscous_work: f64,
    /// Largest fraction of the impact energy in radial motion at any time.
    pub radial_motion: f64,
    /// Mean plastic strain over the mass at the end.
    pub mean_strain: f64,
}

/// The same rod in one dimension on one mesh.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LineRun {
    /// Model.
    pub model: &'static str,
    /// Elements along the rod.
    pub elements: u32,
    /// Final length [mm].
    pub final_length_mm: f64,
    /// Final over original diameter of the foot, at constant volume.
    pub foot: f64,
    /// Fraction of the impact energy that became plastic work.
    pub plastic_work: f64,
    /// Mean plastic strain over the mass at the end.
    pub mean_strain: f64,
}

/// All runs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DimensionStudy {
    /// Length before the impact [mm].
    pub length_mm: f64,
    /// By `axi`, the stoutest rod first.
    pub rods: Vec<RodRun>,
    /// In one dimension.
    pub lines: Vec<LineRun>,
}

fn number(value: Option<f64>, scale: f64) -> f64 {
    value.map_or(f64::NAN, |value| scale * value)
}

/// Mean over the elements of the rod, which have equal masses; NaN without a history.
fn mean_strain(result: &RunResult) -> f64 {
    let profiles = result.history.as_ref().map(|history| &history.profiles);
    let Some(last) = profiles.and_then(|profiles| profiles.last()) else {
        return f64::NAN;
    };
    let rod = last.elements.iter().filter(|element| element.part == 0);
    let strains: Vec<f64> = rod.map(|element| element.plastic_strain).collect();
    strains.iter().sum::<f64>() / strains.len() as f64
}

fn plastic_work(result: &RunResult) -> f64 {
    let energy = &result.numerics().energy;
    energy.plastic_projectile / energy.initial
}

/// Length of the rods before the impact [mm].
///
/// # Errors
/// [`Error::Input`].
pub(super) fn length_mm() -> Result<f64, Error> {
    Ok(1e3 * outside::scenario(CASE, VELOCITY)?.projectile.length)
}

/// Computes a rod by `axi`, so many times as slender as the compared one.
///
/// # Errors
/// Those of the run.
pub(super) fn rod(slenderness: f64) -> Result<RodRun, Error> {
    let mut scenario = outside::scenario(CASE, VELOCITY)?;
    let rod = &mut scenario.projectile;
    rod.diameter /= slenderness;
    rod.mass /= slenderness * slenderness;
    let (ratio, diameter) = (rod.length / rod.diameter, rod.diameter);
    outside::set_mesh(&mut scenario, "axi", CELLS);
    let (mut radial, mut mean_strain) = (0.0_f64, f64::NAN);
    let mut look = |frame: &Frame<'_>| {
        let (mut motion, mut strain, mut mass) = (0.0, 0.0, 0.0);
        for (_, particle) in frame.fields.particles() {
            motion += 0.5 * particle.mass * particle.velocity[0] * particle.velocity[0];
            strain += particle.mass * particle.plastic_strain;
            mass += particle.mass;
        }
        radial = radial.max(motion);
        mean_strain = strain / mass;
        ControlFlow::Continue(())
    };
    let mut control = Control {
        frames: Some(&mut look),
        ..Control::default()
    };
    let result = model::run(model::model("axi")?, &scenario, &mut control)?;
    let energy = &result.numerics().energy;
    Ok(RodRun {
        length_to_diameter: ratio,
        final_length_mm: number(result.projectile_final_length, 1e3),
        foot: number(result.projectile_final_diameter, 1.0 / diameter),
        plastic_work: plastic_work(&result),
        viscous_work: energy.viscous / energy.initial,
        radial_motion: radial / energy.initial,
        mean_strain,
    })
}

/// Computes the rod in one dimension.
///
/// # Errors
/// Those of the run.
pub(super) fn line(model: &'static str, elements: u32) -> Result<LineRun, Error> {
    let mut scenario = outside::scenario(CASE, VELOCITY)?;
    outside::set_mesh(&mut scenario, model, elements);
    let diameter = scenario.projectile.diameter;
    let result = model::run(model::model(model)?, &scenario, &mut Control::recording())?;
    Ok(LineRun {
        mean_strain: mean_strain(&result),
        model,
        elements,
        final_length_mm: number(result.projectile_final_length, 1e3),
        foot: number(result.projectile_final_diameter, 1.0 / diameter),
        plastic_work: plastic_work(&result),
    })
}
