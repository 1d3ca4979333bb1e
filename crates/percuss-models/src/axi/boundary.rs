//! Boundary conditions of a body: symmetry axis, rigid wall, rear face and far edge.

use super::{
    field::{FORCE, Field, MASS, MOMENTUM, Node},
    mesh::Mesh,
};

/// BoundaryCondition of a plane of a target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum BoundaryCondition {
    /// Nothing.
    Free,
    /// No motion across the plane.
    Smooth,
    /// Waves leave, and the static stiffness of what was cut off stays.
    NonReflecting {
        /// Impedance of longitudinal and of shear waves [kg/(m2 s)].
        impedance: [f64; 2],
        /// Stiffness across the plane [Pa/m].
        stiffness: f64,
    },
}

/// BoundaryConditions of a body. Planes stand on rows and columns of nodes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct BoundaryConditions {
    /// Whether a rigid, smooth wall stands at row 0, in front of the body.
    pub(super) wall: bool,
    /// Row of the rear face and its support.
    pub(super) back: (isize, BoundaryCondition),
    /// Column of the far edge, counted with the mirrored one, and its support.
    pub(super) edge: (usize, BoundaryCondition),
    /// Displacement of the rear face at each column [m].
    pub(super) displacement: Vec<f64>,
}

impl BoundaryConditions {
    pub(super) const NONE: Self = Self {
        wall: false,
        back: (isize::MAX, BoundaryCondition::Free),
        edge: (usize::MAX, BoundaryCondition::Free),
        displacement: Vec::new(),
    };

    /// Keeps up the displacement of the rear face.
    pub(super) fn follow(&mut self, field: &Field, time_step: f64) {
        let (row, BoundaryCondition::NonReflecting { .. }) = self.back else {
            return;
        };
        self.displacement
            .resize(field.columns.max(self.displacement.len()), 0.0);
        for column in 1..field.columns {
            if let Some(index) = field.index(row, column) {
                self.displacement[column] += time_step * field.velocity[index][1];
            }
        }
    }

    /// Row of the plane in which the body is mirrored, if there is one: that of the wall or of a smooth rear face.
    pub(super) fn mirror(&self) -> Option<isize> {
        match self.back {
            _ if self.wall => Some(0),
            (row, BoundaryCondition::Smooth) => Some(row),
            _ => None,
        }
    }

    /// Column of the edge in which the body is mirrored, if it is a smooth one. An edge on the axis holds the whole body, and mirrors
    /// nothing.
    fn mirror_column(&self) -> Option<usize> {
        match self.edge {
            (column, BoundaryCondition::Smooth) if column > 1 => Some(column),
            _ => None,
        }
    }

    /// The first columns of a row of so many that neither supports nor mirror images reach.
    pub(super) fn free_columns(&self, row: isize, columns: usize) -> usize {
        let is_reflected = self
            .mirror()
            .is_some_and(|plane| (-1..=1).contains(&row.saturating_sub(plane)));
        let is_supported = match self.back {
            (_, BoundaryCondition::Free) => false,
            (back, BoundaryCondition::Smooth) => row >= back,
            (back, BoundaryCondition::NonReflecting { .. }) => share(row - back).is_some(),
        };
        match self.edge {
            _ if is_reflected || is_supported => 0,
            (_, BoundaryCondition::Free) => columns,
            (edge, _) => columns.min(edge.saturating_sub(1)),
        }
    }

    /// A node and what contact takes from it, with what lies mirrored in planes without motion across them added; `None` behind
    /// such a plane. A wall holds only what presses.
    pub(super) fn folded(
        &self,
        field: &Field,
        row: isize,
        column: usize,
        time_step: f64,
    ) -> Option<Load> {
        let mut load = self.folded_along(field, row, column, time_step)?;
        let Some(edge) = self.mirror_column() else {
            return Some(load);
        };
        if column == edge {
            load.stop(0);
        } else if column == edge + 1 {
            return None;
        } else if column + 1 == edge
            && let Some(mut image) = self.folded_along(field, row, edge + 1, time_step)
        {
            image.reverse(0);
            load.add(&image);
        }
        Some(load)
    }

