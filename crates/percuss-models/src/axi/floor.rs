//! Crater floor while it is less than a cell or two deep: material points on the struck face, which the target's nodes carry.
//!
//! How much of a cell is filled says where a surface is within a tenth of a cell. That is much of a crater that is not as deep as a cell; a
//! point that moves with the material has no such error. In deep craters the material on the floor flows aside, and the filling is better.

use super::{body::Body, crater, field::MASS, kernel::Stencil, mesh::Mesh, transfer::gather};
use crate::problem::Nose;

/// Radii of the points under a flat end, over that of the projectile: close to the axis, where the floor is flat.
const FLAT: &[f64] = &[0.0, 0.1, 0.25];
/// Cells of depth from which on the filling counts, and from which on it alone does.
const SHALLOW: f64 = 2.0;
const DEEP: f64 = 4.0;

/// Points on the struck face and the depth of the floor.
#[derive(Debug, Clone, Default, serde::Serialize, serde::Deserialize)]
pub(super) struct Floor {
    /// Radius and depth of each point [m].
    points: Vec<[f64; 2]>,
}

impl Floor {
    /// Points on a face at depth 0 below a nose.
    pub(super) fn new(nose: Nose, diameter: f64) -> Self {
        let radii = match nose {
            Nose::Flat => FLAT,
            _ => &FLAT[..1],
        };
        Self {
            points: radii
                .iter()
                .map(|radius| [0.5 * diameter * radius, 0.0])
                .collect(),
        }
    }

    /// Moves the points with the struck body for a time [s].
    pub(super) fn follow(&mut self, struck: &Body, mesh: &Mesh, time: f64) {
        for point in &mut self.points {
            let [column, row] = mesh.indices(*point);
            let nearest = struck
                .field
                .node(row.round() as isize, column.round() as usize + 1);
            let stencils = [column, row].map(Stencil::at);
            // A point whose material is gone stays where it was.
            if nearest[MASS] > 0.0 && struck.field.has(&stencils) {
                let [radial, axial, ..] = gather(stencils, &struck.field).velocity;
                *point = [(point[0] + time * radial).abs(), point[1] + time * axial];
            }
        }
    }

    /// Depth of the floor on the axis [m]; `None` when there is no material on the axis.
    pub(super) fn depth(&self, targets: &[Body], mesh: &Mesh) -> Option<f64> {
        let filled = crater::floor(targets, mesh)?;
        let moved =
            self.points.iter().map(|point| point[1]).sum::<f64>() / self.points.len() as f64;
        let cells = filled / mesh.cell;
        let share = ((cells - SHALLOW) / (DEEP - SHALLOW)).clamp(0.0, 1.0);
        Some(moved + share * (filled - moved))
    }
}
