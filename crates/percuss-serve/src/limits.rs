//! Limits of a request: size, time and mesh.

use std::time::Duration;

use percuss::{Scenario, model::Model, scenario::TargetBody};

use crate::problem::Problem;

/// Largest body of a request [bytes].
pub(crate) const BODY: usize = 256 << 10;
/// Largest body that is read before it is refused [bytes]: a client reads no response while it is sending.
pub(crate) const LARGEST_READ_BODY: usize = 4 << 20;
/// Largest time to receive a request.
pub(crate) const ARRIVAL: Duration = Duration::from_secs(10);
/// Largest time that a request waits for a worker.
pub(crate) const QUEUE_TIME: Duration = Duration::from_secs(10);
/// Largest number of connections, of those whose client has not shown the token of the server, and of the latter from one peer.
pub(crate) const CONNECTIONS: usize = 256;
pub(crate) const CONNECTIONS_OF_PEER: usize = 64;
pub(crate) const CONNECTIONS_WITHOUT_TOKEN: usize = 192;
/// Largest time that a client may keep the server waiting before it takes a response.
pub(crate) const PATIENCE: Duration = Duration::from_secs(10);
/// Largest time of a connection whose client does not show the token.
pub(crate) const INTRODUCTION: Duration = Duration::from_secs(20);
/// Largest number of layers.
const LAYERS: usize = 40;
/// Largest number of cells along the radius of a projectile.
const CELLS_PER_RADIUS: u32 = 16;
/// Most particles of a lattice.
const PARTICLES: f64 = 100_000.0;

/// RequestLimits of what a request may ask for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RequestLimits {
    /// Largest number of elements of projectile and target together, on the finest mesh of a study.
    pub elements: usize,
    /// Largest time of a run or a study [s].
    pub seconds: u64,
    /// Largest number of simultaneous runs and studies.
    pub runs: usize,
}

impl Default for RequestLimits {
    fn default() -> Self {
        let cores = std::thread::available_parallelism().map_or(2, usize::from);
        Self {
            elements: 2000,
            seconds: 120,
            runs: cores.max(2),
        }
    }
}

impl RequestLimits {
    pub(crate) fn time(&self) -> Duration {
        Duration::from_secs(self.seconds)
    }

    /// Refuses a case whose mesh exceeds the limits.
    pub(crate) fn check(&self, model: &dyn Model, scenario: &Scenario) -> Result<(), Problem> {
        if let TargetBody::Layers { layers, .. } = &scenario.target
            && layers.len() > LAYERS
        {
            return Err(Problem::at(
                "target.layers",
                format!("the target has {} layers", layers.len()),
                format!("the page allows up to {LAYERS}; use `percuss run` for more"),
            ));
        }
        let options = &scenario.options;
        let (projectile, target) = match model.name() {
            "fdm" => {
                let (projectile, target) = percuss::fdm::elements(scenario);
                (projectile as usize, target as usize)
            }
            "chain" => {
                let chain = &options.chain;
                (chain.projectile_elements(), chain.target_elements())
            }
            _ => (0, 0),
        };
        let elements = projectile.saturating_add(target);
        if elements > self.elements {
            let body = match projectile > target {
                true => "projectile",
                false => "target",
            };
            return Err(Problem::at(
                &format!("{}.{body}_elements", model.name()),
                format!("the mesh has {elements} elements"),
                format!(
                    "this page allows up to {}: use a coarser mesh, restart it with a larger `--max-elements`, or use `percuss run`",
                    self.elements
                ),
            ));
        }
        let cells = options.axi.cells_per_radius();
        let particles = percuss::particles::particles(scenario);
        if model.name() == "particles" && particles > PARTICLES {
            return Err(Problem::at(
                "particles.spacing",
                format!("the lattice has {particles:.0} particles"),
                format!(
                    "the page allows up to {PARTICLES}; use `percuss run --model particles` for more"
                ),
            ));
        }
        if model.name() == "axi" && cells > CELLS_PER_RADIUS {
            return Err(Problem::at(
                "axi.cells_per_radius",
                format!("the mesh has {cells} cells along the projectile's radius"),
                format!(
                    "the page allows up to {CELLS_PER_RADIUS}; use `percuss run --model axi` for more"
                ),
            ));
        }
        Ok(())
    }
}