    /// The same for planes across the axis alone.
    fn folded_along(
        &self,
        field: &Field,
        row: isize,
        column: usize,
        time_step: f64,
    ) -> Option<Load> {
        let mut load = Load::at(field, row, column);
        let Some(plane) = self.mirror() else {
            return Some(load);
        };
        let behind = row.saturating_sub(plane);
        if !(-1..=1).contains(&behind) {
            return Some(load);
        }
        let touching = field.node(plane, column);
        let presses = touching[MOMENTUM + 1] + time_step * touching[FORCE + 1] > 0.0;
        match behind {
            _ if self.wall && !presses => {}
            1 => return None,
            0 => load.stop(1),
            _ => {
                let mut image = Load::at(field, plane + 1, column);
                image.reverse(1);
                load.add(&image);
            }
        }
        Some(load)
    }

    /// The place whose mirror image a node is that `folded` has nothing for, and the signs of its velocity there.
    pub(super) fn original(&self, row: isize, column: usize) -> ((isize, usize), [f64; 2]) {
        let (mut place, mut signs) = ((row, column), [1.0; 2]);
        if let Some(edge) = self.mirror_column().filter(|edge| column == edge + 1) {
            place.1 = edge - 1;
            signs[0] = -1.0;
        }
        if let Some(plane) = self.mirror().filter(|plane| row == plane + 1) {
            place.0 = plane - 1;
            signs[1] = -1.0;
        }
        (place, signs)
    }

    /// Velocity of a node after its supports had their say.
    pub(super) fn held(
        &self,
        node: &Node,
        velocity: [f64; 2],
        (row, column): (isize, usize),
        mesh: &Mesh,
        time_step: f64,
    ) -> [f64; 2] {
        let mut velocity = velocity;
        let (back, support) = self.back;
        match support {
            BoundaryCondition::Smooth if row >= back => velocity[1] = 0.0,
            BoundaryCondition::NonReflecting {
                impedance,
                stiffness,
            } => {
                if let Some(share) = share(row - back) {
                    let moved = self.displacement.get(column).copied().unwrap_or(0.0);
                    let load = time_step * share * mesh.ring(column);
                    let mass = node[MASS];
                    velocity[1] = (mass * velocity[1] - load * stiffness * moved)
                        / (mass + load * impedance[0]);
                    velocity[0] *= mass / (mass + load * impedance[1]);
                }
            }
            _ => {}
        }
        let (edge, support) = self.edge;
        match support {
            BoundaryCondition::Smooth if column >= edge => velocity[0] = 0.0,
            BoundaryCondition::NonReflecting { impedance, .. } => {
                if let Some(share) = share(column as isize - edge as isize) {
                    let load = time_step * share * mesh.sleeve(edge, row);
                    let mass = node[MASS];
                    velocity[0] *= mass / (mass + load * impedance[0]);
                    velocity[1] *= mass / (mass + load * impedance[1]);
                }
            }
            _ => {}
        }
        velocity
    }
}

/// A node and what contact takes from it [N s].
#[derive(Debug, Clone, Copy)]
pub(super) struct Load {
    pub(super) node: Node,
    pub(super) taken: [f64; 2],
}

impl Load {
    fn at(field: &Field, row: isize, column: usize) -> Self {
        Self {
            node: field.node(row, column),
            taken: field.taken(row, column),
        }
    }

    /// Takes away all motion in a direction.
    fn stop(&mut self, direction: usize) {
        self.node[MOMENTUM + direction] = 0.0;
        self.node[FORCE + direction] = 0.0;
        self.taken[direction] = 0.0;
    }

    fn reverse(&mut self, direction: usize) {
        self.node[MOMENTUM + direction] *= -1.0;
        self.node[FORCE + direction] *= -1.0;
        self.taken[direction] *= -1.0;
    }

    fn add(&mut self, other: &Self) {
        for (entry, added) in self.node.iter_mut().zip(other.node.0) {
            *entry += added;
        }
        for (entry, added) in self.taken.iter_mut().zip(other.taken) {
            *entry += added;
        }
    }
}

/// Weight of a plane's pressure on a node that is some rows away: the kernel at the plane.
fn share(rows: isize) -> Option<f64> {
    match rows {
        0 => Some(0.75),
        -1 | 1 => Some(0.125),
        _ => None,
    }
}
