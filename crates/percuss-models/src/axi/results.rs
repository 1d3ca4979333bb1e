//! From the state at the end of a run to its result.

use super::{crater, remnant::Remnant, run::Axisymmetric, setup::extent, solver::Grid};
use crate::{
    outcome::{Detail, Outcome, RunResult, Termination},
    problem::RearFaceCondition,
    scenario::TargetBody,
    shapes::Shapes,
    solver::{Particle, interface::Extremes, monitor::RunMonitor},
};

/// Part of a cell by which a surface must lie below the original face to be a crater, and by which a plate must be thinner.
const NOTICEABLE: f64 = 0.1;
const THINNER: f64 = 0.25;

/// Part of a projectile below which what has come off it is not told apart: rounding of the sums.
const WHOLE: f64 = 1e-9;

/// Adds depths, what is left of the projectile, shapes and warnings.
pub(super) fn complete(run: &Axisymmetric<'_>, result: &mut RunResult, monitor: &RunMonitor) {
    let (scenario, solver) = (run.scenario, &run.grid);
    let solid = matches!(scenario.target, TargetBody::Layers { .. });
    let rod = &solver.bodies[0];
    let sums = &solver.sums[0];
    if solid {
        result.depth_of_penetration = Some(monitor.depth_at_rest());
        result.largest_depth = Some(monitor.largest_depth);
        result.permanent_depth = Some(run.depth.max(0.0));
    }
    // Debris of a rod that has come through stays behind in the hole.
    let remnant = (result.outcome == Outcome::Perforated)
        .then(|| Remnant::of(rod, &solver.mesh))
        .flatten()
        .filter(|piece| piece.mass < sums.mass * (1.0 - WHOLE));
    let (mass, momentum) = remnant.map_or((sums.mass, sums.momentum), |piece| {
        (piece.mass, piece.momentum)
    });
    result.residual_velocity = Some(if mass > 0.0 { momentum / mass } else { 0.0 });
    // The outline of particles lies within a part of a cell of the surface: what did not move keeps its size.
    let (length, diameter) = match result.termination {
        Termination::NothingMoves => (
            Some(scenario.projectile.length),
            Some(scenario.projectile.diameter),
        ),
        _ => (
            crater::ends(rod, &solver.mesh).map(|(tail, tip)| tip - tail),
            (mass > 0.0).then(|| {
                2.0 * remnant.map_or_else(|| crater::largest_radius(rod), |piece| piece.radius)
            }),
        ),
    };
    result.projectile_final_length = length;
    result.projectile_final_diameter = diameter;
    result.projectile_final_mass = Some(mass);
    let shapes = Shapes {
        crater: if solid {
            crater::profile(
                &solver.bodies[1..],
                &solver.mesh,
                run.depth,
                run.floor.flight(),
            )
        } else {
            Vec::new()
        },
        projectile: crater::outline(rod, &solver.mesh),
    };
    result.details = details(run, &shapes.crater);
    if remnant.is_some() {
        result.details.push(Detail::new(
            "debris of the projectile",
            "g",
            (sums.mass - mass) * 1e3,
        ));
    }
    result.shapes = Some(shapes);
    result.warnings = super::warnings::warnings(run, result);
}

/// Mesh and extremes of the material.
pub(super) fn extremes(solver: &Grid) -> Extremes {
    let most = |target: bool, value: fn(&Particle) -> f64| {
        let bodies = solver
            .bodies
            .iter()
            .enumerate()
            .filter(|(index, _)| (*index > 0) == target);
        bodies
            .flat_map(|(_, body)| body.particles())
            .map(|particle| value(&particle))
            .fold(0.0, f64::max)
    };
    let particles = |target: bool| {
        let bodies = solver
            .bodies
            .iter()
            .enumerate()
            .filter(|(index, _)| (*index > 0) == target);
        let lost = solver.accumulated.lost[usize::from(target)];
        let present = |body: &super::body::Body| body.particles().filter(|p| p.mass > 0.0).count();
        lost + bodies.map(|(_, body)| present(body)).sum::<usize>()
    };
    Extremes {
        elements: (particles(false), particles(true)),
        eroded_elements: (solver.accumulated.lost[0], solver.accumulated.lost[1]),
        largest_plastic_strain: (
            most(false, |p| p.plastic_strain),
            most(true, |p| p.plastic_strain),
        ),
        largest_temperature: (
            most(false, |p| p.temperature),
            most(true, |p| p.temperature),
        ),
    }
}

