//! Axisymmetric answer of a case: the model `axi` on several meshes, the limit of its main number, and the discretisation uncertainty.
//!
//! ```
//! use percuss::{axisymmetric::{answer, plan, ReferenceMeshes}, case};
//!
//! let scenario = case::load_str("slow ball", r#"
//!     projectile = { material = "copper", length = "5 mm", diameter = "5 mm", impact_velocity = "200 m/s" }
//!     target = { material = "aluminium-2024-t351", thickness = "25 mm" }
//!     axi = { target_radius = "8 mm", target_depth = "8 mm" }
//! "#)?;
//! let plan = plan(&scenario, ReferenceMeshes::Standard, None).expect("`axi` applies");
//! let answer = answer(&scenario, &plan, &mut |_| std::ops::ControlFlow::Continue(()))?;
//! assert_eq!(answer.meshes.len(), 3);
//! assert!(answer.uncertainty.unwrap() < answer.depth_of_penetration_mm.unwrap());
//! # Ok::<(), percuss::Error>(())
//! ```

mod cost;
mod limit;
mod plan;
#[cfg(test)]
mod tests;

use std::{
    ops::ControlFlow,
    sync::{Mutex, PoisonError},
};

use rayon::prelude::*;
use serde::Serialize;

use crate::{
    Error, Scenario, axi,
    jobs::Jobs,
    limit_choice::{another_outcome, another_residual_velocity, with_free_rear_face},
    model::{self, Choice, Control, Model, fast_models},
    outcome::{BandQuantity, Outcome, RunResult},
    problem::RearFaceCondition,
    regime::Regime,
    richardson::OnMesh,
    scenario::TargetBody,
    solver::frames::Frame,
    units::significant,
    validity::THROUGH_FIXED_FACE,
};

pub use cost::{BUDGET, seconds};
pub use limit::{HIGHEST_ORDER, MeshLimit, limit};
pub use plan::{Plan, ReferenceMeshes, Request, plan};
pub(crate) use plan::{on_cells, too_costly};

/// Name of the model.
pub const MODEL: &str = "axi";
/// Fewest meshes of an answer: one alone has no uncertainty.
const FEWEST: usize = 2;

/// Axisymmetric answer of a case. The names are stable; a number that does not exist is null.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AxisymmetricAnswer {
    /// Meshes that were asked for.
    pub reference: ReferenceMeshes,
    /// Reason why there is no answer.
    pub reason: Option<String>,
    /// Meshes that are missing, with the reason.
    pub note: Option<String>,
    /// Outcome on the finest mesh.
    pub outcome: Option<Outcome>,
    /// Main number: final length on a rigid wall, residual velocity after perforation, depth of penetration otherwise.
    pub quantity: Option<BandQuantity>,
    /// Its value in the limit of fine meshes, in the unit of its name.
    pub value: Option<f64>,
    /// Half width of its discretisation uncertainty ([`limit`]). The error of models and data of the materials is not part of it.
    pub uncertainty: Option<f64>,
    /// Why the value is not one to use, if it is not.
    pub doubt: Option<String>,
    /// Observed order of convergence, where the value is extrapolated.
    pub order: Option<f64>,
    /// Depth of penetration: the limit where it is the main number, otherwise that of the finest mesh.
    pub depth_of_penetration_mm: Option<f64>,
    /// Residual velocity, in the same way.
    pub residual_velocity_m_s: Option<f64>,
    /// Final length of the projectile, in the same way.
    pub projectile_final_length_mm: Option<f64>,
    /// Results of the meshes, from coarse to fine.
    pub meshes: Vec<MeshResult>,
    /// Limitations of the run on the finest mesh.
    pub warnings: Vec<String>,
    /// Result of the finest mesh; not in JSON.
    #[serde(skip)]
    pub finest: Option<Box<RunResult>>,
}

/// Result of one mesh.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MeshResult {
    /// Cells along the projectile's radius.
    pub cells_per_radius: u32,
    /// Outcome.
    pub outcome: Outcome,
    /// Depth of penetration.
    pub depth_of_penetration_mm: Option<f64>,
    /// Residual velocity.
    pub residual_velocity_m_s: Option<f64>,
    /// Final length of the projectile.
    pub projectile_final_length_mm: Option<f64>,
    /// Time steps.
    pub steps: Option<u64>,
    /// Energy balance error, as a part of the initial energy.
    pub energy_residual: Option<f64>,
}

