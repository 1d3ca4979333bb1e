//! Ballistic limit by the axisymmetric model on successively finer meshes.

use std::ops::ControlFlow;

use serde::Serialize;

use super::{
    Bracket, LimitOutcome, LimitRange, ModelLimit, Observer, Progress, Range, Search, Tolerance,
    jobs::{self, Scan, planned_runs},
    run_results,
};
use crate::{
    Error, Scenario, axi,
    axisymmetric::{MODEL, ReferenceMeshes, Request, limit, on_cells, seconds, too_costly},
    model::{self, Model},
    regime::at_least,
    richardson::OnMesh,
    solver::go_on_to_next_run,
};

/// Part of the limit of the mesh before, to either side, that a finer mesh is searched in first.
const NEIGHBOURHOOD: f64 = 0.1;
/// Part of the lowest and of the highest limit of other models between which the coarsest mesh is searched in first.
const BESIDE: (f64, f64) = (0.5, 2.0);

/// Ballistic limit by `axi` in the limit of fine meshes. The names are stable.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AxisymmetricLimit {
    /// Meshes that were asked for.
    pub reference: ReferenceMeshes,
    /// Why there is no limit, if there is none.
    pub reason: Option<String>,
    /// Ballistic limit [m/s].
    pub ballistic_limit_m_s: Option<f64>,
    /// Half width of its discretisation uncertainty [m/s]. The error of models and data of the materials is not part of it.
    pub uncertainty_m_s: Option<f64>,
    /// Observed order of convergence, where the limit is extrapolated.
    pub order: Option<f64>,
    /// What the meshes gave, from coarse to fine.
    pub meshes: Vec<LimitOnMesh>,
    /// Limitations of the numbers.
    pub warnings: Vec<String>,
}

/// Ballistic limit on one mesh.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LimitOnMesh {
    /// Cells along the projectile's radius.
    pub cells_per_radius: u32,
    /// What the search came to.
    pub outcome: LimitOutcome,
    /// Middle of the bracket [m/s].
    pub ballistic_limit_m_s: Option<f64>,
    /// The bracket.
    pub bracket: Option<Bracket>,
    /// Runs that were computed.
    pub runs: usize,
}

/// Narrowest bracket of a search within a budget, as a part of the velocity: meshes differ by more.
const BRACKET: f64 = 0.005;

/// Least uncertainty of a limit on so many cells per radius, as a part of it; it falls with the cell size. Failure localizes in bands narrower
/// than a cell, and meshes may agree by chance: of eight plates, 3, 4 and 6 cells held the limit on 12 cells in four without it, in seven with it.
const LEAST: f64 = 0.07;
const LEAST_CELLS: f64 = 6.0;

/// A range to search in before the whole of it, and how closely.
type First = (Range, Scan);

/// Searches on each mesh: the coarsest about the limits of other models, the others about the limit of the one before; each across the
/// whole range where there is none.
pub(super) fn on_meshes(
    scenario: &Scenario,
    request: &Request,
    search: &Search,
    others: Option<LimitRange>,
    observer: &mut Observer<'_>,
) -> Result<AxisymmetricLimit, Error> {
    let axi = model::model(MODEL)?;
    let reference = request.meshes;
    let without = |reason: String| AxisymmetricLimit {
        reason: Some(reason),
        ..of_meshes(reference, &[])
    };
    if let Some((_, reason)) = run_results::unsuited(axi, scenario) {
        return Ok(without(reason));
    }
    let coarsest = on_cells(scenario, reference.cells()[0]);
    if let Err(refusal) = model::applicability(axi, &coarsest) {
        return Ok(without(refusal.to_string()));
    }
    if let Some(reason) = unresolved(scenario, reference) {
        return Ok(without(reason));
    }
    let highest = search.range.to;
    let closer = search.tolerance.at(highest) < BRACKET * highest;
    let search = &Search {
        tolerance: match request.budget {
            Some(_) if closer => Tolerance::Relative(BRACKET),
            _ => search.tolerance,
        },
        ..*search
    };
    let within = |from: f64, to: f64| Range {
        from: search.range.from.max(from),
        to: search.range.to.min(to),
    };
    let about = |limit: f64| -> First {
        let near = within(limit * (1.0 - NEIGHBOURHOOD), limit * (1.0 + NEIGHBOURHOOD));
        (near, Scan::COARSE)
    };
    let beside = others.map(|others| {
        let near = within(BESIDE.0 * others.lowest_m_s, BESIDE.1 * others.highest_m_s);
        (near, Scan::WHOLE)
    });
    let cells = reference.cells();
    let mut runs = [about(search.range.to); 3];
    runs[0] = beside.unwrap_or((search.range, Scan::WHOLE));
    let mut costs = [0.0; 3];
    for ((cost, cells), (range, scan)) in costs.iter_mut().zip(cells).zip(runs) {
        let runs = planned_runs(&search_in(search, range), scan);
        *cost = runs as f64 * seconds(scenario, cells);
    }
    let whole: f64 = costs.iter().sum();
    if request.budget.is_some_and(|budget| whole > budget) {
        return Ok(without(too_costly(reference, whole).to_string()));
    }
    let mut found: Vec<(u32, ModelLimit)> = Vec::new();
    let mut before = 0.0;
    for (cells, cost) in cells.into_iter().zip(costs) {
        let scenario = on_cells(scenario, cells);
        let runs = found.iter().map(|(_, entry)| entry.runs).sum();
        let first = match found.last() {
            None => beside,
            Some((_, entry)) => entry.ballistic_limit_m_s.map(about),
        };
        let share = [before, before + cost].map(|seconds| seconds / whole);
        let entry = on_mesh(axi, &scenario, search, first, observer, (runs, share))?;
        before += cost;
        found.push((cells, entry));
    }
    let mut limit = of_meshes(reference, &found);
    let cannot_fail = axi::layers_that_cannot_fail(scenario);
    if let Some(reason) = limit.reason.as_mut().filter(|_| !cannot_fail.is_empty()) {
        *reason = format!(
            "{} has no `damage` in its record, so that it only stretches and thins, and no mesh or velocity gives its limit: give `damage`, or \
             `axi.failure_strain`",
            cannot_fail.join(", ")
        );
    }
    Ok(limit)
}