fn details(run: &Axisymmetric<'_>, crater: &[[f64; 2]]) -> Vec<Detail> {
    let solver = &run.grid;
    let mut details = vec![Detail::new("cell size", "mm", solver.mesh.cell * 1e3)];
    let present = solver.bodies.iter().flat_map(|body| body.particles());
    details.push(Detail::new(
        "particles",
        "",
        present.filter(|particle| particle.mass > 0.0).count() as f64,
    ));
    let Some(extent) = extent(run.scenario) else {
        return details;
    };
    let thickness: f64 = extent.layers.iter().sum();
    details.extend([
        Detail::new("modelled target radius", "mm", extent.radius * 1e3),
        Detail::new("modelled target depth", "mm", thickness * 1e3),
    ]);
    // The face of a plate that bends lies below where it was far beyond the crater.
    let is_plate = run.scenario.rear_face() == Some(RearFaceCondition::Free)
        && run.scenario.only_layer().is_some();
    let (names, (mouth, volume)) = match is_plate {
        true => (
            [
                "crater diameter where the target is thinner",
                "crater volume by loss of thickness",
            ],
            mouth(
                &thinning(solver, crater, thickness),
                THINNER * solver.mesh.cell,
            ),
        ),
        false => (
            [
                "crater diameter at the original face",
                "crater volume below the original face",
            ],
            mouth(crater, NOTICEABLE * solver.mesh.cell),
        ),
    };
    details.extend([
        Detail::new(names[0], "mm", 2e3 * mouth),
        Detail::new(names[1], "mm3", volume * 1e9),
    ]);
    details
}

/// How much thinner the target is than it was at the places of a crater's profile [m]; in a hole, all of it.
fn thinning(solver: &Grid, crater: &[[f64; 2]], thickness: f64) -> Vec<[f64; 2]> {
    let Some(last) = solver.bodies.last() else {
        return Vec::new();
    };
    let edge = crater.first().map_or(0.0, |place| place[0]);
    let hole = [0.0, edge].map(|radius| [radius, thickness]);
    let places = crater.iter().filter_map(|&[radius, face]| {
        let rear = crater::rear(last, radius, &solver.mesh)?;
        Some([radius, thickness - (rear - face)])
    });
    let hole = hole.into_iter().filter(|_| edge > 0.0);
    hole.chain(places).collect()
}

/// Radius of a crater at the original face [m] and its volume below that face [m3]: from the axis outwards to where the surface is
/// no more than `least` below the face. Beyond, a loaded face sinks elastically, which is no crater.
fn mouth(crater: &[[f64; 2]], least: f64) -> (f64, f64) {
    let (mut radius, mut volume) = (0.0, 0.0);
    for pair in crater.windows(2) {
        let [[from, above], [to, below]] = [pair[0], pair[1]];
        if above <= least {
            break;
        }
        let part = if below > least {
            1.0
        } else {
            (above - least) / (above - below)
        };
        radius = from + part * (to - from);
        let depth = above + 0.5 * part * (below - above);
        volume += std::f64::consts::PI * (radius * radius - from * from) * depth;
    }
    (radius, volume)
}

#[cfg(test)]
mod tests {
    use super::mouth;

    #[test]
    fn a_crater_ends_where_its_surface_comes_back_to_the_face() {
        // A cone of depth 2 and radius 4 in a face that has sunk by 0.001 far around, behind a lip.
        let crater: Vec<[f64; 2]> = (0..=400)
            .map(|i| {
                let radius = f64::from(i) * 0.05;
                let depth = match radius {
                    ..4.5 => 2.0 - 0.5 * radius,
                    _ => 0.001,
                };
                [radius, depth]
            })
            .collect();
        let (radius, volume) = mouth(&crater, 0.01);
        assert!((radius - 3.98).abs() < 1e-9, "{radius}");
        let cone = std::f64::consts::PI * 16.0 * 2.0 / 3.0;
        assert!((volume / cone - 1.0).abs() < 2e-3, "{volume}");
        assert_eq!(mouth(&[[0.0, 0.001], [1.0, 0.001]], 0.01), (0.0, 0.0));
    }
}
