//! Meshes of an axisymmetric answer, chosen by their cost.

use std::ops::ControlFlow;

use serde::Serialize;

use super::{AxisymmetricAnswer, BUDGET, MODEL, answer, seconds};
use crate::{
    Error, Refusal, Scenario,
    axi::Axi,
    model::{self, Estimate, Model, memory, time_in_words},
};

/// Meshes of an axisymmetric answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ReferenceMeshes {
    /// 3, 4 and 6 cells along the projectile's radius: about a second for a short rod.
    #[default]
    Standard,
    /// 6, 8 and 12 cells: eight times the cost.
    Fine,
}

impl ReferenceMeshes {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Standard, Self::Fine];

    /// Name on the command line and in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Standard => "standard",
            Self::Fine => "fine",
        }
    }

    /// The meshes of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|meshes| meshes.name() == name)
    }

    /// Cells along the projectile's radius, from coarse to fine.
    pub fn cells(self) -> [u32; 3] {
        match self {
            Self::Standard => [3, 4, 6],
            Self::Fine => [6, 8, 12],
        }
    }
}

/// Runs of an axisymmetric answer.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Meshes that are asked for.
    pub reference: ReferenceMeshes,
    /// Cells along the projectile's radius of the meshes that are run, from coarse to fine.
    pub cells: Vec<u32>,
    /// Reason why that is not all of them.
    pub note: Option<String>,
}

/// Plans the runs of a case: all meshes, or without the finest where all would cost more than `budget` [s of processor time].
///
/// # Errors
/// The reason why there is no answer: `axi` does not apply, or the coarser meshes alone cost more than the budget.
pub fn plan(
    scenario: &Scenario,
    reference: ReferenceMeshes,
    budget: Option<f64>,
) -> Result<Plan, Refusal> {
    let axi = model::model(MODEL).map_err(|error| Refusal::new(error.to_string()))?;
    let all = reference.cells();
    let applies = |cells| model::applicability(axi, &on_cells(scenario, cells));
    if let Err(refusal) = applies(all[0]) {
        let fine = ReferenceMeshes::Fine;
        return Err(match applies(fine.cells()[0]) {
            Ok(_) => refusal.with_remedy(self::remedy(fine)),
            Err(_) => refusal,
        });
    }
    // The meshes are run side by side.
    let memory = all.map(|cells| axi.estimate(&on_cells(scenario, cells)).memory);
    if let Some(refusal) = memory::refusal(memory.iter().sum()) {
        return Err(refusal);
    }
    let cost = |cells: &[u32]| cells.iter().map(|&n| seconds(scenario, n)).sum::<f64>();
    let whole = cost(&all);
    let within = |cost: f64| budget.is_none_or(|budget| cost <= budget);
    let remedy = remedy(reference);
    if within(whole) {
        return Ok(Plan {
            reference,
            cells: all.to_vec(),
            note: None,
        });
    }
    let [coarser @ .., finest] = &all;
    if within(cost(coarser)) {
        return Ok(Plan {
            reference,
            cells: coarser.to_vec(),
            note: Some(format!(
                "the mesh of {finest} cells is left out: all meshes take {}; {remedy}",
                in_words(whole)
            )),
        });
    }
    Err(too_costly(reference, whole))
}

/// Refusal of runs that take this processor time [s].
pub(crate) fn too_costly(reference: ReferenceMeshes, seconds: f64) -> Refusal {
    Refusal::new(format!("the runs take {}", in_words(seconds))).with_remedy(remedy(reference))
}

fn remedy(reference: ReferenceMeshes) -> String {
    format!("`--reference {}` computes them", reference.name())
}

/// A case on a mesh.
pub(crate) fn on_cells(scenario: &Scenario, cells_per_radius: u32) -> Scenario {
    let mut scenario = scenario.clone();
    scenario.options.axi.cells_per_radius = Some(cells_per_radius);
    scenario
}

/// An expected processor time as `about 90 s of processor time`.
fn in_words(seconds: f64) -> String {
    format!("about {} of processor time", time_in_words(seconds))
}

/// Axisymmetric answer that a study asks for.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Request {
    /// Meshes.
    pub meshes: ReferenceMeshes,
    /// Largest processor time of an answer [s]: above it the finest mesh, or the answer, is left out.
    pub budget: Option<f64>,
}

impl Request {
    /// Standard meshes within [`BUDGET`]: what a command computes unasked.
    pub fn unasked() -> Self {
        Self {
            meshes: ReferenceMeshes::default(),
            budget: Some(BUDGET),
        }
    }

    /// These meshes, whatever they cost.
    pub fn whole(meshes: ReferenceMeshes) -> Self {
        Self {
            meshes,
            budget: None,
        }
    }

    /// Estimated cost of the answer of a case; of none where there is no answer.
    pub fn estimate(&self, scenario: &Scenario) -> Estimate {
        let plan = plan(scenario, self.meshes, self.budget);
        let meshes = plan.into_iter().flat_map(|plan| plan.cells);
        let estimates = meshes.map(|cells| Axi.estimate(&on_cells(scenario, cells)));
        Estimate {
            memory: self.memory(scenario),
            ..estimates.sum()
        }
    }

    /// Memory of the answer of a case, whose meshes run side by side [bytes].
    pub(crate) fn memory(&self, scenario: &Scenario) -> f64 {
        let plan = plan(scenario, self.meshes, self.budget);
        let meshes = plan.into_iter().flat_map(|plan| plan.cells);
        meshes
            .map(|cells| Axi.estimate(&on_cells(scenario, cells)).memory)
            .sum()
    }

    /// The answer of a case; where there is none, its reason. `progress` as in [`answer`].
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub fn answer(
        &self,
        scenario: &Scenario,
        progress: &mut (dyn FnMut(f64) -> ControlFlow<()> + Send),
    ) -> Result<AxisymmetricAnswer, Error> {
        match plan(scenario, self.meshes, self.budget) {
            Ok(plan) => answer(scenario, &plan, progress),
            Err(refusal) => Ok(AxisymmetricAnswer::without(
                self.meshes,
                refusal.to_string(),
            )),
        }
    }
}