impl MeshResult {
    /// The numbers of a run on a mesh.
    pub fn new(cells_per_radius: u32, result: &RunResult) -> Self {
        let value = |quantity: BandQuantity| Some(quantity.in_unit(result.measurable(quantity)?));
        let numerics = result.numerics.as_ref();
        Self {
            cells_per_radius,
            outcome: result.outcome,
            depth_of_penetration_mm: value(BandQuantity::DepthOfPenetration),
            residual_velocity_m_s: value(BandQuantity::ResidualVelocity),
            projectile_final_length_mm: value(BandQuantity::ProjectileFinalLength),
            steps: numerics.map(|numerics| numerics.steps),
            energy_residual: numerics.map(|numerics| numerics.energy_residual),
        }
    }

    /// A main number, in the unit of its name.
    pub fn value(&self, quantity: BandQuantity) -> Option<f64> {
        match quantity {
            BandQuantity::DepthOfPenetration => self.depth_of_penetration_mm,
            BandQuantity::ResidualVelocity => self.residual_velocity_m_s,
            BandQuantity::ProjectileFinalLength => self.projectile_final_length_mm,
            BandQuantity::BallisticLimit => None,
        }
    }
}

/// Runs the planned meshes in parallel and takes the limit of the main number. `progress` gets the fraction done, 0 to 1, from any thread
/// but never from two at once; [`ControlFlow::Break`] stops the runs.
///
/// # Errors
/// [`Error::Cancelled`]. A mesh that fails is left out with a note; with fewer than two meshes left there is only a reason.
pub fn answer(
    scenario: &Scenario,
    plan: &Plan,
    progress: &mut (dyn FnMut(f64) -> ControlFlow<()> + Send),
) -> Result<AxisymmetricAnswer, Error> {
    answer_with_frames(scenario, plan, progress, &mut |_| ())
}

