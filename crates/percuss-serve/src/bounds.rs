//! What a request may ask for, so that no page can keep the machine busy for ever or fill its memory.

use std::time::Duration;

use percuss::{Scenario, model::Model, scenario::TargetBody};

use crate::problem::Problem;

/// Bytes that the body of a request may have.
pub(crate) const BODY: usize = 256 << 10;
/// Bytes of a larger body that are read before it is refused: a client that is still sending hears no answer.
pub(crate) const PATIENT_BODY: usize = 4 << 20;
/// Time that a client may take to send a request.
pub(crate) const ARRIVAL: Duration = Duration::from_secs(10);
/// Time that a request waits for a place to compute.
pub(crate) const PATIENCE: Duration = Duration::from_secs(3);
/// Connections at a time.
pub(crate) const CONNECTIONS: usize = 256;
/// Layers that a target may have.
const LAYERS: usize = 40;
/// Cells along the radius of a projectile in two dimensions.
const CELLS_PER_RADIUS: u32 = 16;

/// Bounds of what a request may ask for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Bounds {
    /// Elements of projectile and target together, on the finest mesh of a study.
    pub elements: usize,
    /// Seconds that a run or a study may take.
    pub seconds: u64,
    /// Runs and studies at a time.
    pub runs: usize,
}

impl Default for Bounds {
    fn default() -> Self {
        let cores = std::thread::available_parallelism().map_or(2, usize::from);
        Self {
            elements: 2000,
            seconds: 120,
            runs: cores.max(2),
        }
    }
}

impl Bounds {
    pub(crate) fn time(&self) -> Duration {
        Duration::from_secs(self.seconds)
    }

    /// Refuses a case whose mesh is larger than the page may ask for.
    pub(crate) fn check(&self, model: &dyn Model, scenario: &Scenario) -> Result<(), Problem> {
        if let TargetBody::Layers { layers, .. } = &scenario.target
            && layers.len() > LAYERS
        {
            return Err(Problem::too_large(
                format!("the target has {} layers", layers.len()),
                format!("the page takes up to {LAYERS}; `percuss run` takes more"),
                "target.layers",
            ));
        }
        let options = &scenario.options;
        let (projectile, target) = match model.name() {
            "fdm" => {
                let (projectile, target) = percuss::fdm::elements(scenario);
                (projectile as usize, target as usize)
            }
            _ => (
                options.chain.projectile_elements(),
                options.chain.target_elements(),
            ),
        };
        let elements = projectile.saturating_add(target);
        if elements > self.elements {
            return Err(Problem::too_large(
                format!("the mesh has {elements} elements"),
                format!(
                    "this page takes up to {}: give a coarser mesh, start it with a larger `--max-elements`, or use `percuss run`",
                    self.elements
                ),
                match model.name() {
                    "fdm" => "fdm.target_elements",
                    _ => "chain.target_elements",
                },
            ));
        }
        let cells = options.axi.cells_per_radius();
        if model.is_two_dimensional() && cells > CELLS_PER_RADIUS {
            return Err(Problem::too_large(
                format!("the mesh has {cells} cells along the projectile's radius"),
                format!(
                    "the page takes up to {CELLS_PER_RADIUS}; `percuss run --model axi` takes more"
                ),
                "axi.cells_per_radius",
            ));
        }
        Ok(())
    }
}