/// Why the coarsest mesh cannot tell whether a layer has failed, if it cannot: material moves with what is less than two cells away.
fn unresolved(scenario: &Scenario, reference: ReferenceMeshes) -> Option<String> {
    let thicknesses = scenario.layers().iter().filter_map(|layer| layer.thickness);
    let thinnest = thicknesses.fold(f64::INFINITY, f64::min);
    let cells = reference.cells()[0];
    let radius = 0.5 * scenario.projectile.diameter;
    let resolved = at_least(thinnest * f64::from(cells), radius);
    (!resolved).then(|| {
        let remedy = match reference {
            ReferenceMeshes::Fine => "",
            ReferenceMeshes::Standard => ": take finer ones by `--reference fine`",
        };
        format!("the thinnest layer is thinner than a cell of the coarsest mesh, {cells} cells per radius{remedy}")
    })
}

/// Reports the progress of a part of a study, after some runs, as the share of the whole that it is.
pub(super) fn part_of<'a>(
    observer: &'a mut Observer<'_>,
    runs: usize,
    [from, to]: [f64; 2],
) -> impl FnMut(Progress) -> ControlFlow<()> + Send + 'a {
    move |now| match &mut observer.progress {
        Some(progress) => progress(Progress {
            finished: runs + now.finished,
            fraction: from + (to - from) * now.fraction,
            ..now
        }),
        None => ControlFlow::Continue(()),
    }
}

/// The search in a range, for the limit alone.
fn search_in(search: &Search, range: Range) -> Search {
    Search {
        range,
        points: 0,
        ..*search
    }
}

/// The search on a mesh, `first` where a limit is expected. Before it `runs` were computed, and it is the `share` from one part of the
/// whole to another.
fn on_mesh(
    axi: &dyn Model,
    scenario: &Scenario,
    search: &Search,
    first: Option<First>,
    observer: &mut Observer<'_>,
    (runs, [from, to]): (usize, [f64; 2]),
) -> Result<ModelLimit, Error> {
    let mut run = |range: Range, scan: Scan, runs: usize, share: [f64; 2]| {
        let search = search_in(search, range);
        let mut report = part_of(observer, runs, share);
        let mut observer = Observer {
            progress: Some(&mut report),
        };
        jobs::run_one(axi, scenario, &search, scan, &mut observer)
    };
    let Some((near, scan)) = first else {
        return run(search.range, Scan::WHOLE, runs, [from, to]);
    };
    // Where the neighbourhood has no limit, the whole range takes most of the time.
    let middle = 0.7 * from + 0.3 * to;
    let entry = run(near, scan, runs, [from, middle])?;
    if entry.outcome == LimitOutcome::Found {
        let done = Progress {
            finished: entry.runs,
            total: entry.runs,
            fraction: 1.0,
        };
        go_on_to_next_run(part_of(observer, runs, [from, to])(done))?;
        return Ok(entry);
    }
    let spent = entry.runs;
    let mut entry = run(search.range, Scan::WHOLE, runs + spent, [middle, to])?;
    entry.runs += spent;
    Ok(entry)
}

/// The limit of the meshes that have one.
fn of_meshes(reference: ReferenceMeshes, found: &[(u32, ModelLimit)]) -> AxisymmetricLimit {
    let values: Vec<OnMesh> = found
        .iter()
        .filter_map(|(cells, entry)| {
            Some(OnMesh {
                cells: f64::from(*cells),
                value: entry.ballistic_limit_m_s?,
            })
        })
        .collect();
    let widths = found.iter().filter_map(|(_, entry)| entry.bracket);
    let width = widths.map(|bracket| bracket.perforated_m_s - bracket.stopped_m_s);
    let bracket = 0.5 * width.fold(0.0, f64::max);
    let least = values.last().map_or(0.0, |finest| {
        LEAST * LEAST_CELLS / finest.cells * finest.value
    });
    let resolution = bracket.max(least);
    let whole = found.len() == values.len();
    let limit = limit(&values, 0.0, resolution).filter(|_| whole);
    let reason = || {
        let lacking = found.iter().find(|(_, e)| e.ballistic_limit_m_s.is_none());
        let (cells, entry) = lacking?;
        Some(format!(
            "{} on {cells} cells: {}",
            entry.outcome.describe(),
            entry.reason.as_deref().unwrap_or_default()
        ))
    };
    AxisymmetricLimit {
        reference,
        reason: if limit.is_some() { None } else { reason() },
        ballistic_limit_m_s: limit.map(|limit| limit.value),
        uncertainty_m_s: limit.map(|limit| limit.uncertainty),
        order: limit.and_then(|limit| limit.order),
        meshes: found
            .iter()
            .map(|(cells, entry)| LimitOnMesh {
                cells_per_radius: *cells,
                outcome: entry.outcome,
                ballistic_limit_m_s: entry.ballistic_limit_m_s,
                bracket: entry.bracket,
                runs: entry.runs,
            })
            .collect(),
        warnings: found
            .last()
            .map_or_else(Vec::new, |(_, entry)| entry.warnings.clone()),
    }
}