/// [`answer`]; `frames` gets the fields of the finest mesh while it runs.
///
/// # Errors
/// Those of [`answer`].
pub fn answer_with_frames(
    scenario: &Scenario,
    plan: &Plan,
    progress: &mut (dyn FnMut(f64) -> ControlFlow<()> + Send),
    frames: &mut (dyn FnMut(&Frame<'_>) + Send),
) -> Result<AxisymmetricAnswer, Error> {
    let axi = model::model(MODEL)?;
    let costs: Vec<f64> = plan.cells.iter().map(|&n| seconds(scenario, n)).collect();
    let meshes = costs.len();
    let jobs = Jobs::new(costs, progress);
    let frames = Mutex::new(frames);
    // The finest mesh takes longest and starts first.
    let mut runs: Vec<Result<(MeshResult, RunResult), Error>> = (0..meshes)
        .into_par_iter()
        .with_max_len(1)
        .rev()
        .map(|mesh| {
            let mut watch = |now: model::Progress| jobs.report(mesh, now.fraction);
            let mut show = |frame: &Frame<'_>| {
                let mut frames = frames.lock().unwrap_or_else(PoisonError::into_inner);
                frames(frame);
                ControlFlow::Continue(())
            };
            let mut control = Control {
                progress: Some(&mut watch),
                ..Control::default()
            };
            if mesh + 1 == meshes {
                control.frames = Some(&mut show);
            }
            on_mesh(axi, scenario, plan.cells[mesh], &mut control)
        })
        .collect();
    runs.reverse();
    let (mut meshes, mut last) = (Vec::new(), None);
    let mut notes = Vec::from_iter(plan.note.clone());
    for (run, cells) in runs.into_iter().zip(&plan.cells) {
        match run {
            Ok((mesh, result)) => {
                meshes.push(mesh);
                last = Some(result);
            }
            Err(stop @ Error::Cancelled { .. }) => return Err(stop),
            Err(error) => notes.push(format!("the run on {cells} cells failed: {error}")),
        }
    }
    let mut found = AxisymmetricAnswer::of(scenario, plan.reference, meshes, &notes);
    found.finest = last.filter(|_| found.quantity.is_some()).map(Box::new);
    if let Some(finest) = &found.finest {
        found.warnings.clone_from(&finest.warnings);
    }
    Ok(found)
}

/// Result of one mesh.
pub(crate) fn on_mesh(
    axi: &dyn Model,
    scenario: &Scenario,
    cells: u32,
    control: &mut Control<'_>,
) -> Result<(MeshResult, RunResult), Error> {
    let scenario = plan::on_cells(scenario, cells);
    let result = model::run(axi, &scenario, control)?;
    Ok((MeshResult::new(cells, &result), result))
}

impl AxisymmetricAnswer {
    /// Why there is no value, or none to use, or which meshes are missing.
    pub fn remark(&self) -> Option<&str> {
        let said = self.reason.as_ref().or(self.doubt.as_ref());
        said.or(self.note.as_ref()).map(String::as_str)
    }

    /// No answer, with the reason.
    pub fn without(reference: ReferenceMeshes, reason: impl Into<String>) -> Self {
        Self {
            reference,
            reason: Some(reason.into()),
            note: None,
            outcome: None,
            quantity: None,
            value: None,
            uncertainty: None,
            doubt: None,
            order: None,
            depth_of_penetration_mm: None,
            residual_velocity_m_s: None,
            projectile_final_length_mm: None,
            meshes: Vec::new(),
            warnings: Vec::new(),
            finest: None,
        }
    }

    /// The answer of the results on meshes from coarse to fine; with fewer than two there are only the notes.
    pub fn of(
        scenario: &Scenario,
        reference: ReferenceMeshes,
        meshes: Vec<MeshResult>,
        notes: &[String],
    ) -> Self {
        let note = (!notes.is_empty()).then(|| notes.join("; "));
        let Some(finest) = meshes.last().filter(|_| meshes.len() >= FEWEST) else {
            return Self::without(reference, note.unwrap_or_default());
        };
        let is_held = scenario.rear_face() == Some(RearFaceCondition::Fixed);
        if is_held && finest.outcome == Outcome::Perforated {
            return Self {
                meshes,
                ..Self::without(reference, THROUGH_FIXED_FACE)
            };
        }
        let quantity = main_number(scenario, finest.outcome);
        let on_meshes: Vec<OnMesh> = meshes
            .iter()
            .filter(|mesh| main_number(scenario, mesh.outcome) == quantity)
            .filter_map(|mesh| {
                Some(OnMesh {
                    cells: f64::from(mesh.cells_per_radius),
                    value: mesh.value(quantity)?,
                })
            })
            .collect();
        // Meshes that perforate and meshes that do not have no common limit.
        let whole = on_meshes.len() == meshes.len();
        let limit = limit(
            &on_meshes,
            untouched(scenario, quantity),
            resolution(scenario, quantity, finest),
        )
        .filter(|_| whole);
        let value = limit.map_or(finest.value(quantity), |limit| Some(limit.value));
        let uncertainty = limit.map(|limit| limit.uncertainty);
        let of = |number: BandQuantity| match number == quantity {
            true => value,
            false => finest.value(number),
        };
        Self {
            reference,
            reason: None,
            note,
            outcome: Some(finest.outcome),
            quantity: Some(quantity),
            value,
            uncertainty,
            doubt: doubt(
                scenario,
                reference,
                value.zip(Some(finest.outcome)),
                uncertainty,
            ),
            order: limit.and_then(|limit| limit.order),
            depth_of_penetration_mm: of(BandQuantity::DepthOfPenetration),
            residual_velocity_m_s: of(BandQuantity::ResidualVelocity),
            projectile_final_length_mm: of(BandQuantity::ProjectileFinalLength),
            meshes,
            warnings: Vec::new(),
            finest: None,
        }
    }
}

/// Why a value in the limit of meshes, with the outcome, is not one to use: a material breaks, the limit to use lies on the other side, a plate that
/// is perforated cannot fail, or the meshes do not settle it.
fn doubt(
    scenario: &Scenario,
    meshes: ReferenceMeshes,
    found: Option<(f64, Outcome)>,
    uncertainty: Option<f64>,
) -> Option<String> {
    let brittle = scenario.brittle();
    if !brittle.is_empty() {
        let ids = brittle.join(", ");
        return Some(format!(
            "{ids} is brittle, and stays whole in `{MODEL}`: `particles` breaks it"
        ));
    }
    let (value, outcome) = found?;
    if let Some((model, other)) = another_outcome(scenario, outcome) {
        return Some(format!(
            "`{model}`, whose ballistic limit is the one to use here, has another outcome ({}): `percuss limit` gives both limits",
            other.describe()
        ));
    }
    if let Some(free) = with_free_rear_face(scenario)
        && let Some((model, Outcome::Perforated)) = another_outcome(&free, outcome)
    {
        return Some(format!(
            "the rear face is fixed, the default; with a free one `{model}` perforates the plate: give `target.back_face`"
        ));
    }
    if outcome == Outcome::Perforated
        && let Some(doubt) = doubt_without_failure(scenario, value, uncertainty)
    {
        return Some(doubt);
    }
    let mut reason = match (value, uncertainty) {
        (_, None) => "the meshes differ in their outcome".to_owned(),
        (value, Some(error)) if error > value.abs() => {
            "the error of the meshes is larger than the number".to_owned()
        }
        (value, Some(error)) if error > LARGEST_ERROR * value.abs() => format!(
            "the error of the meshes is {} % of the number",
            significant(100.0 * error / value.abs(), 2)
        ),
        _ => return None,
    };
    if meshes == ReferenceMeshes::Standard {
        reason += "; `percuss run --reference fine` takes finer ones";
    }
    let quantity = main_number(scenario, outcome);
    if let Some((model, value)) = another_choice(scenario, quantity) {
        reason += &format!(
            "; `{model}`, a first choice here, gives {} {}",
            significant(value, 3),
            quantity.unit()
        );
    }
    Some(reason)
}

/// Part of a number from which on the error of its meshes makes it one not to rely on.
const LARGEST_ERROR: f64 = 0.3;

/// A quick model that is a first choice for a case within its ranges of validity: its name and its main number, in the unit of its name.
fn another_choice(scenario: &Scenario, quantity: BandQuantity) -> Option<(&'static str, f64)> {
    let regime = Regime::of(scenario);
    fast_models().into_iter().find_map(|model| {
        let choice = Choice::within(model, scenario, &regime)?;
        let found = model::run(model, scenario, &mut Control::default()).ok()?;
        let is_alike = main_number(scenario, found.outcome) == quantity;
        let value = quantity.in_unit(found.measurable(quantity)?);
        is_alike.then_some((choice.model, value))
    })
}

/// Why a residual velocity [m/s] behind a plate that cannot fail is not one to use, where the model whose limit is the one to use gives another.
fn doubt_without_failure(
    scenario: &Scenario,
    velocity: f64,
    uncertainty: Option<f64>,
) -> Option<String> {
    let cannot_fail = axi::layers_that_cannot_fail(scenario);
    if cannot_fail.is_empty() {
        return None;
    }
    let (model, other) = another_residual_velocity(scenario)?;
    let differs = (velocity - other).abs() > uncertainty.unwrap_or(0.0);
    differs.then(|| {
        format!(
            "{} has no `damage` in its record, and stretching and thinning alone takes more energy than failure: `{model}`, whose ballistic limit is \
             the one to use here, gives {} m/s",
            cannot_fail.join(", "),
            significant(other, 3)
        )
    })
}

/// Main number of a run with an outcome.
pub fn main_number(scenario: &Scenario, outcome: Outcome) -> BandQuantity {
    match (&scenario.target, outcome) {
        (TargetBody::RigidWall, _) => BandQuantity::ProjectileFinalLength,
        (_, Outcome::Perforated) => BandQuantity::ResidualVelocity,
        _ => BandQuantity::DepthOfPenetration,
    }
}

/// Value of a number if the impact changed nothing, in the unit of its name.
pub(crate) fn untouched(scenario: &Scenario, quantity: BandQuantity) -> f64 {
    let si = match quantity {
        BandQuantity::ProjectileFinalLength => scenario.projectile.length,
        BandQuantity::ResidualVelocity => scenario.impact_velocity,
        BandQuantity::DepthOfPenetration | BandQuantity::BallisticLimit => 0.0,
    };
    quantity.in_unit(si)
}

/// Part of a cell to which a surface is read: dents below half a cell are too deep by up to 0.07 cells, on all coarse meshes alike.
const SURFACE: f64 = 0.08;
/// Part of a depth that a mesh of [`PART_CELLS`] cells along the projectile's radius leaves open where coarser ones agree with it: heads that
/// shear off, and thin layers of soft rods in craters, appear on finer meshes only. It falls with the cell size.
const PART: f64 = 0.05;
const PART_CELLS: f64 = 6.0;

/// Smallest difference of a length that a mesh shows, for a projectile's diameter, in its unit, and cells along its radius.
fn length_resolution(diameter: f64, cells_per_radius: f64) -> f64 {
    SURFACE * 0.5 * diameter / cells_per_radius
}

/// Smallest difference of a depth that a mesh shows, for a projectile's diameter, in one unit, and cells along its radius.
pub fn depth_resolution(depth: f64, diameter: f64, cells_per_radius: f64) -> f64 {
    let part = PART * PART_CELLS / cells_per_radius * depth;
    part.max(length_resolution(diameter, cells_per_radius))
}

/// Smallest difference of a number that a mesh shows, in the unit of its name.
fn resolution(scenario: &Scenario, quantity: BandQuantity, mesh: &MeshResult) -> f64 {
    let diameter = quantity.in_unit(scenario.projectile.diameter);
    let cells = f64::from(mesh.cells_per_radius);
    match quantity {
        BandQuantity::DepthOfPenetration => {
            depth_resolution(mesh.value(quantity).unwrap_or(0.0), diameter, cells)
        }
        BandQuantity::ProjectileFinalLength => length_resolution(diameter, cells),
        BandQuantity::ResidualVelocity | BandQuantity::BallisticLimit => 0.0,
    }
}
