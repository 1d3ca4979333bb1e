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
/// Cells to both the filling and the projectile's tip from which on a point has left the floor: nodes outside the material have a little of its
/// mass and any velocity, and now and then carry a point away.
const LOST: f64 = 0.5;

/// Points on the struck face and the depth of the floor.
#[derive(Debug, Clone, Default, serde::Serialize, serde::Deserialize)]
pub(super) struct Floor {
    /// Radius and depth of each point [m].
    points: Vec<[f64; 2]>,
    /// Depth of the projectile's tip when it last pushed [m].
    tip: f64,
    /// How far a target that nothing holds has flown [m]: its centre of mass, from which depths count.
    flight: f64,
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
            tip: 0.0,
            flight: 0.0,
        }
    }

    /// Includes a time [s] in which a target flies with a mass [kg] and a momentum [kg m/s].
    pub(super) fn fly(&mut self, (mass, momentum): (f64, f64), time: f64) {
        if mass > 0.0 {
            self.flight += time * momentum / mass;
        }
    }

    /// How far the target has flown [m].
    pub(super) fn flight(&self) -> f64 {
        self.flight
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

    /// Depth of the floor on the axis below the face as it flies [m], given where the projectile's tip is while it pushes [m]; `None` when there is no
    /// material on the axis.
    pub(super) fn depth(
        &mut self,
        targets: &[Body],
        mesh: &Mesh,
        tip: impl FnOnce() -> Option<f64>,
    ) -> Option<f64> {
        let filled = crater::floor(targets, mesh)?;
        if filled - self.flight < DEEP * mesh.cell
            && let Some(tip) = tip()
        {
            self.tip = tip;
        }
        Some(self.correct(filled, mesh.cell) - self.flight)
    }

    /// Place of the floor for that of the filling and the cell size [m]. Points that have left it are dropped.
    fn correct(&mut self, filled: f64, cell: f64) -> f64 {
        let cells = (filled - self.flight) / cell;
        if cells < DEEP {
            let near = |depth: f64, surface: f64| (depth - surface).abs() <= LOST * cell;
            self.points
                .retain(|&[_, depth]| near(depth, filled) || near(depth, self.tip));
        }
        if self.points.is_empty() {
            return filled;
        }
        let moved =
            self.points.iter().map(|point| point[1]).sum::<f64>() / self.points.len() as f64;
        let share = ((cells - SHALLOW) / (DEEP - SHALLOW)).clamp(0.0, 1.0);
        moved + share * (filled - moved)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn floor(depths: &[f64], tip: f64) -> Floor {
        Floor {
            points: depths.iter().map(|depth| [0.0, *depth]).collect(),
            tip,
            flight: 0.0,
        }
    }

    #[test]
    fn shallow_floors_are_those_of_the_points_and_deep_ones_of_the_filling() {
        assert!((floor(&[1.0, 1.2, 1.4], 1.2).correct(1.0, 1.0) - 1.2).abs() < 1e-12);
        assert!((floor(&[3.2, 3.2], 3.2).correct(3.0, 1.0) - 3.1).abs() < 1e-12);
        assert_eq!(floor(&[1.0, 3.0], 5.0).correct(5.0, 1.0), 5.0);
    }

    #[test]
    fn points_that_have_left_the_floor_are_left_out_for_good() {
        let mut followed = floor(&[0.4, 1.9, 2.0], 2.1);
        assert!((followed.correct(2.0, 1.0) - 1.95).abs() < 1e-12);
        followed.tip = 1.2;
        assert!((followed.correct(0.5, 1.0) - 0.5).abs() < 1e-12);
        assert!(followed.points.is_empty());
    }

    #[test]
    fn a_floor_that_flies_is_as_shallow_as_its_crater() {
        let mut flying = floor(&[11.0, 11.2, 11.4], 11.2);
        flying.fly((2.0, 8.0), 2.0);
        flying.fly((0.0, 0.0), 2.0);
        flying.fly((2.0, 2.0), 2.0);
        assert_eq!(flying.flight(), 10.0);
        assert!((flying.correct(11.0, 1.0) - 11.2).abs() < 1e-12);
    }

    #[test]
    fn points_at_the_tip_stay() {
        assert!((floor(&[0.4, 0.6], 0.5).correct(2.0, 1.0) - 0.5).abs() < 1e-12);
    }
}
