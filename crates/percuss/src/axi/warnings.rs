//! What to know before relying on a result.

use super::{run::Run, setup::extent};
use crate::outcome::RunResult;

/// Part of the energy lost between particles and grid that deserves a word.
const TRANSFER: f64 = 0.1;

pub(super) fn warnings(run: &Run<'_>, result: &RunResult) -> Vec<String> {
    let mut warnings = Vec::new();
    let energy = run.solver.energy();
    let share = energy.transfer / energy.initial;
    if share > TRANSFER {
        warnings.push(format!(
            "{:.0} % of the energy was lost between particles and grid: raise `axi.cells_per_radius`",
            100.0 * share
        ));
    }
    if let (Some(extent), Some(depth)) = (extent(run.scenario), result.largest_depth) {
        let below = extent.layers.iter().sum::<f64>() - depth;
        let radius = 0.5 * run.scenario.projectile.diameter;
        if extent.cut && below < 5.0 * radius {
            warnings.push(format!(
                "the crater came within {:.1} projectile radii of the end of the modelled target: raise `axi.target_depth`",
                below / radius
            ));
        }
    }
    if run.solver.books.lost != [0, 0] {
        warnings.push(format!(
            "{} particles of the projectile and {} of the target eroded or left the modelled space; the books have them",
            run.solver.books.lost[0], run.solver.books.lost[1]
        ));
    }
    warnings
}
