//! What holds a body at its edges: symmetry axis, rigid wall, back face and far edge.

use super::field::{FORCE, Field, MASS, MOMENTUM, Node};

/// Support of a plane of a target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Support {
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

/// Supports of a body. Planes stand on rows and columns of nodes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Supports {
    /// Whether a rigid, smooth wall stands at row 0, in front of the body.
    pub(super) wall: bool,
    /// Row of the back face and its support.
    pub(super) back: (isize, Support),
    /// Column of the far edge, counted with the mirrored one, and its support.
    pub(super) edge: (usize, Support),
    /// Displacement of the back face at each column [m].
    pub(super) displacement: Vec<f64>,
}

impl Supports {
    pub(super) const NONE: Self = Self {
        wall: false,
        back: (isize::MAX, Support::Free),
        edge: (usize::MAX, Support::Free),
        displacement: Vec::new(),
    };

    /// Keeps up the displacement of the back face.
    pub(super) fn follow(&mut self, field: &Field, time_step: f64) {
        let (row, Support::NonReflecting { .. }) = self.back else {
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

    /// Row of the plane in which the body is mirrored, if there is one: that of the wall or of a smooth back face.
    pub(super) fn mirror(&self) -> Option<isize> {
        match self.back {
            _ if self.wall => Some(0),
            (row, Support::Smooth) => Some(row),
            _ => None,
        }
    }

    /// A node and the mirror image that a plane without motion across it adds to it; `None` behind the plane. A wall holds only
    /// what presses.
    pub(super) fn folded(
        &self,
        field: &Field,
        row: isize,
        column: usize,
        time_step: f64,
    ) -> Option<Node> {
        let mut node = field.node(row, column);
        let Some(plane) = self.mirror() else {
            return Some(node);
        };
        let behind = row.saturating_sub(plane);
        if !(-1..=1).contains(&behind) {
            return Some(node);
        }
        let touching = field.node(plane, column);
        let presses = touching[MOMENTUM + 1] + time_step * touching[FORCE + 1] > 0.0;
        match behind {
            _ if self.wall && !presses => {}
            1 => return None,
            0 => {
                node[MOMENTUM + 1] = 0.0;
                node[FORCE + 1] = 0.0;
            }
            _ => {
                let mut image = field.node(plane + 1, column);
                image[MOMENTUM + 1] *= -1.0;
                image[FORCE + 1] *= -1.0;
                for (entry, added) in node.iter_mut().zip(image) {
                    *entry += added;
                }
            }
        }
        Some(node)
    }

    /// Velocity of a node after its supports had their say.
    pub(super) fn held(
        &self,
        node: &Node,
        velocity: [f64; 2],
        (row, column): (isize, usize),
        cell: f64,
        time_step: f64,
    ) -> [f64; 2] {
        let mut velocity = velocity;
        let area = |column: usize, width: f64| {
            2.0 * std::f64::consts::PI * (column - 1) as f64 * cell * width
        };
        let (back, support) = self.back;
        match support {
            Support::Smooth if row >= back => velocity[1] = 0.0,
            Support::NonReflecting {
                impedance,
                stiffness,
            } => {
                if let Some(share) = share(row - back) {
                    // The axis has a disc of half a cell's radius.
                    let ring = if column == 1 {
                        0.25 * std::f64::consts::PI * cell * cell
                    } else {
                        area(column, cell)
                    };
                    let moved = self.displacement.get(column).copied().unwrap_or(0.0);
                    let load = time_step * share * ring;
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
            Support::Smooth if column >= edge => velocity[0] = 0.0,
            Support::NonReflecting { impedance, .. } => {
                if let Some(share) = share(column as isize - edge as isize) {
                    let load = time_step * share * area(edge, cell);
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

/// Weight of a plane's pressure on a node that is some rows away: the kernel at the plane.
fn share(rows: isize) -> Option<f64> {
    match rows {
        0 => Some(0.75),
        -1 | 1 => Some(0.125),
        _ => None,
    }
}
